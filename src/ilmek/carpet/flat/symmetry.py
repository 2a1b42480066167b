"""Symmetry: whether a drawing is its own mirror image, up to the grain.

Labels that differ from their mirror image are due to grain if they are few beside the pixels on edges, and nowhere fill
a square of 0.6 knot (at least 3 pixels). Such a drawing is made exactly symmetric: pixels that mirror each other take the
label, among theirs, that is nearest to their mean colour.
"""

import numpy as np

from ilmek.arrays import IntArray, Rgb, UInt8
from ilmek.carpet.design import bands
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress

_SLICE = 1 << 22
_MOST = 0.5
"""Largest number of differing pixels, as a share of the pixels on edges."""


@compiled
def _differing(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"], first: int, stop: int, across: bool, above: IntArray, most: int
) -> tuple[int, int, int]:
    """Differing pixels, pixels on edges, and whether a square of side `most` differs, in some rows."""
    height, width = labels.shape
    differing = edges = solid = 0
    for y in range(first, stop):
        corner = 0
        left = 0
        opposite = y if across else height - 1 - y
        for x in range(width):
            own = labels[y, x]
            if (x > 0 and labels[y, x - 1] != own) or (y > 0 and labels[y - 1, x] != own):
                edges += 1
            side = 0
            if labels[opposite, width - 1 - x if across else x] != own:
                differing += 1
                side = 1 + min(corner, left, above[x])
                if side >= most:
                    solid = 1
            corner, left, above[x] = above[x], side, side
    return differing, edges, solid


def is_symmetric(
    labels: UInt8[np.ndarray, "height width"], across: bool, knot: float, progress: Progress = SILENT
) -> bool:
    """Whether the left half mirrors the right (`across`), or the upper half the lower, up to the grain.

    knot  least side of a knot in pixels
    """
    height, width = labels.shape
    above = np.zeros(width, dtype=np.int64)
    most = max(3, round(0.6 * knot))
    differing = edges = 0
    for band in bands(height, width, _SLICE):
        one, two, solid = _differing(labels, band.start, band.stop, across, above, most)
        differing, edges = differing + one, edges + two
        progress(band.stop / height)
        if solid or differing > _MOST * edges + 0.01 * height * width:
            return False
    return differing <= _MOST * edges


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
                total[channel] = np.int64(rgb[y, x, channel]) + np.int64(rgb[y, far, channel])
                total[channel] += np.int64(rgb[low, x, channel]) + np.int64(rgb[low, far, channel])
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
