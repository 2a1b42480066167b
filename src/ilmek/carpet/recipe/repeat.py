"""Repeats: a tile over an area, straight, shifted by half a tile, or reflected."""

import numpy as np

from ilmek.arrays import Bool, Int64, Pixels
from ilmek.carpet.design import bands
from ilmek.errors import CarpetError
from ilmek.progress import SILENT, Progress

_BAND = 1 << 19
"""Knots that are drawn at once."""


def repeated(tile: Pixels, out: Pixels, order: str, *, cut: bool, progress: Progress = SILENT) -> bool:
    """Draw a tile over an area; whether it fills the area.

    out    colours of the area (rows, columns, 3), in place
    order  of `recipe.ORDERS`
    cut    the middle of the area is the middle of a tile, and the tiles at the edges are cut; else only whole tiles are
           drawn, as many as fit, centred, and what is between them and the edges stays as it is
    Where area and tiles differ by an odd number of knots, the larger margin is below and at the right.
    Raises CarpetError for a tile that does not fit whole.
    """
    area, sides = out.shape[:2], tile.shape[:2]
    if not cut and (sides[0] > area[0] or sides[1] > area[1]):
        given = f"a tile of {sides[1]} × {sides[0]} knots does not fit into {area[1]} × {area[0]}"
        raise CarpetError(given, do="take a smaller tile, or cut = true")
    first = [(size - (1 if cut else size // side) * side) // 2 for size, side in zip(area, sides, strict=True)]
    filled = True
    columns = np.arange(area[1])[None] - first[1]
    for band in bands(area[0], area[1], _BAND):
        part = out[band]
        rows = np.arange(band.start, band.stop)[:, None] - first[0]
        row, column, whole = _of_the_tile(rows, columns, sides, order, first, area)
        if cut:
            part[:] = tile[row, column]
        else:
            part[whole] = tile[row[whole], column[whole]]
            filled = filled and bool(whole.all())
        progress(band.stop / area[0])
    return filled


_Grid = Int64[np.ndarray, "rows columns"]


def _of_the_tile(  # noqa: PLR0917
    rows: Int64[np.ndarray, "rows 1"],
    columns: Int64[np.ndarray, "1 columns"],
    sides: tuple[int, ...],
    order: str,
    first: list[int],
    area: tuple[int, ...],
) -> tuple[_Grid, _Grid, Bool[np.ndarray, "rows columns"]]:
    """Row and column of the tile at each knot, and whether that tile lies in the area with all its knots.

    rows, columns  from the upper left corner of a tile, which is the knot `first` of the area
    """
    height, width = sides
    down = np.where(order == "half-drop", columns // width % 2 * (height // 2), 0)
    right = np.where(order == "brick", rows // height % 2 * (width // 2), 0)
    rows, columns = np.broadcast_arrays(rows - down, columns - right)
    top, left = rows // height * height + down + first[0], columns // width * width + right + first[1]
    whole = (top >= 0) & (top + height <= area[0]) & (left >= 0) & (left + width <= area[1])
    row, column = rows % height, columns % width
    if order == "mirrored":
        row = np.where(rows // height % 2, height - 1 - row, row)
        column = np.where(columns // width % 2, width - 1 - column, column)
    return row, column, whole
