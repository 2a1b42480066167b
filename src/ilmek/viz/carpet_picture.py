"""Simulated picture of a carpet: the chart as pile, with selvedges, flat ends and fringes; and a close-up of the knots.

Tufts are drawn (`tufts`) if a knot has at least two pixels, with half knots and jufti knots; otherwise the light of the
knots is averaged, one knot in each cell. The same seed gives the same picture.
"""

import io
import zlib
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from PIL import Image

from ilmek.arrays import Rgb
from ilmek.carpet.chart import Chart
from ilmek.carpet.colour import LINEAR
from ilmek.carpet.design import bands, resampled_rows
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import CarpetError
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.viz.carpet_edges import flat_band, fringe, selvedge
from ilmek.viz.cells_picture import cut_out, with_carving, with_flat_weave, with_relief, with_sheen
from ilmek.viz.tufts import Light, encoded, marked_tufts, tufted, yarn_light

LONGEST = 1400
"""Number of pixels along the longer side of the picture, where no width is given."""

NARROWEST, WIDEST, MOST_PIXELS = 100, 20_000, 60_000_000
"""Bounds of the picture's width, and of its pixels: 60 million take 8 s and 1 GB."""

_LEAST_OF_PAGE = 0.98
"""Least size of a picture that a page can take, in LONGEST."""

_FRINGE, _BAND, _SELVEDGE = 0.055, 0.012, 0.008
"""Length of the fringe, of the flat-woven end, width of the selvedge [m]."""
_CLOSE_UP = (40, 30)
_CLOSE_WIDTH = 960
_FIBRE = 0.10
_ALL = (slice(None), slice(None))
"""All rows and columns."""


@dataclass(frozen=True, slots=True)
class Pile:
    """The pile's part of the picture: left, top, width, height, as shares of the picture's width and height."""

    left: float
    top: float
    width: float
    height: float


WHOLE = Pile(0.0, 0.0, 1.0, 1.0)
"""The pile of a picture without frame."""


@dataclass(frozen=True, slots=True)
class _Layout:
    """Sizes of pile and frame [pixels]."""

    width: int
    height: int
    fringe: int
    band: int
    selvedge: int

    @property
    def whole(self) -> tuple[int, int]:
        """Width and height of the picture."""
        return self.width + 2 * self.selvedge, self.height + 2 * (self.fringe + self.band)

    @property
    def pile(self) -> Pile:
        """Where the picture shows the pile."""
        width, height = self.whole
        top = self.fringe + self.band
        return Pile(self.selvedge / width, top / height, self.width / width, self.height / height)


@record
class DrawnCarpet:
    """The whole carpet on white, drawn, and where the picture shows its pile."""

    image: Image.Image
    pile: Pile

    def write_png(self, path: Path) -> None:
        """Write it as PNG. Raises OSError."""
        self.image.save(path, format="PNG", compress_level=1, compress_type=zlib.Z_HUFFMAN_ONLY)

    @property
    def of_pile(self) -> "DrawnCarpet":
        """The pile alone, as of a tufted carpet, which has no fringes."""
        (width, height), pile = self.image.size, self.pile
        left, top = round(pile.left * width), round(pile.top * height)
        right, low = left + round(pile.width * width), top + round(pile.height * height)
        return DrawnCarpet(self.image.crop((left, top, right, low)), WHOLE)

    @property
    def jpeg(self) -> bytes:
        """The picture as a JPEG file."""
        return _jpeg(self.image, 84)

    def of_page(self) -> "DrawnCarpet | None":
        """The same at most LONGEST pixels along its longer side; None where it is too small for a page."""
        longest = max(self.image.size)
        if longest < _LEAST_OF_PAGE * LONGEST:
            return None
        if longest <= LONGEST:
            return self
        size = tuple(max(1, round(side * LONGEST / longest)) for side in self.image.size)
        return DrawnCarpet(self.image.resize((size[0], size[1]), Image.Resampling.LANCZOS), self.pile)


def draw_carpet(
    chart: Chart, width: int | None = None, *, longest: int = LONGEST, seed: int = 1, progress: Progress = SILENT
) -> DrawnCarpet:
    """The whole carpet, `width` pixels wide; default: at most `longest` pixels along its longer side.

    Raises CarpetError as `check_carpet_width`.
    """
    check_carpet_width(chart.size, width)
    across, along = shown_size(chart.size)
    layout = _layout(chart.size, longest / max(across, along) if width is None else width / across)
    if width is not None:
        layout = replace(layout, width=width - 2 * layout.selvedge)
    return DrawnCarpet(_drawn(chart, layout, seed, progress), layout.pile)


def check_carpet_width(size: CarpetSize, width: int | None) -> None:
    """Raise CarpetError for a width [pixels] out of bounds, and for a picture of more than MOST_PIXELS."""
    across, along = shown_size(size)
    most = min(WIDEST, int((MOST_PIXELS * across / along) ** 0.5))
    if width is not None and not NARROWEST <= width <= most:
        raise CarpetError(
            f"--carpet-width {width}", allowed=f"{NARROWEST} to {most:,} pixels for {size}", do="or leave it out"
        )


def close_up(chart: Chart, seed: int = 1) -> bytes:
    """About 40 x 30 knots at the centre of the carpet as a JPEG file, in true proportion."""
    columns, rows = min(_CLOSE_UP[0], chart.columns), min(_CLOSE_UP[1], chart.rows)
    left, top = (chart.columns - columns) // 2, (chart.rows - rows) // 2
    part = slice(top, top + rows), slice(left, left + columns)
    rng = np.random.default_rng(seed)
    across = _CLOSE_WIDTH // _CLOSE_UP[0]
    down = max(2, round(across * chart.quality.across / chart.quality.along))
    srgb = [yarn.srgb for yarn in chart.shades]
    light = _lit(yarn_light(chart.shaded[part], srgb, rng, 0.06), chart, rng, part)
    marked = marked_tufts(chart.overlay, (top, left), (rows, columns), srgb, rng)
    drawn = tufted(light, across * columns, down * rows, rng, fibre=_FIBRE, marked=marked)
    return _jpeg(Image.fromarray(with_flat_weave(with_carving(drawn, chart, part), chart, rng, part)), 86)


def shown_size(size: CarpetSize) -> tuple[float, float]:
    """What the picture shows: width and length of the carpet with selvedges, flat ends and fringes [m]."""
    return size.width + 2 * _SELVEDGE, size.length + 2 * (_FRINGE + _BAND)


def _layout(size: CarpetSize, scale: float) -> _Layout:
    """The sizes at a scale [pixels/m]; the proportions follow the carpet's size."""
    framing = (max(2, int(scale * side)) for side in (_FRINGE, _BAND, _SELVEDGE))
    return _Layout(max(1, int(scale * size.width)), max(1, int(scale * size.length)), *framing)


def _drawn(chart: Chart, layout: _Layout, seed: int, progress: Progress) -> Image.Image:
    rng = np.random.default_rng(seed)
    pile = Image.fromarray(_pile(chart, layout, rng, progress))
    if pile.size != (layout.width, layout.height):
        pile = pile.resize((layout.width, layout.height), Image.Resampling.LANCZOS)
    return _framed(chart, pile, layout, rng)


def _pile(chart: Chart, layout: _Layout, rng: np.random.Generator, progress: Progress) -> Rgb:
    if layout.width >= 2 * chart.columns and layout.height >= 2 * chart.rows:
        srgb = [yarn.srgb for yarn in chart.shades]
        light = _lit(yarn_light(chart.shaded, srgb, rng, 0.05), chart, rng, _ALL)
        marked = marked_tufts(chart.overlay, (0, 0), (chart.rows, chart.columns), srgb, rng)
        drawn = tufted(light, layout.width, layout.height, rng, marked=marked, progress=progress)
        return with_flat_weave(with_carving(drawn, chart, _ALL), chart, rng, _ALL)
    height, width = min(layout.height, chart.rows), min(layout.width, chart.columns)
    palette, size = chart.colour_table, (chart.rows, chart.columns)
    mean = resampled_rows(lambda part: palette[chart.knots[part]], size, (height, width), progress)
    shades = 1.0 + np.repeat(rng.normal(0.0, 0.015, height // 12 + 1), 12)[:height].astype(np.float32)
    out = np.empty((height, width, 3), dtype=np.uint8)
    for band in bands(height, width):
        grain = 0.94 + 0.03 * rng.standard_normal(mean[band].shape[:2], dtype=np.float32)
        light = LINEAR[mean[band]].astype(np.float32)
        out[band] = encoded(light * (shades[band, np.newaxis] * grain)[:, :, np.newaxis])
    return out


def _lit(light: Light, chart: Chart, rng: np.random.Generator, part: tuple[slice, slice]) -> Light:
    """The light of knots (a part of the chart) with what lies beside their colour: relief, and the gloss of silk."""
    return with_sheen(with_relief(light, chart, part), chart, rng, part)


def _framed(chart: Chart, pile: Image.Image, layout: _Layout, rng: np.random.Generator) -> Image.Image:
    """The pile with a selvedge left and right, a flat band and a fringe above and below; with a shape, cut out."""
    side, end = layout.selvedge, layout.band + layout.fringe
    whole = Image.new("RGB", (layout.width + 2 * side, layout.height + 2 * end), (255, 255, 255))
    if (cut := cut_out(pile, chart)) is not None:
        whole.paste(pile, (side, end), cut)
        return whole
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
    red, green, blue = LINEAR[chart.colour_table[np.bincount(edge).argmax()]].tolist()
    return 0.8 * red + 0.01, 0.8 * green + 0.01, 0.8 * blue + 0.01


def _jpeg(picture: Image.Image, quality: int) -> bytes:
    stream = io.BytesIO()
    picture.save(stream, format="JPEG", quality=quality, optimize=True, subsampling=1)
    return stream.getvalue()
