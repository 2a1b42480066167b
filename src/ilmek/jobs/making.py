"""A carpet on its loom and through its making: its size there, its warps, and the steps with their times and costs."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.carving import carved_length
from ilmek.carpet.chart import Chart
from ilmek.jobs.loom import LoomResult
from ilmek.machines.automated_loom import AutomatedLoomParams
from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.making import MakingStep
from ilmek.report import Json
from ilmek.units import cm, format_number, format_quantity
from ilmek.weaving.warping import Warping


@dataclass(frozen=True, slots=True)
class Making:
    """The making of a chart's carpet with the yarn of its bill on a loom.

    params  of the loom, with what follows from the chart
    """

    chart: Chart
    bill: YarnBill
    params: AutomatedLoomParams
    loomed: LoomResult

    @property
    def woven(self) -> tuple[float, float] | None:
        """Width and length of the carpet on the loom [m]; None without a loom."""
        made, design = self.loomed.made, self.loomed.design
        if made is None:
            return None
        cloth = made.params.cloth
        rows = cloth.row_distance if design is None else design.row_timing.row_pitch
        return self.chart.columns * cloth.knot_pitch, self.chart.rows * rows

    @property
    def longer(self) -> float | None:
        """How much longer it is on the loom than finished [m]; None without a loom."""
        return None if self.woven is None else self.woven[1] - self.chart.size.length

    @property
    def warping(self) -> Warping:
        """Its warps."""
        return self.params.dressing

    @property
    def cost(self) -> CarpetCost | None:
        """The cost of the carpet, by the time in which it is woven; None without a loom or that time."""
        loom, time, chart = self.loomed.cost, self.loomed.weaving_time, self.chart
        if loom is None or time is None:
            return None
        return replace(
            loom,
            knots=chart.tally().knots,
            area=self.bill.area,
            carved=carved_length(chart),
            time=time,
            energy=loom.energy * time / loom.time,
            dressing=float(self.warping.dressing_time),
        )

    @property
    def steps(self) -> tuple[MakingStep, ...]:
        """The steps of making with their times and costs, the yarn's first; none without a cost."""
        return () if self.cost is None else (MakingStep("yarn", None, self.bill.price), *self.cost.steps)

    def as_json(self) -> dict[str, Json]:
        """By JSON names, SI; null without a loom."""
        woven = self.woven
        return {
            "woven_size": None if woven is None else {"width": woven[0], "length": woven[1]},
            "woven_longer": self.longer,
            "making_steps": [step.as_json() for step in self.steps],
        }

    @property
    def in_words(self) -> Iterator[tuple[str, str, str]]:
        """Each step with its time and its cost, as shown."""
        for step in self.steps:
            yield step.name, "" if step.time is None else format_quantity(step.time, "h", 3), _price(step.cost)

    @property
    def size_in_words(self) -> str:
        """The size on the loom, and how much longer it is; "" without a loom."""
        if self.woven is None or self.longer is None:
            return ""
        sides = " × ".join(format_number(side / cm) for side in self.woven)
        return f"{sides} cm on the loom, {format_quantity(self.longer, 'mm', 2)} longer than finished"


def _price(cost: float | None) -> str:
    return "–" if cost is None else f"{cost:,.2f}"
