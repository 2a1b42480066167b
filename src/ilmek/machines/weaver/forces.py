"""What the tools' work takes at the head's cams: grip, opener, tightening, drawing, sley.

Each force is against the tool's motion forward [N], of the handler a torque [N m]; the follower, which moves 1/i as far
as the tool, gets i times as much, by virtual work.

    jaws            the yarns between them are pressed from their diameter d to the thickness c, n of them; the force
                    rises evenly to S n F / 2 mu, which holds n ends pulled with F
    side grippers   the opener (`opener`); going round the warps, two ends pulled
    centre gripper  on its way back two ends are drawn, over its last part up to the force that tightens the knot, which
                    then holds until the jaws open; it helps the motion forward, so the load is negative
    handler         draws the yarn at its radius
    sley            on its way down, over its last part, up to the force that packs the knot

[thesis 2.2.3: the tools; the forces are assumed by this project where the yarn does not give them]
"""

from collections.abc import Callable

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.weaver.motions import CENTRE_GRASP, CENTRE_MOTION, HANDLER, OPENER, SIDE_GRASP, SIDE_MOTION, SLEY
from ilmek.machines.weaver.opener import Opener
from ilmek.machines.weaver.params import WeaverParams
from ilmek.records import record
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track, sample
from ilmek.units import turn

STILL = 1e-12
"""Slope of a track below which its tool stands [m/rad]."""


@record
class HeadForces:
    """What the forces of a head depend on: its cyclogram, its opener, the radius at which the handler draws [m]."""

    params: WeaverParams
    cyclogram: Cyclogram
    opener: Opener
    radius: float


def grip_force(safety: float, friction: float, ends: int, pull: float) -> float:
    """Force of jaws that hold a number of ends with a safety, each pulled with a force [N]."""
    return safety * ends * pull / (2 * friction)


def tool_force(head: HeadForces, name: str, angle: FloatArray) -> FloatArray:
    """Force on a tool against its motion forward [N; of the handler N m] at cam angles in [0, 2 pi] [rad].

    name  of its track
    """
    params, cyclogram, opener = head.params, head.cyclogram, head.opener
    track = cyclogram.track(name)
    at = sample(track, angle)
    position = at.position
    sense = np.where(np.abs(at.slope) > STILL, np.sign(at.slope), 0.0)
    forces = params.forces
    if name in (SIDE_GRASP, CENTRE_GRASP):
        side = name == SIDE_GRASP
        ends, pull = (1, forces.yarn_pull) if side else (2, forces.tightening)
        return grip_force(forces.grip_safety, params.friction, ends, pull) * pressed(params, position, ends)
    if name in (SIDE_MOTION, OPENER):
        led = 2 * forces.yarn_pull * ((position > opener.travel) & (sense > 0)) if name == SIDE_MOTION else 0.0
        return opener.force(np.maximum(position, 0.0), sense) + led
    if name == CENTRE_MOTION:
        return -_tightening(params, cyclogram, track, angle)
    if name == SLEY:
        into = np.clip(1 - (params.sley_stroke - position) / min(forces.sley_travel, params.sley_stroke), 0.0, 1.0)
        return np.asarray(forces.sley * into * (sense >= 0))
    assert name == HANDLER
    draw = track.segment("draw")
    return np.asarray(forces.yarn_pull * head.radius * ((angle > draw.start) & (angle < draw.end)))


def pressed(params: WeaverParams, position: FloatArray, ends: int) -> FloatArray:
    """Share of the jaws' full force at their positions [m]: from the first touch to the pressed yarns."""
    travel = min(ends * max(params.yarn - params.pressed, 0.0), params.jaw)
    if travel <= 0:
        return np.asarray(position >= params.jaw, float)
    return np.asarray(np.clip(1 - (params.jaw - position) / travel, 0.0, 1.0))


def _tightening(params: WeaverParams, cyclogram: Cyclogram, track: Track, angle: FloatArray) -> FloatArray:
    """Pull of both ends on the centre gripper, which has hold of them [N]."""
    forces, back = params.forces, track.segment("return")
    held = cyclogram.track(CENTRE_GRASP).segment("open").start
    left = sample(track, angle).position
    share = np.clip(1 - left / min(forces.tightening_travel, params.centre_stroke), 0.0, 1.0)
    pull = forces.yarn_pull + max(forces.tightening - forces.yarn_pull, 0.0) * share
    return np.asarray(2 * pull * ((angle > back.start) & (angle <= held)))


def load_on(head: HeadForces, name: str, ratio: float) -> Callable[[FloatArray], FloatArray]:
    """The load on a track's follower [N] at cam angles [rad]; ratio: the tool's motion over the follower's."""

    def load(angle: FloatArray) -> FloatArray:
        return ratio * tool_force(head, name, np.asarray(np.mod(angle, turn)))

    return load
