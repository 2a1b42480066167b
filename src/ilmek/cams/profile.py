"""Plate cam with a translating roller or knife-edge follower: formulas at one cam angle.

The cam turns counter-clockwise by theta; the follower slides along +x on the line y = -e. In the cam's frame the
roller's centre is, with r = s + sqrt(Rp^2 - e^2),

    P = (r - i e) exp(-i theta),    dP/dtheta = ((s' - e) - i r) exp(-i theta)

so that the outward normal is n = (r + i (s' - e)) exp(-i theta) / |dP|. Rp is the prime radius: the least distance of
the roller's centre (of the knife's edge, where the roller radius is 0) from the cam's axis. The offset e is positive
on the side that lowers the pressure angle of a rise. Units: angle [rad], s, s', s'' [m, m/rad, m/rad^2], radii and
offset [m]; any shapes that broadcast.
[Norton, Cam Design and Manufacturing, 7; thesis 3.2]
"""

import math

import numpy as np

from ilmek.arrays import ComplexField, RealField


def reach(s: RealField, prime_radius: float, offset: float = 0.0) -> RealField:
    """Distance r [m] of the roller's centre from the cam's axis along the follower's line."""
    return s + math.sqrt(prime_radius**2 - offset**2)


def pitch_point(angle: RealField, s: RealField, prime_radius: float, offset: float = 0.0) -> ComplexField:
    """Roller's centre in the cam's frame [m], complex."""
    point: ComplexField = (reach(s, prime_radius, offset) - 1j * offset) * np.exp(-1j * np.asarray(angle))
    return point


def normal(angle: RealField, s: RealField, ds: RealField, prime_radius: float, offset: float = 0.0) -> ComplexField:
    """Outward unit normal of the pitch curve in the cam's frame, complex.

    angle, s, ds, prime_radius, offset  as in the module: [rad], [m], [m/rad], [m], [m], shapes that broadcast
    """
    arrow = reach(s, prime_radius, offset) + 1j * (ds - offset)
    unit: ComplexField = arrow / np.abs(arrow) * np.exp(-1j * np.asarray(angle))
    return unit


def pressure_angle(s: RealField, ds: RealField, prime_radius: float, offset: float = 0.0) -> RealField:
    """Pressure angle [rad] from the follower's direction to the contact normal: tan mu = (s' - e) / r."""
    return np.arctan2(ds - offset, reach(s, prime_radius, offset))


def curvature(s: RealField, ds: RealField, dds: RealField, prime_radius: float, offset: float = 0.0) -> RealField:
    """Curvature of the pitch curve [1/m], positive where convex.

    kappa = (r (r - s'') + (s' - e)(2 s' - e)) / (r^2 + (s' - e)^2)^(3/2)
    """
    r = reach(s, prime_radius, offset)
    return (r * (r - dds) + (ds - offset) * (2 * ds - offset)) / (r**2 + (ds - offset) ** 2) ** 1.5
