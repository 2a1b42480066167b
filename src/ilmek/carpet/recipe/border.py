"""Borders: a tile round a carpet by whole repeats, with corners that turn the pattern.

The upper left quarter of a border is drawn and the others are its reflections. On the upper side the tile stands as it
is drawn, its upper edge outside; on the left side it is transposed: reflected at the diagonal of the corner. In the
corner the tile is continued up to the diagonal from both sides, so that a border of equal breadth on all sides is
symmetric under the transposition, and the pattern turns the corner without a break:

    colour(depth, along),   depth = min(row, column),   along = max(row, column) - breadth       [both from the edge]

with `along` < 0 in the corner. A side has a whole number of repeats, so half of it lies in the quarter; where that
number is odd, the middle of the side is the middle of a tile, whose first half is drawn and reflected. A tile that is
symmetric itself is drawn whole everywhere. A tile that is not runs from every corner to the middle of the side.

A tile of two motifs that alternate, A and B, has one half repeat more: a side is A B A ... B A, and the corner is B.
"""

import itertools

import numpy as np

from ilmek.arrays import Int64, Pixels
from ilmek.carpet.recipe.mirror import complete


def repeat_lines(length: int, units: int, tile: int, before: int, motifs: int = 1) -> Int64[np.ndarray, " knots"]:
    """The line of the tile at each knot of the first half of a side, and of `before` knots of the corner.

    length  of the side between the corners [knots]      units   number of motifs on it
    tile    lines of the tile                            motifs  of the tile, which has an equal part for each
    A motif is longer than its part of the tile where the parts do not divide the length: some lines are drawn twice,
    the same in every motif up to one knot, symmetric about its middle.

    >>> repeat_lines(12, 3, 4, 2).tolist(), repeat_lines(7, 1, 4, 0).tolist(), repeat_lines(6, 3, 4, 2, 2).tolist()
    ([2, 3, 0, 1, 2, 3, 0, 1], [0, 0, 1, 2], [2, 3, 0, 1, 2])
    """
    part = tile // motifs
    ends = [(number * length + units // 2) // units for number in range(units // 2 + 1)]
    if units % 2:
        ends.append(length - ends[-1])
    lines = [
        number % motifs * part + _stretched(end - begin, part)
        for number, (begin, end) in enumerate(itertools.pairwise(ends))
    ]
    corner = np.arange(-before, 0) % tile
    return np.concatenate([corner, *lines])[: before + (length + 1) // 2]


def _stretched(length: int, tile: int) -> Int64[np.ndarray, " knots"]:
    """The line of the tile at each knot of a repeat, symmetric about the middle."""
    half = (2 * np.arange((length + 1) // 2) + 1) * tile // (2 * length)
    return np.concatenate([half, tile - 1 - half[: length // 2][::-1]])


def draw_border(
    out: Pixels, tiles: tuple[Pixels, Pixels], units: tuple[int, int], motifs: int = 1, corner: Pixels | None = None
) -> None:
    """Draw a border round an area.

    out      colours of the area with the border's outer edge as its edge (rows, columns, 3), in place; the inside stays
    tiles    of the upper side, (breadth, length, 3), and of the left side as it stands there, (length, breadth, 3)
    units    numbers of motifs on the upper and on the left side, of which a tile has `motifs`
    corner   the upper left one; default: of the tiles
    """
    upper, left = tiles
    high, wide = upper.shape[0], left.shape[1]
    rows, columns = out.shape[:2]
    across = repeat_lines(columns - 2 * wide, units[0], upper.shape[1], wide, motifs)
    along = repeat_lines(rows - 2 * high, units[1], left.shape[0], high, motifs)
    out[:high, : len(across)] = upper[:, across]
    out[high : len(along), :wide] = left[along[high:]]
    if corner is not None:
        out[:high, :wide] = corner
    else:
        row, column = np.arange(high)[:, None], np.arange(wide)[None]
        of_left = (2 * column + 1) * high < (2 * row + 1) * wide
        out[:high, :wide] = np.where(of_left[..., None], left[along[:high]][:, :wide], out[:high, :wide])
    complete(out[:high], "across")
    complete(out[:, :wide], "along")
    out[:, columns - wide :] = out[:, :wide][:, ::-1]
    out[rows - high :] = out[:high][::-1]


def edges(rows: int, columns: int, breadth: tuple[int, int]) -> tuple[tuple[slice, slice], ...]:
    """The four sides of a border as slices of rows and columns, each knot in one."""
    high, wide = breadth
    inner = slice(high, rows - high)
    return (
        (slice(0, high), slice(0, columns)),
        (slice(rows - high, rows), slice(0, columns)),
        (inner, slice(0, wide)),
        (inner, slice(columns - wide, columns)),
    )


def teeth_tile(colours: tuple[tuple[int, int, int], tuple[int, int, int]], breadth: int) -> Pixels:
    """The tile of reciprocal teeth, 2 × breadth long: triangles of the first colour from outside between those of the
    second from inside, equal in shape and size.

    >>> teeth_tile(((1, 0, 0), (0, 0, 0)), 2)[..., 0].tolist()
    [[0, 1, 1, 0], [1, 1, 1, 1]]
    """
    row, column = np.arange(breadth)[:, None], np.arange(2 * breadth)[None]
    outer = np.abs(2 * column + 1 - 2 * breadth) <= 2 * row + 1
    return np.where(outer[..., None], np.array(colours[0], dtype=np.uint8), np.array(colours[1], dtype=np.uint8))
