"""The carpet's view: charts of a recipe, proposed shades, corners of a photographed carpet, rows to weave by."""

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from hashlib import blake2b

import numpy as np

from ilmek.arrays import Rgb
from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.calling import count_text, row_steps
from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.design import resampled
from ilmek.carpet.fitting import FitParams, prepare_picture
from ilmek.carpet.outline import find_outline
from ilmek.carpet.quality import parse_quality
from ilmek.carpet.rows import row_runs
from ilmek.carpet.sizes import parse_size
from ilmek.carpet.specks import specks as lone_patches
from ilmek.carpet.statistics import chart_statistics
from ilmek.errors import IlmekError, ParameterError
from ilmek.io.chart.symbols import signs_of_codes
from ilmek.io.picture import SMALLEST
from ilmek.io.rendered.resolution import Rendering
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.chart import ChartResult, make_charted
from ilmek.jobs.charting import file_key
from ilmek.jobs.order import CarpetOrder, order_of_data
from ilmek.jobs.recipe import picture_pixels
from ilmek.jobs.studio.answers import Binary, Context, packed
from ilmek.jobs.studio.carpet.answers import (
    MOST_MERGED,
    AssignedColour,
    ChartAnswer,
    ChartRequest,
    ChartYarn,
    Corners,
    HardRow,
    ListedYarn,
    PictureAbout,
    PictureRequest,
    Proposal,
    ProposalRequest,
    RowAnswer,
    RowRequest,
    RowRun,
    ShadeToDye,
    SourcePicture,
    Specks,
    SpecksRequest,
)
from ilmek.jobs.studio.carpet.stages import KeptStages, has_draft
from ilmek.jobs.studio.checks import shown_check
from ilmek.jobs.studio.project.folder import ProjectFolder
from ilmek.jobs.studio.words import all_in_page, in_page
from ilmek.jobs.yarn_choice import assignment_results, proposed_shades
from ilmek.records import alike
from ilmek.sentences import changed

MOST_SHADES = 60
"""Largest number of shades that are proposed."""

MOST_SPECK = 99
"""Knots of the largest patch that is looked for as a speck: the largest that a reading merges."""


def prepare() -> None:
    """Load the kernels of a chart by making a small one of a photo."""
    noise = np.random.default_rng(1).integers(0, 256, (64, 64, 3), dtype=np.uint8)
    made = make_chart(noise, parse_size("16x16cm"), parse_quality("20x20/dm"), default_yarns())
    yarn_bill(made)
    chart_statistics(made)


def chart(request: ChartRequest, context: Context) -> Binary:
    """The chart of a recipe: `ChartAnswer`, then its knots, then the fitted picture where the caller lacks it.

    Raises IlmekError as `ilmek chart`.
    """
    began = time.perf_counter()
    chart_result = _charted(request, context, KeptStages(request.draft))
    source, pixels = _source(chart_result.source, request.source)
    about = replace(_answer(chart_result, request.draft, time.perf_counter() - began), source=source)
    return packed(about, chart_result.chart.shaded.tobytes(), *pixels)


def specks(request: SpecksRequest, context: Context) -> Binary:
    """The specks of the chart of a recipe: `Specks`, then their knots and the yarns around them. Raises IlmekError."""
    if not 1 <= request.most <= MOST_SPECK:
        raise ParameterError(f"specks of {request.most} knots", allowed=f"1 to {MOST_SPECK}")
    made = _charted(request, context, KeptStages()).chart
    patches = lone_patches(made.knots, request.most, context.progress)
    about = Specks(tuple(patches.sizes[1:].tolist()), len(patches.knots), tuple(yarn.name for yarn in made.yarns))
    return packed(about, patches.knots.astype("<u4").tobytes(), patches.around.tobytes())


def proposal(request: ProposalRequest, context: Context) -> Proposal:
    """The shades that suit the picture of a recipe best, to dye or to match. Raises IlmekError."""
    if not 2 <= request.count <= MOST_SHADES:
        raise ParameterError(f"{request.count} shades", allowed=f"2 to {MOST_SHADES}")
    with _plain_errors(context):
        order = _order(request, context)
        order = replace(order, palette=replace(order.palette, propose=request.count))
        chart_result = make_charted(order, context.progress, with_source=True, stages=KeptStages())
    shades = proposed_shades(chart_result.chart)
    return Proposal(
        tuple(
            ShadeToDye(shade.shade.name, shade.shade.hex, shade.shade.share, shade.nearest, shade.difference)
            for shade in shades
        )
    )


def corners(request: PictureRequest, context: Context) -> Corners:
    """The corners of a carpet photographed at an angle. Raises PictureError where its outline is not clear."""
    with _plain_errors(context):
        rgb, _ = _pixels(request, context)
        found, clearness = find_outline(rgb, context.progress)
    return Corners(tuple((x, y) for x, y in found.tolist()), clearness)


def picture(request: PictureRequest, context: Context) -> Binary:
    """A picture of the project as it is read, made small: `PictureAbout`, then its pixels. Raises PictureError."""
    with _plain_errors(context):
        rgb, notes = _pixels(request, context)
        fitting = FitParams.read({"corners": request.corners or None, "turn": request.turn or 0.0})
        rgb, _ = prepare_picture(rgb, fitting, context.progress)
    height, width = rgb.shape[:2]
    scale = min(1.0, max(64, min(request.most, 4000)) / max(height, width))
    shown = resampled(rgb, max(1, round(scale * height)), max(1, round(scale * width)), context.progress)
    about = PictureAbout(width, height, shown.shape[1], shown.shape[0], notes)
    return packed(about, shown.tobytes())


def row(request: RowRequest, context: Context) -> RowAnswer:
    """A row of the chart of a recipe to weave by. Raises ParameterError for a row that is not in the chart."""
    made = _charted(request, context, KeptStages()).chart
    if not 1 <= request.row <= made.rows:
        raise ParameterError(f"row {request.row}", allowed=f"1 to {made.rows}, from the lower edge")
    runs = tuple(
        RowRun(run.first + 1, run.cells, run.knots, min(run.yarn, len(made.shades) - 1), run.mark, run.second)
        for run in row_runs(made, request.row)
    )
    right, left = (_row_text(made, request.row, direction) for direction in ("right", "left"))
    return RowAnswer(request.row, made.rows, made.columns, runs, right, left, _yarns(made))


def _row_text(made: Chart, number: int, direction: str) -> str:
    """A row by its runs, like `12A 3B 2½AC`."""
    signs = signs_of_codes(made.yarns)
    words = []
    for step in row_steps(made, number, "runs", direction):
        sign, second = signs[step.yarn], signs[step.second] if "½" in count_text(step) else ""
        words.append(f"{count_text(step)}{':' if sign.isdigit() else ''}{sign}{second}")
    return f"{number} {'>' if direction == 'right' else '<'} {' '.join(words)}"


def _order(request: ChartRequest | ProposalRequest | RowRequest | SpecksRequest, context: Context) -> CarpetOrder:
    """The order of the recipe of a request, whose file need not be saved."""
    return order_of_data(_folder(context).path(request.path), request.recipe)


def _charted(request: ChartRequest | RowRequest | SpecksRequest, context: Context, stages: KeptStages) -> ChartResult:
    """The chart of a request, with the last ones kept."""
    with _plain_errors(context):
        order = _order(request, context)
        files = tuple(file_key(path) for path in order.inputs.values() if path != order.picture)
        key = (context.project, request.path, json.dumps(request.recipe, sort_keys=True), files)

        def made() -> ChartResult:
            draft, kept = _in_shades(order, stages)
            return make_charted(draft, context.progress, with_source=True, stages=kept)

        return stages.keep("charted", key, made)


def _in_shades(order: CarpetOrder, stages: KeptStages) -> tuple[CarpetOrder, KeptStages]:
    """The order of a draft without a list of yarns: in the shades of the last whole chart, where it chose as this."""
    last = stages.last("charted")
    if not stages.draft or not order.dyed or not isinstance(last, ChartResult) or not last.chart.reading.dyed:
        return order, stages
    before = last.order.order
    if any(getattr(before, name) != getattr(order, name) for name in ("recipe", "palette", "inputs")):
        return order, stages
    if _whole(before.fit) != _whole(order.fit):
        return order, stages
    if not has_draft(last.chart.reading.kind, last.chart.knots.size):
        return order, stages
    shades = replace(order, yarns=last.chart.yarns, palette=replace(order.palette, colours=None))
    return shades, replace(stages, in_shades=True)


def _whole(fit: FitParams) -> FitParams:
    """The fit of the whole picture, upright: the colours of its parts are taken to be like its own."""
    return replace(fit, crop=None, turn=0.0)


def _folder(context: Context) -> ProjectFolder:
    return ProjectFolder(context.folder.resolve())


def _pixels(request: PictureRequest, context: Context) -> tuple[Rgb, tuple[str, ...]]:
    path, rendering = _folder(context).path(request.picture), Rendering(request.page)
    return KeptStages().keep(
        "tile",
        (file_key(path), SMALLEST, None, rendering),
        lambda: picture_pixels(path, SMALLEST, context.progress, rendering=rendering),
    )


@contextmanager
def _plain_errors(context: Context) -> Iterator[None]:
    """Name files as in the project, and leave out the line of data that have no text."""
    try:
        yield
    except IlmekError as error:
        base = f"{context.folder.resolve()}/"
        parts = (changed(text, lambda part: part.replace(base, "")) for text in (error.given, error.allowed, error.do))
        given, allowed, do = parts
        raise type(error)(given, allowed=allowed, do=do) from None


def _source(shown: Rgb | None, known: str) -> tuple[SourcePicture | None, tuple[bytes, ...]]:
    """Key and sides of the fitted picture, and its pixels where the caller lacks them."""
    if shown is None:
        return None, ()
    pixels = shown.tobytes()
    key = blake2b(pixels, digest_size=8).hexdigest()
    about = SourcePicture(key, shown.shape[1], shown.shape[0], key != known)
    return about, (() if key == known else (pixels,))


def _yarns(made: Chart) -> tuple[ChartYarn, ...]:
    signs = signs_of_codes(made.yarns)
    return tuple(ChartYarn(yarn.name, yarn.hex, signs[index]) for index, yarn in enumerate(made.shades))


def _needed(result: ChartResult) -> tuple[ChartYarn, ...]:
    """The yarns of a chart with what is needed of them."""
    yarns = list(_yarns(result.chart))
    for index, need in zip(result.chart.used, result.bill.pile, strict=True):
        own = yarns[index]
        yarns[index] = alike(ChartYarn, need, name=own.name, srgb=own.srgb, symbol=own.symbol)
    return tuple(yarns)


def _assignment(chart: Chart) -> tuple[AssignedColour, ...]:
    """The yarn of each colour of a drawing."""
    rows = assignment_results(chart)
    return tuple(AssignedColour(**{**row, "merged_with": tuple(row["merged_with"][:MOST_MERGED])}) for row in rows)


def _answer(result: ChartResult, draft: bool, seconds: float) -> ChartAnswer:
    chart, bill, reading = result.chart, result.bill, result.chart.reading
    return alike(
        ChartAnswer,
        chart,
        width=chart.size.width,
        length=chart.size.length,
        quality=str(chart.quality),
        reading=reading.kind,
        reason=reading.reason,
        fit=reading.fit.words,
        yarns=_needed(result),
        ground=tuple(replace(need, name=in_page(need.name)) for need in bill.ground),
        listed=tuple(ListedYarn(yarn.name, yarn.hex) for yarn in result.order.yarns),
        assignment=_assignment(chart),
        hardest=tuple(HardRow(number, result.statistics.of_row(number)) for number in result.statistics.hardest),
        mean_changes=result.statistics.mean_changes,
        edited=reading.edited,
        mean_delta_e=reading.mean_delta_e,
        mass=bill.mass,
        mass_per_area=bill.mass_per_area,
        price=bill.price,
        currency=bill.currency,
        checks=tuple(shown_check(check) for check in result.checks),
        warnings=all_in_page(result.warnings),
        notes=all_in_page(result.notes),
        half_knots=sum(chart.tied.half),
        jufti_knots=sum(chart.tied.jufti),
        draft=draft and has_draft(reading.kind, chart.knots.size),
        seconds=seconds,
    )
