"""Carrying: an edit that counts the knots of one grid, as edits of another grid of the same design.

A knot of an enlarged design is all the knots that lie in it. On a reduced design a detail, a group of neighbouring
knots, is kept where it is as long as a knot or covers half of one, else left out. A fill is carried by its area, not by
its knot: the area of one yarn that has most in common with it is filled, if that is at least half of both together.
"""

from dataclasses import replace

import numpy as np
import scipy

from ilmek.arrays import Bool, Indices, Int32, IntArray
from ilmek.carpet.recipe.edits import Edit, Knot, line_knots, stroke_knots
from ilmek.carpet.recipe.structure import GridRelation, Patch
from ilmek.records import record

BELOW = "it is smaller than a knot there"
NOWHERE = "the carpet shows nothing of its place"

_SAME = 0.5
"""Least share that two areas have in common of both together where one is taken for the other."""

_EIGHT = np.ones((3, 3), dtype=int)
_CELLS = ("set", "line", "stroke", "half")

Mask = Bool[np.ndarray, "rows columns"]


@record
class PlacedKnots:
    """Knots of the new grid, from its upper left corner, and how many details they show, and how many not.

    below  of those that are not shown, how many are too small
    """

    rows: IntArray
    columns: IntArray
    details: tuple[int, int]
    below: int

    @property
    def reason(self) -> str:
        """Why details are left out."""
        return "" if not self.details[1] else BELOW if self.below else NOWHERE

    @property
    def corners(self) -> tuple[int, int, int, int]:
        """Its first and last row, first and last column."""
        rows, columns = self.rows, self.columns
        return int(rows.min()), int(rows.max()), int(columns.min()), int(columns.max())


@record
class Carried:
    """An edit on the new grid.

    edits    that take its place; none: it is left out      details, reason  as of an outcome
    """

    edits: tuple[Edit, ...]
    details: tuple[int, int] = (1, 0)
    reason: str = ""


def placed(relation: GridRelation, rows: IntArray, columns: IntArray, *, least: bool = True) -> PlacedKnots:
    """The knots of the new grid at the place of knots of the old one.

    rows, columns  from the upper left corner      least  details below a knot are left out
    """
    top, left = int(rows.min()), int(columns.min())
    cells = np.zeros((int(rows.max()) - top + 1, int(columns.max()) - left + 1), dtype=bool)
    cells[rows - top, columns - left] = True
    area = slice(top, top + cells.shape[0]), slice(left, left + cells.shape[1])
    owners = None if relation.owners is None else relation.owners[area]
    found: list[tuple[IntArray, IntArray]] = []
    shown, below = np.zeros_like(cells), np.zeros_like(cells)
    for number, patch in enumerate(relation.patches):
        own = cells if owners is None else cells & (owners == patch.part)
        if not own.any():
            continue
        large = own if not least else own & ~_small(own, patch)
        below |= own & ~large
        at, seen = _in_patch(large, (top, left), patch, relation.covered, number)
        found.append(at)
        shown |= large & seen
    labels, count = scipy.ndimage.label(cells, _EIGHT)
    kept = np.unique(labels[shown])
    lost = [group for group in np.unique(labels[below]).tolist() if group not in kept]
    joined = [np.concatenate([one[way] for one in found] or [np.empty(0, dtype=np.int64)]) for way in (0, 1)]
    return PlacedKnots(joined[0], joined[1], (count, count - len(kept)), len(lost))


def _small(cells: Mask, patch: Patch) -> Mask:
    """The cells of the details that are below a knot of the new grid."""
    down, across = patch.rows.scale, patch.columns.scale
    if min(down, across) >= 1.0:
        return np.zeros_like(cells)
    labels, _ = scipy.ndimage.label(cells, _EIGHT)
    sizes = np.bincount(labels.ravel())
    small = [False]
    for number, box in enumerate(scipy.ndimage.find_objects(labels), 1):
        height, width = (part.stop - part.start for part in box)
        longest = max(height * down, width * across)
        small.append(longest < 1.0 - 1e-9 and sizes[number] * down * across < _SAME - 1e-9)
    return np.asarray(np.array(small)[labels])


def _in_patch(
    cells: Mask, first: tuple[int, int], patch: Patch, covered: IntArray, number: int
) -> tuple[tuple[IntArray, IntArray], Mask]:
    """Rows and columns of the knots of a patch that have any of the cells, and which cells these have."""
    lines, begins, ends = [], [], []
    for axis, low, size in zip((patch.rows, patch.columns), first, cells.shape, strict=True):
        found = np.flatnonzero((axis.last > low) & (axis.first < low + size) & (axis.last > axis.first))
        lines.append(axis.begin + found)
        begins.append(np.clip(axis.first[found] - low, 0, size))
        ends.append(np.clip(axis.last[found] - low, 0, size))
    total: Int32[np.ndarray, "high wide"] = np.zeros((cells.shape[0] + 1, cells.shape[1] + 1), dtype=np.int32)
    total[1:, 1:] = cells.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32)
    rows = total[ends[0]] - total[begins[0]]
    hit = (rows[:, ends[1]] - rows[:, begins[1]] > 0) & (covered[np.ix_(*lines)] == number)
    at = np.nonzero(hit)
    steps = np.zeros((cells.shape[0] + 1, cells.shape[1] + 1), dtype=np.int64)
    for down, sign in ((begins[0], 1), (ends[0], -1)):
        for across, other in ((begins[1], sign), (ends[1], -sign)):
            np.add.at(steps, (down[at[0]], across[at[1]]), other)
    seen = steps.cumsum(axis=0).cumsum(axis=1)[:-1, :-1] > 0
    return (lines[0][at[0]], lines[1][at[1]]), seen


def carry(edit: Edit, relation: GridRelation, old: Indices | None, new: Indices, yarns: tuple[int, ...]) -> Carried:
    """An edit that counts the knots of the old grid as edits of the new one.

    old    knots of the design on the old grid, with the edits before; None: they are not known
    new    knots of the chart, with the edits before      yarns  indices in the chart, as of `named_yarns`
    """
    if edit.kind == "fill":
        return _fill(edit, relation, old, new)
    if edit.kind in _CELLS:
        return _of_cells(edit, relation, new, yarns)
    if edit.kind in ("replace", "jufti"):
        return _of_parts(edit, relation, new.shape)
    if not edit.knots:
        width = max(edit.width and 1, round(edit.width * _factor(new.shape, relation.grid)))
        return Carried((replace(edit, width=width),))
    corners = (*edit.knots, *edit.knots[-1:]) if len(edit.knots) % 2 else edit.knots  # the place of a copy is one knot
    parts = [_between(corners[first : first + 2], relation.grid) for first in range(0, len(corners), 2)]
    places = [placed(relation, *part, least=part[0].size > 1) for part in parts]
    empty = next((place for place in places if not place.rows.size), None)
    if empty is not None:
        return Carried((), (1, 1), empty.reason)
    (top, bottom, left, right), (rows, columns) = places[-1].corners, parts[-1]
    size = _factor((bottom - top + 1, right - left + 1), (int(np.ptp(rows)) + 1, int(np.ptp(columns)) + 1))
    knots = tuple(knot for place in places for knot in _corners(place.corners, len(new)))
    return Carried((replace(edit, knots=knots, width=max(edit.width and 1, round(edit.width * size))),))


def _of_parts(edit: Edit, relation: GridRelation, shape: tuple[int, ...]) -> Carried:
    """A yarn that is replaced, or jufti knots, within a rectangle: within each connected part of its place."""
    if not edit.knots and relation.owners is not None:
        return Carried((edit,))
    place = placed(relation, *_cells(edit, relation.grid))
    boxes = [box for box in _boxes(place, shape) if edit.kind == "replace" or box[3] > box[2]]
    if not boxes:
        return Carried((), (1, 1), place.reason or BELOW)
    return Carried(tuple(replace(edit, knots=_corners(box, shape[0])) for box in boxes), place.details, place.reason)


def _of_cells(edit: Edit, relation: GridRelation, new: Indices, yarns: tuple[int, ...]) -> Carried:
    """A set, a line, a stroke or a half knot."""
    rows, columns = _cells(edit, relation.grid)
    place = placed(relation, rows, columns)
    if not place.rows.size:
        return Carried((), place.details, place.reason)
    at = np.unique(np.stack([place.rows, place.columns], axis=1), axis=0)
    if edit.kind != "half":
        found = tuple((len(new) - row, column + 1) for row, column in at.tolist())
        return Carried((replace(edit, kind="set", knots=found),), place.details, place.reason)
    halves = [(len(new) - row, column + 1) for row, column in at.tolist() if new[row, column] != yarns[0]]
    reason = place.reason or ("" if halves else "its cells have this yarn already")
    return Carried(tuple(replace(edit, knots=(knot,)) for knot in halves), place.details, reason)


def _cells(edit: Edit, grid: tuple[int, int]) -> tuple[IntArray, IntArray]:
    """Rows and columns of the knots that an edit gives, from the upper left corner."""
    at = [(grid[0] - row, column - 1) for row, column in edit.knots]
    if edit.kind == "line":
        return line_knots(*at)
    if edit.kind == "stroke":
        return stroke_knots(at, edit.width, grid)
    if edit.kind in ("replace", "jufti") and len(at) != 1:
        return _between(edit.knots or ((1, 1), grid), grid)
    if edit.kind == "jufti":
        at.append((at[0][0], min(at[0][1] + 1, grid[1] - 1)))
    rows, columns = np.array(at).T
    return rows, columns


def _between(knots: tuple[Knot, ...], grid: tuple[int, int]) -> tuple[IntArray, IntArray]:
    """Rows and columns of all knots between two opposite corners, from the upper left corner."""
    (low, left), (high, right) = np.sort(np.array(knots), axis=0).tolist()
    rows, columns = np.mgrid[grid[0] - high : grid[0] - low + 1, left - 1 : right]
    return rows.ravel(), columns.ravel()


def _corners(box: tuple[int, int, int, int], rows: int) -> tuple[Knot, Knot]:
    """Lower left and upper right corner of a box of rows and columns, as edits count them."""
    top, bottom, left, right = box
    return (rows - bottom, left + 1), (rows - top, right + 1)


def _factor(new: tuple[int, ...], old: tuple[int, ...]) -> float:
    """How many times longer a part is: the root of the ratio of the areas."""
    return float(np.sqrt(new[0] * new[1] / (old[0] * old[1])))


def _fill(edit: Edit, relation: GridRelation, old: Indices | None, new: Indices) -> Carried:
    ((row, column),) = ((relation.grid[0] - row, column - 1) for row, column in edit.knots)
    if old is None:
        boxes = _boxes(placed(relation, np.array([row]), np.array([column]), least=False), new.shape)
        seeds = (((top + bottom) // 2, (left + right) // 2) for top, bottom, left, right in boxes)
        found = tuple(replace(edit, knots=((len(new) - down, across + 1),)) for down, across in seeds)
        return Carried(found, (1, 0 if found else 1), "" if found else NOWHERE)
    labels, _ = scipy.ndimage.label(old == old[row, column])
    place = placed(relation, *np.nonzero(labels == labels[row, column]))
    if not place.rows.size:
        return Carried((), (1, 1), place.reason)
    yarn = int(np.bincount(new[place.rows, place.columns]).argmax())
    areas, _ = scipy.ndimage.label(new == yarn)
    counts = np.bincount(areas[place.rows, place.columns])
    counts[0] = 0
    area = int(counts.argmax())
    common, size = int(counts[area]), int(np.count_nonzero(areas == area))
    share = common / (size + place.rows.size - common)
    if share < _SAME:
        reason = f"no area of one yarn is like the one it fills: the nearest has {share:.0%} in common with it"
        return Carried((), (1, 1), reason)
    inside = np.flatnonzero(areas[place.rows, place.columns] == area)[0]
    seed = len(new) - int(place.rows[inside]), int(place.columns[inside]) + 1
    return Carried((replace(edit, knots=(seed,)),))


def _boxes(place: PlacedKnots, shape: tuple[int, ...]) -> list[tuple[int, int, int, int]]:
    """First and last row, first and last column of each connected part of a place."""
    if not place.rows.size:
        return []
    mask = np.zeros(shape, dtype=bool)
    mask[place.rows, place.columns] = True
    found = scipy.ndimage.find_objects(scipy.ndimage.label(mask, _EIGHT)[0])
    return [(down.start, down.stop - 1, across.start, across.stop - 1) for down, across in found]
