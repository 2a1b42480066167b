"""Pins of four-bars, by which two are compared, and how far apart the answers of a search must lie."""

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.synthesis.four_bar import FourBar

APART, CLOSEST = 0.5, 0.03
"""Distance of two answers in extents of the task, halved down to the least where there are too few."""


SWAPPED = [1, 0, 3, 2]
"""Indices of A0, B0, A, B of a four-bar driven at its other side."""


def pins_of(four_bar: FourBar) -> ComplexArray:
    """A0, B0, A and B as drawn [m]."""
    return np.array([four_bar.a0, four_bar.b0, four_bar.a, four_bar.b])
