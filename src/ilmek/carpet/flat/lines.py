"""The line rule: no line is broken, and none that is at least 0.6 knot wide is lost.

Through the centres of the knots run centre lines, one for each row and column. A run of one label along a centre line
that is shorter than 1.5 knots is where a line crosses it; the line takes the knot in which the middle of the run lies.
(Freeman's grid-intersect quantisation: the knots of a line of any angle are 8-connected.) Of several lines in one knot
that with the largest area of the cell takes it; the others take the next knot on their longer side, if it is not taken.

A tip of an area, a dent in its edge, and a run at the border of the picture are no lines.
"""

import numpy as np

from ilmek.arrays import Indices, Int64, IntArray, NumberArray, UInt8
from ilmek.carpet.design import bands
from ilmek.carpet.flat.areas import NONE, area_share, take_knot
from ilmek.num.compiled import uncounted
from ilmek.progress import Progress

_SLICE = 1 << 21
_LEAST_WIDTH, _LONGEST_RUN = 0.6, 1.5
"""Least width of a line and longest run across one, in knots; a run of pixels may be one pixel shorter."""

_TIP = 0.35
"""Length, in knots, over which a run must go on."""

_LEAST_SHARE, _LEAST_PART = 0.2, 0.4
"""Least share of a cell that a line has, or part of the run across it."""


@uncounted
def _least_share(run: int, length: int) -> float:
    """Least share of a cell that a run must have; `run` and `length` in the same units, `length` a knot."""
    return 65536 * min(_LEAST_SHARE, _LEAST_PART * run / length)


@uncounted
def _follow(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"], across: bool, pixel: int, begin: int, end: int, step: int, depth: int, wide: int
) -> int:
    """What becomes of a run of pixels within `depth` lines on one side: 0 it ends, 1 it goes on, 2 it is an area."""
    height, width = labels.shape
    lines, length = (height, width) if across else (width, height)
    label = labels[pixel, begin] if across else labels[begin, pixel]
    for _ in range(depth):
        pixel += step
        if pixel < 0 or pixel >= lines:
            return 1
        low, high = length, -1
        for position in range(max(begin - 1, 0), min(end + 1, length)):
            if (labels[pixel, position] if across else labels[position, pixel]) == label:
                low, high = min(low, position), position
        if high < 0:
            return 0
        while low > 0 and high - low < wide and (labels[pixel, low - 1] if across else labels[low - 1, pixel]) == label:
            low -= 1
        while high - low < wide and high + 1 < length:
            if (labels[pixel, high + 1] if across else labels[high + 1, pixel]) != label:
                break
            high += 1
        if high - low >= wide:
            return 2
        begin, end = low, high + 1
    return 1


@uncounted
def _is_notch(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"], across: bool, pixel: int, begin: int, end: int, rows: int, columns: int
) -> bool:
    """Whether a run is the tip of an area, or a dent in its edge: it ends on one side and is an area on the other."""
    height, width = labels.shape
    depth = max(1, round(_TIP * (height / rows if across else width / columns)))
    wide = round(_LONGEST_RUN * (width / columns if across else height / rows))
    one = _follow(labels, across, pixel, begin, end, -1, depth, wide)
    two = _follow(labels, across, pixel, begin, end, 1, depth, wide)
    return one + two == 2 and one != two


@uncounted
def _claim_run(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"],
    claims: Indices,
    shares: NumberArray,
    across: bool,
    line: int,
    begin: int,
    end: int,
    label: int,
) -> None:
    """The claim of a run of pixels from `begin` to `end` along the centre line of a row (`across`) or column."""
    rows, columns = claims.shape
    length = labels.shape[1] if across else labels.shape[0]
    cells = columns if across else rows
    cell, rest = divmod((begin + end) * cells, 2 * length)
    row, column = (line, cell) if across else (cell, line)
    share = area_share(labels, rows, columns, row, column, label)
    other_row, other_column, other = row, column, 0
    if rest == 0:  # the middle between two knots
        other_row, other_column = (line, cell - 1) if across else (cell - 1, line)
        other = area_share(labels, rows, columns, other_row, other_column, label)
    if max(share, other) < _least_share((end - begin) * cells, length):
        return
    if share > other or (share == other and 2 * cell <= cells):
        take_knot(claims, shares, row, column, label, share)
    if other > share or (share == other and 2 * cell >= cells):
        take_knot(claims, shares, other_row, other_column, label, other)


@uncounted
def _move_run(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"],
    knots: Indices,
    claims: Indices,
    moved: Indices,
    shares: NumberArray,
    across: bool,
    line: int,
    begin: int,
    end: int,
    label: int,
) -> None:
    """The second claim of a run that got no knot: the next one on its longer side, if no line has claimed that."""
    rows, columns = claims.shape
    length = labels.shape[1] if across else labels.shape[0]
    cells = columns if across else rows
    for cell in range(begin * cells // length, (end * cells - 1) // length + 1):
        row, column = (line, cell) if across else (cell, line)
        if knots[row, column] == label:
            return
    cell, rest = divmod((begin + end) * cells, 2 * length)
    before, after = cell * length - begin * cells, end * cells - (cell + 1) * length
    if rest == 0 or before == after or max(before, after) <= 0:
        return
    cell += 1 if after > before else -1
    row, column = (line, cell) if across else (cell, line)
    share = area_share(labels, rows, columns, row, column, label)
    if claims[row, column] == NONE and share >= _least_share((end - begin) * cells, length):
        take_knot(moved, shares, row, column, label, share)


@uncounted
def _claims_along(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"],
    lines: UInt8[np.ndarray, "n length"],
    pixels: IntArray,
    index: IntArray,
    across: bool,
    knots: Indices,
    claims: Indices,
    moved: Indices,
    shares: NumberArray,
    first: bool,
) -> None:
    """The first or the second claims of the runs along centre lines; runs at the border of the picture have none."""
    length = lines.shape[1]
    cells = claims.shape[1] if across else claims.shape[0]
    least = _LEAST_WIDTH * length - cells
    for number in range(lines.shape[0]):
        begin = 0
        line = index[number]
        for position in range(1, length):
            if lines[number, position] != lines[number, begin]:
                label = int(lines[number, begin])
                run = (position - begin) * cells
                thin = begin > 0 and least <= run < _LONGEST_RUN * length
                if thin and not _is_notch(labels, across, pixels[number], begin, position, *claims.shape):
                    if first:
                        _claim_run(labels, claims, shares, across, line, begin, position, label)
                    else:
                        _move_run(labels, knots, claims, moved, shares, across, line, begin, position, label)
                begin = position


def centre_lines(length: int, cells: int) -> tuple[Int64[np.ndarray, " lines"], Int64[np.ndarray, " lines"]]:
    """The pixels through which the centres of the cells of a side run, and their cells.

    Where a centre lies between two pixels it is that nearer to the middle of the side; in the middle both.

    >>> [values.tolist() for values in centre_lines(12, 3)]
    [[2, 5, 6, 9], [0, 1, 1, 2]]
    """
    cell = np.arange(cells)
    pixel, between = np.divmod((2 * cell + 1) * length, 2 * cells)
    pixel = pixel - ((between == 0) & (2 * cell + 1 >= cells))
    both = np.flatnonzero((between == 0) & (2 * cell + 1 == cells))
    return np.sort(np.append(pixel, pixel[both] + 1)), np.sort(np.append(cell, both))


def claim_lines(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "height width"],
    knots: Indices,
    claims: Indices,
    made: Indices,
    shares: NumberArray,
    progress: Progress,
) -> None:
    """The claims along all centre lines: first ones if `made` is `claims`, else second ones."""
    height, width = labels.shape
    first = made is claims
    pixels, index = centre_lines(height, len(knots))
    for band in bands(len(pixels), width, _SLICE):
        _claims_along(labels, labels[pixels[band]], pixels[band], index[band], True, knots, claims, made, shares, first)
        progress(0.5 * band.stop / len(pixels))
    pixels, index = centre_lines(width, knots.shape[1])
    for band in bands(len(pixels), height, _SLICE):
        lines = np.ascontiguousarray(labels[:, pixels[band]].T)
        _claims_along(labels, lines, pixels[band], index[band], False, knots, claims, made, shares, first)
        progress(0.5 + 0.5 * band.stop / len(pixels))
