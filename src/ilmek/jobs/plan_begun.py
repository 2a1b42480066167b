"""What is on the looms when a plan begins: how far each carpet is, at which pace, and when its loom is free.

The rows that are left take

    (of - rows) t / of * pace

with t the planned weaving time of the whole carpet, stops counted. The pace is the time that the woven rows took over
their planned one: by the clock of the loom's journal, else by the working time since their begin. Below LEAST_WOVEN of
the carpet, and where no time is known, it is 1.
"""

import math
from collections.abc import Callable, Sequence
from datetime import datetime
from typing import TypeAlias

from ilmek.carpet.recipe.edits import located
from ilmek.errors import LoomError, ParameterError, did_you_mean
from ilmek.factory.model import Loom
from ilmek.io.looms_file import LoomEntry, WeavingEntry
from ilmek.jobs.ordering.progress import rows_of_run
from ilmek.jobs.plan_fits import PlannedOrder
from ilmek.records import record
from ilmek.units import minute

LEAST_WOVEN = 0.02
"""Share of a carpet that must be woven for its pace to be measured."""

WorkedTime: TypeAlias = Callable[[datetime], float]
"""Working time of a loom from an instant to the begin of the plan [s]."""


@record
class BegunCarpet:
    """A carpet on a loom when the plan begins.

    order, loom  indices                   rows  woven, of the `of` of the carpet
    pace         time of the woven rows over the planned one [-]
    woven, end   when its last row is woven, and when it is off the loom [min]
    late         delay [min]
    """

    order: int
    loom: int
    rows: int
    of: int
    pace: float
    woven: int
    end: int
    late: int


def begun_carpet(
    index: int, entry: LoomEntry, loom: Loom, orders: Sequence[PlannedOrder], *, worked: WorkedTime, due: Sequence[int]
) -> BegunCarpet | None:
    """The carpet that is on a loom; None for an empty one.

    index  of the loom      due  of each order [min]
    Raises ParameterError, LoomError with file and line: an unknown order, a carpet that the loom cannot weave, another
    carpet's run.
    """
    weaving = entry.weaving
    if weaving is None:
        return None
    with located(entry.where):
        order = _order_named(weaving.order, orders)
        fit, of = orders[order].fits[index], orders[order].rows
        if fit.time is None:
            failed = fit.failed[0].name if fit.failed else "it does not fit"
            raise LoomError(f"loom {loom.name} weaves {weaving.order!r}, which it cannot: {failed}")
        rows, took = _progress(weaving, of, worked)
        planned = fit.time / (1 - entry.stops)
        pace = took / (planned * rows / of) if took is not None and rows >= LEAST_WOVEN * of else 1.0
        left = math.ceil((of - rows) / of * planned * pace / minute - 1e-9)
    woven = loom.weaving.finish(loom.available, left)
    end = loom.attended.finish(woven, loom.doffing)
    return BegunCarpet(order, index, rows, of, pace, woven, end, max(end - due[order], 0))


def _order_named(name: str, orders: Sequence[PlannedOrder]) -> int:
    names = [order.entry.name for order in orders]
    if name not in names:
        raise ParameterError(
            f"weaves an unknown order {name!r}", allowed="an order of the orders' file", do=did_you_mean(name, names)
        )
    return names.index(name)


def _progress(weaving: WeavingEntry, of: int, worked: WorkedTime) -> tuple[int, float | None]:
    """The woven rows and the time that they took [s]; None: not known."""
    if weaving.run is not None:
        rows, clock = rows_of_run(weaving.run, of)
        return rows.rows, clock
    if weaving.rows > of:
        raise ParameterError(f"{weaving.rows} rows are woven", allowed=f"at most the {of} of the carpet")
    return weaving.rows, None if weaving.since is None else worked(weaving.since)


def require_counts(begun: Sequence[BegunCarpet], orders: Sequence[PlannedOrder], looms: Sequence[LoomEntry]) -> None:
    """Raise ParameterError where more carpets of an order are on looms than it has."""
    for index, order in enumerate(orders):
        own = [one for one in begun if one.order == index]
        if len(own) > order.entry.quantity:
            given = f"{len(own)} looms weave {order.entry.name!r}"
            with located(looms[own[-1].loom].where):
                raise ParameterError(given, allowed=f"its quantity, {order.entry.quantity}", do="correct one of them")
