"""Maxima over a turn of many periodic curves at once: one row per member, suprema rather than greatest samples.

Each member has its own samples, even over the turn and dense near the angles where its curves may be sharp. A local
maximum of the samples near the member's greatest one brackets a maximum; all maxima of all members are refined together
by parabolas through three points. [successive parabolic interpolation; the choice of the samples is derived here]
"""

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, IntArray
from ilmek.units import turn

RowCurves: TypeAlias = Callable[[IntArray, FloatArray], Mapping[str, FloatArray]]
"""Members (m, 1) and angles (m, k) [rad] -> named values (m, k); of period 2 pi and smooth near their maxima."""

EVEN, CLOSE, NEAREST = 48, 8, 2.0**-8
"""Even samples over the turn; samples on each side of a sharp angle, at distances of a geometric sequence; and the
ratio of the nearest to the farthest of them, which is at 0.4 of an even step."""

RIVAL, MARGIN = 0.5, 3.0
"""Share of the range below the greatest sample within which local maxima are refined, and safety factor on the greatest
possible rise between samples."""

BLOCK = 8192
"""Samples per block: more would exceed the processor's cache."""

ROUNDS, NARROW, FLAT = 12, 16.0, 1e-6
"""Greatest number of parabolas per maximum; ratio of successive widths; and relative fall of the neighbours below a
maximum at which it has converged."""


def periodic_maxima(curves: RowCurves, sharp: FloatArray) -> dict[str, FloatArray]:
    """The greatest value over a turn of each curve of each member, (members,), to about 1e-8, rarely 1e-5, of itself.

    curves  see `RowCurves`      sharp  angles [rad], (members, k), near which a member's curves may have narrow peaks
    NaN for a curve with a NaN sample.

    >>> heights = np.array([1.0, 2.0])
    >>> found = periodic_maxima(lambda row, at: {"wave": heights[row] * np.cos(at - 0.3 * row)}, np.zeros((2, 1)))
    >>> found["wave"].round(9).tolist()
    [1.0, 2.0]
    """
    grids = _samples(sharp)
    greatest: dict[str, list[FloatArray]] = {}
    brackets: dict[str, list[Brackets]] = {}
    for part in _blocks(*grids.shape):
        row = np.arange(part.start, part.stop)
        for name, values in curves(row[:, None], grids[part]).items():
            greatest.setdefault(name, []).append(np.max(values, axis=1))
            brackets.setdefault(name, []).append(_local_brackets(values, grids[part], row))
    found = {name: np.concatenate(parts) for name, parts in greatest.items()}
    if found:
        _refine(curves, found, brackets)
    return found


def _samples(sharp: FloatArray) -> FloatArray:
    """Angles of each member [rad], ascending, of equal number."""
    step = turn / EVEN
    distances = 0.4 * step * NEAREST ** (np.arange(CLOSE) / (CLOSE - 1))
    offsets = np.concatenate([-distances, [0.0], distances])
    close = np.mod(sharp[:, :, None] + offsets, turn).reshape(len(sharp), -1)
    even = np.broadcast_to((np.arange(EVEN) + 0.5) * step, (len(sharp), EVEN))
    return np.sort(np.concatenate([even, close], axis=1), axis=1)


Brackets: TypeAlias = tuple[IntArray, FloatArray, FloatArray]
"""For each local maximum its member, and three angles [rad] and values around it, (maxima, 3)."""


def _local_brackets(values: FloatArray, angle: FloatArray, row: IntArray) -> Brackets:
    """The local maxima of a block's samples that may exceed the greatest sample."""
    top = np.max(values, axis=1)
    floor = top - RIVAL * (top - np.min(values, axis=1))
    where, column = np.nonzero(_local_maxima(values) & (values >= floor[:, None]))
    width = values.shape[1]
    about = (column[:, None] + np.arange(-1, 2)) % width
    angles, heights = angle[where[:, None], about], values[where[:, None], about]
    # Neighbours across the end of the turn are moved to the sample's side of it.
    angles[:, 0] -= turn * (column == 0)
    angles[:, 2] += turn * (column == width - 1)
    rivals = _may_exceed(angles, heights, top[where])
    return row[where[rivals]], angles[rivals], heights[rivals]


def _may_exceed(x: FloatArray, y: FloatArray, top: FloatArray) -> BoolArray:
    """Whether concave maxima through three points may exceed `top`: they lie below the extended chords."""
    left, right = x[:, 1] - x[:, 0], x[:, 2] - x[:, 1]
    up, down = y[:, 1] - y[:, 0], y[:, 1] - y[:, 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        gain = np.fmax(up * right / left, down * left / right)
    may: BoolArray = ~(y[:, 1] + MARGIN * gain < top)
    return may


def _local_maxima(values: FloatArray) -> BoolArray:
    """Samples above their left neighbour and not below their right one, periodic."""
    rises = np.empty((values.shape[0], values.shape[1] + 1), dtype=bool)
    np.greater(values[:, 1:], values[:, :-1], out=rises[:, 1:-1])
    rises[:, 0] = rises[:, -1] = values[:, 0] > values[:, -1]
    maxima: BoolArray = rises[:, :-1] & ~rises[:, 1:]
    return maxima


def _refine(curves: RowCurves, greatest: dict[str, FloatArray], brackets: Mapping[str, list[Brackets]]) -> None:
    """Refine the maxima of all curves together and raise the greatest values to them."""
    row, x, y = (
        np.concatenate(column) for column in zip(*(one for of in brackets.values() for one in of), strict=True)
    )
    curve = np.repeat(np.arange(len(brackets)), [sum(one[0].size for one in of) for of in brackets.values()])
    for _ in range(ROUNDS):
        if not row.size:
            break
        tried = _next_angles(x, y)
        found = np.empty_like(tried)
        for part in _blocks(*tried.shape):
            values = list(curves(row[part, None], tried[part]).values())
            for which in np.unique(curve[part]):
                own = curve[part] == which
                found[part][own] = values[which][own]
        x, y = _narrowed(np.hstack([x, tried]), np.hstack([y, found]))
        for which, heights in enumerate(greatest.values()):
            own = curve == which
            np.maximum.at(heights, row[own], y[own, 1])
        steep = y[:, 1] - np.min(y, axis=1) > FLAT * np.abs(y[:, 1])
        highest = np.stack(list(greatest.values()))[curve, row]
        steep &= _may_exceed(x, y, highest)
        row, x, y, curve = row[steep], x[steep], y[steep], curve[steep]


def _blocks(rows: int, width: int) -> list[slice]:
    """Rows per block."""
    size = max(1, BLOCK // width)
    return [slice(start, min(rows, start + size)) for start in range(0, rows, size)]


def _next_angles(x: FloatArray, y: FloatArray) -> FloatArray:
    """Next angles within three points: both midpoints, and the parabola's vertex with neighbours."""
    left, right = x[:, 1] - x[:, 0], x[:, 2] - x[:, 1]
    up, down = y[:, 1] - y[:, 0], y[:, 2] - y[:, 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        vertex = x[:, 1] + 0.5 * (up * right**2 + down * left**2) / (up * right - down * left)
    vertex = np.clip(np.where(np.isfinite(vertex), vertex, x[:, 1]), x[:, 0], x[:, 2])
    aside = (x[:, 2] - x[:, 0]) / NARROW
    return np.stack([x[:, 1] - left / 2, x[:, 1] + right / 2, vertex, vertex - aside, vertex + aside], axis=1)


def _narrowed(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The highest point and its neighbours on both sides."""
    order = np.argsort(x, axis=1)
    x, y = np.take_along_axis(x, order, 1), np.take_along_axis(y, order, 1)
    about = np.clip(np.argmax(y, axis=1), 1, x.shape[1] - 2)[:, None] + np.arange(-1, 2)
    return np.take_along_axis(x, about, 1), np.take_along_axis(y, about, 1)
