"""What a carpet costs on a loom, without its yarn, and what the loom costs that ties it.

    annuity = sold * i / (1 - (1 + i)^-n);  sold / n without interest                        [sold: `machine_cost`]
    carpets a year = hours * availability / (weaving time + changeover)
    availability = (1 - failures) (weaving time + changeover) / (weaving time + changeover + stops)
    changeover = dressing + 4.5 h, where it is not given

The stops are those that the twin's causes are expected to give for a carpet, until the operator has mended them.

    cost = (annuity + upkeep * sold + rent * floor) / carpets a year + wage * persons * hours / carpets a year
           + price of energy * energy + finishing * area

The loom is paid back against weavers by hand after sold / (carpets a year * (hand - cost without annuity)) years, where
hand = knots / knots a day * hours a day * wage + finishing * area. Rates: `CostRates`.
By the steps of making: `making`.
"""

import math
from collections.abc import Mapping

from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.automated_loom.machine_cost import MachineCost
from ilmek.machines.automated_loom.making import MakingStep, making_steps
from ilmek.records import computed, record
from ilmek.report import Json

YEAR = 365.25 * 86400.0

CUT_OFF = 4.5 * 3600.0
"""Time between two carpets beside the dressing of the loom [s]: cut off, take down, begin; assumed by this project."""


def annuity_factor(interest: float, years: float) -> float:
    """Share of a loan that is paid each year, so that it is paid off after a number of years.

    >>> round(annuity_factor(0.05, 7), 5), annuity_factor(0.0, 4)
    (0.17282, 0.25)
    """
    return -interest / math.expm1(-years * math.log1p(interest)) if interest else 1 / years


@record
class CarpetCost:
    """Cost of a carpet of a number of knots and an area [m^2], woven in a time [s] with an energy [J], on a loom.

    dressing  of the loom for a carpet [s]      floor  that the loom needs, with the aisle round it [m^2]
    machine   what the loom costs its maker     stops  expected standstill for the operator [s]
    carved    length of carved lines [m]
    """

    rates: CostRates
    knots: int
    area: float
    time: float
    energy: float
    dressing: float
    floor: float
    machine: MachineCost
    stops: float = 0.0
    carved: float = 0.0

    @computed("", "price of the loom: parts, made with assembly and setting to work, sold with the maker's margin")
    def machine_price(self) -> dict[str, float]:
        return {"parts": self.machine.parts, "made": self.machine.made(self.rates), "sold": self.sold}

    @computed("1", "pieces, screws and joints to fit, axes and sensors to wire")
    def fitted(self) -> dict[str, float]:
        return self.machine.fitting._asdict()

    @computed("%", "share of the hours in which the loom runs or changes carpets: less failures and the twin's stops")
    def availability(self) -> float:
        given, busy = self.rates.availability, self.time + self.changeover
        return (1 - self.rates.failures) * busy / (busy + self.stops) if given is None else given

    @computed("1", "carpets that the loom weaves in a year")
    def carpets_per_year(self) -> float:
        return self.rates.hours * self.availability / (self.time + self.changeover)

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

    @computed("", "steps of making: time [s] and cost of each, without yarn")
    def making_steps(self) -> list[Json]:
        return [step.as_json() for step in self.steps]

    @property
    def steps(self) -> list[MakingStep]:
        """The steps of making from the warping on, in order."""
        warping = min(self.dressing, self.changeover)
        on_loom = (warping, self.time, self.changeover - warping)
        return making_steps(on_loom, self.cost_shares, self.rates, self.area, self.carved)

    @computed("", "cost of the carpet tied by hand, without its yarn")
    def hand_cost(self) -> float:
        rates = self.rates
        day = rates.weaver_day * rates.wage
        return self.knots / rates.weaver_knots * day + rates.finishing(self.area, self.carved)

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
    def changeover(self) -> float:
        """Time between two carpets [s]: as given, or by the dressing of the loom."""
        given = self.rates.changeover
        return self.dressing + CUT_OFF if given is None else given

    @property
    def sold(self) -> float:
        """Price of the loom with the maker's margin."""
        return self.machine.made(self.rates) * (1 + self.rates.margin)

    def of_fewer(self, carpets: float) -> float:
        """Cost of a carpet without yarn where the loom weaves a number of them a year [1], at most all that it can.

        The loom and its floor are paid by these; persons are there while it weaves.
        """
        cost: float = self.cost_per_carpet
        return cost + self._yearly * (self.carpets_per_year / carpets - 1)

    @property
    def even_with_hand(self) -> float:
        """Carpets a year with which a carpet costs as much as by hand [1]; inf where it never costs so little."""
        saved = self.hand_cost - self.cost_per_carpet + self._yearly
        return float(self._yearly * self.carpets_per_year / saved) if saved > 0 else math.inf

    @property
    def _yearly(self) -> float:
        """Share of what is paid a year for the loom in the cost of a carpet."""
        shares: dict[str, float] = self.cost_shares
        return sum(shares[name] for name in ("capital", "upkeep", "floor"))

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
            "finishing": rates.finishing(self.area, self.carved),
        }
