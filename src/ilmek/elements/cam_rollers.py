"""Cam followers: rollers with a stud, from a table; their life on a cam.

    L = (C / P)^(10/3) 10^6 turns of the roller,   P = (mean of N^(10/3) over those turns)^(3/10)     [ISO 281]

N force on the roller, C dynamic load rating. While the cam rotates by dtheta the roller rotates by (flow / Rr - 1)
dtheta; flow is the path of its centre along the pitch curve by the cam angle.
"""

import math
from dataclasses import dataclass

from ilmek.elements.bearings import life
from ilmek.elements.catalogue import pick
from ilmek.units import g, mm

POWER = 10 / 3
"""Exponent of the load in the life of a roller bearing."""


@dataclass(frozen=True, slots=True)
class Roller:
    """A needle roller with a thick outer ring on a stud: sizes [m], load ratings and largest force [N], mass [kg]."""

    name: str
    diameter: float
    width: float
    stud: float
    dynamic: float
    static: float
    force_limit: float
    mass: float

    @property
    def radius(self) -> float:
        """Radius of its outer ring [m]."""
        return self.diameter / 2


_ROWS = (
    ("CF 5", 13, 9, 5, 2520, 2140, 1260, 10.3),
    ("CF 6", 16, 11, 6, 3660, 3650, 1950, 18.5),
    ("CF 8", 19, 11, 8, 4250, 4740, 4620, 28.5),
    ("CF 10", 22, 12, 10, 5430, 6890, 6890, 45.0),
    ("CF 10-1", 26, 12, 10, 5430, 6890, 6890, 60.0),
    ("CF 12", 30, 14, 12, 7910, 9790, 9790, 95.0),
    ("CF 12-1", 32, 14, 12, 7910, 9790, 9790, 105.0),
    ("CF 16", 35, 18, 16, 12000, 18300, 18300, 170.0),
    ("CF 18", 40, 20, 18, 14800, 25200, 25200, 250.0),
    ("CF 20-1", 47, 24, 20, 20700, 34600, 34600, 385.0),
    ("CF 20", 52, 24, 20, 20700, 34600, 34600, 460.0),
)

ROLLERS: dict[str, Roller] = {
    name: Roller(name, diameter * mm, width * mm, stud * mm, float(dynamic), float(static), float(most), mass * g)
    for name, diameter, width, stud, dynamic, static, most, mass in _ROWS
}
"""Metric cam followers with a cage, by diameter [maker's catalogue: IKO, C-Lube cam followers CF ... WB]."""


def find_roller(name: str) -> Roller:
    """The roller of a designation. Raises ParameterError, naming the nearest, where it is not in the table."""
    return pick(ROLLERS, name, "roller")


@dataclass(frozen=True, slots=True)
class RollerDuty:
    """Equivalent and largest force on a roller [N], its turns per turn of the cam, the cam's speed [rad/s]."""

    equivalent: float
    largest: float
    turns: float
    speed: float

    def time(self, roller: Roller) -> float:
        """Life of a roller [s]: inf without rotation or force."""
        pace = self.turns * self.speed / (2 * math.pi)
        return life(roller.dynamic, self.equivalent, "roller") / pace if pace > 0 else math.inf
