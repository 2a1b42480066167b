"""From a carpet picture to a tufting machine and its programme: chart at its gauge, machine, twin, report."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart, used_first
from ilmek.carpet.quality import Quality
from ilmek.errors import ParameterError
from ilmek.io.json_file import write_json
from ilmek.io.output import Outputs, joined
from ilmek.io.tufting_file import read_tufting, write_tufting
from ilmek.jobs.chart import ChartResult, make_charted
from ilmek.jobs.deadline import read_deadline
from ilmek.jobs.loom import make_loomed, params_for, read_loom_order
from ilmek.jobs.making import Making
from ilmek.jobs.order import CarpetOrder
from ilmek.jobs.tufted_chart import UnknottedResult, charted_for, cones_of, yarn_setting
from ilmek.jobs.yarn_choice import kept_checks
from ilmek.machines.tufting_machine import MACHINE, TuftingMachine, TuftingMachineParams
from ilmek.machines.tufting_machine.params import BY_NEEDLE, SCROLLS
from ilmek.machines.tufting_machine.picture import TuftedPicture
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject
from ilmek.report import Check, Json, Report, Result, results_of
from ilmek.units import counted
from ilmek.viz.carpet_picture import draw_carpet
from ilmek.viz.tufted_page import tufting_page
from ilmek.weaving.tufting.programme import BARE, tuft_programme
from ilmek.weaving.tufting.twin import tufted_face

PROGRAMME, PAGE, REPORT, PICTURE = "tufting.txt", "report.html", "report.json", "carpet.png"

DRIVE_PITCH = 0.38
"""Greatest distance of the needle drives where their number is left open [m]; assumed by this project."""

OF_THE_PICTURE = {"width": "--size", "pattern.colours": "--colours"}
"""Parameters that follow from the carpet, and the option that sets each."""


@dataclass(frozen=True, slots=True, eq=False)
class TuftingOrder:
    """What is ordered of a tufting machine: its settings, its parameters as far as they are known, the time [s]."""

    settings: Mapping[str, Setting]
    params: TuftingMachineParams
    deadline: float | None = None

    def params_for(self, needles: int, colours: int, piles: Mapping[str, Setting]) -> TuftingMachineParams:
        """The parameters for a number of needles and of colours; piles: the heights and the share of the low loops."""
        width = needles * self.params.gauge
        left_open: dict[str, Setting] = {"drives": max(2, math.ceil(width / DRIVE_PITCH))}
        if colours > 1 or piles:
            left_open["pattern.attachment"] = SCROLLS
        return TuftingMachineParams.read(
            {**left_open, **self.settings, **piles, "width": width, "pattern.colours": colours}
        )


@dataclass(frozen=True, slots=True)
class TuftingResult(UnknottedResult):
    """A carpet by a tufting machine, the machine's report, and the folder of its files.

    more_notes  beside those of the chart
    """

    order: TuftingOrder
    machine: Report
    tufted: TuftedPicture
    more_notes: tuple[str, ...]

    @property
    def checks(self) -> tuple[Check, ...]:
        """The tufts, the machine, and what the chart keeps of the picture."""
        kept = kept_checks(self.charted.chart, self.charted.order.order)
        return (*self.tufted.checks, *self.machine.all_checks, *kept)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was changed of the picture."""
        return (*self.charted.notes, *self.more_notes)

    @property
    def tufts(self) -> bool:
        """Whether every check holds."""
        return all(check.ok for check in self.checks)

    @property
    def results(self) -> tuple[Result, ...]:
        """Those of the picture."""
        return results_of(self.tufted)


def read_tufting_order(
    order: CarpetOrder, settings: Mapping[str, Setting], deadline: str | None = None
) -> TuftingOrder:
    """The order of a machine from texts.

    Raises ParameterError for a parameter that is none, out of its bounds, or follows from the carpet; UnitError; and
    for a quality: gauge and stitch rate are the resolution.
    """
    if order.quality is not None:
        given = f"--quality {order.quality} with --technique tufting"
        do = "set --tufting gauge=5mm and --tufting stitch_rate=30/dm instead"
        raise ParameterError(given, allowed="gauge and stitch rate of the machine", do=do)
    for name in settings:
        if name in OF_THE_PICTURE:
            raise ParameterError(f"{name} follows from the carpet", do=f"set it by {OF_THE_PICTURE[name]}")
    given_or_count = {**yarn_setting(order), **settings}
    params = TuftingMachineParams.read(given_or_count)
    return TuftingOrder(given_or_count, params, None if deadline is None else read_deadline(deadline))


def weave_by_tufting(
    order: CarpetOrder,
    tufting: TuftingOrder,
    folder: Path,
    *,
    outputs: Outputs | None = None,
    force: bool = False,
    progress: Progress = SILENT,
) -> TuftingResult:
    """Design a machine for a carpet, plan and tuft its programme, and write the files; on an error nothing is written.

    The twin tufts the programme as it is read from its file. Other arguments and errors as of `jobs.weave.weave`.
    """
    with joined(outputs, force=force, progress=progress) as made:
        made.expect_folder(folder, "--out")
        charted, notes = _charted(order, tufting, progress.part(0.0, 0.2, "chart"))
        machine = _machine(charted, tufting)
        report = MACHINE.report(machine, illustrated=False)
        knotted = knotted_cost(order, progress.part(0.3, 0.6, "knotted carpet"))
        labels, cones = charted.chart.knots, cones_of(charted)[: charted.chart.colours]
        params = machine.params
        with made.folder(folder) as work:
            by_needle = params.pattern.selection == BY_NEEDLE
            planning, heights = progress.part(0.6, 0.75, "programme"), loop_heights(charted.chart, params)
            programme = tuft_programme(
                labels, len(cones), params.grid, heights=heights, by_needle=by_needle, progress=planning
            )
            write_tufting(work / PROGRAMME, programme, [(cone.name, cone.colour) for cone in cones])
            programme = read_tufting(work / PROGRAMME)
            face = tufted_face(programme, progress.part(0.75, 0.9, "twin"))
            tufted = TuftedPicture(machine, programme, face, labels, heights, cones, knotted, tufting.deadline)
            result = TuftingResult(charted, folder, tufting, report, tufted, notes)
            if not result.tufts:
                (work / PROGRAMME).unlink()
            bare = bool(((face.colours == BARE) & (labels != BARE)).any())
            drawn = None if bare else draw_carpet(replace(charted.chart, knots=face.colours)).of_pile
            files = {PAGE: True, PICTURE: drawn is not None, PROGRAMME: result.tufts, REPORT: True}
            result = replace(result, written=tuple(name for name, there in files.items() if there))
            if drawn is not None:
                drawn.write_png(work / PICTURE)
            page = tufting_page(
                order.picture.stem,
                tufted,
                results=result.results,
                checks=result.checks,
                files=result.written,
                drawn=drawn,
            )
            (work / PAGE).write_text(page, encoding="utf-8")
            write_json(work / REPORT, tufting_json(result))
    return result


def _charted(order: CarpetOrder, tufting: TuftingOrder, progress: Progress) -> tuple[ChartResult, tuple[str, ...]]:
    """The chart with the yarns that it uses first, and notes; colours left open are at most those of the creel."""
    params, creel = tufting.params, tufting.params.pattern.creel
    quality = Quality(1 / params.gauge, params.stitch_rate)
    charted = charted_for(order, quality, progress.part(0.0, 0.5), noun="tufting", outline=True, piles=True)
    notes: tuple[str, ...] = ()
    if charted.chart.colours > creel > 1 and order.palette.colours is None and order.yarns is None:
        taken = counted(charted.chart.colours, "colour")
        notes = (
            f"the picture has {taken}, the creel {creel}: drawn with these; set --colours or --tufting pattern.creel",
        )
        order = replace(order, palette=replace(order.palette, colours=creel))
        charted = charted_for(order, quality, progress.part(0.5, 1.0), noun="tufting", outline=True, piles=True)
    return replace(charted, chart=used_first(charted.chart)), notes


def _machine(charted: ChartResult, tufting: TuftingOrder) -> TuftingMachine:
    """The machine for a chart. Raises ParameterError for more colours than any creel has."""
    chart = charted.chart
    needles, piles = chart.columns + chart.colours - 1, _piles(chart, tufting.params)
    return MACHINE.design(tufting.params_for(needles, chart.colours, piles))


def loop_heights(chart: Chart, params: TuftingMachineParams) -> FloatArray:
    """The height of the pile of each cell [m]; that of the machine where a cell has none of its own."""
    cells = chart.cells
    if cells is None:
        return np.full(chart.knots.shape, params.pile_height)
    of_kinds = np.array([params.pile_height if kind.height is None else kind.height for kind in cells.kinds])
    return np.asarray(of_kinds[cells.index])


def _piles(chart: Chart, params: TuftingMachineParams) -> dict[str, Setting]:
    """The parameters of the heights of a chart; none where its pile is that of the machine.

    Raises ParameterError for loops in a cut pile, or a cut pile among loops.
    """
    tied = [] if chart.cells is None else [kind for kind in chart.cells.kinds if kind.knotted]
    if any(kind.loop for kind in tied) and not (params.pile == "loop" and all(kind.loop for kind in tied)):
        do = "give heights alone: --tufting pile=loop or pile=cut is for the whole carpet"
        raise ParameterError("tufting of cut pile and loops in one carpet", allowed="one of them", do=do)
    heights = loop_heights(chart, params)[chart.knots != BARE]
    high, low = float(heights.max()), float(heights.min())
    if high == low == params.pile_height:
        return {}
    share = float(np.mean((high - heights) / (high - low))) if high > low else 0.0
    return {"pile_height": f"{high} m", **({"low_height": f"{low} m", "low_share": share} if high > low else {})}


def knotted_cost(order: CarpetOrder, progress: Progress = SILENT) -> float | None:
    """Cost of the carpet knotted on a loom in the quality that is usual, its yarn included; None: not known."""
    charted = make_charted(order, progress.part(0.0, 0.3))
    loom = read_loom_order(order)
    loom = replace(loom, params=params_for(loom, charted))
    loomed = make_loomed(loom, charted, progress.part(0.3, 1.0), illustrated=False, assembled=False)
    making = Making(charted.chart, yarn_bill(charted.chart, order.plan, loom.params.ground), loom.params, loomed)
    costs = [step.cost for step in making.steps]
    known = [cost for cost in costs if cost is not None]
    return sum(known) if known and len(known) == len(costs) else None


def tufting_json(result: TuftingResult) -> JsonObject:
    """The JSON of the job."""
    size, params = result.charted.chart.size, result.tufted.machine.params
    found: dict[str, Json] = {"tufts": result.tufts, "width": size.width, "length": size.length}
    found["machine"] = result.machine.own().as_json()
    own, deadline = params.as_dict(), result.order.deadline
    return result.as_json("tufting", own, deadline, found=found, results=result.results, checks=result.checks)
