"""Real eigenvalues x and null vectors v of a matrix pencil, (A + x B) v = 0.

[generalised eigenvalue problem: Golub and Van Loan, Matrix Computations, 7.7]
"""

from typing import NamedTuple, TypeAlias

import numpy as np
import scipy

from ilmek.arrays import Complex, Float
from ilmek.num.pencil3 import REAL

Square: TypeAlias = Float[np.ndarray, "n n"]

ZERO = 1e-12
"""Size, relative to the pencil's, of an eigenvalue's numerator or denominator that counts as zero."""


class Root(NamedTuple):
    """A root x of det(A + x B) = 0 and the unit vector v with (A + x B) v = 0."""

    value: float
    vector: Float[np.ndarray, " n"]


def roots(A: Square, B: Square) -> Complex[np.ndarray, " m"]:
    """All finite roots of det(A + x B) = 0, by generalised eigenvalues; without infinite ones (B singular).

    Empty for a pencil that is singular for every x.

    >>> roots(np.diag([1.0, -6.0]), np.diag([0.0, 2.0]))
    array([3.+0.j])
    """
    size = max(float(np.max(np.abs(A))), 1e-300), max(float(np.max(np.abs(B))), 1e-300)
    numerator, denominator = scipy.linalg.eigvals(A / size[0], -B / size[1], homogeneous_eigvals=True)
    small = np.abs(numerator) < ZERO, np.abs(denominator) < ZERO
    if np.any(small[0] & small[1]):
        return np.empty(0, dtype=complex)
    finite = ~small[1]
    found: Complex[np.ndarray, " m"] = numerator[finite] / denominator[finite] * (size[0] / size[1]) + 0j
    return found


def real_roots(A: Square, B: Square) -> tuple[Root, ...]:
    """The real roots in ascending order, with their vectors; a double root may appear twice.

    >>> [round(root.value, 12) for root in real_roots(np.diag([1.0, -6.0]), np.eye(2))]
    [-1.0, 6.0]
    """
    found = roots(A, B)
    real = np.sort(found[np.abs(found.imag) <= REAL * np.maximum(1.0, np.abs(found))].real)
    return tuple(Root(float(value), np.linalg.svd(A + value * B)[2][-1]) for value in real)
