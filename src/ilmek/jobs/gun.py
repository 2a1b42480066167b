"""From a carpet picture to the paths of a tufting gun: chart at its resolution, plan, G-code, page and report."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.codes import NO_KNOT, pairs_of_codes
from ilmek.carpet.quality import Quality
from ilmek.errors import ParameterError
from ilmek.io.gcode import write_gcode
from ilmek.io.json_file import write_json
from ilmek.io.output import Outputs, joined
from ilmek.jobs.chart import ChartResult
from ilmek.jobs.deadline import read_deadline
from ilmek.jobs.order import CarpetOrder
from ilmek.jobs.tufted_chart import UnknottedResult, charted_for, cones_of, yarn_setting
from ilmek.jobs.yarn_choice import kept_checks
from ilmek.machines.tufting_gun.design import TuftedByGun, tufted_by_gun
from ilmek.machines.tufting_gun.params import TuftingGunParams
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject
from ilmek.report import Check, Result, results_of
from ilmek.units import format_quantity
from ilmek.viz.gun_page import gun_page
from ilmek.weaving.gun.plan import CELLS, gun_plan
from ilmek.weaving.gun.reduction import OUTSIDE
from ilmek.weaving.tufts import Cone

PROGRAMME, PAGE, REPORT = "gun.ngc", "report.html", "report.json"


@dataclass(frozen=True, slots=True)
class GunOrder:
    """What a gun is asked for: its parameters, and the time for the whole carpet [s]."""

    params: TuftingGunParams
    deadline: float | None = None


@dataclass(frozen=True, slots=True)
class GunResult(UnknottedResult):
    """A carpet by a tufting gun, its results, and the folder of its files."""

    order: GunOrder
    tufted: TuftedByGun
    results: tuple[Result, ...]

    @property
    def checks(self) -> tuple[Check, ...]:
        """What the chart keeps of the picture, then gun and gantry."""
        return (*self.tufted.checks, *kept_checks(self.charted.chart, self.charted.order.order))


def read_gun_order(order: CarpetOrder, settings: Mapping[str, Setting], deadline: str | None = None) -> GunOrder:
    """The order of a gun from texts.

    Raises ParameterError for a parameter that is none or out of its bounds, UnitError, and for a quality: the rows of
    the gun are the resolution.
    """
    if order.quality is not None:
        given = f"--quality {order.quality} with --technique gun"
        raise ParameterError(given, allowed="the rows of the gun", do="set --gun row_spacing=3mm instead")
    params = TuftingGunParams.read({**yarn_setting(order), **settings})
    return GunOrder(params, None if deadline is None else read_deadline(deadline))


def weave_by_gun(
    order: CarpetOrder,
    gun: GunOrder,
    folder: Path,
    *,
    outputs: Outputs | None = None,
    force: bool = False,
    progress: Progress = SILENT,
) -> GunResult:
    """Plan a carpet for a gun and write its files into a folder; on an error nothing is written.

    The programme is written where every check holds. Other arguments and errors as of `jobs.weave.weave`.
    """
    with joined(outputs, force=force, progress=progress) as made:
        made.expect_folder(folder, "--out")
        result = plan_by_gun(order, gun, folder, progress.part(0.0, 0.9, "rows"))
        holds = all(check.ok for check in result.checks)
        result = replace(result, written=(PAGE, *((PROGRAMME,) if holds else ()), REPORT))
        title = order.picture.stem
        with made.folder(folder) as work:
            if holds:
                write_gcode(work / PROGRAMME, result.tufted, title)
            page = gun_page(title, result.tufted, result.results, result.checks, result.written)
            (work / PAGE).write_text(page, encoding="utf-8")
            write_json(work / REPORT, gun_json(result))
    return result


def plan_by_gun(order: CarpetOrder, gun: GunOrder, folder: Path, progress: Progress = SILENT) -> GunResult:
    """The plan of a carpet by a gun; nothing is written."""
    per_metre = CELLS / gun.params.row_spacing
    quality, part = Quality(per_metre, per_metre), progress.part(0.0, 0.6)
    charted = charted_for(order, quality, part, noun="tufting by a gun", outline=True, piles=True)
    chart = charted.chart
    labels, cones, heights = _labels(charted, gun.params.pile_height)
    size = (chart.columns / per_metre, chart.rows / per_metre)
    params, rows = gun.params, progress.part(0.6, 1.0)
    least = params.least_coverage
    plan = gun_plan(labels, size, params.row_spacing, params.feature, least=least, progress=rows)
    tufted = tufted_by_gun(params, plan, cones, heights, gun.deadline)
    return GunResult(charted, folder, gun, tufted, results_of(tufted))


def _labels(charted: ChartResult, usual: float) -> tuple[Indices, tuple[Cone, ...], tuple[float, ...]]:
    """A label for each yarn in each kind of pile: of each cell, and the cone and height [m] of each label.

    usual  height of the pile where the chart has none [m]
    """
    chart, cells, cones = charted.chart, charted.chart.cells, cones_of(charted)
    if cells is None:
        return chart.knots, cones, (usual,) * len(cones)
    pairs = [pair for pair in pairs_of_codes(chart.knots, cells.index).tolist() if pair[0] != NO_KNOT]
    if len(pairs) > OUTSIDE:
        given = f"{len(pairs)} pairs of a yarn and a pile"
        raise ParameterError(given, allowed=f"at most {OUTSIDE}", do="set fewer colours or levels of the pile")
    labels = np.full(chart.knots.shape, OUTSIDE, np.uint8)
    for label, (yarn, kind) in enumerate(pairs):
        labels[(chart.knots == yarn) & (cells.index == kind)] = label
    kinds = [cells.kinds[kind] for _, kind in pairs]
    heights = tuple(usual if kind.height is None else kind.height for kind in kinds)
    named = []
    for (yarn, _), kind, height in zip(pairs, kinds, heights, strict=True):
        pile = f", {format_quantity(height, 'mm')}{', loop' if kind.loop else ''}" if len(set(kinds)) > 1 else ""
        named.append(replace(cones[yarn], name=f"{cones[yarn].name}{pile}"))
    return labels, tuple(named), heights


def gun_json(result: GunResult) -> JsonObject:
    """The JSON of the job."""
    plan, order, checks = result.tufted.plan, result.order, result.checks
    found = {"tufts": all(check.ok for check in checks), "width": plan.width, "length": plan.length}
    return result.as_json(
        "gun", order.params.as_dict(), order.deadline, found=found, results=result.results, checks=checks
    )
