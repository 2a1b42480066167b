"""Quality of a JPEG file, from its quantisation table of luma."""

from typing import Any

import numpy as np
from PIL import Image

from ilmek.arrays import IntArray

LEAST_QUALITY = 70
"""Quality below which lines of one knot break, with 2.7 pixels a knot: 24 rays are 1 piece at 75, more at 60."""

_STANDARD = (
    16, 11, 10, 16, 24, 40, 51, 61, 12, 12, 14, 19, 26, 58, 60, 55, 14, 13, 16, 24, 40, 57, 69, 56, 14, 17, 22, 29,
    51, 87, 80, 62, 18, 22, 37, 56, 68, 109, 103, 77, 24, 35, 55, 64, 81, 104, 113, 92, 49, 64, 78, 87, 103, 121, 120,
    101, 72, 92, 95, 98, 112, 100, 103, 99,
)  # fmt: skip
"""Quantisation of luma at quality 50 (ITU-T T.81, 1992, table K.1)."""


def _totals() -> IntArray:
    """Sums of the tables of the qualities 1 to 100, as libjpeg scales them (`jpeg_quality_scaling`)."""
    quality = np.arange(1, 101)
    scale = np.where(quality < 50, 5000 // quality, 200 - 2 * quality)
    return np.asarray(np.clip((np.outer(scale, _STANDARD) + 50) // 100, 1, 255).sum(axis=1))


_TOTALS = _totals()


def jpeg_quality(table: tuple[int, ...] | list[int]) -> int:
    """The quality, 1 to 100, whose quantisation of luma has the sum of a table of 64 steps, or the nearest sum.

    >>> jpeg_quality(_STANDARD)
    50
    """
    return 1 + int(np.abs(_TOTALS - sum(table)).argmin())


def jpeg_loss(opened: Image.Image) -> tuple[str, ...]:
    """A note on a JPEG file of a quality below LEAST_QUALITY."""
    tables: Any = getattr(opened, "quantization", None)
    if opened.format not in ("JPEG", "MPO") or not tables:
        return ()
    quality = jpeg_quality(tables[min(tables)])
    if quality >= LEAST_QUALITY:
        return ()
    return (f"a JPEG of quality {quality}, which may break thin lines: a PNG, or quality 75 or more, keeps them",)
