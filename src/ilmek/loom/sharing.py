"""How knotting heads share a row without meeting.

One head works the whole row. With more, each head has a block of neighbouring knots, and each block two halves. All
heads work the same half at the same time, and wait for the slowest before they go over to the other half. Two
neighbours are therefore never nearer than the half between them and one pitch more, in whatever order they tie:

    distance >= (n + 1) p,   n = floor(columns / (2 heads))   knots in the least half,   p   knot pitch

Heads of width B then fit as long as (n + 1) p >= B. When they go over, the head on the side they go to leaves first.
"""

import math

import numpy as np

from ilmek.arrays import IntArray
from ilmek.errors import LoomError


def halves(heads: int) -> int:
    """Parts of a row for each head: 1 for a single head, else 2."""
    return 1 if heads == 1 else 2


def heads_that_fit(columns: int, pitch: float, head_width: float) -> int:
    """The most heads of a width [m] that can share a row of knots of a pitch [m]; at least 1.

    >>> heads_that_fit(300, 0.004, 0.08)
    7
    """
    least = max(1, math.ceil(head_width / pitch - 1e-9) - 1)
    return max(1, columns // (2 * least))


def share(columns: int, heads: int) -> IntArray:
    """Edges of the parts of a row: part k has the knots edges[k] <= column < edges[k+1]; widths differ by one at most.

    Head h has the parts h * halves(heads) onward. Raises LoomError where there are fewer knots than parts.

    >>> share(10, 2).tolist()
    [0, 2, 5, 7, 10]
    """
    if heads < 1:
        raise LoomError(f"{heads} heads", allowed="at least 1 head")
    parts = heads * halves(heads)
    if columns < parts:
        raise LoomError(
            f"{heads} heads for a row of {columns} knots",
            allowed=f"at most {max(1, columns // 2)} heads: each ties two halves of at least one knot",
            do="take fewer heads",
        )
    return np.arange(parts + 1, dtype=np.int64) * columns // parts


def least_distance(edges: IntArray, heads: int, pitch: float) -> float:
    """The least distance of two neighbouring heads [m]; inf for one head."""
    if heads == 1:
        return math.inf
    return float(np.diff(edges)[1:-1].min() + 1) * pitch
