"""Who can weave what: the looms of a factory as designed, the charts of its orders, and each order on each loom."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

import numpy as np

from ilmek.carpet.bill import YarnBill, names_to_buy, yarn_bill
from ilmek.carpet.carving import carved_length
from ilmek.carpet.chart import Chart
from ilmek.carpet.colourways import Colourway, recoloured
from ilmek.carpet.price_rules import FLAT, woven_in_rows
from ilmek.carpet.recipe.edits import located
from ilmek.carpet.statistics import chart_statistics
from ilmek.carpet.usual_pile import with_counts
from ilmek.errors import IlmekError
from ilmek.io.looms_file import FactoryLooms, LoomEntry, WeaversLoom
from ilmek.io.orders_file import FactoryOrder, FactoryOrders
from ilmek.io.programme_file import ProgrammeFile, open_programme
from ilmek.jobs.chart import ChartResult, make_charted
from ilmek.jobs.existing_loom import ExistingLoom, read_existing_loom
from ilmek.jobs.loom import LoomOrder, make_loomed
from ilmek.jobs.loom_setup import loom_digest
from ilmek.jobs.order import read_order
from ilmek.jobs.weave import overlay_checks, pile_checks
from ilmek.jobs.wishes import Wishes
from ilmek.loom.operations import LoomSetup
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, design
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.automated_loom.making import MakingStep, finishing_steps
from ilmek.progress import Progress
from ilmek.records import JsonObject, record
from ilmek.report import Check, at_most, must


@record
class LoomFit:
    """Whether a loom weaves a carpet: its weaving time without stops [s], None where it does not; checks that fail.

    finishing  the steps of making after it, at the rates of the loom      energy  of its weaving [J]
    """

    time: float | None
    failed: tuple[Check, ...] = ()
    finishing: tuple[MakingStep, ...] = ()
    energy: float = 0.0


@record
class PlannedOrder:
    """An order of the file with its bill, its setup, and its fit to each loom.

    rows     of a carpet
    charted  its chart; None where it is a programme
    """

    entry: FactoryOrder
    bill: YarnBill
    setup: tuple[object, ...]
    fits: tuple[LoomFit, ...]
    rows: int
    charted: ChartResult | None = None

    @property
    def possible(self) -> bool:
        """Whether a loom weaves it."""
        return any(fit.time is not None for fit in self.fits)


ReadyLoom: TypeAlias = ExistingLoom | WeaversLoom


def ready_looms(looms: FactoryLooms, progress: Progress) -> list[ReadyLoom]:
    """The looms of the file; equal ones are designed once."""
    made: dict[tuple[object, ...], ReadyLoom] = {}
    found = []
    for index, entry in enumerate(looms.looms):
        key = entry.file, entry.hand, tuple(sorted(entry.design.items()))
        if key not in made:
            with located(entry.where):
                made[key] = _existing(entry)
        found.append(made[key])
        progress((index + 1) / len(looms.looms))
    return found


def _existing(entry: LoomEntry) -> ReadyLoom:
    if entry.hand is not None:
        return entry.hand
    if entry.file is not None:
        return read_existing_loom(entry.file)
    made = design(AutomatedLoomParams.read(dict(entry.design)))
    return ExistingLoom(Path(entry.name), made, MACHINE.report(made, illustrated=False))


def planned_orders(orders: FactoryOrders, looms: Sequence[ReadyLoom], progress: Progress) -> tuple[PlannedOrder, ...]:
    """The orders; carpets of the same file and settings are charted once."""
    charts: dict[tuple[object, ...], ChartResult] = {}
    made: dict[tuple[object, ...], PlannedOrder] = {}
    found = []
    for index, entry in enumerate(orders.orders):
        design = entry.picture, entry.programme, entry.yarns, tuple(sorted(entry.carpet.items()))
        key = (*design, entry.colourway)
        with located(entry.where):
            if entry.picture is not None and design not in charts:
                charts[design] = _charted(entry.picture, entry)
            if key not in made:
                made[key] = _of_chart(entry, charts[design], looms) if design in charts else _of_programme(entry, looms)
        found.append(replace(made[key], entry=entry))
        progress((index + 1) / len(orders.orders))
    return tuple(found)


def _charted(picture: Path, entry: FactoryOrder) -> ChartResult:
    """The chart of an order's design."""
    settings: JsonObject = dict(entry.carpet)
    return make_charted(read_order(picture, yarn_file=entry.yarns, **settings))


def _of_chart(entry: FactoryOrder, design: ChartResult, looms: Sequence[ReadyLoom]) -> PlannedOrder:
    """A carpet of a design, in its colourway."""
    charted = design if entry.colourway is None else in_colourway(design, entry.colourway)
    fits: dict[int, LoomFit] = {}
    for loom in looms:
        if id(loom) not in fits:
            fits[id(loom)] = _by_hand(charted, loom) if isinstance(loom, WeaversLoom) else _fit(charted, loom)
    chosen = tuple(fits[id(loom)] for loom in looms)
    return PlannedOrder(entry, charted.bill, setup_of(charted.chart), chosen, charted.chart.rows, charted)


def in_colourway(charted: ChartResult, colourway: Colourway) -> ChartResult:
    """The chart of a design in a colourway, with its own bill. Raises CarpetError as `recoloured`."""
    chart = recoloured(charted.chart, colourway, charted.order.yarns)
    bill = yarn_bill(chart, charted.order.order.plan)
    order = charted.order.with_dyed(chart.yarns)
    return replace(charted, order=order, chart=chart, bill=bill, statistics=chart_statistics(chart))


def _by_hand(charted: ChartResult, loom: WeaversLoom) -> LoomFit:
    """The weaving time at a frame that is wide enough: all its weavers work at once."""
    chart = charted.chart
    checks = (*charted.checks, at_most("width", chart.size.width, loom.width, "m", "the loom's frame"))
    failed = tuple(check for check in checks if not check.ok)
    flat = sum(cells for _, cells in woven_in_rows(chart))
    time = (charted.bill.knots + FLAT * flat) / (loom.weavers * loom.knots)
    return LoomFit(
        None if failed else time, failed, finishing_steps(CostRates(), charted.bill.area, carved_length(chart))
    )


def _fit(charted: ChartResult, loom: ExistingLoom) -> LoomFit:
    """Whether a loom weaves a chart, as `ilmek weave --loom FILE` judges it."""
    try:
        loomed = make_loomed(LoomOrder(loom.design.params, Wishes(), existing=loom), charted)
    except IlmekError as error:
        return LoomFit(None, (must("carpet: programme", False, error.given).with_cure(error.do or error.allowed),))
    chart = charted.chart
    checks = (*charted.checks, *overlay_checks(chart), *pile_checks(chart), *loomed.checks, *loom.report.all_checks)
    failed = tuple(check for check in checks if not check.ok)
    if failed or loomed.programme is None:
        return LoomFit(None, failed)
    finishing = finishing_steps(loom.design.params.cost, charted.bill.area, carved_length(chart))
    time, cost = loomed.programme.duration, loomed.cost
    return LoomFit(time, finishing=finishing, energy=0.0 if cost is None else cost.energy * time / cost.time)


def _of_programme(entry: FactoryOrder, looms: Sequence[ReadyLoom]) -> PlannedOrder:
    """A carpet whose programme is compiled: only the loom that it was compiled for weaves it."""
    assert entry.programme is not None
    with open_programme(entry.programme) as programme:
        chart, setup, time = _chart_of(programme), programme.setup, programme.totals.duration
    fits = tuple(_programme_fit(setup, time, loom) for loom in looms)
    return PlannedOrder(entry, yarn_bill(chart), setup_of(chart), fits, chart.rows)


def _chart_of(programme: ProgrammeFile) -> Chart:
    setup = programme.setup
    rows = [programme.chart_row(number) for number in range(setup.rows)]
    yarns = with_counts(setup.yarns, setup.quality, setup.knot)
    return Chart(np.array(rows[::-1], np.uint8), yarns, setup.size, setup.quality, setup.knot)


def _programme_fit(setup: LoomSetup, time: float, loom: ReadyLoom) -> LoomFit:
    if isinstance(loom, WeaversLoom):
        cure = "order its picture: weavers tie by a chart"
        return LoomFit(None, (must("programme: the loom has a control", False, "a frame for weavers").with_cure(cure),))
    compiled = must(
        "programme: compiled for this loom",
        loom_digest(loom.design.params) == setup.loom,
        "digest of the loom's parameters",
    ).with_cure("weave the picture on this loom: ilmek weave PICTURE --loom FILE")
    failed = tuple(check for check in (compiled, *loom.report.all_checks) if not check.ok)
    return LoomFit(None if failed else time, failed, finishing_steps(loom.design.params.cost, setup.size.area))


def setup_of(chart: Chart) -> tuple[object, ...]:
    """What two carpets have in common that need no new warp and no new tubes: warps, quality, knot, tubes."""
    # Two carpets may each have a yarn dyed for them of one name and two shades.
    names = names_to_buy(chart)
    tubes = Counter((names[index], chart.yarns[index].srgb) for index in chart.used)
    return chart.columns, chart.quality, chart.knot, frozenset(tubes.items())
