"""Levelling feet: rows of a table, and the foot for a load.

A foot bears what its pad may press on the floor and what its screw, of the property class 4.6, bears at half its yield:

    F = min(pi D² / 4 p, A_s R / 2)          p 5 MPa on concrete, assumed by this project; A_s [ISO 898-1, table 4]

On an uneven floor two feet that lie diagonally bear the whole loom. A foot's screw is in a plate that is welded under
the frame, with the thread; a nut on it locks it from below.
"""

import math
from dataclasses import dataclass

from ilmek.elements.columns import STEEL
from ilmek.part.part import LASER_CUT, Bought, Part, bought_part
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, rectangle, stepped
from ilmek.plane.contours import circle
from ilmek.units import MPa, mm

FLOOR, YIELD = 5 * MPa, 240 * MPa
"""Pressure on the floor, and yield of a screw of the class 4.6 [Pa]."""

SCREW, PAD = 40 * mm, 15 * mm
"""Free length of a foot's screw, and height of its pad [m]; makers differ by some millimetres."""

PLATE, LEDGE = 15 * mm, 10 * mm
"""Thickness of the plate with the thread, and by how much it is narrower than what it is under, for its weld [m]."""

NUT, ACROSS = 0.5, 1.5
"""Height and width of the nut over the diameter of the thread [ISO 4035]."""

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
        """The foot with its nut, upwards along z from the floor, of the mass of its shape in steel."""
        nut = NUT * self.screw
        free = SCREW - PLATE - nut
        shape = stepped((self.pad, PAD), (self.screw, free), (ACROSS * self.screw, nut), (self.screw, PLATE))
        size = f"{self.name}, pad {self.pad / mm:g} mm, with nut ISO 4035"
        return bought_part(name, "levelling foot", "levelling foot", shape, Bought(size, shape.volume * STEEL.density))

    def plate(self, name: str, side: float) -> Part:
        """The plate with its thread under a section of a side [m], upwards along z from 0."""
        wide = max(side - 2 * LEDGE, 2 * self.screw)
        section = Profile(rectangle(wide, wide), (circle(0j, self.screw / 2),))
        return Part(name, "plate of a levelling foot", LASER_CUT, Prism(section, PLATE), STEEL, machined=True)


FEET = tuple(
    Foot(f"M{screw}", screw * mm, pad * mm, area * mm**2)
    for screw, pad, area in ((20, 80, 245), (24, 100, 353), (30, 120, 561), (36, 150, 817), (42, 180, 1120))
)
"""Feet in ascending order of their loads."""


def foot_for(load: float) -> Foot:
    """The smallest foot for a load [N], else the largest."""
    return next((foot for foot in FEET if foot.rating >= load), FEET[-1])
