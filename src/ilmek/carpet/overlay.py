"""Overlay of a chart: the knots that are not tied on the two warps of one cell.

A cell of the chart is a pair of neighbouring warps, left and right, and stands for one knot on both of them. Two kinds
of knots are tied on other numbers of warps:

    half   a cell with two half knots: one on its left warp in the cell's own yarn, one on its right warp in a second
           yarn. A half knot is a knot on a single warp, one and a half turns around it. It doubles the resolution of an
           outline across the carpet.
    jufti  one knot on four warps: two neighbouring cells of a row, of one yarn. The cell at the left has the mark.

Both are named beside the usual knots in the definition of heading 5701 of the Harmonized System: a knot is tied on two
warps, "may also cover four warp threads", or is a single-warp knot of one and a half turns. The kinds of knots, in
section: `ilmek.weaving.knots.word`. Lengths of yarn: `ilmek.carpet.pile.knot_length`.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, Indices, Int32, UInt8
from ilmek.carpet.codes import NO_KNOT
from ilmek.errors import CarpetError
from ilmek.records import record

HALF, JUFTI = 1, 2
"""Kinds of marks."""

MOST_MARKS = 2_000_000
"""Largest number of marks of a chart."""


class KnotMark(NamedTuple):
    """A mark of the overlay: row and column of its cell, from 0 at the top left as in `Chart.knots`; kind; and of a
    half knot the index of its second yarn, that of the right warp.
    """

    row: int
    column: int
    kind: int
    second: int = 0


class TiedKnots(NamedTuple):
    """Numbers of knots to tie of each yarn, in the order of the list: whole (on two warps), half and jufti."""

    whole: tuple[int, ...]
    half: tuple[int, ...]
    jufti: tuple[int, ...]

    def of(self, yarn: int) -> int:
        """All knots of a yarn."""
        return self.whole[yarn] + self.half[yarn] + self.jufti[yarn]

    @property
    def total(self) -> int:
        """All knots of all yarns."""
        return sum(sum(numbers) for numbers in self)


@record
class Overlay:
    """The marks of a chart, sorted by row and column: rows, columns, kinds, second yarns."""

    rows: Int32[np.ndarray, " marks"]
    columns: Int32[np.ndarray, " marks"]
    kinds: UInt8[np.ndarray, " marks"]
    seconds: UInt8[np.ndarray, " marks"]

    def __len__(self) -> int:
        """Number of marks."""
        return len(self.rows)

    def __iter__(self) -> Iterator[KnotMark]:
        """The marks in order."""
        arrays = (self.rows, self.columns, self.kinds, self.seconds)
        return (KnotMark(*mark) for mark in zip(*(array.tolist() for array in arrays), strict=True))

    def with_yarns(self, moved: UInt8[np.ndarray, " yarns"]) -> "Overlay":
        """The same marks with other numbers of the yarns: `moved` has the new number of each."""
        return replace(self, seconds=np.where(self.kinds == HALF, moved[self.seconds], 0).astype(np.uint8))

    @property
    def halves(self) -> int:
        """Number of cells with two half knots."""
        return int(np.count_nonzero(self.kinds == HALF))

    @property
    def juftis(self) -> int:
        """Number of knots on four warps."""
        return int(np.count_nonzero(self.kinds == JUFTI))

    def between(self, first: int, stop: int) -> "Overlay":
        """The marks of the rows first to stop - 1."""
        return self.only(slice(*np.searchsorted(self.rows, (first, stop)).tolist()))

    def only(self, part: slice | BoolArray) -> "Overlay":
        """Some of the marks."""
        return Overlay(self.rows[part], self.columns[part], self.kinds[part], self.seconds[part])

    def equals(self, other: "Overlay") -> bool:
        """Whether both have the same marks."""
        names = ("rows", "columns", "kinds", "seconds")
        return all(np.array_equal(getattr(self, name), getattr(other, name)) for name in names)


def overlay_of(marks: Iterable[KnotMark | tuple[int, int, int, int]]) -> Overlay:
    """The overlay of some marks, in any order; whether they fit a chart, `require_fit` checks.

    Raises CarpetError for more than MOST_MARKS, and for numbers out of the bounds of any chart.

    >>> list(overlay_of([KnotMark(2, 0, JUFTI), KnotMark(1, 5, HALF, 3)]))
    [KnotMark(row=1, column=5, kind=1, second=3), KnotMark(row=2, column=0, kind=2, second=0)]
    """
    table = sorted(tuple(mark) for mark in marks)
    if len(table) > MOST_MARKS:
        raise CarpetError(f"an overlay of {len(table):,} half knots and jufti knots", allowed=f"at most {MOST_MARKS:,}")
    numbers = np.array(table, dtype=np.int64).reshape(-1, 4)
    most = np.array([np.iinfo(np.int32).max, np.iinfo(np.int32).max, JUFTI, 255])
    if ((numbers < (0, 0, HALF, 0)) | (numbers > most)).any():
        raise CarpetError("a mark of the overlay is out of bounds", allowed="a cell, half or jufti")
    rows, columns, kinds, seconds = numbers.T
    return Overlay(
        rows.astype(np.int32),
        columns.astype(np.int32),
        kinds.astype(np.uint8),
        np.where(kinds == HALF, seconds, 0).astype(np.uint8),
    )


def no_overlay() -> Overlay:
    """The overlay without a mark: every knot is tied on two warps."""
    return overlay_of(())


def require_fit(overlay: Overlay, knots: Indices, yarns: int) -> None:
    """Raise CarpetError for an overlay that does not fit a chart of knots (rows, columns) and a number of yarns.

    Every mark is inside the chart and each cell has at most one; both cells of a jufti knot have one yarn; the second
    yarn of a half knot is of the list and differs from that of its cell.
    """
    _require_arrays(overlay)
    if not len(overlay):
        return
    rows, columns, jufti = overlay.rows.astype(np.int64), overlay.columns.astype(np.int64), overlay.kinds == JUFTI
    width = knots.shape[1]
    outside = (rows < 0) | (rows >= knots.shape[0]) | (columns < 0) | (columns + jufti >= width)
    _refuse(overlay, outside, knots, "is outside of the chart", f"{knots.shape[0]} rows of {width} knots")
    cells = rows * width + columns
    near = np.diff(cells) < np.where(jufti[:-1], 2, 1)
    _refuse(overlay, np.append(False, near), knots, "overlaps the one before it", "one half or jufti knot in a cell")
    flat = knots.reshape(-1)
    unlike = jufti & (flat[cells] != flat[cells + jufti])
    _refuse(overlay, flat[cells] == NO_KNOT, knots, "has no knot", "marks of knots only")
    _refuse(overlay, unlike, knots, "has two yarns", "a jufti knot covers two cells of one yarn")
    second = (overlay.kinds == HALF) & ((overlay.seconds >= yarns) | (overlay.seconds == flat[cells]))
    _refuse(overlay, second, knots, "has no second yarn of its own", "another yarn of the list on its right warp")


def _require_arrays(overlay: object) -> None:
    """Raise CarpetError unless the arrays of an overlay are of its types, one long, and of marks of the two kinds."""
    if not isinstance(overlay, Overlay):
        raise CarpetError(
            f"the overlay is a {type(overlay).__name__}", allowed="an Overlay", do="`overlay_of` makes it"
        )
    types = {"rows": np.int32, "columns": np.int32, "kinds": np.uint8, "seconds": np.uint8}
    for name, expected in types.items():
        array = getattr(overlay, name)
        if not isinstance(array, np.ndarray) or array.dtype != expected or array.shape != overlay.kinds.shape:
            allowed = f"one {np.dtype(expected)} for each mark"
            raise CarpetError(f"{name} of the overlay cannot be used", allowed=allowed, do="`overlay_of` makes it")
    if overlay.kinds.ndim != 1 or not np.isin(overlay.kinds, (HALF, JUFTI)).all():
        raise CarpetError("a mark of the overlay has no kind", allowed=f"{HALF} (half) or {JUFTI} (jufti)")


def _refuse(overlay: Overlay, bad: np.ndarray, knots: Indices, what: str, allowed: str) -> None:
    """Raise CarpetError for the first mark that is bad; rows are counted from the bottom, knots from the left."""
    if bad.any():
        mark = int(np.argmax(bad))
        name = "half knot" if overlay.kinds[mark] == HALF else "jufti knot"
        row, column = len(knots) - int(overlay.rows[mark]), int(overlay.columns[mark]) + 1
        raise CarpetError(f"the {name} at row {row}, knot {column} {what}", allowed=allowed)


def tied_knots(overlay: Overlay, knots: Indices, counts: tuple[int, ...]) -> TiedKnots:
    """The knots to tie of each yarn of a chart.

    counts  cells of each yarn
    A half cell is a half knot of each of its two yarns; a jufti knot is one knot on two cells.
    """
    cells = overlay.rows.astype(np.int64) * knots.shape[1] + overlay.columns
    own, halves = knots.reshape(-1)[cells], overlay.kinds == HALF
    most = len(counts)
    left, jufti = np.bincount(own[halves], minlength=most), np.bincount(own[~halves], minlength=most)
    right = np.bincount(overlay.seconds[halves], minlength=most)
    whole = np.array(counts, dtype=np.int64) - left - 2 * jufti
    return TiedKnots(tuple(whole.tolist()), tuple((left + right).tolist()), tuple(jufti.tolist()))
