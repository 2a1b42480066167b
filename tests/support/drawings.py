"""Drawings to chart: functions of the position in knots, so that each can be rendered at any number of pixels a knot.

A drawing gives the number of its colour at every point; `rendered` makes the picture of it as it would come from a
program that draws hard edges, one that smooths them, a JPEG file of it, or a scan with grain. The truth stays known:
`colours_in_cells` tells which colours a knot's cell really has.
"""

import io
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from ilmek.carpet.colour import LINEAR, encode

Points = NDArray[np.float64]
Numbers = NDArray[np.int64]
Pixels = NDArray[np.uint8]

NAVY, MADDER, IVORY, GOLD = (31, 49, 87), (158, 43, 37), (235, 223, 195), (200, 149, 60)
BLACK, SKY, GREEN, ROSE = (30, 27, 29), (143, 176, 189), (70, 92, 60), (211, 156, 134)

FINE = 8
"""Points a knot, in each direction, at which the truth is taken."""

FINISHES = ("hard", "smooth", "jpeg", "grain")


@dataclass(frozen=True)
class Drawing:
    """A drawing of rows x columns knots: `number(x, y)` is the colour at a point, x to the right, y down.

    lines      numbers of the colours that are lines, whose pieces must neither break nor join
    symmetric  axes: "" or of "x" (left and right alike) and "y"
    """

    number: Callable[[Points, Points], Numbers]
    colours: tuple[tuple[int, int, int], ...]
    rows: int = 72
    columns: int = 60
    lines: tuple[int, ...] = ()
    symmetric: str = ""

    def at(self, height: int, width: int) -> Numbers:
        """The colours at the centres of height x width pixels."""
        x = (np.arange(width) + 0.5) * self.columns / width
        y = (np.arange(height) + 0.5) * self.rows / height
        xs, ys = np.meshgrid(x, y)
        return np.asarray(self.number(xs, ys), dtype=np.int64)


def rendered(drawing: Drawing, pixels: float, finish: str) -> Pixels:
    """The picture of a drawing with so many pixels a knot."""
    height, width = round(drawing.rows * pixels), round(drawing.columns * pixels)
    palette = np.array(drawing.colours, dtype=np.uint8)
    if finish == "hard":
        return palette[drawing.at(height, width)]
    light = LINEAR[palette[drawing.at(4 * height, 4 * width)]]
    smooth = encode(light.reshape(height, 4, width, 4, 3).mean(axis=(1, 3)))
    if finish == "grain":
        smooth = smooth + np.random.default_rng(5).normal(scale=5 / 255, size=smooth.shape)
    rgb = np.rint(255 * np.clip(smooth, 0, 1)).astype(np.uint8)
    if finish != "jpeg":
        return rgb
    file = io.BytesIO()
    Image.fromarray(rgb).save(file, format="JPEG", quality=85)
    return np.asarray(Image.open(file).convert("RGB"))


def colours_in_cells(drawing: Drawing) -> NDArray[np.bool_]:
    """For each knot and colour whether the colour is in the knot's cell: (rows, columns, colours)."""
    fine = drawing.at(drawing.rows * FINE, drawing.columns * FINE)
    cells = fine.reshape(drawing.rows, FINE, drawing.columns, FINE)
    return np.stack([(cells == number).any(axis=(1, 3)) for number in range(len(drawing.colours))], axis=-1)


def _stripes(along: Points, pitch: float, width: float) -> NDArray[np.bool_]:
    """Stripes of a width about the multiples of a pitch."""
    return np.abs(along - pitch * np.rint(along / pitch)) < width / 2


def _turned(degrees: float) -> tuple[float, float]:
    return float(np.cos(np.radians(degrees))), float(np.sin(np.radians(degrees)))


def _lines(degrees: float, width: float) -> Drawing:
    c, s = _turned(degrees)
    return Drawing(lambda x, y: _stripes(s * x - c * y + 1.3, 7.0, width).astype(int), (IVORY, NAVY), lines=(1,))


def _rays(x: Points, y: Points) -> Numbers:
    dx, dy = x - 30, y - 36
    angle = np.arctan2(dy, dx)
    apart = np.hypot(dx, dy) * np.abs(np.sin(angle - np.pi / 12 * np.rint(angle * 12 / np.pi)))
    return ((apart < 0.5) & (np.hypot(dx, dy) > 14)).astype(int)


def _dots(x: Points, y: Points) -> Numbers:
    u, v = x - 0.5, y - 0.5
    return (np.hypot(u - 6 * np.rint(u / 6), v - 6 * np.rint(v / 6)) < 0.65).astype(int)


def _eyes(x: Points, y: Points) -> Numbers:
    u, v = x - 6 - 12 * np.rint((x - 6) / 12), y - 6 - 12 * np.rint((y - 6) / 12)
    r = np.hypot(u, v)
    return np.select([r < 0.8, r < 2.5, r < 3.8], [3, 2, 1], 0)


def _grid(x: Points, y: Points) -> Numbers:
    return (_stripes(x - 4.5, 10, 0.999) | _stripes(y - 5.5, 10, 0.999)).astype(int)


def _rings(x: Points, y: Points) -> Numbers:
    return _stripes(np.hypot(x - 30, y - 36) - 2.0, 4.0, 1.0).astype(int)


def _steps(x: Points, y: Points) -> Numbers:
    u, v = np.abs(np.floor(x) - 29.5), np.floor(y / 3)
    return (np.floor((u + 3 * np.abs(v - 11.5)) / 6) % 4).astype(int)


def _diamonds(x: Points, y: Points) -> Numbers:
    far = np.abs(x - 30) * 1.2 + np.abs(y - 36)
    return np.where(_stripes(far, 8.0, 1.7), 2, np.floor(far / 8) % 2).astype(int)


def _zigzag(x: Points, y: Points) -> Numbers:
    return (np.floor((y + np.abs(x % 10 - 5)) / 4) % 3).astype(int)


def _spiral(x: Points, y: Points) -> Numbers:
    dx, dy = x - 30, y - 36
    turns = np.arctan2(dy, dx) / (2 * np.pi)
    arm = np.rint(np.hypot(dx, dy) / 4 - turns)
    apart = np.abs(np.hypot(dx, dy) - 4 * (arm + turns))
    return ((apart < 0.5) & (arm + turns > 0.8) & (arm + turns < 6.8)).astype(int)


def _rosette(x: Points, y: Points) -> Numbers:
    dx, dy = x - 30, y - 36
    r, angle = np.hypot(dx, dy), np.arctan2(dy, dx)
    petal = 20 + 4 * np.cos(8 * angle)
    return np.select([r < 5, r < petal - 3, r < petal, r < petal + 1.5], [3, 1, 2, 4], 0)


def _checks(x: Points, y: Points) -> Numbers:
    return ((np.floor(x / 2) + np.floor(y / 2)) % 2).astype(int)


def _scales(x: Points, y: Points) -> Numbers:
    row = np.floor(y / 6)
    u = (x + 5 * (row % 2)) % 10 - 5
    return np.where(np.hypot(u, y % 6) < 5, 1, 2) * (np.abs(np.hypot(u, y % 6) - 5) > 0.6)


def _hexagons(x: Points, y: Points) -> Numbers:
    axes = (_turned(angle) for angle in (0, 60, 120))
    return np.any([_stripes(c * (x - 30) + s * (y - 36), 9.0, 0.9) for c, s in axes], axis=0).astype(int)


def _star(x: Points, y: Points) -> Numbers:
    dx, dy = x - 30, y - 36
    far = np.minimum(np.maximum(abs(dx), abs(dy)), np.maximum(abs(dx + dy), abs(dx - dy)) / np.sqrt(2))
    near = np.maximum(np.maximum(abs(dx), abs(dy)), np.maximum(abs(dx + dy), abs(dx - dy)) / np.sqrt(2))
    return np.select([near < 9, far < 19, far < 20.2], [1, 3, 2], 0)


def _borders(x: Points, y: Points) -> Numbers:
    inset = np.minimum(np.minimum(x, 60 - x), np.minimum(y, 72 - y))
    return np.select([inset < 2, inset < 3, inset < 9, inset < 10, inset < 12], [0, 1, 2, 1, 3], 4)


def _letters(x: Points, y: Points) -> Numbers:
    scale = 16
    sheet = Image.new("L", (60 * scale, 72 * scale), 0)
    pen = ImageDraw.Draw(sheet)
    for line, text in enumerate(("ILMEK", "1923", "Hereke")):
        pen.text((4 * scale, (4 + 21 * line) * scale), text, fill=255, font=ImageFont.load_default(size=15 * scale))
    ink = np.asarray(sheet) > 127
    column, row = (np.clip((axis * scale).astype(int), 0, most) for axis, most in ((x, 959), (y, 1151)))
    return ink[row, column].astype(int)


def _tree(x: Points, y: Points) -> Numbers:
    found = np.abs(x - 30) < 0.75
    for level, height in enumerate(range(10, 64, 9)):
        reach = 8 + 3 * level
        found |= (np.abs(np.abs(x - 30) - (y - height)) < 1.0) & (np.abs(x - 30) < reach)
    return np.where((y > 4) & (y < 70), found, False).astype(int)


FLAT: dict[str, Drawing] = {
    **{f"lines at {degrees}": _lines(degrees, 0.7) for degrees in (0, 17, 31, 45, 63, 90)},
    "lines of one knot": _lines(38, 1.0),
    "rays": Drawing(_rays, (IVORY, MADDER)),
    "dots": Drawing(_dots, (NAVY, IVORY)),
    "eyes": Drawing(_eyes, (MADDER, IVORY, NAVY, BLACK), symmetric="xy"),
    "grid": Drawing(_grid, (MADDER, GOLD), lines=(1,)),
    "rings": Drawing(_rings, (IVORY, BLACK), lines=(1,), symmetric="xy"),
    "kilim steps": Drawing(_steps, (MADDER, IVORY, NAVY, GOLD), symmetric="x"),
    "diamonds": Drawing(_diamonds, (MADDER, NAVY, IVORY), lines=(2,), symmetric="xy"),
    "zigzag": Drawing(_zigzag, (MADDER, IVORY, GREEN)),
    "spiral": Drawing(_spiral, (SKY, NAVY), lines=(1,)),
    "rosette": Drawing(_rosette, (NAVY, ROSE, MADDER, GOLD, BLACK), symmetric="xy"),
    "checks": Drawing(_checks, (IVORY, NAVY)),
    "scales": Drawing(_scales, (BLACK, SKY, IVORY)),
    "hexagons": Drawing(_hexagons, (MADDER, IVORY), lines=(1,), symmetric="xy"),
    "star": Drawing(_star, (MADDER, IVORY, BLACK, NAVY), lines=(2,), symmetric="xy"),
    "borders": Drawing(_borders, (BLACK, IVORY, MADDER, GOLD, NAVY), lines=(1,), symmetric="xy"),
    "letters": Drawing(_letters, (IVORY, BLACK)),
    "tree": Drawing(_tree, (SKY, GREEN), lines=(1,), symmetric="x"),
}
"""Drawings by name, 60 x 72 knots."""


def sunset(rows: int = 360, columns: int = 240) -> Pixels:
    """A sky from navy over rose to gold, with a sun: a gradient with no outline but the sun's and the horizon's."""
    y, x = np.mgrid[0 : 1 : rows * 1j, 0 : 1 : columns * 1j]
    stops = np.array([[24, 30, 74], [120, 60, 110], [214, 110, 92], [245, 178, 96], [250, 222, 150]], dtype=float)
    stage = np.clip(y / 0.7, 0, 1) * (len(stops) - 1)
    low = np.minimum(stage.astype(int), len(stops) - 2)
    share = (stage - low)[..., None]
    rgb = (1 - share) * stops[low] + share * stops[low + 1]
    glow = np.exp(-(((x - 0.5) * columns / rows / 0.16) ** 2 + ((y - 0.52) / 0.16) ** 2))[..., None]
    rgb = rgb + glow * (np.array([255, 236, 170]) - rgb) * 0.7
    sea = y > 0.7
    rgb[sea] = (1 - y[sea][:, None]) / 0.3 * np.array([150, 96, 84]) + (y[sea][:, None] - 0.7) / 0.3 * np.array(
        [20, 26, 52]
    )
    return np.clip(np.rint(rgb), 0, 255).astype(np.uint8)


def vignette(rows: int = 300, columns: int = 240) -> Pixels:
    """Rose in the middle, darker towards the corners."""
    y, x = np.mgrid[-1 : 1 : rows * 1j, -1 : 1 : columns * 1j]
    share = np.clip(1 - 0.6 * np.hypot(x, y), 0, 1)[..., None]
    return np.clip(np.rint(share * np.array([224, 170, 150]) + (1 - share) * 30), 0, 255).astype(np.uint8)
