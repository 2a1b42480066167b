"""What a type checker proves of operators of arrays: mypy checks this file, and an ignored error that is none fails.

Each `type: ignore` below stands for a mistake that the types must refuse.
"""

from typing import assert_type

import numpy as np

from ilmek.arrays import ComplexField, FloatArray, RealField


def of_arrays(lengths: FloatArray, angles: FloatArray) -> None:
    """An operator of two arrays, or of an array and a number, gives an array."""
    assert_type(lengths * angles, np.ndarray)
    assert_type(2.0 * lengths - 1j, np.ndarray)
    assert_type(lengths @ angles < 1.0, np.ndarray)
    lengths + "1 mm"  # type: ignore[operator]
    total: float = lengths * angles  # type: ignore[assignment]
    del total


def of_fields(radius: RealField, point: ComplexField) -> None:
    """A number or an array stays one, and is no text."""
    moved: ComplexField = radius * point
    name: str = radius * point  # type: ignore[assignment]
    del moved, name
