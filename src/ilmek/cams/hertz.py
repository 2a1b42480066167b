"""Contact pressure between cam and follower after Hertz: line contact and elliptical contact.

Both bodies are assumed smooth, elastic and much larger than the contact. A curvature is positive for a convex body,
negative for a concave one and 0 for a flat one. The bodies touch only where the sum of the curvatures is positive;
elsewhere the results are NaN. Without load the pressure is 0.
[Johnson, Contact Mechanics, 4.2; Hertz 1882]

>>> steel = contact_modulus(206e9, 0.3, 206e9, 0.3)
>>> line = line_contact(1000 / 0.015, 1 / 0.012 + 1 / 0.040, steel)      # a roller of 12 mm on a cam of 40 mm
>>> round(float(line.half_width) * 1e3, 7), round(float(line.pressure) * 1e-6, 4)
(0.0832014, 510.1036)
"""

import math
from typing import NamedTuple

import numpy as np

from ilmek.arrays import FloatArray, RealField

_STEPS = 20
_SLOPE = -1.75
"""Slope of the logarithm of the ratio of curvatures over that of the ratio of axes: -1.5 for a circle, -2 for a line.
A step with this slope leaves at most 1/7 of the error."""

_NOT_ROUND = -1e-9
"""Largest logarithm of the ratio of axes; for a circle the formula of the ratio is 0/0."""

_MEANS = 6
"""Steps of the arithmetic-geometric mean: enough from a ratio of 1e-6 to rounding."""

LINE_YIELD, POINT_YIELD = 1.79, 1.60
"""Pressure over yield strength at which steel first yields, below the surface, after von Mises [Johnson, 4.5, 6.2]."""


class Line(NamedTuple):
    """Line contact: half width [m] and maximum pressure [Pa]."""

    half_width: FloatArray
    pressure: FloatArray


class Ellipse(NamedTuple):
    """Elliptical contact: semi-axes [m] in the planes of larger and smaller curvature, and maximum pressure [Pa]."""

    narrow: FloatArray
    wide: FloatArray
    pressure: FloatArray


def contact_modulus(first: float, first_poisson: float, second: float, second_poisson: float) -> float:
    """Contact modulus E* of a pair [Pa]: 1/E* = (1 - v1^2)/E1 + (1 - v2^2)/E2.

    first, second  elastic moduli [Pa]      first_poisson, second_poisson  Poisson's ratios [-]
    """
    return 1.0 / ((1 - first_poisson**2) / first + (1 - second_poisson**2) / second)


def line_contact(load: RealField, curvature: RealField, modulus: float) -> Line:
    """Line contact of two parallel cylinders.

        b^2 = 4 q / (pi E* k),   p0 = 2 q / (pi b) = sqrt(q E* k / pi)

    load        q, per length of the line [N/m]; below 0 counts as 0
    curvature   k, sum of both bodies [1/m]; not above 0: no line contact, NaN
    modulus     E* of the pair [Pa]
    """
    q = np.maximum(load, 0.0)
    k = _touching(curvature)
    return Line(np.asarray(np.sqrt(4 * q / (math.pi * modulus * k))), np.asarray(np.sqrt(q * modulus * k / math.pi)))


def ellipse_contact(load: RealField, along: RealField, across: RealField, modulus: float) -> Ellipse:
    """Point contact of two bodies with principal curvatures in the same two planes.

        (k_sharp / k_flat) = (E(e)/k'^2 - K(e)) / (K(e) - E(e)),   k' = b/a,   e^2 = 1 - k'^2
        b^3 = 3 F k' E(e) / (pi E* (along + across)),   p0 = 3 F / (2 pi a b)

    load            F [N]; below 0 counts as 0
    along, across   relative curvatures in the two planes [1/m], sums of both bodies; not above 0: NaN
    modulus         E* of the pair [Pa]

    A sphere on a plane: a^3 = 3 F R / (4 E*), p0 = 3 F / (2 pi a^2).     [Johnson, eqs. 4.22 to 4.32]
    """
    sharp, flat = _touching(np.maximum(along, across)), _touching(np.minimum(along, across))
    slim = _slimness(sharp / flat)
    _, part = _elliptic(slim)
    force = np.maximum(load, 0.0)
    narrow = np.cbrt(3 * force * slim * part / (math.pi * modulus * (sharp + flat)))
    wide = narrow / slim
    with np.errstate(divide="ignore", invalid="ignore"):
        pressure = np.where(force > 0, 3 * force / (2 * math.pi * wide * narrow), 0.0 * narrow)
    return Ellipse(np.asarray(narrow), np.asarray(wide), np.asarray(pressure))


def _touching(curvature: RealField) -> RealField:
    k = np.asarray(curvature, dtype=float)
    return np.where(k > 0, k, np.nan)


def _slimness(ratio: RealField) -> RealField:
    """Smaller over larger semi-axis for a ratio of curvatures >= 1."""
    target = np.log(ratio)
    found = target / _SLOPE
    for _ in range(_STEPS):
        found = np.minimum(found, _NOT_ROUND)
        found = found - (np.log(_ratio(np.exp(found))) - target) / _SLOPE
    return np.where(ratio > 1, np.exp(np.minimum(found, 0.0)), 1.0)


def _ratio(slim: RealField) -> RealField:
    """Ratio of curvatures of an ellipse of this ratio of axes; falls from infinity to 1."""
    square = 1 - slim**2
    tail = _tail(slim)
    return (square / 2 - tail) / (slim**2 * (square / 2 + tail))


def _elliptic(slim: RealField) -> tuple[RealField, RealField]:
    """Complete elliptic integrals K and E of e^2 = 1 - slim^2."""
    mean = _mean(slim)
    first = 0.5 * math.pi / mean
    return first, first * (1 - (1 - slim**2) / 2 - _tail(slim))


def _mean(slim: RealField) -> RealField:
    a: RealField = 1.0
    b = slim
    for _ in range(_MEANS):
        a, b = 0.5 * (a + b), np.sqrt(a * b)
    return a


def _tail(slim: RealField) -> RealField:
    """Sum of 2^(n-1) c_n^2 over n >= 1 of the arithmetic-geometric mean, each c without cancellation."""
    a: RealField = 1.0
    total: RealField = 0.0
    b, c = slim, (1 - slim) / 2
    for n in range(_MEANS):
        a, b = 0.5 * (a + b), np.sqrt(a * b)
        total = total + 2.0**n * c**2
        c = c**2 / (2 * (a + b))
    return total
