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
from ilmek.carpet.dots import REACH, in_row, middle_of
from ilmek.carpet.halftone import CELL
from ilmek.carpet.light import LIGHT, lab_of_light
from ilmek.carpet.patches import Marks, Members, begins, fill, grown, room
from ilmek.carpet.thin_lines import RADIUS, between_areas, on_line
from ilmek.num.compiled import embedded, uncounted
from ilmek.num.threads import MOST_THREADS, in_threads
from ilmek.progress import SILENT, Progress

KEPT = 255
"""Stands for no yarn: indices of yarns are at most 254."""

OwnKnots = UInt8[np.ndarray, "own columns"]
"""The rows of a window that it merges itself."""

Sizes = UInt8[np.ndarray, "rows columns"]
Starts = Int32[np.ndarray, " patches"]
Labs = Float[np.ndarray, "yarns 3"]

Targets = UInt8[np.ndarray, " patches"]

_WINDOW = 1 << 20


class _Rooms(NamedTuple):
    """Room for the judgement of a patch [`patches.room`]: of it, of others, its light, and what lies around it."""

    members: Members
    marks: Marks
    others: Members
    other_marks: Marks
    own: IntArray
    around: IntArray
    sums: IntArray


def _rooms(least: int, yarns: int) -> _Rooms:
    around, sums = np.zeros(yarns, dtype=np.int64), np.zeros((yarns, 3), dtype=np.int64)
    return _Rooms(*room(least), *room(least), np.zeros(3, dtype=np.int64), around, sums)


class _Window(NamedTuple):
    """A part of the chart.

    knots   rows of the chart, with a margin, as they were      first, top  row of the chart and of the part with which
            the knots and its own rows begin
    own     its own rows, which receive the yarns               wanted      tiles of `knots` whose patches are judged
    again   of the tiles of its own rows, receives where patches are merged or wait for others
    dotted  the same, receives where rows of dots begin
    """

    knots: Indices
    first: int
    top: int
    own: OwnKnots
    wanted: BoolArray
    again: BoolArray
    dotted: BoolArray


DRAWN = 5.0
"""Least contrast of what is drawn: fainter patches are grain, even along a line."""

VISIBLE = 10.0
"""Contrast [CIEDE2000] at which a patch of the least number of knots is kept."""


@uncounted
def _add_light(rgb: Rgb, row: int, column: int, sums: IntArray) -> None:
    # Whole numbers: the sum does not depend on the order.
    for channel in range(3):
        sums[channel] += LIGHT[rgb[row, column, channel]]


@uncounted
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


@uncounted
def _nearest_around(own: IntArray, number: int, ring: int, around: IntArray, sums: IntArray) -> tuple[int, float]:
    """The yarn around a patch that it would take, and the contrast to it."""
    most = 0
    for number_of_yarn in around:
        most = max(most, number_of_yarn)
    best, least = -1, np.inf
    lightness, a, b = lab_of_light(own[0] / number, own[1] / number, own[2] / number)
    for yarn in range(len(around)):
        ones = around[yarn]
        if ones > 0 and (4 * ones >= ring or ones == most):
            l2, a2, b2 = lab_of_light(sums[yarn, 0] / ones, sums[yarn, 1] / ones, sums[yarn, 2] / ones)
            contrast = ciede2000(lightness, a, b, l2, a2, b2)
            if contrast < least:
                best, least = yarn, contrast
    return best, least


@embedded
def _is_kept(kept: BoolArray, y: int, x: int) -> bool:
    """Whether a knot lies in a cell of a halftone; `kept` is empty without one."""
    return bool(kept.size and kept[min(y // CELL, kept.shape[0] - 1), min(x // CELL, kept.shape[1] - 1)])


@uncounted
def _any_is_kept(kept: BoolArray, members: Members, number: int) -> bool:
    for k in range(number):  # noqa: SIM110 - `any` is not compiled
        if _is_kept(kept, members[k, 0], members[k, 1]):
            return True
    return False


@uncounted
def _target(  # noqa: PLR0917
    knots: Indices, rgb: Rgb, gap: FloatArray, least: int, number: int, mark: int, rooms: _Rooms
) -> tuple[int, bool]:
    """The yarn that a patch takes, KEPT if none, and whether that is for a row of dots.

    rooms  its first `number` members are the patch, at which the marks are `mark`
    """
    members, marks, own, around, sums = rooms.members, rooms.marks, rooms.own, rooms.around, rooms.sums
    yarn = knots[members[0, 0], members[0, 1]]
    own[:] = 0
    for k in range(number):
        _add_light(rgb, members[k, 0], members[k, 1], own)
    ring = _surround(knots, rgb, members, number, marks, mark, around, sums)
    other, contrast = _nearest_around(own, number, ring, around, sums)
    if other < 0 or number * contrast >= VISIBLE * least:
        return KEPT, False
    if contrast >= DRAWN:
        row, column = middle_of(members, number)
        line = not between_areas(around, ring, yarn, other, gap)
        if line and on_line(knots, row, column, number, yarn, other, gap):
            return KEPT, False
        if in_row(knots, members, number, least, rooms.others, rooms.other_marks):
            return KEPT, True
    return other, False


@uncounted
def _judge(  # noqa: PLR0917
    window: _Window, rgb: Rgb, gap: FloatArray, least: int, side: int, kept: BoolArray, rooms: _Rooms, sizes: Sizes,
    starts: Starts, targets: Targets
) -> int:  # fmt: skip
    """Number of loose patches of fewer than `least` knots, that take another yarn.

    sizes  receives the size of each at its knots      starts, targets  receive the first knot of each, and its yarn
    """
    knots, top = window.knots, window.top
    loose, mark, columns = 0, 0, knots.shape[1]
    for row in range(max(top - 2 * least, 0), min(top + window.own.shape[0] + 2 * least, knots.shape[0])):
        for tile in range(window.wanted.shape[1]):
            if not window.wanted[row // side, tile]:
                continue
            for column in range(tile * side, min((tile + 1) * side, columns)):
                if not begins(knots, row, column) or _is_kept(kept, row, column):
                    continue
                mark += 2
                number = fill(knots, row, column, least, True, rooms.members, rooms.marks, mark)
                if not 0 < number < least or _any_is_kept(kept, rooms.members, number):
                    continue
                target, dotted = _target(knots, rgb, gap, least, number, mark, rooms)
                if dotted and top <= row < top + window.own.shape[0]:
                    window.dotted[(row - top) // side, tile] = True
                if target != KEPT:
                    starts[loose], targets[loose] = row * columns + column, target
                    loose += 1
                    for k in range(number):
                        sizes[rooms.members[k, 0], rooms.members[k, 1]] = number
    return loose


@uncounted
def _first_of_its_neighbours(knots: Indices, sizes: Sizes, members: Members, number: int, yarn: int) -> bool:
    """Whether no loose patch that touches this one is smaller, or equal and of an earlier yarn."""
    for k in range(number):
        y, x = members[k]
        for i in range(max(y - 1, 0), min(y + 2, knots.shape[0])):
            for j in range(max(x - 1, 0), min(x + 2, knots.shape[1])):
                if 0 < sizes[i, j] < number or (sizes[i, j] == number and knots[i, j] < yarn):
                    return False
    return True


@uncounted
def _merge(  # noqa: PLR0917
    window: _Window, least: int, side: int, members: Members, marks: Marks, sizes: Sizes, starts: Starts,
    targets: Targets
) -> None:  # fmt: skip
    """Merge the loose patches that are first of their neighbours; `marks` are 0."""
    knots, own, top = window.knots, window.own, window.top
    for patch in range(len(starts)):
        row, column = divmod(starts[patch], knots.shape[1])
        number = fill(knots, row, column, least, False, members, marks, patch + 1)
        first = _first_of_its_neighbours(knots, sizes, members, number, knots[row, column])
        for k in range(number):
            y, x = members[k]
            if top <= y < top + own.shape[0]:
                window.again[(y - top) // side, x // side] = True
                if first:
                    own[y - top, x] = targets[patch]


def merge_patches(
    knots: Indices, rgb: Rgb, yarn_labs: Labs, least: int, *, kept: BoolArray | None = None, progress: Progress = SILENT
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
    dotted = np.zeros_like(wanted)
    share = 0.0
    while wanted.any():
        then = 0.2 * share + 0.8  # the number of rounds is not known
        again = _round(merged, task, wanted, dotted, progress.part(share, then))
        wanted = grown(again)
        far = wanted
        for _ in range(_margin(least)):
            far = grown(far)
        wanted |= far & dotted
        share = then
    return merged, sum(int(np.count_nonzero(merged[band] != knots[band])) for band in bands(*knots.shape))


class _Task(NamedTuple):
    """What every round takes: the design, CIEDE2000 of each two yarns, least patch, cells that are kept."""

    rgb: Rgb
    gap: FloatArray
    least: int
    kept: BoolArray


def _round(knots: Indices, task: _Task, wanted: BoolArray, dotted: BoolArray, progress: Progress) -> BoolArray:
    """Merge the patches of the wanted tiles that are first of their neighbours; the tiles where work remains.

    Windows of rows, with a margin above and below, are copies of the chart at the begin of the round, so that the
    result does not depend on the windows, nor on the threads.
    """
    side, margin = _side(task.least), _margin(task.least)
    rows = margin * side
    again = np.zeros_like(wanted)
    parts = list(bands(len(wanted), side * knots.shape[1], max(_WINDOW, rows * knots.shape[1])))
    above = knots[:0]
    for first in range(0, len(parts), MOST_THREADS):
        works = []
        for tiles in parts[first : first + MOST_THREADS]:
            start, stop = tiles.start * side, min(tiles.stop * side, len(knots))
            near = wanted[max(tiles.start - margin, 0) : tiles.stop + margin]
            if near.any():
                part = np.concatenate([above, knots[start : stop + rows]])
                works.append(
                    _Window(part, start - len(above), len(above), knots[start:stop], near, again[tiles], dotted[tiles])
                )
            above = knots[max(stop - rows, 0) : stop].copy()
        for _ in in_threads(lambda window: _merge_window(task, window), works):
            progress(stop / len(knots))
    return again


def _merge_window(task: _Task, window: _Window) -> None:
    least, side, rooms = task.least, _side(task.least), _rooms(task.least, len(task.gap))
    sizes = np.zeros(window.knots.shape, dtype=np.uint8)
    starts, targets = np.empty(window.knots.size, dtype=np.int32), np.empty(window.knots.size, dtype=np.uint8)
    rgb, kept = task.rgb[window.first : window.first + len(window.knots)], task.kept[window.first // CELL :]
    loose = _judge(window, rgb, task.gap, least, side, kept, rooms, sizes, starts, targets)
    rooms.marks[:] = 0
    _merge(window, least, side, rooms.members, rooms.marks, sizes, starts[:loose], targets[:loose])


def _side(least: int) -> int:
    """Side of a tile: no judgement but that of a row of dots depends on a knot as far away; a whole number of cells."""
    return 2 * least + 2 * RADIUS


def _margin(least: int) -> int:
    """Tiles from a patch to the furthest knot on which a judgement depends."""
    return -(-(REACH + 4 * least) // _side(least))
