"""Patches: the 8-connected components of knots of one yarn, of fewer than a given number of knots.

A small patch is found by a fill from its first knot in the order of reading, which stops at the given number. A fill
begins only where no earlier neighbour (left, above, above left, above right) has the same yarn, and is given up where
it meets a knot before its first. So the time is linear in the knots, and no labels are kept.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, Indices, Int32, Int64, UInt8
from ilmek.carpet.codes import CODES, NO_KNOT
from ilmek.carpet.design import PART, bands
from ilmek.num.compiled import compiled, embedded, uncounted
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress

Members = Int64[np.ndarray, "knots 2"]
Marks = Int32[np.ndarray, "side side"]


def room(least: int) -> tuple[Members, Marks]:
    """The arrays of a fill of patches of fewer than `least` knots: their knots, and marks around the first one."""
    return np.empty((least + 1, 2), dtype=np.int64), np.zeros((2 * least + 3, 2 * least + 3), dtype=np.int32)


def grown(cells: BoolArray) -> BoolArray:
    """Cells (rows, columns) that are true, and those that touch them.

    >>> grown(np.array([[True, False, False]])).tolist()
    [[True, True, False]]
    """
    wide = cells.copy()
    wide[1:] |= cells[:-1]
    wide[:-1] |= cells[1:]
    out = wide.copy()
    out[:, 1:] |= wide[:, :-1]
    out[:, :-1] |= wide[:, 1:]
    return out


@embedded
def is_lone(knots: Indices, row: int, column: int) -> bool:
    """Whether a knot has neighbours and differs from all of them: left, right, above and below (fewer at an edge)."""
    yarn = knots[row, column]
    last_row, last_column = knots.shape[0] - 1, knots.shape[1] - 1
    return bool(
        yarn != NO_KNOT
        and (column == 0 or knots[row, column - 1] != yarn)
        and (column == last_column or knots[row, column + 1] != yarn)
        and (row == 0 or knots[row - 1, column] != yarn)
        and (row == last_row or knots[row + 1, column] != yarn)
        and (last_row > 0 or last_column > 0)
    )


@embedded
def begins(knots: Indices, row: int, column: int) -> bool:
    """Whether a cell has a knot, and no earlier neighbour its yarn."""
    yarn = knots[row, column]
    if yarn == NO_KNOT or (column > 0 and knots[row, column - 1] == yarn):
        return False
    if row == 0:
        return True
    return bool(
        knots[row - 1, column] != yarn
        and (column == 0 or knots[row - 1, column - 1] != yarn)
        and (column == knots.shape[1] - 1 or knots[row - 1, column + 1] != yarn)
    )


@uncounted
def next_mark(marks: Marks) -> int:
    """A mark that is at no knot; they are counted in the corner, which no fill reaches."""
    marks[0, 0] += 1
    return int(marks[0, 0])


@uncounted
def fill(  # noqa: PLR0917
    knots: Indices, row: int, column: int, least: int, first: bool, members: Members, marks: Marks, mark: int
) -> int:
    """The number of knots of the patch of a knot, at most `least`; 0 where `first` and an earlier knot belongs to it.

    members  receives the rows and columns of the knots
    marks    receives `mark` at each of them; its middle is at (row, column)
    """
    yarn = knots[row, column]
    middle = marks.shape[0] // 2
    up, left = middle - row, middle - column
    members[0, 0], members[0, 1] = row, column
    marks[middle, middle] = mark
    found, done = 1, 0
    while done < found:
        y, x = members[done]
        done += 1
        for i in range(max(y - 1, 0), min(y + 2, knots.shape[0])):
            for j in range(max(x - 1, 0), min(x + 2, knots.shape[1])):
                if knots[i, j] == yarn and marks[i + up, j + left] != mark:
                    if first and (i < row or (i == row and j < column)):
                        return 0
                    if found == least - 1:
                        return least
                    marks[i + up, j + left] = mark
                    members[found, 0], members[found, 1] = i, j
                    found += 1
    return found


@uncounted
def _count(  # noqa: PLR0917
    knots: Indices, first: int, stop: int, members: Members, marks: Marks, found: Int64[np.ndarray, " sizes"]
) -> None:
    least, mark = len(found), 0
    marks[:] = 0
    for row in range(first, stop):
        for column in range(knots.shape[1]):
            if begins(knots, row, column):
                mark += 1
                size = fill(knots, row, column, least, True, members, marks, mark)
                if 0 < size < least:
                    found[size] += 1


def patch_sizes(knots: Indices, most: int, progress: Progress = SILENT) -> Int64[np.ndarray, " sizes"]:
    """Numbers of the patches of 0, 1, 2 ... `most` knots of a chart (rows, columns).

    >>> patch_sizes(np.array([[1, 0, 0, 2], [0, 1, 0, 2], [0, 0, 0, 2]], dtype=np.uint8), 3).tolist()
    [0, 0, 1, 1]
    """
    knots = np.ascontiguousarray(knots)

    def of_band(band: slice) -> Int64[np.ndarray, " sizes"]:
        sizes = np.zeros(most + 1, dtype=np.int64)
        _count(knots, band.start, band.stop, *room(most + 1), sizes)
        return sizes

    found = np.zeros(most + 1, dtype=np.int64)
    for band, sizes in in_threads(of_band, bands(knots.shape[0], knots.shape[1], PART)):
        found += sizes
        progress(band.stop / len(knots))
    return found


def count_patches(knots: Indices, most: int, progress: Progress = SILENT) -> int:
    """Number of patches of at most `most` knots of a chart (rows, columns).

    >>> count_patches(np.array([[1, 0, 0, 2], [0, 1, 0, 2], [0, 0, 0, 2]], dtype=np.uint8), 2)
    1
    """
    return int(patch_sizes(knots, most, progress).sum())


class SmallPatches(NamedTuple):
    """The small patches of a chart.

    sizes  numbers of the patches of 0, 1, 2 ... knots
    knots  of all of them, patch by patch, counted row by row from the upper edge
    around the yarn of each knot's patch that most of the knots around it have; of equal ones the first
    """

    sizes: Int64[np.ndarray, " sizes"]
    knots: Int64[np.ndarray, " knots"]
    around: UInt8[np.ndarray, " knots"]


def small_patches(knots: Indices, most: int, progress: Progress = SILENT) -> SmallPatches:
    """The patches of at most `most` knots of a chart (rows, columns).

    >>> found = small_patches(np.array([[1, 0, 0, 2], [0, 1, 0, 2], [0, 0, 0, 2]], dtype=np.uint8), 2)
    >>> found.knots.tolist(), found.around.tolist()
    ([0, 5], [0, 0])
    """
    knots = np.ascontiguousarray(knots)
    places, yarns = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.uint8)]
    sizes = np.zeros(most + 1, dtype=np.int64)
    members, marks = room(most + 1)
    for band in bands(knots.shape[0], knots.shape[1], PART):
        number = (band.stop - band.start) * knots.shape[1] + most * knots.shape[1]
        place, around = np.empty(number, dtype=np.int64), np.empty(number, dtype=np.uint8)
        found = _list(knots, band.start, band.stop, members, marks, sizes, place, around)
        places.append(place[:found])
        yarns.append(around[:found])
        progress(band.stop / len(knots))
    return SmallPatches(sizes, np.concatenate(places), np.concatenate(yarns))


@compiled
def _list(  # noqa: PLR0917
    knots: Indices,
    first: int,
    stop: int,
    members: Members,
    marks: Marks,
    sizes: Int64[np.ndarray, " sizes"],
    places: Int64[np.ndarray, " most"],
    yarns: UInt8[np.ndarray, " most"],
) -> int:
    """List the knots of the small patches that begin in some rows, and the yarns around; the number of knots."""
    least, mark, found = len(sizes), 0, 0
    near = np.zeros(CODES, dtype=np.int64)
    marks[:] = 0
    for row in range(first, stop):
        for column in range(knots.shape[1]):
            if not begins(knots, row, column):
                continue
            mark += 1
            size = fill(knots, row, column, least, True, members, marks, mark)
            if not 0 < size < least:
                continue
            sizes[size] += 1
            near[:] = 0
            for k in range(size):
                y, x = members[k]
                for i in range(max(y - 1, 0), min(y + 2, knots.shape[0])):
                    for j in range(max(x - 1, 0), min(x + 2, knots.shape[1])):
                        near[knots[i, j]] += 1
            near[knots[row, column]] = 0
            around = np.argmax(near) if near.any() else knots[row, column]
            for k in range(size):
                places[found] = members[k, 0] * knots.shape[1] + members[k, 1]
                yarns[found] = around
                found += 1
    return found
