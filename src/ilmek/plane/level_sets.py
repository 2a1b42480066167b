"""Level sets of a field on a square grid, as closed polygons: marching squares, the crossings by linear interpolation.

A square whose two inner corners are opposite joins neither them nor their polygons.
[Lorensen & Cline 1987, in the plane]
"""

import numpy as np

from ilmek.arrays import Complex, Float, Int

_BOTTOM, _RIGHT, _TOP, _LEFT = range(4)

_CHORDS = {
    1: ((_BOTTOM, _LEFT),),
    2: ((_RIGHT, _BOTTOM),),
    3: ((_RIGHT, _LEFT),),
    4: ((_TOP, _RIGHT),),
    5: ((_BOTTOM, _LEFT), (_TOP, _RIGHT)),
    6: ((_TOP, _BOTTOM),),
    7: ((_TOP, _LEFT),),
    8: ((_LEFT, _TOP),),
    9: ((_BOTTOM, _TOP),),
    10: ((_RIGHT, _BOTTOM), (_LEFT, _TOP)),
    11: ((_RIGHT, _TOP),),
    12: ((_LEFT, _RIGHT),),
    13: ((_BOTTOM, _RIGHT),),
    14: ((_LEFT, _BOTTOM),),
}
"""Chords in a square by its inner corners (1 lower left, 2 lower right, 4 upper right, 8 upper left), side to side;
the inside is on the left.
"""


def level_polygons(field: Float[np.ndarray, "rows columns"], level: float) -> list[Complex[np.ndarray, " corners"]]:
    """Closed polygons about all that is above a level, its inside on their left: outer ones run counter-clockwise.

    A point is column + i row. The nodes at the edge of the field have to be at the level or below it.

    >>> field = np.zeros((3, 3)); field[1, 1] = 1.0
    >>> level_polygons(field, 0.5)[0].tolist()
    [(1+0.5j), (1.5+1j), (1+1.5j), (0.5+1j)]
    """
    inside = field > level
    columns = field.shape[1]
    code = inside[:-1, :-1] + 2 * inside[:-1, 1:] + 4 * inside[1:, 1:] + 8 * inside[1:, :-1].astype(np.int64)
    crossed = np.flatnonzero((code > 0) & (code < 15))
    row, column = np.divmod(crossed, columns - 1)
    node = row * columns + column
    sides = np.stack([2 * node, 2 * (node + 1) + 1, 2 * (node + columns), 2 * node + 1])  # even: along a row
    codes = code.ravel()[crossed]
    start, end = [], []
    for inner, chords in _CHORDS.items():
        own = np.flatnonzero(codes == inner)
        for first, last in chords:
            start.append(sides[first, own])
            end.append(sides[last, own])
    return _polygons(np.concatenate(start), np.concatenate(end), field, level)


def _polygons(
    start: Int[np.ndarray, " chords"],
    end: Int[np.ndarray, " chords"],
    field: Float[np.ndarray, "rows columns"],
    level: float,
) -> list[Complex[np.ndarray, " corners"]]:
    """The chords joined to polygons, each corner where the field crosses the level on the side of a square."""
    order = np.argsort(start)
    start, end = start[order], end[order]
    node, upright = np.divmod(start, 2)
    step = np.where(upright == 1, field.shape[1], 1)
    values = field.ravel()
    before, after = values[node], values[node + step]
    share = (level - before) / (after - before)
    row, column = np.divmod(node, field.shape[1])
    points = column + 1j * row + share * np.where(upright == 1, 1j, 1.0)
    following: list[int] = np.searchsorted(start, end).tolist()
    passed = bytearray(len(following))
    polygons = []
    for first in range(len(following)):
        if passed[first]:
            continue
        around, chord = [], first
        while not passed[chord]:
            passed[chord] = 1
            around.append(chord)
            chord = following[chord]
        polygons.append(points[around])
    return polygons
