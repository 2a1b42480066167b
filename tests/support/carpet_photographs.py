"""Random photographs of the medallion carpet on a wooden floor: a camera, soft shadow, fringe, vignetting, noise, JPEG.

Nothing here knows how an outline is searched: the corners are those of the pinhole camera.
"""

import io
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from examples.draw_photograph import blurred
from photographs import projected_by_pillow
from PIL import Image, ImageFilter

from ilmek.arrays import Rgb

MEDALLION = Path(__file__).parents[2] / "examples" / "medallion.png"
WOODS = {"light": (205, 184, 152), "mid": (158, 118, 82), "dark": (92, 66, 48), "black": (46, 38, 33)}
"""Colours of floors; black is taken where it is asked for."""

PAD = 90
"""Floor around the carpet on its own sheet, for shadow and fringe [pixels of the sheet]."""


@dataclass(frozen=True)
class Photograph:
    """A picture, the corners of its carpet (4, 2), and what it shows: kind of wood and of fringe, share, shadow."""

    rgb: Rgb
    corners: np.ndarray
    wood: str
    fringe: str
    share: float
    shadow: float


@cache
def medallion(width: int) -> Rgb:
    """The picture of the examples at that width [pixels]."""
    with Image.open(MEDALLION) as picture:
        return np.asarray(picture.convert("RGB").resize((width, width * 3 // 2), Image.Resampling.BOX))


def area(corners: np.ndarray) -> float:
    """Area of a quadrilateral, by the shoelace formula."""
    x, y = corners.T
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def camera_view(rng: np.random.Generator, shape: tuple[int, int], wanted: float) -> np.ndarray:
    """Homography from the plane of a carpet of 1 × 1.5 about the origin, y down, into a picture: a pinhole camera.

    Its height above the floor, its direction and its roll are random; the distance is the one at which the carpet has
    the wanted share of the picture, as far as it stays whole.
    """
    height, width = shape
    while True:
        turn, tilt, roll = rng.uniform(-0.6, 0.6), rng.uniform(0, 0.75), rng.uniform(-0.06, 0.06)
        turn += rng.integers(2) * np.pi / 2
        shift, focal = rng.uniform(-0.12, 0.12, 2), rng.uniform(0.75, 1.3) * width
        c, s = np.cos(turn), np.sin(turn)
        spun = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        tilted = np.array([[1, 0, 0], [0, np.cos(tilt), np.sin(tilt)], [0, -np.sin(tilt), np.cos(tilt)]])
        rolled = np.array([[np.cos(roll), -np.sin(roll), 0], [np.sin(roll), np.cos(roll), 0], [0, 0, 1]])
        turned = rolled @ tilted @ spun
        for distance in np.linspace(1.0, 6.0, 120):
            middle = distance * np.array([*shift * (width, height) / focal, 1.0])
            lens = np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]])
            view = lens @ np.column_stack([turned[:, 0], turned[:, 1], middle])
            quad = seen(view, np.array([(-0.5, -0.75), (0.5, -0.75), (0.5, 0.75), (-0.5, 0.75)]))
            share = area(quad) / (height * width)
            inside = (quad > 0.045 * height).all() and (quad < (width - 0.045 * height, 0.955 * height)).all()
            if inside and share <= wanted and view[2] @ (0, -2, 1) > 0.2 and view[2] @ (2, 0, 1) > 0.2:
                if share > 0.8 * wanted:
                    return np.asarray(view)
                break


def seen(view: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Points of the floor in the picture [pixels]."""
    x, y, z = view @ np.column_stack([points, np.ones(len(points))]).T
    return np.stack([x / z, y / z], axis=1)


def wood(rng: np.random.Generator, view: np.ndarray, shape: tuple[int, int], colour: np.ndarray) -> np.ndarray:
    """A floor of planks with soft grain lines, in perspective."""
    height, width = shape
    y, x = np.mgrid[0.5:height, 0.5:width]
    u, v, w = np.tensordot(np.linalg.inv(view), np.stack([x, y, np.ones_like(x)]), axes=1)
    angle = rng.choice([0.0, np.pi / 2, rng.uniform(0, np.pi)])
    along = (np.cos(angle) * u + np.sin(angle) * v) / w
    across = (np.cos(angle) * v - np.sin(angle) * u) / w
    plank = np.floor(across / rng.uniform(0.12, 0.2)).astype(int)
    tones = rng.normal(0, rng.uniform(2, 7), 997)[plank % 997]
    grain = blurred(rng.normal(0, 1, (2048, 64)), 2.0)
    grain /= grain.std()
    lines = grain[(across * 400).astype(int) % 2048, ((along + plank * 0.37) * 3).astype(int) % 64]
    values = tones + rng.uniform(1, 4) * lines
    floor: np.ndarray = colour * (1 + values[..., None] / 130)
    return floor


def fringed(rng: np.random.Generator, carpet: Rgb, fringe: str) -> np.ndarray:
    """The carpet with its fringe on a transparent sheet, RGBA."""
    height, width = carpet.shape[:2]
    sheet = np.zeros((height + 2 * PAD, width + 2 * PAD, 4), dtype=np.uint8)
    length, step, thick = rng.uniform(20, 45), int(rng.integers(4, 9)), {"none": 0, "sparse": 2, "dense": 3}[fringe]
    ragged = rng.uniform(0, 0.2)
    if thick:
        for column in range(PAD, PAD + width - thick, step if fringe == "sparse" else 4):
            for end, outwards in ((PAD, -1), (PAD + height - 1, 1)):
                rows = end + outwards * np.arange(int(length * rng.uniform(1 - ragged, 1 + ragged)))
                drift = np.cumsum(rng.normal(0, 0.15, len(rows))).astype(int)
                tone = np.array([230, 222, 202]) * rng.uniform(0.85, 1.05)
                for thread in range(thick):
                    sheet[rows, np.clip(column + thread + drift, 0, width + 2 * PAD - 1)] = (*tone.clip(0, 255), 255)
    sheet[PAD : PAD + height, PAD : PAD + width] = np.dstack([carpet, np.full((height, width), 255, np.uint8)])
    return sheet


def kilim(width: int) -> Rgb:
    """A kilim of that width [pixels]: stripes at its ends, cream the outermost, and a field without a frame."""
    rgb = np.empty((width * 3 // 2, width, 3), dtype=np.uint8)
    rgb[:] = (45, 60, 120)
    across = np.arange(width) // max(1, width // 12) % 2 == 0
    rgb[width // 4 : -width // 4, across] = (190, 120, 50)
    for number, colour in enumerate([(228, 218, 192), (160, 40, 35), (60, 90, 60)]):
        stripe = slice(number * width // 30, (number + 1) * width // 30)
        rgb[stripe] = rgb[::-1][stripe] = colour
    return rgb


def random_photograph(
    seed: int,
    shape: tuple[int, int] = (1200, 1600),
    carpet: Callable[[int], Rgb] = medallion,
    **fixed: str,
) -> Photograph:
    """A photograph of a carpet; kinds of wood and fringe are random unless they are fixed."""
    rng = np.random.default_rng(seed)
    kind = fixed.get("wood", str(rng.choice(["light", "mid", "dark"])))
    fringe = fixed.get("fringe", str(rng.choice(["none", "sparse", "dense"])))
    view = camera_view(rng, shape, rng.uniform(0.25, 0.8))
    colour = np.trunc(np.array(WOODS[kind]) + rng.normal(0, 6, 3))
    sheet = fringed(rng, carpet(800 * shape[1] // 1600), fringe)
    high, wide = sheet.shape[:2]
    unit = wide - 2 * PAD
    edge = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) / 2
    quad = [tuple(point) for point in seen(view, edge * (wide / unit, high / unit)).tolist()]
    layer = np.asarray(projected_by_pillow(Image.fromarray(sheet), quad, shape), dtype=float)
    shadow, soft = rng.uniform(0.1, 0.5), rng.uniform(3, 18)
    shade = Image.fromarray(np.roll(sheet[..., 3], rng.integers(-14, 15, 2), (0, 1)))
    shade = shade.filter(ImageFilter.GaussianBlur(soft)).convert("RGB")
    dark = np.asarray(projected_by_pillow(shade, quad, shape), dtype=float)[..., :1] / 255
    ground = wood(rng, view, shape, colour) * (1 - shadow * dark)
    cover = layer[..., 3:] / 255
    picture = layer[..., :3] * cover + ground * (1 - cover)
    y, x = np.linspace(-0.75, 0.75, shape[0])[:, None], np.linspace(-1, 1, shape[1])
    tilt = rng.uniform(-0.12, 0.12, 2)
    light = (1 + tilt[0] * x + tilt[1] * y) * (1 - rng.uniform(0.05, 0.4) * (x**2 + y**2) / 1.56)
    picture = picture * light[..., None] * rng.uniform(0.9, 1.05) + rng.normal(0, rng.uniform(1, 4), (*shape, 3))
    room = io.BytesIO()
    Image.fromarray(picture.clip(0, 255).astype(np.uint8)).save(room, "JPEG", quality=int(rng.integers(85, 91)))
    corners = seen(view, edge * (1.0, 1.5))
    with Image.open(room) as photo:
        rgb = np.asarray(photo)
    return Photograph(rgb, corners, kind, fringe, area(corners) / (shape[0] * shape[1]), shadow)
