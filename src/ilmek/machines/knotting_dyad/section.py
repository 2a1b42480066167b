"""The section across the warps that the head works in: warps, gaps, hand-over, and the clearance of a needle.

The knot's pair stands at 0 and p. Its neighbours, NEIGHBOURS on each side, stand in the same pitch, and aside by the
opening o of a warp opener, which holds the pair in two slots and pushes the rest away [thesis 2.2.3, Fig 2.14]. So the
gaps outside the pair are g = p + o wide between axes, their middles lie g/2 outside the pair.

A needle of diameter d through the middle of such a gap, tilted by phi, stays off both warps of diameter D by

    c = (g/2) cos phi - (D + d)/2

To hand over on the line between the pair, h behind the warps' axes, it tilts by phi with tan phi = (p + g)/2h. So the
clearance c cannot be greater than this, whatever the arm; and it requires the depth

    h = (p + g) / 2 tan phi,     cos phi = (D + d + 2c)/g,     possible where D + d + 2c < g
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
"""Depth of the hand-over, over the pitch: as a rule, and at most, where the clearance requires more."""

SPARE = 1 * mm
"""Room between wide links and warps, besides the clearance."""


@record
class WarpSection:
    """Lengths of the section [m]; x from the pair's left warp, y from the warps' axes, the pile upwards.

    pitch    p                   outer   g, width of the outer gaps between axes      front  height of the ends at rest
    warp     diameter D          needle  diameter d of both needles and of the        width  of the links
    required clearance                   centre gripper
    """

    pitch: float
    outer: float
    warp: float
    needle: float
    depth: float = result("mm", "depth h of the hand-over behind the warps' axes", name="handover_depth")
    front: float
    width: float
    required: float

    @computed("mm", "greatest clearance of any needle, and of the centre gripper, at this depth")
    def clearance_bound(self) -> float:
        outer = self.outer / 2 * math.cos(self.tilt)
        return min(outer, self.pitch / 2) - (self.warp + self.needle) / 2

    @computed("mm", "from the tip to where the second link grows wide")
    def needle_length(self) -> float:
        # Off the warps, and beside the centre gripper at the hand-over.
        off_warps = self.reach + (self.width / 2 + self.warp / 2 + self.room) / math.cos(self.tilt)
        return max(off_warps, (self.width + self.room) / math.sin(self.tilt))

    @computed("deg", "tilt of the needle from upright, at the hand-over", name="needle_tilt")
    def tilt(self) -> float:
        return math.atan2((self.pitch + self.outer) / 2, self.depth)

    @property
    def gap(self) -> complex:
        """Middle of the gap left of the pair [m]."""
        return complex(-self.outer / 2)

    @property
    def middle(self) -> float:
        """Abscissa of the line between the pair [m]: of the centre gripper, and of the mirror."""
        return self.pitch / 2

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
        return np.concatenate([left, [0.0, self.pitch], self.pitch - left[::-1]]) + 0j


def section_of(params: KnottingDyadParams) -> WarpSection:
    """The section of the parameters; its depth chosen for the clearance where none is given."""
    outer = params.warp_pitch + params.opening
    depth = params.depth or _depth(params, outer)
    return WarpSection(
        params.warp_pitch,
        outer,
        params.warp_diameter,
        params.needle_diameter,
        depth,
        params.leg,
        params.link_width,
        params.clearance,
    )


def knot_of(params: KnottingDyadParams) -> Knot:
    """The knot to tie, on the pair among all warps of the section."""
    return knot(params.knot, NEIGHBOURS + 1, opens=params.opens)


def _depth(params: KnottingDyadParams, outer: float) -> float:
    """As deep as usual, or deeper for the clearance."""
    usual, greatest = USUAL_DEPTH * params.warp_pitch, GREATEST_DEPTH * params.warp_pitch
    cosine = (params.warp_diameter + params.needle_diameter + 2 * params.clearance) / outer
    required = math.inf if cosine >= 1 else (params.warp_pitch + outer) / 2 / math.tan(math.acos(cosine))
    return min(max(usual, required), greatest)
