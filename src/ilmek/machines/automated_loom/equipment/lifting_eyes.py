"""The eye bolts by which a loom is lifted, in plates on the tops of its columns and on its front feet.

A sling stands where nothing of the loom is above its eye. Each eye bears half of the loom: of four slings two may hang
slack [`elements.eye_bolts`]. The plates are welded round to what they stand on, as thick as the thread is long.
"""

from functools import lru_cache

import numpy as np

from ilmek.elements.columns import STEEL
from ilmek.elements.eye_bolts import EyeBolt, eye_bolt_for
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.creel import Creel, creel_of
from ilmek.machines.automated_loom.equipment.guards import POST
from ilmek.machines.automated_loom.equipment.surroundings import GAP, Surroundings, surroundings
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.part.extents import Extent
from ilmek.part.part import Bought, Part
from ilmek.part.part_lists import FASTENER
from ilmek.part.placement import UPRIGHT, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Corner, Placed, Prism, Sum, bar, box, rectangle
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle
from ilmek.units import mm

LIFTING_EYES, EYE_BOLT = part_id("lifting-eyes"), part_id("eye-bolt")
"""Ids of the body and of the bolts."""

_STEP, _HIGH = 10 * mm, 10.0
"""Of points that are tried on a foot, and height of a sling over it [m]."""


@lru_cache(maxsize=4)
def eye_bolt_of(loom: LoomDesign) -> EyeBolt:
    """The eye bolts of a loom."""
    return eye_bolt_for(parts_of_loom(loom).mass)


def seats_of_eyes(loom: LoomDesign) -> tuple[tuple[Extent, Corner], ...]:
    """What carries each eye, and the middle of its plate's lower side [m]: the rear pair first, the left one first.

    Of several columns and feet beside each other the outermost carry them.
    """
    near, row = surroundings(loom), eye_bolt_of(loom)
    creel = creel_of(loom) if loom.heads else None
    duct = (0.0, 0.0) if creel is None else (creel.mouth[2] - _aside(creel), creel.mouth[2] + _aside(creel))
    columns, feet = (near.of(part_id(name)) for name in ("column", "front-foot"))
    return (
        *((column, _top(column)) for column in (columns[0], columns[-1])),
        *((foot, _free(near, foot, row, duct)) for foot in (feet[0], feet[-1])),
    )


def eye_height(row: EyeBolt) -> float:
    """Of the middle of an eye over the lower side of its plate [m]."""
    return row.length + row.height - row.ring / 2


def lifting_eyes(loom: LoomDesign) -> Tree:
    """The plates, and the bolts in them."""
    row, seats = eye_bolt_of(loom), seats_of_eyes(loom)
    bolt = Part(
        EYE_BOLT,
        "eye bolt",
        FASTENER,
        shape=Sum(
            (
                Placed(bar(row.thread, row.length), (placement(z=-row.length),)),
                Placed(box(row.ring, row.ring - row.collar, row.height)),
            )
        ),
        purchase=Bought(row.name, row.mass),
        envelope=True,
    )
    plates = (
        _plate(row, name, title, pair)
        for name, title, pair in (
            ("column-eye-plate", "plate of an eye bolt on a column", seats[:2]),
            ("foot-eye-plate", "plate of an eye bolt on a foot", seats[2:]),
        )
    )
    eyes = tuple(placement(x, y + row.length, z).after(UPRIGHT) for _, (x, y, z) in seats)
    return Tree((RigidBody(LIFTING_EYES, (*plates, Occurrence(bolt, eyes))),))


def _plate(row: EyeBolt, name: str, title: str, seats: tuple[tuple[Extent, Corner], ...]) -> Occurrence:
    """The plate of a pair, as wide as what carries it."""
    side = float(seats[0][0].high[0] - seats[0][0].low[0])
    section = Profile(rectangle(side, side), (circle(0j, row.thread / 2),))
    plate = Part(part_id(name), title, "laser-cut part", Prism(section, row.length), STEEL, machined=True)
    return Occurrence(plate, tuple(placement(x, y, z).after(UPRIGHT) for _, (x, y, z) in seats))


def _top(extent: Extent) -> Corner:
    return np.array([(extent.low[0] + extent.high[0]) / 2, extent.high[1], (extent.low[2] + extent.high[2]) / 2])


def _free(near: Surroundings, foot: Extent, row: EyeBolt, duct: tuple[float, float]) -> Corner:
    """The foremost point on a foot from which a sling goes up past all parts, and beside the yarns' duct on it [m]; the
    plate is on the foot's end where there is none.
    """
    point, wide = _top(foot), max(float(foot.high[0] - foot.low[0]), row.ring)
    half = np.array([wide / 2 + GAP, 0.0, wide / 2 + GAP])
    for z in np.arange(foot.high[2] - wide / 2, foot.low[2], -_STEP).tolist():
        point[2] = z
        beside = duct[1] <= z - half[2] or z + half[2] <= duct[0]
        if beside and near.free(point - half, point + half + (0.0, _HIGH, 0.0), but=foot.part):
            return point
    x, y, _ = _top(foot).tolist()
    return np.array([x, y - row.length, float(foot.high[2]) + wide / 2])


def _aside(creel: Creel) -> float:
    """Half of what the yarns' duct and its stand take of a foot [m]."""
    return max(creel.duct, POST) / 2
