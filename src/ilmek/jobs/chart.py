"""From a picture to knot chart and yarn bill, and their files."""

from collections.abc import Sequence
from dataclasses import asdict, fields, replace
from functools import partial
from pathlib import Path
from typing import Any

from ilmek.arrays import Rgb
from ilmek.carpet.bill import YarnBill, YarnNeed, yarn_bill
from ilmek.carpet.carving import carved_length
from ilmek.carpet.cells import PILE, CellMap
from ilmek.carpet.chart import Chart
from ilmek.carpet.construction import CarpetConstruction, construction_of
from ilmek.carpet.fitting import Fit
from ilmek.carpet.ground import GroundParams
from ilmek.carpet.mounting import mounting
from ilmek.carpet.pile import PileParams, fill_check, knot_length, of_kind, of_yarn, pile_fill
from ilmek.carpet.recipe.outcome import edit_checks
from ilmek.carpet.statistics import ChartStatistics, chart_statistics
from ilmek.carpet.yarn import Yarn
from ilmek.io.chart.formats import FORMATS, ChartFormat
from ilmek.io.chart.pdf import chart_cut
from ilmek.io.chart.printing import Printing
from ilmek.io.json_file import write_json
from ilmek.io.output import Outputs, joined
from ilmek.io.yarn_csv import write_yarn_csv
from ilmek.io.yarn_proposal import write_proposal
from ilmek.jobs.carpet_report import page_of
from ilmek.jobs.charting import chart_of_order
from ilmek.jobs.order import MOST_PRINTED, MOST_SHEETS, CarpetOrder, ResolvedOrder
from ilmek.jobs.paper import PAPER_PAGE, paper_checks, paper_files, paper_notes, paper_results
from ilmek.jobs.recipe import chart_of_recipe
from ilmek.jobs.rows import rows_plan, write_rows
from ilmek.jobs.shaping import with_shape
from ilmek.jobs.stages import ANEW, Stages
from ilmek.jobs.yarn_choice import (
    PROPOSED,
    kept_checks,
    proposed_shades,
    twin_warnings,
    yarn_choice_results,
    yarn_notes,
)
from ilmek.jobs.yarn_warnings import yarn_warnings
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.report import Check, Json, plain, verdict_json
from ilmek.report.left_out import made_or_left_out
from ilmek.viz.carpet_page import CarpetPage, carpet_page
from ilmek.viz.carpet_picture import DrawnCarpet, check_carpet_width, draw_carpet
from ilmek.viz.paper_page import paper_page

CARPET_PICTURE, YARN_TABLE = "carpet.png", "yarn.csv"


@record
class ChartResult:
    """Chart and yarn bill of an order.

    statistics  of the chart
    notes       changes made to the picture, and files that are left out
    source      the fitted picture, made small; None of a chart as input, and where it is not wanted
    whole       the same of the picture before it was cropped to the carpet's proportions; None where it was not
    ground      of the loom, where there is one
    name        of the carpet in its order, colourway included; ""
    """

    order: ResolvedOrder
    chart: Chart
    bill: YarnBill
    statistics: ChartStatistics
    notes: tuple[str, ...]
    source: Rgb | None = None
    whole: Rgb | None = None
    ground: GroundParams | None = None
    name: str = ""

    @property
    def pile(self) -> PileParams:
        """The parameters of the pile."""
        return self.order.order.plan.pile(self.chart.quality)

    @property
    def construction(self) -> CarpetConstruction:
        """Outline, binding, flat weave and the heights of the pile."""
        order = self.order.order
        return construction_of(self.chart, self.bill, order.shape, order.plan)

    @property
    def usual_counts(self) -> bool:
        """Whether the counts of the pile yarns follow from the quality."""
        order = self.order.order
        return order.plan.yarn_count is None and (order.yarns is None or order.yarns[0].metric_count is None)

    @property
    def files(self) -> tuple[str, ...]:
        """Names of the files that `write_chart` writes."""
        charts = (row.file for row in self.order.order.files.formats)
        printed = (row.file for row in self.printed)
        rows = rows_plan(self.chart, self.order.order).names
        proposed = (PROPOSED,) if self.chart.reading.proposed else ()
        return (*charts, CARPET_PICTURE, *printed, *rows, YARN_TABLE, *proposed, *paper_files(self.chart))

    @property
    def printed(self) -> tuple[ChartFormat, ...]:
        """The printed formats that are written; default: if they have at most MOST_SHEETS sheets."""
        pdf = self.order.order.pdf
        wanted = chart_cut(self.chart).count <= MOST_SHEETS if pdf is None else pdf
        return tuple(row for row in FORMATS.values() if row.printed and wanted)

    @property
    def printing(self) -> Printing:
        """What the printed files have besides the chart."""
        ground = self.order.order.plan.ground(self.ground)
        files = self.order.order.files
        return Printing(files.digits or "", self.bill, mounting(self.chart, ground), files.lang, self.name)

    @property
    def thickest(self) -> Yarn:
        """The yarn that fills most of the ground, of those that are used."""
        return max((self.chart.yarns[yarn] for yarn in self.chart.used), key=self.fill)

    @property
    def knot_yarns(self) -> tuple[float, ...]:
        """The pile yarn of a knot of each yarn of the chart in its highest pile [m]."""
        knot, quality, pile = self.chart.knot, self.chart.quality, self.highest
        return tuple(knot_length(knot, quality, yarn.linear_density, of_yarn(pile, yarn)) for yarn in self.chart.yarns)

    @property
    def highest(self) -> PileParams:
        """The parameters of the highest pile of the chart's knots."""
        cells = self.chart.cells
        kinds = (PILE,) if cells is None else (kind for kind in cells.kinds if kind.knotted)
        return max((of_kind(self.pile, kind) for kind in kinds), key=lambda pile: pile.pile_height)

    def fill(self, yarn: Yarn) -> float:
        """Share of the ground that a yarn fills [-]."""
        return pile_fill(self.chart.quality, yarn.linear_density, of_yarn(self.pile, yarn))

    @property
    def checks(self) -> tuple[Check, ...]:
        """The ground that the pile fills; what the chart keeps of the picture; the edge of a sheet; edits left out."""
        fill = fill_check(self.fill(self.thickest))
        kept = kept_checks(self.chart, self.order.order)
        paper = paper_checks(self.chart)
        return (fill, *kept, *paper, *edit_checks(self.chart.reading.edits))

    @property
    def warnings(self) -> tuple[str, ...]:
        """Near twins, remedies for the checks that fail, the mass, dye lots."""
        of_yarns = yarn_warnings(self.chart, self.bill, self.thickest, self.checks[0])
        return (*twin_warnings(self.chart), *of_yarns)


def chart_order(
    order: CarpetOrder,
    folder: Path | None = None,
    *,
    outputs: Outputs | None = None,
    force: bool = False,
    progress: Progress = SILENT,
) -> tuple[ChartResult, list[str]]:
    """Chart an order and write its files into a folder; on an error nothing is written. Returns also their paths.

    folder   default: nothing is written
    outputs  of the caller, who commits them; default: committed here
    force    replace a folder that ilmek wrote; for outputs of the caller, theirs holds
    Raises OutputError, before any work, for a folder that cannot be written; errors of `make_charted`; Cancelled.
    """
    if folder is None:
        return make_charted(order, progress), []
    with joined(outputs, force=force, progress=progress) as made:
        made.expect_folder(folder, "--out")
        charted = make_charted(order, progress.part(0.0, 0.6), with_source=True)
        left_out: list[str] = []
        with made.folder(folder) as work:
            written, drawn = write_chart(charted, work, left_out, progress.part(0.6, 0.9, "files"))
            names = ["report.html", *written, "chart.json"]
            shown = _page(charted, (*names, "chart.json"), left_out, drawn)
            drawing = progress.part(0.9, 1.0, "report.html")
            page = made_or_left_out("report.html", lambda: carpet_page(shown, left_out, drawing), left_out)
            if page is None:
                names.remove("report.html")
            else:
                (work / "report.html").write_text(page, encoding="utf-8")
            charted = replace(charted, notes=(*charted.notes, *left_out))
            files = [str(folder / name) for name in names]
            write_json(work / "chart.json", chart_json(charted, files))
    return charted, files


def _page(charted: ChartResult, names: Sequence[str], left_out: Sequence[str], drawn: DrawnCarpet | None) -> CarpetPage:
    return page_of(
        charted.order.order.picture.stem,
        charted.chart,
        charted.bill,
        names,
        statistics=charted.statistics,
        source=charted.source,
        whole=charted.whole,
        checks=charted.checks,
        warnings=(*charted.warnings, *charted.notes, *left_out),
        drawn=drawn,
    )


def make_charted(
    order: CarpetOrder, progress: Progress = SILENT, *, with_source: bool = False, stages: Stages = ANEW
) -> ChartResult:
    """Read the picture and chart it. Raises PictureError, CarpetError or YarnError.

    with_source  keep the fitted picture, made small, for a page      stages  default: every stage is made anew
    """
    charted_by = chart_of_order if order.recipe is None else chart_of_recipe
    made = with_shape(charted_by(order, progress, with_source=with_source, stages=stages), order)
    chart = made.chart
    check_carpet_width(chart.size, order.files.carpet_width)
    bill = yarn_bill(chart, order.plan)
    notes = (*order.notes, *made.notes, *paper_notes(chart), *yarn_notes(chart), *_left_out(order, chart))
    return ChartResult(made.order, chart, bill, chart_statistics(chart), notes, made.source, made.whole)


def _left_out(order: CarpetOrder, chart: Chart) -> tuple[str, ...]:
    sheets, rows = chart_cut(chart).count, rows_plan(chart, order).notes
    if order.pdf is not None or sheets <= MOST_SHEETS:
        return rows
    remedy = "--pdf writes it" if sheets <= MOST_PRINTED else f"at most {MOST_PRINTED:,} are written"
    return (f"chart.pdf would have {sheets:,} sheets and is left out; {remedy}", *rows)


def chart_results(charted: ChartResult) -> dict[str, Json]:
    """The results of a chart by their JSON names, SI."""
    chart, bill, reading = charted.chart, charted.bill, charted.chart.reading
    return {
        "rows": chart.rows,
        "columns": chart.columns,
        "knots": chart.tally().knots,
        "cells": [] if chart.cells is None else _cells(chart.cells),
        "carving": _carving(charted),
        "finished_area": bill.area,
        "edge_length": bill.edge,
        "colours": chart.colours,
        "reading": reading.kind,
        "changed_knots": reading.changed,
        "edited_knots": reading.edited,
        "edits": [outcome.as_plain() for outcome in reading.edits],
        "foreign_fraction": None if reading.foreign is None else reading.foreign / chart.knots.size,
        "fit": fit_results(reading.fit),
        "paper": paper_results(chart),
        **yarn_choice_results(chart, charted.order.order),
        "mean_delta_e": reading.mean_delta_e,
        "least_delta_e": reading.least_delta_e,
        "half_knots": sum(chart.tied.half),
        "jufti_knots": sum(chart.tied.jufti),
        "lone_fraction": chart.lone_fraction,
        "small_patches": chart.small_patches,
        "changes_per_knot": chart.changes_per_knot,
        "statistics": _statistics(charted),
        "yarn": [_need(need) for need in bill.pile],
        "yarn_index": [chart.positions[yarn] for yarn in chart.used],
        "ground": [_need(need) for need in bill.ground],
        "pile_mass": bill.pile_mass,
        "pile_mass_per_area": bill.pile_mass / bill.area,
        "yarn_mass": bill.mass,
        "pile_height": charted.pile.pile_height,
        "mass_per_area": bill.mass_per_area,
        "mass_band": None if bill.band is None else [bill.band.least, bill.band.most],
        "price": bill.price,
        "currency": bill.currency,
    }


def _cells(cells: CellMap) -> list[Json]:
    """The kinds of cells with their numbers."""
    return [{**asdict(kind), "cells": count} for kind, count in zip(cells.kinds, cells.counts, strict=True)]


def _carving(charted: ChartResult) -> JsonObject | None:
    """The lines that are carved, and the yarn that is cut away; None: there are none."""
    cells = charted.chart.cells
    if cells is None or cells.carving is None:
        return None
    mass = sum(need.carved for need in charted.bill.pile)
    return {**asdict(cells.carving), "length": carved_length(charted.chart), "mass": mass}


def _statistics(charted: ChartResult) -> dict[str, Json]:
    chart, found = charted.chart, charted.statistics
    return {
        "mean_changes": found.mean_changes,
        "hardest_rows": [{"row": row, "changes": found.of_row(row)} for row in found.hardest],
        "patches": [group._asdict() for group in found.patches],
        "yarn_delta_e": [
            {"name": yarn.name, "mean": one.mean, "worst": one.worst}
            for yarn, one, knots in zip(chart.yarns, chart.reading.differences, chart.counts, strict=False)
            if knots
        ],
    }


def fit_results(fit: Fit) -> dict[str, Json]:
    """How a picture was fitted, by the JSON names, SI."""
    return {field.name: getattr(fit, field.name) for field in fields(fit)}


_NEED = ("name", "use", "material", "knots", "length", "mass", "price", "count", "to_buy", "hanks", "lots", "lot_rows")


def _need(need: YarnNeed) -> dict[str, Json]:
    return {name: plain(getattr(need, name)) for name in _NEED}


def write_chart(
    charted: ChartResult, folder: Path, left_out: list[str], progress: Progress = SILENT
) -> tuple[tuple[str, ...], DrawnCarpet | None]:
    """Write the chart's files into a folder; returns their names, and the carpet as drawn for a page.

    A PDF that cannot be made is added to `left_out`.

    Raises OSError, and CarpetError for a carpet.png of too many pixels.
    """
    chart, width = charted.chart, charted.order.order.files.carpet_width
    formats = charted.order.order.files.formats
    for number, row in enumerate(formats):
        share = 0.2 / len(formats)
        row.save(folder / row.file, chart, progress.part(number * share, (number + 1) * share, row.file))
    drawn = draw_carpet(chart, width, progress=progress.part(0.2, 0.4, CARPET_PICTURE))
    drawn.write_png(folder / CARPET_PICTURE)
    drawn_for_page = drawn.of_page()
    write_yarn_csv(folder / YARN_TABLE, charted.bill, charted.chart.yarns)
    printed = _print_chart(charted, folder, left_out, progress.part(0.4, 0.7))
    rows = write_rows(chart, charted.order.order, folder, left_out, progress.part(0.7, 1.0), printing=charted.printing)
    proposed = (PROPOSED,) if chart.reading.proposed else ()
    if proposed:
        write_proposal(folder / PROPOSED, proposed_shades(chart))
    paper = paper_files(chart)
    if paper:
        (folder / PAPER_PAGE).write_text(paper_page(chart, charted.order.order.picture.stem), encoding="utf-8")
    charts = (row.file for row in formats)
    return (*charts, CARPET_PICTURE, *printed, *rows, YARN_TABLE, *proposed, *paper), drawn_for_page


def _print_chart(charted: ChartResult, folder: Path, left_out: list[str], progress: Progress) -> list[str]:
    """Write the printed formats into a folder; returns the names of those that are not left out."""
    names: list[str] = []
    for row in charted.printed:
        file, before, part = folder / row.file, len(left_out), progress.part(0.0, 1.0, row.file)
        made_or_left_out(row.file, partial(row.save, file, charted.chart, part, charted.printing), left_out)
        if len(left_out) > before:
            file.unlink(missing_ok=True)
        else:
            names.append(row.file)
    return names


def chart_json(charted: ChartResult, files: Sequence[str]) -> dict[str, Json]:
    """The JSON of a chart and the paths of its files."""
    return job_json(
        "chart",
        charted.order.as_dict(),
        chart_results(charted),
        checks=charted.checks,
        notes=list(charted.notes),
        warnings=list(charted.warnings),
        files=list(files),
    )


def job_json(
    job: str, parameters: JsonObject, results: JsonObject, *, checks: Sequence[Check], **more: Any
) -> JsonObject:
    """The JSON of a job: `job`, its verdict, `parameters`, `results`, `checks`, and `more` (notes, files ...).

    Each result is given twice: under `results`, as in a machine's report, and at the top level, where a reader of one
    number finds it by name. No result may have the name of another entry of the top level.
    """
    judged = {**verdict_json(checks), "checks": [check.as_json() for check in checks]}
    around = {"job": job, "parameters": parameters, "results": results, **judged, **more}
    assert not results.keys() & around.keys()
    return {**around, **results}
