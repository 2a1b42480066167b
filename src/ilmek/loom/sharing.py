"""Division of a row among knotting heads without collision.

One head ties the whole row. With more heads, each has a block of neighbouring knots, divided into two halves. All heads
work in the same half at the same time and wait for the slowest before they change to the other half. The distance of
two neighbours is therefore at least the half between them plus one pitch, in any tying order:

    distance >= (n + 1) p,   n = floor(columns / (2 heads))   knots in the least half,   p   knot pitch

Heads of width B fit if (n + 1) p >= B. At the change, the head on the side of the target half moves first.
"""

import math

import numpy as np

from ilmek.arrays import IntArray
from ilmek.errors import LoomError

MOST_HEADS = 1000
"""Largest number of heads: one every 5 cm of the widest carpet, 50 m. It bounds the description of a programme."""


def require_whole(noun: str, given: object, most: int) -> None:
    """Raise LoomError unless a count is a whole number from 1 to `most`; noun: what is counted."""
    if isinstance(given, bool) or not isinstance(given, int | np.integer) or not 1 <= given <= most:
        raise LoomError(f"{given} {noun}", allowed=f"1 to {most} {noun}")


def halves(heads: int) -> int:
    """Number of parts of a row per head: 1 for a single head, else 2."""
    return 1 if heads == 1 else 2


def heads_that_fit(columns: int, pitch: float, head_width: float) -> int:
    """Largest number of heads of a width [m] for a row of `columns` knots of a pitch [m]: 1 to MOST_HEADS.

    >>> heads_that_fit(300, 0.004, 0.08)
    7
    """
    least = max(1, math.ceil(head_width / pitch - 1e-9) - 1)
    return min(max(1, columns // (2 * least)), MOST_HEADS)


def share(columns: int, heads: int) -> IntArray:
    """Edges of the parts of a row: part k has the knots edges[k] <= column < edges[k+1]; widths differ by one at most.

    Head h has the parts from h * halves(heads). Raises LoomError for fewer knots than parts, and unless there are 1 to
    MOST_HEADS heads.

    >>> share(10, 2).tolist()
    [0, 2, 5, 7, 10]
    """
    require_whole("heads", heads, MOST_HEADS)
    parts = heads * halves(heads)
    if columns < parts:
        raise LoomError(
            f"{heads} heads for a row of {columns} knots",
            allowed=f"at most {max(1, columns // 2)} heads: each ties two halves of at least one knot",
            do="use fewer heads",
        )
    return np.arange(parts + 1, dtype=np.int64) * columns // parts


def least_distance(edges: IntArray, heads: int, pitch: float) -> float:
    """Least distance [m] of two neighbouring heads on knots of a pitch [m]; inf for one head."""
    if heads == 1:
        return math.inf
    return float(np.diff(edges)[1:-1].min() + 1) * pitch
