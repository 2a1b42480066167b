"""Parts: grids over a part of a design that the carpet may show several times, and the knots on which they lie.

picture   of the field, also its reflections
motif     in each of its copies
border    its repeat as it stands on the upper side, in each repeat on all four sides; in the corners as it is continued
corner    the upper left one of a border with a picture of its own, and its reflections

Motifs that lie over a part hide it.
"""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import IntArray
from ilmek.carpet.recipe.anchor import BORDER, CORNER, MOTIF, Anchor
from ilmek.carpet.recipe.axis import LineMap, pictured, proportional
from ilmek.carpet.recipe.border import edges, repeat_lines
from ilmek.carpet.recipe.layout import BorderLayout
from ilmek.carpet.recipe.structure import (
    Area,
    DesignStructure,
    GridRelation,
    MotifCopy,
    Patch,
    mirrors,
    painted,
    shown_part,
    span,
)
from ilmek.errors import CarpetError

_UPPER, _LEFT = 0, 1


def relate_part(new: DesignStructure, anchor: Anchor) -> GridRelation:
    """The grid of an anchor on a part. Raises CarpetError for one that the recipe does not have."""
    if anchor.on == MOTIF:
        return relate_motif(new, anchor.number, anchor.grid)
    if anchor.on in (BORDER, CORNER):
        return _relate_border(new, anchor)
    assert anchor.grid is not None
    return relate_picture(new, anchor.grid)


def relate_picture(new: DesignStructure, grid: tuple[int, int]) -> GridRelation:
    """A grid over the picture of the field."""
    if new.recipe.picture is None:
        raise CarpetError("the recipe has no picture", do='write on = "carpet"')
    axes = [
        pictured(
            (0, grid[direction]),
            span(new.field[direction]),
            ((0.0, 1.0), shown_part(new.fit, direction)),
            mirror=mirrors(new.recipe, direction),
            copies=True,
        )
        for direction in (0, 1)
    ]
    covered = _uncovered(painted(new.grid, [new.field]), new.motifs)
    return GridRelation(grid, (Patch(axes[0], axes[1]),), None, covered)


def relate_motif(new: DesignStructure, number: int, grid: tuple[int, int] | None) -> GridRelation:
    """A grid over a motif, from 1; default: its knots."""
    if number > len(new.motifs):
        raise _missing("motif", number, len(new.motifs))
    return _of_copies(new, new.motifs[number - 1], grid, new.motifs[number:])


def _relate_border(new: DesignStructure, anchor: Anchor) -> GridRelation:
    if anchor.number > len(new.layout.borders):
        raise _missing("border", anchor.number, len(new.layout.borders))
    border = new.layout.borders[anchor.number - 1]
    if anchor.on == BORDER:
        return relate_border(new, border, anchor.grid)
    if border.border.corner is None:
        given = f"border {anchor.number} has no picture of its corner"
        raise CarpetError(given, do=f'write on = "border {anchor.number}", whose repeat is continued there')
    (top, left), (high, wide), (rows, columns) = border.inset, border.breadth, new.grid
    places = [
        (slice(top, top + high), slice(rows - top - high, rows - top)),
        (slice(left, left + wide), slice(columns - left - wide, columns - left)),
    ]
    copies = [
        MotifCopy((places[0][down], places[1][right]), (bool(down), bool(right))) for down in (0, 1) for right in (0, 1)
    ]
    return _of_copies(new, copies, anchor.grid, new.motifs)


def relate_border(new: DesignStructure, border: BorderLayout, grid: tuple[int, int] | None) -> GridRelation:
    """A grid over the repeat of a border; default: its knots on the upper side. A stripe repeats itself at every knot.

    The lines of the sides are those of `border.draw_border`: the upper and the lower side are one patch, the left and
    the right side another one, whose rows run along the border.
    """
    tile = border.tile or (1, 1)
    sides = grid or (border.breadth[0], tile[_UPPER])
    rows, columns = _along_side(new, border, _LEFT, sides[1]), _along_side(new, border, _UPPER, sides[1])
    upper = Patch(_across_side(new, border, 0, sides[0]), columns)
    left = Patch(rows, _across_side(new, border, 1, sides[0]), transposed=True)
    return GridRelation(sides, (upper, left), None, _uncovered(_border_sides(new, border), new.motifs), is_tile=True)


def _along_side(new: DesignStructure, border: BorderLayout, side: int, cells: int) -> LineMap:
    """Which lines of the repeat lie at each line along a side, from corner to corner."""
    inset, breadth, whole = border.inset[1 - side], border.breadth[1 - side], new.grid[1 - side]
    length = whole - 2 * inset
    if border.tile is None:
        drawn, tile = np.zeros(-(-length // 2), dtype=np.int64), 1
    else:
        tile = border.tile[side]
        drawn = repeat_lines(length - 2 * breadth, border.units[side], tile, breadth, border.motifs)
    lines = np.concatenate([drawn, drawn[: length // 2][::-1]])
    return _chosen(inset, lines, proportional((0, cells), (0, tile)))


def _across_side(new: DesignStructure, border: BorderLayout, direction: int, cells: int) -> LineMap:
    """Which lines of the repeat lie at each line across both sides: the rows of the upper and the lower one (0), or the
    columns of the left and the right one.
    """
    inset, breadth, whole = border.inset[direction], border.breadth[direction], new.grid[direction]
    lines = np.full(whole - 2 * inset, -1, dtype=np.int64)
    lines[:breadth] = np.arange(breadth)
    lines[len(lines) - breadth :] = np.arange(breadth)[::-1]
    return _chosen(inset, lines, proportional((0, cells), (0, breadth)))


def _chosen(begin: int, lines: IntArray, axis: LineMap) -> LineMap:
    """Lines of an axis, one after the other; -1: none."""
    known = lines >= 0
    return LineMap(begin, np.where(known, axis.first[lines], 0), np.where(known, axis.last[lines], 0), axis.scale)


def _border_sides(new: DesignStructure, border: BorderLayout) -> IntArray:
    """At each knot, on which side of a border it is drawn: 0 the upper and lower one, 1 the left and right one."""
    (top, left), (high, wide), (rows, columns) = border.inset, border.breadth, new.grid
    sides = painted(new.grid, [])
    ring = sides[top : rows - top, left : columns - left]
    for number, part in enumerate(edges(ring.shape[0], ring.shape[1], border.breadth)):
        ring[part] = number // 2
    row, column = np.arange(high)[:, None], np.arange(wide)[None]
    corner = ((2 * column + 1) * high < (2 * row + 1) * wide).astype(sides.dtype)
    if border.border.corner is not None:
        corner[:] = -1
    for down in (1, -1):
        for right in (1, -1):
            ring[::down, ::right][:high, :wide] = corner
    return sides


def _of_copies(
    new: DesignStructure,
    copies: Sequence[MotifCopy],
    grid: tuple[int, int] | None,
    above: Sequence[Sequence[MotifCopy]],
) -> GridRelation:
    """A grid over copies of a picture; default: their knots."""
    rows, columns = copies[0].area
    sides = grid or (rows.stop - rows.start, columns.stop - columns.start)
    axes = [
        [proportional((0, sides[axis]), span(copy.area[axis]), reflected=copy.reflected[axis]) for axis in (0, 1)]
        for copy in copies
    ]
    patches = tuple(Patch(down, across) for down, across in axes)
    return GridRelation(sides, patches, None, _uncovered(painted(new.grid, [copy.area for copy in copies]), above))


def _uncovered(covered: IntArray, motifs: Sequence[Sequence[MotifCopy]]) -> IntArray:
    """Patches of knots without those under motifs, in place."""
    areas: list[Area] = [copy.area for copies in motifs for copy in copies]
    for area in areas:
        covered[area] = -1
    return covered


def _missing(noun: str, number: int, count: int) -> CarpetError:
    return CarpetError(f"{noun} {number} is not there", allowed=f"{noun} 1 to {count}" if count else f"no {noun}")
