"""The shape of an order: its outline from the picture's transparent parts, or from a file, on the grid of its chart."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy import ndimage

from ilmek.arrays import Indices, Rgb, UInt8
from ilmek.carpet.carving import require_carved
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.design import encoded, resampled
from ilmek.carpet.fitting import FitParams, prepare_picture
from ilmek.carpet.shape import PICTURE, require_wide, shaped
from ilmek.errors import CarpetError
from ilmek.io.picture import read_picture
from ilmek.io.rendered.resolution import Rendering
from ilmek.jobs.charting import OrderedChart
from ilmek.jobs.order import CarpetOrder

_HALF = int(encoded(0.5))
"""Least code of a cell that is inside: half of its light, as areas are averaged."""

_TOUCHED = int(encoded(0.01))
"""Least code of a cell that the outline covers in part, above the grain of a photo."""


_WHITE, _SEEN = 255, 128
"""Code of white; difference on white and on black from which a pixel of a map of the pile is transparent."""

_BLUR = 3
"""Cells inside of an outline that a picture may mix with its ground."""

Codes = UInt8[np.ndarray, "rows columns"]


def with_shape(made: OrderedChart, order: CarpetOrder) -> OrderedChart:
    """The chart of an order with its shape. Raises CarpetError, and PictureError for a file that is no outline."""
    shape, chart = order.shape, made.chart
    base = order.picture.parent if order.recipe is not None else Path()
    covered = None
    if shape.shape == PICTURE:
        path = order.picture if order.recipe is None else order.recipe.picture
        if path is None:
            raise CarpetError("--shape picture: the recipe has several pictures", do="give the outline as a file")
        covered = _of_picture(path, made, order)
    elif shape.file is not None:
        covered = _on_grid(_covered(base / shape.file, Rendering(1, (chart.rows, chart.columns))), made)
    if covered is not None:
        require_wide(covered >= _HALF, covered >= _TOUCHED)
        chart = _inner_yarns(chart, covered)
    levels = None if shape.pile_map is None else _levels(base / shape.pile_map, len(shape.levels), made)
    chart = shaped(chart, shape, None if covered is None else covered >= _HALF, levels)
    require_carved(chart, order.plan.pile(chart.quality))
    return replace(made, chart=chart)


def _levels(path: Path, number: int, made: OrderedChart) -> Indices:
    """The level of each cell in a picture of greys at equal steps: that of most of the cell; NO_KNOT: transparent."""
    rows, columns = made.chart.rows, made.chart.columns
    black, white = _on_black_and_white(path, Rendering(1, (rows, columns)))
    seen = (white.astype(np.int16) - black).max(axis=2) < _SEEN
    level = np.where(seen, np.rint(black.mean(axis=2) / _WHITE * (number - 1)), number).astype(np.uint8)
    shares = [_on_grid(_grey((level == one) * np.uint8(_WHITE)), made) for one in range(number + 1)]
    most = np.argmax(shares, axis=0).astype(np.uint8)
    return np.where(most == number, np.uint8(NO_KNOT), most)


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
    black, white = _on_black_and_white(path, rendering)
    seen = np.abs(white.astype(np.int16) - black).max(axis=2)
    if seen.any():
        cover = (_WHITE - seen).astype(np.uint8)
    elif needed:
        given = f"--shape picture: {path.name} has no transparent part"
        raise CarpetError(given, do="give a shape like round, or an outline as a file")
    else:
        cover = black.max(axis=2)
    return _grey(cover)


def _on_black_and_white(path: Path, rendering: Rendering) -> tuple[Rgb, Rgb]:
    """A picture on a black and on a white ground, which differ where it is transparent."""
    black, white = (read_picture(path, ground=code, rendering=rendering).rgb for code in ("#000000", "#ffffff"))
    return black, white


def _grey(codes: Codes) -> Rgb:
    """Codes of grey as a picture."""
    return np.ascontiguousarray(np.repeat(codes[..., np.newaxis], 3, axis=2))
