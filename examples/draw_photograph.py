"""Draws examples/photo.jpg: the Tabriz of examples/recipes on a wooden floor, photographed from where one stands.

Run it as `python examples/draw_photograph.py`; it prints the corners of the carpet in the picture.
"""

import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageFilter

from ilmek.carpet.chart import Chart
from ilmek.jobs.order import read_order
from ilmek.jobs.recipe import chart_of_recipe
from ilmek.viz.carpet_picture import draw_carpet

EXAMPLES = Path(__file__).parent
FILE = EXAMPLES / "photo.jpg"

EYE, LOOKS_AT, FOCAL = (35.0, -185.0, 225.0), (0.0, -10.0, 0.0), 0.97
"""The camera [cm] from the carpet's middle, to the right, to its upper end and up; what it looks at; its focal length
in widths of the picture."""

SHAPE = (1200, 1600)
SCALE = 5
"""Pixels of the floor for each centimetre."""

FRINGE, MARGIN = 5, 220
"""Length of the fringe, and floor around the carpet [cm]."""

Quad = Sequence[tuple[float, float]]


def perspective(quad: Quad, width: float, height: float) -> np.ndarray:
    """Coefficients of Pillow's PERSPECTIVE from a photograph to a picture whose corners are at `quad`."""
    rows, values = [], []
    for (u, v), (x, y) in zip(quad, [(0, 0), (width, 0), (width, height), (0, height)], strict=True):
        rows += [[u, v, 1, 0, 0, 0, -u * x, -v * x], [0, 0, 0, u, v, 1, -u * y, -v * y]]
        values += [x, y]
    return np.linalg.solve(np.array(rows, dtype=float), np.array(values, dtype=float))


def corners(width: float, length: float) -> Quad:
    """Corners of a carpet [cm] in the picture [pixels], from its own upper left one clockwise."""
    eye = np.array(EYE)
    ahead = (np.array(LOOKS_AT) - eye) / np.linalg.norm(np.array(LOOKS_AT) - eye)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    down = np.cross(ahead, right)
    rays = np.array([(x * width / 2, y * length / 2, 0.0) for x, y in ((-1, 1), (1, 1), (1, -1), (-1, -1))]) - eye
    scale = FOCAL * SHAPE[1] / (rays @ ahead)
    return list(zip(SHAPE[1] / 2 + scale * (rays @ right), SHAPE[0] / 2 + scale * (rays @ down), strict=True))


def blurred(values: np.ndarray, radius: float) -> np.ndarray:
    """Values of about -3 to 3, blurred."""
    image = Image.fromarray((127.5 + 40 * values).clip(0, 255).astype(np.uint8))
    return (np.asarray(image.filter(ImageFilter.GaussianBlur(radius)), dtype=float) - 127.5) / 40


def floor(height: int, width: int, rng: np.random.Generator) -> np.ndarray:
    """Planks of oak across the picture, each with a tone and a grain of its own."""
    board = 14 * SCALE
    grain = rng.normal(0, 1, (height, width // 48 + 2)).repeat(48, axis=1)[:, :width]
    tone = rng.normal(0, 9, height // board + 1).repeat(board)[:height, None] + 7 * blurred(grain, 1.2)
    seam = np.minimum(np.arange(height) % board, 3)[:, None] < 1
    ends = np.zeros((height, width), dtype=bool)
    for number in range(0, height, board):
        ends[number : number + board, rng.integers(0, width, 2)] = True
    planks: np.ndarray = np.array([176.0, 146.0, 108.0]) + tone[..., None] * np.array([1.0, 0.95, 0.8])
    planks[np.broadcast_to(seam, ends.shape) | ends] *= 0.62
    return planks


def carpet_on_floor(carpet: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, tuple[int, int]]:
    """The floor from above with the carpet, its fringe and its shadow; and where the carpet's corner is."""
    high, wide = carpet.shape[:2]
    top, left = MARGIN * SCALE, MARGIN * SCALE
    ground = floor(high + 2 * top, wide + 2 * left, rng)
    shade = np.zeros(ground.shape[:2], dtype=float)
    shade[top : top + high, left : left + wide + 2] = 1
    ground *= 1 - 0.25 * blurred(shade, 2)[..., None]
    for end, outwards in ((top, -1), (top + high - 1, 1)):
        for column in range(left + 2, left + wide - 2, 8):
            length = int(FRINGE * SCALE * rng.uniform(0.75, 1.1))
            drift = np.cumsum(rng.normal(0, 0.35, length)).astype(int)
            rows = end + outwards * np.arange(length)
            for thick in (0, 1):
                ground[rows, column + drift + thick] = np.array([228, 219, 198]) * rng.uniform(0.85, 1.03)
    ground[top : top + high, left : left + wide] = carpet
    return ground, (top, left)


def photographed(chart: Chart) -> Image.Image:
    """The carpet of a chart on the floor, with light from a window on the left and a little noise."""
    rng = np.random.default_rng(1)
    size = (round(100 * chart.size.width) * SCALE, round(100 * chart.size.length) * SCALE)
    drawn = draw_carpet(chart, longest=max(size))
    pile = np.array([drawn.pile.left, drawn.pile.top, drawn.pile.width, drawn.pile.height]) * (2 * drawn.image.size)
    woven = drawn.image.crop((*pile[:2], *(pile[:2] + pile[2:]))).convert("RGB").resize(size)
    ground, (top, left) = carpet_on_floor(np.asarray(woven, dtype=float), rng)
    coefficients = perspective(corners(100 * chart.size.width, 100 * chart.size.length), *size)
    coefficients[:3] += left * np.array([*coefficients[6:], 1.0])
    coefficients[3:6] += top * np.array([*coefficients[6:], 1.0])
    coefficients[[0, 1, 3, 4, 6, 7]] /= 2
    above = Image.fromarray(ground.clip(0, 255).astype(np.uint8))
    large = above.transform(
        (2 * SHAPE[1], 2 * SHAPE[0]), Image.Transform.PERSPECTIVE, coefficients.tolist(), Image.Resampling.BILINEAR
    )
    seen = np.asarray(large.resize((SHAPE[1], SHAPE[0]), Image.Resampling.BOX), dtype=float)
    across, along = np.linspace(0, 1, SHAPE[1]), np.linspace(-1, 1, SHAPE[0])[:, None]
    light = (1.06 - 0.2 * across - 0.06 * along**2)[..., None] * np.array([1.0, 0.985, 0.95])
    return Image.fromarray((seen * light + rng.normal(0, 1.5, seen.shape)).clip(0, 255).astype(np.uint8))


def draw() -> bytes:
    """The photograph as a JPEG file."""
    chart = chart_of_recipe(read_order(EXAMPLES / "recipes" / "tabriz.toml")).chart
    room = io.BytesIO()
    photographed(chart).save(room, "JPEG", quality=72, optimize=True)
    return room.getvalue()


if __name__ == "__main__":
    FILE.write_bytes(draw())
    print([tuple(round(float(x), 1) for x in corner) for corner in corners(140, 200)])
    print(f"{FILE.name}: {FILE.stat().st_size / 1e3:.0f} kB")
