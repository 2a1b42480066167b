"""The arm of a crank-rocker that clears the heads: at rest its rocker is over heads that knot, its plate in front.

Side view, the fell at 0, the pivot of the rocker at P in front of it. At rest the rocker has swung up by d; its half
width is e. The plate of crank and rocker has its lower corner at P - e - i e, and its edge there runs as the heads
retreat, down and to the front at the angle r. A corner x + i y of a head or of its rail keeps a distance c from both

    (P - x) sin d - y cos d >= e + c,   (P - e - x) sin r - (e + y) cos r >= c                      [plane geometry]

All lengths of the linkage grow with its ground, so that the least P gives the least ground.
"""

import cmath
import math
from collections.abc import Iterator

from ilmek.machines.arrangement.side_view import RETREAT, SideView
from ilmek.machines.beat_up.design import BeatUp


def ground_beside_heads(linkage: BeatUp, side: SideView | None, clearance: float) -> float:
    """The ground with which a linkage keeps a clearance [m] from the heads; its own where it does, or without a side
    view.
    """
    ground = linkage.params.ground
    if side is None:
        return ground
    swing, slope, half = linkage.swing, -cmath.phase(RETREAT), linkage.params.width / 2
    arm = max(
        max(
            corner.real + (corner.imag * math.cos(swing) + half + clearance) / math.sin(swing),
            corner.real + half + (clearance + (half + corner.imag) * math.cos(slope)) / math.sin(slope),
        )
        for corner in _corners(side)
    )
    return max(ground, ground * arm / linkage.lengths["beater"])


def _corners(side: SideView) -> Iterator[complex]:
    """Upper corners in front of a head that knots, and of its rail, in the side view [m]."""
    head = side.head
    yield head.body + head.size
    yield head.magazine + head.magazine_size
    yield side.rail.corner + side.rail.size / 2 + side.rail_side * (1 + 0.5j)
