"""Strength of a knotting four-bar's links and pins: over the working range with poses, else at the crank angle."""

from collections.abc import Mapping

from ilmek.dynamics.inertia import Inertia
from ilmek.machines.knotting_four_bar.model import PIN_BODIES, KnottingState, loads_of
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.machines.linkage_strength import LinkageStrength, linkage_loads, linkage_strength
from ilmek.machines.strength_params import StrengthParams

LINKS = {"crank": (), "coupler": ("H",), "rocker": ()}


def four_bar_strength(
    params: KnottingFourBarParams, state: KnottingState, bodies: Mapping[str, Inertia], limits: StrengthParams
) -> LinkageStrength:
    """Stresses of links and pins in the states given, of bodies with these inertias."""
    loads = linkage_loads(
        state.forces,
        bodies,
        loads_of(params),
        LINKS,
        PIN_BODIES,
        speed=abs(params.speed),
        line_mass=params.width * params.thickness * params.density,
    )
    return linkage_strength(loads, limits, dict.fromkeys(LINKS, (params.width, params.thickness)))
