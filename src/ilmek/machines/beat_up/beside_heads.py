"""The arm of a crank-rocker that clears heads and reed: at rest its rocker is over heads that knot, its plate in front.

Side view, the fell at 0, the pivot of the rocker at P in front of it. At rest the rocker has swung up by d; its half
width is e. The plate of crank and rocker has its lower corner at P - e - i e, and its edge there runs as the heads
retreat, down and to the front at the angle r. A corner x + i y of a head or of its rail keeps a distance c from both

    (P - x) sin d - y cos d >= e + c,   (P - e - x) sin r - (e + y) cos r >= c                      [plane geometry]

The circle of the crank round D stands c before the front f of the cams' reed, D - crank - e - f >= c at its height.

All lengths of the linkage grow with its ground, so that the least P gives the least ground.
"""

import cmath
import math
from collections.abc import Iterator

from ilmek.machines.arrangement.side_view import RETREAT, SideView
from ilmek.machines.beat_up.carriage import PLATE, shaft
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.links import PART_IDS
from ilmek.report import Check, at_least

_SLOPE = -cmath.phase(RETREAT)


def ground_beside_heads(linkage: BeatUp, side: SideView | None, clearance: float) -> float:
    """The ground with which a linkage keeps a clearance [m] from the heads; its own where it does, or without a side
    view.
    """
    ground = linkage.params.ground
    if side is None:
        return ground
    longer = max(
        *((clearance - gap) / math.sin(linkage.swing) for gap in _over(linkage, side)),
        *((clearance - gap) / math.sin(_SLOPE) for gap in _before(linkage, side)),
    )
    arm, reach = linkage.lengths["beater"], shaft(linkage).real - linkage.lengths["crank"]
    grown = max(longer / arm, *((clearance - gap) / reach for gap in _before_reeds(linkage, side)), 0.0)
    return ground * (1 + grown)


def checks_beside_heads(linkage: BeatUp, side: SideView | None, clearance: float) -> tuple[Check, ...]:
    """Whether rocker and plate keep the clearance [m]; none without a side view."""
    if side is None:
        return ()
    cure = "leave the ground of the crank-rocker open, or set fewer heads"
    source = "parameter clearance; the rail no larger than its room in the arrangement"
    before = "clearance: crank and reed", min(_before_reeds(linkage, side)), clearance, "mm", "parameter clearance"
    reed = at_least(*before, cure="leave the ground of the crank-rocker open", parts=(PART_IDS["crank"],))
    return (
        *((reed,) if any(cam.reeded for cam in side.cams) else ()),
        at_least(
            "clearance: rocker at rest and heads that knot",
            min(_over(linkage, side)),
            clearance,
            "mm",
            source,
            cure=cure,
            parts=(PART_IDS["rocker"],),
        ),
        at_least(
            "clearance: plate of the crank-rocker and heads that retreat",
            min(_before(linkage, side)),
            clearance,
            "mm",
            source,
            cure=cure,
            parts=(PLATE,),
        ),
    )


def _over(linkage: BeatUp, side: SideView) -> Iterator[float]:
    """Gaps between the rocker at rest and the corners of heads and rail [m]."""
    swing, arm, half = linkage.swing, linkage.lengths["beater"], linkage.params.width / 2
    return ((arm - corner.real) * math.sin(swing) - corner.imag * math.cos(swing) - half for corner in _corners(side))


def _before(linkage: BeatUp, side: SideView) -> Iterator[float]:
    """Gaps between the plate and the ways of these corners in the retreat [m]."""
    arm, half = linkage.lengths["beater"], linkage.params.width / 2
    return (
        (arm - half - corner.real) * math.sin(_SLOPE) - (half + corner.imag) * math.cos(_SLOPE)
        for corner in _corners(side)
    )


def _before_reeds(linkage: BeatUp, side: SideView) -> Iterator[float]:
    """Gaps between the circle of the crank's end and what stands before the cam shafts' axes [m]."""
    behind = shaft(linkage).real - linkage.lengths["crank"] - linkage.params.width / 2
    return (behind - cam.at.real - cam.front for cam in side.cams)


def _corners(side: SideView) -> Iterator[complex]:
    """Upper corners in front of a head that knots, and of its rail, in the side view [m]."""
    head = side.head
    yield head.body + head.size
    yield head.magazine + head.magazine_size
    yield side.rail.corner + side.rail.size / 2 + side.rail_side * (1 + 0.5j)
