"""The section across the warps that the head works in: warps, gaps, hand-over, and the clearance of a needle.

A warp opener holds the knot's pair at 0 and e in two slots, as far apart as the pitch p or farther, and pushes the rest
away [thesis 2.2.3, Fig 2.14]. The gaps outside the pair are g = p + o wide between axes, their middles lie g/2 outside
the pair; the neighbours, NEIGHBOURS on each side, stand in the pitch.

A needle of diameter d through the middle of such a gap, tilted by phi, stays off both warps of diameter D by

    c = (g/2) cos phi - (D + d)/2

To hand over on the line between the pair, h behind the warps' axes, it tilts by phi with tan phi = (e + g)/2h. So the
clearance c cannot be greater than this, whatever the arm; and it requires the depth

    h = (e + g) / 2 tan phi,     cos phi = (D + d + 2c)/g,     possible where D + d + 2c < g

Beside the needle lies the end that it leads, pressed to the thickness w. Several ends in a gap lie above one another
along the warps, so one counts:

    d + w <= g cos phi - D      beside the pair          d + w <= e - D      between the pair

With the usual depth h = e + g, tan phi = 1/2: e and g are chosen as the least that give needle and yarn this room, with
the clearance c on both sides where that is more.
"""

import math

import numpy as np

from ilmek.arrays import Complex
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.records import computed, record, result
from ilmek.units import mm
from ilmek.weaving.knots.word import Knot, knot

NEIGHBOURS = 6
"""Warps on each side of the pair that must be passed clear."""

USUAL_DEPTH, GREATEST_DEPTH = 2.0, 4.0
"""Depth of the hand-over over the mean of e and g: as a rule, and at most, where the clearance requires more."""

USUAL_COSINE = USUAL_DEPTH / math.hypot(USUAL_DEPTH, 1.0)
"""Cosine of the needle's tilt at the usual depth."""

SPARE = 1 * mm
"""Room between wide links and warps, besides the clearance."""


@record
class WarpSection:
    """Lengths of the section [m]; x from the pair's left warp, y from the warps' axes, the pile upwards.

    pitch    p                   outer   g, width of the outer gaps between axes      front  height of the ends at rest
    warp     diameter D          needle  diameter d of both needles and of the        width  of the links
    required clearance                   centre gripper                               yarn   pressed, w
    """

    pitch: float
    pair: float = result("mm", "distance e of the pair of warps in the opener's slots", name="pair_opened")
    outer: float = result("mm", "distance g from a warp of the pair to its neighbour", name="gap_opened")
    warp: float
    needle: float
    depth: float = result("mm", "depth h of the hand-over behind the warps' axes", name="handover_depth")
    front: float
    width: float
    required: float
    yarn: float

    @computed("mm", "greatest clearance of any needle, and of the centre gripper, at this depth")
    def clearance_bound(self) -> float:
        outer = self.outer / 2 * math.cos(self.tilt)
        return min(outer, self.pair / 2) - (self.warp + self.needle) / 2

    @computed("mm", "room across the needle beside the pair, between the warps", name="gap_room")
    def beside(self) -> float:
        return self.outer * math.cos(self.tilt) - self.warp

    @computed("mm", "room between the pair of warps", name="pair_room")
    def between(self) -> float:
        return self.pair - self.warp

    @computed("mm", "from the tip to where the second link grows wide")
    def needle_length(self) -> float:
        # Off the warps, and beside the centre gripper at the hand-over.
        off_warps = self.reach + (self.width / 2 + self.warp / 2 + self.room) / math.cos(self.tilt)
        return max(off_warps, (self.width + self.room) / math.sin(self.tilt))

    @computed("deg", "tilt of the needle from upright, at the hand-over", name="needle_tilt")
    def tilt(self) -> float:
        return math.atan2((self.pair + self.outer) / 2, self.depth)

    @property
    def gap(self) -> complex:
        """Middle of the gap left of the pair [m]."""
        return complex(-self.outer / 2)

    @property
    def middle(self) -> float:
        """Abscissa of the line between the pair [m]: of the centre gripper, and of the mirror."""
        return self.pair / 2

    @property
    def plate_half(self) -> float:
        """Half the width of a warp opener's plates, whose sides hold the neighbours of the pair [m]."""
        return self.pair / 2 + self.outer - self.warp / 2

    @property
    def handover(self) -> complex:
        """Point at which arms and centre gripper meet [m]."""
        return complex(self.middle, -self.depth)

    @property
    def reach(self) -> float:
        """From the gap's middle to the hand-over [m]."""
        return abs(self.handover - self.gap)

    @property
    def room(self) -> float:
        """Clearance of wide links from warps and from the centre gripper [m]: more than the needle can have."""
        return max(self.required + SPARE, self.clearance_bound)

    @property
    def warps(self) -> Complex[np.ndarray, " warps"]:
        """Positions of all warps from left to right [m]; the pair are numbers NEIGHBOURS + 1 and + 2."""
        left = -self.outer - self.pitch * np.arange(NEIGHBOURS)[::-1]
        return np.concatenate([left, [0.0, self.pair], self.pair - left[::-1]]) + 0j


def section_of(params: KnottingDyadParams) -> WarpSection:
    """The section of the parameters; gaps left open are chosen for needle and yarn, the depth for the clearance."""
    content = params.needle_diameter + max(params.pressed, 2 * params.clearance)
    pitch, room = params.cloth.warp_pitch, params.warp + content
    pair = params.pair_opened or max(pitch, room)
    outer = max(pitch, _gap(room, pair, params.depth)) if params.opening is None else pitch + params.opening
    return WarpSection(
        pitch,
        pair,
        outer,
        params.warp,
        params.needle_diameter,
        params.depth or _depth(params, pair, outer),
        params.leg,
        params.link_width,
        params.clearance,
        params.pressed,
    )


def _gap(room: float, pair: float, depth: float | None) -> float:
    """The least g with g cos phi = room [m]; of a given depth h with  g² = room² (1 + (e + g)²/4h²)."""
    usual = room / USUAL_COSINE
    if depth is None or room >= 2 * depth:  # at this depth no gap is enough; a check fails
        return usual
    share = (room / (2 * depth)) ** 2
    return (share * pair + math.sqrt(share**2 * pair**2 + (1 - share) * (share * pair**2 + room**2))) / (1 - share)


def knot_of(params: KnottingDyadParams) -> Knot:
    """The knot to tie, on the pair among all warps of the section."""
    return knot(params.knot, NEIGHBOURS + 1, opens=params.opens)


def _depth(params: KnottingDyadParams, pair: float, outer: float) -> float:
    """As deep as usual, or deeper for the clearance."""
    across = (pair + outer) / 2
    cosine = (params.warp + params.needle_diameter + 2 * params.clearance) / outer
    required = math.inf if cosine >= 1 else across / math.tan(math.acos(cosine))
    return min(max(USUAL_DEPTH * across, required), GREATEST_DEPTH * across)
