"""What is wished of a loom beside its carpet: a number of heads, a deadline, a price. Wishes that cannot all hold are
named together, each with what it would need.
"""

import math
from dataclasses import dataclass, replace

from ilmek.errors import LoomError, ParameterError
from ilmek.jobs.loom_setup import CarpetPile
from ilmek.loom.bobbins import stop_time
from ilmek.loom.programme import least_heads, weaving_time
from ilmek.loom.sharing import MOST_HEADS
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.params import AIMS
from ilmek.machines.automated_loom.report import analyse
from ilmek.progress import SILENT, Progress
from ilmek.report import Choice, Report
from ilmek.units import format_number, format_quantity, hour

TIME = AIMS[1]
"""The aim for which all that is left open is chosen, where the deadline cannot be kept otherwise."""


@dataclass(frozen=True, slots=True)
class Wishes:
    """Number of heads, time for the whole carpet [s], and price at most; None: any."""

    heads: int | None = None
    deadline: float | None = None
    price: float | None = None


def heads_for_wishes(
    params: AutomatedLoomParams, wishes: Wishes, carpet: CarpetPile, progress: Progress = SILENT
) -> tuple[LoomDesign, tuple[Choice, ...]]:
    """The loom with the heads that are wished, or that its choice or the deadline needs; what was chosen for these.

    Where what is chosen for the least price cannot keep the deadline, all that is open is chosen for the least time.
    Raises ParameterError, naming every wish, where they cannot all hold; the errors of the loom's design.
    """
    try:
        made = design(params)
    except LoomError:
        made = design(replace(params, heads=1))
        if (wishes.heads or 1) <= made.heads_max:
            raise
    if (wishes.heads or 1) > made.heads_max:
        raise _contradiction(wishes, made, carpet)
    if wishes.deadline is None or _time(made, carpet, made.heads, wishes.deadline) <= wishes.deadline:
        return made, ()
    for aim in dict.fromkeys((params.aim, TIME)):
        if aim != params.aim:
            made = design(replace(params, aim=aim))
        if wishes.heads is not None:
            if _time(made, carpet, wishes.heads, wishes.deadline) <= wishes.deadline:
                return made, _of_aim(aim, params)
            continue
        needed = _needed(wishes.deadline, made, carpet, made.heads_max, progress)
        if needed is not None:
            made = design(replace(params, aim=aim, heads=needed))
            return made, (*_of_aim(aim, params), _of_heads(made, carpet))
    raise _contradiction(wishes, made, carpet)


def _of_aim(aim: str, params: AutomatedLoomParams) -> tuple[Choice, ...]:
    """The choice of another aim than the one wished, which the deadline needs."""
    return () if aim == params.aim else (Choice("aim", aim, "the deadline", params.aim, "the deadline"),)


def _of_heads(made: LoomDesign, carpet: CarpetPile) -> Choice:
    """The choice of the fewest heads that keep the deadline."""
    fewer = made.heads - 1
    time = _time(made, carpet, fewer) if fewer else math.inf
    failed = f"weaving time {_hours(time)}" if fewer and time < math.inf else "colours of a part" if fewer else ""
    return Choice("heads", str(made.heads), "the deadline", str(fewer) if fewer else "", failed)


def require_price(
    wishes: Wishes, params: AutomatedLoomParams, made: LoomDesign, report: Report, duration: float
) -> None:
    """Raise ParameterError, naming every wish, for a loom above the price that is wished; params: as given."""
    price = report["price"]
    if wishes.price is None or not isinstance(price, float) or price <= wishes.price:
        return
    costs = f"the price is to be at most {format_number(wishes.price)}; this loom costs {format_number(price)}"
    takes = f"its {_heads(made.heads)} weave the carpet in {_hours(duration)}"
    deadline = (
        [] if wishes.deadline is None else [f"the deadline of {_hours(wishes.deadline)} needs {_heads(made.heads)}"]
    )
    parts = [costs, takes, *deadline, *_quickest_for(wishes.price, params)]
    raise _error(parts, "give a higher price_limit, more time, fewer heads, or a narrower carpet")


def _quickest_for(price: float, params: AutomatedLoomParams) -> list[str]:
    """How quickly the carpet is woven for a price at most, estimated; nothing where no loom is so cheap."""
    quickest = design(replace(params, aim=TIME, deadline=None, price_limit=price))
    found = analyse(quickest)
    if found.listed.price > price:
        return []
    return [f"for {format_number(price)} it is woven in about {_hours(found.time)} by {_heads(quickest.heads)}"]


def _contradiction(wishes: Wishes, made: LoomDesign, carpet: CarpetPile) -> ParameterError:
    """The error that names each wish of heads, deadline and width with what it needs."""
    fit, parts = made.heads_max, []
    if wishes.heads is not None:
        shown = _hours(_time(made, carpet, wishes.heads)) if wishes.heads <= carpet.chart.columns // 2 else ""
        parts.append(f"{_heads(wishes.heads)} weave it in {shown}" if shown else _heads(wishes.heads))
    if wishes.deadline is not None:
        parts.append(_deadline_needs(wishes.deadline, made, carpet))
    width = format_quantity(made.params.width, "m"), format_quantity(made.head_width, "mm")
    reached = _hours(_time(made, carpet, fit))
    parts.append(f"at most {_heads(fit)} of {width[1]} fit {width[0]}, weaving it in {reached}")
    if wishes.price is not None:
        parts.append(f"the price is to be at most {format_number(wishes.price)}")
    return _error(parts, "give more time, other heads, a wider carpet, a coarser quality or narrower heads")


def _deadline_needs(deadline: float, made: LoomDesign, carpet: CarpetPile) -> str:
    """How many heads a deadline [s] needs, whether they fit or not."""
    chart = carpet.chart
    needed = _needed(deadline, made, carpet, min(MOST_HEADS, max(1, chart.columns // 2)), SILENT)
    if needed is not None:
        return f"the deadline of {_hours(deadline)} needs {_heads(needed)}"
    wefts = chart.rows * made.times.weft + stop_time(made.bobbins, chart.rows)
    alone = f": the wefts, beats and stops of {chart.rows} rows alone take {_hours(wefts)}" if wefts >= deadline else ""
    return f"the deadline of {_hours(deadline)} cannot be met by any number of heads{alone}"


def _error(parts: list[str], do: str) -> ParameterError:
    return ParameterError(f"the wishes contradict each other: {'; '.join(parts)}", do=do)


def _time(made: LoomDesign, carpet: CarpetPile, heads: int, deadline: float = math.inf) -> float:
    chart = carpet.chart
    return weaving_time(
        chart.knots,
        len(chart.yarns),
        heads,
        made.times,
        deadline,
        bobbins=made.bobbins,
        supply=carpet.supply(made.params),
        tube_change=made.params.tube_change,
    )


def _needed(deadline: float, made: LoomDesign, carpet: CarpetPile, most: int, progress: Progress) -> int | None:
    chart = carpet.chart
    return least_heads(
        chart.knots,
        len(chart.yarns),
        deadline,
        made.times,
        most,
        bobbins=made.bobbins,
        supply=carpet.supply(made.params),
        tube_change=made.params.tube_change,
        progress=progress,
    )


def _heads(number: int) -> str:
    return f"{number} {'head' if number == 1 else 'heads'}"


def _hours(seconds: float) -> str:
    return f"{format_number(seconds / hour, 3)} h"
