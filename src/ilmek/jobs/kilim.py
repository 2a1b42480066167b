"""From a carpet picture to a kilim: chart at the resolution of its warps and picks, rows to weave by, page, report."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from ilmek.carpet.chart import used_first
from ilmek.carpet.kilim import KilimParams
from ilmek.carpet.kilim_cloth import KilimCloth, KilimPrices, kilim_cloth
from ilmek.errors import ParameterError
from ilmek.io.chart.formats import FORMATS
from ilmek.io.chart.join_marks import kilim_printing
from ilmek.io.json_file import write_json
from ilmek.io.kilim_rows import write_kilim_rows
from ilmek.io.output import Outputs, joined
from ilmek.jobs.deadline import read_deadline
from ilmek.jobs.order import CarpetOrder
from ilmek.jobs.tufted_chart import UnknottedResult, charted_for, cones_of, yarn_setting
from ilmek.jobs.yarn_choice import kept_checks
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject
from ilmek.report import Check, Result, results_of
from ilmek.viz.kilim_picture import draw_kilim
from ilmek.viz.tufted_page import kilim_page

PAGE, REPORT, PICTURE, ROWS = "report.html", "report.json", "carpet.png", "rows.txt"


@dataclass(frozen=True, slots=True)
class KilimOrder:
    """What is asked for: the parameters of the cloth, and the time for the whole carpet [s]."""

    params: KilimParams
    deadline: float | None = None


@dataclass(frozen=True, slots=True)
class KilimResult(UnknottedResult):
    """A carpet as a kilim, its results, and the folder of its files."""

    order: KilimOrder
    cloth: KilimCloth
    results: tuple[Result, ...]

    @property
    def checks(self) -> tuple[Check, ...]:
        """Slits and time, then what the chart keeps of the picture."""
        return (*self.cloth.checks, *kept_checks(self.charted.chart, self.charted.order.order))


def read_kilim_order(order: CarpetOrder, settings: Mapping[str, Setting], deadline: str | None = None) -> KilimOrder:
    """The order of a kilim from texts.

    Raises ParameterError for a parameter that is none or out of its bounds, UnitError, for a knot, and for a quality:
    warps and picks are the resolution.
    """
    if order.knot is not None:
        raise ParameterError(f"--knot {order.knot} with --technique kilim", allowed="no knot", do="leave it out")
    if order.quality is not None:
        given = f"--quality {order.quality} with --technique kilim"
        do = "set --kilim warps=50/dm and --kilim picks=200/dm instead"
        raise ParameterError(given, allowed="warps and picks of the cloth", do=do)
    params = KilimParams.read({**yarn_setting(order), **settings})
    return KilimOrder(params, None if deadline is None else read_deadline(deadline))


def weave_kilim(
    order: CarpetOrder,
    kilim: KilimOrder,
    folder: Path,
    *,
    outputs: Outputs | None = None,
    force: bool = False,
    progress: Progress = SILENT,
) -> KilimResult:
    """Chart a kilim and write its files into a folder; on an error nothing is written.

    Where a slit is too long its rows are not written. Other arguments and errors as of `jobs.weave.weave`.
    """
    with joined(outputs, force=force, progress=progress) as made:
        made.expect_folder(folder, "--out")
        result = _charted(order, kilim, folder, progress.part(0.0, 0.6, "chart"))
        holds = all(check.ok for check in result.cloth.checks)
        chart, printed = result.cloth.chart, FORMATS["pdf"]
        names = (PAGE, PICTURE, FORMATS["png"].file, printed.file, *((ROWS,) if holds else ()), REPORT)
        result = replace(result, written=names)
        printing = kilim_printing(result.cloth, order.files.digits or "", order.files.lang)
        with made.folder(folder) as work:
            FORMATS["png"].save(work / FORMATS["png"].file, chart)
            printed.save(work / printed.file, chart, progress.part(0.6, 0.8, printed.file), printing)
            if holds:
                write_kilim_rows(work / ROWS, result.cloth, order.files.lang)
            drawn = draw_kilim(result.cloth)
            drawn.write_png(work / PICTURE)
            page = kilim_page(
                order.picture.stem,
                result.cloth,
                results=result.results,
                checks=result.checks,
                files=names,
                drawn=drawn,
            )
            (work / PAGE).write_text(page, encoding="utf-8")
            write_json(work / REPORT, kilim_json(result))
    return result


def _charted(order: CarpetOrder, kilim: KilimOrder, folder: Path, progress: Progress) -> KilimResult:
    """The cloth of an order; nothing is written."""
    charted = charted_for(order, kilim.params.quality, progress, noun="a kilim", outline=True)
    charted = replace(charted, chart=used_first(charted.chart))
    prices = tuple(cone.price for cone in cones_of(charted))
    warp = order.plan.price("warp", order.plan.ground().yarns.warp)
    known = KilimPrices(prices, warp, CostRates().wage)
    cloth = kilim_cloth(charted.chart, kilim.params, order.plan.ground(), known, kilim.deadline)
    return KilimResult(charted, folder, kilim, cloth, results_of(cloth))


def kilim_json(result: KilimResult) -> JsonObject:
    """The JSON of the job."""
    chart, order, checks = result.cloth.chart, result.order, result.checks
    found = {
        "weaves": all(check.ok for check in checks),
        "width": chart.size.width,
        "length": chart.size.length,
        "rows": chart.rows,
        "columns": chart.columns,
    }
    return result.as_json(
        "kilim", order.params.as_dict(), order.deadline, found=found, results=result.results, checks=checks
    )
