"""Greatest values over a turn of many periodic curves at once: one row a member, suprema rather than best samples.

Each member has samples of its own, evenly over the turn and ever closer to the angles where its curves may be sharp.
A sample not below its neighbours that rivals the member's greatest one brackets a summit; all summits of all members
climb together by parabolas through three points.
"""

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, IntArray
from ilmek.units import turn

RowCurves: TypeAlias = Callable[[IntArray, FloatArray], Mapping[str, FloatArray]]
"""Members (m, 1) and angles (m, k) [rad] -> named values (m, k); of period 2 pi and smooth near their summits."""

EVEN, CLOSE, NEAREST = 48, 8, 2.0**-8
"""Even samples over the turn; samples on each side of a sharp angle, each nearer than the last by one ratio; and the
nearest over the farthest of them, which is 0.4 of an even step away."""

RIVAL, MARGIN = 0.5, 3.0
"""Part of the span below the greatest sample within which local maxima are looked at, and how many times the gain that
a hill without flanks may have is granted to each."""

BLOCK = 8192
"""Samples worked off at a time: more would leave the processor's cache."""

ROUNDS, NARROW, FLAT = 12, 16.0, 1e-6
"""Most parabolas fitted to a summit; how much narrower each may be than the last; and the fall of its neighbours below
a summit, as a part of it, at which it is reached."""


def summits(curves: RowCurves, sharp: FloatArray) -> dict[str, FloatArray]:
    """The greatest value over a turn of each curve of each member, to about 1e-8 of itself, hardly ever more than 1e-5.

    sharp  angles [rad], (members, any number), near which a member's curves may be narrow
    A curve that is not finite somewhere has no greatest value: NaN.

    >>> heights = np.array([1.0, 2.0])
    >>> found = summits(lambda row, at: {"wave": heights[row] * np.cos(at - 0.3 * row)}, np.zeros((2, 1)))
    >>> found["wave"].round(9).tolist()
    [1.0, 2.0]
    """
    grids = _samples(sharp)
    greatest: dict[str, list[FloatArray]] = {}
    hills: dict[str, list[Hills]] = {}
    for part in _blocks(*grids.shape):
        row = np.arange(part.start, part.stop)
        for name, values in curves(row[:, None], grids[part]).items():
            greatest.setdefault(name, []).append(np.max(values, axis=1))
            hills.setdefault(name, []).append(_hills(values, grids[part], row))
    found = {name: np.concatenate(parts) for name, parts in greatest.items()}
    if found:
        _climb(curves, found, hills)
    return found


def _samples(sharp: FloatArray) -> FloatArray:
    """Angles of each member, ascending, all of one number."""
    step = turn / EVEN
    near = 0.4 * step * NEAREST ** (np.arange(CLOSE) / (CLOSE - 1))
    offsets = np.concatenate([-near, [0.0], near])
    close = np.mod(sharp[:, :, None] + offsets, turn).reshape(len(sharp), -1)
    even = np.broadcast_to((np.arange(EVEN) + 0.5) * step, (len(sharp), EVEN))
    return np.sort(np.concatenate([even, close], axis=1), axis=1)


Hills: TypeAlias = tuple[IntArray, FloatArray, FloatArray]
"""Of each local maximum its member, and angles and values (number, 3) about it."""


def _hills(values: FloatArray, angle: FloatArray, row: IntArray) -> Hills:
    """The local maxima of a block's samples that may rival the greatest."""
    top = np.max(values, axis=1)
    floor = top - RIVAL * (top - np.min(values, axis=1))
    where, place = np.nonzero(_local_maxima(values) & (values >= floor[:, None]))
    width = values.shape[1]
    about = (place[:, None] + np.arange(-1, 2)) % width
    angles, heights = angle[where[:, None], about], values[where[:, None], about]
    # Neighbours across the end of the turn lie on the sample's own side of it.
    angles[:, 0] -= turn * (place == 0)
    angles[:, 2] += turn * (place == width - 1)
    rivals = _may_exceed(angles, heights, top[where])
    return row[where[rivals]], angles[rivals], heights[rivals]


def _may_exceed(x: FloatArray, y: FloatArray, top: FloatArray) -> BoolArray:
    """Whether hills through three points may be higher than `top`: a hill lies below its chords drawn on."""
    left, right = x[:, 1] - x[:, 0], x[:, 2] - x[:, 1]
    up, down = y[:, 1] - y[:, 0], y[:, 1] - y[:, 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        gain = np.fmax(up * right / left, down * left / right)
    may: BoolArray = ~(y[:, 1] + MARGIN * gain < top)
    return may


def _local_maxima(values: FloatArray) -> BoolArray:
    """Samples above their left neighbour and not below their right one, round the turn."""
    rises = np.empty((values.shape[0], values.shape[1] + 1), dtype=bool)
    np.greater(values[:, 1:], values[:, :-1], out=rises[:, 1:-1])
    rises[:, 0] = rises[:, -1] = values[:, 0] > values[:, -1]
    maxima: BoolArray = rises[:, :-1] & ~rises[:, 1:]
    return maxima


def _climb(curves: RowCurves, greatest: dict[str, FloatArray], hills: Mapping[str, list[Hills]]) -> None:
    """Raise the greatest values to the summits of all hills; those of all curves are climbed together."""
    row, x, y = (np.concatenate(column) for column in zip(*(one for of in hills.values() for one in of), strict=True))
    curve = np.repeat(np.arange(len(hills)), [sum(one[0].size for one in of) for of in hills.values()])
    for _ in range(ROUNDS):
        if not row.size:
            break
        tried = _tries(x, y)
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
    """Rows worked off at a time."""
    size = max(1, BLOCK // width)
    return [slice(start, min(rows, start + size)) for start in range(0, rows, size)]


def _tries(x: FloatArray, y: FloatArray) -> FloatArray:
    """Where to look next within three points: both middles, and the parabola's vertex with neighbours."""
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
