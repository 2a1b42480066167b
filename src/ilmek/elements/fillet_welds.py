"""Fillet welds by the simplified method: the force on each length of a weld against its shear strength.

    F / l <= f a,   f = f_u / (sqrt 3 beta gamma)                                [EN 1993-1-8, 4.5.3.3, eq. 4.3 and 4.4]

a throat, f_u tensile strength of the weaker part joined, beta 0.8 of S235 [table 4.1], gamma 1.25 [2.2]. The throat is
3 mm at least [4.5.2], and 0.7 of the thinner wall at most, which is as strong as the wall. Groups of welds share a
force evenly and a moment linearly: n = F / L + M r / J.                           [theory of elasticity of weld groups]
"""

import math
from dataclasses import dataclass

from ilmek.elements.columns import STEEL
from ilmek.units import mm

CORRELATION, PARTIAL = 0.8, 1.25

STRENGTH = STEEL.tensile / (math.sqrt(3) * CORRELATION * PARTIAL)
"""Shear strength of a fillet weld of S235 [Pa]."""

THROATS = tuple(size * mm for size in (3, 4, 5, 6, 7, 8, 10, 12))
"""Throats of welds [m]."""

_OF_WALL = 0.7


@dataclass(frozen=True, slots=True)
class RoundSquare:
    """A weld all round a square section of a side [m].

    >>> weld = RoundSquare(0.1)
    >>> round(weld.force(1000.0, 0.0), 6), round(weld.force(0.0, 1.0), 6)
    (2500.0, 75.0)
    """

    side: float

    def force(self, force: float, moment: float) -> float:
        """Greatest force on a length [N/m] of a force [N], and of a moment that bends the section [N m]."""
        return abs(force) / (4 * self.side) + abs(moment) * (self.side / 2) / (2 / 3 * self.side**3)


@dataclass(frozen=True, slots=True)
class TwoSeams:
    """Two parallel welds of a length, their distance from each other [m]: a plate on the side of a hollow section."""

    length: float
    distance: float

    @property
    def polar(self) -> float:
        """J of the lines about their common middle [m³]."""
        return self.length**3 / 6 + self.length * self.distance**2 / 2

    def force(self, force: float, moment: float, across: float = 0.0) -> float:
        """Greatest force on a length [N/m] of a force in the plane of the welds [N], a moment in it, and one that lifts
        their ends off it, across [N m].
        """
        corner = math.hypot(self.length, self.distance) / 2
        inside = abs(force) / (2 * self.length) + abs(moment) * corner / self.polar
        return math.hypot(inside, 3 * abs(across) / self.length**2)


def throat_for(force: float, wall: float) -> float:
    """The least throat [m] for a force on a length [N/m]; the largest that a wall of a thickness [m] allows, or 3 mm.

    >>> throat_for(200e3, 0.01), throat_for(2e6, 0.01)
    (0.003, 0.007)
    """
    offered = [throat for throat in THROATS if throat <= _OF_WALL * wall + 1e-12] or [THROATS[0]]
    return next((one for one in offered if force <= STRENGTH * one), offered[-1])
