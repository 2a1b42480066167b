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

Plane = Float32[np.ndarray, "rows columns"]
Light = Float32[np.ndarray, "rows columns 3"]
"""The linear colours of knots."""

Pixels = Float32[np.ndarray, "height width 3"]
"""A picture in linear light."""

_FOOT = (0.66, 0.74)
_LEAN = 0.10
_LOOSE = 0.10
"""Half axes of a tuft's foot, shift of its tip towards the viewer's lower edge, spread of its position [pitches]."""
_SUN = (-0.34, -0.26)
_FINE = 65535
_CODES = np.rint(255 * encode(np.arange(_FINE + 1) / _FINE)).astype(np.uint8)


@dataclass(frozen=True, slots=True)
class _Tufts:
    """Tufts of a piece of pile and of a ring of neighbours around it: position in the cell, height, linear colour."""

    across: Plane
    down: Plane
    height: Plane
    colour: Float32[np.ndarray, "rows columns 3"]


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
    rows = np.arange(knots.shape[0])[:, np.newaxis]
    palette = LINEAR[np.array(srgb, dtype=np.uint8)].astype(np.float32)
    shades = palette[:, np.newaxis, :] * abrash(len(palette), knots.shape[0], rng)
    light = shades[knots, rows]
    return np.asarray(light * (1.0 + grain * rng.standard_normal(knots.shape, dtype=np.float32))[:, :, np.newaxis])


def tufted(light: Light, across: int, down: int, rng: np.random.Generator, fibre: float = 0.0) -> Pixels:
    """The pile of knots with these linear colours, `across` x `down` pixels per knot.

    fibre  strength of single fibres: streaks in the light, frayed borders between tufts; for close-ups
    """
    tufts = _scattered(light, rng)
    rows, columns = light.shape[:2]
    cells = np.empty((rows, down, columns, across, 3), dtype=np.float32)
    for j in range(down):
        for i in range(across):
            cells[:, j, :, i] = _seen(tufts, (i + 0.5) / across, (j + 0.5) / down, rng, fibre)
    out = cells.reshape(rows * down, columns * across, 3)
    if fibre:
        out *= _streaks(out.shape[0], out.shape[1], across, rng, fibre)[:, :, np.newaxis]
    return out


def _scattered(light: Light, rng: np.random.Generator) -> _Tufts:
    ringed = np.pad(light, ((1, 1), (1, 1), (0, 0)), mode="edge")
    shape = ringed.shape[:2]
    return _Tufts(
        0.5 + _LOOSE * rng.standard_normal(shape, dtype=np.float32),
        0.5 + _LEAN + _LOOSE * rng.standard_normal(shape, dtype=np.float32),
        1.0 + 0.13 * rng.standard_normal(shape, dtype=np.float32),
        ringed,
    )


def _seen(tufts: _Tufts, x: float, y: float, rng: np.random.Generator, fray: float) -> Light:
    """The light at one point of every cell: the highest of its own tuft and the three nearest neighbours."""
    aside, above = (1 if x > 0.5 else -1), (1 if y > 0.5 else -1)
    best, lit, colour = _tuft(tufts, x, y, 0, 0)
    best = best + _roughness(fray, best.shape, rng)
    for dx, dy in ((aside, 0), (0, above), (aside, above)):
        z, slope, other = _tuft(tufts, x, y, dx, dy)
        z = z + _roughness(fray, z.shape, rng)
        higher = z > best
        best, lit = np.where(higher, z, best), np.where(higher, slope, lit)
        colour = np.where(higher[:, :, np.newaxis], other, colour)
    depth = np.clip(best, -0.4, 1.2)
    return np.asarray(colour * (0.60 + 0.42 * depth + lit)[:, :, np.newaxis])


def _tuft(tufts: _Tufts, x: float, y: float, dx: int, dy: int) -> tuple[Plane, Plane, Light]:
    """Height, brightness by its slope, and colour of the tufts dx, dy cells away, at one point of every cell."""
    part = (slice(1 + dy, tufts.height.shape[0] - 1 + dy), slice(1 + dx, tufts.height.shape[1] - 1 + dx))
    u = (np.float32(x - dx) - tufts.across[part]) * np.float32(1 / _FOOT[0])
    v = (np.float32(y - dy) - tufts.down[part]) * np.float32(1 / _FOOT[1])
    slope = u * np.float32(_SUN[0]) + v * np.float32(_SUN[1])
    return tufts.height[part] - u * u - v * v, slope, tufts.colour[part]


def _roughness(fray: float, shape: tuple[int, ...], rng: np.random.Generator) -> Plane | np.float32:
    """Random unevenness of the fibre tips [pitches]."""
    return np.float32(1.3 * fray) * rng.standard_normal(shape, dtype=np.float32) if fray else np.float32(0)


def _streaks(height: int, width: int, across: int, rng: np.random.Generator, strength: float) -> Plane:
    """Noise stretched down the picture: the fibres of the cut pile."""
    noise = rng.standard_normal((height, width), dtype=np.float32)
    length = max(2, across // 4)
    summed = np.cumsum(np.pad(noise, ((length, 0), (0, 0)), mode="wrap"), axis=0, dtype=np.float32)
    smooth = (summed[length:] - summed[:-length]) / np.float32(np.sqrt(length))
    return 1.0 + strength * smooth
