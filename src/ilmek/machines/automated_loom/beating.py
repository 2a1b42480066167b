"""What beats the rows of a loom: crank-rockers, or the comb on the guide cams, and where either leaves the rows.

The comb goes down with the whole cam system, presses, and goes up [thesis 3.3], as quickly as its acceleration allows:
a stroke h by a law of peak Ca, down and up in a share (1 - q)/2 of the time each and pressing for q, takes
T = 2/(1 - q) sqrt(Ca h / a). Crank-rockers strike once in a turn of their crank. Where a force for each warp leaves the
rows is the fabric's answer [`ilmek.weaving.fell`]; how hard it packs is to be measured, until then assumed.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

from ilmek.cams.laws import LAWS
from ilmek.elements.yarns import warp_stiffness
from ilmek.machines import beat_up, hammer
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.units import turn

USUAL = hammer.HammerParams()
"""The hammer's defaults: law of its stroke, share of a beat for which it presses."""


@dataclass(frozen=True, slots=True)
class Beat:
    """A beat in time: stroke [m], time [s], of it the share forward and the share pressed, and the motions' law."""

    stroke: float
    time: float
    forward: float
    pressed: float
    law: str


class BeatResult(NamedTuple):
    """What a beat leaves: force on each warp [N], distance of the rows [m]; and the force that the rows wanted ask."""

    force: float
    spacing: float
    needed: float


def beat_of_comb(params: AutomatedLoomParams) -> Beat:
    """The comb's beat, as quick as its acceleration allows."""
    peak, share = LAWS[USUAL.law].acceleration_peak, (1 - USUAL.press_share) / 2
    time = math.sqrt(peak * params.comb_stroke / params.comb_acceleration) / share
    return Beat(params.comb_stroke, time, share, USUAL.press_share, USUAL.law)


def beat_of_linkage(params: AutomatedLoomParams, linkage: beat_up.BeatUp) -> Beat:
    """A turn of the crank, drawn harmonic; the true motion is the crank-rocker's."""
    swing, dead = float(linkage.dead_centres.swing), linkage.dead_centres
    stroke = 2 * linkage.lengths["beater"] * math.sin(swing / 2)
    return Beat(stroke, turn / params.beat_speed, 1 - float(dead.rotation) / turn, 0.0, "harmonic")


def hammer_for(
    params: AutomatedLoomParams, warps: int, tension: float, *, stack: float, period: float, beat: Beat
) -> hammer.Hammer:
    """The comb for a loom: of so many warps of a tension [N], with cams of a mass [kg], at a period of the cams [s]."""
    return hammer.design(
        replace(
            _asked(params, warps, tension),
            stroke=beat.stroke,
            law=beat.law,
            press_share=beat.pressed,
            shed_speed=turn / period,
            step=beat.time / period * turn,
            stack_mass=stack,
        )
    )


def left_by(params: AutomatedLoomParams, warps: int, tension: float, force: float) -> BeatResult:
    """Where a force for each warp [N] leaves the rows of a loom."""
    asked = _asked(params, warps, tension)
    fabric = asked.fabric
    return BeatResult(force, float(fabric.spacing(force)), float(fabric.resistance(asked.required_pitch)))


def stiffness_of_warp(params: AutomatedLoomParams) -> float:
    """Force over strain of a warp [N]: as given, or of cotton of its mass."""
    return params.warp_stiffness or warp_stiffness(params.pitch)


def _asked(params: AutomatedLoomParams, warps: int, tension: float) -> hammer.HammerParams:
    """What is asked of the comb: what is woven."""
    along = 1 / params.quality.along
    return hammer.HammerParams(
        warps=warps,
        warp_pitch=params.pitch,
        row_pitch=along,
        tension=tension,
        warp_stiffness=params.warp_stiffness,
        warp_length=params.warp_length,
    )
