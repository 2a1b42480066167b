"""The pile of a carpet seen from above: every knot is a tuft, in linear light.

A tuft is a leaning mound with an elliptic foot:

    z(x, y) = h - ((x - cx) / a)² - ((y - cy) / b)²                            own model, lengths in knot pitches

with a centre (cx, cy) and a height h that vary from knot to knot. At each point the highest tuft is visible. It is
darker deep between the tufts and lighter where it faces the light (upper left). The pile leans towards the beginning of
the weave, the lower edge. The yarn's colour varies a little from knot to knot, and in bands of rows from dye lot to dye
lot (abrash).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Float32, Indices, Rgb
from ilmek.carpet.colour import LINEAR, encode
from ilmek.carpet.design import bands
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress

Plane = Float32[np.ndarray, "rows columns"]
Light = Float32[np.ndarray, "rows columns 3"]
"""The linear colours of knots."""

Pixels = Float32[np.ndarray, "height width channels"]
"""A picture in linear light."""

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
    progress: Progress = SILENT,
) -> Rgb:
    """The pile of knots with these linear colours, on `width` x `height` pixels.

    fibre  strength of single fibres: streaks in the light, frayed borders between tufts; for close-ups
    """
    tufts = _scattered(light, rng)
    fibres = np.zeros((0, 0, 5), dtype=np.float32)
    if fibre:
        fibres = np.empty((height, width, 5), dtype=np.float32)
        rng.standard_normal(out=fibres, dtype=np.float32)
        fibres *= np.float32(1.3 * fibre)
        fibres[:, :, 4] = _streaks(height, width, width // light.shape[1], rng, fibre)
    out = np.empty((height, width, 3), dtype=np.uint8)
    for band in bands(height, width, _SLICE):
        _draw(tufts.across, tufts.down, tufts.height, light, fibres, out[band], band.start, height)
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
def _draw(  # noqa: PLR0917
    across: Plane, down: Plane, height: Plane, light: Light, fibres: Pixels, out: Rgb, first: int, high: int
) -> None:
    # The highest of a pixel's own tuft and its three nearest neighbours; at the edges a tuft is its own neighbour.
    rows, columns = across.shape
    wide, frayed = out.shape[1], fibres.shape[0] > 0
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
            best, lit, seen_row, seen_column = -np.inf, 0.0, row, column
            for which in range(4):
                dx, dy = aside * (which % 2), above * (which // 2)
                r = min(max(row + dy, 0), rows - 1)
                c = min(max(column + dx, 0), columns - 1)
                u = (x - dx - across[r, c]) / _FOOT[0]
                v = (y - dy - down[r, c]) / _FOOT[1]
                z = height[r, c] - u * u - v * v
                if frayed:
                    z += fibres[first + j, i, which]
                if z > best:
                    best, lit, seen_row, seen_column = z, u * _SUN[0] + v * _SUN[1], r, c
            shade = 0.60 + 0.42 * min(max(best, -0.4), 1.2) + lit
            if frayed:
                shade *= fibres[first + j, i, 4]
            for channel in range(3):
                value = min(max(light[seen_row, seen_column, channel] * shade, 0.0), 1.0)
                out[j, i, channel] = _CODES[int(value * _FINE)]


def _streaks(height: int, width: int, across: int, rng: np.random.Generator, strength: float) -> Plane:
    """Noise stretched down the picture: the fibres of the cut pile."""
    noise = rng.standard_normal((height, width), dtype=np.float32)
    length = max(2, across // 4)
    summed = np.cumsum(np.pad(noise, ((length, 0), (0, 0)), mode="wrap"), axis=0, dtype=np.float32)
    smooth = (summed[length:] - summed[:-length]) / np.float32(np.sqrt(length))
    return 1.0 + strength * smooth
