"""Carrying: an edit that counts the knots of one grid, as edits of another grid of the same design.

Knots are carried to their place [`carried_knots`]. A fill is carried by its area, not by its knot: the areas of one
yarn that lie at its place are filled, if at least half of both together is common. Of a rectangle that is reflected or
copied, what has its source and its place on the carpet is carried [`carried_areas`].
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import scipy

from ilmek.arrays import Indices, IntArray, UInt8
from ilmek.carpet.recipe.carried import Box, Carried, between, corner_knots, left_out, set_knots
from ilmek.carpet.recipe.carried_areas import carry_area
from ilmek.carpet.recipe.carried_knots import BELOW, EIGHT, NOWHERE, Mask, PlacedKnots, placed, tile_knots
from ilmek.carpet.recipe.edits import Edit, Knot, line_knots, stroke_knots
from ilmek.carpet.recipe.structure import GridRelation

_SAME = 0.5
"""Least share that two areas have in common of both together where one is taken for the other."""

OldKnots = UInt8[np.ndarray, "old_rows old_columns"]
"""Yarns on the old grid."""

_CELLS = ("set", "line", "stroke", "half")


def carry(edit: Edit, relation: GridRelation, old: OldKnots | None, new: Indices, yarns: tuple[int, ...]) -> Carried:
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
    return carry_area(edit, relation, new.shape)


def _of_parts(edit: Edit, relation: GridRelation, shape: tuple[int, ...]) -> Carried:
    """A yarn that is replaced, or jufti knots, within a rectangle: within the rectangles that make its place."""
    if not edit.knots and relation.owners is not None:
        return Carried((edit,))
    place = placed(relation, *_cells(edit, relation.grid))
    boxes = [box for box in _rectangles(_mask(place, shape)) if edit.kind == "replace" or box[3] > box[2]]
    if not boxes:
        return left_out(place.reason or BELOW)
    edits = tuple(replace(edit, knots=corner_knots(box, shape[0])) for box in boxes)
    return Carried(edits, place.details, place.reason, place.lost)


def _of_cells(edit: Edit, relation: GridRelation, new: Indices, yarns: tuple[int, ...]) -> Carried:
    """A set, a line, a stroke or a half knot."""
    place = placed(relation, *_cells(edit, relation.grid))
    if edit.kind != "half" or not place.rows.size:
        return set_knots(edit, place, len(new))
    at = np.unique(np.stack([place.rows, place.columns], axis=1), axis=0)
    halves = [(len(new) - row, column + 1) for row, column in at.tolist() if new[row, column] != yarns[0]]
    reason = place.reason or ("" if halves else "its cells have this yarn already")
    return Carried(tuple(replace(edit, knots=(knot,)) for knot in halves), place.details, reason, place.lost)


def _cells(edit: Edit, grid: tuple[int, int]) -> tuple[IntArray, IntArray]:
    """Rows and columns of the knots that an edit gives, from the upper left corner."""
    at = [(grid[0] - row, column - 1) for row, column in edit.knots]
    if edit.kind == "line":
        return line_knots(*at)
    if edit.kind == "stroke":
        return stroke_knots(at, edit.width, grid)
    if edit.kind in ("replace", "jufti") and len(at) != 1:
        return between(edit.knots or ((1, 1), grid), grid)
    if edit.kind == "jufti":
        at.append((at[0][0], min(at[0][1] + 1, grid[1] - 1)))
    rows, columns = np.array(at).T
    return rows, columns


def _fill(edit: Edit, relation: GridRelation, old: OldKnots | None, new: Indices) -> Carried:
    ((row, column),) = ((relation.grid[0] - row, column - 1) for row, column in edit.knots)
    if relation.is_tile:
        tile = tile_knots(relation, new)
        labels, _ = scipy.ndimage.label(tile == tile[row, column])
        return set_knots(edit, placed(relation, *np.nonzero(labels == labels[row, column])), len(new))
    if old is None:
        place = placed(relation, np.array([row]), np.array([column]), least=False)
        found = tuple(replace(edit, knots=(knot,)) for knot in _seeds(_mask(place, new.shape)))
        return Carried(found) if found else left_out(NOWHERE)
    labels, _ = scipy.ndimage.label(old == old[row, column])
    place = placed(relation, *np.nonzero(labels == labels[row, column]))
    if not place.rows.size:
        return left_out(place.reason)
    yarn = int(np.bincount(new[place.rows, place.columns]).argmax())
    areas, _ = scipy.ndimage.label(new == yarn)
    of_place = areas[place.rows, place.columns]
    sizes = np.bincount(areas.ravel())
    counts = np.bincount(of_place, minlength=len(sizes))
    counts[0] = 0
    alike = np.flatnonzero((counts > 0) & (counts >= _SAME * sizes))
    chosen = alike if alike.size else np.array([counts.argmax()])
    common, size = int(counts[chosen].sum()), int(sizes[chosen].sum())
    share = common / (size + place.rows.size - common)
    if share < _SAME:
        return left_out(f"no area of one yarn is like the one it fills: the nearest has {share:.0%} in common with it")
    firsts = (np.flatnonzero(of_place == area)[0] for area in chosen)
    seeds = ((len(new) - int(place.rows[first]), int(place.columns[first]) + 1) for first in firsts)
    return Carried(tuple(replace(edit, knots=(seed,)) for seed in seeds), (1, 0), place.reason, place.lost)


def _mask(place: PlacedKnots, shape: tuple[int, ...]) -> Mask:
    mask = np.zeros(shape, dtype=bool)
    mask[place.rows, place.columns] = True
    return mask


def _seeds(mask: Mask) -> Iterator[Knot]:
    """Of each connected part of a place the knot that is nearest to the middle of the rectangle about it."""
    labels, _ = scipy.ndimage.label(mask, EIGHT)
    for number, (down, across) in enumerate(scipy.ndimage.find_objects(labels), 1):
        rows, columns = np.nonzero(labels[down, across] == number)
        middle = (down.stop - down.start - 1) // 2, (across.stop - across.start - 1) // 2
        nearest = int(np.argmin((rows - middle[0]) ** 2 + (columns - middle[1]) ** 2))
        yield len(mask) - int(rows[nearest]) - down.start, int(columns[nearest]) + across.start + 1


def _rectangles(mask: Mask) -> Iterator[Box]:
    """Rectangles that make a place together: equal runs of rows that follow each other."""
    begun: dict[tuple[int, int], int] = {}
    steps = np.diff(mask.astype(np.int8), axis=1, prepend=0, append=0)
    rows = np.flatnonzero(mask.any(axis=1)).tolist()
    for row in range(rows[0], rows[-1] + 2) if rows else ():
        step = steps[row] if row < len(mask) else steps[0] * 0
        runs = set(zip(np.flatnonzero(step == 1).tolist(), (np.flatnonzero(step == -1) - 1).tolist(), strict=True))
        for run in sorted(begun.keys() - runs):
            yield begun.pop(run), row - 1, *run
        begun |= dict.fromkeys(runs - begun.keys(), row)
