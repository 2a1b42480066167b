"""The pile of a carpet seen from above: every knot is a tuft, in linear light.

A tuft is a leaning mound with an elliptic foot:

    z(x, y) = h - ((x - cx) / a)² - ((y - cy) / b)²                            own model, lengths in knot pitches

with a centre (cx, cy) and a height h that vary from knot to knot. At each point the highest tuft is visible. It is
darker deep between the tufts and lighter where it faces the light (upper left). The pile leans towards the beginning of
the weave, the lower edge. A cell of two half knots has two tufts of half the width, a jufti knot one of twice the
width over its two cells. The yarn's colour varies a little from knot to knot, and in bands of rows from dye lot to dye
lot (abrash).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Float32, Indices, Int32, Rgb
from ilmek.carpet.colour import LINEAR, encode
from ilmek.carpet.design import bands
from ilmek.carpet.overlay import HALF, Overlay
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress

Plane = Float32[np.ndarray, "rows columns"]
Light = Float32[np.ndarray, "rows columns 3"]
"""The linear colours of knots."""

Pixels = Float32[np.ndarray, "height width channels"]
"""A picture in linear light."""

Marks = Int32[np.ndarray, "rows columns"]
"""Forms of the knots of cells: 0 a whole knot; n > 0 two half knots, the right one in the n-th second colour; the left
and the right cell of a jufti knot. Without a row: all are whole.
"""

SecondLight = Float32[np.ndarray, "halves 3"]
"""The linear colours of the right half knots."""

_JUFTI_LEFT, _JUFTI_RIGHT = -1, -2

_FOOT = (0.66, 0.74)
_LEAN = 0.10
_LOOSE = 0.10
"""Half axes of a tuft's foot, shift of its tip towards the viewer's lower edge, spread of its position [pitches]."""
_SUN = (-0.34, -0.26)
_SLICE = 1 << 20
"""Pixels of one call of the kernel: about 0.1 s, in which an interrupt waits."""
_FINE = 65535
_CODES = np.rint(255 * encode(np.arange(_FINE + 1) / _FINE)).astype(np.uint8)


@dataclass(frozen=True, slots=True)
class _Tufts:
    """Tufts of a piece of pile: position in the cell, height."""

    across: Plane
    down: Plane
    height: Plane


@dataclass(frozen=True, slots=True)
class MarkedTufts:
    """The half knots and jufti knots of a piece of pile."""

    marks: Marks
    seconds: SecondLight


def no_marks() -> MarkedTufts:
    """Every knot is whole."""
    return MarkedTufts(np.zeros((0, 0), dtype=np.int32), np.zeros((0, 3), dtype=np.float32))


def marked_tufts(
    overlay: Overlay,
    corner: tuple[int, int],
    shape: tuple[int, int],
    srgb: Sequence[tuple[int, int, int]],
    rng: np.random.Generator,
) -> MarkedTufts:
    """The marks of an overlay in a piece of `shape` (rows, columns) whose first cell is `corner` (row, column).

    A jufti knot of which the piece has only the right cell is drawn as a whole knot.
    """
    part = overlay.between(corner[0], corner[0] + shape[0])
    rows, columns = part.rows - corner[0], part.columns - corner[1]
    inside, half = (columns >= 0) & (columns < shape[1]), part.kinds == HALF
    if not inside.any():
        return no_marks()
    marks, halves, juftis = np.zeros(shape, dtype=np.int32), inside & half, inside & ~half
    marks[rows[halves], columns[halves]] = 1 + np.arange(np.count_nonzero(halves))
    marks[rows[juftis], columns[juftis]] = _JUFTI_LEFT
    whole = juftis & (columns + 1 < shape[1])
    marks[rows[whole], columns[whole] + 1] = _JUFTI_RIGHT
    if not halves.any():
        return MarkedTufts(marks, no_marks().seconds)
    return MarkedTufts(marks, yarn_light(part.seconds[halves][np.newaxis], srgb, rng, 0.05)[0])


def encoded(light: Pixels) -> Rgb:
    """Linear light as sRGB codes, clipped."""
    return np.asarray(_CODES[(np.clip(light, 0.0, 1.0) * np.float32(_FINE)).astype(np.uint16)])


def abrash(yarns: int, rows: int, rng: np.random.Generator) -> Float32[np.ndarray, "yarns rows 3"]:
    """Factors on each yarn's colour by row: dye lots of some 20 to 120 rows, and a slow drift within them."""
    factors = np.ones((yarns, rows, 3), dtype=np.float32)
    for yarn in range(yarns):
        row = int(rng.integers(0, 60))
        while row < rows:
            lot = int(rng.integers(20, 120))
            factors[yarn, row : row + lot] *= 1.0 + rng.normal(0.0, 0.028) + rng.normal(0.0, 0.012, 3)
            row += lot
    drift = np.cumsum(rng.normal(0.0, 0.004, (yarns, rows, 1)), axis=1)
    return factors * (1.0 + np.clip(drift, -0.05, 0.05)).astype(np.float32)


def yarn_light(knots: Indices, srgb: Sequence[tuple[int, int, int]], rng: np.random.Generator, grain: float) -> Light:
    """The linear colour of every knot: palette, abrash, and `grain` as the spread between knots."""
    palette = LINEAR[np.array(srgb, dtype=np.uint8)].astype(np.float32)
    shades = palette[:, np.newaxis, :] * abrash(len(palette), knots.shape[0], rng)
    light = np.empty((*knots.shape, 3), dtype=np.float32)
    for band in bands(*knots.shape):
        rows = np.arange(band.start, band.stop)[:, np.newaxis]
        spread = rng.standard_normal(knots[band].shape, dtype=np.float32)[:, :, np.newaxis]
        light[band] = shades[knots[band], rows] * (1.0 + grain * spread)
    return light


def tufted(
    light: Light,
    width: int,
    height: int,
    rng: np.random.Generator,
    *,
    fibre: float = 0.0,
    marked: MarkedTufts | None = None,
    progress: Progress = SILENT,
) -> Rgb:
    """The pile of knots with these linear colours, on `width` x `height` pixels.

    fibre   strength of single fibres: streaks in the light, frayed borders between tufts; for close-ups
    marked  half knots and jufti knots; default: none
    """
    marked = marked or no_marks()
    tufts = _scattered(light, rng)
    fibres = np.zeros((0, 0, 5), dtype=np.float32)
    if fibre:
        fibres = np.empty((height, width, 5), dtype=np.float32)
        rng.standard_normal(out=fibres, dtype=np.float32)
        fibres *= np.float32(1.3 * fibre)
        fibres[:, :, 4] = _streaks(height, width, width // light.shape[1], rng, fibre)
    out = np.empty((height, width, 3), dtype=np.uint8)
    for band in bands(height, width, _SLICE):
        _draw(
            tufts.across,
            tufts.down,
            tufts.height,
            light,
            marked.marks,
            marked.seconds,
            fibres,
            out[band],
            band.start,
            height,
        )
        progress(band.stop / height)
    return out


def _scattered(light: Light, rng: np.random.Generator) -> _Tufts:
    shape = light.shape[:2]
    return _Tufts(
        0.5 + _LOOSE * rng.standard_normal(shape, dtype=np.float32),
        0.5 + _LEAN + _LOOSE * rng.standard_normal(shape, dtype=np.float32),
        1.0 + 0.13 * rng.standard_normal(shape, dtype=np.float32),
    )


@compiled
def _marked_tuft(away: float, centre: float, mark: int) -> tuple[float, float, int]:
    """Distance from a tuft's middle, half its foot, and its second colour: of the nearer half knot, or of a jufti knot.

    away, centre  of a whole knot in the cell, or in the left cell of the jufti knot
    """
    if mark < 0:
        return away - 0.5, 2.0 * _FOOT[0], 0
    left = away + 0.5 * centre
    if left > 0.25:
        return left - 0.5, 0.5 * _FOOT[0], mark
    return left, 0.5 * _FOOT[0], 0


@compiled
def _draw(  # noqa: PLR0917 - one kernel
    across: Plane,
    down: Plane,
    height: Plane,
    light: Light,
    marks: Marks,
    seconds: SecondLight,
    fibres: Pixels,
    out: Rgb,
    first: int,
    high: int,
) -> None:
    # The highest of a pixel's own tuft and its three nearest neighbours; at the edges a tuft is its own neighbour.
    rows, columns = across.shape
    wide, frayed, marked = out.shape[1], fibres.shape[0] > 0, marks.shape[0] > 0
    for j in range(out.shape[0]):
        y = (first + j + 0.5) * rows / high
        row = int(y)
        y -= row
        above = 1 if y > 0.5 else -1
        for i in range(wide):
            x = (i + 0.5) * columns / wide
            column = int(x)
            x -= column
            aside = 1 if x > 0.5 else -1
            best, lit, seen_row, seen_column, seen_half = -np.inf, 0.0, row, column, 0
            for which in range(4):
                dx, dy = aside * (which % 2), above * (which // 2)
                r = min(max(row + dy, 0), rows - 1)
                c = min(max(column + dx, 0), columns - 1)
                if marked and marks[r, c] == _JUFTI_RIGHT:
                    c, dx = c - 1, dx - 1
                away, foot, half = x - dx - across[r, c], _FOOT[0], 0
                if marked and marks[r, c] != 0:
                    away, foot, half = _marked_tuft(away, across[r, c], marks[r, c])
                u = away / foot
                v = (y - dy - down[r, c]) / _FOOT[1]
                z = height[r, c] - u * u - v * v
                if frayed:
                    z += fibres[first + j, i, which]
                if z > best:
                    best, lit, seen_row, seen_column, seen_half = z, u * _SUN[0] + v * _SUN[1], r, c, half
            shade = 0.60 + 0.42 * min(max(best, -0.4), 1.2) + lit
            if frayed:
                shade *= fibres[first + j, i, 4]
            for channel in range(3):
                yarn = seconds[seen_half - 1, channel] if seen_half else light[seen_row, seen_column, channel]
                value = min(max(yarn * shade, 0.0), 1.0)
                out[j, i, channel] = _CODES[int(value * _FINE)]


def _streaks(height: int, width: int, across: int, rng: np.random.Generator, strength: float) -> Plane:
    """Noise stretched down the picture: the fibres of the cut pile."""
    noise = rng.standard_normal((height, width), dtype=np.float32)
    length = max(2, across // 4)
    summed = np.cumsum(np.pad(noise, ((length, 0), (0, 0)), mode="wrap"), axis=0, dtype=np.float32)
    smooth = (summed[length:] - summed[:-length]) / np.float32(np.sqrt(length))
    return 1.0 + strength * smooth
