"""The order in which the crank meets the points of a path, where a search has lost it: points that must be met at once.

The nearest angles that rise are means over runs of points (pool adjacent violators); such a run then shares one crank
angle, its block, and the search goes on with fewer angles.        [Barlow, Bartholomew, Bremner and Brunk 1972, ch. 1]
"""

import math

import numpy as np

from ilmek.arrays import Bool, Float, Int

Angles = Float[np.ndarray, " points"]
Blocks = Int[np.ndarray, " points"]

SLACK = 1e-7
"""Angle [rad] against the order that is rounding."""

ONCE = 2 * math.pi


def in_order(angles: Float[np.ndarray, "some points"]) -> Bool[np.ndarray, " some"]:
    """Whether the angles [rad] rise, or fall, by one turn at most."""
    rising = angles * sense(angles)[:, None]
    once = rising[:, -1] - rising[:, 0] <= ONCE + SLACK
    result: Bool[np.ndarray, " some"] = (np.diff(rising, axis=1) >= -SLACK).all(axis=1) & once
    return result


def sense(angles: Float[np.ndarray, "*some points"]) -> Float[np.ndarray, "*some"]:
    """+1 where the crank goes on with the points against the clock, -1 where with it."""
    return np.where(angles[..., -1] >= angles[..., 0], 1.0, -1.0)


def pooled(angles: Angles, blocks: Blocks) -> tuple[Angles, Blocks]:
    """The nearest angles in order, and the blocks that share one: at least those that did.

    >>> pooled(np.array([0.0, 2.0, 1.0, 3.0]), np.arange(4))
    (array([0. , 1.5, 1.5, 3. ]), array([0, 1, 1, 2]))
    """
    way = float(sense(angles))
    runs = _rising(_runs(way * angles, blocks))
    wrapped = blocks[0] == blocks[-1] and blocks[0] != blocks[len(blocks) // 2]
    first, last = runs[0], runs[-1]
    if len(runs) > 1 and (wrapped or last[0] - first[0] > ONCE):
        shared = (first[0] * first[1] + (last[0] - ONCE) * last[1]) / (first[1] + last[1])
        runs[0], runs[-1] = (shared, first[1]), (shared + ONCE, last[1])
        wrapped = True
    lengths = [length for _, length in runs]
    found = np.repeat(np.arange(len(runs)), lengths)
    if wrapped and len(runs) > 1:
        found[found == len(runs) - 1] = 0
    return way * np.repeat([value for value, _ in runs], lengths), found


def _runs(values: Angles, blocks: Blocks) -> list[tuple[float, int]]:
    """Mean and length of each run of points in one block."""
    starts = np.flatnonzero(np.r_[True, np.diff(blocks) != 0])
    lengths = np.diff(np.r_[starts, len(blocks)])
    means = np.add.reduceat(values, starts) / lengths
    return [(float(mean), int(length)) for mean, length in zip(means, lengths, strict=True)]


def _rising(runs: list[tuple[float, int]]) -> list[tuple[float, int]]:
    """The runs, each merged with the one before while it is lower."""
    kept: list[tuple[float, int]] = []
    for value, length in runs:
        while kept and kept[-1][0] > value:
            before, count = kept.pop()
            value, length = (before * count + value * length) / (count + length), count + length
        kept.append((value, length))
    return kept
