"""The shape of an order: its outline from the picture's transparent parts, or from a file, on the grid of its chart."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy import ndimage

from ilmek.arrays import Rgb, UInt8
from ilmek.carpet.chart import Chart
from ilmek.carpet.design import encoded, resampled
from ilmek.carpet.fitting import FitParams, prepare_picture
from ilmek.carpet.shape import PICTURE, shaped
from ilmek.errors import CarpetError
from ilmek.io.picture import read_picture
from ilmek.io.rendered.resolution import Rendering
from ilmek.jobs.charting import OrderedChart
from ilmek.jobs.order import CarpetOrder

_HALF = int(encoded(0.5))
"""Least code of a cell that is inside: half of its light, as areas are averaged."""


_BLUR = 3
"""Cells inside of an outline that a picture may mix with its ground."""

Codes = UInt8[np.ndarray, "rows columns"]


def with_shape(made: OrderedChart, order: CarpetOrder) -> OrderedChart:
    """The chart of an order with its shape. Raises CarpetError, and PictureError for a file that is no outline."""
    shape, chart = order.shape, made.chart
    covered = None
    if shape.shape == PICTURE:
        path = order.picture if order.recipe is None else order.recipe.picture
        if path is None:
            raise CarpetError("--shape picture: the recipe has several pictures", do="give the outline as a file")
        covered = _of_picture(path, made, order)
    elif shape.file is not None:
        base = order.picture.parent if order.recipe is not None else Path()
        covered = _on_grid(_covered(base / shape.file, Rendering(1, (chart.rows, chart.columns))), made)
    if covered is not None:
        chart = _inner_yarns(chart, covered)
    return replace(made, chart=shaped(chart, shape, None if covered is None else covered >= _HALF))


def _inner_yarns(chart: Chart, covered: Codes) -> Chart:
    """The chart with cells that the outline crosses in the yarn of the nearest cell inside, without the ground's."""
    full = covered == covered.max()
    crossed = ~full & (covered >= _HALF) & ndimage.binary_dilation(covered < _HALF, iterations=_BLUR)
    if not crossed.any() or not full.any():
        return chart
    row, column = ndimage.distance_transform_edt(~full, return_distances=False, return_indices=True)
    return replace(chart, knots=np.where(crossed, chart.knots[row, column], chart.knots))


def _of_picture(path: Path, made: OrderedChart, order: CarpetOrder) -> Codes:
    """How far the picture covers each cell as the carpet shows it."""
    fit, chart = made.chart.reading.fit, made.chart
    covered = _covered(path, Rendering(order.fit.page, (chart.rows, chart.columns)), needed=True)
    corners = None if fit.corners is None else " ".join(f"{x},{y}" for x, y in fit.corners)
    params = replace(order.fit, corners=corners, ground="#000000")
    prepared, _ = prepare_picture(covered, params if fit.corners else replace(params, corners=None), size=chart.size)
    if fit.turned and abs(order.fit.turn - fit.turned) > 1e-6:  # the fit turned it
        prepared, _ = prepare_picture(covered, FitParams(turn=fit.turned, ground="#000000"), size=chart.size)
    left, top, right, bottom = fit.shown
    height, width = prepared.shape[:2]
    rows = np.clip(np.round([top * height, bottom * height]).astype(int), 0, height)
    columns = np.clip(np.round([left * width, right * width]).astype(int), 0, width)
    if min(left, top) < 0 or max(right, bottom) > 1:
        raise CarpetError("--shape picture: the picture has a border", do="--fit crop, or give the outline as a file")
    return _on_grid(np.ascontiguousarray(prepared[slice(*rows), slice(*columns)]), made)


def _on_grid(covered: Rgb, made: OrderedChart) -> Codes:
    """How far each cell of the chart is covered, a code of light."""
    return resampled(covered, made.chart.rows, made.chart.columns)[..., 0]


def _covered(path: Path, rendering: Rendering, *, needed: bool = False) -> Rgb:
    """How far a picture covers what is behind it, 0 to 255, as grey: its opaque part, else its light part.

    needed  Raise CarpetError for a picture without transparent parts

    On white and on black it differs by what is seen of the ground.
    """
    black, white = (read_picture(path, ground=code, rendering=rendering).rgb for code in ("#000000", "#ffffff"))
    seen = np.abs(white.astype(np.int16) - black).max(axis=2)
    if seen.any():
        cover = (255 - seen).astype(np.uint8)
    elif needed:
        given = f"--shape picture: {path.name} has no transparent part"
        raise CarpetError(given, do="give a shape like round, or an outline as a file")
    else:
        cover = black.max(axis=2)
    return np.ascontiguousarray(np.repeat(cover[..., np.newaxis], 3, axis=2))
