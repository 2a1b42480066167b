"""Horizontal lines through polygons: the intervals that are inside, and what intervals of one line have in common."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Complex, Float, Int
from ilmek.plane.vectors import following

LINE = 1024.0
"""Distance of the lines on the common axis, on which intervals of different lines never meet [m]."""


class Cuts(NamedTuple):
    """Cuts of lines: number of the line, first and last x [m] of each; sorted, those of one line apart."""

    line: Int[np.ndarray, " intervals"]
    start: Float[np.ndarray, " intervals"]
    end: Float[np.ndarray, " intervals"]

    def of_length(self, least: float) -> "Cuts":
        """Those of at least a length [m]."""
        kept = self.end - self.start >= least
        return Cuts(self.line[kept], self.start[kept], self.end[kept])


def cut(polygons: Sequence[Complex[np.ndarray, " corners"]], pitch: float, shift: float) -> Cuts:
    """The insides of polygons on the lines y = (k + 1/2) pitch + shift [m].

    >>> square = np.array([0, 2 + 0j, 2 + 2j, 2j])
    >>> [part.tolist() for part in cut([square], 1.0, 0.0)]
    [[0, 1], [0.0, 0.0], [2.0, 2.0]]
    """
    corners = np.concatenate([*polygons, np.empty(0, dtype=complex)])
    after = np.concatenate([*(following(around) for around in polygons), np.empty(0, dtype=complex)])
    rank, next_rank = ((points.imag - shift) / pitch - 0.5 for points in (corners, after))
    first = np.ceil(np.minimum(rank, next_rank)).astype(np.int64)
    crossings = np.ceil(np.maximum(rank, next_rank)).astype(np.int64) - first
    edge = np.repeat(np.arange(len(corners)), crossings)
    line = np.arange(len(edge)) - np.repeat(np.cumsum(crossings) - crossings, crossings) + first[edge]
    share = (line - rank[edge]) / (next_rank[edge] - rank[edge])
    x = corners.real[edge] + share * (after.real[edge] - corners.real[edge])
    order = np.lexsort((x, line))
    line, x = line[order], x[order]
    return Cuts(line[::2], x[::2], x[1::2])


def common(sets: Sequence[Cuts], least: int) -> Cuts:
    """What lies in at least so many of several sets of intervals: in one of them (1), or in all.

    >>> one, other = (Cuts(np.array([0]), np.array([a]), np.array([a + 2.0])) for a in (0.0, 1.0))
    >>> [[part.item() for part in common([one, other], least)] for least in (1, 2)]
    [[0, 0.0, 3.0], [0, 1.0, 2.0]]
    """
    line, start, end = (np.concatenate(parts) for parts in zip(*sets, strict=True))
    steps = np.concatenate([np.ones(len(start), dtype=np.int64), -np.ones(len(end), dtype=np.int64)])
    along = np.concatenate([start, end])
    lines = np.concatenate([line, line])
    order = np.lexsort((-steps, along, lines))
    inside = np.cumsum(steps[order])
    lines, along, before = lines[order], along[order], inside - steps[order]
    opened, closed = (before < least) & (inside >= least), (before >= least) & (inside < least)
    return Cuts(lines[opened], along[opened], along[closed])


def nearest(
    intervals: Cuts, line: Int[np.ndarray, " points"], x: Float[np.ndarray, " points"]
) -> Float[np.ndarray, " points"]:
    """The x nearest to each point (line, x) that is in an interval of its line; inf where the line has none.

    >>> one = Cuts(np.array([0, 0]), np.array([0.0, 4.0]), np.array([1.0, 5.0]))
    >>> nearest(one, np.array([0, 0, 0, 1]), np.array([0.5, 2.0, 3.0, 0.5])).tolist()
    [0.5, 1.0, 4.0, inf]
    """
    before = np.searchsorted(intervals.line * LINE + intervals.start, line * LINE + x, side="right") - 1
    found = np.full(len(x), np.inf)
    for candidate in (before, before + 1):
        number = candidate.clip(0, max(0, len(intervals.line) - 1))
        if not len(intervals.line):
            break
        own = (candidate == number) & (intervals.line[number] == line)
        reached = np.where(own, x.clip(intervals.start[number], intervals.end[number]), np.inf)
        found = np.where(np.abs(reached - x) < np.abs(found - x), reached, found)
    return found
