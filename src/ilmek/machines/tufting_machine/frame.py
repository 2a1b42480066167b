"""The frame of a tufting machine: end plates, beams, bearing plates of the loopers, guides, bed plate and presser.

The end plates stand on the floor, the beams between them. Bearing plates of the needle drives stand before the head's
beam, those of the loopers on the lower one; each push rod has its guide on a bearing plate. The bed plate has a slot
for the needles of each drive, with a bridge between two needles; posts on the lower beam carry it.
"""

from collections.abc import Iterator
from functools import lru_cache
from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.materials import MATERIALS
from ilmek.elements.reducers import DIRECT
from ilmek.machines.tufting.links import WALL
from ilmek.machines.tufting.strength import needle_sizes
from ilmek.machines.tufting.tree import bearing_plate
from ilmek.machines.tufting_machine.layout import BED, TuftingLayout
from ilmek.machines.tufting_machine.needle_parts import DOWN, needle_heights
from ilmek.machines.tufting_machine.params import SCROLLS, TuftingMachineParams
from ilmek.machines.tufting_machine.rocker_parts import CLEAR, NAME, looper_bearing
from ilmek.machines.tufting_machine.scrolls import scroll_parts, scrolls
from ilmek.part import catalogue
from ilmek.part.catalogue import reducer_face
from ilmek.part.part import Part, Seat
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, box, rectangle
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle, polygon, rounded_hull
from ilmek.report import Contour
from ilmek.units import mm

STEEL = MATERIALS["structural steel"]

BEAM, BEAM_WALL, END_PLATE = 100 * mm, 6 * mm, 30 * mm
"""Side and wall of the beams, thickness of the end plates; assumed by this project."""

SLOT, BRIDGE = 8 * mm, 1 * mm
"""Half of the width of the bed plate's slots, and width of a bridge between two needles; assumed by this project."""

SHEET, PRESSER, FLOOR, ABOVE = 6 * mm, 50 * mm, 0.55, 0.25
"""Greatest thickness of the bed plate, width of a presser, floor below the looper shaft, end plates above the driven
shaft [m]; assumed by this project."""

GUIDE, GUIDE_BELOW = 60 * mm, 90 * mm
"""Length of a push rod's guide, and its lower end under the main shaft; assumed by this project."""

BEAMS = f"{NAME}/beam"
"""Id of the beams, to which the bearing plates are welded."""

JOURNAL, POST = 30 * mm, 8 * mm
"""Diameter of the journals of rollers, thickness of a post; assumed by this project."""


def feet(laid: TuftingLayout) -> tuple[complex, ...]:
    """Points that the bearing plates of the needle drives reach: at the head's beam, and at the guide [m]."""
    radius = _wall(laid)
    guide = complex(laid.line - radius / 2, GUIDE / 2 - GUIDE_BELOW)
    return (complex(laid.behind + radius), complex(laid.behind + radius, -0.6 * BEAM), guide)


@lru_cache(maxsize=8)
def _wall(laid: TuftingLayout) -> float:
    """Radius of the corners of the bearing plates of the needle drives [m]: about the greater of their seats."""
    seats = bearing_plate(laid.machine.needle).seats.values()
    return max(seat.size for seat in seats) / 2 * (1 + 2 * WALL)


def frame_parts(laid: TuftingLayout) -> Iterator[Occurrence]:
    """The parts of the frame beside the bearing plates of the needle drives."""
    first, last = laid.ends
    hollow = Profile(rectangle(BEAM, BEAM), (rectangle(BEAM - 2 * BEAM_WALL, BEAM - 2 * BEAM_WALL),))
    beam = Part(BEAMS, "beam", "steel tube", Prism(hollow, last - first), STEEL)
    below = _post_at(laid)
    corners = (laid.behind - BEAM / 2, -BEAM / 2), (below, laid.low - BEAM / 2)
    yield Occurrence(beam, tuple(placement(*corner, first) for corner in corners))
    yield Occurrence(_end_plate(laid), (placement(z=first - END_PLATE), placement(z=last)))
    yield from _looper_brackets(laid)
    yield _guides(laid)
    yield from _bed(laid)
    if laid.machine.params.pattern.attachment == SCROLLS:
        yield from scroll_parts(laid, scroll_height(laid))


def _post_at(laid: TuftingLayout) -> float:
    """Middle of the lower beam and of the posts along x [m]."""
    return (laid.crank_shaft.real + laid.shaft.real) / 2


def roller_axes(laid: TuftingLayout) -> dict[str, complex]:
    """Axes of the rollers [m]: the spiked ones' tops at the backing's under side, the yarn's above the needles."""
    feed = laid.machine.params.feed
    low = laid.under - feed.spiked_roller / 2
    spiked = {"rear": complex(laid.rear, low), "front": complex(laid.front, low)}
    if laid.machine.params.pattern.attachment == SCROLLS:
        return spiked
    yarn = complex(laid.line + BED, laid.driven_shaft.imag + ABOVE / 2)
    row, by = laid.machine.feed.motors["yarn"] or (None, DIRECT)
    face = reducer_face(by, row) if row else catalogue.SPECIAL_FACE
    pitch = max(feed.yarn_roller, face) + CLEAR
    return spiked | {
        f"yarn {number + 1}": yarn + 1j * number * pitch for number in range(laid.machine.feed.yarn_shafts)
    }


def scroll_height(laid: TuftingLayout) -> float:
    """Lower end of the plate of the scrolls [m]."""
    return laid.driven_shaft.imag + ABOVE / 2


def _top(laid: TuftingLayout) -> float:
    """Upper end of the end plates [m]: over the yarn feed."""
    least = laid.driven_shaft.imag + ABOVE
    if laid.machine.params.pattern.attachment == SCROLLS:
        return max(least, scrolls(laid, scroll_height(laid)).top)
    return max(least, *(axis.imag + ABOVE / 2 for axis in roller_axes(laid).values()))


def _end_plate(laid: TuftingLayout) -> Part:
    """An end plate: free holes for the main and the looper crank shaft, bushes for the rollers' journals."""
    left, right = min(laid.behind - BEAM, laid.rear) - BEAM / 2, laid.front + BEAM / 2
    outline = np.array([left, right, right, left]) + 1j * np.array(
        [laid.shaft.imag - FLOOR, laid.shaft.imag - FLOOR, *(2 * [_top(laid)])]
    )
    free = ((0j, needle_sizes(laid.machine.needle).main), (laid.crank_shaft, laid.machine.params.looper.shaft))
    holes = (
        *(circle(at, diameter / 2 + CLEAR / 2) for at, diameter in free),
        *(circle(at, JOURNAL / 2) for at in roller_axes(laid).values()),
    )
    shape = Prism(Profile(polygon(outline), holes), END_PLATE)
    return Part(f"{NAME}/end-plate", "end plate", "laser-cut part", shape, STEEL, machined=True)


def _looper_brackets(laid: TuftingLayout) -> Iterator[Occurrence]:
    """Plates beside each looper linkage with the bearings of both shafts, flat on the lower beam."""
    row = looper_bearing(laid.machine.params.looper)
    radius, hole = row.outer / 2 * (1 + 2 * WALL), row.outer / 2
    shafts = laid.crank_shaft, laid.shaft, *laid.knives
    ends = [complex(at.real, laid.low + radius) for at in shafts[:2]]
    holes = tuple(circle(at, hole) for at in shafts)
    shape = Prism(Profile(rounded_hull(np.array([*shafts, *ends]), radius), holes), row.width)
    seats = {name: Seat(placement(at.real, at.imag), row.outer) for name, at in zip("QPK", shafts, strict=False)}
    name, title = f"{NAME}/looper-plate", "bearing plate of the loopers"
    plate = Part(name, title, "laser-cut part", shape, STEEL, seats=seats, machined=True, joins=(BEAMS,))
    half, drives = laid.machine.looper_forces.parts.rocker.half, range(laid.machine.params.drives)
    heights = [laid.middle(drive) + side for drive in drives for side in (-half - row.width, half)]
    bearing = catalogue.bearing(f"{NAME}/looper-bearing", "bearing of the loopers", row)
    yield Occurrence(plate, tuple(placement(z=height) for height in heights))
    yield Occurrence(bearing, tuple(placement(at.real, at.imag, z) for z in heights for at in shafts))


def _guides(laid: TuftingLayout) -> Occurrence:
    """The guides of the push rods, each a bored block on the face of its bearing plate."""
    rod, level = laid.machine.params.needle_bar.rod, laid.needle_level
    half, face = rod / 2 + CLEAR, laid.planes[1] - level
    corners = np.array([-half - 1j * half, half - 1j * half, half + 1j * face, -half + 1j * face])
    shape = Prism(Profile(polygon(corners), (circle(0j, rod / 2),)), GUIDE)
    part = Part(f"{NAME}/guide", "guide of a push rod", "machined link", shape, MATERIALS["tin bronze"])
    top = GUIDE - GUIDE_BELOW
    drives = range(laid.machine.params.drives)
    return Occurrence(
        part, tuple(placement(laid.line, top, level + drive * laid.pitch).after(DOWN) for drive in drives)
    )


def _bed(laid: TuftingLayout) -> Iterator[Occurrence]:
    """Bed plate with its slots and posts under the backing, a presser on both sides of the needles over it."""
    params, (first, last) = laid.machine.params, laid.ends
    thick = presser_thickness(params)
    outline = np.array([-BED + 1j * first, BED + 1j * first, BED + 1j * last, -BED + 1j * last])
    shape = Prism(Profile(polygon(outline), tuple(_slots(laid))), thick)
    joins = f"{NAME}/end-plate", f"{NAME}/post"
    bed = Part(f"{NAME}/bed-plate", "bed plate", "laser-cut part", shape, STEEL, joins=joins)
    yield Occurrence(bed, (placement(laid.line, laid.under).after(DOWN),))
    post = box(30 * mm, laid.under - thick - laid.low, POST)
    middle, low = _post_at(laid), (laid.under - thick + laid.low) / 2
    if params.drives > 1:
        part = Part(f"{NAME}/post", "post of the bed plate", "laser-cut part", post, STEEL)
        places = (placement(middle, low, laid.left + k * laid.pitch - post.length / 2) for k in range(1, params.drives))
        yield Occurrence(part, tuple(places))
    level = laid.under + params.backing_thickness
    strip = box(PRESSER, thick, last - first)
    presser = Part(f"{NAME}/presser", "presser", "steel bar", strip, STEEL, joins=joins)
    beside = SLOT + PRESSER / 2
    yield Occurrence(presser, tuple(placement(laid.line + side * beside, level + thick / 2, first) for side in (-1, 1)))


def presser_thickness(params: TuftingMachineParams) -> float:
    """Thickness of bed plate and presser [m]: the bed plate is over the hooks."""
    return min(SHEET, params.pile_height / 2)


def _slots(laid: TuftingLayout) -> Iterator[Contour]:
    """Slots of the drives along z, divided in the middle between two needles."""
    params, needles = laid.machine.params, laid.machine.carpet.needles
    start = laid.left + float(needle_heights(params, needles)[0].origin[2]) - params.gauge / 2
    inner = (laid.left + drive * laid.pitch - start for drive in range(1, params.drives))
    cuts = (round(place / params.gauge) * params.gauge for place in inner)
    ends = -CLEAR, *cuts, needles * params.gauge + CLEAR
    for low, high in pairwise(ends):
        yield polygon(_slot(start + low + BRIDGE / 2, start + high - BRIDGE / 2))


def _slot(low: float, high: float) -> ComplexArray:
    return np.array([-SLOT + 1j * low, SLOT + 1j * low, SLOT + 1j * high, -SLOT + 1j * high])
