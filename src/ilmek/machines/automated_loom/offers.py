"""The finite choices of a loom with a bound of each: what its carpet takes, and what it and its carpet cost at least.

    choices   kind of knotting x time of a knot x carrier of the weft x beat x heads
    time      rows * (wefts and beats + knots of the widest parts * time of a knot) + stops, of `estimate`
    price     heads * parts of a head + parts of weft and beat + all other parts of the simplest loom
    cost      that of this time on a loom of this price, with the standby power of its axes  [`cost`]

The simplest loom has the first of each kind, the slowest knot and the fewest heads. So the bounds hold where no frame,
cylinder, guard or cabinet is cheaper for more heads, for a quicker knot or for another kind. Sizes are steps of tables:
`SLACK` is left for a step down. A head by arms is taken as dearer than one on cams by half of its servos, until it is
designed. A test holds the bounds against all looms of a table.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from ilmek.elements.prices import PriceRates, read_prices
from ilmek.machines import WEFT_CARRIERS
from ilmek.machines.automated_loom.choice import BeatOption
from ilmek.machines.automated_loom.cost import MachineCost, machine_cost, with_control
from ilmek.machines.automated_loom.design import ReadyLoom, knotters, ready_loom, times_at, with_changes
from ilmek.machines.automated_loom.equipment.tree import OF_A_HEAD
from ilmek.machines.automated_loom.knotting import ARMS, KnottingHead
from ilmek.machines.automated_loom.params import AUTO, COST, HAND, PRICE, TIME, AutomatedLoomParams
from ilmek.machines.automated_loom.report import LoomAnalysis
from ilmek.machines.automated_loom.search import LoomOffer
from ilmek.machines.automated_loom.standing_frame import AMPLIFIER
from ilmek.machines.beat import GUIDED
from ilmek.machines.weaver.design import ties_in_time
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weft.params import SHUTTLE
from ilmek.records import record

_FROM_2 = (2.0, 1.9, 1.8, 1.7, 1.6, 1.5, 1.4, 1.32, 1.25, 1.18, 1.12, 1.06)
_FROM_1 = (1.0, 0.95, 0.9, 0.85, 0.8, 0.75, 0.71, 0.67, 0.63, 0.6, 0.56, 0.53, 0.5)
CYCLES = (*_FROM_2, *_FROM_1)
"""Times of a knot [s] that are offered: preferred numbers, R 40 in the rounding R' 40. [ISO 3]"""

SLACK = 0.003
"""Share by which a bound of price or cost is lowered for the steps of tables, by a loom of the same kinds."""

OTHER_SLACK = 0.015
"""The same, by a loom of other kinds: another beat, another frame."""

ARM_SERVOS = 4
"""Servos of the arms of a head; two of them are counted for the price: it lacks the cams of the grippers."""


@record
class HeadBranch:
    """A kind of knotting with a carrier of the weft: the loom of the slowest knot up to its beat, and its times.

    kind    of knotting     cycles  that can be chosen [s], the slowest first     most  heads that fit
    head    the cost of one                       beats  that of the weft side with each kind of beat
    """

    kind: str
    ready: ReadyLoom
    cycles: tuple[float, ...]
    most: int
    head: MachineCost
    beats: Mapping[str, MachineCost]

    @property
    def weft(self) -> str:
        """The carrier of the weft; auto where the weft side chooses it."""
        return self.ready.params.weft

    def others(self, beat: str) -> MachineCost:
        """The cost of the weft side and of a kind of beat."""
        return self.beats[beat]


def head_cost(head: KnottingHead, prices: Mapping[str, PriceRates]) -> MachineCost:
    """The cost of the machines of a head."""
    return machine_cost((line for child in head.children.values() for line in child.parts), prices)


def branches(params: AutomatedLoomParams, kind: str) -> tuple[HeadBranch, ...]:
    """The branches of a kind of knotting, one for each carrier of the weft that is open.

    For the least price the weft side chooses its carrier, the cheaper one, itself.
    """
    wefts = WEFT_CARRIERS if params.weft == AUTO and params.aim != PRICE else (params.weft,)
    usual = WeaverParams().cycle
    slowest = params.knot_cycle or usual
    cycle = None if kind == HAND else slowest
    looms = [ready_loom(replace(params, knotting=kind, weft=weft, knot_cycle=cycle)) for weft in wefts]
    knotting = looms[0].head
    quicker = params.knot_cycle is None and (params.aim != PRICE or params.deadline is not None)
    if knotting.weaver is None:
        cycles: tuple[float, ...] = (params.hand_knot,)
    else:
        cycles = _cycles(knotting.weaver.params) if quicker else (slowest,)
    fit = knotting.most(looms[0].task.columns, looms[0].task.cloth.knot_pitch)
    return tuple(_branch(kind, ready, cycles, fit) for ready in looms)


def _branch(kind: str, ready: ReadyLoom, cycles: tuple[float, ...], most: int) -> HeadBranch:
    prices, weft = read_prices(ready.params.prices), ready.machines["weft"].parts
    beats = {option.kind: machine_cost((*weft, *option.drive.parts), prices) for option in ready.options}
    return HeadBranch(kind, ready, cycles, most, head_cost(ready.head, prices), beats)


def undesigned_arms(branch: HeadBranch) -> HeadBranch:
    """The branch of looms with arms, before these are designed, from that with cams: arms that take no time to tie."""
    servo = read_prices(branch.ready.params.prices)["servo"].each
    assert branch.ready.head.weaver is not None
    head, own = branch.ready.head.weaver.params, branch.cycles
    no_time = replace(head, arms=replace(head.arms, time=1e-3, yarn=0.0))
    extra = MachineCost(ARM_SERVOS / 2 * servo, 0, ARM_SERVOS)
    return replace(branch, kind=ARMS, cycles=_cycles(no_time) if len(own) > 1 else own, head=branch.head.plus(extra))


def _cycles(head: WeaverParams) -> tuple[float, ...]:
    """The times of a knot that are offered [s], down to the quickest that a head ties in."""
    low, high = 0, len(CYCLES)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if ties_in_time(replace(head, cycle=CYCLES[middle])) else (low, middle)
    return CYCLES[: low + 1]


@record
class LoomRest:
    """What a designed loom costs without its heads, its weft side, its beat and the control of its axes.

    creel  the cost of what of the creel, and of the sensors, is for one head
    """

    offer: LoomOffer
    rest: MachineCost
    creel: MachineCost
    floor: float

    def bounds(self, offer: LoomOffer) -> bool:
        """Whether the rest of an offer costs no less: of the same kinds, with as many heads and as quick a knot."""
        own = self.offer
        alike = (own.knotting, own.weft, own.beat) == (offer.knotting, offer.weft, offer.beat)
        return alike and own.heads <= offer.heads and own.cycle >= offer.cycle


def rest_of(offer: LoomOffer, found: LoomAnalysis) -> LoomRest:
    """The rest of the designed loom of an offer."""
    loom, listed = found.loom, found.listed
    own = {line.part for name in loom.head.children for line in loom.machines[name].parts}
    exchanged = own | {AMPLIFIER} | {line.part for line in (*loom.machines["weft"].parts, *loom.beat.parts)}
    rest = [line for line in listed.parts if line.part not in exchanged | OF_A_HEAD]
    creel = machine_cost((line for line in listed.parts if line.part in OF_A_HEAD), listed.prices)
    return LoomRest(offer, machine_cost(rest, listed.prices), creel.times(1 / loom.knotters), found.cost.floor)


@record
class Bounds:
    """The least time, price and cost of looms, from those that were designed.

    simplest  the first of them      rests  of all of them; each designed loom is added, so that bounds rise
    """

    params: AutomatedLoomParams
    simplest: LoomAnalysis
    rests: list[LoomRest]

    def offers(self, branch: HeadBranch) -> Iterator[LoomOffer]:
        """The offers of a branch that can keep the deadline and the limit of the price, with their bounds."""
        params = self.params
        latest, most = params.deadline or math.inf, params.price_limit or math.inf
        kept = [offer for offer in self._offers(branch) if offer.time <= latest and offer.price <= most]
        if params.aim != PRICE:
            return iter(kept)
        # A quicker knot is not cheaper: of each beat and number of heads the slowest that keeps the deadline.
        return iter({(offer.beat, offer.heads): offer for offer in reversed(kept)}.values())

    def _offers(self, branch: HeadBranch) -> Iterator[LoomOffer]:
        ready, params, weft = branch.ready, self.params, branch.weft
        for option in ready.options:
            if option.kind == GUIDED and weft == SHUTTLE and params.weft == AUTO:  # no room for shuttles' carriages
                continue
            number = params.heads or (knotters(params, branch.most, ready.head) if ready.head.weaver is None else 0)
            for heads in (number,) if number else range(1, branch.most + 1):
                for cycle in branch.cycles:
                    time = _least_time(ready, option, cycle, heads)
                    offer = LoomOffer(branch.kind, cycle, weft, option.kind, heads, time, 0.0, 0.0)
                    yield self.bounded(offer, branch, branch.head)

    def bounded(self, offer: LoomOffer, branch: HeadBranch, head: MachineCost) -> LoomOffer:
        """The offer with the greatest of its bounds by the designed looms that are not above it; head: its cost."""
        alike = [one for one in self.rests if one.bounds(offer)]
        slack = SLACK if alike else OTHER_SLACK
        costs = [
            (self._cost(one, branch.others(offer.beat), head, offer.heads), one.floor)
            for one in alike or self.rests[:1]
        ]
        cost, floor = max(costs, key=lambda one: one[0].parts)
        return replace(offer, price=(1 - slack) * cost.parts, value=self._value(cost, floor, offer.time, slack))

    def _cost(self, one: LoomRest, others: MachineCost, head: MachineCost, heads: int) -> MachineCost:
        cost = one.rest.plus(others).plus(head.plus(one.creel).times(heads))
        return with_control(cost, self.simplest.listed.prices)

    def _value(self, cost: MachineCost, floor: float, time: float, slack: float) -> float:
        if self.params.aim == TIME:
            return time
        if self.params.aim == PRICE:
            return (1 - slack) * cost.parts
        made, sold = cost.sold(self.params.cost)
        energy = self.params.standby_power * cost.axes * time
        least = replace(self.simplest.cost, time=time, energy=energy, floor=floor, made=made, sold=sold)
        carpet: float = least.cost_per_carpet
        return (1 - slack) * carpet


def value_of(found: LoomAnalysis, aim: str) -> float:
    """What a loom has of what its aim makes least: time [s], price of its parts, or cost of a carpet."""
    values: dict[str, float] = {TIME: found.time, PRICE: found.listed.price, COST: found.cost.cost_per_carpet}
    return values[aim]


def _least_time(ready: ReadyLoom, option: BeatOption, cycle: float, heads: int) -> float:
    """The weaving time with a time of the knot [s], estimated; the step to the next knot may take longer."""
    head, params, task = ready.head.weaver, ready.params, ready.task
    times = times_at(params, ready.head, task.cloth.knot_pitch, option.period)
    tied = replace(times, knot=cycle * (head.cycle / head.params.cycle if head else 1))
    busy = with_changes(tied, params.changes_per_knot)
    return ready.head.least_time(task.rows, task.columns, heads, busy, ready.weft.bobbins)
