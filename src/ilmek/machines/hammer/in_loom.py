"""The comb on the guide cams that beats the rows of a loom.                                                [thesis 3.3]

It goes down with the whole cam system, presses, and goes up, as quickly as the loom's `comb_acceleration` a allows: a
stroke h by a law whose peak acceleration is Ca, down and up in a share (1 - q)/2 of the time each and pressing for q,
takes T = 2/(1 - q) sqrt(Ca h / a).
"""

import math
from dataclasses import replace

import numpy as np

from ilmek.cams.laws import LAWS
from ilmek.elements.drive_parts import motor_part, reducer_part
from ilmek.elements.materials import GRAVITY
from ilmek.machines.beat import Beat, BeatDrive
from ilmek.machines.beat_up import in_loom as crank_rockers
from ilmek.machines.hammer.design import Hammer, design
from ilmek.machines.hammer.params import STEEL, HammerParams
from ilmek.machines.loom_task import LoomTask
from ilmek.records import record
from ilmek.report import Part, Work
from ilmek.units import format_quantity, turn


def fit(task: LoomTask, kind: str = "comb") -> HammerParams:
    """The comb for the loom's warps and rows, within the row's time; with the shedding's cams on it for guide-cams."""
    beat = planned_beat(task, kind).beat
    return replace(
        _of_carpet(task, kind),
        shed_speed=turn / task.period,
        step=beat.time / task.period * turn,
        stack_mass=task.designs["shedding"].stack.mass if kind == "guide-cams" else 0.0,
    )


def _of_carpet(task: LoomTask, kind: str) -> HammerParams:
    """The comb for the loom's warps and rows; what depends on the row's time is left as it is."""
    params = task.params
    assert task.side is not None
    return HammerParams(
        warps=task.warps,
        warp_pitch=params.pitch,
        row_pitch=task.row_pitch,
        tension=task.tension,
        warp_stiffness=task.yarns.warp.stiffness,
        drive="linkage" if kind == "linkage" else "comb",
        warp_length=task.side.warp_length,
        stroke=task.side.beat_stroke,
    )


def parts(hammer: Hammer) -> tuple[Part, ...]:
    """Comb and vertical axes, or the crank-rockers."""
    if hammer.axis is None:
        return crank_rockers.parts(hammer.linkage.one, hammer.linkage.number) if hammer.linkage else ()
    number, drive, load = hammer.params.axis_count, hammer.axis.drive, hammer.axis.cycle
    torque, speed = float(np.max(np.abs(load.torque))), float(np.max(np.abs(load.speed)))
    motor, axis = drive.motor if drive else None, "vertical axis"
    bar = f"bar {format_quantity(hammer.params.depth, 'mm')} high, a leaf between two warps"
    return (
        Part("comb of the hammer", 1, bar, STEEL.name, "laser-cut part", hammer.comb.mass),
        Part(axis, number, hammer.params.axis, "", "linear axis", length=hammer.params.stroke),
        motor_part(f"motor of a {axis}", motor, torque, speed, number),
        *((reducer_part(f"reducer of a {axis}", drive.reducer.ratio, motor, number),) if drive else ()),
    )


def work(hammer: Hammer) -> tuple[Work, ...]:
    """Work of a beat: of the comb on its rows, and to lift all that moves; or of the crank-rockers."""
    if hammer.axis is None:
        return crank_rockers.work(hammer.linkage.one, hammer.linkage.number) if hammer.linkage else ()
    lifted = (1 - hammer.params.counterbalance) * hammer.mass * GRAVITY * hammer.params.stroke
    return (Work("beating", hammer.params.warps * hammer.energy + lifted, "beat"),)


@record
class CombBeat:
    """A beat by the comb, with its parameters as far as they do not depend on the row's time."""

    params: HammerParams
    acceleration: float
    kind: str

    @property
    def beat(self) -> Beat:
        """The comb's beat, as quick as its acceleration allows; of crank-rockers a turn of the crank."""
        params = self.params
        if self.kind == "linkage":
            return Beat(params.stroke, turn / params.beat_speed, 0.5, 0.0, "harmonic", "beat-up crank")
        peak, share = LAWS[params.law].acceleration_peak, (1 - params.press_share) / 2
        time = math.sqrt(peak * params.stroke / self.acceleration) / share
        return Beat(params.stroke, time, share, params.press_share, params.law, "vertical axes")

    def drive(self, task: LoomTask) -> BeatDrive:
        """The comb at the period of the row, with the shedding's cams on it."""
        hammer = design(task.parameters("hammer", fit(task, self.kind)))
        return BeatDrive(
            name="hammer",
            design=hammer,
            task=task,
            beat=self.beat,
            fabric=hammer.fabric,
            parts=parts(hammer),
            work=work(hammer),
            torque=0.0,
            crank_rockers=0,
            force=hammer.params.warps * hammer.force,
        )


def planned_beat(task: LoomTask, kind: str) -> CombBeat:
    """The comb's beat in a loom. Raises ParameterError where values set for it contradict each other."""
    return CombBeat(task.parameters("hammer", _of_carpet(task, kind)), task.params.comb_acceleration, kind)
