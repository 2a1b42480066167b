"""Plates on the floor with their anchors: what stands beside the loom is held where it stands."""

from collections.abc import Iterable, Iterator

from ilmek.elements.anchor_bolts import ANCHOR
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

_WASHER, _NUT, _OUT = (16 * mm, 1.6 * mm), (13 * mm, 6.8 * mm), 3 * mm
"""Diameters and heights of washer and nut, and what of the thread stands out of the nut [m]: ISO 7089, ISO 4032."""


def anchored(
    name: str, title: str, size: tuple[float, float, float], holes: Iterable[complex], positions: Iterable[Placement]
) -> Iterator[Occurrence]:
    """A plate at some positions, with an anchor in each of its holes; its z upwards from the floor.

    size  sides and thickness [m]      holes  from its middle [m]
    """
    (wide, deep, thick), middles, places = size, tuple(holes), tuple(positions)
    section = Profile(rectangle(wide, deep), tuple(circle(hole, ANCHOR.hole / 2) for hole in middles))
    plate = Part(part_id(name), title, LASER_CUT, Prism(section, thick), STEEL)
    yield Occurrence(plate, places)
    feet = tuple(place.after(placement(hole.real, hole.imag)) for place in places for hole in middles)
    yield anchors(name, title, thick, feet)


def anchors(name: str, title: str, thick: float, positions: tuple[Placement, ...]) -> Occurrence:
    """Anchors in holes of what is so thick on the floor [m]; their z upwards from it."""
    shape = stepped((ANCHOR.thread, thick), _WASHER, _NUT, (ANCHOR.thread, _OUT))
    row = Bought(ANCHOR.designation, ANCHOR.mass)
    anchor = Part(part_id(f"{name}-anchor"), f"anchor of the {title}", FASTENER, shape, purchase=row, envelope=True)
    return Occurrence(anchor, positions)
