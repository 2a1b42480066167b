"""The loom for a carpet, with what its parameters leave open chosen so that every check holds and the aim is least.

Branch and bound: of all offers [`offers`] the one with the least bound is designed, its value takes the place of its
bound, and when a designed loom is the least of all, its checks decide: it is chosen, or refused. So no other loom can
be better, by their bounds, and few are designed. What fails in a part that looms share refuses them all, and what more
heads or quicker knots make worse, all looms of a kind with more or quicker ones. These checks are formulas.
Where the parts of the chosen loom have no room in space, the kind of beat is refused, and the next best loom is chosen
[`with_room`]; that takes seconds a kind, so that `design` leaves it out.
"""

import contextlib
import heapq
from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from itertools import count
from types import MappingProxyType
from typing import TypeAlias

from ilmek.elements.prices import read_prices
from ilmek.errors import LoomError, ParameterError
from ilmek.machines.automated_loom.assembly import assembly
from ilmek.machines.automated_loom.design import LoomDesign, head_for, ready_loom, with_beat
from ilmek.machines.automated_loom.equipment.yarn_path import yarn_checks
from ilmek.machines.automated_loom.frame_modes import frame_modes
from ilmek.machines.automated_loom.knotting import ARMS, CAMS
from ilmek.machines.automated_loom.machine_cost import MachineCost
from ilmek.machines.automated_loom.offers import (
    SLACK,
    Bounds,
    HeadBranch,
    bare_rest,
    branches,
    frame_cost,
    head_cost,
    only_loom,
    rest_of,
    undesigned_arms,
    value_of,
)
from ilmek.machines.automated_loom.params import AUTO, PRICE, TIME, AutomatedLoomParams
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.automated_loom.report import all_checks, analyse
from ilmek.machines.automated_loom.search import LoomOffer, LoomSearch, SearchJournal
from ilmek.machines.weaver_hands import HAND
from ilmek.records import record
from ilmek.report import Check
from ilmek.report.verdict import weight

Refused: TypeAlias = Mapping[str, tuple[Check, ...]]
"""Checks that fail in space, by kinds of beat."""

_ALL: Refused = MappingProxyType({})

MOST_REFUSED, MOST_LIMITS = 8, 16
"""Whole looms that are designed and refused before the search ends with the one that misses its limits least; and how
many more where each shuts out others.
"""


@lru_cache(maxsize=16)
def design(params: AutomatedLoomParams) -> LoomDesign:
    """The loom for a carpet. Where no loom keeps every limit, the one that misses them least of those designed.

    The last looms are kept: commands and reports that begin with the same parameters share the design.

    Raises LoomError for a shed by hand, where more heads or weavers are given than fit, or the shed leaves no time for
    the weft; CarpetError for a carpet without knots; the errors of the machines where their parameters contradict each
    other.
    """
    if params.shed == HAND:
        raise LoomError("a loom whose shed is opened by hand", allowed="a loom with drives", do="set shed=cams")
    return _chosen(params, _ALL)


def with_room(loom: LoomDesign, params: AutomatedLoomParams) -> LoomDesign:
    """The loom, or where its parts have no room in space and its beat was left open, the next best with another beat.

    params  of the choice: with the heads of the loom, these stay
    Where no kind has room, the loom with the beat whose heaviest failed check weighs least.
    """
    refused: dict[str, tuple[Check, ...]] = {}
    while params.beat == AUTO and loom.params.beat not in refused and not assembly(loom).holds:
        refused[loom.params.beat] = tuple(check for check in assembly(loom).checks if not check.ok)
        loom = _chosen(params, refused)
    return loom


def _chosen(params: AutomatedLoomParams, refused: Refused) -> LoomDesign:
    """The loom of the best offer; refused: failed checks in space by kinds of beat."""
    if (only := only_loom(params)) is not None:
        return with_beat(only, only.options[0])
    kinds = (CAMS, ARMS) if params.knotting == AUTO else (params.knotting,)
    journal = SearchJournal()
    first = branches(params, kinds[0], journal)
    search = _begun(params, first, refused, journal)
    if search is None:
        return with_beat(first[0].ready, first[0].ready.options[0])
    for branch in first:
        search.add(branch)
    if len(kinds) > 1:
        search.postpone(first, designed=params.aim != PRICE)
    return search.run() or _nearest(params, refused)


def _begun(
    params: AutomatedLoomParams, first: Sequence[HeadBranch], refused: Refused, journal: SearchJournal
) -> "_Search | None":
    """The search with the bounds by the loom that seems the best of some branches; None where none has its parts."""
    prices = read_prices(params.prices)
    for branch, loom in ((one, loom) for one in first for loom in one.looms.values()):
        offer = LoomOffer(branch.kind, branch.cycles[0], branch.weft, loom.params.beat, loom.knotters, 0.0, 0.0, 0.0)
        with contextlib.suppress(ParameterError):
            rest = bare_rest(offer, loom)
            search = _Search(Bounds(params, prices, rest.frame, {offer.key: rest}), refused, journal)
            if search.begin(offer, first):
                return search
    return None


def _slack(loom: LoomDesign) -> list[Check]:
    """The natural frequencies of a loom's frame that its drives come too near to."""
    return [check for check in frame_modes(loom, parts_of_loom(loom).frame).checks if not check.ok]


def _tight(loom: LoomDesign) -> list[Check]:
    """The limits that a yarn's pull on its path to the head does not keep; none without heads."""
    return [check for check in yarn_checks(loom) if not check.ok] if loom.heads else []


def _nearest(params: AutomatedLoomParams, refused: Refused) -> LoomDesign:
    """The loom that comes nearest to a limit of the price or a deadline that no loom keeps, of both together: the
    cheapest that keeps the deadline, or where none does the quickest. Its check of what it misses fails.
    """
    if params.price_limit is None:
        relaxed = replace(params, aim=TIME, deadline=None)
    else:
        relaxed = replace(params, aim=PRICE, price_limit=None)
    near = _chosen(relaxed, refused)
    ready = ready_loom(replace(near.params, deadline=params.deadline, price_limit=params.price_limit))
    return with_beat(ready, ready.options[0], near.journal)


@record
class _Entry:
    """An offer in the search.

    bounded  number of designed looms by which it was bounded; 0: with another frame      own  by its own head
    loom     its own, by whose frame it is bounded      valued  it has the value of this loom
    opens    what makes the offers of looms by arms, where the offer stands for these
    """

    offer: LoomOffer
    bounded: int = 0
    own: bool = False
    loom: LoomDesign | None = None
    valued: bool = False
    opens: Callable[[], None] | None = None


@record
class _Limit:
    """The least offer of its kinds that fails a check: with the least heads, or with the slowest knot."""

    offer: LoomOffer
    check: Check
    by_heads: bool

    def shuts_out(self, other: LoomOffer) -> bool:
        """Whether another offer fails the same check: a frame is shaken no less by as many heads that tie as quickly
        together, a yarn is pulled no less by a quicker knot.
        """
        own = self.offer
        if (own.knotting, own.weft, own.beat) != (other.knotting, other.weft, other.beat):
            return False
        if self.by_heads:
            return own.heads <= other.heads and own.heads / own.cycle <= other.heads / other.cycle
        return other.cycle <= own.cycle


class _Search:
    """The search of one loom: offers by their bounds, and designed looms by their values."""

    def __init__(self, bounds: Bounds, refused: Refused, journal: SearchJournal) -> None:
        self.bounds, self.refused, self.journal = bounds, refused, journal
        self.looms: dict[tuple[object, ...], LoomDesign] = {}
        self.params = bounds.params
        self.offers: list[LoomOffer] = []
        self.closed: list[LoomOffer] = []
        self.heap: list[tuple[float, float, int, _Entry]] = []
        self.lost: list[tuple[LoomOffer, Check]] = []
        self.tried: list[tuple[LoomOffer, LoomDesign, float]] = []
        self.branches: dict[tuple[str, str], HeadBranch] = {}
        self.failed: dict[HeadBranch, Mapping[str, list[Check]]] = {}
        self.heads: dict[tuple[str, float], MachineCost] = {}
        self.limits: list[_Limit] = []
        self.order = count()

    def begin(self, simplest: LoomOffer, first: Sequence[HeadBranch]) -> bool:
        """Design the loom that seems the best, by bounds without equipment, or else the simplest: the bounds are then
        by its rest. False where it has not its parts.
        """
        offers: list[LoomOffer] = []
        for branch in first:
            self.branches[branch.kind, branch.weft] = branch
            failed = self._failed(branch)
            offers += [offer for offer in self.bounds.offers(branch) if not failed[offer.beat]]
        best = min(offers, key=lambda offer: (offer.value, offer.price), default=simplest)
        for offer in (best, simplest):
            with contextlib.suppress(LoomError, ParameterError):
                self.bounds.rests.clear()
                self.bounds.rests[offer.key] = rest_of(offer, analyse(self._loom(offer)))
                return True
        return False

    def _failed(self, branch: HeadBranch) -> Mapping[str, list[Check]]:
        """The checks that fail for each kind of beat: of head and weft, of its own, and in space."""
        if branch not in self.failed:
            ready = branch.ready
            shared = [check for check in (*ready.head.checks, *ready.weft.checks) if not check.ok]
            self.failed[branch] = {
                option.kind: [*shared, *(c for c in option.checks if not c.ok), *self.refused.get(option.kind, ())]
                for option in ready.options
            }
        return self.failed[branch]

    def add(self, branch: HeadBranch) -> None:
        """The offers of a branch; those whose head, weft or beat fails a check are lost."""
        failed = self._failed(branch)
        for offer in self.bounds.offers(branch):
            self.branches[offer.knotting, offer.weft] = branch
            self.offers.append(offer)
            if failed[offer.beat]:
                self.lost.append((offer, max(failed[offer.beat], key=weight)))
            else:
                self._push(offer.value, _Entry(offer))

    def postpone(self, cams: Sequence[HeadBranch], *, designed: bool) -> None:
        """The looms by arms, which are designed only where none with a head on cams is better than their bound: first
        the arms alone, then their heads.
        """
        arms = undesigned_arms(cams, designed=designed)
        self.closed = [offer for branch in arms for offer in self.bounds.offers(branch)]
        if self.closed:
            best = min(self.closed, key=lambda offer: offer.value)
            opens = self._open if designed else partial(self.postpone, cams, designed=True)
            self._push(best.value, _Entry(best, opens=opens))

    def _open(self) -> None:
        """The looms by arms in place of the offers that stand for them."""
        self.closed = []
        for branch in branches(self.params, ARMS, self.journal):
            self.add(branch)

    def _push(self, value: float, entry: _Entry) -> None:
        tie = entry.offer.price if self.params.aim == TIME else 0.0
        heapq.heappush(self.heap, (value, tie, next(self.order), entry))

    def run(self) -> LoomDesign | None:
        """The best loom that keeps every limit; else that which misses them least, or None where there is no offer."""
        while self.heap and len(self.tried) - min(len(self.limits), MOST_LIMITS) < MOST_REFUSED:
            value, _, _, entry = heapq.heappop(self.heap)
            if entry.opens is not None:
                entry.opens()
            elif (check := self._limit(entry.offer)) is not None:
                self.lost.append((entry.offer, check))
            elif entry.loom is not None and entry.valued:
                if self._holds(entry.offer, entry.loom):
                    return self._ended(entry.offer, entry.loom, value)
            elif entry.bounded < len(self.bounds.rests) or not entry.own:
                self._bound(entry)
            else:
                self._design(entry)
        if self.tried:
            offer, loom, _ = min(self.tried, key=lambda one: one[2])
            return self._ended(offer, loom, value_of(analyse(loom), self.params.aim))
        if not self.lost:
            return None
        offer, _ = min(self.lost, key=lambda one: (weight(one[1]), one[0].value))
        return self._ended(offer, self._loom(offer), offer.value)

    def _bound(self, entry: _Entry) -> None:
        """The offer again, with its bounds by the frame of its kinds, then by its own head, or that for another
        carrier, then by its own frame, and by all looms until now.
        """
        offer, loom = entry.offer, entry.loom
        key = offer.knotting, offer.cycle
        branch = self.branches[offer.knotting, offer.weft]
        if entry.bounded and key not in self.heads:
            self.heads[key] = head_cost(head_for(offer.of(self.params)), self.bounds.prices)
        head = self.heads.get(key)
        frame = None if loom is None else frame_cost(loom)
        nearer = self.bounds.nearer(offer, loom or branch.looms[offer.beat], head or branch.head, frame)
        if self.bounds.wished(nearer.time, nearer.price):
            self._push(nearer.value, _Entry(nearer, len(self.bounds.rests), own=head is not None, loom=loom))

    def _loom(self, offer: LoomOffer) -> LoomDesign:
        branch = self.branches[offer.knotting, offer.weft]
        first = branch.looms.get(offer.beat)
        if first and (first.knotters, branch.cycles[0]) == (offer.heads, offer.cycle):
            return first
        if offer.key not in self.looms:
            ready = ready_loom(offer.of(self.params))
            self.looms[offer.key] = with_beat(ready, ready.options[0], self.journal)
        return self.looms[offer.key]

    def _design(self, entry: _Entry) -> None:
        """The loom of an offer, first with its frame alone, then whole, with the value that it has. What cannot be
        designed, wider heads, is no offer, nor what costs more than is wished.
        """
        with contextlib.suppress(LoomError, ParameterError):
            if entry.loom is None:
                self._bound(replace(entry, loom=self._loom(entry.offer)))
                return
            found = analyse(entry.loom)
            self.bounds.rests[entry.offer.key] = rest_of(entry.offer, found)
            if self.bounds.wished(found.time, found.listed.price):
                self._push(value_of(found, self.params.aim), replace(entry, valued=True))

    def _holds(self, offer: LoomOffer, loom: LoomDesign) -> bool:
        failed = [check for check in all_checks(loom) if not check.ok]
        if failed:
            heaviest = max(failed, key=weight)
            self.lost.append((offer, heaviest))
            self.tried.append((offer, loom, weight(heaviest)))
            self.limits += self._shut_out(offer, loom)
        return not failed

    def _shut_out(self, offer: LoomOffer, loom: LoomDesign) -> Iterator[_Limit]:
        """What the refused loom of an offer shuts out: more heads, or quicker knots, from the least that fail on."""
        cycles = [own for own in self.branches[offer.knotting, offer.weft].cycles if own >= offer.cycle]
        for failed, offers in (
            (_slack, [replace(offer, heads=number + 1) for number in range(offer.heads)]),
            (_tight, [replace(offer, cycle=own) for own in cycles]),
        ):
            if checks := failed(loom):
                fails = bisect_left(offers, True, hi=len(offers) - 1, key=lambda own: bool(failed(self._loom(own))))
                yield _Limit(offers[fails], checks[0], by_heads=failed is _slack)

    def _limit(self, offer: LoomOffer) -> Check | None:
        """The check that fails for an offer because it fails for a lesser one of its kinds."""
        return next((limit.check for limit in self.limits if limit.shuts_out(offer)), None)

    def _ended(self, offer: LoomOffer, loom: LoomDesign, value: float) -> LoomDesign:
        """The loom, with the record of the search in its journal."""
        lost = sorted((one for one in self.lost if one[0].value <= value), key=lambda one: one[0].value)
        costs = tuple((rest.offer, rest.cost) for rest in self.bounds.rests.values())
        search = LoomSearch(self.params, (*self.offers, *self.closed), costs, tuple(lost), offer, value, SLACK)
        if self.heap:
            least, _, _, entry = self.heap[0]
            search = replace(search, rival=entry.offer, rival_value=least, rival_designed=entry.valued)
        self.journal.search = search
        return loom
