"""What a carpet costs on a loom, without its yarn, and what the loom costs that ties it.

    made    = parts + fitter's wage * (screws * time of a screw + axes * time of an axis + commissioning)
    sold    = made * (1 + margin)
    annuity = sold * i / (1 - (1 + i)^-n);  sold / n without interest
    carpets a year = hours * availability / (weaving time + changeover)

    cost = (annuity + upkeep * sold + rent * floor) / carpets a year + wage * persons * hours / carpets a year
           + price of energy * energy + finishing * area

The loom is paid back against weavers by hand after sold / (carpets a year * (hand - cost without annuity)) years, where
hand = knots / knots a day * hours a day * wage + finishing * area. Rates: `CostRates`.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

from ilmek.elements.prices import PriceRates, price_of
from ilmek.machines.automated_loom.choice import BeatOption
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.automated_loom.design import LoomDesign, ready_loom
from ilmek.machines.automated_loom.equipment.guards import POST, fence_of
from ilmek.machines.automated_loom.equipment.tree import OF_A_HEAD
from ilmek.machines.automated_loom.estimate import estimated_time
from ilmek.machines.automated_loom.params import AUTO
from ilmek.machines.automated_loom.parts import PartsList, motors
from ilmek.machines.automated_loom.standing_frame import AMPLIFIER
from ilmek.records import computed, record
from ilmek.report import BillLine

YEAR = 365.25 * 86400.0
_SCREWS = "fastener"


def annuity_factor(interest: float, years: float) -> float:
    """Share of a loan that is paid each year, so that it is paid off after a number of years.

    >>> round(annuity_factor(0.05, 7), 5), annuity_factor(0.0, 4)
    (0.17282, 0.25)
    """
    return -interest / math.expm1(-years * math.log1p(interest)) if interest else 1 / years


@record
class CarpetCost:
    """Cost of a carpet of a number of knots and an area [m^2], woven in a time [s] with an energy [J], on a loom.

    parts, made, sold  prices of the loom: its parts, with assembly, with the maker's margin
    floor              that the loom needs, with the aisle round it [m^2]
    """

    rates: CostRates
    knots: int
    area: float
    time: float
    energy: float
    floor: float
    parts: float
    made: float
    sold: float

    @computed("", "price of the loom: parts, made with assembly and setting to work, sold with the maker's margin")
    def machine_price(self) -> dict[str, float]:
        return {"parts": self.parts, "made": self.made, "sold": self.sold}

    @computed("1", "carpets that the loom weaves in a year")
    def carpets_per_year(self) -> float:
        return self.rates.hours * self.rates.availability / (self.time + self.rates.changeover)

    @computed("", "cost of a carpet without yarn, by cause")
    def cost_shares(self) -> dict[str, float]:
        return {"capital": self._annuity / self.carpets_per_year, **self._running}

    @computed("", "cost of a carpet, without its yarn")
    def cost_per_carpet(self) -> float:
        return sum(self.cost_shares.values())

    @computed("1/m^2", "cost of a square metre of carpet, without its yarn")
    def cost_per_area(self) -> float:
        cost: float = self.cost_per_carpet
        return cost / self.area

    @computed("", "cost of the carpet tied by hand, without its yarn")
    def hand_cost(self) -> float:
        rates = self.rates
        day = rates.weaver_day * rates.wage
        return self.knots / rates.weaver_knots * day + rates.finishing * self.area

    @computed(
        "day",
        "time after which the loom has earned its price against weavers by hand",
        optional=True,
        absent="a carpet tied by hand is the cheaper one",
    )
    def payback_time(self) -> float | None:
        saving = self.carpets_per_year * (self.hand_cost - sum(self._running.values()))
        return self.sold / saving * YEAR if saving > 0 else None

    @property
    def _annuity(self) -> float:
        return self.sold * annuity_factor(self.rates.interest, self.rates.life)

    @property
    def _running(self) -> Mapping[str, float]:
        rates, carpets = self.rates, self.carpets_per_year
        return {
            "operators": rates.wage * rates.persons * rates.hours / carpets,
            "upkeep": rates.upkeep * self.sold / carpets,
            "floor": rates.rent * self.floor / carpets,
            "energy": rates.energy * self.energy,
            "finishing": rates.finishing * self.area,
        }


@record
class MachineCost:
    """What a loom costs its maker: its parts, and the screws and axes by which its assembly is paid."""

    parts: float
    screws: float
    axes: float

    def sold(self, rates: CostRates) -> tuple[float, float]:
        """Prices of the loom: with assembly and setting to work, and with the maker's margin."""
        work = self.screws * rates.screw_time + self.axes * rates.axis_time + rates.commissioning
        made = self.parts + rates.fitter_wage * work
        return made, made * (1 + rates.margin)

    def plus(self, other: "MachineCost") -> "MachineCost":
        """With another."""
        return MachineCost(self.parts + other.parts, self.screws + other.screws, self.axes + other.axes)

    def times(self, number: float) -> "MachineCost":
        """A number of times."""
        return MachineCost(number * self.parts, number * self.screws, number * self.axes)


def machine_cost(lines: Iterable[BillLine], prices: Mapping[str, PriceRates]) -> MachineCost:
    """The cost of the lines of a parts list."""
    lines = tuple(lines)
    return MachineCost(
        sum(price_of(line, prices) for line in lines),
        sum(line.number for line in lines if line.kind == _SCREWS),
        motors(lines),
    )


def with_control(cost: MachineCost, prices: Mapping[str, PriceRates]) -> MachineCost:
    """A cost without the amplifiers of the control, with those of its axes."""
    return replace(cost, parts=cost.parts + cost.axes * prices["axis of the control"].each)


def carpet_cost(loom: LoomDesign, listed: PartsList, time: float, energy: float) -> CarpetCost:
    """The cost of the loom's carpet.

    listed  parts of the loom      time, energy  of weaving the carpet [s], [J]
    """
    params, rates = loom.params, rates_of(loom, loom.weavers)
    cost = machine_cost(listed.parts, listed.prices)
    made, sold = cost.sold(rates)
    fence = fence_of(loom)
    margins = 2 * (POST + rates.aisle)
    return CarpetCost(
        rates=rates,
        knots=loom.rows * loom.columns,
        area=params.width * params.length,
        time=time,
        energy=energy,
        floor=(fence.right - fence.left + margins) * (fence.front - fence.rear + margins),
        parts=cost.parts,
        made=made,
        sold=sold,
    )


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
        made, sold = cost.sold(own.rates)
        time = estimated_time(loom, number, None if beat is None else beat.period)
        rates = rates_of(loom, number if loom.weavers else 0)
        return replace(own, rates=rates, time=time, parts=cost.parts, made=made, sold=sold)

    return tuple(with_heads(number) for number in range(1, loom.knotters_max + 1))


def costs_by_beats(loom: LoomDesign, listed: PartsList, energy: float) -> Mapping[str, tuple[CarpetCost, ...]]:
    """Costs by heads or weavers with each kind of beat whose drive keeps its limits, estimated; its own as it is."""
    options = ready_loom(replace(loom.params, beat=AUTO)).options
    own = loom.params.beat
    good = [option for option in options if option.kind == own or all(check.ok for check in option.checks)]
    return {one.kind: costs_by_number(loom, listed, energy, None if one.kind == own else one) for one in good}
