"""The comb that beats the rows of a loom: on crank-rockers, on axes of its own, or on the guide cams.      [thesis 3.3]

On axes it goes down, alone or with the whole cam system, presses, and goes up, as quickly as the loom's
`comb_acceleration` a allows: a stroke h by a law whose peak acceleration is Ca, down and up in a share (1 - q)/2 of the
time each and pressing for q, takes T = 2/(1 - q) sqrt(Ca h / a). On crank-rockers it takes a turn from rest to rest.
"""

import math
from dataclasses import replace
from itertools import chain

import numpy as np

from ilmek.cams.laws import LAWS
from ilmek.elements.materials import GRAVITY
from ilmek.machines import beat_up
from ilmek.machines.arrangement.spans import SPARE
from ilmek.machines.beat import GUIDED, Beat, BeatDrive, BeatPath, stroke_needed
from ilmek.machines.beat_up.beam import PAST_RAIL
from ilmek.machines.beat_up.beside_heads import checks_beside_heads, ground_beside_heads, room_under_baulks
from ilmek.machines.beat_up.crank_path import crank_beat, crank_path, rocker_outline
from ilmek.machines.beat_up.crank_start import CrankStart
from ilmek.machines.fell_of_loom import USUAL_WARP_LENGTH
from ilmek.machines.hammer.comb import BAR_ID, LEAF_ID
from ilmek.machines.hammer.design import Hammer, design
from ilmek.machines.hammer.linkage import chosen_linkage
from ilmek.machines.hammer.params import HammerParams
from ilmek.machines.hammer.report import checks
from ilmek.machines.hammer.tree import outline, tree
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.shedding.stack import part_id
from ilmek.machines.shedding.tree import tree as shedding_tree
from ilmek.machines.weft.carriers import CARRIAGE
from ilmek.machines.weft.shuttle import Shuttle
from ilmek.part.bill import bill
from ilmek.records import record
from ilmek.report import Check, Choice, Work, at_least, at_most, must
from ilmek.units import deg, mm, turn

ABOVE_SIGHT = 400 * mm
"""Of what crosses the loom before weavers, over the fell [m]: they see the fell below it; assumed by this project."""

_SHARES = 181

SWINGS = (None, 21 * deg, 18 * deg, 15 * deg)
"""Swings of a crank-rocker that are tried: the paper's, or such with which a longer one rises as high, its bar before
the reeds.
"""

_ROUNDS = 4
"""In which links and ground are made for each other, at most."""


def fit(task: LoomTask, kind: str = "comb") -> HammerParams:
    """The comb for the loom's warps and rows, within the row's time; with the shedding's cams on it for guide-cams."""
    beat = planned_beat(task, kind).beat
    return _in_the_row(_of_carpet(task, kind), task, beat, kind)


def _in_the_row(params: HammerParams, task: LoomTask, beat: Beat, kind: str) -> HammerParams:
    """The parameters with what follows from the row's time, and the mass of the cams."""
    return replace(
        params,
        shed_speed=turn / task.period,
        step=min(beat.time / task.period, 0.5) * turn,
        stack_mass=shedding_tree(task.shedding).mass if kind == GUIDED else 0.0,
    )


def _of_carpet(task: LoomTask, kind: str, swing: float | None = None) -> HammerParams:
    """The comb for the loom's warps and rows; what depends on the row's time is left as it is."""
    params, stroke = task.params, stroke_needed(task)
    return HammerParams(
        cloth=task.cloth,
        drive="linkage" if kind == "linkage" else "comb",
        warp_length=task.side.warp_length if task.side else USUAL_WARP_LENGTH,
        stroke=stroke,
        shed_speed=params.cam_speed,
        ground=beat_up.ground_for(stroke + SPARE * params.clearance, swing=swing),
        swing=swing,
        beam_length=task.rail_length + 2 * PAST_RAIL,
        stack_mass=0.0 if kind == "comb" else None,
        leaf_reach=_before_reeds(task) if kind != "linkage" or swing else None,
        axes_height=ABOVE_SIGHT if task.weaver is None else None,
    )


def _before_reeds(task: LoomTask) -> float | None:
    """Reach of leaves whose bar goes up before the reeds [m]; None where the usual one does."""
    if task.side is None:
        return None
    least = task.side.cam_front + SPARE * task.params.clearance
    return least if least > HammerParams().reach else None


def work(hammer: Hammer) -> tuple[Work, ...]:
    """Work of a beat: of the comb on its rows, and to lift all that moves; or of the crank-rockers with their start."""
    if hammer.linkage is not None:
        return (Work("beating", hammer.linkage.start.start_work, "beat"),)
    lifted = (1 - hammer.params.counterbalance) * hammer.mass * GRAVITY * hammer.params.stroke
    return (Work("beating", hammer.params.cloth.warps * hammer.energy + lifted, "beat"),)


def _carried(task: LoomTask) -> tuple[Check, ...]:
    """Whether there are guide cams that carry the leaves, on one shaft, with room to sink."""
    shedding = task.shedding
    cure = "set another beat, or shedding.guides=cams and a coarser pitch"
    return (
        must("guide cams that carry the leaves", shedding.guides == "cams", "thesis 3.3").with_cure(cure),
        at_most("cam shafts that go down with the comb", len(shedding.shafts), 1, "1", "thesis 3.3").with_cure(cure),
        *_over_shuttles(task),
    )


def _over_shuttles(task: LoomTask) -> tuple[Check, ...]:
    """Whether the guide cams that sink stay above what drags the shuttles behind the warps; none with a rapier."""
    side, laid = task.side, task.weft
    if side is None or not isinstance(laid.carried, Shuttle):
        return ()
    lowest = min(cam.at.imag - cam.guide_radius for cam in side.cams) - stroke_needed(task)
    highest = (side.carrier.corner + side.carrier.size).imag
    value, source = lowest - highest, "parameter clearance; the carriage runs behind the warps, below the cams"
    return (
        at_least(
            "clearance: guide cams that sink and carriage of the shuttle", value, task.params.clearance, "mm", source
        ).with_cure("set weft=rapier, or another beat", part_id("shedding-cam"), CARRIAGE),
    )


@record
class CombBeat:
    """A beat by the comb: its parameters without what depends on the row's time, and the start of its crank-rockers."""

    params: HammerParams
    acceleration: float
    kind: str
    start: CrankStart | None
    choices: tuple[Choice, ...] = ()

    @property
    def beat(self) -> Beat:
        """The comb's beat, as quick as its acceleration allows; of crank-rockers a turn of the crank."""
        if self.start is not None:
            return crank_beat(self.start)
        params = self.params
        law, share = LAWS[params.law], (1 - params.press_share) / 2
        time = math.sqrt(law.acceleration_peak * params.stroke / self.acceleration) / share
        return Beat(params.stroke, time, share, params.press_share, law, law, "vertical axes")

    @property
    def path(self) -> BeatPath:
        """Its path; straight down to the fell and up again where vertical axes drive it."""
        if self.start is not None:
            rocker = rocker_outline(self.start.duty.linkage)
            return crank_path(self.start, (*outline(self.params), rocker))
        return self._path(self.params)

    def drive(self, task: LoomTask) -> BeatDrive:
        """The comb at the period of the row, with the shedding's cams on it."""
        params = task.parameters("hammer", _in_the_row(self.params, task, self.beat, self.kind))
        hammer = design(params)
        hammer = replace(hammer, choices=(*self.choices, *hammer.choices))
        linkage = hammer.linkage
        force = linkage.frame_force if linkage else float(np.max(np.abs(hammer.axis.force))) if hammer.axis else 0.0
        return BeatDrive(
            name="hammer",
            design=hammer,
            task=task,
            beat=self.beat,
            fabric=hammer.fabric,
            parts=bill(tree(hammer)),
            work=work(hammer),
            torque=linkage.start.start_torque if linkage else 0.0,
            path=crank_path(linkage.start, (*outline(hammer.params), rocker_outline(linkage.one)))
            if linkage
            else self._path(hammer.params),
            machine_checks=checks(hammer),
            crank_rockers=linkage.number if linkage else 0,
            force=hammer.params.cloth.warps * hammer.force,
            beaten=hammer.params.cloth.warps,
            frame_force=force,
            striking=(LEAF_ID, BAR_ID),
            loom_checks=self._loom_checks(task, hammer),
        )

    def _loom_checks(self, task: LoomTask, hammer: Hammer) -> tuple[Check, ...]:
        """Room beside the heads of crank-rockers, and of guide cams that sink."""
        if hammer.linkage is not None:
            return checks_beside_heads(hammer.linkage.one, task.side, task.params.clearance)
        return _carried(task) if self.kind == GUIDED else ()

    def _path(self, params: HammerParams) -> BeatPath:
        """Straight down to the fell and up again."""
        beat, share = self.beat, np.linspace(0.0, 1.0, _SHARES)
        down = np.asarray(beat.law.s(np.clip(share / beat.forward, 0.0, 1.0)))
        up = np.asarray(beat.back_law.s(np.clip((share - beat.forward - beat.pressed) / beat.forward, 0.0, 1.0)))
        return BeatPath(outline(params), share, 1j * params.stroke * (1 - down + up))


def planned_beat(task: LoomTask, kind: str) -> CombBeat:
    """The comb's beat in a loom. Raises ParameterError where values set for it contradict each other."""
    params = task.parameters("hammer", _of_carpet(task, kind))
    if params.drive != "linkage":
        return CombBeat(params, task.params.comb_acceleration, kind, None)
    rockers = (_rockers(task, kind, swing) for swing in ((params.swing,) if params.swing else SWINGS))
    first = next(rockers)
    return next((made for made in chain((first,), rockers) if _under_reeds(made, task)), first)


def _rockers(task: LoomTask, kind: str, swing: float | None) -> CombBeat:
    """The comb on crank-rockers of a swing [rad], as long as heads and cams need."""
    params = task.parameters("hammer", _of_carpet(task, kind, swing))
    fabric, clearance = params.fabric, SPARE * task.params.clearance
    needed = float(fabric.resistance(params.cloth.row_distance))
    chosen, linkage, choices = chosen_linkage(params, fabric, needed)
    for _ in range(_ROUNDS):
        # A longer linkage may need other links, and these more room.
        ground = ground_beside_heads(linkage.one, task.side, clearance, outline(chosen)[1])
        params = task.parameters("hammer", replace(_of_carpet(task, kind, swing), ground=ground))
        if params.ground == chosen.ground:
            break
        chosen, linkage, choices = chosen_linkage(params, fabric, needed)
    return CombBeat(chosen, task.params.comb_acceleration, kind, linkage.start, choices)


def _under_reeds(made: CombBeat, task: LoomTask) -> bool:
    """Whether the comb at rest keeps clear of the baulks of reeds above it: a longer linkage rises more."""
    return task.side is None or room_under_baulks(made.path.at_rest, task.side) >= SPARE * task.params.clearance
