"""Names of moving points: beside their points at every frame, clear of the lines, with as little movement as possible.

A name has sixteen positions around its point. The sequence of positions over the frames minimises the sum of

    cost of the parts covered at a frame  +  p d^2 for a change by d positions from frame to frame, p the name's pull

by dynamic programming (the Viterbi algorithm); in a closed run the last frame is followed by the first.
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray
from ilmek.viz.labels import LabelRequest, covered

NAME_POSITIONS = 16
_TOUCHED = 30.0
"""Cost of touching another name or leaving the sheet."""


def positions_around(one: LabelRequest) -> ComplexArray:
    """Possible centres of the name relative to its point [pt]; its box keeps the distance in every direction."""
    angle = 2 * np.pi * np.arange(NAME_POSITIONS) / NAME_POSITIONS + np.pi / 4
    aside = (
        np.clip(1.5 * np.cos(angle), -1, 1) * one.half.real + 1j * np.clip(1.5 * np.sin(angle), -1, 1) * one.half.imag
    )
    return np.asarray(one.distance * np.exp(1j * angle) + aside)


def named(
    requests: list[LabelRequest], obstacles: list[ComplexArray], lower: complex, upper: complex, *, closes: bool
) -> list[ComplexArray]:
    """The centre of each name at every frame [pt].

    requests      names with their points at the frames as anchors
    obstacles     points that should not be covered at each frame [pt]
    lower, upper  corners of the sheet [pt]
    closes        the first frame follows the last
    """
    found: list[ComplexArray] = []
    for request in requests:
        around = positions_around(request)
        centres = request.anchors[:, np.newaxis] + around
        cost = np.array([covered(at, request.half, met) for at, met in zip(centres, obstacles, strict=True)])
        least, most = lower + request.half, upper - request.half
        cost += _TOUCHED * ((centres.real < least.real) | (centres.real > most.real))
        cost += _TOUCHED * ((centres.imag < least.imag) | (centres.imag > most.imag))
        for other, centre in zip(requests, found, strict=False):
            away = centres - centre[:, np.newaxis]
            room = request.half + other.half
            cost += _TOUCHED * ((np.abs(away.real) < room.real) & (np.abs(away.imag) < room.imag))
        found.append(request.anchors + around[steadiest(cost, request.pull, closes=closes)])
    return found


def steadiest(cost: FloatArray, pull: float, *, closes: bool) -> IntArray:
    """The position at each frame that minimises the sum of costs and changes.

    cost  (frames, positions), the positions in a ring
    pull  cost of a change to the next position

    >>> steadiest(np.array([[0.0, 1.0], [0.9, 1.0], [1.0, 0.0]]), 3.0, closes=False)
    array([0, 0, 0])
    """
    count = cost.shape[1]
    apart = np.abs(np.subtract.outer(np.arange(count), np.arange(count)))
    change = pull * np.minimum(apart, count - apart) ** 2
    # A closed run returns to its first position: one search for each of these. An open run needs a single search.
    sums = np.where(np.eye(count, dtype=bool), cost[0], np.inf) if closes else cost[:1]
    came = []
    for of_frame in cost[1:]:
        through = sums[:, :, np.newaxis] + change
        came.append(np.argmin(through, axis=1))
        sums = np.min(through, axis=1) + of_frame
    total = sums + change if closes else sums
    search, last = np.unravel_index(int(np.argmin(total)), total.shape)
    chosen = [int(last)]
    for before in reversed(came):
        chosen.append(int(before[search, chosen[-1]]))
    return np.array(chosen[::-1])
