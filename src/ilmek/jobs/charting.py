"""From the file of an order to its chart: what the file states, and what the order changes of it."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from scipy import ndimage

from ilmek.arrays import Indices, Rgb
from ilmek.carpet.cells import CellMap
from ilmek.carpet.chart import Chart, used_first
from ilmek.carpet.chart_making import chart_of_design
from ilmek.carpet.creel import in_creel_order
from ilmek.carpet.design import knot_grid, resampled
from ilmek.carpet.exact import few_colours, has_grid, of_grid, stated_quality
from ilmek.carpet.fitted import fitted_design, shaped_size, unfitted_design
from ilmek.carpet.fitting import Fit, FitParams, fit_notes, prepare_picture
from ilmek.carpet.flat import Flatness, looks_flat
from ilmek.carpet.picture_points import hex_colour
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import Design, ReadParams, toned_design
from ilmek.carpet.size_of_picture import unrounded_size
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.errors import PictureError
from ilmek.io.chart.formats import format_of
from ilmek.io.picture import Picture, read_picture
from ilmek.io.rendered.kind import RENDERED
from ilmek.io.rendered.resolution import Rendering
from ilmek.jobs.order import GROUPS, CarpetOrder, ResolvedOrder, check_sheets
from ilmek.jobs.stages import ANEW, Stages
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.units import counted

SHOWN = 1000
"""Largest side of the picture that a page shows [pixels]."""

_OF_THE_KNOTS = tuple(group for group in GROUPS if group not in ("shape", "plan", "files"))
"""Groups of parameters that act on the knots; the others act on the yarn or the files alone."""


@record
class OrderedChart:
    """The order with nothing left open, its chart, and notes.

    source  the fitted picture, at most SHOWN pixels on its longer side; None where it is not wanted, and where the file
            is a chart that is taken as it is
    whole   the same of the picture before it was cropped to the carpet's proportions; None where it was not
    """

    order: ResolvedOrder
    chart: Chart
    notes: tuple[str, ...]
    source: Rgb | None = None
    whole: Rgb | None = None


def chart_of_order(
    order: CarpetOrder,
    progress: Progress = SILENT,
    *,
    with_source: bool = False,
    stages: Stages = ANEW,
    edited: bool = False,
) -> OrderedChart:
    """The chart of an order.

    edited  edits follow, which name the yarns of the list: an indexed drawing has them, not the positions of its creel

    A chart that ilmek wrote is taken as it is; what the order gives acts on it. Another knot is put in the place of its
    knot. A size or a quality keeps its grid, and the other follows. Yarns, rules of the palette, a fit or a reading act
    on it as on a drawing in its yarns, and so do a size and a quality that do not have its grid.
    Raises PictureError, CarpetError or YarnError.
    """
    file = file_key(order.picture)
    key = (file, order.size, order.quality, order.fit, order.reading.of_picture, order.shape.shape, with_source)
    chart, notes = stages.keep(
        "own chart", (file, order.fit.ground), lambda: _own_chart(order, progress.part(0.0, 0.4, "picture"))
    )
    if chart is not None:
        given, order = order, _on_the_chart(order, chart)
        made = order.resolved()
        check_sheets(made.size, made.quality, order)
        if _keeps_knots(order, chart):
            kept = replace(chart, yarns=made.yarns, size=made.size, quality=made.quality, knot=made.knot)
            return OrderedChart(made, kept, notes)
        of_chart, reading = chart, progress.part(0.2, 0.4, "chart")
        read = stages.keep("read", key, lambda: _read_chart(order, of_chart, given, reading, with_source=with_source))
        del chart, of_chart
    else:
        reading = progress.part(0.0, 0.4)
        read = stages.keep("read", key, lambda: _read_file(order, file, reading, stages, with_source=with_source))
    made = _sized(order, read.size, read.quality).resolved()
    yarns = (made.yarns, order.dyed, stages.in_shades)
    rest = (edited, order.reading, order.palette, made.size, made.quality, made.knot, yarns)

    def chart_of() -> Chart:
        design = toned_design(stages.shown(key, read.design), order.reading.tone, progress.part(0.4, 0.5, "chart"))
        made_chart = chart_of_design(
            design,
            made.size,
            made.quality,
            made.yarns,
            knot=made.knot,
            fit=read.fit,
            reading=order.reading,
            palette=order.palette,
            dyed=order.dyed,
            chosen=stages.in_shades,
            exact=None if order.reading.tone.changes else read.design.colours,
            progress=progress.part(0.5, 1.0, "chart"),
        )
        return _of_indices(made_chart, read, edited=edited)

    chart = stages.keep("chart", (key, rest), chart_of)
    return OrderedChart(made.with_dyed(chart.yarns), chart, (*notes, *read.notes), read.source, read.whole)


def _of_indices(chart: Chart, read: "_ReadPicture", *, edited: bool) -> Chart:
    """The chart with its cells, in the order of an indexed drawing's creel, else by its knots, with why it is not."""
    if read.cells is not None:
        chart = replace(chart, cells=read.cells.on_grid(chart.rows, chart.columns, read.fit.shown).merged())
    if read.indices is None:
        return used_first(chart)
    obstacle = "edits name the yarns of the list" if edited else ""
    if read.fit.words != Fit().words:
        obstacle = "it is turned, cropped or stretched"
    made = in_creel_order(chart, read.indices, obstacle)
    if isinstance(made, Chart):
        return made
    reason = chart.reading.reason + (f"; its indices are not kept as positions of the creel: {made}" if made else "")
    return used_first(replace(chart, reading=replace(chart.reading, reason=reason)))


def rendering_of(order: CarpetOrder) -> Rendering:
    """How a drawing is rendered for the knots of an order."""
    made = order.resolved()
    return Rendering(order.fit.page, knot_grid(made.size, made.quality))


def file_key(path: Path) -> tuple[Path, int, int]:
    """What changes when a file does."""
    try:
        found = path.stat()
    except OSError:
        return path, 0, 0
    return path, found.st_size, found.st_mtime_ns


@record
class _ReadPicture:
    """The design of a picture without changes of its tone, size and quality, how it was fitted, notes, and what a page
    shows; indices of an indexed picture before it was turned or cropped; cells of a chart, on its own grid.
    """

    size: CarpetSize
    quality: Quality
    design: Design
    fit: Fit
    notes: tuple[str, ...]
    source: Rgb | None
    whole: Rgb | None = None
    indices: Indices | None = None
    cells: CellMap | None = None


def _require_upright(order: CarpetOrder, read: _ReadPicture) -> _ReadPicture:
    """What was read. Raises PictureError for a chart with a map of cells that was turned, cropped by hand or padded."""
    of_hand = replace(order.fit, fit=FitParams().fit, ground=None, width=None, length=None, page=1) != FitParams()
    if read.cells is not None and (of_hand or read.fit.turned or read.fit.padded):
        kinds = ", ".join(kind.name for kind in read.cells.kinds)
        given = f"{order.picture.name}, a chart with cells of its own ({kinds}), turned, cropped or with a border"
        raise PictureError(given, allowed="another size, quality or yarns", do="chart the design anew, with its shape")
    return read


def _read_file(
    order: CarpetOrder, file: object, progress: Progress, stages: Stages, *, with_source: bool
) -> _ReadPicture:
    """Read a picture that is no chart."""
    ground, reading_file = order.fit.ground, progress.part(0.0, 0.5, "picture")
    rendering = rendering_of(order)
    of_picture = (file, ground, rendering if order.picture.suffix.lower() in RENDERED else rendering.page)
    picture = stages.keep(
        "picture", of_picture, lambda: read_picture(order.picture, reading_file, ground=ground, rendering=rendering)
    )
    if order.shape.cuts(picture.outside) and picture.rim is not None:  # of the picture's colours: no other takes a yarn
        ground = hex_colour(picture.rim)
        of_picture = (file, ground, of_picture[2])
        picture = read_picture(order.picture, ground=ground, rendering=rendering)
    rgb, notes, behind, indices = picture.rgb, picture.notes, picture.ground, picture.indices
    outside, hidden = picture.outside, picture.hidden
    stated = _stated(order, picture)
    if stated is not None:
        order = replace(order, quality=stated)
        notes = (*notes, f"its resolution is that of knots: {stated}")
    if order.size is not None and order.reading.reading == "auto" and order.fit.fit != FitParams().fit:
        order = replace(order, quality=order.resolved().quality)
    size, fitting = order.size, order.fit
    if behind is not None:
        fitting = replace(fitting, ground=hex_colour(behind))
    rows, columns = rendering.knots

    def prepare() -> tuple[Rgb, Fit, float]:
        taken = stages.to_turn(of_picture, rgb, rows * columns) if fitting.only_turned else rgb
        return *prepare_picture(taken, fitting, progress.part(0.5, 0.6), size=size), len(rgb) / len(taken)

    prepared, fit, scale = stages.keep("prepared", (of_picture, fitting, size), prepare)
    del rgb, picture
    reading = progress.part(0.6, 1.0, "chart")
    read = _read(
        replace(order, fit=fitting),
        prepared,
        fit,
        reading,
        drawn=stated is not None,
        with_source=with_source,
        seen=partial(stages.seen, of_picture),
        scale=scale,
    )
    if order.fit.ground is not None and behind is None and not read.fit.padded:
        notes = (*notes, f"ground={ground!r} is not seen: the picture has no transparent part and no margin")
    whole = shown_source(prepared) if with_source and stages.with_whole and read.fit.kind == "crop" else None
    if fitting.corners is None and fitting.crop is None:
        read = replace(read, fit=replace(read.fit, outside=outside, hidden=hidden))
    return replace(read, notes=(*notes, *read.notes), whole=whole, indices=indices)


def _read_chart(
    order: CarpetOrder, chart: Chart, given: CarpetOrder, progress: Progress, *, with_source: bool
) -> _ReadPicture:
    """Read a chart as a drawing; given: the order without what it has of the chart."""
    prepared, fit = prepare_picture(drawn_chart(chart), order.fit, progress.part(0.0, 0.3))
    drawn = given.size is None and _is_part(prepared, chart)
    if drawn:
        rows, columns = prepared.shape[:2]
        part = (columns / chart.quality.across) / (rows / chart.quality.along)
        size = _with_its_proportions(given, part).size
        drawn = size is None
        quality = order.quality if drawn else given.quality or of_grid((rows, columns), size, None)[1]
        order = replace(order, size=size, quality=quality)
    reading = progress.part(0.3, 1.0)
    seen = partial(ANEW.seen, None)
    read = _read(order, prepared, fit, reading, drawn=drawn, with_source=with_source, seen=seen)
    whole = shown_source(prepared) if with_source and read.fit.kind == "crop" else None
    return _require_upright(
        order, replace(read, notes=(*_flattened(chart), *read.notes), whole=whole, cells=chart.cells)
    )


def _read(
    order: CarpetOrder,
    prepared: Rgb,
    fit: Fit,
    progress: Progress,
    *,
    drawn: bool,
    with_source: bool,
    seen: Callable[[int, Callable[[], Flatness]], Flatness],
    scale: float = 1.0,
) -> _ReadPicture:
    """Read a picture that is turned and cropped; its tone stays.

    fit    what was done to it      drawn  every pixel is a knot, whatever the size      seen  as `Stages.seen` of it
    scale  to the size that it had before a draft made it smaller
    """
    params = order.reading.of_picture
    first = progress.part(0.0, 0.4)
    exact = unfitted_design(
        prepared, order.size, order.quality, fitting=order.fit, reading=params, drawn=drawn, progress=first
    )
    if exact is not None:
        design, size, quality = exact
        check_sheets(size, quality, order)
        return _ReadPicture(size, quality, design, fit, (), shown_source(prepared) if with_source else None)
    size = order.size or shaped_size(prepared, order.resolved().quality, order.fit)
    made = _sized(order, size, order.quality).resolved()
    check_sheets(made.size, made.quality, order)
    reading = progress.part(0.35, 1.0)
    rows, columns = grid = knot_grid(made.size, made.quality)
    design, fitted, fit = fitted_design(
        prepared,
        fit,
        made.size,
        made.quality,
        fitting=order.fit,
        reading=params,
        look=lambda rgb: seen(rows * columns, partial(looks_flat, rgb)),
        progress=reading,
    )
    height, width = fitted.shape[:2]
    notes = fit_notes(fit, (round(scale * height), round(scale * width)), made.size, grid)
    source = shown_source(fitted, design) if with_source else None
    return _ReadPicture(made.size, made.quality, design, fit, notes, source)


def _sized(order: CarpetOrder, size: CarpetSize, quality: Quality | None) -> CarpetOrder:
    """The order with a size, and so without the one side that was given of it."""
    return replace(order, size=size, quality=quality, fit=order.fit.without_sides)


def _stated(order: CarpetOrder, picture: Picture) -> Quality | None:
    """The quality that the picture states, where the order leaves size, quality and reading open."""
    if order.size is not None or order.quality is not None or order.reading.reading not in ("auto", "exact"):
        return None
    return None if replace(order.fit, ground=None) != FitParams() else stated_quality(picture.density, picture.rgb)


def drawn_chart(chart: Chart) -> Rgb:
    """The picture of a chart: each knot one pixel in its yarn's colour, other cells in that of the nearest knot."""
    knots = chart.knots
    if chart.cells is not None:
        row, column = ndimage.distance_transform_edt(~chart.cells.tied, return_distances=False, return_indices=True)
        knots = knots[row, column]
    colours: Rgb = chart.colour_table[knots]
    return colours


def _flattened(chart: Chart) -> tuple[str, ...]:
    """A note on the marks of a chart that is read as a drawing."""
    halves, juftis = counted(chart.overlay.halves, "half knot"), counted(chart.overlay.juftis, "jufti knot")
    return (f"without its {halves} and {juftis}",) if len(chart.overlay) else ()


def _is_part(prepared: Rgb, chart: Chart) -> bool:
    """Whether a picture made from a chart has another grid, and still one knot for each pixel."""
    return prepared.shape[:2] != chart.knots.shape and few_colours(prepared, MOST_YARNS) is not None


def _own_chart(order: CarpetOrder, progress: Progress) -> tuple[Chart | None, tuple[str, ...]]:
    """The chart in the order's file, if it is one, and notes, also where the data of a chart cannot be used."""
    chosen = format_of(order.picture)
    if chosen is None or chosen.read is None:
        return None, ()
    try:
        return chosen.read(order.picture, order.size, order.quality, progress, order.fit.ground)
    except PictureError as error:
        if not chosen.picture:
            raise
        return None, (f"{error.given}: it is read as a picture",)


def _on_the_chart(order: CarpetOrder, chart: Chart) -> CarpetOrder:
    """The order, with what it leaves open from the chart; a size or a quality alone keeps the chart's grid."""
    grid = chart.rows, chart.columns
    order = _with_its_proportions(order, chart.size.width / chart.size.length)
    size = chart.size if order.size is not None and _same(order.size, chart.size) else order.size
    if (size or chart.size) == chart.size and (order.quality or chart.quality) == chart.quality:
        size, quality = chart.size, chart.quality
    elif size is not None and order.quality is None and order.fit.fit != FitParams().fit:
        quality = chart.quality
    elif size is None or order.quality is None:
        size, quality = of_grid(grid, size, order.quality)
    else:
        quality = order.quality
    return replace(order, size=size, quality=quality, knot=order.knot or chart.knot, yarns=order.yarns or chart.yarns)


def _with_its_proportions(order: CarpetOrder, proportions: float) -> CarpetOrder:
    """The order with its size, where it gives one side of a chart's."""
    width, length = order.fit.width, order.fit.length
    if width is None and length is None:
        return order
    return _sized(order, unrounded_size(proportions, width=width, length=length), order.quality)


def _same(one: CarpetSize, other: CarpetSize) -> bool:
    return (one.width, one.length) == (other.width, other.length)


def _keeps_knots(order: CarpetOrder, chart: Chart) -> bool:
    """Whether the order leaves the chart's knots and yarns as they are."""
    if order.yarns != chart.yarns or order.size is None or order.quality is None:
        return False
    reading = order.reading
    if reading.reading == "exact":
        reading = replace(reading, reading=ReadParams().reading)
    if reading.least_patch == 0:
        reading = replace(reading, least_patch=None)
    changed = {"reading": reading, "fit": replace(order.fit, ground=None)}  # all cells of a chart have knots
    given: JsonObject = {group: getattr(order, group) for group in _OF_THE_KNOTS} | changed
    untouched = all(given[group] == GROUPS[group]() for group in _OF_THE_KNOTS)
    return untouched and has_grid((chart.rows, chart.columns), order.size, order.quality)


def shown_source(fitted: Rgb, design: Design | None = None) -> Rgb:
    """The fitted picture, made smaller until its longer side has at most SHOWN pixels.

    design  read from it: the averages of a photo are taken in its place where they are fine enough
    """
    height, width = fitted.shape[:2]
    scale = min(1.0, SHOWN / max(height, width))
    rows, columns = max(1, round(scale * height)), max(1, round(scale * width))
    if design is not None and design.kind == "photo":
        fine = design.colours.shape[0] >= rows and design.colours.shape[1] >= columns
        fitted = design.colours if fine else fitted
    return resampled(fitted, rows, columns)
