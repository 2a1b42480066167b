"""From a carpet picture to chart, yarn, loom, programme and report."""

from dataclasses import dataclass, replace
from pathlib import Path

from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.cells import PILE
from ilmek.carpet.chart import Chart
from ilmek.io.drawing_in import write_drawing_in
from ilmek.io.json_file import write_json
from ilmek.io.output import Outputs, joined
from ilmek.io.programme_file import write_programme
from ilmek.jobs.carpet_files import file_notes
from ilmek.jobs.carpet_report import page_of
from ilmek.jobs.chart import ChartResult, chart_results, job_json, make_charted, write_chart
from ilmek.jobs.loom import LoomOrder, LoomResult, make_loomed, params_for
from ilmek.jobs.loom_space import loom_in_space
from ilmek.jobs.making import Making
from ilmek.jobs.order import CarpetOrder
from ilmek.jobs.yarn_warnings import currency_warning
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.programme import Programme
from ilmek.machines.automated_loom.assembly import LoomAssembly
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.hand_loom import HandLoom
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject
from ilmek.report import NEAREST, Check, Json, Report, at_most, declared_results, must, verdict_json
from ilmek.report.left_out import made_or_left_out
from ilmek.report.shown import Shown
from ilmek.sentences import Sentence
from ilmek.units import counted, format_quantity, hour
from ilmek.viz.carpet_page import CarpetPage, carpet_page
from ilmek.viz.carpet_picture import DrawnCarpet
from ilmek.viz.loom_page import BAD, GOOD, LoomPage, loom_page
from ilmek.viz.page_parts import Fact, FileNote


@dataclass(frozen=True, slots=True)
class WeaveResult(Shown):
    """Results of the job, and the folder of its files.

    written   names of the files in the folder; there is no programme where the loom cannot weave the carpet
    left_out  warnings: figures and files that could not be made
    """

    charted: ChartResult
    loom_order: LoomOrder
    loomed: LoomResult
    folder: Path
    written: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()

    @property
    def making(self) -> Making:
        """The carpet on its loom, and its making."""
        return Making(self.charted.chart, self.charted.bill, self.loom_order.params, self.loomed)

    @property
    def loom(self) -> Report:
        """The loom's report, with those of its machines."""
        return self.loomed.report

    @property
    def weaves(self) -> bool:
        """Whether the loom weaves the carpet: every check holds."""
        return all(check.ok for check in self.checks)

    @property
    def checks(self) -> tuple[Check, ...]:
        """All checks: of the job, the loom and its machines; the latter begin with the machine's name."""
        own = {check.name for check in self.own_checks}
        return (*self.own_checks, *(check for check in self.loom.all_checks if check.name not in own))

    @property
    def own_checks(self) -> tuple[Check, ...]:
        """Checks of the job: the carpet, its overlay, and the deadline if one is given."""
        by_loom = () if self.loomed.made is not None and self.loomed.made.weavers else pile_checks(self.charted.chart)
        return (*self.charted.checks, *overlay_checks(self.charted.chart), *by_loom, *self.loomed.checks)

    @property
    def warnings(self) -> tuple[str, ...]:
        """All warnings: of the carpet, the loom and its machines."""
        currency = currency_warning(self.charted.bill.currency, self.loom_order.params.prices)
        found = (*self.charted.warnings, currency, *self.loomed.notes, *self.loom.all_warnings, *self.left_out)
        return tuple(filter(None, found))

    @property
    def notes(self) -> tuple[FileNote, ...]:
        """The files that are written, with descriptions."""
        return file_notes(self.written)

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

    Where the loom cannot weave the carpet, there is no programme among the files, and the report has the reasons.

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
    charted = make_charted(order, progress.part(0.0, 0.4, "picture"), with_source=True)
    loom_order = replace(loom_order, params=params_for(loom_order, charted))
    loomed = make_loomed(loom_order, charted, progress.part(0.4, 0.5, "loom"))
    ground = loom_order.params.ground
    charted = replace(charted, bill=yarn_bill(charted.chart, order.plan, ground), ground=ground)
    woven = WeaveResult(charted, loom_order, loomed, folder)
    left_out: list[str] = []
    with outputs.folder(folder) as work:
        of_chart, drawn = write_chart(charted, work, left_out, progress.part(0.5, 0.7, "chart"))
        written = (*of_chart, *_write_loom(woven, work, progress.part(0.7, 0.8, "programme")))
        write_json(work / "machine.json", machine_json(woven))
        written = ("report.html", "loom.html", *written, "machine.json", "report.json")
        woven = replace(woven, written=written, left_out=tuple(left_out))
        drawing = progress.part(0.8, 1.0, "report")
        pages = {
            "loom.html": lambda: loom_page(_loom_page(woven), left_out, drawing.part(0.0, 0.5)),
            "report.html": lambda: carpet_page(_carpet_page(woven, drawn), left_out, drawing.part(0.5, 1.0)),
        }
        for name, make in pages.items():
            page = made_or_left_out(name, make, left_out)
            if page is not None:
                (work / name).write_text(page, encoding="utf-8")
            else:
                written = tuple(one for one in written if one != name)
            woven = replace(woven, written=written, left_out=tuple(left_out))
        write_json(work / "report.json", weave_json(woven))
    return woven


def overlay_checks(chart: Chart) -> tuple[Check, ...]:
    """That every knot is on two warps, as the loom ties it; failed for a chart with half knots or jufti knots."""
    if not len(chart.overlay):
        return ()
    halves, juftis = counted(2 * chart.overlay.halves, "half knot"), counted(chart.overlay.juftis, "jufti knot")
    source = f"{halves}, {juftis}; the loom ties none"
    cure = "weave by hand from rows.pdf, or leave the overlay out"
    return (must("every knot on two warps", False, source).with_cure(cure),)


def pile_checks(chart: Chart) -> tuple[Check, ...]:
    """That all knots have one pile, as the knife of a head cuts it; none for a chart without piles of their own."""
    if chart.cells is None or all(kind == PILE for kind in chart.cells.kinds if kind.knotted):
        return ()
    piles = [kind for kind in chart.cells.kinds if kind.knotted]
    heights = len({kind.height for kind in piles if not kind.loop})
    loops = sum(count for kind, count in zip(chart.cells.kinds, chart.cells.counts, strict=True) if kind.loop)
    cure, source = Sentence("check.pile-by-hand"), Sentence("check.one-knife")
    return (
        at_most(Sentence("check.pile-heights"), heights, 1, "1", source).with_cure(cure),
        at_most(Sentence("check.pile-loops"), loops, 0, "1", source).with_cure(cure),
    )


def _write_loom(woven: WeaveResult, folder: Path, progress: Progress) -> tuple[str, ...]:
    """Write drawing-in list and programme if the loom weaves the carpet; returns the names of the written files."""
    setup, programme, made = woven.loomed.setup, woven.loomed.programme, woven.loomed.made
    if not woven.weaves or made is None:
        return ()
    write_drawing_in(folder / "drawing-in.csv", woven.making.warping, made.warp_guide)
    if setup is None or programme is None:
        return ("drawing-in.csv",)
    write_programme(folder / "programme.ilmek", CompiledProgramme(setup, programme), progress=progress)
    return ("drawing-in.csv", "programme.ilmek")


def weave_results(woven: WeaveResult) -> JsonObject:
    """The results of the job by their JSON names, SI; those of the loom are null where it cannot be designed."""
    programme, made, tied = woven.loomed.programme, woven.loomed.design, woven.loomed.made
    of_loom = {result.name: result.value for result in woven.loom.results}
    return {
        "weaves": woven.weaves,
        "row_pitch_left": woven.loomed.row_pitch_left,
        "nearest": woven.loom[NEAREST] if woven.loom_order.existing is None and woven.loomed.hand is None else [],
        **{name: of_loom.get(name) for name in _OF_THE_PARTS},
        **chart_results(woven.charted),
        "heads": programme.heads if programme else 0 if tied and tied.weavers else None,
        "heads_max": tied and tied.heads_max,
        "weavers": tied and tied.weavers,
        **woven.making.as_json(),
        "weaving_time": woven.loomed.weaving_time,
        "time_bound": programme and programme.bound,
        "time_naive": programme and programme.naive.time,
        "knot_time": made and made.times.knot,
        "row_time": made and made.times.weft,
        "colour_changes": programme and int(programme.work.changes.sum()),
        "changes_naive": programme and programme.naive.changes,
        "package_changes": programme and len(programme.tubes.changes),
        "warps": tied and tied.params.cloth.warps,
        "warp_pitch": tied and tied.params.cloth.warp_pitch,
    }


_OF_THE_PARTS = (*(one.name for one in declared_results(LoomAssembly)), "driven_axes")
"""Results of the loom's parts against each other, and how many of its axes are driven."""


def weave_json(woven: WeaveResult) -> dict[str, Json]:
    """The JSON of the job."""
    return job_json(
        "weave",
        {**woven.charted.order.as_dict(), **woven.loom_order.as_dict()},
        weave_results(woven),
        checks=woven.checks,
        choices=[choice.as_json() for choice in woven.loom.all_choices],
        notes=list(woven.charted.notes),
        warnings=list(woven.warnings),
        files=woven.files,
    )


def machine_json(woven: WeaveResult) -> dict[str, Json]:
    """The loom's report as JSON, and under `machines` those of its machines by name."""
    machines = {child.machine: child.as_json() for child in woven.loom.children}
    return {**woven.loom.own().as_json(), **verdict_json(woven.loom.all_checks), "machines": machines}


def time_in_words(seconds: float) -> str:
    """A weaving time in hours, short ones in minutes.

    >>> time_in_words(270000.0), time_in_words(90.0)
    ('75 h', '1.5 min')
    """
    return format_quantity(seconds, "h", 3) if seconds >= hour else format_quantity(seconds, "min", 3)


def order_in_words(programme: Programme) -> str:
    """How good the order of tying is: the least time of any, and that of the naive one.

    The bound is of the same heads with the same parts of a row.
    """
    over, saved = programme.duration / programme.bound - 1, 1 - programme.duration / programme.naive.time
    least = f"at most {over:.2%} above the least of any order"
    return f"{least}, {saved:.1%} below row by row" if saved >= 5e-4 else least


def _carpet_page(woven: WeaveResult, drawn: DrawnCarpet | None) -> CarpetPage:
    charted = woven.charted
    return page_of(
        charted.order.order.picture.stem,
        charted.chart,
        charted.bill,
        woven.written,
        statistics=charted.statistics,
        source=charted.source,
        whole=charted.whole,
        facts=_loom_facts(woven),
        making=tuple(woven.making.in_words),
        good=GOOD,
        bad=BAD,
        checks=woven.checks,
        warnings=(*charted.warnings, *charted.notes, *woven.loomed.notes, *woven.left_out),
        loom="loom.html",
        nearest=woven.loom.nearest,
        drawn=drawn,
    )


def _loom_page(woven: WeaveResult) -> LoomPage:
    chart, made = woven.charted.chart, woven.loomed.made
    of_machines = {check.name for report in (woven.loom.own(), *woven.loom.children) for check in report.checks}
    return LoomPage(
        title=f"Loom for {woven.charted.order.order.picture.stem}",
        lead=f"{chart.size}, {chart.quality}, {chart.knot} knot",
        back="report.html",
        reports=(woven.loom.own(), *woven.loom.children),
        checks=tuple(check for check in woven.own_checks if check.name not in of_machines),
        warnings=woven.loomed.notes,
        choices=woven.loom.all_choices,
        nearest=woven.loom.nearest,
        space=None if made is None else loom_in_space(made, woven.loom, chart),
    )


def _loom_facts(woven: WeaveResult) -> tuple[Fact, ...]:
    """Heads or weavers, weaving time and deadline of the loom; none where it cannot be designed."""
    made, programme, deadline = woven.loomed.made, woven.loomed.programme, woven.loom_order.deadline
    time = woven.loomed.weaving_time
    if made is None or time is None:
        return ()
    size = Fact("Woven", woven.making.size_in_words)
    facts = (size, *(_of_weavers(made, time) if programme is None else _of_heads(made, programme)))
    if deadline is None:
        return facts
    met = time <= deadline
    return (*facts, Fact("Deadline", time_in_words(deadline), "met" if met else "missed", "good" if met else "bad"))


def _of_weavers(made: LoomDesign | HandLoom, time: float) -> tuple[Fact, ...]:
    """Weavers, their days and their wage."""
    return (
        Fact("Weavers", str(made.weavers), f"{made.knotters_max} would fit"),
        Fact("Weaving time", time_in_words(time), days_in_words(made, time)),
        Fact("Wage", f"{wage(made, time):,.0f}", "of the weavers, for this time"),
    )


def days_in_words(made: LoomDesign | HandLoom, time: float) -> str:
    """A time of the weavers of a loom [s] in days of their hours."""
    day = made.params.cost.weaver_day
    return f"{time / day:.1f} days of {format_quantity(day, 'h')}"


def wage(made: LoomDesign | HandLoom, time: float) -> float:
    """What the weavers of a loom are paid for a time of weaving [s]."""
    return made.weavers * made.params.cost.wage * time


def _of_heads(made: LoomDesign | HandLoom, programme: Programme) -> tuple[Fact, ...]:
    """Heads, weaving time and stops of a programme."""
    stops = programme.stops
    packages = len(programme.tubes.changes)
    return (
        Fact("Heads", str(programme.heads), f"{made.heads_max} would fit"),
        Fact("Weaving time", time_in_words(programme.duration), f"{programme.rows} rows; {order_in_words(programme)}"),
        Fact("Planned stops", str(len(stops)), f"{time_in_words(programme.stop_time)}; {packages} packages changed"),
    )
