"""Cells without a knot and piles of several heights in the picture of a carpet: flat weave, the cut edge, relief."""

import numpy as np
from PIL import Image

from ilmek.arrays import BoolArray, Rgb
from ilmek.carpet.cells import OUTSIDE
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.usual_pile import usual_pile_height
from ilmek.viz.carpet_edges import flat_band
from ilmek.viz.tufts import Light

_SLOPE = 0.5
"""Share of light that a slope of one takes or gives."""


def with_relief(light: Light, chart: Chart, part: tuple[slice, slice]) -> Light:
    """The light of knots (a part of the chart: rows, columns) where neighbours have piles of several heights.

    A step towards the light, from the upper left, is bright, one away from it dark.
    """
    cells = chart.cells
    if cells is None or all(kind.height is None for kind in cells.kinds if kind.knotted):
        return light
    usual = usual_pile_height(chart.quality)
    heights = [(usual if kind.height is None else kind.height) if kind.knotted else 0.0 for kind in cells.kinds]
    high = np.array(heights, dtype=np.float32)[cells.index[part]] * np.float32(chart.quality.across)
    rise = np.zeros_like(high)
    rise[:, 1:] += np.diff(high, axis=1)
    rise[1:] += np.diff(high, axis=0)
    lit: Light = light * (1.0 + _SLOPE * np.clip(rise, -1.0, 1.0))[:, :, np.newaxis]
    return lit


def with_flat_weave(pile: Rgb, chart: Chart, rng: np.random.Generator, part: tuple[slice, slice]) -> Rgb:
    """The picture of the pile of some cells with flat weave in the place of the cells without a knot."""
    if chart.cells is None:
        return pile
    height, width = pile.shape[:2]
    bare = _on(chart.knots[part] == NO_KNOT, (height, width))
    return np.where(bare[..., np.newaxis], flat_band(height, width, rng), pile) if bare.any() else pile


def cut_out(image: Image.Image, chart: Chart) -> Image.Image | None:
    """Which pixels of the picture of the cells are carpet, for pasting; None: no cell is cut away."""
    if chart.cells is None or not chart.cells.number(OUTSIDE):
        return None
    inside = np.where(chart.cells.are(OUTSIDE), np.uint8(0), np.uint8(255))
    return Image.fromarray(inside).resize(image.size, Image.Resampling.BILINEAR)


def _on(cells: BoolArray, shape: tuple[int, int]) -> BoolArray:
    """Cells on the pixels of a picture of them."""
    rows, columns = (np.arange(side) * given // side for side, given in zip(shape, cells.shape, strict=True))
    pixels: BoolArray = cells[rows[:, np.newaxis], columns]
    return pixels
