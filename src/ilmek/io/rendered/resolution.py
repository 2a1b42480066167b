"""Resolution: the pixels with which a drawing is rendered, and these as a PNG file.

A drawing has no pixels of its own. It is rendered with at least `PIXELS` on each side of a knot, also where the carpet
shows only a part of it, so that a true colour of each knot is seen.
"""

import io
import math
from dataclasses import dataclass

import numpy as np
from PIL import Image

from ilmek.arrays import UInt8

PIXELS = 4
"""Pixels on a side of a knot."""

LARGEST = 40_000_000
"""Largest number of pixels that are rendered."""

USUAL = (450, 300)
"""Rows and columns of knots for which a drawing is rendered where they are not known."""


@dataclass(frozen=True, slots=True)
class Rendering:
    """How a drawing is rendered: the page of a file of several, from 1; rows and columns of the knots."""

    page: int = 1
    knots: tuple[int, int] = USUAL


def scale_for(width: float, height: float, knots: tuple[int, int]) -> float:
    """Pixels for a unit of a drawing, whose smaller overhang the carpet may cut off.

    >>> scale_for(100, 150, (450, 300))
    12.0
    """
    wanted = PIXELS * max(knots[0] / height, knots[1] / width)
    return min(wanted, math.sqrt(LARGEST / (width * height)))


def png_bytes(pixels: UInt8[np.ndarray, "rows columns channels"]) -> bytes:
    """A PNG file of pixels, hardly compressed."""
    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels)).save(file, "PNG", compress_level=1)
    return file.getvalue()
