"""From the file of an order to its chart: what the file states, and what the order changes of it."""

from dataclasses import replace
from typing import Any

import numpy as np

from ilmek.arrays import Rgb
from ilmek.carpet.chart import Chart, chart_of_design
from ilmek.carpet.design import knot_grid
from ilmek.carpet.exact import has_grid, of_grid
from ilmek.carpet.fitting import Fit, fit_notes, fit_picture
from ilmek.carpet.quality import parse_quality
from ilmek.carpet.reading import Design, ReadParams, read_design
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import PictureError
from ilmek.io.chart.png import is_chart_png, read_chart_png
from ilmek.io.picture import read_picture
from ilmek.jobs.order import GROUPS, QUALITY, CarpetOrder, ResolvedOrder, check_sheets
from ilmek.progress import SILENT, Progress

_OF_THE_KNOTS = tuple(group for group in GROUPS if group not in ("plan", "files"))
"""Groups of parameters that act on the knots; the others act on the yarn or the files alone."""


def chart_of_order(order: CarpetOrder, progress: Progress = SILENT) -> tuple[ResolvedOrder, Chart, tuple[str, ...]]:
    """The order with nothing left open, its chart, and notes.

    A chart that ilmek wrote is taken as it is; what the order gives acts on it. Another knot is put in the place of its
    knot. A size or a quality keeps its grid, and the other follows. Yarns, rules of the palette, a fit or a reading act
    on it as on a drawing in its yarns, and so do a size and a quality that do not have its grid.
    Raises PictureError, CarpetError or YarnError.
    """
    chart, notes = _own_chart(order, progress.part(0.0, 0.4, "picture"))
    if chart is None:
        picture = read_picture(order.picture, progress.part(0.0, 0.2, "picture"))
        rgb, notes = picture.rgb, (*notes, *picture.notes)
    else:
        order = _on_the_chart(order, chart)
        made = order.resolved()
        check_sheets(made.size, made.quality, order.pdf)
        if _keeps_knots(order, chart):
            return made, replace(chart, size=made.size, quality=made.quality, knot=made.knot), notes
        rgb = np.array([yarn.srgb for yarn in chart.yarns], dtype=np.uint8)[chart.knots]
        del chart
    made = order.resolved()
    check_sheets(made.size, made.quality, order.pdf)
    design, fit, more = _read_design(made, rgb, progress.part(0.2, 0.4, "chart"))
    del rgb
    made_chart = chart_of_design(
        design,
        made.size,
        made.quality,
        made.yarns,
        knot=made.knot,
        fit=fit,
        palette=order.palette,
        progress=progress.part(0.4, 1.0, "chart"),
    )
    return made, made_chart, (*notes, *more)


def _own_chart(order: CarpetOrder, progress: Progress) -> tuple[Chart | None, tuple[str, ...]]:
    """The chart in the order's file, if it is one; a note where its data cannot be used."""
    if not is_chart_png(order.picture):
        return None, ()
    try:
        chart = read_chart_png(order.picture, progress)
        if not has_grid((chart.rows, chart.columns), chart.size, chart.quality):
            raise PictureError(f"{order.picture} is no knot chart (it does not have the knots of its size and quality)")
    except PictureError as error:
        return None, (f"{error.given}: it is read as a picture",)
    return chart, ()


def _on_the_chart(order: CarpetOrder, chart: Chart) -> CarpetOrder:
    """The order, with what it leaves open from the chart; a size or a quality alone keeps the chart's grid."""
    grid = chart.rows, chart.columns
    size = chart.size if order.size is not None and _same(order.size, chart.size) else order.size
    if (size or chart.size) == chart.size and (order.quality or chart.quality) == chart.quality:
        size, quality = chart.size, chart.quality
    elif size is None or order.quality is None:
        size, quality = of_grid(grid, size, order.quality, parse_quality(QUALITY))
    else:
        quality = order.quality
    return replace(order, size=size, quality=quality, knot=order.knot or chart.knot, yarns=order.yarns or chart.yarns)


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
    given: dict[str, Any] = {group: getattr(order, group) for group in _OF_THE_KNOTS} | {"reading": reading}
    untouched = all(given[group] == GROUPS[group]() for group in _OF_THE_KNOTS)
    return untouched and has_grid((chart.rows, chart.columns), order.size, order.quality)


def _read_design(made: ResolvedOrder, rgb: Rgb, progress: Progress) -> tuple[Design, Fit, tuple[str, ...]]:
    """The design of the picture, how it was fitted, and notes."""
    grid = knot_grid(made.size, made.quality)
    fitted, fit = fit_picture(rgb, made.size, made.order.fit, progress.part(0.0, 0.2), grid=grid)
    design = read_design(fitted, grid, made.order.reading, progress.part(0.2, 1.0))
    return design, fit, fit_notes(fit, fitted.shape[:2], made.size, grid)
