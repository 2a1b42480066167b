"""Carried knots: the knots of a new grid at the place of knots of an old one, and how much of these has none.

A knot of an enlarged design is all the knots that lie in it. On a reduced design a detail, a group of neighbouring
knots, is kept where it is as long as a knot or covers half of one, else left out.
"""

import numpy as np
import scipy

from ilmek.arrays import Bool, Indices, Int32, IntArray, UInt8
from ilmek.carpet.recipe.structure import GridRelation, Patch
from ilmek.records import record

BELOW = "it is smaller than a knot there"
NOWHERE = "the carpet shows nothing of its place"
CROPPED = "the carpet does not show all of its place"

LEAST_COVER = 0.5
"""Least share of a knot that a detail covers where it is kept."""

EIGHT = np.ones((3, 3), dtype=int)
"""Neighbours of a knot, also by a corner."""

Mask = Bool[np.ndarray, "rows columns"]


@record
class PlacedKnots:
    """Knots of the new grid, from its upper left corner, and what of the old knots they show.

    cells    the old knots, within the rectangle about them      shown  of these
    details  groups of neighbouring ones, and how many of them are not shown at all      below  whether any is too small
    """

    rows: IntArray
    columns: IntArray
    cells: Mask
    shown: Mask
    details: tuple[int, int]
    below: bool

    @property
    def lost(self) -> float:
        """Share of the old knots that is not shown."""
        return lost_share(int(np.count_nonzero(self.shown)), int(np.count_nonzero(self.cells)))

    @property
    def reason(self) -> str:
        """Why some are not shown; "": all are."""
        if not self.lost:
            return ""
        return BELOW if self.below else CROPPED if self.shown.any() else NOWHERE

    @property
    def corners(self) -> tuple[int, int, int, int]:
        """Its first and last row, first and last column."""
        rows, columns = self.rows, self.columns
        return int(rows.min()), int(rows.max()), int(columns.min()), int(columns.max())


def lost_share(shown: int, count: int) -> float:
    """Share that is not shown of a number of knots.

    >>> lost_share(3, 4)
    0.25
    """
    return (count - shown) / count


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
        own, first = (own.T, (left, top)) if patch.transposed else (own, (top, left))
        large = own if not least else own & ~_small(own, patch)
        knots, seen = _in_patch(large, first, patch, relation.covered, number)
        found.append(knots)
        for all_cells, of_patch in ((shown, large & seen), (below, own & ~large)):
            all_cells |= of_patch.T if patch.transposed else of_patch
    labels, count = scipy.ndimage.label(cells, EIGHT)
    details = count, count - len(np.unique(labels[shown]))
    joined = [np.concatenate([indices[axis] for indices in found] or [np.empty(0, dtype=np.int64)]) for axis in (0, 1)]
    return PlacedKnots(joined[0], joined[1], cells, shown, details, bool((below & ~shown).any()))


def _small(cells: Mask, patch: Patch) -> Mask:
    """The cells of the details that are below a knot of the new grid."""
    down, across = patch.rows.scale, patch.columns.scale
    if min(down, across) >= 1.0:
        return np.zeros_like(cells)
    labels, _ = scipy.ndimage.label(cells, EIGHT)
    sizes = np.bincount(labels.ravel())
    small = [False]
    for number, box in enumerate(scipy.ndimage.find_objects(labels), 1):
        height, width = (part.stop - part.start for part in box)
        longest = max(height * down, width * across)
        small.append(longest < 1.0 - 1e-9 and sizes[number] * down * across < LEAST_COVER - 1e-9)
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


def tile_knots(relation: GridRelation, new: Indices) -> UInt8[np.ndarray, "tile_rows tile_columns"]:
    """The knots of a tile as the new grid shows them; one that it does not show is as the nearest that it does."""
    known = np.zeros(relation.grid, dtype=bool)
    old = np.zeros(relation.grid, dtype=np.uint8)
    for number, patch in enumerate(relation.patches):
        down, across = patch.area
        held = relation.covered[patch.area] == number
        held &= (patch.rows.last > patch.rows.first)[:, None] & (patch.columns.last > patch.columns.first)
        rows, columns = np.nonzero(held)
        cells = patch.rows.first[rows], patch.columns.first[columns]
        cells = cells[::-1] if patch.transposed else cells
        old[cells], known[cells] = new[down, across][rows, columns], True
    nearest = scipy.ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
    return np.asarray(old[tuple(nearest)])
