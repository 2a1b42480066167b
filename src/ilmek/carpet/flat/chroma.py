"""Chroma: that of a JPEG which halves it, carried by its luma again.

Most JPEG files keep one sample of chroma for 2 × 1 or 2 × 2 pixels (4:2:2, 4:2:0; ITU-T T.81, 1992, annex A.1.1). A
decoder interpolates between the samples with the weights 3/4 and 1/4: a thin line keeps its luma, and has the chroma of
its ground. Where two colours meet, chroma is linear in luma. Its slope a against the luma y*, y averaged over the
samples and interpolated, tells the chroma of each pixel (He, Sun, Tang, Guided image filtering, 2013):

    c' = (1 - w) (c + g a (y - y*)) + w (mean c + g a (y - mean y*)),   a = cov(y*, c) / (var y* + e)

All moments are those of a square of SIDE × SIDE pixels. The share r² of the variance of the chroma that the line
explains, and what is off the line, say how far two colours are all that the square has: g, 0 to 1, how far the slope
counts; w, 0 to 1, how far what is off the line is the residue of the compression. An even area stays as it is.

Halved chroma shows in the pixels: through the two pixels of a sample and those beside them, interpolated chroma is
a, b, c, d with a - 3b + 3c - d = 0, whatever the samples. The third difference of the luma does not vanish there.
"""

import math

import numpy as np

from ilmek.arrays import Int64, IntArray, Rgb, UInt8
from ilmek.carpet.design import bands
from ilmek.carpet.flat.survey import sample_positions
from ilmek.num.compiled import compiled, uncounted
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress

SIDE = 7
"""Side of the square of the moments [pixels]."""

_RADIUS = SIDE // 2
_RED, _GREEN, _BLUE = 299, 587, 114
_UNIT = 1000
"""Luma in units of 1/1000 code (ITU-R BT.601); the two chromas are blue and red less luma, in the same unit."""

_ALONG = 8
"""What interpolation along one axis multiplies: two pixels a sample, weights 3 and 1."""

_LEAST_VARIANCE, _LEAST_CHROMA = 4 * (_ALONG * _ALONG * _UNIT) ** 2, 4 * _UNIT**2
"""e: square of the grain of luma, 2 codes; that of chroma."""

_NO_SLOPE, _FULL_SLOPE, _NO_LINE, _ON_LINE = 0.2, 0.6, 0.75, 0.95
"""r² from which the slope counts, and counts fully; from which the residue goes, and goes wholly."""

_TWO_COLOURS, _THREE_COLOURS = 13 * _UNIT, 24 * _UNIT
"""Root mean square of the chroma off the line up to which two colours meet, and from which three do: the median is 8 on
lines of two colours at quality 75, and 22 on those between two others. All are chosen on the drawings of the tests."""

_CLEAR, _TO_CB, _TO_CR = 6 * _UNIT * 1000, 564, 713
"""Third difference that is not rounding; factors from blue and red less luma to chroma, in 1/1000."""

_LEAST_CLEAR, _VANISHING, _LIKELY, _OF_LUMA = 16, 0.15, 0.5, 0.5
"""Clear third differences that show something. Largest share of those through samples beside the others, of an axis by
itself and of one beside another; least share for luma."""

_LINES = 400
"""Lines of the picture in which third differences are counted, about."""

_SLICE = 1 << 18
NOT_HALVED = -1


@uncounted
def _luma(rgb: Rgb, y: int, x: int) -> int:
    red, green, blue = int(np.int64(rgb[y, x, 0])), int(np.int64(rgb[y, x, 1])), int(np.int64(rgb[y, x, 2]))
    return _RED * red + _GREEN * green + _BLUE * blue


@uncounted
def _count_clear(rgb: Rgb, lines: IntArray, across: bool, counts: Int64[np.ndarray, "2 2"]) -> None:
    """Clear third differences of chroma and of luma by the parity of the second pixel; clipped pixels do not count."""
    length = rgb.shape[1] if across else rgb.shape[0]
    for line in lines:
        for begin in range(length - 3):
            luma = cb = cr = 0
            clipped = False
            for step in range(4):
                weight = (1, -3, 3, -1)[step]
                y, x = (line, begin + step) if across else (begin + step, line)
                own = _luma(rgb, y, x)
                luma += weight * own
                cb += weight * (_UNIT * int(np.int64(rgb[y, x, 2])) - own)
                cr += weight * (_UNIT * int(np.int64(rgb[y, x, 0])) - own)
                for channel in range(3):
                    clipped = clipped or rgb[y, x, channel] == 0 or rgb[y, x, channel] == 255
            if not clipped:
                counts[0, (begin + 1) % 2] += max(_TO_CB * abs(cb), _TO_CR * abs(cr)) > _CLEAR
                counts[1, (begin + 1) % 2] += _UNIT * abs(luma) > _CLEAR


def halved_axes(rgb: Rgb) -> tuple[int, int]:
    """Parity of the first pixel of each chroma sample across and down; NOT_HALVED where chroma is whole.

    >>> halved_axes(np.zeros((8, 8, 3), dtype=np.uint8))
    (-1, -1)
    """
    found = [_parity(rgb, True), _parity(rgb, False)]
    clear = any(share <= _VANISHING for _, share in found)
    across, down = (parity if clear and share <= _LIKELY else NOT_HALVED for parity, share in found)
    return across, down


def _parity(rgb: Rgb, across: bool) -> tuple[int, float]:
    """The likelier parity of an axis, and the share of clear third differences through its samples."""
    counts = np.zeros((2, 2), dtype=np.int64)
    side = rgb.shape[0] if across else rgb.shape[1]
    _count_clear(rgb, sample_positions(side, max(1, side // _LINES)), across, counts)
    parity = int(np.argmin(counts[0]))
    most = int(counts[0, 1 - parity])
    if most < _LEAST_CLEAR or counts[1, parity] <= _OF_LUMA * counts[1, 1 - parity]:
        return parity, 1.0
    return parity, int(counts[0, parity]) / most


@uncounted
def _begins(position: int, parity: int, length: int) -> tuple[int, int]:
    """The first pixels of the sample of a pixel and of the next nearer one; at the border that is its own."""
    own = position - ((position - parity) & 1)
    other = own - 2 if position == own else own + 2
    return own, own if other + 1 < 0 or other >= length else other


@uncounted
def _pair(line: IntArray, begin: int) -> int:
    """Sum of a sample's two pixels; one beyond the border is that at the border."""
    return int(line[max(begin, 0)] + line[min(begin + 1, len(line) - 1)])


@uncounted
def _spread(luma: IntArray, parity: int, made: IntArray) -> None:
    """A line averaged over its samples and interpolated, _ALONG times as large."""
    for position in range(len(luma)):
        if parity == NOT_HALVED:
            made[position] = _ALONG * luma[position]
        else:
            own, other = _begins(position, parity, len(luma))
            made[position] = 3 * _pair(luma, own) + _pair(luma, other)


@compiled
def _coarse_luma(rgb: Rgb, across: int, down: int, first: int, stop: int) -> Int64[np.ndarray, "n w"]:
    """The luma of some rows at the resolution of the chroma, _ALONG² times as large."""
    height, width = rgb.shape[:2]
    top, bottom = max(first - 3, 0), min(stop + 3, height)
    spread = np.empty((bottom - top, width), dtype=np.int64)
    line = np.empty(width, dtype=np.int64)
    for y in range(top, bottom):
        for x in range(width):
            line[x] = _luma(rgb, y, x)
        _spread(line, across, spread[y - top])
    coarse = np.empty((stop - first, width), dtype=np.int64)
    for y in range(first, stop):
        if down == NOT_HALVED:
            coarse[y - first] = _ALONG * spread[y - top]
            continue
        own, other = _begins(y, down, height)
        above, below = max(own, 0), min(own + 1, height - 1)
        over, under = max(other, 0), min(other + 1, height - 1)
        coarse[y - first] = 3 * (spread[above - top] + spread[below - top]) + spread[over - top] + spread[under - top]
    return coarse


@uncounted
def _add_row(  # noqa: PLR0917
    rgb: Rgb, coarse: Int64[np.ndarray, "n w"], y: int, top: int, sign: int, sums: Int64[np.ndarray, "w 7"]
) -> None:
    """Add a row to the sums of each column: y*, y*², two chromas, their products with y*, their squares."""
    for x in range(rgb.shape[1]):
        luma, own = coarse[y - top, x], _luma(rgb, y, x)
        blue, red = _UNIT * int(np.int64(rgb[y, x, 2])) - own, _UNIT * int(np.int64(rgb[y, x, 0])) - own
        sums[x, 0] += sign * luma
        sums[x, 1] += sign * luma * luma
        sums[x, 2] += sign * blue
        sums[x, 3] += sign * red
        sums[x, 4] += sign * luma * blue
        sums[x, 5] += sign * luma * red
        sums[x, 6] += sign * (blue * blue + red * red)


@uncounted
def _code(value: float) -> int:
    return int(min(max(np.rint(value / _UNIT), 0.0), 255.0))


@compiled
def _restore(rgb: Rgb, across: int, down: int, first: int, out: Rgb) -> None:
    """The rows from `first` with the chroma that their luma tells."""
    height, width = rgb.shape[:2]
    stop = first + out.shape[0]
    top, bottom = max(first - _RADIUS, 0), min(stop + _RADIUS, height)
    coarse = _coarse_luma(rgb, across, down, top, bottom)
    sums = np.zeros((width, 7), dtype=np.int64)
    for y in range(top, min(first + _RADIUS, height)):
        _add_row(rgb, coarse, y, top, 1, sums)
    total = np.zeros(7, dtype=np.int64)
    for y in range(first, stop):
        if y + _RADIUS < height:
            _add_row(rgb, coarse, y + _RADIUS, top, 1, sums)
        if y - _RADIUS - 1 >= top:
            _add_row(rgb, coarse, y - _RADIUS - 1, top, -1, sums)
        rows = min(y + _RADIUS, height - 1) - max(y - _RADIUS, 0) + 1
        _restore_row(rgb, y, coarse[y - top], sums, rows, total, out[y - first])


@uncounted
def _restore_row(  # noqa: PLR0917
    rgb: Rgb, y: int, coarse: Int64[np.ndarray, " w"], sums: Int64[np.ndarray, "w 7"], rows: int, total: IntArray,
    made: UInt8[np.ndarray, "w 3"]
) -> None:  # fmt: skip
    """One row, from the sums of each column of `rows` rows; `total`: room for those of a square."""
    width = rgb.shape[1]
    total[:] = 0
    for x in range(min(_RADIUS, width)):
        _add(total, sums, x, 1)
    for x in range(width):
        if x + _RADIUS < width:
            _add(total, sums, x + _RADIUS, 1)
        if x > _RADIUS:
            _add(total, sums, x - _RADIUS - 1, -1)
        number = rows * (min(x + _RADIUS, width - 1) - max(x - _RADIUS, 0) + 1)
        _restore_pixel(rgb, y, x, coarse[x], total, number, made)


@uncounted
def _add(total: IntArray, sums: Int64[np.ndarray, "w 7"], x: int, sign: int) -> None:
    for moment in range(7):
        total[moment] += sign * sums[x, moment]


@uncounted
def _restore_pixel(  # noqa: PLR0917
    rgb: Rgb, y: int, x: int, coarse: int, total: IntArray, number: int, made: UInt8[np.ndarray, "w 3"]
) -> None:
    """One pixel, from the sums of its square of `number` pixels."""
    variance = number * total[1] - total[0] * total[0]
    chroma = number * total[6] - total[2] * total[2] - total[3] * total[3]
    if variance == 0 or chroma == 0:
        for channel in range(3):
            made[x, channel] = rgb[y, x, channel]
        return
    with_blue = float(number * total[4] - total[0] * total[2])
    with_red = float(number * total[5] - total[0] * total[3])
    squares = number * number
    explained = (with_blue**2 + with_red**2) / (float(variance) * (chroma + _LEAST_CHROMA * squares))
    off = math.sqrt(max(chroma - (with_blue**2 + with_red**2) / float(variance), 0.0) / squares)
    two = _rise(explained, _NO_SLOPE, _FULL_SLOPE) * (1.0 - _rise(off, _TWO_COLOURS, _THREE_COLOURS))
    slope = two / (variance + _LEAST_VARIANCE * squares)
    line = _rise(explained, _NO_LINE, _ON_LINE)
    luma, scale = _luma(rgb, y, x), _ALONG * _ALONG
    step = slope * (scale * luma - (1.0 - line) * coarse - line * total[0] / number)
    own_blue, own_red = _UNIT * int(np.int64(rgb[y, x, 2])) - luma, _UNIT * int(np.int64(rgb[y, x, 0])) - luma
    blue = luma + (1.0 - line) * own_blue + line * total[2] / number + step * with_blue
    red = luma + (1.0 - line) * own_red + line * total[3] / number + step * with_red
    green = (_UNIT * luma - _RED * red - _BLUE * blue) / _GREEN
    made[x, 0], made[x, 1], made[x, 2] = _code(red), _code(green), _code(blue)


@uncounted
def _rise(value: float, begin: float, end: float) -> float:
    """0 up to the beginning, 1 from the end, linear between them."""
    return min(max((value - begin) / (end - begin), 0.0), 1.0)


def whole_chroma(rgb: Rgb, progress: Progress = SILENT) -> Rgb:
    """A picture with the chroma that its luma tells; the same array where chroma is not halved."""
    across, down = halved_axes(rgb)
    if across == down == NOT_HALVED:
        return rgb
    height, width = rgb.shape[:2]
    made = np.empty_like(rgb)

    def restore(band: slice) -> None:
        _restore(rgb, across, down, band.start, made[band])

    for band, _ in in_threads(restore, bands(height, width, _SLICE)):
        progress(band.stop / height)
    return made
