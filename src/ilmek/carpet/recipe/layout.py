"""Layout: where the borders and the field of a recipe lie on the grid of knots.

Where the tiles of a border do not fill a side by whole repeats, the carpets nearest in size on which they do are
offered, and the qualities at which they do on this carpet.
"""

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from ilmek.carpet.quality import Quality
from ilmek.carpet.recipe.edits import located
from ilmek.carpet.recipe.recipe import Border, Recipe
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import CarpetError
from ilmek.records import record
from ilmek.units import cm, dm, format_number

Sides = tuple[int, int]
"""Rows and columns."""

_SEARCHED = 20_000
"""Sizes that are tried on either side of a carpet's own [knots]."""


@record
class BorderLayout:
    """A border on the grid.

    inset    knots between the carpet's edge and the border: above, and at the left
    breadth  knots of the upper and of the left side
    tile     knots along the upper and along the left side; None: no tile
    units    motifs on the upper and on the left side, of which a tile has `motifs`
    """

    border: Border
    inset: Sides
    breadth: Sides
    tile: Sides | None = None
    units: Sides = (0, 0)

    @property
    def motifs(self) -> int:
        """Number of motifs of the tile."""
        return 2 if self.border.alternate else 1


@record
class CarpetLayout:
    """Borders from the edge inwards, and the field (rows, columns) with its inset from the upper left corner."""

    borders: tuple[BorderLayout, ...]
    inset: Sides
    field: Sides


def lay_out(
    recipe: Recipe, size: CarpetSize, quality: Quality, grid: Sides, pixels: Mapping[Path, Sides]
) -> CarpetLayout:
    """The layout of a recipe.

    pixels  height and width of each tile
    Raises CarpetError, with file and line, for a border that does not fit.
    """
    rows, columns = grid
    high = wide = 0
    borders = []
    for border in recipe.borders:
        with located(border.where):
            breadth = _breadth(border, quality, pixels)
            if 2 * (high + breadth[0]) >= rows or 2 * (wide + breadth[1]) >= columns:
                given = f"the borders up to here take {2 * (high + breadth[0])} of {rows} rows and "
                given += f"{2 * (wide + breadth[1])} of {columns} columns"
                raise CarpetError(given, do="make them narrower, or take a larger size")
        borders.append(BorderLayout(border, (high, wide), breadth, _tile(border, breadth, quality, pixels)))
        high, wide = high + breadth[0], wide + breadth[1]
    made = [_repeated(one, grid) for one in borders]
    for one, fits in zip(borders, made, strict=True):
        if fits is None:
            with located(one.border.where):
                raise _no_fit(one, borders, size, quality, grid)
    return CarpetLayout(
        tuple(fits for fits in made if fits is not None), (high, wide), (rows - 2 * high, columns - 2 * wide)
    )


def _breadth(border: Border, quality: Quality, pixels: Mapping[Path, Sides]) -> Sides:
    if border.width is not None:
        return border.width.on(quality.along), border.width.on(quality.across)
    if border.tile is None:
        raise CarpetError("the border has no width", do='give it in knots, or like "3cm"')
    height = pixels[border.tile][0]
    return height, height


def _tile(border: Border, breadth: Sides, quality: Quality, pixels: Mapping[Path, Sides]) -> Sides | None:
    """Knots of a tile along the upper and along the left side."""
    if border.teeth:
        return 2 * breadth[0], 2 * breadth[1]
    if border.tile is None:
        return None
    height, width = pixels[border.tile]
    if border.length is not None:
        return border.length, border.length
    if breadth == (height, height):
        return width, width
    # In the picture's proportions on the carpet: a knot is 1/across wide and 1/along long.
    upper = breadth[0] / quality.along * width / height * quality.across
    left = breadth[1] / quality.across * width / height * quality.along
    return max(1, round(upper)), max(1, round(left))


def _sides(one: BorderLayout, grid: Sides) -> Sides:
    """Knots of the upper and the left side between the corners."""
    return grid[1] - 2 * (one.inset[1] + one.breadth[1]), grid[0] - 2 * (one.inset[0] + one.breadth[0])


def _repeated(one: BorderLayout, grid: Sides) -> BorderLayout | None:
    """The border with its numbers of repeats; None if these are not whole."""
    if one.tile is None:
        return one
    found = [_units(one, side, tile) for side, tile in zip(_sides(one, grid), one.tile, strict=True)]
    if None in found:
        return None
    upper, left = (units or 0 for units in found)
    return BorderLayout(one.border, one.inset, one.breadth, one.tile, (upper, left))


def _units(one: BorderLayout, side: int, tile: int) -> int | None:
    """The number of motifs on a side; None if no such number fills it."""
    motifs = one.motifs
    units = side * motifs // tile
    if one.border.adjust:
        units -= motifs == 2 and units % 2 == 0
        return units if units > 0 else None
    fits = side >= tile // motifs and side * motifs % tile == 0 and (motifs == 1 or units % 2 == 1)
    return units if fits else None


def _no_fit(
    one: BorderLayout, borders: Sequence[BorderLayout], size: CarpetSize, quality: Quality, grid: Sides
) -> CarpetError:
    """The error of a border whose repeats are not whole, with the carpets on which all borders fit."""
    assert one.tile is not None
    sides = _sides(one, grid)
    given = (
        f"the tile is {_both(one.tile)} knots long, and the sides between the corners are {_both(sides)}: "
        f"{_both(tuple(side / tile for side, tile in zip(sides, one.tile, strict=True)))} repeats"
        f"{', where a half is needed besides whole ones' if one.border.alternate else ''}"
    )
    columns = _nearest(grid[1], lambda count: all(_whole(other, 0, count) for other in borders))
    rows = _nearest(grid[0], lambda count: all(_whole(other, 1, count) for other in borders))
    adjust = "adjust = true makes the repeats a little longer"
    if not columns or not rows:
        return CarpetError(given, allowed="no carpet near this size has whole repeats", do=adjust)
    pairs = sorted(itertools.product(columns, rows), key=lambda pair: _change(pair, grid))[:3]
    sizes = [_size(pair, quality) for pair in pairs]
    offered = f"at {quality} these sizes fit: {', '.join(sizes)}"
    if all(_of_any_quality(other.border) for other in borders):
        across, along = _written(pairs[0][0], size.width / dm), _written(pairs[0][1], size.length / dm)
        offered += f"; at {size} this quality: {across}x{along}/dm"
    return CarpetError(given, allowed=offered, do=adjust)


def _of_any_quality(border: Border) -> bool:
    """Whether a border has the same knots at every quality."""
    if border.width is None:
        return True
    return border.width.knots is not None and (border.tile is None or border.length is not None)


def _both(pair: Sequence[float]) -> str:
    upper, left = (format_number(one, 4) for one in pair)
    return upper if upper == left else f"{upper} (across) and {left} (along)"


def _whole(one: BorderLayout, direction: int, count: int) -> bool:
    """Whether a border has at least one and no broken repeats on a grid of so many columns (0) or rows (1)."""
    if one.tile is None:
        return True
    return _units(one, _sides(one, (count, count))[direction], one.tile[direction]) is not None


def _nearest(count: int, fits: Callable[[int], bool]) -> list[int]:
    """The nearest numbers of knots below and above that fit, or the number itself."""
    if fits(count):
        return [count]
    below = next((near for near in range(count - 1, max(1, count - _SEARCHED), -1) if fits(near)), None)
    above = next((near for near in range(count + 1, count + _SEARCHED) if fits(near)), None)
    return [near for near in (below, above) if near is not None]


def _change(pair: Sides, grid: Sides) -> float:
    return abs(pair[0] / grid[1] - 1) + abs(pair[1] / grid[0] - 1)


def _size(pair: Sides, quality: Quality) -> str:
    """The size of a grid of columns and rows, as it is given."""
    return f"{_written(pair[0], quality.across * cm)}x{_written(pair[1], quality.along * cm)}cm"


def _written(count: int, density: float) -> str:
    """The number with the fewest decimals that gives a number of knots when it is multiplied by a density."""
    texts: Iterator[str] = (format_number(count / density, digits) for digits in range(2, 12))
    return next(text for text in texts if abs(float(text) * density - count) < 0.4)
