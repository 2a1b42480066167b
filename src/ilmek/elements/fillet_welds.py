"""Fillet welds by the simplified method: the force on each length of a weld against its shear strength.

    F / l <= f a,   f = f_u / (sqrt 3 beta gamma)                                [EN 1993-1-8, 4.5.3.3, eq. 4.3 and 4.4]

a throat, f_u tensile strength of the weaker part joined, beta 0.8 of S235 [table 4.1], gamma 1.25 [2.2]. Throats have
two bounds, by the walls t [mm] that are joined:

    sqrt(max t) - 0.5 <= a <= 0.7 min t                                               [DIN EN 1993-1-8/NA, NCI to 4.5.2]

The upper one is as strong as the wall, and a thinner wall does not burn through. Below the lower one the thick part
cools the weld too fast: where a thin wall does not allow it, the thick part is preheated [same NCI; EN 1011-2]. From
4 mm of wall the throat is 3 mm at least [4.5.2]; thinner walls are those of EN 1993-1-3, which has no such bound.
Groups of welds share a force evenly and a moment linearly: n = F / L + M r / J.   [theory of elasticity of weld groups]
"""

import math
from dataclasses import dataclass

from ilmek.elements.columns import STEEL
from ilmek.units import mm

CORRELATION, PARTIAL = 0.8, 1.25

STRENGTH = STEEL.tensile / (math.sqrt(3) * CORRELATION * PARTIAL)
"""Shear strength of a fillet weld of S235 [Pa]."""

THROATS = tuple(size * mm for size in (1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 10, 12))
"""Throats of welds [m]."""

_OF_WALL, _LEAST, _THIN, _LEAST_THIN = 0.7, 3 * mm, 4 * mm, 2 * mm
"""Largest throat over the wall; least throat, the wall from which it holds, and that of thinner walls [m]: the last one
assumed by this project.
"""

_COMBINED = 25 * mm
"""Thickness by which a joint takes heat away, of one piece once and of the other twice, from which the bound by the
thicker wall is kept [m]: after EN 1011-2, annex C; assumed by this project.
"""

WELDABLE, _WARM = 0.45, 100.0
"""Carbon equivalent up to which a steel is welded without preheating, and temperature that takes the chill off a thick
part [degrees Celsius]: EN 1011-2; assumed by this project.
"""

_ROUNDING, _FINE = 1e-7, 0.1 * mm
"""What counts as rounding, and step of throats that are brazed [m]."""


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


def largest_throat(wall: float) -> float:
    """The largest throat on a wall [m].

    >>> [round(largest_throat(wall) / mm, 6) for wall in (0.003, 0.004, 0.01)]
    [2.1, 3.0, 7.0]
    """
    return max(_OF_WALL * wall, _LEAST if wall > _THIN - _ROUNDING else 0.0)


def least_throat(wall: float, thickest: float) -> float:
    """The least throat between two walls [m], the thinner one and the thicker one, without preheating.

    >>> round(least_throat(0.01, 0.02) / mm, 3), least_throat(0.005, 0.006), least_throat(0.003, 0.003)
    (3.972, 0.003, 0.002)
    """
    thin = min(_LEAST_THIN, _OF_WALL * wall)
    return max(math.sqrt(thickest / mm) * mm - 0.5 * mm, _LEAST if wall > _THIN - _ROUNDING else thin)


def preheating(throat: float, wall: float, thickest: float, carbon: float = 0.0) -> float:
    """Temperature to which two walls are preheated [degrees Celsius]; 0: none. What is thinner than a fillet is brazed.

        T = 350 sqrt(C (1 + 0.005 t) - 0.25), upwards to 25, where C > 0.45                    [Seferian]

    carbon  greater equivalent of both, C      thickest  t [mm] in the formula

    >>> preheating(0.003, 0.004, 0.02), preheating(0.003, 0.004, 0.008), preheating(0.003, 0.004, 0.008, 0.63)
    (100.0, 0.0, 225.0)
    """
    if throat < THROATS[0] - _ROUNDING:
        return 0.0
    if carbon > WELDABLE:
        hot = 350 * math.sqrt(carbon * (1 + 0.005 * thickest / mm) - 0.25)
        return math.ceil(hot / 25) * 25.0
    cold = wall + 2 * thickest > _COMBINED and throat < least_throat(wall, thickest) - _ROUNDING
    return _WARM if cold else 0.0


def throat_for(force: float, wall: float, thickest: float = 0.0) -> float:
    """The least throat [m] for a force on a length [N/m] between two walls [m]; the largest that the thinner one allows
    where none bears it.

    >>> throat_for(200e3, 0.01), throat_for(2e6, 0.01), throat_for(0.0, 0.01, 0.02)
    (0.003, 0.007, 0.004)
    """
    largest = largest_throat(wall) + _ROUNDING
    offered = [throat for throat in THROATS if throat <= largest] or [largest // _FINE * _FINE or largest]
    least = least_throat(wall, max(wall, thickest)) - _ROUNDING
    return next((throat for throat in offered if throat >= least and force <= STRENGTH * throat), offered[-1])
