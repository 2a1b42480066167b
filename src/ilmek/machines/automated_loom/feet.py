"""Levelling feet: rows of a table, and the foot for a load.

A foot bears what its pad may press on the floor and what its screw, of the property class 4.6, bears at half its yield:

    F = min(pi D² / 4 p, A_s R / 2)          p 5 MPa on concrete, assumed by this project; A_s [ISO 898-1, table 4]

On an uneven floor two feet that lie diagonally bear the whole loom.
"""

import math
from dataclasses import dataclass

from ilmek.elements.columns import STEEL
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.shapes import stepped
from ilmek.units import MPa, mm

FLOOR, YIELD = 5 * MPa, 240 * MPa
"""Pressure on the floor, and yield of a screw of the class 4.6 [Pa]."""

SCREW, PAD = 40 * mm, 15 * mm
"""Free length of a foot's screw, and height of its pad [m]; makers differ by some millimetres."""

FOOT = SCREW + PAD
"""Height of the frame over the floor, on its levelling feet [m]."""


@dataclass(frozen=True, slots=True)
class Foot:
    """A levelling foot: its thread, diameters of thread and pad [m], stress area of the thread [m²]."""

    name: str
    screw: float
    pad: float
    area: float

    @property
    def rating(self) -> float:
        """Load that it bears [N].

        >>> [round(foot.rating) for foot in FEET[:2]]
        [25133, 39270]
        """
        return min(math.pi / 4 * self.pad**2 * FLOOR, self.area * YIELD / 2)

    def part(self, name: str) -> Part:
        """The foot, upwards along z from the floor, of the mass of its shape in steel."""
        shape = stepped((self.pad, PAD), (self.screw, SCREW))
        bought = Bought(f"{self.name}, pad {self.pad / mm:g} mm", shape.volume * STEEL.density)
        return bought_part(name, "levelling foot", "levelling foot", shape, bought)


FEET = tuple(
    Foot(f"M{screw}", screw * mm, pad * mm, area * mm**2)
    for screw, pad, area in ((20, 80, 245), (24, 100, 353), (30, 120, 561), (36, 150, 817), (42, 180, 1120))
)
"""Feet in ascending order of their loads."""


def foot_for(load: float) -> Foot:
    """The smallest foot for a load [N], else the largest."""
    return next((foot for foot in FEET if foot.rating >= load), FEET[-1])
