"""Halftone: tones between the yarns, as patterns that mix to the tone at viewing distance.

The chart is cut into cells of 2 × 2 knots, and the light that a cell has too little or too much is carried on to the
cells beside and below it, row by row, forth and back, in the shares of Floyd and Steinberg.

smooth  A cell of a smooth area is a dot: one yarn of the mixture of its tone [`mixtures`], that which comes nearest to
        the light of the mixture and of what was carried on. No yarn of a mixture contrasts with its tone by more than
        the yarns need, so no dot does with what lies around it.
other   In a cell that holds or touches an outline, or belongs to no smooth square of 3 × 3 others, each knot has the
        yarn nearest to its own colour, moved by what was carried on, at most by MOST_MOVED codes, and by no more than
        its tone differs from its yarn. So lines and textures stay sharp, and the borders of their areas make the tone
        right.

An outline: the means of two cells side by side differ by more than twice what either lacks to its nearest yarn, at most
by OUTLINE, in codes of a channel, or knots of a cell by half as much again. A texture that its nearest yarns show needs
no dots, which would hide it. The strength is the share of the light that is carried on.

Light is in whole numbers, so that the chart does not depend on the machine.

Source of the shares: R. W. Floyd and L. Steinberg, An adaptive algorithm for spatial greyscale, Proc. SID 17 (1976)
75-77.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, Float, FloatArray, Indices, Int32, IntArray, Rgb
from ilmek.carpet.colour import lab_to_srgb
from ilmek.carpet.colour_difference import ciede2000
from ilmek.carpet.design import bands
from ilmek.carpet.light import LIGHT, code_of_light, lab_of_light
from ilmek.carpet.mixtures import WHITE, greatest_contrast, mix, yarn_lights
from ilmek.carpet.nearest_colour import NearestSearch, nearest_of, nearest_search
from ilmek.carpet.patches import grown, is_lone
from ilmek.num.compiled import compiled, embedded, uncounted
from ilmek.progress import SILENT, Progress

CELL = 2
"""Knots along a side of a cell."""

OUTLINE, FAINTEST = 32, 4
"""Greatest and least difference between the tones of two cells that is an outline, in codes of a channel."""

MOST_MOVED, LEAST_MOVED = 32, 4
"""Codes by which at most, and in any case, what is carried on moves the colours of a cell that is no dot."""

STEP, FINE = 8, 4
"""Codes between the channels of the tones whose mixtures are computed, and of the colours whose nearest yarns are; what
is rounded off is carried on.
"""

SAME = 3
"""A tone whose codes differ by no more from those of its nearest yarn takes that yarn."""

SHOWN = 5.0
"""A lone knot shows where the yarns beside it are farther from its colour than its own by more [CIEDE2000]."""

_TONES, _COLOURS = 255 // STEP + 2, 256 // FINE
_UNKNOWN = 255
"""Stands for no yarn: indices of yarns are at most 254."""

_WHOLE = 256
"""Strength of which all of the light is carried on."""

Tones = Int32[np.ndarray, "rows columns"]
Light = tuple[int, int, int]
"""Light of the three channels in units of `light.LIGHT`."""


class _Shelf(NamedTuple):
    """The yarns, and what was found of their mixtures so far.

    search    of the nearest yarn
    lights, codes  linear light of each yarn in units of LIGHT, and its codes
    strength  of the light that is carried on, in shares of _WHOLE      contrast  greatest of a yarn with its tone
    nearest   of colours in steps of FINE the nearest yarn, _UNKNOWN before it is computed
    known     of tones in steps of STEP whether the mixture is computed
    yarns, aims, positions, slopes  of mixtures [`mixtures.mix`]
    """

    search: NearestSearch
    lights: IntArray
    codes: IntArray
    strength: int
    contrast: float
    nearest: Indices
    known: BoolArray
    yarns: Indices
    aims: IntArray
    positions: IntArray
    slopes: IntArray


def _shelf(labs: FloatArray, strength: float, contrast: float) -> _Shelf:
    tones = _TONES**3  # memory that is never touched costs nothing
    return _Shelf(
        nearest_search(labs),
        np.rint(WHITE * yarn_lights(labs)).astype(np.int64),
        lab_to_srgb(labs).astype(np.int64),
        round(_WHOLE * strength),
        contrast,
        np.full((_COLOURS**2, _COLOURS), _UNKNOWN, dtype=np.uint8),
        np.zeros(tones, dtype=bool),
        np.empty((tones, 3), dtype=np.uint8),
        np.empty((tones, 3), dtype=np.int32),
        np.empty((tones, 3, 3), dtype=np.int32),
        np.empty((tones, 3, 3), dtype=np.int32),
    )


@compiled
def _find_mixture(shelf: _Shelf, key: int) -> None:
    """Compute the mixture of a tone."""
    light = np.empty(3)
    for channel in range(3):
        step = key // _TONES ** (2 - channel) % _TONES
        light[channel] = LIGHT[min(step * STEP, 255)] / WHITE
    shelf.known[key] = True
    share, lights = shelf.strength / _WHOLE, shelf.lights / WHITE
    yarns, aim, position, slope = shelf.yarns[key], shelf.aims[key], shelf.positions[key], shelf.slopes[key]
    mix(light, shelf.search.labs, lights, share, shelf.contrast, yarns, aim, position, slope)


@uncounted
def _find_nearest(shelf: _Shelf, first: int, second: int) -> None:
    """Compute the yarn nearest to a colour, in steps of FINE codes."""
    red, green, blue = FINE * (first // _COLOURS), FINE * (first % _COLOURS), FINE * second
    half = FINE // 2
    lightness, a, b = lab_of_light(LIGHT[red + half], LIGHT[green + half], LIGHT[blue + half])
    shelf.nearest[first, second] = nearest_of(shelf.search, lightness, a, b)[0]


@embedded
def _nearest_yarn(shelf: _Shelf, red: int, green: int, blue: int) -> int:
    """The yarn nearest to a colour, in steps of FINE codes."""
    first = min(max(red, 0), 255) // FINE * _COLOURS + min(max(green, 0), 255) // FINE
    second = min(max(blue, 0), 255) // FINE
    if shelf.nearest[first, second] == _UNKNOWN:
        _find_nearest(shelf, first, second)
    return int(shelf.nearest[first, second])


@embedded
def _off(shelf: _Shelf, tone: int) -> int:
    """Difference of a tone and its nearest yarn, in codes of a channel."""
    red, green, blue = tone >> 16, tone >> 8 & 255, tone & 255
    codes = shelf.codes[_nearest_yarn(shelf, red, green, blue)]
    return int(max(abs(red - codes[0]), abs(green - codes[1]), abs(blue - codes[2])))


@uncounted
def _tones(rgb: Rgb, tones: Tones, rough: BoolArray, shelf: _Shelf, most: IntArray) -> None:
    """The tone of each cell as a code r·65536 + g·256 + b, and whether it holds or touches an outline.

    most  room for the greatest differences without an outline of two rows of cells (2, columns)
    """
    rows, columns = tones.shape
    for i in range(rows):
        top, bottom = CELL * i, rgb.shape[0] if i == rows - 1 else CELL * (i + 1)
        for j in range(columns):
            left, right = CELL * j, rgb.shape[1] if j == columns - 1 else CELL * (j + 1)
            tone, widest = 0, 0
            for channel in range(3):
                if bottom - top == CELL and right - left == CELL:
                    light, width = _of_four(rgb, top, left, channel)
                else:
                    light, width = _of_cell(rgb, (top, bottom, left, right), channel)
                tone = tone << 8 | code_of_light(light)
                widest = max(widest, width)
            tones[i, j] = tone
            own = most[i % 2, j] = min(OUTLINE, max(FAINTEST, 2 * _off(shelf, tone)))
            rough[i, j] = 2 * widest > 3 * own
            if i > 0 and _apart(tone, tones[i - 1, j], max(own, most[1 - i % 2, j])):
                rough[i, j] = rough[i - 1, j] = True
            if j > 0 and _apart(tone, tones[i, j - 1], max(own, most[i % 2, j - 1])):
                rough[i, j] = rough[i, j - 1] = True


@embedded
def _of_four(rgb: Rgb, y: int, x: int, channel: int) -> tuple[int, int]:
    """As `_of_cell`, of a cell of CELL × CELL knots: nearly all are, and no loop is quicker."""
    one, two = int(rgb[y, x, channel]), int(rgb[y, x + 1, channel])
    three, four = int(rgb[y + 1, x, channel]), int(rgb[y + 1, x + 1, channel])
    least, most = min(one, two, three, four), max(one, two, three, four)
    return (LIGHT[one] + LIGHT[two] + LIGHT[three] + LIGHT[four]) >> 2, most - least


@uncounted
def _of_cell(rgb: Rgb, place: tuple[int, int, int, int], channel: int) -> tuple[int, int]:
    """The mean light of the knots of a cell, and the width of their codes."""
    top, bottom, left, right = place
    light, least, most = 0, 255, 0
    for y in range(top, bottom):
        for x in range(left, right):
            code = int(rgb[y, x, channel])
            light += LIGHT[code]
            least, most = min(least, code), max(most, code)
    return _part(light, (bottom - top) * (right - left)), most - least


@uncounted
def _apart(tone: int, other: int, most: int) -> bool:
    """Whether an outline lies between two cells."""
    red, green, blue = (
        (tone >> 16) - (other >> 16),
        (tone >> 8 & 255) - (other >> 8 & 255),
        (tone & 255) - (other & 255),
    )
    return max(abs(red), abs(green), abs(blue)) > most


@embedded
def _along(slope: IntArray, light: Light) -> int:
    """Light along an axis of CIELAB."""
    return int(slope[0] * (light[0] >> 8) + slope[1] * (light[1] >> 8) + slope[2] * (light[2] >> 8)) >> 8


@embedded
def _dot(shelf: _Shelf, tone: int, light: Light) -> tuple[int, Light]:
    """The yarn of a dot, and the light that is to be carried on; `light`: what was carried on to it."""
    red, green, blue = tone >> 16, tone >> 8 & 255, tone & 255
    yarn, codes = _nearest_yarn(shelf, red, green, blue), shelf.codes
    if max(abs(red - codes[yarn, 0]), abs(green - codes[yarn, 1]), abs(blue - codes[yarn, 2])) > SAME:
        half = STEP // 2
        key = ((red + half) // STEP * _TONES + (green + half) // STEP) * _TONES + (blue + half) // STEP
        if not shelf.known[key]:
            _find_mixture(shelf, key)
        positions, slopes, lights = shelf.positions, shelf.slopes[key], shelf.lights
        x, y, z = _along(slopes[0], light), _along(slopes[1], light), _along(slopes[2], light)
        best, least = 0, np.int64(1) << 62
        for k in range(3):
            far = (positions[key, k, 0] - x) ** 2 + (positions[key, k, 1] - y) ** 2 + (positions[key, k, 2] - z) ** 2
            if far < least:
                best, least = k, far
        yarn = int(shelf.yarns[key, best])
        light = (
            light[0] + shelf.aims[key, 0] - lights[yarn, 0],
            light[1] + shelf.aims[key, 1] - lights[yarn, 1],
            light[2] + shelf.aims[key, 2] - lights[yarn, 2],
        )
    return yarn, light


@uncounted
def _part(light: int, knots: int) -> int:
    """The mean light of the knots of a cell."""
    return light >> 2 if knots == CELL**2 else light // knots  # a division takes as long as all the rest


@embedded
def _moved(code: int, light: int, most: int) -> tuple[int, int]:
    """The light of a code with what was carried on, within MOST_MOVED codes of it, and the codes that it moves."""
    light = min(max(light + LIGHT[code], LIGHT[max(code - most, 0)]), LIGHT[min(code + most, 255)])
    return light, code_of_light(light) - code


@embedded
def _detail(  # noqa: PLR0917
    shelf: _Shelf, tone: int, rgb: Rgb, knots: Indices, place: tuple[int, int, int, int], light: Light
) -> Light:
    """Tie each knot of a cell in the yarn nearest to its colour, moved by what was carried on; `light` as for a dot."""
    top, bottom, left, right = place
    most = min(MOST_MOVED, max(LEAST_MOVED, _off(shelf, tone)))
    first, red = _moved(tone >> 16, light[0], most)
    second, green = _moved(tone >> 8 & 255, light[1], most)
    third, blue = _moved(tone & 255, light[2], most)
    moves = red != 0 or green != 0 or blue != 0
    x, y, z = 0, 0, 0
    for i in range(top, bottom):
        for j in range(left, right):
            if moves:
                knots[i, j] = _nearest_yarn(shelf, rgb[i, j, 0] + red, rgb[i, j, 1] + green, rgb[i, j, 2] + blue)
            yarn = knots[i, j]
            x, y, z = x + shelf.lights[yarn, 0], y + shelf.lights[yarn, 1], z + shelf.lights[yarn, 2]
    size = (bottom - top) * (right - left)
    return first - _part(x, size), second - _part(y, size), third - _part(z, size)


@embedded
def _shares(light: int) -> tuple[int, int, int, int]:
    """The shares of the light of a cell: 7/16 ahead, and below 3/16 behind it, 5/16 beside it, what is left ahead."""
    first, second, third = 7 * light >> 4, 3 * light >> 4, 5 * light >> 4
    return first, second, third, light - first - second - third


@uncounted
def _draw(  # noqa: PLR0917
    knots: Indices, rgb: Rgb, tones: Tones, dots: BoolArray, shelf: _Shelf, own: tuple[int, int, int], owed: IntArray
) -> None:
    """Tie the cells of the rows `own[0]` to `own[1]` of a part; `own[2]`: row of the chart with which it begins.

    owed  light that is carried on to the cells of this row and the next one (2, columns + 2, 3), each at its row modulo
          2, with a column more on both sides
    """
    rows, columns = tones.shape
    strength = shelf.strength
    for i in range(own[0], own[1]):
        top, bottom = CELL * i, knots.shape[0] if i == rows - 1 else CELL * (i + 1)
        here = (own[2] + i) % 2
        below, ahead = 1 - here, 1 - 2 * here
        # What goes to the next cell of the row, to that below this one, and to that below the next one.
        next_red, next_green, next_blue = 0, 0, 0
        red, green, blue = 0, 0, 0
        last_red, last_green, last_blue = 0, 0, 0
        for step in range(columns):
            j = columns - 1 - step if here else step
            left, right = CELL * j, knots.shape[1] if j == columns - 1 else CELL * (j + 1)
            light = (
                owed[here, j + 1, 0] + next_red,
                owed[here, j + 1, 1] + next_green,
                owed[here, j + 1, 2] + next_blue,
            )
            if dots[i, j]:
                yarn, light = _dot(shelf, tones[i, j], light)
                for y in range(top, bottom):
                    for x in range(left, right):
                        knots[y, x] = yarn
            else:
                light = _detail(shelf, tones[i, j], rgb, knots, (top, bottom, left, right), light)
            next_red, behind, beside, rest = _shares(light[0] * strength >> 8)
            owed[below, j + 1 - ahead, 0] = red + behind
            red, last_red = last_red + beside, rest
            next_green, behind, beside, rest = _shares(light[1] * strength >> 8)
            owed[below, j + 1 - ahead, 1] = green + behind
            green, last_green = last_green + beside, rest
            next_blue, behind, beside, rest = _shares(light[2] * strength >> 8)
            owed[below, j + 1 - ahead, 2] = blue + behind
            blue, last_blue = last_blue + beside, rest
        end = 1 if here else columns
        owed[below, end, 0], owed[below, end, 1], owed[below, end, 2] = red, green, blue


@uncounted
def _join(knots: Indices, rgb: Rgb, labs: FloatArray, first: int, stop: int) -> None:
    """Give each lone knot of the rows the yarn beside it that is nearest to its colour, unless it shows there."""
    rows, columns = knots.shape
    for y in range(first, stop):
        for x in range(columns):
            if not is_lone(knots, y, x):
                continue
            own = knots[y, x]
            lightness, a, b = lab_of_light(LIGHT[rgb[y, x, 0]], LIGHT[rgb[y, x, 1]], LIGHT[rgb[y, x, 2]])
            least = ciede2000(lightness, a, b, labs[own, 0], labs[own, 1], labs[own, 2]) + SHOWN
            before = own
            for i, j in ((y - 1, x), (y, x - 1), (y + 1, x), (y, x + 1)):
                if 0 <= i < rows and 0 <= j < columns and knots[i, j] not in (before, knots[y, x]):
                    before = yarn = knots[i, j]
                    far = ciede2000(lightness, a, b, labs[yarn, 0], labs[yarn, 1], labs[yarn, 2])
                    if far < least:
                        least = far
                        knots[y, x] = yarn


def _dots(part: Rgb, tones: Tones, shelf: _Shelf) -> BoolArray:
    """Write the tones of the cells of a part; those that belong to a smooth square of 3 × 3 cells."""
    rough = np.empty(tones.shape, dtype=bool)
    _tones(part, tones, rough, shelf, np.empty((2, tones.shape[1]), dtype=np.int64))
    return grown(~grown(rough))


def draw_halftone(
    knots: Indices,
    rgb: Rgb,
    yarn_labs: Float[np.ndarray, "yarns 3"],
    strength: float,
    *,
    off: float,
    progress: Progress = SILENT,
) -> tuple[Indices, BoolArray]:
    """The chart with the pattern, and which cells of CELL × CELL knots are dots.

    knots  chart of the nearest yarns      rgb  the design      strength  share of the light that is carried on [-]
    off    mean difference of the design and the nearest yarns [CIEDE2000]
    """
    rgb, out, shelf = np.ascontiguousarray(rgb), knots.copy(), _shelf(yarn_labs, strength, greatest_contrast(off))
    rows, columns = max(1, knots.shape[0] // CELL), max(1, knots.shape[1] // CELL)
    drawn, owed = np.zeros((rows, columns), dtype=bool), np.zeros((2, columns + 2, 3), dtype=np.int64)
    for band in bands(rows, CELL**2 * columns):
        around = slice(max(band.start - 3, 0), min(band.stop + 3, rows))
        part = _knots_of(rgb, around, rows)
        tones = np.empty((around.stop - around.start, columns), dtype=np.int32)
        dots = _dots(part, tones, shelf)
        own = (band.start - around.start, band.stop - around.start, around.start)
        drawn[band] = dots[own[0] : own[1]]
        _draw(_knots_of(out, around, rows), part, tones, dots, shelf, own, owed)
        progress(0.9 * band.stop / rows)
    for band in bands(*out.shape):
        _join(out, rgb, shelf.search.labs, band.start, band.stop)
        progress(0.9 + 0.1 * band.stop / len(out))
    return out, drawn


def _knots_of(knots: Indices, cells: slice, rows: int) -> Indices:
    """The knots of rows of cells; the last row of cells takes what is left over."""
    return knots[CELL * cells.start : len(knots) if cells.stop == rows else CELL * cells.stop]
