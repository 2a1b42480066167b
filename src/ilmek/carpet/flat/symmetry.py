"""Symmetry: whether a drawing is its own mirror image, up to the grain.

Labels that differ from their mirror image are due to grain if they are few beside the pixels on edges, if their colours
are alike, and if they nowhere fill a square of 0.6 knot (at least 3 pixels). Such a drawing is made exactly symmetric:
pixels that mirror each other take the label, among theirs, that is nearest to their mean colour.
"""

import numpy as np

from ilmek.arrays import IntArray, Rgb, UInt8
from ilmek.carpet.design import bands
from ilmek.num.compiled import compiled, uncounted
from ilmek.progress import SILENT, Progress

_SLICE = 1 << 22
_MOST, _UNLIKE = 0.5, 0.1
"""Largest numbers of pixels with another label, and with another colour, as shares of the pixels on edges."""

_CONTRAST = 48
"""Contrast in codes, beside the noise, of another colour."""


@uncounted
def _differing(  # noqa: PLR0917
    rgb: Rgb,
    labels: UInt8[np.ndarray, "h w"],
    first: int,
    stop: int,
    across: bool,
    above: IntArray,
    most: int,
    grain: int,
) -> tuple[int, int, int, int]:
    """Pixels with another label, those of another colour, edges, and whether a square of side `most` differs."""
    height, width = labels.shape
    differing = unlike = edges = solid = 0
    for y in range(first, stop):
        corner = 0
        left = 0
        opposite = y if across else height - 1 - y
        for x in range(width):
            own = labels[y, x]
            if (x > 0 and labels[y, x - 1] != own) or (y > 0 and labels[y - 1, x] != own):
                edges += 1
            side = 0
            far = width - 1 - x if across else x
            if labels[opposite, far] != own:
                differing += 1
                contrast = 0
                for channel in range(3):
                    contrast = max(
                        contrast, abs(int(np.int64(rgb[y, x, channel])) - int(np.int64(rgb[opposite, far, channel])))
                    )
                unlike += contrast > grain
                side = 1 + min(corner, left, above[x])
                if side >= most:
                    solid = 1
            corner, left, above[x] = above[x], side, side
    return differing, unlike, edges, solid


def is_symmetric(  # noqa: PLR0917
    rgb: Rgb,
    labels: UInt8[np.ndarray, "height width"],
    across: bool,
    knot: float,
    noise: int,
    progress: Progress = SILENT,
) -> bool:
    """Whether the left half mirrors the right (`across`), or the upper half the lower, up to the grain.

    knot  least side of a knot in pixels      noise  range of a channel over 3 × 3 pixels in areas
    """
    height, width = labels.shape
    above = np.zeros(width, dtype=np.int64)
    most = max(3, round(0.6 * knot))
    total = np.zeros(4, dtype=np.int64)
    for band in bands(height, width, _SLICE):
        total += _differing(rgb, labels, band.start, band.stop, across, above, most, _CONTRAST + noise)
        progress(band.stop / height)
        if total[3]:
            return False
    differing, unlike, edges, _ = total.tolist()
    return bool(differing <= _MOST * edges and unlike <= _UNLIKE * edges)


@compiled
def _join(  # noqa: PLR0917
    rgb: Rgb, labels: UInt8[np.ndarray, "h w"], colours: IntArray, across: bool, down: bool, first: int, stop: int
) -> None:
    height, width = labels.shape
    total = np.zeros(3, dtype=np.int64)
    for y in range(first, stop):
        low = height - 1 - y if down else y
        for x in range((width + 1) // 2 if across else width):
            far = width - 1 - x if across else x
            own = labels[y, x]
            if labels[y, far] == own and labels[low, x] == own and labels[low, far] == own:
                continue
            for channel in range(3):
                total[channel] = int(np.int64(rgb[y, x, channel])) + int(np.int64(rgb[y, far, channel]))
                total[channel] += int(np.int64(rgb[low, x, channel])) + int(np.int64(rgb[low, far, channel]))
            best, least = 255, 1 << 60
            for label in (own, labels[y, far], labels[low, x], labels[low, far]):
                apart = 0
                for channel in range(3):
                    apart += (total[channel] - 4 * colours[label, channel]) ** 2
                if apart < least or (apart == least and label < best):
                    best, least = int(label), apart
            labels[y, x] = labels[y, far] = labels[low, x] = labels[low, far] = best


def make_symmetric(
    rgb: Rgb, labels: UInt8[np.ndarray, "height width"], srgb: UInt8[np.ndarray, "colours 3"], across: bool, down: bool
) -> None:
    """The labels made symmetric, in their array."""
    height, width = labels.shape
    for band in bands((height + 1) // 2 if down else height, width, _SLICE):
        _join(rgb, labels, srgb.astype(np.int64), across, down, band.start, band.stop)
