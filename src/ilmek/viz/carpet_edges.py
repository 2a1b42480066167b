"""The frame of the pile: selvedges at the sides, a flat-woven band and a fringe at both ends."""

import numpy as np
from PIL import Image, ImageDraw

from ilmek.arrays import Rgb
from ilmek.viz.tufts import encoded

COTTON = (0.72, 0.63, 0.48)
"""Linear colour of the warp."""
_PAPER = (255, 255, 255)
_FINER = 3


def selvedge(height: int, width: int, light: tuple[float, float, float], rng: np.random.Generator) -> Rgb:
    """A round cord of overcast wefts, `height` x `width` pixels, in a linear colour."""
    across = (np.arange(width) + 0.5) / max(width, 1) * 2 - 1
    body = 0.45 + 0.55 * np.sqrt(np.clip(1 - across**2, 0, 1)) - 0.12 * across
    turns = np.arange(height)[:, np.newaxis] / max(2.6, width / 2.2) + across * 0.35
    shade = body * (0.86 + 0.14 * np.cos(2 * np.pi * turns)) * rng.normal(1.0, 0.04, (height, width))
    return encoded((shade[:, :, np.newaxis] * np.array(light)).astype(np.float32))


def flat_band(height: int, width: int, rng: np.random.Generator) -> Rgb:
    """The flat-woven end: ribs of weft across the warps."""
    ribs = 0.88 + 0.10 * np.cos(2 * np.pi * np.arange(height)[:, np.newaxis] / 3.0)
    warps = 0.97 + 0.05 * np.cos(2 * np.pi * np.arange(width) / 2.9)
    shade = ribs * warps * rng.normal(1.0, 0.03, (height, width))
    return encoded((shade[:, :, np.newaxis] * np.array(COTTON) * 0.9).astype(np.float32))


def fringe(height: int, width: int, rng: np.random.Generator) -> Image.Image:
    """Warp ends knotted in bundles on white paper, pointing down."""
    finer = Image.new("RGB", (width * _FINER, height * _FINER), _PAPER)
    draw = ImageDraw.Draw(finer)
    spacing = max(6.0, width / 170) * _FINER
    for centre in np.arange(spacing / 2, width * _FINER, spacing):
        _bundle(draw, float(centre), spacing, height * _FINER, rng)
    return finer.reduce(_FINER)


def _bundle(draw: ImageDraw.ImageDraw, centre: float, spacing: float, height: int, rng: np.random.Generator) -> None:
    """Strands from the edge into a knot and out of it again, the rear ones darker."""
    knot, along = 0.20 * height, np.linspace(0.0, 1.0, 9)
    width = max(1, round(spacing / 7))
    strands = 7
    upper = [0.68 + 0.34 * number / strands + rng.normal(0.0, 0.03) for number in range(strands)]
    drawn = [(rng.normal(0.0, 0.03), rng.normal(0.0, 0.30), rng.uniform(0, 2 * np.pi), rng.uniform(0.84, 0.99))
             for _ in range(strands)]  # fmt: skip
    lower = [0.66 + 0.36 * number / strands + one[0] for number, one in enumerate(drawn)]
    shades = _cotton([*upper, *lower, 0.8, 1.05])
    for number, shade in enumerate(shades[:strands]):
        start = centre + spacing * 0.42 * (number / (strands - 1) - 0.5)
        draw.line([(start, 0), (centre, knot)], fill=shade, width=width)
    _, sways, phases, lengths = np.array(drawn).T[..., np.newaxis]
    x = centre + sways * spacing * along**1.4 + 0.07 * spacing * np.sin(phases + 9.0 * along) * along
    y = knot + (height - knot) * lengths * along
    for shade, points in zip(shades[strands:], np.stack((x, y), axis=-1), strict=False):
        draw.line(list(map(tuple, points.tolist())), fill=shade, width=width, joint="curve")
    radius = 0.16 * spacing
    draw.ellipse((centre - radius, knot - 1.3 * radius, centre + radius, knot + 1.3 * radius), fill=shades[-2])
    draw.ellipse((centre - 0.6 * radius, knot - radius, centre + 0.3 * radius, knot + 0.2 * radius), fill=shades[-1])


def _cotton(brightness: list[float]) -> list[tuple[int, int, int]]:
    light = np.array(COTTON, dtype=np.float32) * np.array(brightness, dtype=np.float32)[:, np.newaxis]
    return [(red, green, blue) for red, green, blue in encoded(light).tolist()]
