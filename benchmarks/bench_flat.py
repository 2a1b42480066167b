"""Drawings to knots: the flat reading beside Pillow (nearest), scikit-image (anti-aliased resize) and a majority vote.

Two pictures: the medallion of the examples, 1200 × 1800 pixels with grain onto 300 × 450 knots, and lines of 0.7 knot
at twelve angles, 4 pixels a knot, anti-aliased. Each method ends in the sixteen wools. Foreign: knots whose yarn is
the nearest of no pixel of their cell. Patches: 8-connected, at most 3 knots. Broken: lines that are lost or in more
than one piece. The last two rows are the speed for large charts.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image
from scipy import ndimage
from skimage.transform import resize

from benchmarks.bench_chart import best_of, medallion, wool
from ilmek.arrays import Indices, Rgb
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.flat import flat_design
from ilmek.carpet.palette import distinct_colours, nearest_yarns, paint
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import ReadParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import yarn_labs

Grid = tuple[int, int]
IVORY, NAVY = (235, 223, 195), (31, 49, 87)
EIGHT = np.ones((3, 3), dtype=int)
LABS = yarn_labs(wool())


def in_yarns(rgb: Rgb) -> Indices:
    """The nearest yarn of each colour."""
    distinct = distinct_colours(rgb)
    return paint(rgb, distinct, nearest_yarns(distinct, LABS)[0])


def flat(rgb: Rgb, grid: Grid) -> Indices:
    """The flat reading."""
    return in_yarns(flat_design(rgb, grid).colours)


def pillow(rgb: Rgb, grid: Grid) -> Indices:
    """Pillow's nearest pixel."""
    return in_yarns(np.asarray(Image.fromarray(rgb).resize(grid[::-1], Image.Resampling.NEAREST)))


def skimage(rgb: Rgb, grid: Grid) -> Indices:
    """scikit-image's resize with anti-aliasing."""
    smooth = resize(rgb, grid, anti_aliasing=True)  # type: ignore[no-untyped-call]
    return in_yarns(np.rint(255 * smooth).astype(np.uint8))


def majority(rgb: Rgb, grid: Grid) -> Indices:
    """The most frequent yarn of the pixels of each cell, for a whole number of pixels a knot."""
    cells = cells_of(in_yarns(rgb), grid)
    votes = np.stack([np.count_nonzero(cells == yarn, axis=-1) for yarn in range(len(LABS))])
    return np.asarray(votes.argmax(axis=0), dtype=np.uint8)


def cells_of(pixels: Indices, grid: Grid) -> np.ndarray:
    """The pixels of each cell, (rows, columns, pixels)."""
    rows, columns = grid
    parts = pixels.reshape(rows, len(pixels) // rows, columns, -1).swapaxes(1, 2)
    return np.asarray(parts.reshape(rows, columns, -1))


def patches(knots: Indices) -> int:
    """Number of patches of at most 3 knots."""
    sizes = [np.bincount(ndimage.label(knots == yarn, EIGHT)[0].ravel())[1:] for yarn in np.unique(knots)]
    return int(np.count_nonzero(np.concatenate(sizes) <= 3))


def line(degrees: float) -> Rgb:
    """An anti-aliased navy line of 0.7 knot through 40 × 40 knots, 4 pixels a knot."""
    axis = (np.arange(640) + 0.5) / 16 - 20
    along, across = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    cover = np.abs(across * axis[None] - along * axis[:, None] + 0.3) < 0.35
    share = cover.reshape(160, 4, 160, 4).mean(axis=(1, 3))[..., None]
    return np.asarray(np.rint(np.array(IVORY) * (1 - share) + np.array(NAVY) * share), dtype=np.uint8)


def broken(method: Callable[[Rgb, Grid], Indices]) -> int:
    """Lines, of twelve, that are lost or in more than one piece."""
    ground = in_yarns(np.array([[IVORY]], dtype=np.uint8))[0, 0]
    masks = [method(line(angle), (40, 40)) != ground for angle in np.arange(3.0, 180.0, 15.0)]
    return sum(ndimage.label(mask, EIGHT)[1] != 1 or max(mask.any(0).sum(), mask.any(1).sum()) < 38 for mask in masks)


def whole_chart(width: int, height: int) -> float:
    """Seconds to the chart of a picture with one pixel a knot, read as a drawing."""
    picture, size = medallion(width, height), CarpetSize(width / 1000, height / 1000)
    reading = ReadParams(reading="flat")
    return best_of(3, lambda: make_chart(picture, size, Quality(1000.0, 1000.0), wool(), reading=reading).knots)[0]


def run() -> None:
    """Print the table."""
    rgb = np.asarray(Image.open(Path(__file__).parents[1] / "examples" / "medallion.png").convert("RGB"))
    grid = (450, 300)
    cells = cells_of(in_yarns(rgb), grid)
    methods = {
        "ilmek, flat": flat,
        "Pillow, nearest": pillow,
        "scikit-image, anti-aliased": skimage,
        "majority": majority,
    }
    print(f"{'method':<30} {'s':>7} {'foreign':>8} {'patches':>8} {'mirror':>7} {'broken lines':>13}")
    for name, method in methods.items():
        method(rgb[:40, :40], (10, 10))  # compiles the kernels
        seconds, knots = best_of(3, lambda method=method: method(rgb, grid))  # type: ignore[misc]
        foreign = int(np.count_nonzero(~np.any(cells == knots[..., None], axis=-1)))
        unlike = int(np.count_nonzero(knots != knots[:, ::-1]))
        print(f"{name:<30} {seconds:7.2f} {foreign:8d} {patches(knots):8d} {unlike:7d} {broken(method):10d}/12")
    for width, height in ((1000, 1500), (2400, 3600)):
        print(f"chart of {width} × {height} knots, read flat: {whole_chart(width, height):.2f} s")


if __name__ == "__main__":
    run()
