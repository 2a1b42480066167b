"""The paper's beat-up in a loom: it travels along the carpet on its slide and strokes along the width."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.drive_parts import motor_part
from ilmek.elements.motors import smallest_motor
from ilmek.machines.beat import Beat, BeatDrive, stroke_needed
from ilmek.machines.beat_up.crank_path import crank_beat, crank_path
from ilmek.machines.beat_up.crank_start import crank_start, start_parts
from ilmek.machines.beat_up.design import BeatUp, design, ground_for
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.beat_up.report import criteria
from ilmek.machines.beat_up.strength import beat_up_strength_checks
from ilmek.machines.beat_up.travel import travel_parts
from ilmek.machines.beat_up.use import BeatUpUse, in_use, use_checks
from ilmek.machines.beat_up.use_params import TravelParams
from ilmek.machines.fell_of_loom import loom_fabric
from ilmek.machines.linkage_strength import FLAT_BARS
from ilmek.machines.loom_task import LoomTask
from ilmek.records import record
from ilmek.report import BillLine, Work
from ilmek.units import format_quantity, mm, turn

STEEL = "structural steel"

TOOTH, BAR = 10 * mm, 30 * mm
"""Height of the beater's teeth, and height and depth of its bar [m]: assumed by this project."""

BAR_IN_FRONT, BAR_ABOVE = 20 * mm, 5 * mm
"""The bar in front of the warps, and above the edge that strikes, clear of the pile [m]: assumed by this project."""


def fit(task: LoomTask) -> BeatUpParams:
    """The paper's beat-up for the loom's warps: the force that its rows need, the time from beat to beat."""
    needed = float(loom_fabric(task).resistance(task.row_pitch))
    every = task.period / 2
    return BeatUpParams(
        speed=task.params.beat_speed,
        ground=ground_for(stroke_needed(task)),
        beat_force=needed,
        interval=every if every > 0 else None,
        travel=TravelParams(warps=task.warps, warp_pitch=task.params.pitch, warp_force=needed),
    )


def links_parts(linkage: BeatUp, number: int = 1) -> tuple[BillLine, ...]:
    """Links of a number of crank-rockers."""
    return tuple(
        BillLine(
            f"{name} of the beat-up", number, format_quantity(linkage.lengths[name], "mm"), STEEL, "machined link", m
        )
        for name, m in linkage.masses.items()
    )


def parts(linkage: BeatUp) -> tuple[BillLine, ...]:
    """Beater, links, and the motor that turns the crank at its speed."""
    torque, speed = linkage.drive_torque_max, linkage.params.speed
    motor = motor_part("motor of the beat-up", smallest_motor(torque, speed), torque, speed)
    return (_beater(linkage), *links_parts(linkage), motor)


def _beater(linkage: BeatUp) -> BillLine:
    return BillLine("beater", 1, "a tooth between two warps", STEEL, "laser-cut part", linkage.params.beater_mass)


def work(linkage: BeatUp) -> tuple[Work, ...]:
    """Work of a turn of the crank without recovery."""
    state = linkage.state
    step = turn / (state.angle.size - 1)
    return (Work("beating", float(np.sum(np.maximum(state.torque[:-1], 0.0)) * step), "beat"),)


def frame_force(linkage: BeatUp) -> float:
    """Greatest force on the frame over a turn [N]: of both pivots together, at the speed, on an empty beat."""
    return float(np.max(np.abs(linkage.state.forces.pin("A") + linkage.state.forces.pin("D"))))


def outline(reach: float) -> tuple[ComplexArray, ...]:
    """The beater in the side view [m]: its teeth through the warps, and the bar in front of them, above the pile."""
    front = BAR_IN_FRONT
    tooth = np.array([-reach / 2, front, front, -reach / 2])
    bar, up = np.array([0.0, BAR, BAR, 0.0]) + front, np.array([0, 0, 1j, 1j])
    return tooth + TOOTH * up, bar + 1j * BAR_ABOVE + BAR * up


@record
class TravellingBeat:
    """A beat by the travelling beater."""

    design: BeatUp
    use: BeatUpUse

    @property
    def beat(self) -> Beat:
        """All strokes across the width, from the start of the crank to its stop."""
        return crank_beat(self.use.start, self.use.travel.slide_run)

    def drive(self, task: LoomTask) -> BeatDrive:
        """The same for the time from beat to beat."""
        fabric = loom_fabric(task)
        params = task.parameters("beat-up", replace(self.design.params, interval=fit(task).interval))
        made = _at_interval(self.design, params)
        duty = replace(self.use.start.duty, linkage=made, every=params.interval)
        use = replace(self.use, start=crank_start(duty, params.start))
        across = use.travel
        sliding = across.strokes * across.slide_mass * across.step.speed**2 / 2
        return BeatDrive(
            name="beat-up",
            design=made,
            task=task,
            beat=crank_beat(use.start, across.slide_run),
            fabric=fabric,
            parts=(_beater(made), *links_parts(made), *start_parts(use.start), *travel_parts(across)),
            work=(Work("beating", use.start.start_work + sliding, "beat"),),
            torque=use.start.start_torque,
            path=crank_path(use.start, outline(params.travel.reach)),
            machine_checks=(*criteria(made), *use_checks(use)),
            crank_rockers=1,
            force=across.stroke_force,
            beaten=across.stroke_warps,
            frame_force=frame_force(made),
        )


@lru_cache(maxsize=16)
def _at_interval(linkage: BeatUp, params: BeatUpParams) -> BeatUp:
    """The same linkage with another time from beat to beat, which decides on motor and flywheel alone."""
    return replace(linkage, params=params)


def planned_beat(task: LoomTask, _kind: str) -> TravellingBeat:
    """The travelling beater of a loom, its links as the paper's or stronger. Raises the errors of `beat_up.design`."""
    usual, fabric = fit(task), loom_fabric(task)
    for width, thickness in FLAT_BARS:
        made = design(task.parameters("beat-up", replace(usual, width=width, thickness=thickness)))
        found = in_use(made, fabric)
        given = (made.params.width, made.params.thickness) != (width, thickness)
        if given or all(check.ok for check in beat_up_strength_checks(found.strength)):
            break
    return TravellingBeat(made, found)
