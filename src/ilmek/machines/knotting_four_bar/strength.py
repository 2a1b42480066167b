"""Strength of a knotting four-bar's links and pins: over the working range with poses, else at the crank angle."""

from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.model import PIN_BODIES, loads_of
from ilmek.machines.linkage_strength import LinkageStrength, linkage_loads, linkage_strength

LINKS = {"crank": (), "coupler": ("H",), "rocker": ()}


def four_bar_strength(design: KnottingFourBar) -> LinkageStrength:
    """Stresses of links and pins; near a dead point only the motion through given poses counts."""
    params, limits = design.params, design.params.strength
    state = design.moving if design.working else design.at
    found = linkage_loads(
        state.forces,
        design.inertias,
        loads_of(params),
        LINKS,
        PIN_BODIES,
        speed=abs(params.speed),
        line_mass=params.width * params.thickness * params.density,
    )
    return linkage_strength(found, limits, dict.fromkeys(LINKS, (params.width, params.thickness)))
