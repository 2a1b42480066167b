"""Pictures of pages, kept small and compared with a tolerance.

A picture is kept at half its size with a palette. Two pictures are compared by their cells of 10 px of the page: by
mean colour, which shows where something stands, and by contrast, which shows letters and lines whatever their form. A
cell counts where the other picture has none like it nearby: other letters and moved lines are allowed, and a missing
part is found.
"""

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

SCALE = 2
COLOURS = 64
CELL = 5
"""Side of a cell [px of the kept picture]."""
REACH = 3
"""How far a cell may have moved [cells]."""
MEAN = 14.0
"""Allowed difference of mean colours [levels of 255]."""
CONTRAST = 20.0
"""Allowed difference of standard deviations [levels of 255]."""
SHARE = 0.025
"""Allowed share of cells that have none like them in the other picture.

Measured on the seven views: 0 to 1.3 % for the same page again, up to 2 % with another font without serifs, and more
where a part of 5 % of the window is missing.
"""


def halved(screenshot: bytes) -> Image.Image:
    """A screenshot as it is kept, without the palette."""
    return Image.open(io.BytesIO(screenshot)).convert("RGB").reduce(SCALE)


def keep(screenshot: bytes, path: Path) -> None:
    """Write a screenshot as reference."""
    path.parent.mkdir(exist_ok=True)
    picture = halved(screenshot).quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    picture.save(path, optimize=True)


def difference(screenshot: bytes, path: Path) -> float:
    """Share of the cells that have none like them near their position, in the picture that has more of them.

    1 where the sizes differ.
    """
    taken, kept = _cells(halved(screenshot)), _cells(Image.open(path).convert("RGB"))
    if taken.shape != kept.shape:
        return 1.0
    return float(max(_unmatched(taken, kept), _unmatched(kept, taken)))


def _cells(picture: Image.Image) -> NDArray[np.float64]:
    """For each cell its mean colour and its standard deviation, in units of what is allowed; a cut cell is dropped."""
    pixels = np.asarray(picture, dtype=float)
    rows, columns = pixels.shape[0] // CELL, pixels.shape[1] // CELL
    whole = pixels[: rows * CELL, : columns * CELL].reshape(rows, CELL, columns, CELL, 3)
    return np.concatenate([whole.mean(axis=(1, 3)) / MEAN, whole.std(axis=(1, 3)) / CONTRAST], axis=-1)


def _unmatched(cells: NDArray[np.float64], others: NDArray[np.float64]) -> float:
    """Share of the cells without one like them among the others near their position."""
    rows, columns, _ = cells.shape
    around = np.pad(others, ((REACH, REACH), (REACH, REACH), (0, 0)), mode="edge")
    shifts = [(down, right) for down in range(2 * REACH + 1) for right in range(2 * REACH + 1)]
    found = [np.abs(cells - around[down:, right:][:rows, :columns]).max(axis=-1) <= 1 for down, right in shifts]
    return 1 - float(np.any(found, axis=0).mean())
