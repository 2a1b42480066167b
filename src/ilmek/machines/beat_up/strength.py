"""Strength of a beat-up's links and pins over a turn of the crank at its speed (`machines.linkage_strength`).

The forces are those of the empty beat: the fell's resistance opposes the inertia of the beater and relieves the pins.
The mean of pressure times speed is that over the time from one turn to the next.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Gravity
from ilmek.machines.beat_up.linkage import PINS, BeatUpState
from ilmek.machines.beat_up.links import LINKS, PART_IDS
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.link_tree import BRIDGE
from ilmek.machines.linkage_strength import (
    LinkageLoads,
    LinkageStrength,
    linkage_loads,
    linkage_strength,
    strength_checks,
)
from ilmek.records import computed, group, record, value_record
from ilmek.report import Check, Choice, at_least
from ilmek.units import turn

WIDER = "set wider or thicker links, a shorter ground, or a lower speed"
POINTS = {"crank": (), "coupler": (), "rocker": ("E",)}
"""Links, and their points beside the pins."""


@value_record
class Duty:
    """What the strength of a beat-up depends on beside its parameters.

    every   time from one turn of the crank to the next [s]; None: it turns on
    limits  name of the limits' parameters
    """

    every: float | None = None
    limits: str = "strength"


@record
class BeatUpStrength:
    """Greatest stresses of links and pins; bridge: least distance of two pins of a link, over their diameter."""

    duty: Duty
    bridge: float
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


def beat_up_strength(
    params: BeatUpParams, loads: LinkageLoads, lengths: Mapping[str, float], duty: Duty, pin: float
) -> BeatUpStrength:
    """Stresses of the links and pins of a beat-up; pin: diameter that the pins have [m]."""
    limits, sections = params.strength, dict.fromkeys(POINTS, (params.width, params.thickness))
    strength = linkage_strength(loads, limits, sections, name=duty.limits)
    if strength.pin_diameter != pin:
        strength = linkage_strength(loads, replace(limits, pin_diameter=pin), sections, name=duty.limits)
    return BeatUpStrength(duty, min(lengths[name] for name in LINKS) / strength.pin_diameter, strength)


def beat_up_strength_checks(strength: BeatUpStrength) -> tuple[Check, ...]:
    """Whether links and pins bear a beat, and the holes of each link are apart."""
    title = "distance of the pins of a link, over their diameter"
    return (
        *strength_checks(strength.found, name=strength.duty.limits, stronger=WIDER, parts=PART_IDS),
        at_least(title, strength.bridge, BRIDGE, "1", "bridge between the holes, assumed by this project").with_cure(
            "set a longer ground, thinner pins, or other links", *tuple(PART_IDS[name] for name in LINKS)
        ),
    )


def link_loads(
    params: BeatUpParams,
    state: BeatUpState,
    bodies: Mapping[str, Inertia],
    every: float | None = None,
    links: Mapping[str, Sequence[str]] = MappingProxyType(POINTS),
) -> LinkageLoads:
    """What links and pins bear over a turn at the speed.

    every  time from turn to turn [s]      links  those whose internal forces are computed; none: the pins' loads alone
    """
    return linkage_loads(
        state.forces,
        bodies,
        (Gravity(params.gravity_vector),),
        links,
        PINS,
        speed=params.speed,
        line_mass=params.width * params.thickness * params.link_material.density,
        share=1.0 if every is None else min(turn / params.speed / every, 1.0),
    )


def frame_force(state: BeatUpState) -> float:
    """Greatest force on the frame over a turn [N]: of both pivots together, at the speed, on an empty beat."""
    return float(np.max(np.abs(state.forces.pin("A") + state.forces.pin("D"))))
