"""The comb: its mass, its leaves, and how it presses the fell from edge to edge.

A bar of h x b across the width (h along the beat) with a leaf in each gap of the warps, bonded in a slot s deep and l
high in its lower edge, of which the bar counts as without the lands between:

    A = b h - s l,    A y = b h h/2 - s l l/2,    I = b h^3/12 + b h (y - h/2)^2 - s l^3/12 - s l (y - l/2)^2

A leaf is a cantilever with the force of one warp at its end: stress 6 F a / (t h^2), sag 4 F a^3 / (E t h^3).
"""

from dataclasses import replace

import numpy as np

from ilmek.machines.hammer.params import DEPTHS, HammerParams
from ilmek.records import computed, record, result
from ilmek.units import mm
from ilmek.weaving.comb_on_fell import FellPressure, fell_pressure
from ilmek.weaving.fell import Fabric


@record
class Comb:
    """The comb under the beat; line: its pressure across the width."""

    line: FellPressure
    depth: float = result("mm", "height of the comb's bar: as given, or chosen", name="comb_depth", least=0.0)
    mass: float = result("kg", "mass of bar and leaves", name="comb_mass")
    rigidity: float = result("N*m^2", "E I of the comb's bar", name="comb_rigidity")
    foundation: float = result("Pa", "stiffness of the fell: force over width and displacement", name="fell_stiffness")
    stress: float = result("MPa", "largest stress of the bar", name="comb_stress")
    leaf_stress: float = result("MPa", "stress of a leaf")
    leaf_sag: float = result("mm", "sag of a leaf at the fell")

    uniformity = computed("1", "least force over the largest, across the width", lambda it: it.line.uniformity)
    share_min = computed("1", "least force over the mean", lambda it: it.line.least)
    share_max = computed("1", "largest force over the mean", lambda it: it.line.most)
    beam_number = computed("1", "width over the length in which the comb bends, l W", lambda it: it.line.number)


BAR_ID, LEAF_ID = "hammer/bar", "hammer/leaf"

BEHIND = 5 * mm
"""Reach of the leaves behind the warps [m]: assumed by this project."""


ABOVE_PILE = 12 * mm
"""Bar of a comb on crank-rockers over its striking edge [m]; assumed by this project."""

SLOT = 3 * mm
"""Depth of the slots that hold the leaves at their pitch, at most a fourth of the bar [m]; assumed by this project."""


def bar_low(params: HammerParams) -> float:
    """Lower edge of the bar over that of the leaves [m]: on crank-rockers it is above the pile."""
    return ABOVE_PILE if params.drive == "linkage" else 0.0


def slot_of(params: HammerParams) -> tuple[float, float]:
    """Depth and height of a leaf's slot in the bar [m]."""
    high = min(params.leaf_height - bar_low(params), params.depth)
    return (min(SLOT, params.comb_thickness / 4), high) if high > 0 else (0.0, 0.0)


def second_moment(params: HammerParams) -> tuple[float, float]:
    """Second moment of area of the bar [m^4], and from its neutral axis to the farther edge [m]."""
    high, (deep, tall) = params.depth, slot_of(params)
    full, cut = params.comb_thickness * high, deep * tall
    axis = (full * high / 2 - cut * tall / 2) / (full - cut)
    moment = full * (high**2 / 12 + (axis - high / 2) ** 2) - cut * (tall**2 / 12 + (axis - tall / 2) ** 2)
    return moment, max(axis, high - axis)


def comb_mass(params: HammerParams) -> float:
    """Mass of bar and leaves [kg]; a leaf reaches `BEHIND` the fell, and fills its slot."""
    bar = params.cloth.width * params.depth * params.comb_thickness
    leaves = (params.cloth.warps - 1) * (params.reach + BEHIND) * params.leaf_height * params.leaf
    return (bar + leaves) * params.density


def comb_for(params: HammerParams, fabric: Fabric, force: float) -> Comb:
    """The comb pressing with a force [N] for each warp; the fell as stiff as it is at that force."""
    moment, edge = second_moment(params)
    rigidity = params.modulus * moment
    foundation = fabric.rate(float(fabric.spacing(force))) / params.cloth.warp_pitch
    width = params.cloth.width
    ends = (params.inset, width - params.inset) if params.support_count > 1 else (width / 2,) * 2
    supports = np.unique(np.linspace(*ends, params.support_count))
    line = fell_pressure(width, supports, rigidity, foundation)
    curvature = float(np.max(np.abs(line.curvature))) * force / params.cloth.warp_pitch
    leaf = params.leaf * params.leaf_height**2
    return Comb(
        line=line,
        depth=params.depth,
        mass=comb_mass(params),
        rigidity=rigidity,
        foundation=foundation,
        stress=params.modulus * curvature * edge,
        leaf_stress=6 * force * line.most * params.reach / leaf,
        leaf_sag=4 * force * line.most * params.reach**3 / (params.modulus * leaf * params.leaf_height),
    )


def with_depth(params: HammerParams, fabric: Fabric, force: float) -> HammerParams:
    """The parameters with a comb deep enough to press evenly with a force for each warp; the deepest where none is."""
    if params.comb_depth is not None:
        return params
    low, high = 0, len(DEPTHS) - 1
    while low < high:
        middle = (low + high) // 2
        tried = comb_for(replace(params, comb_depth=DEPTHS[middle]), fabric, force)
        low, high = (low, middle) if tried.uniformity >= params.uniformity_limit else (middle + 1, high)
    return replace(params, comb_depth=DEPTHS[low])
