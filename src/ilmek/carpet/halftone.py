"""Halftone: tones between the yarns, as patterns that mix to the tone at viewing distance.

The chart is cut into cells of 2 × 2 knots. A cell in a smooth area takes one yarn of a mixture of at most three, chosen
by a threshold of blue noise [`blue_noise`], so that the yarns' shares over some cells are those of the mixture
[`mixtures`]. Every dot of a pattern has at least four knots, and none is alone.

smooth    No pattern is drawn in a cell that holds or touches an outline: its knots differ by more than OUTLINE_INSIDE,
          or its mean from that of a cell beside it by more than OUTLINE, in codes of a channel; nor in a cell that
          belongs to no square of 3 × 3 others. There the knots keep their nearest yarns.
strength  The tone aimed at lies at this share of the path from the light of the nearest yarn to that of the cell.

Mixtures are computed once for each tone, with channels rounded to steps of 4 codes, up or down by the noise.
"""

import numpy as np

from ilmek.arrays import BoolArray, Float, FloatArray, Indices, Int32, IntArray, Rgb
from ilmek.carpet.blue_noise import SIDE, blue_noise
from ilmek.carpet.colour import LINEAR
from ilmek.carpet.design import bands, encoded
from ilmek.carpet.light import LIGHT
from ilmek.carpet.mixtures import WHITE, mix, yarn_lights
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress

CELL = 2
"""Knots along a side of a cell."""

OUTLINE, OUTLINE_INSIDE = 24, 36
"""Differences of an outline, in codes of a channel."""

STEP = 4
"""Codes between the rounded channels of two tones."""

SHIFT = SIDE // 2
"""Cells between the noise that draws the pattern and that which rounds the tones."""

_LEVELS = 255 // STEP + 2
_BATCH = 1024


@compiled
def _tone(rgb: Rgb, top: int, bottom: int, left: int, right: int, out: IntArray) -> int:  # noqa: PLR0917
    """Write the codes of the mean light of a cell; returns the greatest range of a channel over its knots."""
    widest = 0
    for channel in range(3):
        light, least, most = 0, 255, 0
        for i in range(top, bottom):
            for j in range(left, right):
                code = rgb[i, j, channel]
                light += LIGHT[code]
                least, most = min(least, int(code)), max(most, int(code))
        out[channel] = encoded(light / (WHITE * (bottom - top) * (right - left)))
        widest = max(widest, most - least)
    return widest


@compiled
def _tones(rgb: Rgb, tones: Int32[np.ndarray, "rows columns"], rough: BoolArray) -> None:
    """The tone of each cell as a code r·65536 + g·256 + b, and whether it holds or touches an outline."""
    rows, columns = tones.shape
    own = np.empty(3, dtype=np.int64)
    for i in range(rows):
        bottom = rgb.shape[0] if i == rows - 1 else CELL * (i + 1)
        for j in range(columns):
            right = rgb.shape[1] if j == columns - 1 else CELL * (j + 1)
            rough[i, j] = _tone(rgb, CELL * i, bottom, CELL * j, right, own) > OUTLINE_INSIDE
            tones[i, j] = own[0] << 16 | own[1] << 8 | own[2]
    for i in range(rows):
        for j in range(columns):
            for y, x in ((i, j - 1), (i - 1, j)):
                if y >= 0 and x >= 0:
                    apart = 0
                    for shift in (0, 8, 16):
                        apart = max(apart, abs((tones[i, j] >> shift & 255) - (tones[y, x] >> shift & 255)))
                    if apart > OUTLINE:
                        rough[i, j] = rough[y, x] = True


@compiled
def _key(tone: int, level: int) -> int:
    """The number of a tone with its channels rounded up or down by the noise, so that no step is seen."""
    up = level * STEP // (SIDE * SIDE)
    red, green, blue = (tone >> 16 & 255) + up, (tone >> 8 & 255) + up, (tone & 255) + up
    return int(((red // STEP) * _LEVELS + green // STEP) * _LEVELS + blue // STEP)


@compiled
def _note(tones: Int32[np.ndarray, "rows columns"], noise: IntArray, top: int, seen: BoolArray) -> None:
    for i in range(tones.shape[0]):
        for j in range(tones.shape[1]):
            seen[_key(tones[i, j], noise[(top + i + SHIFT) % SIDE, (j + SHIFT) % SIDE])] = True


@compiled
def _all_smooth(rough: BoolArray, i: int, j: int) -> bool:
    """Whether a cell and the cells around it are smooth."""
    for y in range(max(i - 1, 0), min(i + 2, rough.shape[0])):
        for x in range(max(j - 1, 0), min(j + 2, rough.shape[1])):
            if rough[y, x]:
                return False
    return True


@compiled
def _in_smooth_area(rough: BoolArray, i: int, j: int) -> bool:
    """Whether a cell belongs to a smooth square of 3 × 3 cells."""
    if rough[i, j]:
        return False
    for y in range(max(i - 1, 0), min(i + 2, rough.shape[0])):
        for x in range(max(j - 1, 0), min(j + 2, rough.shape[1])):
            if _all_smooth(rough, y, x):
                return True
    return False


@compiled
def _draw(  # noqa: PLR0917
    knots: Indices, tones: Int32[np.ndarray, "rows columns"], rough: BoolArray, number: IntArray, yarns: IntArray,
    limits: IntArray, noise: IntArray, first: int, stop: int, top: int, drawn: BoolArray
) -> None:  # fmt: skip
    """Draw the pattern of the cells of rows `first` to `stop`.

    number  of each tone's mixture      limits  of the noise, below which the first and the second yarn are taken
    top     row of the noise of the first row of cells      drawn  receives which cells have a pattern
    """
    rows, columns = tones.shape
    for i in range(first, stop):
        bottom = knots.shape[0] if i == rows - 1 else CELL * (i + 1)
        for j in range(columns):
            if not _in_smooth_area(rough, i, j):
                continue
            mixture = number[_key(tones[i, j], noise[(top + i + SHIFT) % SIDE, (j + SHIFT) % SIDE])]
            level = noise[(top + i) % SIDE, j % SIDE]
            taken = (level >= limits[mixture, 0]) + (level >= limits[mixture, 1])
            drawn[i, j] = True
            for y in range(CELL * i, bottom):
                for x in range(CELL * j, knots.shape[1] if j == columns - 1 else CELL * (j + 1)):
                    knots[y, x] = yarns[mixture, taken]


def _tones_of(part: Rgb, cells: tuple[int, int]) -> tuple[Int32[np.ndarray, "rows columns"], BoolArray]:
    tones, rough = np.empty(cells, dtype=np.int32), np.zeros(cells, dtype=bool)
    _tones(part, tones, rough)
    return tones, rough


def draw_halftone(
    knots: Indices, rgb: Rgb, yarn_labs: Float[np.ndarray, "yarns 3"], strength: float, progress: Progress = SILENT
) -> tuple[Indices, BoolArray]:
    """The chart with the pattern, and which cells of CELL × CELL knots have one.

    knots  chart of the nearest yarns      rgb  the design      strength  share of the tone that is rendered [-]
    """
    rgb, out = np.ascontiguousarray(rgb), knots.copy()
    rows, columns = max(1, knots.shape[0] // CELL), max(1, knots.shape[1] // CELL)
    drawn = np.zeros((rows, columns), dtype=bool)
    parts = [(band, slice(max(band.start - 3, 0), min(band.stop + 3, rows))) for band in bands(rows, CELL**2 * columns)]
    seen = np.zeros(_LEVELS**3, dtype=bool)
    for band, around in parts:
        tones, _ = _tones_of(_knots_of(rgb, around, rows), (around.stop - around.start, columns))
        _note(tones, blue_noise(), around.start % SIDE, seen)
        progress(0.3 * band.stop / rows)
    keys = np.flatnonzero(seen)
    number = np.zeros(_LEVELS**3, dtype=np.int32)
    number[keys] = np.arange(len(keys))
    yarns, limits = _mixtures(keys, yarn_labs, strength, progress.part(0.3, 0.6))
    for band, around in parts:
        tones, rough = _tones_of(_knots_of(rgb, around, rows), (around.stop - around.start, columns))
        first, stop, top = band.start - around.start, band.stop - around.start, around.start % SIDE
        part, marks = _knots_of(out, around, rows), drawn[around]
        _draw(part, tones, rough, number, yarns, limits, blue_noise(), first, stop, top, marks)
        progress(0.6 + 0.4 * band.stop / rows)
    return out, drawn


def _knots_of(knots: Indices, cells: slice, rows: int) -> Indices:
    """The knots of rows of cells; the last row of cells takes what is left over."""
    return knots[CELL * cells.start : len(knots) if cells.stop == rows else CELL * cells.stop]


def _mixtures(keys: IntArray, labs: FloatArray, strength: float, progress: Progress) -> tuple[IntArray, IntArray]:
    """The yarns of each tone's mixture, from dark to light, and the limits of the noise between them."""
    codes = np.stack([keys // _LEVELS**2, keys // _LEVELS % _LEVELS, keys % _LEVELS], axis=-1) * STEP
    tones, lights = LINEAR[np.minimum(codes, 255)], yarn_lights(labs)
    dark = np.argsort(np.argsort(labs[:, 0], kind="stable"), kind="stable")
    yarns, shares = np.empty((len(keys), 3), dtype=np.int64), np.empty((len(keys), 3))
    for part in bands(len(keys), 1, _BATCH):
        mix(tones[part], np.ascontiguousarray(labs), lights, dark, strength, yarns[part], shares[part])
        progress(part.stop / len(keys))
    return yarns, np.rint(SIDE**2 * np.cumsum(shares[:, :2], axis=1)).astype(np.int64)
