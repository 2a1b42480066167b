"""The paper's beat-up in a loom: it travels along the carpet on its slide and strokes along the width."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.arrangement.spans import SPARE
from ilmek.machines.beat import Beat, BeatDrive, BeatPath, stroke_needed
from ilmek.machines.beat_up.beam import PAST_RAIL
from ilmek.machines.beat_up.beside_heads import checks_beside_heads, ground_beside_heads
from ilmek.machines.beat_up.crank_path import crank_beat, crank_path, rocker_outline
from ilmek.machines.beat_up.crank_start import crank_start
from ilmek.machines.beat_up.design import BeatUp, design, ground_for
from ilmek.machines.beat_up.hand import HAND, forearm_positions
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.beat_up.report import criteria
from ilmek.machines.beat_up.strength import beat_up_strength_checks, frame_force
from ilmek.machines.beat_up.tree import beside_beater, travelling
from ilmek.machines.beat_up.use import BeatUpUse, in_use, on_its_beam, use_checks
from ilmek.machines.beat_up.use_params import TravelParams
from ilmek.machines.fell_of_loom import loom_fabric
from ilmek.machines.linkage_strength import FLAT_BARS
from ilmek.machines.loom_task import LoomTask
from ilmek.part.bill import bill
from ilmek.records import record
from ilmek.report import Work
from ilmek.units import turn


def fit(task: LoomTask) -> BeatUpParams:
    """The paper's beat-up for the loom's warps: the force that its rows need, the time from beat to beat."""
    needed = float(loom_fabric(task).resistance(task.cloth.row_distance))
    every, stroke = task.period / 2, stroke_needed(task)
    hand = forearm_positions(stroke + SPARE * task.params.clearance) if task.weaver is None else HAND
    return BeatUpParams(
        hand=hand,
        speed=task.params.beat_speed,
        ground=ground_for(stroke, hand),
        beat_force=needed,
        interval=every if every > 0 else None,
        cloth=task.cloth,
        travel=TravelParams(
            warp_force=needed, bar_distance=_bar_distance(task), beam_length=task.rail_length + 2 * PAST_RAIL
        ),
    )


def _bar_distance(task: LoomTask) -> float:
    """Distance of the beater's bar from the warps [m]: as usual, or before the guide cams or the reed beside it."""
    usual = TravelParams().bar_distance
    return usual if task.side is None else max(usual, task.side.cam_front + SPARE * task.params.clearance)


def work(linkage: BeatUp) -> tuple[Work, ...]:
    """Work of a turn of the crank without recovery."""
    state = linkage.state
    step = turn / (state.angle.size - 1)
    return (Work("beating", float(np.sum(np.maximum(state.torque[:-1], 0.0)) * step), "beat"),)


@record
class TravellingBeat:
    """A beat by the travelling beater."""

    design: BeatUp
    use: BeatUpUse

    @property
    def beat(self) -> Beat:
        """All strokes across the width, from the start of the crank to its stop."""
        return crank_beat(self.use.start, self.use.travel)

    @property
    def path(self) -> BeatPath:
        """Path of the beater on its rocker."""
        return crank_path(self.use.start, self._outline)

    @property
    def _outline(self) -> tuple[ComplexArray, ...]:
        """The beater, and the rocker behind it."""
        return (*self.use.travel.beater.outline, rocker_outline(self.design))

    def drive(self, task: LoomTask) -> BeatDrive:
        """The same for the time from beat to beat."""
        fabric = loom_fabric(task)
        params = task.parameters("beat-up", replace(self.design.params, interval=fit(task).interval))
        made = _at_interval(self.design, params)
        duty = replace(self.use.start.duty, linkage=made, every=params.interval)
        use = on_its_beam(made, self.use.travel, crank_start(duty, params.start))
        across = use.travel
        moves = across.strokes + (2 if across.params.park else 0)
        sliding = moves * across.slide_mass * across.step.speed**2 / 2
        return BeatDrive(
            name="beat-up",
            design=made,
            task=task,
            beat=crank_beat(use.start, across),
            fabric=fabric,
            parts=bill(travelling(made, use)),
            work=(Work("beating", use.start.start_work + sliding, "beat"),),
            torque=use.start.start_torque,
            path=crank_path(use.start, self._outline),
            machine_checks=(*criteria(made), *use_checks(use)),
            crank_rockers=1,
            force=across.stroke_force,
            beaten=across.stroke_warps,
            frame_force=frame_force(made.state),
            loom_checks=checks_beside_heads(made, task.side, task.params.clearance, parked=True),
            striking=across.beater.ids,
            use=use,
        )


@lru_cache(maxsize=16)
def _at_interval(linkage: BeatUp, params: BeatUpParams) -> BeatUp:
    """The same linkage with another time from beat to beat, which decides on motor and flywheel alone."""
    return replace(linkage, params=params)


def planned_beat(task: LoomTask, _kind: str) -> TravellingBeat:
    """The travelling beater of a loom, its links as the paper's or stronger. Raises the errors of `beat_up.design`."""
    usual, fabric = fit(task), loom_fabric(task)
    for width, thickness in FLAT_BARS:
        usual = replace(usual, width=width, thickness=thickness)
        made = design(task.parameters("beat-up", usual))
        ground = ground_beside_heads(made, task.side, SPARE * task.params.clearance, parked=True)
        made = design(task.parameters("beat-up", replace(usual, ground=ground)))
        use = in_use(made, fabric)
        given = (made.params.width, made.params.thickness) != (width, thickness)
        if given or all(check.ok for check in beat_up_strength_checks(use.strength)):
            break
    if task.weaver is None:
        beside = beside_beater(made, use) + SPARE * task.params.clearance
        travel = replace(usual.travel, park=beside)
        made = design(task.parameters("beat-up", replace(usual, ground=made.params.ground, travel=travel)))
        use = in_use(made, fabric)
    return TravellingBeat(made, use)
