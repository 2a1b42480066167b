"""The automated loom for one carpet: its machines, sized by the carpet and timed together."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from functools import lru_cache

from ilmek.errors import LoomError
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.sharing import least_distance, share
from ilmek.loom.times import Times
from ilmek.machines import loom_parts
from ilmek.machines.arrangement.side_view import SideView, laid_out
from ilmek.machines.automated_loom.choice import BeatOption, beat_options
from ilmek.machines.automated_loom.cyclogram import (
    LOOM,
    WEAVERS,
    RowTiming,
    cyclogram,
    knot_cyclogram,
    shortest_passage,
    shortest_retreat,
    take_up_time,
    timed,
    weavers_row,
)
from ilmek.machines.automated_loom.knotting import KnottingHead, arms_alone, knotting_head, require_knot
from ilmek.machines.automated_loom.params import AUTO, AutomatedLoomParams
from ilmek.machines.automated_loom.search import LoomSearch, SearchJournal
from ilmek.machines.beat import Beat, BeatDrive, PlannedBeat
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.component import Child
from ilmek.machines.loom_task import LoomTask, MachineDesign
from ilmek.machines.shedding import SheddingDesign
from ilmek.machines.warp_tension import WarpTensionDesign
from ilmek.machines.weaver import Weaver
from ilmek.machines.weaver.tool_params import ArmsInHead
from ilmek.machines.weft import Weft
from ilmek.params import Params
from ilmek.records import record
from ilmek.report import BillLine, Choice
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.s_curve import move_time, travel_time
from ilmek.units import format_quantity, turn
from ilmek.weaving.warping import WarpEnd

BEFORE_THE_ROW = ("weft", "weaver", "shedding")
"""Machines whose designs set the timing of a row; all others are designed for it."""


@record
class LoomDesign:
    """A loom for one carpet.

    machines       its machines by name, in the order of the report: head, shedding, warp tension, ...
    task           of its machines                        side  the side view
    head           what ties the knots       beat  the drive of the beat
    knotters       heads or weavers who share a row, and knotters_max  the most that find room
    row_timing, row_cyclogram   of the wefts and beats of a row, one turn of the shedding cams
    knot_cyclogram              of a knot; of a row with its weavers where these tie
    times          of the acts of weaving, as the programme counts them
    journal        of the choice of what the parameters left open; `params` has what was chosen
    """

    params: AutomatedLoomParams
    rows: int
    columns: int
    knotters: int
    knotters_max: int
    machines: Mapping[str, Child]
    task: LoomTask
    side: SideView
    head: KnottingHead
    beat: BeatDrive
    row_timing: RowTiming
    row_cyclogram: Cyclogram
    knot_cyclogram: Cyclogram
    times: Times
    journal: SearchJournal = field(default_factory=SearchJournal)

    @property
    def search(self) -> LoomSearch | None:
        """The search in which it was chosen; None where nothing was left open."""
        return self.journal.search

    @property
    def choices(self) -> tuple[Choice, ...]:
        """The choices of what the parameters left open."""
        return self.search.choices if self.search else ()

    @property
    def heads(self) -> int:
        """Knotting heads; 0 where weavers tie."""
        return self.knotters if self.head.weaver else 0

    @property
    def heads_max(self) -> int:
        """The most heads that can share a row without meeting; 0 where weavers tie."""
        return self.knotters_max if self.head.weaver else 0

    @property
    def weavers(self) -> int:
        """Weavers who tie beside each other; 0 where heads do."""
        return self.knotters - self.heads

    @property
    def weaver(self) -> Weaver:
        """The knotting head. Raises KeyError where weavers tie."""
        return self.machines["weaver"].design_as(Weaver)

    @property
    def weft(self) -> Weft:
        """What lays the wefts."""
        return self.machines["weft"].design_as(Weft)

    @property
    def bobbins(self) -> tuple[Bobbin, ...]:
        """Bobbins of weft, for which the loom stops."""
        return self.weft.bobbins

    @property
    def shedding(self) -> SheddingDesign:
        """The shedding cams."""
        return self.machines["shedding"].design_as(SheddingDesign)

    @property
    def warp_tension(self) -> WarpTensionDesign:
        """The warp cylinders."""
        return self.machines["warp-tension"].design_as(WarpTensionDesign)

    @property
    def children(self) -> tuple[Child, ...]:
        """Every machine in the loom, in the order of the report."""
        machines = self.machines.items()
        of_head = tuple(child for name, child in machines if name in self.head.children)
        others = (child for name, child in machines if name not in self.head.children)
        return (*of_head, Child(MACHINES[self.beat.name], self.beat.design, self.beat.number), *others)

    @property
    def warps(self) -> int:
        """Warps: two for each knot of a row, and the selvedges'."""
        return self.task.cloth.warps

    def warp_guide(self, end: WarpEnd) -> str:
        """What lifts a warp: its cam."""
        cam, shaft = divmod(end.number - 1, len(self.shedding.shafts))
        return f"cam {cam + 1} of shaft {shaft + 1}"

    @property
    def knot_pitch(self) -> float:
        """Distance of two neighbouring knots [m]."""
        return self.task.cloth.knot_pitch

    @property
    def head_width(self) -> float:
        """Width of a head or a weaver, the least distance of two [m]."""
        return self.head.width

    @property
    def head_distance(self) -> float:
        """The least distance that two heads ever have [m]; inf for one head."""
        return least_distance(share(self.columns, self.heads), self.heads, self.knot_pitch)

    @property
    def tube(self) -> tuple[float, float]:
        """Outer diameter and wall of the warp cylinder [m]."""
        cylinder = self.warp_tension
        return 2 * cylinder.outer_radius, cylinder.outer_radius - cylinder.inner_radius

    @property
    def cyclograms(self) -> tuple[Cyclogram, Cyclogram]:
        """The cyclograms of a knot, or of a row with its weavers, and of wefts and beats."""
        return self.knot_cyclogram, self.row_cyclogram


@record
class ReadyLoom:
    """A loom as far as it does not depend on its beat.

    machines, task   the machines designed before the beat is chosen, and the task of the others
    head             what ties the knots
    options          kinds of beat that it may have, in ascending order of their prices
    """

    params: AutomatedLoomParams
    machines: Mapping[str, Child]
    task: LoomTask
    head: KnottingHead
    options: tuple[BeatOption, ...]

    @property
    def weft(self) -> Weft:
        """What lays the wefts."""
        return self.machines["weft"].design_as(Weft)


def head_for(params: AutomatedLoomParams) -> KnottingHead:
    """The head of a loom alone: neither its beat nor the number of heads and weavers changes it."""
    return _head_for(replace(params, beat=AUTO, heads=None, weavers=None))


@lru_cache(maxsize=32)
def _head_for(params: AutomatedLoomParams) -> KnottingHead:
    return knotting_head(_laid(params)[1])


def arms_for(params: AutomatedLoomParams) -> tuple[ArmsInHead, Sequence[BillLine]]:
    """The arms of a head alone: what the head has to know of them, and their parts. Raises as `head_for` does."""
    return arms_alone(_laid(params)[1])


def _laid(params: AutomatedLoomParams) -> tuple[Child, LoomTask]:
    """What lays the wefts, and the task with it: with it the design of a loom begins."""
    return _made("weft", LoomTask(params, *params.knot_grid, params.cloth, {}))


def ready_loom(params: AutomatedLoomParams) -> ReadyLoom:
    """The loom for a carpet up to its beat, of the kind of knotting that its parameters name.

    Raises LoomError where the shed leaves no time for the weft; CarpetError for a carpet without knots; the errors of
    the machines where their parameters contradict each other.
    """
    require_knot(params)
    laid, task = _laid(params)
    knotting = head_for(params)
    machines: dict[str, Child] = {**knotting.children, "weft": laid}
    task = replace(task, designs={name: child.design for name, child in machines.items()})
    machines["weft"], task = _made("weft", task)  # its devices beside the head
    machines["shedding"], task = _made("shedding", task)
    task = replace(task, side=laid_out(task))
    cams = task.shedding

    def timed_with(plan: PlannedBeat) -> tuple[LoomTask, RowTiming]:
        planned = replace(task, side=laid_out(task, plan.path))
        timing, period = _timed_row(params, _row_timing(planned, cams, plan.beat), cams)
        return replace(planned, period=period), timing

    return ReadyLoom(params, machines, task, knotting, beat_options(task, timed_with))


def with_beat(ready: ReadyLoom, option: BeatOption, journal: SearchJournal | None = None) -> LoomDesign:
    """The loom with one of its kinds of beat; one head where their number is open.

    journal  of the search that it is designed in

    Raises LoomError where more heads are given than fit.
    """
    params, knotting, task, timing, period = ready.params, ready.head, option.task, option.timing, option.period
    machines, rows, columns, weft = dict(ready.machines), task.rows, task.columns, task.weft
    machines["shedding"] = _at_period(machines["shedding"], timing.turning * period)
    times = times_at(params, knotting, task.cloth.knot_pitch, period)
    most = knotting.most(columns, task.cloth.knot_pitch)
    number = knotters(params, most, knotting)
    task = replace(
        task,
        designs={name: child.design for name, child in machines.items()},
        take_up_time=take_up_time(timing, period),
        row_time=knotting.least_time(1, columns, number, times),
    )
    beat = option.plan.drive(task)
    task = replace(task, beat=beat)
    for name in loom_parts():
        if name not in BEFORE_THE_ROW:
            machines[name], task = _made(name, task)
    side = laid_out(task, beat.path)
    timing = replace(timing, retreat=side.heads.retreat if side.heads else None)
    machines |= {name: replace(machines[name], number=number) for name in knotting.children}
    chosen = replace(params, beat=option.kind, weft=weft.carrier)
    if knotting.weaver:
        chosen = replace(chosen, heads=number, knot_cycle=knotting.weaver.params.cycle)
    else:
        chosen = replace(chosen, weavers=number)
    return LoomDesign(
        params=chosen,
        rows=rows,
        columns=columns,
        knotters=number,
        knotters_max=most,
        machines=machines,
        task=task,
        side=side,
        head=knotting,
        beat=beat,
        row_timing=timing,
        row_cyclogram=_row_cyclogram(timing, period, machines),
        knot_cyclogram=knot_cyclogram(knotting.weaver, times.knot)
        if knotting.weaver
        else weavers_row(((WEAVERS, "knots", task.row_time - period), (LOOM, "wefts and beats", period))),
        times=times,
        journal=journal or SearchJournal(),
    )


def _at_period(shedding: Child, period: float) -> Child:
    """The shedding cams at the time of a row's wefts and beats [s], slower where these need more time."""
    params = shedding.design_as(SheddingDesign).params
    if period <= turn / params.speed:
        return shedding
    return Child(shedding.component, _designed("shedding", replace(params, speed=turn / period)))


def _row_cyclogram(timing: RowTiming, period: float, machines: Mapping[str, Child]) -> Cyclogram:
    """The cyclogram of a row with the tracks of all machines."""
    row = cyclogram(timing, period)
    tracks = (track for child in machines.values() for track in child.component.tracks(child.design))
    return replace(row, tracks=(*row.tracks, *tracks))


def _made(name: str, task: LoomTask) -> tuple[Child, LoomTask]:
    """A machine designed for the task, and the task with it."""
    component = MACHINES[name]
    assert component.fit is not None
    made = _designed(name, task.parameters(name, component.fit(task)))
    return Child(component, made), replace(task, designs={**task.designs, name: made})


@lru_cache(maxsize=64)
def _designed(name: str, params: Params) -> MachineDesign:
    """A machine, designed once for each set of parameters: looms that differ elsewhere share it."""
    design: MachineDesign = MACHINES[name].design(params)
    return design


def times_at(params: AutomatedLoomParams, knotting: KnottingHead, knot_pitch: float, weft: float) -> Times:
    """Times of the acts of weaving [s] at a pitch of the knots [m], with the time of wefts and beats of a row [s].

    A step to the next knot that is longer than a head leaves for it lengthens the knot. The knots of a weaver's day
    count all that she does for them.
    """
    head = knotting.weaver
    if head is None:
        return Times(params.hand_knot, 0.0, 0.0, weft)
    carriage = head.params.carriage
    late = max(0.0, move_time(knot_pitch, carriage) - head.carriage_window)
    return Times(head.cycle + late, head.colour_change, travel_time(knot_pitch, head.carriage_window, carriage), weft)


def of_mean_cell(times: Times, params: AutomatedLoomParams) -> Times:
    """The times with that of a mean cell as the knot's: a knot with its colour changes, where there is one."""
    return replace(times, knot=params.knotted_share * (times.knot + params.changes_per_knot * times.colour_change))


def knotters(params: AutomatedLoomParams, most: int, knotting: KnottingHead) -> int:
    """Number of heads, or of weavers; one head, or all weavers that fit, where it is open.

    Raises LoomError where more are given than fit.
    """
    head = knotting.weaver is not None
    noun, given = ("head", params.heads) if head else ("weaver", params.weavers)
    if given is not None and given > most:
        width, each = format_quantity(params.width, "m"), format_quantity(knotting.width, "mm")
        allowed = f"at most {most}: neighbours keep half a {noun}'s share of the row between them"
        do = f"set {noun}s={most}{', or narrower heads' if head else ''}"
        raise LoomError(f"{given} {noun}s of {each} do not fit a carpet {width} wide", allowed=allowed, do=do)
    return given or (1 if head else most)


def _row_timing(task: LoomTask, cams: SheddingDesign, beat: Beat) -> RowTiming:
    params, weft = task.params, task.weft
    assert task.side is not None
    return RowTiming(
        lift=cams.params.lift,
        law=cams.params.law,
        window=cams.shuttle_window,
        carrier=weft.carrier,
        passage=weft.passage,
        beat=beat,
        beat_end=params.beat_end,
        row_pitch=task.cloth.row_distance,
        take_up_end=params.take_up_end,
        retreat=task.side.heads.retreat if task.side.heads else None,
    )


def _timed_row(params: AutomatedLoomParams, timing: RowTiming, cams: SheddingDesign) -> tuple[RowTiming, float]:
    """The timing and the time of a row [s]: a turn of the shedding cams as given, or the shortest that weft, heads and
    beat allow.
    """
    shed, window, name = format_quantity(timing.lift, "mm"), timing.window, timing.carrier
    if window[1] - window[0] < 1e-6:
        given = f"a shed of {shed} is never as open as open_share={params.open_share:g} of it"
        raise LoomError(given, allowed=f"an opening that lasts, for the {name} to pass", do="set a smaller open_share")
    heads = shortest_retreat(timing, params.retreat_speed, params.retreat_acceleration)
    turned = max(turn / cams.params.speed, shortest_passage(timing), heads)
    found, period = timed(timing, turned, params.shed_stop)
    if not math.isfinite(period):
        given = f"the beater is to be back at {format_quantity(params.beat_end, 'deg')}"
        allowed = f"the shed is free of the {name} from {format_quantity(window[1], 'deg')} on"
        raise LoomError(given, allowed=allowed, do="set a later beat_end, or a larger open_share for a shorter passage")
    if params.take_up_end <= params.beat_end:
        raise LoomError("the take-up ends before the beat", do="set take_up_end after beat_end")
    return found, period
