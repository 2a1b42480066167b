"""The comb: its mass, its leaves, and how it presses the fell from edge to edge.

A bar of h x b across the width (h along the beat) with a leaf in each gap of the warps: E I = E b h^3 / 12. A leaf is a
cantilever with the force of one warp at its end: stress 6 F a / (t h^2), sag 4 F a^3 / (E t h^3).
"""

from dataclasses import dataclass, replace

import numpy as np

from ilmek.machines.hammer.params import DEPTHS, HammerParams
from ilmek.weaving.comb_on_fell import FellPressure, fell_pressure
from ilmek.weaving.fell import Fabric


@dataclass(frozen=True, slots=True)
class Comb:
    """The comb under the beat.

    mass        bar and leaves [kg]           rigidity  E I of the bar [N m^2]
    foundation  stiffness of the fell over the width [N/m^2]
    line        its pressure across the width             stress      largest of the bar [Pa]
    leaf_stress, leaf_sag  of a leaf [Pa, m]
    """

    mass: float
    rigidity: float
    foundation: float
    line: FellPressure
    stress: float
    leaf_stress: float
    leaf_sag: float


def comb_mass(params: HammerParams) -> float:
    """Mass of bar and leaves [kg]."""
    bar = params.width * params.depth * params.comb_thickness
    leaves = (params.warps - 1) * params.leaf_reach * params.leaf_height * params.leaf
    return (bar + leaves) * params.density


def comb_for(params: HammerParams, fabric: Fabric, force: float) -> Comb:
    """The comb pressing with a force [N] for each warp; the fell as stiff as it is at that force."""
    rigidity = params.modulus * params.comb_thickness * params.depth**3 / 12
    foundation = fabric.rate(float(fabric.spacing(force))) / params.warp_pitch
    ends = (params.inset, params.width - params.inset) if params.places > 1 else (params.width / 2,) * 2
    line = fell_pressure(params.width, np.unique(np.linspace(*ends, params.places)), rigidity, foundation)
    curvature = float(np.max(np.abs(line.curvature))) * force / params.warp_pitch
    leaf = params.leaf * params.leaf_height**2
    return Comb(
        mass=comb_mass(params),
        rigidity=rigidity,
        foundation=foundation,
        line=line,
        stress=params.modulus * curvature * params.depth / 2,
        leaf_stress=6 * force * line.most * params.leaf_reach / leaf,
        leaf_sag=4 * force * line.most * params.leaf_reach**3 / (params.modulus * leaf * params.leaf_height),
    )


def with_depth(params: HammerParams, fabric: Fabric, force: float) -> HammerParams:
    """The parameters with a comb deep enough to press evenly with a force for each warp; the deepest where none is."""
    if params.comb_depth is not None:
        return params
    low, high = 0, len(DEPTHS) - 1
    while low < high:
        middle = (low + high) // 2
        tried = comb_for(replace(params, comb_depth=DEPTHS[middle]), fabric, force)
        low, high = (low, middle) if tried.line.uniformity >= params.uniformity_limit else (middle + 1, high)
    return replace(params, comb_depth=DEPTHS[low])
