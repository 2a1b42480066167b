"""Carried edits, and rectangles of knots as edits write them and as arrays count them."""

from dataclasses import replace

import numpy as np

from ilmek.arrays import IntArray
from ilmek.carpet.recipe.carried_knots import PlacedKnots
from ilmek.carpet.recipe.edits import Edit, Knot
from ilmek.records import record

Box = tuple[int, int, int, int]
"""First and last row, first and last column, from the upper left corner."""


@record
class Carried:
    """An edit on the new grid.

    edits    that take its place; none: it is left out      details, reason, lost  as of an outcome
    """

    edits: tuple[Edit, ...]
    details: tuple[int, int] = (1, 0)
    reason: str = ""
    lost: float = 0.0


def left_out(reason: str) -> Carried:
    """An edit that is left out as a whole."""
    return Carried((), (1, 1), reason, 1.0)


def set_knots(edit: Edit, knots: PlacedKnots, rows: int) -> Carried:
    """An edit knot by knot on a grid of some rows."""
    if not knots.rows.size:
        return Carried((), knots.details, knots.reason, knots.lost)
    each = np.unique(np.stack([rows - knots.rows, knots.columns + 1], axis=1), axis=0).tolist()
    edits = (replace(edit, kind="set", knots=tuple((row, column) for row, column in each)),)
    return Carried(edits, knots.details, knots.reason, knots.lost)


def between(knots: tuple[Knot, ...], grid: tuple[int, int]) -> tuple[IntArray, IntArray]:
    """Rows and columns of all knots between two opposite corners, from the upper left corner."""
    (low, left), (high, right) = np.sort(np.array(knots), axis=0).tolist()
    rows, columns = np.mgrid[grid[0] - high : grid[0] - low + 1, left - 1 : right]
    return rows.ravel(), columns.ravel()


def corner_knots(box: Box, rows: int) -> tuple[Knot, Knot]:
    """Lower left and upper right corner of a box of rows and columns, as edits count them."""
    top, bottom, left, right = box
    return (rows - bottom, left + 1), (rows - top, right + 1)
