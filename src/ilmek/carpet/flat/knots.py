"""Knots: one label for each knot, from the labels of the pixels.

Area rule. A knot takes the label with the largest area of its cell.

Line rule. Through the centres of the knots run centre lines, one for each row and column. A run of one label along a
centre line that is shorter than 1.5 knots is where a line crosses it; the line takes the knot in which the middle of the
run lies. (Freeman's grid-intersect quantisation: the knots of a line of any angle are 8-connected.) Of several lines in
one knot, that with the largest area of the cell takes it.

Dot rule. A dot between four centres crosses no centre line. It takes the knot, of those four, that has the most of it.

Ties are decided by the colours and by the distance from the centre of the picture, never by the order of the scan: the
mirror image of a picture gives the mirror image of the chart. All areas are integers.
"""

import numpy as np

from ilmek.arrays import Indices, Int64, IntArray, UInt8
from ilmek.carpet.design import bands
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress

NONE = 255
_SLICE = 1 << 21
_LEAST_WIDTH, _LONGEST_RUN = 0.6, 1.5
"""Least width of a line and longest run across one, in knots; a run of pixels may be one pixel shorter."""

_TIP = 0.35
"""Length, in knots, over which a run must go on."""

_LEAST_SHARE, _LEAST_PART, _LEAST_DOT = 0.2, 0.4, 0.25
"""Least share of a cell that a line has, or part of the run across it; least area of a dot, in knots."""


@compiled
def _vote(labels: UInt8[np.ndarray, "h w"], rows: int, first: int, knots: Indices) -> None:
    height, width = labels.shape
    columns = knots.shape[1]
    areas = np.zeros(256, dtype=np.int64)
    for index in range(knots.shape[0]):
        row = first + index
        top, bottom = row * height // rows, ((row + 1) * height - 1) // rows
        for column in range(columns):
            left, right = column * width // columns, ((column + 1) * width - 1) // columns
            own = labels[top, left]
            same = True
            for y in range(top, bottom + 1):
                for x in range(left, right + 1):
                    same = same and labels[y, x] == own
            if same:
                knots[index, column] = own
                continue
            for y in range(top, bottom + 1):
                deep = min((row + 1) * height, (y + 1) * rows) - max(row * height, y * rows)
                for x in range(left, right + 1):
                    wide = min((column + 1) * width, (x + 1) * columns) - max(column * width, x * columns)
                    areas[labels[y, x]] += deep * wide
            best = NONE
            for y in range(top, bottom + 1):
                for x in range(left, right + 1):
                    label = labels[y, x]
                    if best == NONE or areas[label] > areas[best] or (areas[label] == areas[best] and label < best):
                        best = int(label)
            knots[index, column] = best
            for y in range(top, bottom + 1):
                for x in range(left, right + 1):
                    areas[labels[y, x]] = 0


@compiled
def _share(labels: UInt8[np.ndarray, "h w"], rows: int, columns: int, row: int, column: int, label: int) -> int:
    """Area of a label in a cell; the whole cell has 65536."""
    height, width = labels.shape
    area = 0
    for y in range(row * height // rows, ((row + 1) * height - 1) // rows + 1):
        deep = min((row + 1) * height, (y + 1) * rows) - max(row * height, y * rows)
        for x in range(column * width // columns, ((column + 1) * width - 1) // columns + 1):
            if labels[y, x] == label:
                area += deep * (min((column + 1) * width, (x + 1) * columns) - max(column * width, x * columns))
    return area * 65536 // (height * width)


@compiled
def _least_share(run: int, length: int) -> float:
    """Least share of a cell that a run must have; `run` and `length` in the same units, `length` a knot."""
    return 65536 * min(_LEAST_SHARE, _LEAST_PART * run / length)


@compiled
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


@compiled
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


@compiled
def _take(claims: Indices, shares: IntArray, row: int, column: int, label: int, share: int) -> None:  # noqa: PLR0917
    before = claims[row, column]
    if before == NONE or share > shares[row, column] or (share == shares[row, column] and label < before):
        claims[row, column], shares[row, column] = label, share


@compiled
def _claim_run(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"],
    claims: Indices,
    shares: IntArray,
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
    share = _share(labels, rows, columns, row, column, label)
    other_row, other_column, other = row, column, 0
    if rest == 0:  # the middle between two knots
        other_row, other_column = (line, cell - 1) if across else (cell - 1, line)
        other = _share(labels, rows, columns, other_row, other_column, label)
    if max(share, other) < _least_share((end - begin) * cells, length):
        return
    if share > other or (share == other and 2 * cell <= cells):
        _take(claims, shares, row, column, label, share)
    if other > share or (share == other and 2 * cell >= cells):
        _take(claims, shares, other_row, other_column, label, other)


@compiled
def _move_run(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"],
    knots: Indices,
    claims: Indices,
    moved: Indices,
    shares: IntArray,
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
    share = _share(labels, rows, columns, row, column, label)
    if claims[row, column] == NONE and share >= _least_share((end - begin) * cells, length):
        _take(moved, shares, row, column, label, share)


@compiled
def _claim_lines(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"],
    lines: UInt8[np.ndarray, "n length"],
    pixels: IntArray,
    index: IntArray,
    across: bool,
    knots: Indices,
    claims: Indices,
    moved: Indices,
    shares: IntArray,
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


@compiled
def _claim_dots(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"],
    knots: Indices,
    across: IntArray,
    down: IntArray,
    claims: Indices,
    shares: IntArray,
    first: int,
    stop: int,
) -> None:
    rows, columns = knots.shape
    height, width = labels.shape
    areas = np.zeros(256, dtype=np.int64)
    least = _LEAST_DOT * height * width
    for row in range(first, stop):
        top, bottom = down[row, 1] + 1, down[row + 1, 0]
        for column in range(columns - 1):
            left, right = across[column, 1] + 1, across[column + 1, 0]
            if top >= bottom or left >= right:
                continue
            own = labels[top, left]
            same = True
            for y in range(top, bottom):
                for x in range(left, right):
                    same = same and labels[y, x] == own
            if same:
                continue
            for y in range(top, bottom):
                for x in range(left, right):
                    areas[labels[y, x]] += rows * columns
            for y in range(top, bottom):
                for x in range(left, right):
                    label = labels[y, x]
                    if areas[label] >= least and not _on_frame(labels, top, bottom, left, right, label):
                        _claim_dot(labels, knots, claims, shares, row, column, label)
                    areas[label] = 0


@compiled
def _on_frame(labels: UInt8[np.ndarray, "h w"], top: int, bottom: int, left: int, right: int, label: int) -> bool:
    """Whether a label occurs on the centre lines around a rectangle."""
    height, width = labels.shape
    for x in range(max(left - 1, 0), min(right + 1, width)):
        if labels[max(top - 1, 0), x] == label or labels[min(bottom, height - 1), x] == label:
            return True
    for y in range(top, bottom):
        if labels[y, max(left - 1, 0)] == label or labels[y, min(right, width - 1)] == label:
            return True
    return False


@compiled
def _claim_dot(
    labels: UInt8[np.ndarray, "h w"],
    knots: Indices,
    claims: Indices,
    shares: IntArray,
    row: int,
    column: int,
    label: int,
) -> None:
    rows, columns = knots.shape
    most = 0
    for down in range(2):
        for right in range(2):
            if knots[row + down, column + right] == label:
                return
            most = max(most, _share(labels, rows, columns, row + down, column + right, label))
    nearest = rows + columns + 2
    for down in range(2):
        for right in range(2):
            far = abs(2 * (row + down) + 1 - rows) + abs(2 * (column + right) + 1 - columns)
            if _share(labels, rows, columns, row + down, column + right, label) == most:
                nearest = min(nearest, far)
    for down in range(2):
        for right in range(2):
            far = abs(2 * (row + down) + 1 - rows) + abs(2 * (column + right) + 1 - columns)
            share = _share(labels, rows, columns, row + down, column + right, label)
            if share == most and far == nearest:
                _take(claims, shares, row + down, column + right, label, share)


def knot_labels(
    labels: UInt8[np.ndarray, "height width"], grid: tuple[int, int], progress: Progress = SILENT
) -> Indices:
    """The label of each knot."""
    (height, width), (rows, columns) = labels.shape, grid
    knots = np.empty(grid, dtype=np.uint8)
    step = max(1, _SLICE // (width * -(-height // rows) + columns))
    for first in range(0, rows, step):
        _vote(labels, rows, first, knots[first : first + step])
        progress(0.4 * min(first + step, rows) / rows)
    claims, shares = np.full(grid, NONE, dtype=np.uint8), np.zeros(grid, dtype=np.uint16)
    _scan(labels, knots, claims, claims, shares, progress.part(0.4, 0.6))
    np.copyto(knots, claims, where=claims != NONE)
    second = np.full(grid, NONE, dtype=np.uint8)
    shares[:] = 0
    _scan(labels, knots, claims, second, shares, progress.part(0.6, 0.8))
    np.copyto(knots, second, where=second != NONE)
    np.copyto(claims, second, where=second != NONE)
    second[:] = NONE
    shares[:] = 0
    across, down = _frames(*centre_lines(width, columns)), _frames(*centre_lines(height, rows))
    for first in range(0, rows - 1, step):
        _claim_dots(labels, knots, across, down, second, shares, first, min(first + step, rows - 1))
        progress(0.8 + 0.2 * min(first + step, rows) / rows)
    np.copyto(knots, second, where=(second != NONE) & (claims == NONE))
    return knots


def _scan(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "height width"],
    knots: Indices,
    claims: Indices,
    made: Indices,
    shares: UInt8[np.ndarray, "rows columns"],
    progress: Progress,
) -> None:
    """The claims along all centre lines: first ones if `made` is `claims`, else second ones."""
    height, width = labels.shape
    first = made is claims
    pixels, index = centre_lines(height, len(knots))
    for band in bands(len(pixels), width, _SLICE):
        _claim_lines(labels, labels[pixels[band]], pixels[band], index[band], True, knots, claims, made, shares, first)
        progress(0.5 * band.stop / len(pixels))
    pixels, index = centre_lines(width, knots.shape[1])
    for band in bands(len(pixels), height, _SLICE):
        lines = np.ascontiguousarray(labels[:, pixels[band]].T)
        _claim_lines(labels, lines, pixels[band], index[band], False, knots, claims, made, shares, first)
        progress(0.5 + 0.5 * band.stop / len(pixels))


def _frames(pixels: IntArray, index: IntArray) -> Int64[np.ndarray, "cells 2"]:
    """The first and the last centre line of each cell."""
    begin = np.flatnonzero(np.diff(index, prepend=-1))
    end = np.flatnonzero(np.diff(index, append=index[-1] + 1))
    return np.stack([pixels[begin], pixels[end]], axis=-1)
