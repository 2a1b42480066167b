"""The loom of an order: its parameters, its design for a chart, and its programme."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

from ilmek.carpet.chart import Chart
from ilmek.carpet.pile import knot_length
from ilmek.errors import ParameterError, UnitError
from ilmek.jobs.order import CarpetOrder
from ilmek.loom.programme import Programme, heads_for, make_programme
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.units import format_quantity, parse_quantity


@dataclass(frozen=True, slots=True)
class LoomOrder:
    """An order for a loom.

    params    parameters of the loom, as far as they are known without the picture
    heads     number of knotting heads; default: as many as the deadline needs, or as the loom chooses
    deadline  time for the whole carpet [s]; default: none
    """

    params: AutomatedLoomParams
    heads: int | None
    deadline: float | None

    def as_dict(self) -> dict[str, Any]:
        """The order as plain data, SI."""
        return {"heads": self.heads, "deadline": self.deadline, "warp_pitch": self.params.pitch}


@dataclass(frozen=True, slots=True)
class LoomResult:
    """A loom for a chart, and the programme that weaves the chart on it."""

    design: LoomDesign
    programme: Programme


OF_THE_CARPET = {
    "width": "--size",
    "length": "--size",
    "knots_across": "--quality",
    "knots_along": "--quality",
    "knot": "--knot",
    "heads": "--heads",
    "warp_pitch": "--warp-pitch",
    "colours": "--colours",
    "knot_yarn": "--pile-height",
    "yarns.pile_density": "--yarns",
    "changes_per_knot": "the picture",
}
"""Parameters of a loom that follow from the carpet, and the option that sets each."""


def read_loom_order(
    order: CarpetOrder,
    *,
    heads: int | None = None,
    deadline: str | None = None,
    warp_pitch: Setting = None,
    loom: Mapping[str, Setting] = MappingProxyType({}),
) -> LoomOrder:
    """The order for a loom, from texts.

    loom  further parameters of the loom, by name
    Raises ParameterError, UnitError, or LoomError if the quality does not fit the warp pitch.
    """
    for name in loom:
        if name in OF_THE_CARPET:
            raise ParameterError(f"{name} of the loom follows from the carpet", do=f"set it by {OF_THE_CARPET[name]}")
    if heads is not None and deadline is not None:
        raise ParameterError("heads and a deadline are both given", do="give one of --heads and --deadline")
    limit = None if deadline is None else _deadline(deadline)
    settings: dict[str, Setting] = dict(
        width=order.size.width,
        length=order.size.length,
        knots_across=order.quality.across,
        knots_along=order.quality.along,
        knot=order.knot,
        heads=heads,
        **loom,
    )
    if warp_pitch is not None:
        settings["warp_pitch"] = warp_pitch
    return LoomOrder(AutomatedLoomParams.read(settings), heads, limit)


def _deadline(text: str) -> float:
    if re.fullmatch(r"\s*[\d.]+\s*", text):
        raise UnitError(f"deadline {text!r} has no unit", allowed="h, min or d", do=f"did you mean {text.strip()}h?")
    seconds = parse_quantity(text, "h")
    if seconds <= 0:
        raise ParameterError(f"a deadline of {format_quantity(seconds, 'h')}", allowed="above 0 h", do="like 72h")
    return seconds


def make_loomed(loom_order: LoomOrder, order: CarpetOrder, chart: Chart, progress: Progress = SILENT) -> LoomResult:
    """The loom for a chart, with the number of heads required, and its programme.

    Raises LoomError if the heads do not fit or the deadline cannot be met, and errors of the machines.
    """
    longest = max(knot_length(chart.knot, chart.quality, yarn.linear_density, order.pile) for yarn in chart.yarns)
    heaviest = max(yarn.linear_density for yarn in chart.yarns)
    params = replace(
        loom_order.params,
        yarns=replace(loom_order.params.yarns, pile_density=heaviest),
        colours=chart.colours,
        knot_yarn=longest,
        changes_per_knot=min(1.0, chart.changes_per_knot),
    )
    made = design(params)
    heads = _heads(loom_order, made, chart, progress.part(0.0, 0.7))
    if heads != made.heads:
        made = design(replace(params, heads=heads))
    programme = make_programme(chart.knots, len(chart.yarns), heads, made.times, progress=progress.part(0.7, 1.0))
    return LoomResult(made, programme)


def _heads(loom_order: LoomOrder, made: LoomDesign, chart: Chart, progress: Progress) -> int:
    if loom_order.deadline is None:
        return made.heads
    yarns = len(chart.yarns)
    return heads_for(chart.knots, yarns, loom_order.deadline, made.times, made.heads_max, progress=progress)
