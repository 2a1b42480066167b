"""Order in which the crank meets the points of a path: restored by points that share a crank angle.

The nearest ascending angles are means over runs of points (pool adjacent violators). Each run then shares one crank
angle, its block, and the search continues with fewer angles.      [Barlow, Bartholomew, Bremner and Brunk 1972, ch. 1]
"""

import math

import numpy as np

from ilmek.arrays import Bool, Float, Int

Angles = Float[np.ndarray, " points"]
Blocks = Int[np.ndarray, " points"]

TOLERANCE = 1e-7
"""Step against the order that counts as rounding [rad]."""

FULL_TURN = 2 * math.pi


def in_order(angles: Float[np.ndarray, "some points"]) -> Bool[np.ndarray, " some"]:
    """Whether the angles [rad] of each row are ascending, or descending, over one turn at most."""
    rising = angles * sense(angles)[:, None]
    once = rising[:, -1] - rising[:, 0] <= FULL_TURN + TOLERANCE
    result: Bool[np.ndarray, " some"] = (np.diff(rising, axis=1) >= -TOLERANCE).all(axis=1) & once
    return result


def sense(angles: Float[np.ndarray, "*some points"]) -> Float[np.ndarray, "*some"]:
    """+1 where the crank rotates counter-clockwise along the points, -1 where clockwise; angles [rad]."""
    return np.where(angles[..., -1] >= angles[..., 0], 1.0, -1.0)


def pooled(angles: Angles, blocks: Blocks) -> tuple[Angles, Blocks]:
    """The nearest angles [rad] in order, and the block of each point; points of one block stay together.

    >>> pooled(np.array([0.0, 2.0, 1.0, 3.0]), np.arange(4))
    (array([0. , 1.5, 1.5, 3. ]), array([0, 1, 1, 2]))
    """
    direction = float(sense(angles))
    runs = _rising(_runs(direction * angles, blocks))
    wrapped = blocks[0] == blocks[-1] and blocks[0] != blocks[len(blocks) // 2]
    first, last = runs[0], runs[-1]
    if len(runs) > 1 and (wrapped or last[0] - first[0] > FULL_TURN):
        shared = (first[0] * first[1] + (last[0] - FULL_TURN) * last[1]) / (first[1] + last[1])
        runs[0], runs[-1] = (shared, first[1]), (shared + FULL_TURN, last[1])
        wrapped = True
    lengths = [length for _, length in runs]
    found = np.repeat(np.arange(len(runs)), lengths)
    if wrapped and len(runs) > 1:
        found[found == len(runs) - 1] = 0
    return direction * np.repeat([value for value, _ in runs], lengths), found


def _runs(values: Angles, blocks: Blocks) -> list[tuple[float, int]]:
    """Mean angle [rad] and number of points of each run in one block."""
    starts = np.flatnonzero(np.r_[True, np.diff(blocks) != 0])
    lengths = np.diff(np.r_[starts, len(blocks)])
    means = np.add.reduceat(values, starts) / lengths
    return [(float(mean), int(length)) for mean, length in zip(means, lengths, strict=True)]


def _rising(runs: list[tuple[float, int]]) -> list[tuple[float, int]]:
    """The runs, each merged with the previous one while its mean is lower."""
    kept: list[tuple[float, int]] = []
    for value, length in runs:
        while kept and kept[-1][0] > value:
            before, count = kept.pop()
            value, length = (before * count + value * length) / (count + length), count + length
        kept.append((value, length))
    return kept
