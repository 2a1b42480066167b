"""What is not even pile of wool in the picture of a carpet: flat weave, the cut edge, relief, carved lines, silk."""

from dataclasses import replace

import numpy as np
from PIL import Image

from ilmek.arrays import BoolArray, Rgb
from ilmek.carpet.carving import carved
from ilmek.carpet.cells import OUTSIDE
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import CODES, NO_KNOT
from ilmek.carpet.usual_pile import usual_pile_height
from ilmek.elements.yarns import SILK
from ilmek.viz.carpet_edges import flat_band
from ilmek.viz.tufts import Light

_SLOPE, _SHEEN, _GROOVE = 0.5, 0.16, 0.6
"""Share of light that a slope of one takes or gives, most white that silk mirrors, what a groove's bottom loses."""


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


def with_sheen(light: Light, chart: Chart, rng: np.random.Generator, part: tuple[slice, slice]) -> Light:
    """The light of knots (a part of the chart: rows, columns) with the gloss of silk: white beside its colour.

    Its smooth fibres mirror, more or less by how a tuft leans.
    """
    silk = np.zeros(CODES, dtype=bool)
    silk[: len(chart.yarns)] = [yarn.material == SILK.name for yarn in chart.yarns]
    glossy = silk[chart.knots[part]]
    if glossy.any():
        light[glossy] += np.float32(_SHEEN) * rng.random((np.count_nonzero(glossy), 1), dtype=np.float32)
    return light


def with_carving(pile: Rgb, chart: Chart, part: tuple[slice, slice]) -> Rgb:
    """The picture of the pile of some cells with its carved lines: dark in the groove, from a border of colours on."""
    if chart.cells is None or chart.cells.carving is None:
        return pile
    drawn = replace(chart.cells, index=chart.cells.index[part])
    aside, above = carved(chart.knots[part], chart.yarns, drawn)
    (rows, columns), (height, width) = chart.knots[part].shape, pile.shape[:2]
    groove = chart.cells.carving.half_width
    dark = np.zeros((height, width), dtype=np.float32)
    for lines, pitch, axis in ((aside, chart.quality.across, 1), (above, chart.quality.along, 0)):
        number, pixels = ((rows, height), (columns, width))[axis]
        at = (np.arange(pixels) + 0.5) * number / pixels
        cell = at.astype(int)
        for border, away in ((cell, at - cell), (cell + 1, cell + 1 - at)):
            there = np.pad(lines, [(1, 1) if side == axis else (0, 0) for side in (0, 1)])
            line = _on(np.take(there, border, axis=axis), (height, width))
            share = np.clip(1.0 - away / max(groove * pitch, number / pixels), 0.0, 1.0).astype(np.float32)
            np.maximum(dark, line * np.expand_dims(share, 1 - axis), out=dark)
    return np.asarray(pile * (1.0 - _GROOVE * dark[..., np.newaxis]), dtype=np.uint8)


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
