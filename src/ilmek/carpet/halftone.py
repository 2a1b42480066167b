"""Halftone: tones between the yarns, as patterns that mix to the tone at viewing distance.

The chart is cut into cells of 2 × 2 knots, and the light that a cell has too little or too much is carried on to the
cells beside and below it, row by row, forth and back, in the shares of Floyd and Steinberg.

smooth  A cell of a smooth area is a dot: one yarn of the mixture of its tone [`mixtures`], that which comes nearest to
        the light of the mixture and of what was carried on. No yarn of a mixture contrasts with its tone by more than
        CONTRAST, so no dot does with what lies around it.
other   In a cell that holds or touches an outline, or belongs to no smooth square of 3 × 3 others, each knot has the
        yarn nearest to its own colour, moved by what was carried on, at most by MOST_MOVED codes. So lines and
        textures stay sharp, and the borders of their areas make the tone right.

An outline: knots of a cell differ by more than OUTLINE_INSIDE, or its mean from that of a cell beside it by more than
OUTLINE, in codes of a channel. The strength is the share of the light that is carried on.

Light is in whole numbers, so that the chart does not depend on the machine.

Source of the shares: R. W. Floyd and L. Steinberg, An adaptive algorithm for spatial greyscale, Proc. SID 17 (1976)
75-77.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, Float, FloatArray, Indices, Int32, IntArray, Rgb
from ilmek.carpet.colour import lab_to_srgb
from ilmek.carpet.colour_difference import ciede2000
from ilmek.carpet.design import bands, encoded
from ilmek.carpet.light import LIGHT, lab_of_light
from ilmek.carpet.mixtures import WHITE, mix, yarn_lights
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress

CELL = 2
"""Knots along a side of a cell."""

OUTLINE, OUTLINE_INSIDE = 24, 36
"""Differences of an outline, in codes of a channel."""

MOST_MOVED = 32
"""Codes by which what is carried on moves the colours of a cell that is no dot."""

STEP, FINE = 8, 4
"""Codes between the channels of the tones whose mixtures are computed, and of the colours whose nearest yarns are; what
is rounded off is carried on.
"""

SAME = 3
"""A tone whose codes differ by no more from those of its nearest yarn takes that yarn."""

SHOWN = 4.0
"""A lone knot shows where the yarns beside it are farther from its colour than its own by more [CIEDE2000]."""

_TONES, _COLOURS = 255 // STEP + 2, 256 // FINE
_UNKNOWN = 255
"""Stands for no yarn: indices of yarns are at most 254."""


class _Shelf(NamedTuple):
    """The yarns, and what was found of their mixtures so far.

    labs, lights, codes  CIELAB of each yarn, its linear light in units of LIGHT, and its codes
    strength      share of the light that is carried on
    nearest       of colours in steps of FINE the nearest yarn, _UNKNOWN before it is asked for
    found         of tones in steps of STEP whether the mixture is computed
    yarns, aims, slopes  its yarns, its light and the slope of CIELAB there [`mixtures.mix`]
    """

    labs: FloatArray
    lights: IntArray
    codes: IntArray
    strength: float
    nearest: Indices
    found: BoolArray
    yarns: IntArray
    aims: IntArray
    slopes: IntArray


def _shelf(labs: FloatArray, strength: float) -> _Shelf:
    tones = _TONES**3  # memory that is never touched costs nothing
    return _Shelf(
        np.ascontiguousarray(labs),
        np.rint(WHITE * yarn_lights(labs)).astype(np.int64),
        lab_to_srgb(labs).astype(np.int64),
        strength,
        np.full(_COLOURS**3, _UNKNOWN, dtype=np.uint8),
        np.zeros(tones, dtype=bool),
        np.empty((tones, 3), dtype=np.int64),
        np.empty((tones, 3), dtype=np.int64),
        np.empty((tones, 3, 3), dtype=np.int64),
    )


@compiled
def _tone(rgb: Rgb, top: int, bottom: int, left: int, right: int, out: IntArray) -> int:  # noqa: PLR0917
    """Write the mean light of a cell; returns the greatest range of a channel over its knots."""
    widest = 0
    for channel in range(3):
        light, least, most = 0, 255, 0
        for i in range(top, bottom):
            for j in range(left, right):
                code = rgb[i, j, channel]
                light += LIGHT[code]
                least, most = min(least, int(code)), max(most, int(code))
        out[channel] = light // ((bottom - top) * (right - left))
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
            tones[i, j] = encoded(own[0] / WHITE) << 16 | encoded(own[1] / WHITE) << 8 | encoded(own[2] / WHITE)
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
def _mixture(shelf: _Shelf, tone: int) -> int:
    """The number of the mixture of a tone, which is computed when it is first asked for."""
    half = STEP // 2
    red, green, blue = (tone >> 16 & 255) + half, (tone >> 8 & 255) + half, (tone & 255) + half
    key = ((red // STEP) * _TONES + green // STEP) * _TONES + blue // STEP
    if not shelf.found[key]:
        shelf.found[key] = True
        light = np.empty(3)
        for channel, code in enumerate((red, green, blue)):
            light[channel] = LIGHT[min(code // STEP * STEP, 255)] / WHITE
        mix(
            light,
            shelf.labs,
            shelf.lights / WHITE,
            shelf.strength,
            shelf.yarns[key],
            shelf.aims[key],
            shelf.slopes[key],
        )
    return int(key)


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
def _nearest_light(shelf: _Shelf, mixture: int, aim: IntArray) -> int:
    """The yarn of a mixture whose light is nearest to what is aimed at."""
    best, least = -1, 0
    for k in range(3):
        yarn, far = shelf.yarns[mixture, k], 0
        for axis in range(3):
            off = 0
            for channel in range(3):
                off += shelf.slopes[mixture, axis, channel] * (shelf.lights[yarn, channel] - aim[channel] >> 8)
            far += (off >> 8) * (off >> 8)
        if best < 0 or far < least:
            best, least = yarn, far
    return int(best)


@compiled
def _nearest_yarn(shelf: _Shelf, red: int, green: int, blue: int) -> int:
    """The yarn nearest to a colour, in steps of FINE codes."""
    red, green, blue = min(max(red, 0), 255) // FINE, min(max(green, 0), 255) // FINE, min(max(blue, 0), 255) // FINE
    key, half = (red * _COLOURS + green) * _COLOURS + blue, FINE // 2
    if shelf.nearest[key] == _UNKNOWN:
        lightness, a, b = lab_of_light(LIGHT[FINE * red + half], LIGHT[FINE * green + half], LIGHT[FINE * blue + half])
        least = np.inf
        for yarn in range(len(shelf.labs)):
            far = ciede2000(lightness, a, b, shelf.labs[yarn, 0], shelf.labs[yarn, 1], shelf.labs[yarn, 2])
            if far < least:
                least = far
                shelf.nearest[key] = yarn
    return int(shelf.nearest[key])


@compiled
def _draw_dot(shelf: _Shelf, tone: int, knots: Indices, light: IntArray) -> None:
    """Tie a cell in one yarn of its mixture; `light`: what was carried on, and receives what is to be."""
    red, green, blue = tone >> 16 & 255, tone >> 8 & 255, tone & 255
    yarn = _nearest_yarn(shelf, red, green, blue)
    own = shelf.codes[yarn]
    if max(abs(red - own[0]), abs(green - own[1]), abs(blue - own[2])) <= SAME:
        knots[:] = yarn
        return
    mixture = _mixture(shelf, tone)
    for channel in range(3):
        light[channel] += shelf.aims[mixture, channel]
    yarn = _nearest_light(shelf, mixture, light)
    for channel in range(3):
        light[channel] -= shelf.lights[yarn, channel]
    knots[:] = yarn


@compiled
def _draw_detail(shelf: _Shelf, tone: int, rgb: Rgb, knots: Indices, light: IntArray) -> None:
    """Tie each knot of a cell in the yarn nearest to its colour, moved by what was carried on; `light` as for a dot."""
    moved = np.empty(3, dtype=np.int64)
    for channel in range(3):
        code = tone >> (16 - 8 * channel) & 255
        least, most = LIGHT[max(code - MOST_MOVED, 0)], LIGHT[min(code + MOST_MOVED, 255)]
        light[channel] = min(max(light[channel] + LIGHT[code], least), most)
        moved[channel] = encoded(light[channel] / WHITE) - code
    still = moved[0] == 0 and moved[1] == 0 and moved[2] == 0
    for y in range(knots.shape[0]):
        for x in range(knots.shape[1]):
            if not still:
                red, green, blue = rgb[y, x, 0] + moved[0], rgb[y, x, 1] + moved[1], rgb[y, x, 2] + moved[2]
                knots[y, x] = _nearest_yarn(shelf, red, green, blue)
            for channel in range(3):
                light[channel] -= shelf.lights[knots[y, x], channel] // knots.size


@compiled
def _carry(light: IntArray, row: int, column: int, ahead: int, owed: IntArray) -> None:
    """Hand on the light of a cell: 7/16 ahead, 3/16, 5/16 and what is left below.

    owed  to the cells of this row and the next one (2, columns, 3), each at its row modulo 2
    """
    columns, here, below = owed.shape[1], row % 2, (row + 1) % 2
    for channel in range(3):
        whole = light[channel]
        first, second, third = 7 * whole >> 4, 3 * whole >> 4, 5 * whole >> 4
        if 0 <= column + ahead < columns:
            owed[here, column + ahead, channel] += first
            owed[below, column + ahead, channel] += whole - first - second - third
        if 0 <= column - ahead < columns:
            owed[below, column - ahead, channel] += second
        owed[below, column, channel] += third


@compiled
def _draw(  # noqa: PLR0917
    knots: Indices, rgb: Rgb, tones: Int32[np.ndarray, "rows columns"], rough: BoolArray, shelf: _Shelf,
    own: tuple[int, int, int], owed: IntArray, drawn: BoolArray
) -> None:  # fmt: skip
    """Tie the cells of the rows `own[0]` to `own[1]` of a part; `own[2]`: row of the chart with which it begins.

    drawn  receives which cells are dots
    """
    rows, columns = tones.shape
    light = np.empty(3, dtype=np.int64)
    for i in range(own[0], own[1]):
        bottom = knots.shape[0] if i == rows - 1 else CELL * (i + 1)
        row = own[2] + i
        for at in range(columns):
            j = at if row % 2 == 0 else columns - 1 - at
            right = knots.shape[1] if j == columns - 1 else CELL * (j + 1)
            cell = knots[CELL * i : bottom, CELL * j : right]
            light[:] = owed[row % 2, j]
            owed[row % 2, j] = 0
            drawn[i, j] = _in_smooth_area(rough, i, j)
            if drawn[i, j]:
                _draw_dot(shelf, tones[i, j], cell, light)
            else:
                _draw_detail(shelf, tones[i, j], rgb[CELL * i : bottom, CELL * j : right], cell, light)
            for channel in range(3):
                light[channel] = round(shelf.strength * light[channel])
            _carry(light, row, j, 1 if row % 2 == 0 else -1, owed)


@compiled
def _join(knots: Indices, rgb: Rgb, labs: FloatArray, first: int, stop: int) -> None:
    """Give each lone knot of the rows the yarn beside it that is nearest to its colour, unless it shows there."""
    rows, columns = knots.shape
    for y in range(first, stop):
        for x in range(columns):
            own, lone = knots[y, x], True
            for i, j in ((y - 1, x), (y + 1, x), (y, x - 1), (y, x + 1)):
                if 0 <= i < rows and 0 <= j < columns and knots[i, j] == own:
                    lone = False
            if lone:
                lightness, a, b = lab_of_light(LIGHT[rgb[y, x, 0]], LIGHT[rgb[y, x, 1]], LIGHT[rgb[y, x, 2]])
                least = ciede2000(lightness, a, b, labs[own, 0], labs[own, 1], labs[own, 2]) + SHOWN
                for i, j in ((y - 1, x), (y + 1, x), (y, x - 1), (y, x + 1)):
                    if 0 <= i < rows and 0 <= j < columns:
                        yarn = knots[i, j]
                        far = ciede2000(lightness, a, b, labs[yarn, 0], labs[yarn, 1], labs[yarn, 2])
                        if far < least:
                            least = far
                            knots[y, x] = yarn


def _tones_of(part: Rgb, cells: tuple[int, int]) -> tuple[Int32[np.ndarray, "rows columns"], BoolArray]:
    tones, rough = np.empty(cells, dtype=np.int32), np.zeros(cells, dtype=bool)
    _tones(part, tones, rough)
    return tones, rough


def draw_halftone(
    knots: Indices, rgb: Rgb, yarn_labs: Float[np.ndarray, "yarns 3"], strength: float, progress: Progress = SILENT
) -> tuple[Indices, BoolArray]:
    """The chart with the pattern, and which cells of CELL × CELL knots are dots.

    knots  chart of the nearest yarns      rgb  the design      strength  share of the light that is carried on [-]
    """
    rgb, out, shelf = np.ascontiguousarray(rgb), knots.copy(), _shelf(yarn_labs, strength)
    rows, columns = max(1, knots.shape[0] // CELL), max(1, knots.shape[1] // CELL)
    drawn, owed = np.zeros((rows, columns), dtype=bool), np.zeros((2, columns, 3), dtype=np.int64)
    for band in bands(rows, CELL**2 * columns):
        around = slice(max(band.start - 3, 0), min(band.stop + 3, rows))
        part = _knots_of(rgb, around, rows)
        tones, rough = _tones_of(part, (around.stop - around.start, columns))
        own = (band.start - around.start, band.stop - around.start, around.start)
        _draw(_knots_of(out, around, rows), part, tones, rough, shelf, own, owed, drawn[around])
        progress(0.9 * band.stop / rows)
    for band in bands(*out.shape):
        _join(out, rgb, shelf.labs, band.start, band.stop)
        progress(0.9 + 0.1 * band.stop / len(out))
    return out, drawn


def _knots_of(knots: Indices, cells: slice, rows: int) -> Indices:
    """The knots of rows of cells; the last row of cells takes what is left over."""
    return knots[CELL * cells.start : len(knots) if cells.stop == rows else CELL * cells.stop]
