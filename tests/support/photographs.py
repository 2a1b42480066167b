"""Photographs of carpets on floors, drawn: a carpet with a fringe, projected by Pillow onto a floor with noise."""

from collections.abc import Sequence

import numpy as np
from examples.draw_photograph import perspective
from PIL import Image

from ilmek.arrays import Rgb

Quad = Sequence[tuple[float, float]]


def projected_by_pillow(picture: Image.Image, quad: Quad, shape: tuple[int, int], above: float = 0.0) -> Image.Image:
    """A picture in a photograph of (height, width), with 2 × 2 samples a pixel.

    above  height of what the picture shows above and below the part whose corners are at `quad`
    """
    a = perspective(quad, picture.width, picture.height - 2 * above)
    a[3:6] += above * np.array([a[6], a[7], 1.0])
    scale = 2
    a[[0, 1, 3, 4, 6, 7]] /= scale
    large = (scale * shape[1], scale * shape[0])
    made = picture.transform(large, Image.Transform.PERSPECTIVE, a.tolist(), Image.Resampling.BILINEAR)
    return made.resize((shape[1], shape[0]), Image.Resampling.BOX)


def checkerboard(across: int, along: int, square: int) -> Rgb:
    """Squares of two colours, red in the upper left corner."""
    odd = (np.arange(across * square) // square + np.arange(along * square)[:, None] // square) % 2 == 1
    return np.where(odd[..., None], np.uint8([30, 40, 110]), np.uint8([200, 60, 40])).astype(np.uint8)


def photograph(
    carpet: Rgb,
    quad: Quad,
    shape: tuple[int, int] = (900, 1200),
    *,
    floor: tuple[int, int, int] = (150, 120, 90),
    noise: float = 12.0,
    fringe: int = 30,
    seed: int = 0,
) -> Rgb:
    """A carpet whose corners are at `quad`, with a fringe beyond its upper and lower side, on planks."""
    rng = np.random.default_rng(seed)
    height, width = carpet.shape[:2]
    sheet = np.zeros((height + 2 * fringe, width, 4), dtype=np.uint8)
    sheet[fringe : fringe + height] = np.dstack([carpet, np.full((height, width), 255, np.uint8)])
    threads = np.arange(width) % 6 < 2
    for end in (sheet[:fringe], sheet[fringe + height :]):
        end[:, threads] = (235, 228, 210, 255)
    layer = np.asarray(projected_by_pillow(Image.fromarray(sheet), quad, shape, fringe), dtype=float)
    planks = rng.normal(0, 10, shape[1] // 90 + 1).repeat(90)[: shape[1]] + np.linspace(-15, 15, shape[0])[:, None]
    below = np.array(floor) + planks[..., None]
    cover = layer[..., 3:] / 255
    return np.clip(layer[..., :3] * cover + below * (1 - cover) + rng.normal(0, noise, (*shape, 3)), 0, 255).astype(
        np.uint8
    )
