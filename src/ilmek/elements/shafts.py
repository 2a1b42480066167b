"""Smallest section of a simply supported, uniformly loaded shaft for a slope and a deflection.

The least second moment of area for the limit, and the size of the section that has it (`beam.uniform`). Load w [N/m],
length l [m], modulus E [Pa], slope theta [rad], deflection y [m].                 [thesis 3.1, 3.2, eq. 3.4, 3.5]
"""

import math

import numpy as np

from ilmek.units import mm

STOCK_SIDES = tuple(
    side * mm for side in (20, 22, 25, 28, 30, 32, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80, 90, 100, 110, 120, 130, 150)
)
"""Stock sides of hot rolled square steel bars [m] (a choice from EN 10059)."""


def inertia_for_slope(load: float, length: float, modulus: float, slope: float) -> float:
    """Least second moment of area [m^4] for a slope at the supports: w l^3 / (24 E theta)."""
    return load * length**3 / (24 * modulus * slope)


def inertia_for_deflection(load: float, length: float, modulus: float, deflection: float) -> float:
    """Least second moment of area [m^4] for a deflection at mid-span: 5 w l^4 / (384 E y)."""
    return 5 * load * length**4 / (384 * modulus * deflection)


def square_side(inertia: float) -> float:
    """Side [m] of a square bar with a second moment of area [m^4]: (12 I)^(1/4)."""
    return float((12 * inertia) ** 0.25)


def tube_outer_radius(inertia: float, inner_radius: float) -> float:
    """Outer radius [m] of a tube with a second moment of area [m^4]: (Ri^4 + 4 I / pi)^(1/4)."""
    return float((inner_radius**4 + 4 * inertia / math.pi) ** 0.25)


def stock_side(side: float) -> float | None:
    """The smallest stock bar's side [m] that is not below `side`; None beyond the largest.

    >>> stock_side(0.069)
    0.07
    """
    return next((stock for stock in STOCK_SIDES if stock >= side * (1 - 1e-9)), None)


POISSON = 0.3
"""Poisson's ratio of steel: G = E / 2.6 [EN 1993-1-1, 3.2.6]."""

SQUARE_TORSION, SQUARE_SHEAR = 0.140577, 0.208165
"""Factors of a square bar of side B: J = 0.1406 B^4, largest shear stress T / (0.208 B^3).

[Saint-Venant's series; Timoshenko and Goodier, Theory of Elasticity, torsion of rectangular bars]
"""


def square_twist(torque: float, length: float, modulus: float, side: float) -> float:
    """Twist [rad] of a square bar driven at one end, with the torque [N m] taken off evenly along its length [m].

    T l / (2 G J): half the twist of the same torque at the far end
    """
    return torque * length / (2 * modulus / (2 + 2 * POISSON) * SQUARE_TORSION * side**4)


def side_for_twist(torque: float, length: float, modulus: float, twist: float) -> float:
    """Least side [m] of a square bar for a twist [rad]; see `square_twist`."""
    return math.sqrt(math.sqrt(square_twist(torque, length, modulus, 1.0) / twist))


def square_stress(moment: float, torque: float, side: float) -> float:
    """Equivalent stress [Pa] of a square bar in bending and torsion: sqrt(sigma^2 + 3 tau^2), von Mises."""
    return math.hypot(6 * moment, math.sqrt(3) * torque / SQUARE_SHEAR) / side**3


def side_for_strength(moment: float, torque: float, strength: float) -> float:
    """Least side [m] of a square bar for a strength [Pa] under a moment and a torque [N m]."""
    return float(np.cbrt(square_stress(moment, torque, 1.0) / strength))
