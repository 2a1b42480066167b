"""Crank-rockers that beat the rows of a loom.

The paper's beat-up rides along the carpet on a slide, and the width of its beater is not printed; here one comb strikes
the whole width at once [thesis 3.3]. Crank-rockers on one crank shaft share its mass and its force.
"""

import math

import numpy as np

from ilmek.elements.drive_parts import motor_part
from ilmek.elements.motors import smallest_motor
from ilmek.machines.beat import Beat, BeatDrive
from ilmek.machines.beat_up.design import BeatUp, design
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.loom_task import LoomTask
from ilmek.records import record
from ilmek.report import Part, Work
from ilmek.units import format_quantity, turn
from ilmek.weaving.fell import assumed_fabric

STEEL = "structural steel"


def fit(task: LoomTask) -> BeatUpParams:
    """One of the loom's crank-rockers: its share of the beater and of the force."""
    params = task.params
    share = params.width / crank_rockers(task)
    return BeatUpParams(
        speed=params.beat_speed, beater_mass=params.beater_density * share, beat_force=params.beat_force * share
    )


def crank_rockers(task: LoomTask) -> int:
    """The smallest number of crank-rockers that leaves none more than `beater_width`."""
    return math.ceil(task.params.width / task.params.beater_width - 1e-9)


def parts(linkage: BeatUp, number: int = 1) -> tuple[Part, ...]:
    """Comb, links and motor of a number of crank-rockers on one shaft."""
    torque, speed = number * linkage.drive_torque_max, linkage.params.speed
    links = (
        Part(f"{name} of the beat-up", number, format_quantity(linkage.lengths[name], "mm"), STEEL, "machined link", m)
        for name, m in linkage.masses.items()
    )
    comb = number * linkage.params.beater_mass
    return (
        Part("comb of the beater", 1, "a leaf between two warps", STEEL, "laser-cut part", comb),
        *links,
        motor_part("motor of the beat-up", smallest_motor(torque, speed), torque, speed),
    )


def work(linkage: BeatUp, number: int = 1) -> tuple[Work, ...]:
    """Work of a beat: a turn of the crank without recovery, of a number of crank-rockers."""
    state = linkage.state
    step = turn / (state.angle.size - 1)
    return (Work("beating", number * float(np.sum(np.maximum(state.torque[:-1], 0.0)) * step), "beat"),)


@record
class CrankRockers:
    """A beat by a number of crank-rockers, all alike."""

    design: BeatUp
    number: int

    @property
    def beat(self) -> Beat:
        """A turn of the crank, drawn harmonic; the true motion is the crank-rocker's."""
        forward = 1 - self.design.crank_rotation / turn
        return Beat(self.design.beater_stroke, self.design.period, forward, 0.0, "harmonic", "beat-up crank")

    def drive(self, task: LoomTask) -> BeatDrive:
        """The same with forces, parts and work of all; nothing in it depends on the period of the row."""
        assert task.side is not None
        return BeatDrive(
            name="beat-up",
            design=self.design,
            task=task,
            beat=self.beat,
            fabric=assumed_fabric(task.row_pitch, task.tension, task.yarns.warp.stiffness, task.side.warp_length),
            parts=parts(self.design, self.number),
            work=work(self.design, self.number),
            torque=self.number * self.design.drive_torque_max,
            crank_rockers=self.number,
            force=self.number * self.design.beater_force_max,
        )


def planned_beat(task: LoomTask, _kind: str) -> CrankRockers:
    """The crank-rockers of a loom. Raises the errors of `beat_up.design`."""
    return CrankRockers(design(task.parameters("beat-up", fit(task))), crank_rockers(task))
