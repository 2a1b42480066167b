"""Strength of a beat-up's links and pins over a turn of the crank at its speed (`machines.linkage_strength`).

The forces are those of the empty beat: the fell's resistance opposes the inertia of the beater and relieves the pins.
The mean of pressure times speed is that over the time from one turn to the next.
"""

from functools import lru_cache

from ilmek.dynamics.loads import Gravity
from ilmek.machines.beat_up.design import PINS, BeatUp
from ilmek.machines.linkage_strength import (
    LinkageLoads,
    LinkageStrength,
    linkage_loads,
    linkage_strength,
    strength_checks,
)
from ilmek.machines.strength_params import StrengthParams
from ilmek.records import computed, group, record
from ilmek.report import Check, Choice

WIDER = "set wider or thicker links, a shorter ground, or a lower speed"
POINTS = {"crank": (), "coupler": (), "rocker": ("E",)}
"""Links, and their points beside the pins."""


@record
class BeatUpStrength:
    """Greatest stresses of links and pins."""

    found: LinkageStrength = group()

    crank_stress = computed("MPa", "greatest stress of the crank", lambda it: it.found.links["crank"].stress)
    coupler_stress = computed("MPa", "greatest stress of the coupler", lambda it: it.found.links["coupler"].stress)
    rocker_stress = computed("MPa", "greatest stress of the rocker", lambda it: it.found.links["rocker"].stress)
    coupler_buckling = computed(
        "1", "safety of the coupler against buckling", lambda it: it.found.links["coupler"].buckling, least=0.0
    )

    @property
    def choices(self) -> tuple[Choice, ...]:
        """The choice of the pins."""
        return self.found.choices


@lru_cache(maxsize=16)
def beat_up_strength(
    design: BeatUp, limits: StrengthParams, every: float | None = None, *, name: str = "strength"
) -> BeatUpStrength:
    """Stresses of the links and pins of a beat-up; of the stock pins the first that is enough, else the largest.

    every  time from one turn of the crank to the next [s]; default: it turns on      name  of the limits' parameters
    """
    params, loads = design.params, link_loads(design, every)
    return BeatUpStrength(
        linkage_strength(loads, limits, dict.fromkeys(POINTS, (params.width, params.thickness)), name=name)
    )


def beat_up_strength_checks(found: BeatUpStrength, *, name: str = "strength") -> tuple[Check, ...]:
    """Whether links and pins bear a beat; name: of the limits' parameters."""
    return strength_checks(found.found, name=name, stronger=WIDER)


def link_loads(design: BeatUp, every: float | None = None) -> LinkageLoads:
    """What links and pins bear over a turn at the speed; every: time from turn to turn [s]."""
    params = design.params
    return linkage_loads(
        design.state.forces,
        design.bodies,
        (Gravity(params.gravity_vector),),
        POINTS,
        PINS,
        speed=params.speed,
        line_mass=params.width * params.thickness * params.density,
        share=1.0 if every is None else min(design.period / every, 1.0),
    )
