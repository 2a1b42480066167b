"""The whole arc: carpet picture in; chart, yarn, loom, programme and report out."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ilmek.io.chart.symbols import symbols
from ilmek.io.json_file import write_json
from ilmek.io.output import output_folder
from ilmek.io.programme_file import Label, write_programme
from ilmek.jobs.chart import ChartResult, chart_results, job_json, make_charted, write_chart
from ilmek.jobs.loom import LoomOrder, LoomResult, make_loomed
from ilmek.jobs.order import CarpetOrder
from ilmek.machines.automated_loom import MACHINE
from ilmek.progress import SILENT, Progress
from ilmek.report import Check, Report, at_most
from ilmek.units import format_quantity, hour
from ilmek.viz.page import CarpetPage, carpet_page
from ilmek.viz.page_parts import Fact, FileNote

FILES = (
    FileNote("report.html", "this page: pictures, yarn, machines, checks"),
    FileNote("report.json", "the same results as data, SI"),
    FileNote("chart.png", "the knot chart, one pixel one knot"),
    FileNote("chart.pdf", "the knot chart to weave from, with symbols and row numbers"),
    FileNote("yarn.csv", "the yarn to buy"),
    FileNote("programme.ilmek", "the loom programme; look into it with `ilmek inspect`"),
    FileNote("machine.json", "the loom and its machines: parameters, results, checks"),
)
"""What a woven folder holds, each file where it is made."""


@dataclass(frozen=True, slots=True)
class WeaveResult:
    """Everything that the job found, and the folder of its files.

    loom   the loom's report, with those of its machines
    """

    charted: ChartResult
    asked: LoomOrder
    loomed: LoomResult
    loom: Report
    folder: Path

    @property
    def checks(self) -> tuple[Check, ...]:
        """Every check: of the whole, the loom and each of its machines, by whose name it begins."""
        return (*self.own_checks, *self.loom.all_checks)

    @property
    def own_checks(self) -> tuple[Check, ...]:
        """Checks of the whole: of the carpet, and the deadline, where there is one."""
        return (*self.charted.checks, *job_checks(self.asked, self.loomed))

    @property
    def warnings(self) -> tuple[str, ...]:
        """Every warning: of the carpet, the loom and its machines."""
        return (*self.charted.warnings, *self.loom.all_warnings)

    @property
    def notes(self) -> tuple[FileNote, ...]:
        """The files that are made."""
        return tuple(file for file in FILES if file.name != "chart.pdf" or file.name in self.charted.files)

    @property
    def files(self) -> list[str]:
        """The paths of the files."""
        return [str(self.folder / file.name) for file in self.notes]


def weave(
    order: CarpetOrder, asked: LoomOrder, folder: Path, *, force: bool = False, progress: Progress = SILENT
) -> WeaveResult:
    """Do the whole job and put its files into a folder, whole or not at all.

    Raises any IlmekError; then nothing is written.
    """
    charted = make_charted(order, progress.part(0.0, 0.4, "picture"))
    progress.part(0.4, 0.5, "loom")
    loomed = make_loomed(asked, order, charted.chart)
    woven = WeaveResult(charted, asked, loomed, MACHINE.report(loomed.design), folder)
    with output_folder(folder, force=force) as work:
        write_chart(charted, work, progress.part(0.5, 0.7, "chart.pdf"))
        write_programme(
            work / "programme.ilmek", loomed.programme, _label(woven), progress=progress.part(0.7, 0.8, "programme")
        )
        write_json(work / "machine.json", machine_json(woven))
        write_json(work / "report.json", weave_json(woven))
        progress.part(0.8, 1.0, "report")
        (work / "report.html").write_text(carpet_page(_page(woven)), encoding="utf-8")
    return woven


def job_checks(asked: LoomOrder, loomed: LoomResult) -> tuple[Check, ...]:
    """The deadline, where there is one."""
    if asked.deadline is None:
        return ()
    return (at_most("weaving time", loomed.programme.duration, asked.deadline, "h", "the deadline asked for"),)


def weave_results(woven: WeaveResult) -> dict[str, Any]:
    """The results of the whole by their stable names, SI."""
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
    """The JSON of the whole."""
    return job_json(
        "weave",
        {**woven.charted.order.as_dict(), **woven.asked.as_dict()},
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
    chart, programme, asked = woven.charted.chart, woven.loomed.programme, woven.asked
    heads = "as the deadline needs" if asked.deadline is not None else f"{woven.loomed.design.heads_max} would fit"
    facts = [
        Fact("Heads", str(programme.heads), heads),
        Fact("Weaving time", time_in_words(programme.duration), f"{programme.rows} rows"),
    ]
    if asked.deadline is not None:
        facts.append(Fact("Deadline", time_in_words(asked.deadline), "met", "good"))
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
        warnings=(*woven.charted.warnings, *woven.charted.notes),
    )
