"""From a carpet picture to chart, yarn, loom, programme and report."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ilmek.io.chart.symbols import symbols
from ilmek.io.json_file import write_json
from ilmek.io.output import Outputs, joined
from ilmek.io.programme_file import write_programme
from ilmek.io.programme_meta import Label
from ilmek.jobs.chart import ChartResult, chart_results, job_json, make_charted, write_chart
from ilmek.jobs.loom import LoomOrder, LoomResult, make_loomed
from ilmek.jobs.order import CarpetOrder
from ilmek.machines.automated_loom import MACHINE
from ilmek.progress import SILENT, Progress
from ilmek.report import Check, Report, at_most
from ilmek.report.left_out import made_or_left_out
from ilmek.units import format_quantity, hour
from ilmek.viz.page import CarpetPage, carpet_page
from ilmek.viz.page_parts import Fact, FileNote

FILES = (
    FileNote("report.html", "this page: pictures, yarn, machines, checks"),
    FileNote("report.json", "the same results as data, SI"),
    FileNote("chart.png", "the knot chart, one pixel one knot"),
    FileNote("chart.pdf", "the knot chart to weave from, with symbols and row numbers"),
    FileNote("yarn.csv", "the yarn to buy"),
    FileNote("programme.ilmek", "the loom programme; show it with `ilmek inspect`"),
    FileNote("machine.json", "the loom and its machines: parameters, results, checks"),
)
"""Files of the output folder."""


@dataclass(frozen=True, slots=True)
class WeaveResult:
    """Results of the job, and the folder of its files.

    loom      the loom's report, with those of its machines
    written   names of the files in the folder
    left_out  warnings: figures and files that could not be made
    """

    charted: ChartResult
    loom_order: LoomOrder
    loomed: LoomResult
    loom: Report
    folder: Path
    written: tuple[str, ...] = tuple(file.name for file in FILES)
    left_out: tuple[str, ...] = ()

    @property
    def checks(self) -> tuple[Check, ...]:
        """All checks: of the job, the loom and its machines; the latter begin with the machine's name."""
        return (*self.own_checks, *self.loom.all_checks)

    @property
    def own_checks(self) -> tuple[Check, ...]:
        """Checks of the job: the carpet, and the deadline if one is given."""
        return (*self.charted.checks, *job_checks(self.loom_order, self.loomed))

    @property
    def warnings(self) -> tuple[str, ...]:
        """All warnings: of the carpet, the loom and its machines."""
        return (*self.charted.warnings, *self.loom.all_warnings, *self.left_out)

    @property
    def notes(self) -> tuple[FileNote, ...]:
        """The files that are written, with descriptions."""
        return tuple(file for file in FILES if file.name in self.written)

    @property
    def files(self) -> list[str]:
        """The paths of the files."""
        return [str(self.folder / file.name) for file in self.notes]


def weave(
    order: CarpetOrder,
    loom_order: LoomOrder,
    folder: Path,
    *,
    outputs: Outputs | None = None,
    force: bool = False,
    progress: Progress = SILENT,
) -> WeaveResult:
    """Do the whole job and write its files into a folder.

    outputs  of the caller, who commits them; default: committed here
    force    replace a folder that ilmek wrote; for outputs of the caller, theirs holds
    Raises OutputError, before any work, for a folder that cannot be written; any IlmekError; then nothing is written.
    """
    with joined(outputs, force=force, progress=progress) as made:
        made.expect_folder(folder, "--out")
        return _weave(order, loom_order, folder, made, progress)


def _weave(
    order: CarpetOrder, loom_order: LoomOrder, folder: Path, outputs: Outputs, progress: Progress
) -> WeaveResult:
    charted = make_charted(order, progress.part(0.0, 0.4, "picture"))
    loomed = make_loomed(loom_order, order, charted.chart, progress.part(0.4, 0.5, "loom"))
    woven = WeaveResult(charted, loom_order, loomed, MACHINE.report(loomed.design), folder)
    left_out: list[str] = []
    with outputs.folder(folder) as work:
        written = write_chart(charted, work, left_out, progress.part(0.5, 0.7, "chart"))
        write_programme(
            work / "programme.ilmek", loomed.programme, _label(woven), progress=progress.part(0.7, 0.8, "programme")
        )
        write_json(work / "machine.json", machine_json(woven))
        drawing = progress.part(0.8, 1.0, "report")
        written = (*written, "programme.ilmek", "machine.json", "report.html", "report.json")
        woven = replace(woven, written=written, left_out=tuple(left_out))
        page = made_or_left_out("report.html", lambda: carpet_page(_page(woven), left_out, drawing), left_out)
        if page is not None:
            (work / "report.html").write_text(page, encoding="utf-8")
        written = tuple(name for name in written if name != "report.html" or page is not None)
        woven = replace(woven, written=written, left_out=tuple(left_out))
        write_json(work / "report.json", weave_json(woven))
    return woven


def job_checks(loom_order: LoomOrder, loomed: LoomResult) -> tuple[Check, ...]:
    """The check of the deadline, if one is given."""
    if loom_order.deadline is None:
        return ()
    return (at_most("weaving time", loomed.programme.duration, loom_order.deadline, "h", "the deadline given"),)


def weave_results(woven: WeaveResult) -> dict[str, Any]:
    """The results of the job by their JSON names, SI."""
    programme, made = woven.loomed.programme, woven.loomed.design
    return {
        **chart_results(woven.charted),
        "heads": programme.heads,
        "heads_max": made.heads_max,
        "weaving_time": programme.duration,
        "knot_time": made.times.knot,
        "row_time": made.times.weft,
        "colour_changes": int(programme.work.changes.sum()),
        "warps": made.warps,
        "warp_pitch": made.params.pitch,
    }


def weave_json(woven: WeaveResult) -> dict[str, Any]:
    """The JSON of the job."""
    return job_json(
        "weave",
        {**woven.charted.order.as_dict(), **woven.loom_order.as_dict()},
        weave_results(woven),
        checks=[check.as_json() for check in woven.checks],
        notes=list(woven.charted.notes),
        warnings=list(woven.warnings),
        files=woven.files,
    )


def machine_json(woven: WeaveResult) -> dict[str, Any]:
    """The loom's report as JSON, and under `machines` those of its machines by name."""
    machines = {child.machine: child.as_json() for child in woven.loom.children}
    return {**woven.loom.own().as_json(), "machines": machines}


def _label(woven: WeaveResult) -> Label:
    chart, made = woven.charted.chart, woven.loomed.design
    return Label(chart.size, chart.quality, chart.knot, chart.yarns, made.params.pitch, made.cyclograms)


def time_in_words(seconds: float) -> str:
    """A weaving time in hours, short ones in minutes.

    >>> time_in_words(270000.0), time_in_words(90.0)
    ('75 h', '1.5 min')
    """
    return format_quantity(seconds, "h", 3) if seconds >= hour else format_quantity(seconds, "min", 3)


def _page(woven: WeaveResult) -> CarpetPage:
    chart, programme, deadline = woven.charted.chart, woven.loomed.programme, woven.loom_order.deadline
    heads = "as the deadline needs" if deadline is not None else f"{woven.loomed.design.heads_max} would fit"
    facts = [
        Fact("Heads", str(programme.heads), heads),
        Fact("Weaving time", time_in_words(programme.duration), f"{programme.rows} rows"),
    ]
    if deadline is not None:
        facts.append(Fact("Deadline", time_in_words(deadline), "met", "good"))
    return CarpetPage(
        title=woven.charted.order.picture.stem,
        lead=f"{chart.size}, {chart.quality}, {chart.knot} knot",
        chart=chart,
        bill=woven.charted.bill,
        symbols=symbols(len(chart.yarns)),
        facts=tuple(facts),
        reports=(woven.loom.own(), *woven.loom.children),
        checks=woven.own_checks,
        files=woven.notes,
        warnings=(*woven.charted.warnings, *woven.charted.notes, *woven.left_out),
    )
