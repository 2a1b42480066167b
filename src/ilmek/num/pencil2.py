"""Many pencils of 2 x 2 matrices at once: both roots of det(k A + x B) = 0 with their null vectors.

    det(k A + x B) = k² det A + k x tr(adj(A) B) + x² det B

Roots are ratios x : k, so that an infinite one (k = 0) is a root like any other; the quadratic is solved as
q : c2 and c0 : q with q = -(c1 + sgn(c1) sqrt(c1² - 4 c0 c2)) / 2, without cancellation
[Press et al., Numerical Recipes, 5.6].
"""

import numpy as np

from ilmek.arrays import Bool, Float, Num, NumberArray
from ilmek.num.pencil3 import REAL, SINGULAR, Roots

Rows = Num[np.ndarray, "*batch 2 2"]

POLISHED = 2
"""Number of Newton steps on the determinant."""

TURNS = np.pi * np.array([0.0, 0.25, 0.5, 0.75])
"""Directions in the plane of (x, k) for the test of singularity; a quadratic vanishes in two directions at most."""


def roots2(A: Float[np.ndarray, "*batch 2 2"], B: Float[np.ndarray, "*batch 2 2"]) -> Roots:
    """Both roots of det(k A + x B) = 0 for each pencil.

    Complex roots are marked as not real; a double root appears twice.

    >>> found = roots2(np.diag([1.0, -6.0]), np.diag([0.0, 2.0]))
    >>> found.numerator.round(9).tolist(), float((found.numerator[1] / found.denominator[1]).round(9))
    ([1.0, 0.948683298], 3.0)
    """
    scale_a, scale_b = (np.maximum(np.max(np.abs(M), axis=(-2, -1)), 1e-300) for M in (A, B))
    A, B = A / scale_a[..., None, None], B / scale_b[..., None, None]
    c0, c1, c2 = determinant(A), _both(A, B), determinant(B)
    inside = c1 * c1 - 4 * c0 * c2
    real = inside >= -((2 * REAL) ** 2) * np.maximum(c1 * c1, np.abs(c0 * c2))
    q = -0.5 * (c1 + np.copysign(np.sqrt(np.maximum(inside, 0.0)), c1))
    x, k = np.stack([q, c0], axis=-1), np.stack([c2, q], axis=-1)
    none = (x == 0) & (k == 0)  # a double root 0 or infinite, c1 = 0: the other formula has it
    x, k = np.where(none, x[..., ::-1], x), np.where(none, k[..., ::-1], k)
    length = np.hypot(x, k)
    length = np.where(length > 0, length, 1.0)
    x, k = _polished(A[..., None, :, :], B[..., None, :, :], x / length, k / length)
    rows = k[..., None, None] * A[..., None, :, :] + x[..., None, None] * B[..., None, :, :]
    free = _free(A, B)
    alone = (np.max(np.abs(rows), axis=(-2, -1)) > SINGULAR) & ~_parallel(A, B)[..., None]
    x, k = x / scale_b[..., None], k / scale_a[..., None]
    length = np.hypot(x, k)
    are_real = (real & ~free)[..., None] & np.ones(2, dtype=bool)
    return Roots(x / length, k / length, null_vector(rows), are_real, alone, free)


def determinant(rows: Rows) -> Num[np.ndarray, "*batch"]:
    """Determinant of 2 x 2 matrices."""
    return np.asarray(rows[..., 0, 0] * rows[..., 1, 1] - rows[..., 0, 1] * rows[..., 1, 0])


def null_vector(rows: Rows) -> Float[np.ndarray, "*batch 2"]:
    """Unit v with M v = 0 of matrices of rank 1: normal to the longer row.

    >>> null_vector(np.array([[0.0, 2.0], [0.0, 1.0]])).tolist()
    [1.0, 0.0]
    """
    size = np.hypot(rows[..., 0], rows[..., 1])
    longer = np.argmax(size, axis=-1)[..., None, None]
    row = np.take_along_axis(rows, longer, axis=-2)[..., 0, :]
    length = np.take_along_axis(size, longer[..., 0], axis=-1)
    found = np.stack([row[..., 1], -row[..., 0]], axis=-1)
    return np.asarray(found / np.where(length > 0, length, 1.0)) + 0.0


def _both(A: NumberArray, B: NumberArray) -> NumberArray:
    """tr(adj(A) B)."""
    straight = A[..., 0, 0] * B[..., 1, 1] + A[..., 1, 1] * B[..., 0, 0]
    return np.asarray(straight - A[..., 0, 1] * B[..., 1, 0] - A[..., 1, 0] * B[..., 0, 1])


def _free(A: NumberArray, B: NumberArray) -> Bool[np.ndarray, "*batch"]:
    """Whether k A + x B is singular in every direction."""
    tried = np.sin(TURNS)[:, None, None] * B[..., None, :, :] + np.cos(TURNS)[:, None, None] * A[..., None, :, :]
    size = np.sqrt(np.sum(tried * tried, axis=(-2, -1)))
    least = np.abs(determinant(tried)) / np.where(size > 0, size, 1.0)  # approximately the smaller singular value
    return np.asarray(np.max(least, axis=-1) <= SINGULAR)


def _parallel(A: NumberArray, B: NumberArray) -> Bool[np.ndarray, "*batch"]:
    """Whether A is a multiple of B: a double root, split by rounding, with any null vector."""
    share = np.sum(A * B, axis=(-2, -1)) / np.maximum(np.sum(B * B, axis=(-2, -1)), 1e-300)
    return np.asarray(np.max(np.abs(A - share[..., None, None] * B), axis=(-2, -1)) <= SINGULAR)


def _polished(A: NumberArray, B: NumberArray, x: NumberArray, k: NumberArray) -> tuple[NumberArray, NumberArray]:
    """Newton's method on the determinant, which has the roots more exactly than the quadratic's coefficients."""
    turned = np.abs(x) > np.abs(k)
    P, Q = np.where(turned[..., None, None], B, A), np.where(turned[..., None, None], A, B)
    greater, less = np.where(turned, x, k), np.where(turned, k, x)
    y = less / np.where(greater == 0, 1.0, greater)
    for _ in range(POLISHED):
        rows = P + y[..., None, None] * Q
        slope = _both(rows, Q)
        step = determinant(rows) / np.where(slope == 0, np.inf, slope)
        y = np.where(np.abs(step) < 1e-6, y - step, y)
    length = np.hypot(1.0, y)
    return np.where(turned, 1.0, y) / length, np.where(turned, y, 1.0) / length
