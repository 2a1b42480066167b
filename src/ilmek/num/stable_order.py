"""The stable order of whole numbers of at most 24 bits, by their digits: quicker than a sort by comparisons.

Source: D. E. Knuth, The Art of Computer Programming 3 (1998), 5.2.5, algorithm R.
"""

import numpy as np

from ilmek.arrays import IntArray
from ilmek.num.compiled import uncounted

_DIGIT = 12
"""Bits of a digit: its counts stay in the nearest cache."""

_MASK = (1 << _DIGIT) - 1


@uncounted
def _by_digit(numbers: IntArray, order: IntArray, shift: int, places: IntArray, out: IntArray) -> None:
    """Put an order in that of one digit; `places` begin with 0."""
    for number in numbers:
        places[(number >> shift & _MASK) + 1] += 1
    for digit in range(_MASK):
        places[digit + 1] += places[digit]
    for index in order:
        digit = numbers[index] >> shift & _MASK
        out[places[digit]] = index
        places[digit] += 1


def stable_order(numbers: IntArray) -> IntArray:
    """The indices of numbers (n), 0 to 2^24 - 1, from the least to the largest, equal ones as they stand.

    >>> stable_order(np.array([7, 3, 7, 0])).tolist()
    [3, 1, 0, 2]
    """
    order, out = np.arange(len(numbers)), np.empty(len(numbers), dtype=np.int64)
    for shift in (0, _DIGIT):
        _by_digit(numbers, order, shift, np.zeros(_MASK + 2, dtype=np.int64), out)
        order, out = out, order
    return order
