"""Labels: the true colour of each pixel.

A pixel has the nearest true colour (CIELAB). On an edge that is not sharp, mixtures may be near to a third colour: a
band of at most three pixels between two colours, whose colour lies on the segment between both and changes across the
band, belongs to the nearer of the two. A line with one colour on both sides stays, and a wider one of an even colour.
A single pixel unlike all its neighbours, and between them in colour, takes the nearest colour among theirs.
"""

import numpy as np

from ilmek.arrays import IntArray, Rgb, UInt8
from ilmek.carpet.design import bands
from ilmek.carpet.flat.nearest import UNKNOWN, label_rows
from ilmek.carpet.flat.true_colours import TrueColours
from ilmek.num.compiled import uncounted
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress

_WIDEST = 3
_SLICE = 1 << 18


@uncounted
def _mixed_share(  # noqa: PLR0917
    rgb: Rgb, y: int, x: int, one: IntArray, two: IntArray, slack: int
) -> float:
    """Position of a pixel's colour from `one` (0) to `two` (1); negative where it is no mixture of both."""
    along = offset = length = 0
    for channel in range(3):
        far = int(np.int64(two[channel])) - int(np.int64(one[channel]))
        here = int(np.int64(rgb[y, x, channel])) - int(np.int64(one[channel]))
        along += here * far
        offset += here * here
        length += far * far
    if along <= 0 or along >= length:
        return -1.0
    off = offset - along * along / length
    return along / length if off <= max(slack * slack, 0.09 * length) else -1.0


@uncounted
def _reach(labels: UInt8[np.ndarray, "h w"], y: int, x: int, down: int, right: int) -> int:
    """Pixels to the first other label in a direction; 0: none within a band, or the border."""
    height, width = labels.shape
    for far in range(1, _WIDEST + 1):
        v, u = y + far * down, x + far * right
        if v < 0 or u < 0 or v >= height or u >= width:
            return 0
        if labels[v, u] != labels[y, x]:
            return far
    return 0


@uncounted
def _across(  # noqa: PLR0917
    rgb: Rgb, labels: UInt8[np.ndarray, "h w"], colours: IntArray, y: int, x: int, down: int, right: int, slack: int
) -> int:
    """The label that a mixture takes by the two sides of one direction; UNKNOWN where it is none."""
    before, after = _reach(labels, y, x, -down, -right), _reach(labels, y, x, down, right)
    if before == 0 or after == 0 or before + after - 1 > _WIDEST:
        return UNKNOWN
    one = labels[y - before * down, x - before * right]
    two = labels[y + after * down, x + after * right]
    share = _mixed_share(rgb, y, x, colours[one], colours[two], slack)
    if one == two or share < 0.0:
        return UNKNOWN
    if before + after > 2:  # a band of even colour is a line
        begin = _mixed_share(rgb, y - (before - 1) * down, x - (before - 1) * right, colours[one], colours[two], slack)
        end = _mixed_share(rgb, y + (after - 1) * down, x + (after - 1) * right, colours[one], colours[two], slack)
        if begin < 0.0 or end < 0.0 or end - begin < 0.2:
            return UNKNOWN
    nearer = one if share < 0.5 else two
    return int(min(one, two) if share == 0.5 else nearer)


@uncounted
def _alone(rgb: Rgb, labels: UInt8[np.ndarray, "h w"], colours: IntArray, y: int, x: int) -> int:
    """The label of a pixel unlike all its neighbours: its own where it is a dot, else the nearest of theirs."""
    height, width = labels.shape
    own = labels[y, x]
    for v in range(max(y - 1, 0), min(y + 2, height)):
        for u in range(max(x - 1, 0), min(x + 2, width)):
            if labels[v, u] == own and (v != y or u != x):
                return int(own)
    best, least = int(own), 1 << 30
    dot = True
    for down in range(-1, 2):
        for right in range(-1, 2):
            v, u = y + down, x + right
            if (down == 0 and right == 0) or v < 0 or u < 0 or v >= height or u >= width:
                continue
            label = labels[v, u]
            apart = product = 0
            opposite = 0 <= y - down < height and 0 <= x - right < width
            for channel in range(3):
                apart += (int(np.int64(rgb[y, x, channel])) - int(np.int64(colours[label, channel]))) ** 2
                if opposite:
                    product += (int(np.int64(rgb[y, x, channel])) - int(np.int64(rgb[v, u, channel]))) * (
                        int(np.int64(rgb[y, x, channel])) - int(np.int64(rgb[y - down, x - right, channel]))
                    )
            dot = dot and (product > 0 or not opposite)
            if apart < least or (apart == least and label < best):
                best, least = int(label), apart
    return int(own) if dot and least > 3 * 24 * 24 else best


@uncounted
def _clean(  # noqa: PLR0917
    rgb: Rgb,
    labels: UInt8[np.ndarray, "h w"],
    colours: IntArray,
    slack: int,
    join_lone: bool,
    first: int,
    out: UInt8[np.ndarray, "n w"],
) -> None:
    height, width = labels.shape
    for row in range(out.shape[0]):
        y = first + row
        up, low = max(y - 1, 0), min(y + 1, height - 1)
        for x in range(width):
            own = labels[y, x]
            out[row, x] = own
            left, far = max(x - 1, 0), min(x + 1, width - 1)
            if (
                labels[y, left] == own
                and labels[y, far] == own
                and labels[up, x] == own
                and labels[low, x] == own
                and labels[up, left] == own
                and labels[up, far] == own
                and labels[low, left] == own
                and labels[low, far] == own
            ):
                continue
            label = min(
                _across(rgb, labels, colours, y, x, 0, 1, slack), _across(rgb, labels, colours, y, x, 1, 0, slack)
            )
            if label == UNKNOWN:
                falling = _across(rgb, labels, colours, y, x, 1, 1, slack)
                label = min(falling, _across(rgb, labels, colours, y, x, 1, -1, slack))
            if label != UNKNOWN:
                out[row, x] = label
            elif join_lone:
                out[row, x] = _alone(rgb, labels, colours, y, x)


def label_pixels(
    rgb: Rgb, true: TrueColours, table: UInt8[np.ndarray, " codes"], join_lone: bool, progress: Progress = SILENT
) -> UInt8[np.ndarray, "height width"]:
    """Index of the true colour of each pixel; `join_lone`: single pixels that are no dots take a neighbour's."""
    height, width = rgb.shape[:2]
    labels = np.empty((height, width), dtype=np.uint8)

    def label(band: slice) -> None:  # threads may find the same code, and write the same label into the table
        label_rows(rgb[band], table, true.labs, labels[band])

    for band, _ in in_threads(label, bands(height, width, _SLICE)):
        progress(0.5 * band.stop / height)
    if not true.mixed:
        return labels
    cleaned = np.empty_like(labels)
    colours = true.srgb.astype(np.int64)

    def clean(band: slice) -> None:
        _clean(rgb, labels, colours, 10 + true.noise, join_lone, band.start, cleaned[band])

    for band, _ in in_threads(clean, bands(height, width, _SLICE)):
        progress(0.5 + 0.5 * band.stop / height)
    return cleaned
