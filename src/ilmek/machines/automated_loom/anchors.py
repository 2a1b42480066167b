"""Plates on the floor with their anchors: what stands beside the loom is held where it stands."""

from collections.abc import Iterable, Iterator

from ilmek.elements.columns import STEEL
from ilmek.machines.automated_loom.frame import part_id
from ilmek.part.part import LASER_CUT, Bought, Part
from ilmek.part.part_lists import FASTENER
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, rectangle, stepped
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle
from ilmek.units import mm

ANCHOR, HOLE = 8 * mm, 9 * mm
"""Thread of an anchor, and hole for it [m]: EN 1992-4; ISO 273, medium."""

_WASHER, _NUT, _OUT = (16 * mm, 1.6 * mm), (13 * mm, 6.8 * mm), 3 * mm
"""Diameters and heights of washer and nut, and what of the thread stands out of the nut [m]: ISO 7089, ISO 4032."""


def anchored(
    name: str, title: str, size: tuple[float, float, float], holes: Iterable[complex], positions: Iterable[Placement]
) -> Iterator[Occurrence]:
    """A plate at some positions, with an anchor in each of its holes; its z upwards from the floor.

    size  sides and thickness [m]      holes  from its middle [m]
    """
    (wide, deep, thick), middles, places = size, tuple(holes), tuple(positions)
    section = Profile(rectangle(wide, deep), tuple(circle(hole, HOLE / 2) for hole in middles))
    plate = Part(part_id(name), title, LASER_CUT, Prism(section, thick), STEEL)
    yield Occurrence(plate, places)
    shape = stepped((ANCHOR, thick), _WASHER, _NUT, (ANCHOR, _OUT))
    row = Bought(f"wedge anchor M{ANCHOR / mm:.0f} x 75 EN 1992-4", 0.04)
    anchor = Part(part_id(f"{name}-anchor"), f"anchor of the {title}", FASTENER, shape, purchase=row, envelope=True)
    yield Occurrence(
        anchor, tuple(place.after(placement(hole.real, hole.imag)) for place in places for hole in middles)
    )
