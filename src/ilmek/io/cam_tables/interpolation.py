"""Interpolations of controllers between the points of a cam table, from which the error of a table is computed.

linear   straight lines; needs the positions alone
spline   the periodic cubic spline through all points, with two continuous derivatives
quintic  between neighbours the polynomial of the fifth degree with their positions, velocities and accelerations
"""

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np
import scipy

from ilmek.arrays import Float, FloatArray
from ilmek.records import record


@record
class Nodes:
    """Points of a cam table over a turn: master angles [rad] from 0 to 2 pi, ascending; s [SI] and its derivatives."""

    angle: Float[np.ndarray, " nodes"]
    s: Float[np.ndarray, " nodes"]
    ds: Float[np.ndarray, " nodes"]
    dds: Float[np.ndarray, " nodes"]


Between: TypeAlias = Callable[[Nodes, FloatArray], FloatArray]


@record
class Interpolation:
    """A method of interpolation.

    at     nodes and master angles in [0, 2 pi] [rad] -> positions [SI]
    order  halving the distance of points divides the error of a smooth motion by 2^order
    """

    name: str
    at: Between
    order: int


def linear(nodes: Nodes, angle: FloatArray) -> FloatArray:
    """Positions [SI] at master angles [rad] by linear interpolation."""
    return np.asarray(np.interp(angle, nodes.angle, nodes.s))


def spline(nodes: Nodes, angle: FloatArray) -> FloatArray:
    """Positions [SI] at master angles [rad] by the periodic cubic spline plus a uniform motion."""
    slope = (nodes.s[-1] - nodes.s[0]) / (nodes.angle[-1] - nodes.angle[0])
    rest = nodes.s - slope * nodes.angle
    rest[-1] = rest[0]
    return np.asarray(scipy.interpolate.CubicSpline(nodes.angle, rest, bc_type="periodic")(angle) + slope * angle)


def quintic(nodes: Nodes, angle: FloatArray) -> FloatArray:
    """Positions [SI] at master angles [rad] by quintic Hermite polynomials.

    With h the distance of neighbours and u the share of it:
    s = s0 + u v0 + u^2 a0/2 + u^3 (10 D - 4 E + F/2) + u^4 (-15 D + 7 E - F) + u^5 (6 D - 3 E + F/2),
    v = h s', a = h^2 s'',  D = s1 - s0 - v0 - a0/2,  E = v1 - v0 - a0,  F = a1 - a0
    """
    index = np.clip(np.searchsorted(nodes.angle, angle, side="right") - 1, 0, len(nodes.angle) - 2)
    h = np.diff(nodes.angle)[index]
    u = (angle - nodes.angle[index]) / h
    v0, v1 = h * nodes.ds[index], h * nodes.ds[index + 1]
    a0, a1 = h**2 * nodes.dds[index], h**2 * nodes.dds[index + 1]
    d, e, f = nodes.s[index + 1] - nodes.s[index] - v0 - a0 / 2, v1 - v0 - a0, a1 - a0
    high = 10 * d - 4 * e + f / 2 + u * (-15 * d + 7 * e - f + u * (6 * d - 3 * e + f / 2))
    return np.asarray(nodes.s[index] + u * (v0 + u * (a0 / 2 + u * high)))


INTERPOLATIONS: Mapping[str, Interpolation] = {
    "linear": Interpolation("linear", linear, 2),
    "spline": Interpolation("spline", spline, 4),
    "quintic": Interpolation("quintic", quintic, 6),
}
