"""The steps of making of a carpet from its warping on, with the time and the cost of each.

    on the loom    (dressing + taking down + weaving) share what loom, floor and persons cost of a carpet by their times
    off the loom   rate * area;   inspection and shearing take their time by area, washing with drying that of a carpet
    carving        wage * time by the length of the lines

Weaving has the energy too. The costs of all steps are that of a carpet without its yarn.
"""

from collections.abc import Mapping, Sequence

from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.records import record
from ilmek.report import Json

ON_LOOM = "warping", "weaving", "taking down"
"""Steps for which a carpet holds its loom."""


@record
class MakingStep:
    """A step of making: its time [s], None where it is bought, and its cost, None where no price is known."""

    name: str
    time: float | None
    cost: float | None

    def as_json(self) -> dict[str, Json]:
        """By JSON names, SI."""
        return {"name": self.name, "time": self.time, "cost": self.cost}


def making_steps(
    times: Sequence[float], shares: Mapping[str, float], rates: CostRates, area: float, carved: float = 0.0
) -> list[MakingStep]:
    """The steps of making of a carpet, in order.

    times   of the steps on the loom, as ON_LOOM [s]        area    of the carpet [m^2]
    carved  length of its carved lines [m]
    shares  the cost of a carpet by cause, without yarn
    """
    an_hour = sum(cost for cause, cost in shares.items() if cause not in {"energy", "finishing"}) / sum(times)
    on_loom = [
        MakingStep(name, time, an_hour * time + (shares["energy"] if name == "weaving" else 0.0))
        for name, time in zip(ON_LOOM, times, strict=True)
    ]
    return [*on_loom, *finishing_steps(rates, area, carved)]


CARVING = "carving"
"""Name of the step in which lines are carved."""


def finishing_steps(rates: CostRates, area: float, carved: float = 0.0) -> tuple[MakingStep, ...]:
    """The steps of making of a carpet of an area [m^2] off the loom, in order.

    carved  length of its carved lines [m]
    """
    time = carved / rates.carving_speed
    return (
        MakingStep("inspection", rates.inspection_time * area, rates.inspection * area),
        MakingStep("shearing", rates.shearing_time * area, rates.shearing * area),
        *([MakingStep(CARVING, time, rates.wage * time)] if carved else []),
        MakingStep("washing", rates.washing_time, rates.washing * area),
    )
