"""The section across the warps that the head works in: warps, gaps, hand-over, and how much room a needle has.

The knot's pair stands at 0 and p. Its neighbours, NEIGHBOURS on each side, stand in the same pitch, and aside by the
opening o of a warp opener, which holds the pair in two slots and pushes the rest away [thesis 2.2.3, Fig 2.14]. So the
gaps outside the pair are g = p + o wide between axes, their middles lie g/2 outside the pair.

A needle of diameter d through the middle of such a gap, tilted by phi, stays off both warps of diameter D by

    c = (g/2) cos phi - (D + d)/2

To hand over on the line between the pair, h behind the warps' axes, it tilts by phi with tan phi = (p + g)/2h. So the
clearance c cannot be greater than this, whatever the arm; and it asks for the depth

    h = (p + g) / 2 tan phi,     cos phi = (D + d + 2c)/g,     possible where D + d + 2c < g
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.units import mm
from ilmek.weaving.knots.word import Knot, knot

NEIGHBOURS = 6
"""Warps on each side of the pair that must be passed clear."""

USUAL_DEPTH, GREATEST_DEPTH = 2.0, 4.0
"""Depth of the hand-over, over the pitch: as a rule, and where the clearance asks for more."""

SPARE = 1 * mm
"""Room between wide links and warps, besides the clearance."""


@dataclass(frozen=True, slots=True)
class WarpSection:
    """Lengths of the section [m]; x from the pair's left warp, y from the warps' axes, the pile upwards.

    pitch    p                   outer   g, width of the outer gaps between axes      front  height of the ends at rest
    warp     diameter D          needle  diameter d of both needles and of the        width  of the links
    depth    h, of the hand-over         centre gripper                               asked  clearance asked for
    """

    pitch: float
    outer: float
    warp: float
    needle: float
    depth: float
    front: float
    width: float
    asked: float

    @property
    def gap(self) -> complex:
        """Middle of the gap left of the pair [m]."""
        return complex(-self.outer / 2)

    @property
    def middle(self) -> float:
        """Place across of the line between the pair [m]: of the centre gripper, and of the mirror."""
        return self.pitch / 2

    @property
    def handover(self) -> complex:
        """Where arms and centre gripper meet [m]."""
        return complex(self.middle, -self.depth)

    @property
    def tilt(self) -> float:
        """Tilt of the needle at the hand-over [rad]."""
        return math.atan2((self.pitch + self.outer) / 2, self.depth)

    @property
    def reach(self) -> float:
        """From the gap's middle to the hand-over [m]."""
        return abs(self.handover - self.gap)

    @property
    def clearance_bound(self) -> float:
        """The greatest clearance that any arm's needle can have [m], and the centre gripper."""
        outer = self.outer / 2 * math.cos(self.tilt)
        return min(outer, self.pitch / 2) - (self.warp + self.needle) / 2

    @property
    def room(self) -> float:
        """What wide links keep from warps and from the centre gripper [m]: more than the needle can."""
        return max(self.asked + SPARE, self.clearance_bound)

    @property
    def needle_length(self) -> float:
        """From the tip to where the link grows wide [m]: off the warps, beside the centre gripper at the hand-over."""
        off_warps = self.reach + (self.width / 2 + self.warp / 2 + self.room) / math.cos(self.tilt)
        return max(off_warps, (self.width + self.room) / math.sin(self.tilt))

    @property
    def warps(self) -> Complex[np.ndarray, " warps"]:
        """Places of all warps from left to right [m]; the pair are numbers NEIGHBOURS + 1 and + 2."""
        left = -self.outer - self.pitch * np.arange(NEIGHBOURS)[::-1]
        return np.concatenate([left, [0.0, self.pitch], self.pitch - left[::-1]]) + 0j


def section_of(params: KnottingDyadParams) -> WarpSection:
    """The section that the parameters ask for; its depth chosen for the clearance where none is given."""
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
    asked = math.inf if cosine >= 1 else (params.warp_pitch + outer) / 2 / math.tan(math.acos(cosine))
    return min(max(usual, asked), greatest)
