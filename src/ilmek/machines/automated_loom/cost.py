"""The cost of the carpet of a loom, and of the same carpet with other numbers of heads and other kinds of beat."""

from collections.abc import Mapping
from dataclasses import replace

from ilmek.loom.twin.faults import Exposure, StopParams, expected_standstill
from ilmek.machines.automated_loom.cabinet import AMPLIFIER
from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.choice import BeatOption
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.automated_loom.design import LoomDesign, ready_loom
from ilmek.machines.automated_loom.equipment.guards import POST, fence_of
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.equipment.tree import OF_A_HEAD
from ilmek.machines.automated_loom.estimate import estimated_time
from ilmek.machines.automated_loom.machine_cost import machine_cost, with_control
from ilmek.machines.automated_loom.params import AUTO
from ilmek.machines.automated_loom.parts import PartsList


def carpet_cost(loom: LoomDesign, listed: PartsList, time: float, energy: float) -> CarpetCost:
    """The cost of the loom's carpet.

    listed  parts of the loom      time, energy  of weaving the carpet [s], [J]
    """
    params, rates = loom.params, rates_of(loom, loom.weavers)
    fence = fence_of(site_of(loom))
    margins = 2 * (POST + rates.aisle)
    return CarpetCost(
        rates=rates,
        knots=params.knots,
        area=params.width * params.length,
        time=time,
        energy=energy,
        dressing=float(params.dressing.dressing_time),
        floor=(fence.right - fence.left + margins) * (fence.front - fence.rear + margins),
        machine=machine_cost(listed.parts, listed.prices),
        stops=standstill_of(loom),
    )


def standstill_of(loom: LoomDesign) -> float:
    """Time for which the twin's causes stop the loom for a carpet, as expected [s].

    A weaver ties on where a pile yarn breaks.
    """
    knots = loom.params.knots if loom.heads else 0
    return expected_standstill(StopParams(), Exposure(knots, knots * loom.params.billed, loom.rows, loom.columns))


def rates_of(loom: LoomDesign, weavers: int) -> CostRates:
    """The rates of a loom: where weavers tie, these are its persons."""
    return replace(loom.params.cost, persons=float(weavers)) if weavers else loom.params.cost


def costs_by_number(
    loom: LoomDesign, listed: PartsList, energy: float, beat: BeatOption | None = None
) -> tuple[CarpetCost, ...]:
    """Costs with 1, 2, ... heads or weavers up to what fits: an estimate, with frame and energy as they are.

    beat  in place of the loom's
    """
    own = carpet_cost(loom, listed, 1.0, energy)
    of_heads = {line.part for name in loom.head.children for line in loom.machines[name].parts} | OF_A_HEAD
    of_one = machine_cost((line for line in listed.parts if line.part in of_heads), listed.prices).times(
        1 / loom.knotters
    )
    exchanged = {AMPLIFIER} if beat is None else {AMPLIFIER, *(line.part for line in loom.beat.parts)}
    others = (line for line in listed.parts if line.part not in of_heads | exchanged)
    without = machine_cost((*others, *(() if beat is None else beat.drive.parts)), listed.prices)

    def with_heads(number: int) -> CarpetCost:
        cost = with_control(without.plus(of_one.times(number)), listed.prices)
        time = estimated_time(loom, number, None if beat is None else beat.period)
        rates = rates_of(loom, number if loom.weavers else 0)
        return replace(own, rates=rates, time=time, machine=cost)

    return tuple(with_heads(number) for number in range(1, loom.knotters_max + 1))


def costs_by_beats(loom: LoomDesign, listed: PartsList, energy: float) -> Mapping[str, tuple[CarpetCost, ...]]:
    """Costs by heads or weavers with each kind of beat whose drive keeps its limits, estimated; its own as it is."""
    options = ready_loom(replace(loom.params, beat=AUTO)).options
    own = loom.params.beat
    good = [option for option in options if option.kind == own or all(check.ok for check in option.checks)]
    return {one.kind: costs_by_number(loom, listed, energy, None if one.kind == own else one) for one in good}
