"""Design: one colour per knot from a picture.

Each knot covers a rectangle of the picture. Its colour is the mean of the linear light over the rectangle (a box
filter: exact, separable, for any ratio), rounded to sRGB codes. The design fills the carpet: where the proportions of
picture and carpet differ, the picture is stretched by `distortion`.

Knots are not square where the quality differs across and along; the grid accounts for that.
"""

from collections.abc import Callable, Iterator

import numpy as np

from ilmek.arrays import Rgb, UInt8
from ilmek.carpet.colour import LINEAR, decode
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import CarpetError
from ilmek.num.compiled import compiled
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence

MOST_KNOTS = 200_000_000
"""Largest number of knots: 32 m² of 250 x 250 knots per dm². With a picture of 150 megapixels `weave` takes 70 s and
1.2 GB, of random colours 4 min and 1.7 GB.
"""

LARGEST_DISTORTION = 0.02
"""Largest distortion that is not noticeable; above it a job should warn."""

_BAND = 128
_SLICE = 1 << 22
"""Pixels or knots of one call of a kernel: about 0.1 s, in which an interrupt waits."""

PART = 1 << 20
"""Knots of one call of a kernel where several threads call it."""

_STEPS = 4096

# Linear light above which the next code is nearer, and the code at each of _STEPS even steps of light.
_THRESHOLDS = np.append(decode((np.arange(255) + 0.5) / 255), np.inf)
_GUESSES = np.searchsorted(_THRESHOLDS, np.arange(_STEPS + 1) / _STEPS).astype(np.int64)


def knot_grid(size: CarpetSize, quality: Quality) -> tuple[int, int]:
    """(rows, columns) of knots: length × along and width × across, each rounded.

    Raises CarpetError for less than two knots per side or more than MOST_KNOTS.

    >>> knot_grid(CarpetSize(1.2, 1.8), Quality(250.0, 250.0))
    (450, 300)
    """
    rows, columns = round(size.length * quality.along), round(size.width * quality.across)
    if min(rows, columns) < 2:
        raise CarpetError(
            Sentence("grid.knots", size=size, quality=quality, columns=columns, rows=rows),
            allowed=Sentence("grid.least"),
            do=Sentence("grid.larger"),
        )
    if rows * columns > MOST_KNOTS:
        raise CarpetError(
            Sentence("grid.millions", size=size, quality=quality, count=f"{rows * columns / 1e6:.0f}"),
            allowed=Sentence("grid.most", count=MOST_KNOTS // 1_000_000),
            do=Sentence("grid.smaller"),
        )
    return rows, columns


def require_grid(knots: UInt8[np.ndarray, "rows columns"], size: CarpetSize, quality: Quality) -> None:
    """Raise CarpetError unless the knots are those of a carpet of this size and quality."""
    grid = knot_grid(size, quality)
    if knots.shape != grid:
        raise CarpetError(
            f"knots of the shape {knots.shape}",
            allowed=f"{grid}, rows and columns of {size} at {quality}",
            do="give the size and quality that these knots have",
        )


def distortion(rgb: Rgb, size: CarpetSize) -> float:
    """Relative stretch of the picture's width against its height [-]; negative where it is compressed.

    >>> round(distortion(np.zeros((180, 100, 3), np.uint8), CarpetSize(1.2, 1.8)), 9)
    0.2
    """
    height, width = int(rgb.shape[0]), int(rgb.shape[1])
    return (size.width / size.length) / (width / height) - 1


@compiled
def encoded(light: float) -> int:
    """The sRGB code nearest to a linear light (0 to 1), by the encoded value."""
    code: int = _GUESSES[int(min(max(light, 0.0), 1.0) * _STEPS)]
    while light > _THRESHOLDS[code]:
        code += 1
    return code


def bands(rows: int, columns: int, most: int = _SLICE) -> Iterator[slice]:
    """Slices of the rows of a picture or chart, of at most `most` pixels each and at least one row.

    >>> [(band.start, band.stop) for band in bands(5, 10, 20)]
    [(0, 2), (2, 4), (4, 5)]
    """
    step = max(1, most // columns)
    return (slice(first, min(first + step, rows)) for first in range(0, rows, step))


@compiled
def _resample(rgb: Rgb, out: Rgb, first: int, rows: int, top: int, height: int) -> None:  # noqa: PLR0917
    # In units of 1/rows (1/columns) of a pixel, pixels and knots begin and end at integers: the shares are exact.
    width = rgb.shape[1]
    columns = out.shape[1]
    line = np.empty((width, 3))
    for row in range(out.shape[0]):
        line[:] = 0.0
        start, end = (first + row) * height, (first + row + 1) * height
        for y in range(start // rows, (end - 1) // rows + 1):
            share = (min(end, (y + 1) * rows) - max(start, y * rows)) / height
            for x in range(width):
                for channel in range(3):
                    line[x, channel] += share * LINEAR[rgb[y - top, x, channel]]
        for column in range(columns):
            left, right = column * width, (column + 1) * width
            red, green, blue = 0.0, 0.0, 0.0
            for x in range(left // columns, (right - 1) // columns + 1):
                share = (min(right, (x + 1) * columns) - max(left, x * columns)) / width
                red += share * line[x, 0]
                green += share * line[x, 1]
                blue += share * line[x, 2]
            out[row, column, 0] = encoded(red)
            out[row, column, 1] = encoded(green)
            out[row, column, 2] = encoded(blue)


def resampled(rgb: Rgb, rows: int, columns: int, progress: Progress = SILENT) -> UInt8[np.ndarray, "rows columns 3"]:
    """The picture on a grid of rows × columns by box averages in linear light; unchanged if it has that grid."""
    if rgb.shape[:2] == (rows, columns):
        return np.ascontiguousarray(rgb)
    height, width = int(rgb.shape[0]), int(rgb.shape[1])
    return resampled_rows(lambda part: rgb[part], (height, width), (rows, columns), progress)


def resampled_rows(
    source: Callable[[slice], Rgb], size: tuple[int, int], grid: tuple[int, int], progress: Progress = SILENT
) -> UInt8[np.ndarray, "rows columns 3"]:
    """As `resampled`, of a picture that is made in parts.

    source  the picture's rows in a slice; several threads call it
    size    its height and width      grid  rows and columns of the result
    """
    (height, width), (rows, columns) = size, grid
    out = np.empty((rows, columns, 3), dtype=np.uint8)
    step = min(_BAND, max(1, _SLICE // (width * -(-height // rows) + columns)))

    def average(first: int) -> None:
        band = out[first : first + step]
        top, bottom = first * height // rows, -(-(first + len(band)) * height // rows)
        _resample(np.ascontiguousarray(source(slice(top, bottom))), band, first, rows, top, height)

    for first, _ in in_threads(average, range(0, rows, step)):
        progress(min(first + step, rows) / rows)
    return out


def resampled_band(rgb: Rgb, grid: tuple[int, int], band: slice) -> UInt8[np.ndarray, "rows columns 3"]:
    """The rows of a band of `resampled` alone."""
    height, (rows, columns) = int(rgb.shape[0]), grid
    out = np.empty((band.stop - band.start, columns, 3), dtype=np.uint8)
    top, bottom = band.start * height // rows, -(-band.stop * height // rows)
    _resample(np.ascontiguousarray(rgb[top:bottom]), out, band.start, rows, top, height)
    return out
