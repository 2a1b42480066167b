"""Names of points that move: beside their points at every frame, clear of the lines, as still as that allows.

A name has sixteen places around its point. Over the frames that sequence of places is taken whose sum is least of

    what the name covers at a frame  +  p d^2 for a change by d places from frame to frame, p the name's pull

found by dynamic programming; where the run closes, the last frame is followed by the first [R. Bellman; A. Viterbi].
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray
from ilmek.viz.labels import LabelRequest, covered

NAME_POSITIONS = 16
_TOUCHED = 30.0
"""What it costs to touch another name, or to leave the sheet."""


def positions_around(one: LabelRequest) -> ComplexArray:
    """Where the middle of the name may stand, from its point [pt]: its box clears the distance in every direction."""
    angle = 2 * np.pi * np.arange(NAME_POSITIONS) / NAME_POSITIONS + np.pi / 4
    aside = (
        np.clip(1.5 * np.cos(angle), -1, 1) * one.half.real + 1j * np.clip(1.5 * np.sin(angle), -1, 1) * one.half.imag
    )
    return np.asarray(one.distance * np.exp(1j * angle) + aside)


def named(
    wanted: list[LabelRequest], obstacles: list[ComplexArray], lower: complex, upper: complex, *, closes: bool
) -> list[ComplexArray]:
    """The middle of each name at every frame [pt].

    wanted      names with their points at the frames as anchors        obstacles  at every frame, not to be covered
    lower, upper  corners of the sheet                                  closes     the first frame follows the last
    """
    found: list[ComplexArray] = []
    for one in wanted:
        around = positions_around(one)
        centres = one.anchors[:, np.newaxis] + around
        cost = np.array([covered(at, one.half, met) for at, met in zip(centres, obstacles, strict=True)])
        least, most = lower + one.half, upper - one.half
        cost += _TOUCHED * ((centres.real < least.real) | (centres.real > most.real))
        cost += _TOUCHED * ((centres.imag < least.imag) | (centres.imag > most.imag))
        for other, place in zip(wanted, found, strict=False):
            away = centres - place[:, np.newaxis]
            room = one.half + other.half
            cost += _TOUCHED * ((np.abs(away.real) < room.real) & (np.abs(away.imag) < room.imag))
        found.append(one.anchors + around[steadiest(cost, one.pull, closes=closes)])
    return found


def steadiest(cost: FloatArray, pull: float, *, closes: bool) -> IntArray:
    """The place at each frame for which costs and changes together are least.

    cost  (frames, places), the places in a ring      pull  what it costs to change to the next place

    >>> steadiest(np.array([[0.0, 1.0], [0.9, 1.0], [1.0, 0.0]]), 3.0, closes=False)
    array([0, 0, 0])
    """
    count = cost.shape[1]
    apart = np.abs(np.subtract.outer(np.arange(count), np.arange(count)))
    change = pull * np.minimum(apart, count - apart) ** 2
    # One search for each first place where the run must come back to it, otherwise a single one.
    sums = np.where(np.eye(count, dtype=bool), cost[0], np.inf) if closes else cost[:1]
    came = []
    for of_frame in cost[1:]:
        ways = sums[:, :, np.newaxis] + change
        came.append(np.argmin(ways, axis=1))
        sums = np.min(ways, axis=1) + of_frame
    total = sums + change if closes else sums
    search, place = np.unravel_index(int(np.argmin(total)), total.shape)
    chosen = [int(place)]
    for before in reversed(came):
        chosen.append(int(before[search, chosen[-1]]))
    return np.array(chosen[::-1])
