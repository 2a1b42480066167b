"""Structure: where the parts of a design lie on a grid of knots, and what lies at the same place of the same design on
another grid.

The parts from below: borders from the edge inwards, the field, the motifs. Each is related to itself on the other grid:

    border  in depth by its breadth, along a side by whole motifs from the nearer corner, an even stripe by its length
    field   a picture by what of it the carpet shows, a repeat tile by tile, a plain ground by its size
    motif   copy by copy
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ilmek.arrays import Int, IntArray
from ilmek.carpet.fitting import Fit
from ilmek.carpet.recipe.axis import LineMap, Tiling, bordered, old_tiles, pictured, proportional, tiled
from ilmek.carpet.recipe.layout import BorderLayout, CarpetLayout
from ilmek.carpet.recipe.recipe import Recipe
from ilmek.errors import CarpetError
from ilmek.records import record

Area = tuple[slice, slice]
"""Rows and columns of a part of the grid."""


@record
class MotifCopy:
    """A copy of a motif: its area, and whether it is reflected along and across."""

    area: Area
    reflected: tuple[bool, bool] = (False, False)


@record
class DesignStructure:
    """Where the parts of a design lie.

    grid    rows and columns      fit  of the field's picture
    tile    rows and columns of the tile that the field repeats; None: it has none
    motifs  the copies of each motif of the recipe
    """

    recipe: Recipe
    grid: tuple[int, int]
    layout: CarpetLayout
    fit: Fit
    tile: tuple[int, int] | None = None
    motifs: tuple[tuple[MotifCopy, ...], ...] = ()

    @property
    def field(self) -> Area:
        """The area of the field."""
        (top, left), (rows, columns) = self.layout.inset, self.layout.field
        return slice(top, top + rows), slice(left, left + columns)

    def tiling(self, direction: int) -> Tiling:
        """The tiles along the rows (0) or the columns (1) of the field, where they are not shifted."""
        repeat = self.recipe.repeat
        assert self.tile is not None
        assert repeat is not None
        side, (begin, end) = self.tile[direction], span(self.field[direction])
        count = 1 if repeat.cut else (end - begin) // side
        return Tiling((begin, end), side, (end - begin - count * side) // 2, not repeat.cut)


@record
class Patch:
    """A rectangle of the new grid, of which every knot has its place on the old grid: row by row, column by column.

    part  of the design to which it belongs
    transposed  its rows are columns of the old grid, and its columns are rows
    """

    rows: LineMap
    columns: LineMap
    part: int = 0
    transposed: bool = False

    @property
    def area(self) -> Area:
        """Its part of the new grid."""
        axes = self.rows, self.columns
        rows, columns = (slice(axis.begin, axis.begin + len(axis.first)) for axis in axes)
        return rows, columns


@record
class GridRelation:
    """Each knot of a new grid and its place on an old one.

    grid     rows and columns of the old grid      patches  later ones lie over those before
    owners   part of the design at each old knot; None: every patch has all of the old grid
    covered  patch of each new knot; -1: none
    is_tile  the old grid is that of a tile, of which the new one shows parts; an area of one yarn ends at its edges
    """

    grid: tuple[int, int]
    patches: tuple[Patch, ...]
    owners: Int[np.ndarray, "old_rows old_columns"] | None
    covered: Int[np.ndarray, "rows columns"]
    is_tile: bool = False


def relate(old: DesignStructure, new: DesignStructure) -> GridRelation:
    """The same design on two grids. Raises CarpetError where its picture lies turned on one of them."""
    if old.recipe.picture is not None and abs(old.fit.turned - new.fit.turned) > 1e-9:
        raise CarpetError("the picture is turned on one of the two carpets", do="give fit = crop, pad or stretch")
    areas: list[Area] = []
    patches: list[Patch] = []
    for before, after in zip(old.layout.borders, new.layout.borders, strict=True):
        spans = _ring(before, old.grid), _ring(after, new.grid)
        axes = [_border_axis(before, after, direction, spans) for direction in (0, 1)]
        patches.append(Patch(axes[0], axes[1], len(areas)))
        areas.append((slice(*spans[0][0]), slice(*spans[0][1])))
    patches += [replace(patch, part=len(areas)) for patch in _field(old, new)]
    areas.append(old.field)
    for copies, others in zip(old.motifs, new.motifs, strict=True):
        for one, other in zip(copies, others, strict=True):
            axes = [proportional(span(one.area[axis]), span(other.area[axis])) for axis in (0, 1)]
            patches.append(Patch(axes[0], axes[1], len(areas)))
            areas.append(one.area)
    covered = painted(new.grid, [patch.area for patch in patches])
    return GridRelation(old.grid, tuple(patches), painted(old.grid, areas), covered)


def span(part: slice) -> tuple[int, int]:
    """First line of a part, and that behind the last one."""
    return part.start, part.stop


def mirrors(recipe: Recipe, direction: int) -> bool:
    """Whether the picture of the field is reflected down its rows (0) or across its columns (1)."""
    return recipe.mirror == "both" or recipe.mirror == ("along", "across")[direction]


def shown_part(fit: Fit, direction: int) -> tuple[float, float]:
    """The part of the picture that is shown, down (0) or across (1), as shares."""
    left, top, right, bottom = fit.shown
    return (top, bottom) if direction == 0 else (left, right)


def _ring(border: BorderLayout, grid: tuple[int, int]) -> tuple[tuple[int, int], tuple[int, int]]:
    """Rows and columns within the outer edge of a border."""
    (high, wide), (rows, columns) = border.inset, grid
    return (high, rows - high), (wide, columns - wide)


def _border_axis(
    before: BorderLayout, after: BorderLayout, direction: int, spans: tuple[tuple[tuple[int, int], ...], ...]
) -> LineMap:
    """Down (0) or across (1) a carpet within the outer edge of a border."""
    old, new = spans[0][direction], spans[1][direction]
    breadths = before.breadth[direction], after.breadth[direction]
    pitches = []
    for one, span in ((before, old), (after, new)):
        units = one.units[1 - direction]  # the upper side first, which runs across
        if one.tile is not None and units:
            pitches.append((span[1] - span[0] - 2 * one.breadth[direction]) / units)
    return bordered(old, new, breadths, (pitches[0], pitches[1]) if len(pitches) == 2 else None)


def _field(old: DesignStructure, new: DesignStructure) -> Iterator[Patch]:
    if old.recipe.picture is not None:
        axes = [
            pictured(
                span(old.field[direction]),
                span(new.field[direction]),
                (shown_part(old.fit, direction), shown_part(new.fit, direction)),
                mirror=mirrors(old.recipe, direction),
                copies=False,
            )
            for direction in (0, 1)
        ]
        yield Patch(axes[0], axes[1])
    elif old.recipe.repeat is None:
        rows, columns = (proportional(span(old.field[axis]), span(new.field[axis])) for axis in (0, 1))
        yield Patch(rows, columns)
    else:
        yield from _repeat(old, new, old.recipe.repeat.order)


def _repeat(old: DesignStructure, new: DesignStructure, order: str) -> Iterator[Patch]:
    """A field of tiles; where every second line of them is shifted, each line is a patch."""
    if order not in ("brick", "half-drop"):
        axes = [tiled(old.tiling(axis), new.tiling(axis), mirrored=order == "mirrored") for axis in (0, 1)]
        yield Patch(axes[0], axes[1])
        return
    way = 0 if order == "brick" else 1
    across, fixed = (old.tiling(1 - way), new.tiling(1 - way)), (old.tiling(way), new.tiling(way))
    shift = across[0].side // 2
    axis = tiled(*fixed)
    numbers = fixed[1].number(np.arange(len(axis.first)) + 0.5)
    found, _ = old_tiles(*fixed, numbers)
    for number in np.unique(numbers):
        lines = np.flatnonzero(numbers == number)
        place = slice(lines[0], lines[-1] + 1)
        strip = LineMap(axis.begin + int(lines[0]), axis.first[place], axis.last[place], axis.scale)
        shifts = int(found[lines[0]]) % 2 * shift, int(number) % 2 * shift
        moved = tiled(across[0].shifted(shifts[0]), across[1].shifted(shifts[1]))
        yield Patch(strip, moved) if way == 0 else Patch(moved, strip)


def painted(grid: tuple[int, int], areas: list[Area]) -> IntArray:
    """The last of the areas in which each knot lies; -1: none."""
    painted = np.full(grid, -1, dtype=np.int16)
    for number, area in enumerate(areas):
        painted[area] = number
    return painted
