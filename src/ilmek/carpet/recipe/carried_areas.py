"""Carrying of edits that act on the carpet or on a rectangle: mirror, repeat, copy, move and border.

Where the carpet shows a rectangle only in part, what is carried is the part that comes out as on the old grid:

    mirror  knots whose reflections are shown, too, so that the axis stays where it was
    repeat  the part of the rectangle, if the whole tile is shown
    copy    knots that are shown where they are copied from and where they are copied to; of `move` the same
    border  knot by knot, so that a side that is cropped is not drawn at the edge of the carpet
"""

from dataclasses import replace

import numpy as np

from ilmek.arrays import IntArray
from ilmek.carpet.recipe.border import edges
from ilmek.carpet.recipe.carried import Box, Carried, between, corner_knots, left_out, set_knots
from ilmek.carpet.recipe.carried_knots import Mask, PlacedKnots, lost_share, placed
from ilmek.carpet.recipe.copies import transformed
from ilmek.carpet.recipe.edits import Edit, Knot
from ilmek.carpet.recipe.structure import GridRelation


def carry_area(edit: Edit, relation: GridRelation, new: tuple[int, ...]) -> Carried:
    """An edit of the kinds above on another grid; new: rows and columns of that."""
    if not edit.knots:
        return Carried((_widened(edit, _factor(new, relation.grid)),))
    if edit.kind in ("copy", "move"):
        return _copied(edit, relation, new[0])
    tile, part = edit.knots[:-2], edit.knots[-2:]
    if edit.kind == "repeat" and not tile:  # over the whole carpet
        tile, part = part, ()
    for corners in (tile,) if tile else ():
        if (found := _placed(corners, relation)).lost:
            return left_out(found.reason)
    place = _placed(part, relation) if part else None
    lost, reason = 0.0, ""
    if place is not None and place.lost:
        if edit.kind == "border":
            return _ring(edit, relation, new[0])
        kept = _kept(edit, place.shown)
        lost, reason = lost_share(int(np.count_nonzero(kept)), kept.size), place.reason
        if not kept.any():
            return left_out(place.reason)
        part = _within(_box(kept), part, relation.grid)
    return Carried((_at(replace(edit, knots=(*tile, *part)), relation, new[0]),), (1, 0), reason, lost)


def _kept(edit: Edit, shown: Mask) -> Mask:
    """The knots of a rectangle on which an edit comes out as on the old grid."""
    kept = shown
    if edit.direction in ("across", "both"):
        kept = kept & kept[:, ::-1]
    if edit.direction in ("along", "both"):
        kept = kept & kept[::-1]
    return kept


def _copied(edit: Edit, relation: GridRelation, rows: int) -> Carried:
    """A copy or a move, of which each knot counts once."""
    grid, part, to = relation.grid, edit.knots[:2], edit.knots[2]
    source = _placed(part, relation)
    number: IntArray = np.arange(source.cells.size).reshape(source.cells.shape)
    moved = transformed(number, edit.direction, edit.turned)
    bottom, left = grid[0] - to[0], to[1] - 1
    moved = moved[max(len(moved) - 1 - bottom, 0) :, : grid[1] - left]
    target = (to, (to[0] + len(moved) - 1, to[1] + moved.shape[1] - 1))
    place = _placed(target, relation)
    kept = place.shown & source.shown.ravel()[moved]
    if not kept.any():
        return left_out(source.reason or place.reason)
    if kept.all():
        return Carried((_at(edit, relation, rows),))
    box = _box(kept)
    whole = moved[box[0] : box[1] + 1, box[2] : box[3] + 1]
    down, across = np.divmod(whole, source.cells.shape[1])
    part = _within((int(down.min()), int(down.max()), int(across.min()), int(across.max())), part, grid)
    target = _within(box, target, grid)
    carried = _at(replace(edit, knots=(*part, target[0])), relation, rows)
    lost = lost_share(int(np.count_nonzero(kept)), kept.size)
    return Carried((carried,), (1, 0), source.reason or place.reason, lost)


def _ring(edit: Edit, relation: GridRelation, rows: int) -> Carried:
    """A border knot by knot."""
    down, across = between(edit.knots, relation.grid)
    high, wide = int(np.ptp(down)) + 1, int(np.ptp(across)) + 1
    drawn = np.zeros((high, wide), dtype=bool)
    for side in edges(high, wide, (min(edit.width, high), min(edit.width, wide))):
        drawn[side] = True
    place = placed(relation, down[drawn.ravel()], across[drawn.ravel()])
    return set_knots(edit, place, rows)


def _at(edit: Edit, relation: GridRelation, rows: int) -> Edit:
    """An edit whose rectangles are shown, on the new grid."""
    corners = (*edit.knots, *edit.knots[-1:]) if len(edit.knots) % 2 else edit.knots  # the place of a copy is one knot
    pairs = [corners[first : first + 2] for first in range(0, len(corners), 2)]
    places = [_placed(pair, relation) for pair in pairs]
    (top, bottom, left, right), (high, wide) = places[-1].corners, places[-1].cells.shape
    knots = tuple(knot for place in places for knot in corner_knots(place.corners, rows))
    return _widened(replace(edit, knots=knots), _factor((bottom - top + 1, right - left + 1), (high, wide)))


def _placed(corners: tuple[Knot, ...], relation: GridRelation) -> PlacedKnots:
    """The place of a rectangle; of one knot the place is shown, however small the knot is."""
    rows, columns = between(corners, relation.grid)
    return placed(relation, rows, columns, least=rows.size > 1)


def _box(kept: Mask) -> Box:
    rows, columns = (np.flatnonzero(kept.any(axis=axis)) for axis in (1, 0))
    return int(rows[0]), int(rows[-1]), int(columns[0]), int(columns[-1])


def _within(box: Box, corners: tuple[Knot, ...], grid: tuple[int, int]) -> tuple[Knot, Knot]:
    """Corners of a box of rows and columns of a rectangle."""
    rows, columns = between(corners, grid)
    top, left = int(rows.min()), int(columns.min())
    return corner_knots((box[0] + top, box[1] + top, box[2] + left, box[3] + left), grid[0])


def _widened(edit: Edit, factor: float) -> Edit:
    """An edit whose border is wider by a factor, at least one knot."""
    return replace(edit, width=max(edit.width and 1, round(edit.width * factor)))


def _factor(new: tuple[int, ...], old: tuple[int, ...]) -> float:
    """How many times longer a part is: the root of the ratio of the areas."""
    return float(np.sqrt(new[0] * new[1] / (old[0] * old[1])))
