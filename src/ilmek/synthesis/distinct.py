"""Four-bars that really differ: distance of two, groups that trace one curve, a choice of different ones."""

import math
from collections.abc import Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.synthesis.cognates import cognates
from ilmek.synthesis.four_bar import FourBar

APART, CLOSEST = 0.5, 0.03
"""Distance of two answers in extents of the task, halved down to the least where there are too few."""

SAME = 1e-6
"""Distance of the pins of two four-bars, relative to their ground link, below which they are one."""

SWAPPED = [1, 0, 3, 2]
"""Indices of A0, B0, A, B of a four-bar driven at its other side."""


def pins_of(four_bar: FourBar) -> ComplexArray:
    """A0, B0, A and B as drawn [m]."""
    return np.array([four_bar.a0, four_bar.b0, four_bar.a, four_bar.b])


def distance(one: FourBar, other: FourBar) -> float:
    """Greatest distance of the pins of two four-bars drawn at the same position [m], either one driven at either side.

    >>> drawn = FourBar(0j, 4 + 0j, 1j, 3 + 3j)
    >>> distance(drawn, drawn.reversed()), distance(drawn, drawn.moved(3 + 4j))
    (0.0, 5.0)
    """
    mine, its = pins_of(one), pins_of(other)
    return float(min(np.max(np.abs(mine - its)), np.max(np.abs(mine - its[SWAPPED]))))


def grouped(found: Sequence[FourBar]) -> tuple[tuple[int, ...], ...]:
    """Indices of four-bars with a tracer, those of one coupler curve together: repeats and cognates; in their order.

    >>> drawn = FourBar(0j, 4 + 0j, 1j, 3 + 3j, tracer=2 + 3j)
    >>> both = cognates(drawn)
    >>> grouped([drawn, both.other, drawn.moved(1), drawn.reversed()])
    ((0, 1, 3), (2,))
    """
    groups: list[list[int]] = []
    families: list[list[FourBar]] = []
    for index, one in enumerate(found):
        for members, family in zip(groups, families, strict=True):
            size = one.lengths.ground
            if any(distance(one, other) <= SAME * size for other in family):
                members.append(index)
                break
        else:
            made = cognates(one)
            groups.append([index])
            families.append([other for other in (one, made.timed, made.other) if other is not None])
    return tuple(tuple(members) for members in groups)


def differing(found: Sequence[FourBar], count: int, extent: float) -> tuple[int, ...]:
    """Indices of at most `count` four-bars, the best first, that differ by `APART` extents, or less if too few do.

    found  the best first      extent  of the task [m]

    >>> near, far = FourBar(0j, 4 + 0j, 1j, 3 + 3j), FourBar(0j, 4 + 0j, 1j, 3 + 5j)
    >>> differing([near, near.moved(0.1), far], 2, extent=2.0)
    (0, 2)
    """
    chosen: list[int] = []
    apart = APART
    while len(chosen) < count and apart >= CLOSEST:
        free = (
            index
            for index, one in enumerate(found)
            if min((distance(one, found[other]) for other in chosen), default=math.inf) > apart * extent
        )
        following = next(free, None)
        if following is None:
            apart /= 2
        else:
            chosen.append(following)
    return tuple(sorted(chosen))
