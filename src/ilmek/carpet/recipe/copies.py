"""Copies of a part of a chart, reflected and turned, and the brush of a stroke."""

import numpy as np

from ilmek.arrays import Num

WIDEST_BRUSH = 99
"""Largest width of a brush [knots]."""

_AXES = {"across": 1, "along": 0}


def transformed(part: Num[np.ndarray, "high wide"], direction: str, turned: int) -> Num[np.ndarray, "high2 wide2"]:
    """A part (rows, columns) reflected, left to right `across` or top to bottom `along`, then turned clockwise.

    direction  "": not reflected      turned  right angles

    >>> transformed(np.array([[1, 2, 3], [4, 5, 6]], dtype=np.uint8), "across", 1).tolist()
    [[6, 3], [5, 2], [4, 1]]
    """
    reflected = np.flip(part, _AXES[direction]) if direction else part
    return np.rot90(reflected, -turned)


def brush_spans(width: int) -> tuple[tuple[int, tuple[int, int]], ...]:
    """Rows of a round brush about a knot, and of each its columns: the first, and that behind the last one.

    A knot belongs to the brush if its centre lies within a circle of the width as diameter. An odd width is symmetric
    about the knot; an even one has a row and a column more below and at the right.

    >>> brush_spans(2)
    ((0, (0, 2)), (1, (0, 2)))
    >>> [right - left for _, (left, right) in brush_spans(5)]
    [3, 5, 5, 5, 3]
    """
    begin, middle = -((width - 1) // 2), (width - 1) / 2
    spans = []
    for number in range(width):
        inside = [at for at in range(width) if (at - middle) ** 2 + (number - middle) ** 2 <= (width / 2) ** 2]
        spans.append((begin + number, (begin + inside[0], begin + inside[-1] + 1)))
    return tuple(spans)
