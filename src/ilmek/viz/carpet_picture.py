"""Simulated picture of a carpet: the chart as pile, with selvedges, flat ends and fringes; and a close-up of the knots.

Tufts are drawn (`tufts`) if a knot has at least two pixels; otherwise the light of the knots is averaged. The same seed
gives the same picture.
"""

import io
import math
from dataclasses import dataclass

import numpy as np
from PIL import Image

from ilmek.arrays import Rgb
from ilmek.carpet.chart import Chart
from ilmek.carpet.colour import LINEAR
from ilmek.carpet.design import resampled_rows
from ilmek.progress import SILENT, Progress
from ilmek.viz.carpet_edges import flat_band, fringe, selvedge
from ilmek.viz.tufts import encoded, tufted, yarn_light

LONGEST = 1400
"""Largest number of pixels along the longer side of the picture."""
_FRINGE, _BAND, _SELVEDGE = 0.055, 0.012, 0.008
"""Length of the fringe, of the flat-woven end, width of the selvedge [m]."""
_CLOSE_UP = (40, 30)
_CLOSE_WIDTH = 960
_FIBRE = 0.10


@dataclass(frozen=True, slots=True)
class _Layout:
    """Sizes of pile and frame [pixels]; a knot has `across` x `down` pixels, 0 if knots are averaged."""

    width: int
    height: int
    across: int
    down: int
    fringe: int
    band: int
    selvedge: int


def carpet_picture(chart: Chart, longest: int = LONGEST, seed: int = 1, progress: Progress = SILENT) -> bytes:
    """The whole carpet as a JPEG file on white, its longer side at most `longest` pixels."""
    rng = np.random.default_rng(seed)
    layout = _layout(chart, longest)
    pile = Image.fromarray(_pile(chart, layout, rng, progress))
    if pile.size != (layout.width, layout.height):
        pile = pile.resize((layout.width, layout.height), Image.Resampling.LANCZOS)
    return _jpeg(_framed(chart, pile, layout, rng), 84)


def close_up(chart: Chart, seed: int = 1) -> bytes:
    """About 40 x 30 knots at the centre of the carpet as a JPEG file, in true proportion."""
    columns, rows = min(_CLOSE_UP[0], chart.columns), min(_CLOSE_UP[1], chart.rows)
    left, top = (chart.columns - columns) // 2, (chart.rows - rows) // 2
    piece = chart.knots[top : top + rows, left : left + columns]
    rng = np.random.default_rng(seed)
    across = _CLOSE_WIDTH // _CLOSE_UP[0]
    down = max(2, round(across * chart.quality.across / chart.quality.along))
    light = yarn_light(piece, [yarn.srgb for yarn in chart.yarns], rng, 0.06)
    return _jpeg(Image.fromarray(encoded(tufted(light, across, down, rng, _FIBRE))), 86)


def _layout(chart: Chart, longest: int) -> _Layout:
    """The proportions follow the carpet's size. Tufts are drawn on whole pixels and then scaled down."""
    width, length = chart.size.width, chart.size.length
    scale = longest / max(width + 2 * _SELVEDGE, length + 2 * (_FRINGE + _BAND))
    across, down = (math.ceil(scale * side - 1e-6) for side in (width / chart.columns, length / chart.rows))
    if min(across, down) < 2:
        across = down = 0
    framing = (max(2, int(scale * side)) for side in (_FRINGE, _BAND, _SELVEDGE))
    return _Layout(max(1, int(scale * width)), max(1, int(scale * length)), across, down, *framing)


def _pile(chart: Chart, layout: _Layout, rng: np.random.Generator, progress: Progress) -> Rgb:
    srgb = [yarn.srgb for yarn in chart.yarns]
    if layout.across:
        return encoded(tufted(yarn_light(chart.knots, srgb, rng, 0.05), layout.across, layout.down, rng))
    height, width = min(layout.height, chart.rows), min(layout.width, chart.columns)
    palette, size = np.array(srgb, dtype=np.uint8), (chart.rows, chart.columns)
    mean = resampled_rows(lambda part: palette[chart.knots[part]], size, (height, width), progress)
    bands = 1.0 + np.repeat(rng.normal(0.0, 0.015, height // 12 + 1), 12)[:height, np.newaxis]
    shade = bands * (0.94 + 0.03 * rng.standard_normal((height, width)))
    return encoded((LINEAR[mean] * shade[:, :, np.newaxis]).astype(np.float32))


def _framed(chart: Chart, pile: Image.Image, layout: _Layout, rng: np.random.Generator) -> Image.Image:
    """The pile with a selvedge left and right, a flat band and a fringe above and below."""
    side, end = layout.selvedge, layout.band + layout.fringe
    whole = Image.new("RGB", (layout.width + 2 * side, layout.height + 2 * end), (255, 255, 255))
    light = _edge_light(chart)
    for left in (0, side + layout.width):
        whole.paste(Image.fromarray(selvedge(layout.height + 2 * layout.band, side, light, rng)), (left, layout.fringe))
    for top in (layout.fringe, end + layout.height):
        whole.paste(Image.fromarray(flat_band(layout.band, layout.width, rng)), (side, top))
    upper = fringe(layout.fringe, layout.width, rng)
    whole.paste(upper.transpose(Image.Transpose.FLIP_TOP_BOTTOM), (side, 0))
    whole.paste(fringe(layout.fringe, layout.width, rng), (side, end + layout.height + layout.band))
    whole.paste(pile, (side, end))
    return whole


def _edge_light(chart: Chart) -> tuple[float, float, float]:
    """The linear colour of the yarn most frequent at the sides, somewhat darkened: the selvedge is overcast in it."""
    edge = np.concatenate([chart.knots[:, 0], chart.knots[:, -1]])
    red, green, blue = LINEAR[list(chart.yarns[int(np.bincount(edge).argmax())].srgb)].tolist()
    return 0.8 * red + 0.01, 0.8 * green + 0.01, 0.8 * blue + 0.01


def _jpeg(picture: Image.Image, quality: int) -> bytes:
    stream = io.BytesIO()
    picture.save(stream, format="JPEG", quality=quality, optimize=True, subsampling=1)
    return stream.getvalue()
