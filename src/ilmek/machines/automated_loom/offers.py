"""The finite choices of a loom with a bound of each: what its carpet takes, and what it and its carpet cost at least.

    choices   kind of knotting x time of a knot x carrier of the weft x beat x heads
    time      rows * (wefts and beats + knots of the widest parts * time of a knot) + stops, of `estimate`
    price     heads * parts of a head + parts of all other machines + frame and equipment of a designed loom
    cost      that of this time on a loom of this price, with the standby power of its axes  [`cost`]

All other machines are designed for each carrier and beat: heads and their knots do not change them. The head is that
of the slowest knot, the frame that of the loom with the fewest heads, the equipment that of the first loom that was
designed, both less `OTHER_SLACK`. Nearer bounds have the head of the time of the knot, the frame of the carrier and the
beat with the fewest heads, and the equipment of designed looms with the carrier, less a share for each head that they
have more; the nearest the frame of the loom itself. A head by arms has the parts of the arms, and `ARMS_REST` of one on
cams, until it is designed.

The time is that of the slowest head: of 265 looms of a carpet of 0.51 x 0.55 m it was up to 2.2 % too long. That frame
and equipment are no cheaper with more heads or quicker knots is no proof, as sizes are steps of tables: `SLACK` is left
for it. Of 992 looms of the usual carpet designed one by one (`every_loom` of `make campaigns`) the cheapest frame costs
1.6 % less than that with the fewest heads and the slowest knot, of arms, equipment 0.02 % less, of another beat 1.6 %,
a head 0.5 % less than the slowest.
"""

import contextlib
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import chain
from typing import Any

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.prices import PriceRates, read_prices
from ilmek.errors import IlmekError, LoomError, ParameterError
from ilmek.loom.times import Times
from ilmek.machines import WEFT_CARRIERS
from ilmek.machines.automated_loom.cabinet import AMPLIFIER
from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.choice import BeatOption
from ilmek.machines.automated_loom.cost import rates_of, standstill_of
from ilmek.machines.automated_loom.design import (
    LoomDesign,
    ReadyLoom,
    arms_for,
    knotters,
    of_mean_cell,
    ready_loom,
    times_at,
    with_beat,
)
from ilmek.machines.automated_loom.equipment.tree import OF_A_HEAD, more_for_heads
from ilmek.machines.automated_loom.knotting import ARMS, CAMS, KnottingHead
from ilmek.machines.automated_loom.machine_cost import Fitting, MachineCost, machine_cost, with_control
from ilmek.machines.automated_loom.params import AUTO, COST, PRICE, TIME, AutomatedLoomParams
from ilmek.machines.automated_loom.parts import own_lines, parts_of_loom
from ilmek.machines.automated_loom.report import LoomAnalysis
from ilmek.machines.automated_loom.search import LoomOffer, SearchJournal
from ilmek.machines.beat import GUIDED
from ilmek.machines.weaver.design import ties_in_time
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver_hands import HAND
from ilmek.machines.weft.params import SHUTTLE
from ilmek.records import record

_FROM_2 = (2.0, 1.9, 1.8, 1.7, 1.6, 1.5, 1.4, 1.32, 1.25, 1.18, 1.12, 1.06)
_FROM_1 = (1.0, 0.95, 0.9, 0.85, 0.8, 0.75, 0.71, 0.67, 0.63, 0.6, 0.56, 0.53, 0.5)
CYCLES = (*_FROM_2, *_FROM_1)
"""Times of a knot [s] that are offered: preferred numbers, R 40 in the rounding R' 40. [ISO 3]"""

SLACK = 0.03
"""Share by which frame, equipment and the head of the slowest knot are lowered, for the steps of tables."""

OTHER_SLACK = 0.25
"""The same, of a loom with another carrier or another beat: another frame, a wider fence."""

ROUNDING = 0.001
"""Share by which a bound is lowered for what differs between heads and beats of other carriers and times of a knot."""

ARM_SERVOS = 5
"""Servos of the arms of a head, the least of their parts."""

ARMS_REST = 0.7
"""Share of a head on cams that one by arms has at least: it lacks the grippers with their cams."""


@record
class HeadBranch:
    """A kind of knotting with a carrier of the weft: the loom of the slowest knot up to its beat, and its times.

    kind    of knotting     cycles  that can be chosen [s], the slowest first     most  heads that fit
    head    the least cost of one                 looms  with the fewest heads and each kind of beat
    """

    kind: str
    ready: ReadyLoom
    cycles: tuple[float, ...]
    most: int
    head: MachineCost
    looms: Mapping[str, LoomDesign]

    @property
    def weft(self) -> str:
        """The carrier of the weft; auto where the weft side chooses it."""
        return self.ready.params.weft


@lru_cache(maxsize=32)
def machines_cost(loom: LoomDesign) -> MachineCost:
    """The cost of all machines of a loom but its heads."""
    others = (child.parts for name, child in loom.machines.items() if name not in loom.head.children)
    return machine_cost((*chain.from_iterable(others), *loom.beat.parts), read_prices(loom.params.prices))


@lru_cache(maxsize=32)
def frame_cost(loom: LoomDesign) -> MachineCost:
    """The cost of the frame of a loom with all that it carries beside the machines, without the control of the axes."""
    listed = parts_of_loom(loom)
    return machine_cost((line for line in own_lines(loom, listed) if line.part != AMPLIFIER), listed.prices)


def head_cost(head: KnottingHead, prices: Mapping[str, PriceRates]) -> MachineCost:
    """The cost of the machines of a head."""
    return machine_cost((line for child in head.children.values() for line in child.parts), prices)


def branches(params: AutomatedLoomParams, kind: str, journal: SearchJournal) -> tuple[HeadBranch, ...]:
    """The branches of a kind of knotting, one for each carrier of the weft that is open.

    For the least price the weft side chooses its carrier, the cheaper one, itself.
    """
    looms = [_slowest(replace(params, knotting=kind, weft=weft)) for weft in _wefts(params)]
    knotting = looms[0].head
    if knotting.weaver is None:
        cycles: tuple[float, ...] = (params.hand_knot,)
    else:
        cycles = _cycles(knotting.weaver.params) if _quicker(params) else (_slowest_cycle(params),)
    fit = knotting.most(looms[0].task.columns, looms[0].task.cloth.knot_pitch)
    least = [head_cost(ready.head, read_prices(params.prices)).share(1 - SLACK) for ready in looms]
    return tuple(
        HeadBranch(kind, ready, cycles, fit, cost, _looms(ready, journal))
        for ready, cost in zip(looms, least, strict=True)
    )


def only_loom(params: AutomatedLoomParams) -> ReadyLoom | None:
    """The one loom up to its beat whose parameters leave nothing open; None where they leave something."""
    by_hand = params.knotting == HAND
    given = params.heads is not None or by_hand
    kinds = AUTO not in (params.knotting, params.beat) and len(_wefts(params)) == 1
    return _slowest(params) if given and kinds and (by_hand or not _quicker(params)) else None


def any_loom(params: AutomatedLoomParams) -> bool:
    """Whether there is a loom with heads on cams to choose, good or not: the slowest, with some weft and some beat."""
    try:
        return any(branch.looms for branch in branches(params, CAMS, SearchJournal()))
    except IlmekError:
        return False


def _wefts(params: AutomatedLoomParams) -> tuple[str, ...]:
    return WEFT_CARRIERS if params.weft == AUTO and params.aim != PRICE else (params.weft,)


def _quicker(params: AutomatedLoomParams) -> bool:
    """Whether knots quicker than the slowest one are offered."""
    return params.knot_cycle is None and (params.aim != PRICE or params.deadline is not None)


def _slowest(params: AutomatedLoomParams) -> ReadyLoom:
    """The loom of the slowest knot up to its beat."""
    return ready_loom(replace(params, knot_cycle=None if params.knotting == HAND else _slowest_cycle(params)))


def _slowest_cycle(params: AutomatedLoomParams) -> float:
    return params.knot_cycle or WeaverParams().cycle


def _looms(ready: ReadyLoom, journal: SearchJournal) -> Mapping[str, LoomDesign]:
    """The loom with each kind of beat, those whose drive holds first; what cannot be designed is left out."""
    looms: dict[str, LoomDesign] = {}
    for option in sorted(ready.options, key=lambda option: any(not check.ok for check in option.checks)):
        with contextlib.suppress(LoomError, ParameterError):
            looms[option.kind] = with_beat(ready, option, journal)
    return looms


def undesigned_arms(cams: Sequence[HeadBranch], *, designed: bool) -> tuple[HeadBranch, ...]:
    """The branches of looms by arms, before their heads are designed, from those with cams; none where no arms tie so.

    designed  whether the arms themselves are: else they tie in no time, and have their servos alone
    """
    ready, own = cams[0].ready, cams[0].cycles
    assert ready.head.weaver is not None
    head, prices = ready.head.weaver.params, read_prices(ready.params.prices)
    inside = replace(head.arms, time=1e-3, yarn=0.0)
    arms = MachineCost(ARM_SERVOS * prices["servo"].each, fitting=Fitting(ARM_SERVOS, axes=ARM_SERVOS))
    if designed:
        try:
            inside, parts = arms_for(ready.params)
        except (LoomError, ParameterError):
            return ()
        arms = machine_cost(parts, prices)
    cycles = _cycles(replace(head, arms=inside)) if len(own) > 1 else own
    heads = (arms.plus(branch.head.share(ARMS_REST)) for branch in cams)
    return tuple(
        replace(branch, kind=ARMS, cycles=cycles, head=least) for branch, least in zip(cams, heads, strict=True)
    )


def _cycles(head: WeaverParams) -> tuple[float, ...]:
    """The times of a knot that are offered [s], down to the quickest that a head ties in."""
    low, high = 0, len(CYCLES)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if ties_in_time(replace(head, cycle=CYCLES[middle])) else (low, middle)
    return CYCLES[: low + 1]


@record
class LoomRest:
    """What a designed loom costs without its machines and the control of its axes.

    frame      with all that it carries           creel      and sensors that each head has, for one of them
    equipment  all other                          more       pieces of a head in what of it is more for more heads
    """

    offer: LoomOffer
    frame: MachineCost
    equipment: MachineCost
    creel: MachineCost
    more: MachineCost
    cost: CarpetCost

    def equipment_for(self, heads: int) -> MachineCost:
        """The least cost of the equipment of a loom with another number of heads."""
        return self.equipment.plus(self.more.times(-max(0, self.offer.heads - heads)))


def rest_of(offer: LoomOffer, found: LoomAnalysis) -> LoomRest:
    """The rest of the designed loom of an offer."""
    loom, listed, more = found.loom, found.listed, more_for_heads(found.loom)
    before = {line.part for line in parts_of_loom(loom).parts} | OF_A_HEAD
    others = [line for line in listed.parts if line.part not in before]
    shared, of_a_head = [line for line in others if line.part in more], [p for p in listed.parts if p.part in OF_A_HEAD]
    creel, share = (machine_cost(lines, listed.prices).times(1 / loom.knotters) for lines in (of_a_head, shared))
    pieces = replace(share, batches=0.0)
    return LoomRest(offer, frame_cost(loom), machine_cost(others, listed.prices), creel, pieces, found.cost)


def bare_rest(offer: LoomOffer, loom: LoomDesign) -> LoomRest:
    """The rest of a loom that is not designed whole: its frame without equipment, on no floor."""
    params, none = loom.params, MachineCost(0.0)
    dressing, area = float(params.dressing.dressing_time), params.width * params.length
    rates, knots = rates_of(loom, loom.weavers), params.knots
    cost = CarpetCost(rates, knots, area, 1.0, 0.0, dressing, 0.0, none, standstill_of(loom))
    return LoomRest(offer, frame_cost(loom), none, none, none, cost)


@record
class Bounds:
    """The least time, price and cost of looms, from those that were designed.

    frame  of the loom with the fewest heads and the slowest knot, with another carrier or beat
    rests  of the designed looms, by their choices; each is added, so that bounds rise
    """

    params: AutomatedLoomParams
    prices: Mapping[str, PriceRates]
    frame: MachineCost
    rests: dict[tuple[object, ...], LoomRest]

    def offers(self, branch: HeadBranch) -> Iterator[LoomOffer]:
        """The offers of a branch that can keep the deadline and the limit of the price, with their bounds."""
        kept = [offer for offer in self._offers(branch) if self.wished(offer.time, offer.price)]
        if self.params.aim != PRICE:
            return iter(kept)
        # A quicker knot is not cheaper: of each beat and number of heads the slowest that keeps the deadline.
        return iter({(offer.beat, offer.heads): offer for offer in reversed(kept)}.values())

    def wished(self, time: float, price: float) -> bool:
        """Whether a time [s] and a price keep the deadline and the limit of the price."""
        limit = self.params.price_limit
        return time <= (self.params.deadline or math.inf) and price <= (math.inf if limit is None else limit)

    def _offers(self, branch: HeadBranch) -> Iterator[LoomOffer]:
        ready, params, weft = branch.ready, self.params, branch.weft
        grid, bobbins = (ready.task.rows, ready.task.columns), ready.weft.bobbins
        for option in ready.options:
            if option.kind == GUIDED and weft == SHUTTLE and params.weft == AUTO:  # no room for shuttles' carriages
                continue
            if option.kind not in branch.looms:
                continue
            loom, alike = branch.looms[option.kind], (self.simplest.offer.weft, self.simplest.offer.beat)
            frame = self._frame(loom) if (weft, option.kind) == alike else self.frame.share(1 - OTHER_SLACK)
            number = params.heads or (knotters(params, branch.most, ready.head) if ready.head.weaver is None else 0)
            busy = [_least_times(ready, option, cycle) for cycle in branch.cycles]
            for heads in (number,) if number else range(1, branch.most + 1):
                cost, floor = self._least(weft, heads, loom, branch.head, frame)
                time = ready.head.least_times(*grid, heads, busy, bobbins)
                value = self._value(cost, floor, np.array(time)).tolist()
                for cycle, own, least in zip(branch.cycles, time, value, strict=True):
                    yield LoomOffer(branch.kind, cycle, weft, option.kind, heads, own, cost.parts, least)

    def nearer(
        self, offer: LoomOffer, loom: LoomDesign, head: MachineCost, frame: MachineCost | None = None
    ) -> LoomOffer:
        """The offer with its bounds by a head, by the frame of a loom, and by the equipment of the designed ones.

        loom  with its carrier of the weft and its beat, the slowest knot and the fewest heads; its own with its frame
        """
        cost, floor = self._least(offer.weft, offer.heads, loom, head, frame or self._frame(loom))
        value = float(self._value(cost, floor, np.array(offer.time)))
        return replace(offer, price=cost.parts, value=value)

    def _frame(self, loom: LoomDesign) -> MachineCost:
        """The least cost of a frame, by that of a loom; by another's where it has no room for one."""
        with contextlib.suppress(ParameterError):
            return frame_cost(loom).share(1 - SLACK)
        return self.frame.share(1 - OTHER_SLACK)

    def _least(
        self, weft: str, heads: int, loom: LoomDesign, head: MachineCost, frame: MachineCost
    ) -> tuple[MachineCost, float]:
        """The least cost of a loom, and its floor [m²], with a number of heads, and a frame."""
        alike = [rest for rest in self.rests.values() if rest.offer.weft == weft]
        share = 1 - (SLACK if alike else OTHER_SLACK)
        rest = max(alike or [self.simplest], key=lambda rest: rest.equipment_for(heads).parts)
        cost = frame.plus(rest.equipment_for(heads).share(share)).plus(machines_cost(loom))
        cost = with_control(cost.plus(head.plus(rest.creel).times(heads)), self.prices)
        return cost.share(1 - ROUNDING), share * rest.cost.floor

    @property
    def simplest(self) -> LoomRest:
        """The rest of the first loom that was designed."""
        return next(iter(self.rests.values()))

    def _value(self, cost: MachineCost, floor: float, time: FloatArray) -> FloatArray:
        """The least of what the aim makes least, of a loom with each of some times [s]."""
        if self.params.aim == TIME:
            return time
        if self.params.aim == PRICE:
            return np.full(time.shape, cost.parts)
        each: Any = time  # the cost is a formula: of all times at once
        energy = self.params.standby_power * cost.axes * each
        least = replace(self.simplest.cost, time=each, energy=energy, floor=floor, machine=cost)
        return np.asarray((1 - ROUNDING) * least.cost_per_carpet)


def value_of(found: LoomAnalysis, aim: str) -> float:
    """What a loom has of what its aim makes least: time [s], price of its parts, or cost of a carpet."""
    values: dict[str, float] = {TIME: found.time, PRICE: found.listed.price, COST: found.cost.cost_per_carpet}
    return values[aim]


def _least_times(ready: ReadyLoom, option: BeatOption, cycle: float) -> Times:
    """The least times of the acts with a time of the knot [s]; the step to the next knot may take longer."""
    head, params, task = ready.head.weaver, ready.params, ready.task
    times = times_at(params, ready.head, task.cloth.knot_pitch, option.period)
    tied = replace(times, knot=cycle * (head.cycle / head.params.cycle if head else 1))
    return of_mean_cell(tied, params)
