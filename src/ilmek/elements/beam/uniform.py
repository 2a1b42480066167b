"""Simply supported beam under a uniform load, and the inertia of its section; for other beams see `bend`.

Load w [N/m], length l [m], modulus E [Pa], second moment of area I [m^4]; any shapes that broadcast. Deflection is
positive along the load. l is the distance of the supports.
                                                                                               [thesis 3.1, eq. 3.1-3.7]

The ratio of the largest deflection and slope does not depend on the section: y/theta = 5 l / 16.

>>> tube = 210e9 * float(tube_inertia(0.07, 0.065))
>>> bent = bend(Beam(1.2, (0.0, 1.2), (LineLoad(0.0, 1.2, 7500.0),)))
>>> round(bent.deflection_max(tube).size * 1e3, 6), round(bent.slope_at_supports(tube).size * 1e4, 4)
(0.199333, 5.3155)
"""

import math

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.elements.beam.model import Beam, Couple, LineLoad, PointLoad
from ilmek.elements.beam.result import BeamExtreme, BeamResult
from ilmek.elements.beam.solve import bend

__all__ = [
    "Beam",
    "BeamExtreme",
    "BeamResult",
    "Couple",
    "LineLoad",
    "PointLoad",
    "bend",
    "bending_stress",
    "deflection",
    "deflection_max",
    "moment_max",
    "reaction",
    "slope_max",
    "square_inertia",
    "tube_inertia",
]


def reaction(load: RealField, length: RealField) -> RealField:
    """Force on each support [N]: w l / 2 [eq. 3.1]."""
    return load * length / 2


def deflection(x: FloatArray, load: float, length: float, modulus: float, *, inertia: float) -> FloatArray:
    """Deflection [m] at x [m] from a support: w x (l^3 - 2 l x^2 + x^3) / (24 E I) [eq. 3.3, there with sign minus]."""
    shape = np.asarray(x * (length**3 - 2 * length * x**2 + x**3))
    return load / (24 * modulus * inertia) * shape


def deflection_max(load: RealField, length: RealField, modulus: RealField, inertia: RealField) -> RealField:
    """Deflection at mid-span [m]: 5 w l^4 / (384 E I) [eq. 3.4]; the thesis' Table 3.1 left the 5 out."""
    return 5 * load * length**4 / (384 * modulus * inertia)


def slope_max(load: RealField, length: RealField, modulus: RealField, inertia: RealField) -> RealField:
    """Slope at the supports [rad]: w l^3 / (24 E I) [eq. 3.5]."""
    return load * length**3 / (24 * modulus * inertia)


def moment_max(load: RealField, length: RealField) -> RealField:
    """Bending moment at mid-span [N m]: w l^2 / 8."""
    return load * length**2 / 8


def tube_inertia(outer_radius: RealField, inner_radius: RealField = 0.0) -> RealField:
    """Second moment of area [m^4] of a tube, or of a solid round bar: pi/4 (Ro^4 - Ri^4).

    Radii, not diameters: the thesis' 140 x 5 mm tube is Ro = 70 mm, Ri = 65 mm.
    """
    return 0.25 * math.pi * (outer_radius**4 - inner_radius**4)


def square_inertia(side: RealField) -> RealField:
    """Second moment of area [m^4] of a square bar: B^4 / 12."""
    return side**4 / 12


def bending_stress(moment: RealField, distance: RealField, inertia: RealField) -> RealField:
    """Stress [Pa] at `distance` [m] from the neutral line: M c / I."""
    return np.multiply(moment, distance) / inertia
