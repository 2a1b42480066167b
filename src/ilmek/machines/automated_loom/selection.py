"""The loom for a carpet, with what its parameters leave open chosen so that every check holds.

Kinds of beat are tried in ascending order of what the aim makes least: first by the checks of the drive alone, then in
the whole loom, until one keeps every limit. With a deadline a quicker beat may save heads: then the price of the whole
loom decides. These checks are formulas. Where the parts of the chosen loom have no room in space, the next kind is
tried [`with_room`]; that takes seconds a kind, so that `design` leaves it out.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from types import MappingProxyType

from ilmek.machines.automated_loom.assembly import assembly
from ilmek.machines.automated_loom.cost import costs_by_heads
from ilmek.machines.automated_loom.design import LoomDesign, ReadyLoom, ready_loom, with_beat
from ilmek.machines.automated_loom.params import AUTO, AutomatedLoomParams
from ilmek.machines.automated_loom.report import analyse, checks
from ilmek.report import Alternative, Check, choose

_ALL: Mapping[str, tuple[Check, ...]] = MappingProxyType({})


@lru_cache(maxsize=8)
def design(params: AutomatedLoomParams) -> LoomDesign:
    """The loom for a carpet. Where no beat keeps every limit, the loom with the one that misses them least.

    The last looms are kept: commands and reports that begin with the same parameters share the design.

    Raises LoomError where more heads are given than fit, or the shed leaves no time for the weft; CarpetError for a
    carpet without knots; the errors of the machines where their parameters contradict each other.
    """
    return _chosen(params, _ALL)


def with_room(loom: LoomDesign, params: AutomatedLoomParams) -> LoomDesign:
    """The loom, or where its parts have no room in space and its beat was left open, that with the next kind that has.

    params  of the choice: with the heads of the loom, these stay
    Where no kind has room, the loom with the beat whose heaviest failed check weighs least.
    """
    refused: dict[str, tuple[Check, ...]] = {}
    while params.beat == AUTO and loom.params.beat not in refused and not assembly(loom).holds:
        refused[loom.params.beat] = assembly(loom).checks
        loom = _chosen(params, refused)
    return loom


def _chosen(params: AutomatedLoomParams, refused: Mapping[str, tuple[Check, ...]]) -> LoomDesign:
    """The loom with the first kind of beat that keeps every limit; refused: checks in space by kinds."""
    if params.aim == "cost":
        return _by_cost(params, refused)
    ready = ready_loom(params)
    if len(ready.options) == 1:
        return with_beat(ready, ready.options[0])
    if params.deadline is not None and params.heads is None and params.aim == "price":
        return _by_whole_price(ready, refused)
    alternatives = [Alternative(one.kind, (*one.checks, *refused.get(one.kind, ()))) for one in ready.options]
    looms: dict[int, LoomDesign] = {}
    for index, option in enumerate(ready.options):
        if alternatives[index].failed:
            continue
        looms[index] = with_beat(ready, option, (choose("beat", alternatives, params.aim)[1],))
        alternatives[index] = Alternative(option.kind, (*option.checks, *checks(analyse(looms[index]))))
        if not alternatives[index].failed:
            break
    index, choice = choose("beat", alternatives, params.aim)
    return looms.get(index) or with_beat(ready, ready.options[index], (choice,))


def _by_whole_price(ready: ReadyLoom, refused: Mapping[str, tuple[Check, ...]]) -> LoomDesign:
    """The cheapest loom of those with each kind of beat, each with the heads that its deadline needs."""
    whole = sorted(
        (
            (analyse(loom).listed.price, option.kind, option, loom)
            for option in ready.options
            for loom in [with_beat(ready, option)]
        ),
        key=lambda one: one[:2],
    )
    found = [
        Alternative(kind, (*option.checks, *checks(analyse(loom)), *refused.get(kind, ())))
        for _, kind, option, loom in whole
    ]
    index, choice = choose("beat", found)
    return with_beat(ready, whole[index][2], (choice,))


def _by_cost(params: AutomatedLoomParams, refused: Mapping[str, tuple[Check, ...]]) -> LoomDesign:
    """The loom whose carpet costs least: each kind of beat with its heads of least cost, by the estimate over heads."""
    trial = ready_loom(params)
    offers = sorted(
        (_of_least_cost(params, with_beat(trial, option)) for option in trial.options),
        key=lambda loom: (analyse(loom).cost.cost_per_carpet, loom.params.beat),
    )
    alternatives = [
        Alternative(
            f"{loom.params.beat}, heads={loom.heads}", (*checks(analyse(loom)), *refused.get(loom.params.beat, ()))
        )
        for loom in offers
    ]
    index, choice = choose("beat and heads", alternatives, params.aim)
    return replace(offers[index], choices=(choice, *offers[index].choices))


def _of_least_cost(params: AutomatedLoomParams, trial: LoomDesign) -> LoomDesign:
    """The loom with the trial's beat, and the heads of least cost of those that keep the deadline; all as given."""
    if params.heads is not None:
        return trial
    found = analyse(trial)
    costs = costs_by_heads(trial, found.listed, found.energy.total)
    timely = [number for number, cost in enumerate(costs) if cost.time <= (params.deadline or math.inf)]
    number = min(timely or [len(costs) - 1], key=lambda number: costs[number].cost_per_carpet) + 1
    if number == trial.heads:
        return trial
    ready = ready_loom(replace(params, heads=number, beat=trial.params.beat))
    return with_beat(ready, ready.options[0])
