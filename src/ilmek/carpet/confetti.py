"""Confetti: patches too small to be seen, which a weaver would tie for nothing.

A patch is an 8-connected component of knots of one yarn [`patches`]. A patch of fewer than `least` knots is merged
into a yarn around it, unless one of three reasons keeps it:

contrast  n c >= 10 `least`, with its n knots and its contrast c, the CIEDE2000 of its mean colour in the design to that
          of the knots around it that have the other yarn. For small areas the product of area and contrast decides
          whether they are seen (Ricco's law): a lone knot is as visible at the contrast 10 `least` as a patch of
          `least` knots at 10. The colours are those of the design: two yarns far apart may meet in a smooth area
line      c >= 5, and the knots of its yarn or of near ones within 5 knots lie along a line [`thin_lines`]
dots      c >= 5, and patches of its yarn and of like size follow at equal steps, five or more in a row [`dots`]

The yarn that it takes is one with at least a quarter of the knots around it, or with most of them; of these the one of
the least contrast. Of patches that touch, the smallest is merged first, of equal ones that of the yarn first in the
list, and what remains is judged again until nothing changes. No choice depends on positions: a mirrored or turned
design gives the mirrored or turned chart.

Source of the law: A. Ricco, Relazione fra il minimo angolo visuale e l'intensita luminosa, 1877.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, Float, FloatArray, Indices, Int32, IntArray, Rgb, UInt8
from ilmek.carpet.colour_difference import ciede2000, delta_e_2000
from ilmek.carpet.design import bands
from ilmek.carpet.dots import REACH, Sizes, in_row, middle_of
from ilmek.carpet.halftone import CELL
from ilmek.carpet.light import LIGHT, lab_of_light
from ilmek.carpet.patches import Marks, Members, begins, fill, grown, room
from ilmek.carpet.thin_lines import between_areas, on_line
from ilmek.num.compiled import compiled, in_place
from ilmek.num.threads import MOST_THREADS, in_threads
from ilmek.progress import SILENT, Progress

KEPT = 255
"""Stands for no yarn: indices of yarns are at most 254."""

OwnKnots = UInt8[np.ndarray, "own columns"]
"""The rows of a window that it merges itself."""

Starts = Int32[np.ndarray, " patches"]
Labs = Float[np.ndarray, "yarns 3"]

_WINDOW = 1 << 20

DRAWN = 5.0
"""Least contrast of what is drawn: fainter patches are grain, even along a line."""

VISIBLE = 10.0
"""Contrast [CIEDE2000] at which a patch of the least number of knots is kept."""


@in_place
def is_lone(knots: Indices, row: int, column: int) -> bool:
    """Whether a knot has neighbours and differs from all of them: left, right, above and below (fewer at an edge)."""
    yarn = knots[row, column]
    last_row, last_column = knots.shape[0] - 1, knots.shape[1] - 1
    return bool(
        (column == 0 or knots[row, column - 1] != yarn)
        and (column == last_column or knots[row, column + 1] != yarn)
        and (row == 0 or knots[row - 1, column] != yarn)
        and (row == last_row or knots[row + 1, column] != yarn)
        and (last_row > 0 or last_column > 0)
    )


@in_place
def _add_light(rgb: Rgb, row: int, column: int, sums: IntArray) -> None:
    # Whole numbers: the sum does not depend on the order.
    for channel in range(3):
        sums[channel] += LIGHT[rgb[row, column, channel]]


@compiled
def _contrast(one: IntArray, ones: int, other: IntArray, others: int) -> float:
    l1, a1, b1 = lab_of_light(one[0] / ones, one[1] / ones, one[2] / ones)
    l2, a2, b2 = lab_of_light(other[0] / others, other[1] / others, other[2] / others)
    return ciede2000(l1, a1, b1, l2, a2, b2)


@in_place
def _surround(  # noqa: PLR0917
    knots: Indices, rgb: Rgb, members: Members, number: int, marks: Marks, mark: int, around: IntArray, sums: IntArray
) -> int:
    """The number of knots around a patch, and of each yarn their number and light; `mark` + 1 is set at them."""
    middle = marks.shape[0] // 2
    up, left = middle - members[0, 0], middle - members[0, 1]
    around[:] = 0
    sums[:] = 0
    ring = 0
    for k in range(number):
        y, x = members[k]
        for i in range(max(y - 1, 0), min(y + 2, knots.shape[0])):
            for j in range(max(x - 1, 0), min(x + 2, knots.shape[1])):
                if marks[i + up, j + left] < mark:
                    marks[i + up, j + left] = mark + 1
                    yarn = knots[i, j]
                    around[yarn] += 1
                    ring += 1
                    _add_light(rgb, i, j, sums[yarn])
    return ring


@in_place
def _nearest_around(own: IntArray, number: int, ring: int, around: IntArray, sums: IntArray) -> tuple[int, float]:
    """The yarn around a patch that it would take, and the contrast to it."""
    most = 0
    for number_of_yarn in around:
        most = max(most, number_of_yarn)
    best, least = -1, np.inf
    for yarn in range(len(around)):
        if around[yarn] > 0 and (4 * around[yarn] >= ring or around[yarn] == most):
            contrast = _contrast(own, number, sums[yarn], around[yarn])
            if contrast < least:
                best, least = yarn, contrast
    return best, least


@in_place
def _measure(  # noqa: PLR0917
    knots: Indices, least: int, side: int, wanted: BoolArray, sizes: Sizes, starts: Starts, members: Members,
    marks: Marks
) -> int:  # fmt: skip
    """Number of patches of fewer than `least` knots that begin in the wanted tiles.

    sizes  receives the size of each at its knots, and 0 elsewhere      starts  receives the first knot of each
    """
    found, mark = 0, 0
    marks[:] = 0
    sizes[:] = 0
    for row in range(knots.shape[0]):
        for tile in range(wanted.shape[1]):
            if wanted[row // side, tile]:
                for column in range(tile * side, min((tile + 1) * side, knots.shape[1])):
                    if begins(knots, row, column):
                        mark += 1
                        number = fill(knots, row, column, least, True, members, marks, mark)
                        if 0 < number < least:
                            starts[found] = row * knots.shape[1] + column
                            found += 1
                            for k in range(number):
                                sizes[members[k, 0], members[k, 1]] = number
    return found


@in_place
def _is_kept(kept: BoolArray, members: Members, number: int) -> bool:
    """Whether a knot of a patch lies in a cell of a halftone; `kept` is empty without one."""
    for k in range(number if kept.size else 0):
        y, x = members[k]
        if kept[min(y // CELL, kept.shape[0] - 1), min(x // CELL, kept.shape[1] - 1)]:
            return True
    return False


@compiled
def _judge(  # noqa: PLR0917
    knots: Indices, rgb: Rgb, gap: FloatArray, least: int, side: int, wanted: BoolArray, near: tuple[int, int],
    sizes: Sizes, starts: Starts, targets: Indices, loose: BoolArray, kept: BoolArray, members: Members, marks: Marks
) -> None:  # fmt: skip
    """Write the yarn that each patch takes, KEPT if none, and mark the knots of those that take one as loose.

    wanted, near  tiles and rows in which patches that begin there are judged
    """
    around, sums = np.zeros(len(gap), dtype=np.int64), np.zeros((len(gap), 3), dtype=np.int64)
    own = np.zeros(3, dtype=np.int64)
    others, other_marks = np.empty_like(members), np.zeros_like(marks)
    mark = 0
    marks[:] = 0
    for patch in range(len(starts)):
        row, column = divmod(starts[patch], knots.shape[1])
        targets[patch] = KEPT
        if not (near[0] <= row < near[1] and wanted[row // side, column // side]):
            continue
        mark += 2
        yarn = knots[row, column]
        number = fill(knots, row, column, least, False, members, marks, mark)
        if _is_kept(kept, members, number):
            continue
        own[:] = 0
        for k in range(number):
            _add_light(rgb, members[k, 0], members[k, 1], own)
        ring = _surround(knots, rgb, members, number, marks, mark, around, sums)
        other, contrast = _nearest_around(own, number, ring, around, sums)
        if other < 0 or number * contrast >= VISIBLE * least:
            continue
        if contrast >= DRAWN:
            line = not between_areas(around, ring, yarn, other, gap)
            if line and on_line(knots, *middle_of(members, number), number, yarn, other, gap):
                continue
            if in_row(knots, sizes, members, number, least, others, other_marks):
                continue
        targets[patch] = other
        for k in range(number):
            loose[members[k, 0], members[k, 1]] = True


@in_place
def _first_of_its_neighbours(  # noqa: PLR0917
    knots: Indices, sizes: Sizes, loose: BoolArray, members: Members, number: int, yarn: int
) -> bool:
    """Whether no patch that touches this one and takes another yarn is smaller, or equal and of an earlier yarn."""
    for k in range(number):
        y, x = members[k]
        for i in range(max(y - 1, 0), min(y + 2, knots.shape[0])):
            for j in range(max(x - 1, 0), min(x + 2, knots.shape[1])):
                if loose[i, j] and (sizes[i, j] < number or (sizes[i, j] == number and knots[i, j] < yarn)):
                    return False
    return True


@in_place
def _merge(  # noqa: PLR0917
    knots: Indices, out: OwnKnots, top: int, least: int, side: int, sizes: Sizes, starts: Starts, targets: Indices,
    loose: BoolArray, again: BoolArray, members: Members, marks: Marks
) -> None:  # fmt: skip
    """Merge the loose patches that are first of their neighbours.

    out    the knots of the window from row `top` on, which receive the yarns
    again  by tile of `out`, receives where patches are merged or wait for others
    """
    mark = 0
    marks[:] = 0
    for patch in range(len(starts)):
        if targets[patch] == KEPT:
            continue
        row, column = divmod(starts[patch], knots.shape[1])
        mark += 1
        number = fill(knots, row, column, least, False, members, marks, mark)
        first = _first_of_its_neighbours(knots, sizes, loose, members, number, knots[row, column])
        for k in range(number):
            y, x = members[k]
            if top <= y < top + out.shape[0]:
                again[(y - top) // side, x // side] = True
                if first:
                    out[y - top, x] = targets[patch]


def merge_patches(
    knots: Indices,
    rgb: Rgb,
    yarn_labs: Labs,
    least: int,
    *,
    kept: BoolArray | None = None,
    progress: Progress = SILENT,
) -> tuple[Indices, int]:
    """The chart (rows, columns) with its confetti merged, and the number of knots that changed.

    rgb  the design      yarn_labs  CIELAB of the yarns      least  knots of a patch that is never merged
    kept  cells whose patches are never merged [`halftone.draw_halftone`]; default: none
    """
    knots, rgb = np.ascontiguousarray(knots), np.ascontiguousarray(rgb)
    if least < 2:
        return knots, 0
    gap = delta_e_2000(yarn_labs[:, None], yarn_labs[None, :])
    task = _Task(rgb, gap, least, np.zeros((0, 0), dtype=bool) if kept is None else kept)
    side = _side(least)
    merged = knots.copy()
    wanted = np.ones((-(-knots.shape[0] // side), -(-knots.shape[1] // side)), dtype=bool)
    share = 0.0
    while wanted.any():
        then = 0.2 * share + 0.8  # the number of rounds is not known
        wanted = _round(merged, task, grown(wanted), progress.part(share, then))
        share = then
    return merged, sum(int(np.count_nonzero(merged[band] != knots[band])) for band in bands(*knots.shape))


class _Task(NamedTuple):
    """What every round takes: the design, CIEDE2000 of each two yarns, least patch, cells that are kept."""

    rgb: Rgb
    gap: FloatArray
    least: int
    kept: BoolArray


def _round(knots: Indices, task: _Task, wanted: BoolArray, progress: Progress) -> BoolArray:
    """Merge the patches of the wanted tiles that are first of their neighbours; the tiles where work remains.

    Windows of rows, with a tile more above and below, are copies of the chart at the begin of the round, so that the
    result does not depend on the windows, nor on the threads.
    """
    side = _side(task.least)
    again = np.zeros_like(wanted)
    parts = list(bands(len(wanted), side * knots.shape[1], _WINDOW))
    above = knots[:0]
    for first in range(0, len(parts), MOST_THREADS):
        works = []
        for tiles in parts[first : first + MOST_THREADS]:
            start, stop = tiles.start * side, min(tiles.stop * side, len(knots))
            window = np.concatenate([above, knots[start : stop + side]])
            near = wanted[max(tiles.start - 1, 0) : tiles.stop + 1]
            if near.any():
                works.append((window, start, len(above), knots[start:stop], near, again[tiles]))
            above = knots[stop - side : stop].copy()
        for _ in in_threads(lambda work: _merge_window(task, *work), works):
            progress(stop / len(knots))
    return again


def _merge_window(  # noqa: PLR0917
    task: _Task, window: Indices, start: int, top: int, out: OwnKnots, wanted: BoolArray, again: BoolArray
) -> None:
    """Merge in a window of rows whose own rows, from its row `top` on, are those of `out` and begin at row `start`."""
    least, side, first = task.least, _side(task.least), start - top
    members, marks = room(least)
    sizes, loose = np.empty(window.shape, dtype=np.uint8), np.zeros(window.shape, dtype=bool)
    starts = np.empty(window.size, dtype=np.int32)
    found = _measure(window, least, side, grown(wanted), sizes, starts, members, marks)
    starts, targets = starts[:found], np.empty(found, dtype=np.uint8)
    rgb, kept = task.rgb[first : first + len(window)], task.kept[first // CELL :]
    near = (top - 2 * least, top + len(out) + 2 * least)
    _judge(window, rgb, task.gap, least, side, wanted, near, sizes, starts, targets, loose, kept, members, marks)
    _merge(window, out, top, least, side, sizes, starts, targets, loose, again, members, marks)


def _side(least: int) -> int:
    """Side of a tile: no judgement depends on a knot as far away."""
    return REACH + 4 * least
