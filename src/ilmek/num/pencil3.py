"""Many pencils of 3 x 3 matrices at once: all roots of det(k A + x B) = 0 with their null vectors.

    det(k A + x B) = k³ det A + k² x tr(adj(A) B) + k x² tr(adj(B) A) + x³ det B

Roots are ratios x : k, so that an infinite one (k = 0) is a root like any other: the pencil is first rotated
in the plane of (x, k) to a direction with a large determinant, so that no root is near infinity.
[derived from the expansion of the determinant]
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Bool, Float, Num, NumberArray

Rows = Num[np.ndarray, "*batch 3 3"]

TURNS = np.pi * np.array([0.0, 0.25, 0.5, 0.75, 0.1, 0.6])
"""Directions in the plane of (x, k) for the rotation; a cubic vanishes in three directions at most."""

REAL = 1e-6
"""Greatest imaginary part of a real root, relative to the root or 1: rounding splits a double root that far."""

SINGULAR = 1e-9
"""Greatest singular value, relative to the pencil, that counts as zero."""

POLISHED = 3
"""Number of Newton steps on the determinant after the eigenvalues."""


class Roots(NamedTuple):
    """The n roots of each pencil of n x n matrices.

    numerator, denominator  x and k of x : k = root, x² + k² = 1
    vectors  unit v with (k A + x B) v = 0          real  whether the root is real; other rows have no meaning
    alone    whether the null space has dimension 1      free  whether the pencil is singular for every x, without roots
    """

    numerator: Float[np.ndarray, "*batch n"]
    denominator: Float[np.ndarray, "*batch n"]
    vectors: Float[np.ndarray, "*batch n n"]
    real: Bool[np.ndarray, "*batch n"]
    alone: Bool[np.ndarray, "*batch n"]
    free: Bool[np.ndarray, "*batch"]


def adjugate(rows: Rows) -> Num[np.ndarray, "*batch 3 3"]:
    """adj(M) with adj(M) M = det(M) 1: its columns are the vector products of the rows of M.

    >>> adjugate(np.diag([1.0, 2.0, 3.0])).diagonal()
    array([6., 3., 2.])
    """
    one, two, three = rows[..., 0, :], rows[..., 1, :], rows[..., 2, :]
    return np.stack([product(two, three), product(three, one), product(one, two)], axis=-1)


def product(u: NumberArray, v: NumberArray) -> Num[np.ndarray, "... 3"]:
    """Vector product in space over the last axis; complex vectors are not conjugated."""
    x, y, z = u[..., 0], u[..., 1], u[..., 2]
    a, b, c = v[..., 0], v[..., 1], v[..., 2]
    return np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=-1)


def determinant(rows: Rows) -> Num[np.ndarray, "*batch"]:
    """Determinant of 3 x 3 matrices."""
    return np.asarray(np.sum(rows[..., 0, :] * product(rows[..., 1, :], rows[..., 2, :]), axis=-1))


def null_vector(rows: Rows) -> Float[np.ndarray, "*batch 3"]:
    """Unit v with M v = 0 of matrices of rank 2: the longest vector product of two rows."""
    columns = adjugate(rows)
    size = np.sum(columns * columns, axis=-2)
    longest = np.argmax(size, axis=-1)[..., None, None]
    found = np.take_along_axis(columns, longest, axis=-1)[..., 0]
    length = np.sqrt(np.take_along_axis(size, longest[..., 0], axis=-1))
    return np.asarray(found / np.where(length > 0, length, 1.0))


def roots3(A: Float[np.ndarray, "*batch 3 3"], B: Float[np.ndarray, "*batch 3 3"]) -> Roots:
    """All roots of det(k A + x B) = 0 for each pencil, by eigenvalues and Newton's method.

    >>> found = roots3(np.diag([1.0, -6.0, -4.0]), np.diag([1.0, 2.0, 2.0]))
    >>> np.sort(found.numerator / found.denominator).round(12)
    array([-1.,  2.,  3.])
    """
    scale_a, scale_b = (np.maximum(np.max(np.abs(M), axis=(-2, -1)), 1e-300) for M in (A, B))
    A, B = A / scale_a[..., None, None], B / scale_b[..., None, None]
    form = _form(A, B)
    best = TURNS[np.argmax(np.abs(_at(form, np.sin(TURNS), np.cos(TURNS))), axis=-1)]
    s, c = np.sin(best)[..., None, None], np.cos(best)[..., None, None]
    # In the turned plane (x, k) = y (s, c) + (c, -s): the leading matrix is the one with the large determinant.
    free = _singular(s * B + c * A)
    Y = np.where(free[..., None, None], np.eye(3), s * B + c * A)
    X = np.where(free[..., None, None], np.eye(3), c * B - s * A)
    y = _companion_roots(_form(X, Y))
    real = np.abs(y.imag) <= REAL * np.maximum(1.0, np.abs(y))
    at = _polished(X[..., None, :, :], Y[..., None, :, :], y.real)
    rows = X[..., None, :, :] + at[..., None, None] * Y[..., None, :, :]
    size = np.maximum(1.0, np.abs(at))
    alone = np.max(np.abs(adjugate(rows)), axis=(-2, -1)) > SINGULAR * size**2
    x, k = at * s[..., 0] + c[..., 0], at * c[..., 0] - s[..., 0]
    x, k = x / scale_b[..., None], k / scale_a[..., None]
    length = np.hypot(x, k)
    return Roots(x / length, k / length, null_vector(rows), real & ~free[..., None], alone, free)


def _form(A: NumberArray, B: NumberArray) -> NumberArray:
    """Coefficients of k³, k² x, k x², x³ in det(k A + x B)."""
    by_a = np.sum(np.swapaxes(adjugate(A), -1, -2) * B, axis=(-2, -1))
    by_b = np.sum(np.swapaxes(adjugate(B), -1, -2) * A, axis=(-2, -1))
    return np.stack([determinant(A), by_a, by_b, determinant(B)], axis=-1)


def _at(form: NumberArray, x: NumberArray, k: NumberArray) -> NumberArray:
    c0, c1, c2, c3 = (form[..., i, None] for i in range(4))
    return np.asarray(c0 * k**3 + c1 * k**2 * x + c2 * k * x**2 + c3 * x**3)


def _singular(rows: NumberArray) -> Bool[np.ndarray, "*batch"]:
    """Whether the rank is below 3; singular values are computed for small determinants only."""
    small = np.asarray(np.abs(determinant(rows)) < 1e3 * SINGULAR)
    if small.any():
        small[small] = np.linalg.svd(rows[small], compute_uv=False)[..., -1] < SINGULAR
    return small


def _companion_roots(form: NumberArray) -> NumberArray:
    """Roots of c0 + c1 y + c2 y² + c3 y³, c3 large."""
    companion = np.zeros((*form.shape[:-1], 3, 3))
    companion[..., 1, 0] = companion[..., 2, 1] = 1.0
    companion[..., :, 2] = -form[..., :3] / form[..., 3:]
    return np.linalg.eigvals(companion) + 0j


def _polished(X: NumberArray, Y: NumberArray, y: NumberArray) -> NumberArray:
    """Newton's method on det(X + y Y), which has the roots more exactly than the cubic's coefficients."""
    for _ in range(POLISHED):
        rows = X + y[..., None, None] * Y
        slope = np.sum(np.swapaxes(adjugate(rows), -1, -2) * Y, axis=(-2, -1))
        step = determinant(rows) / np.where(slope == 0, np.inf, slope)
        y = np.where(np.abs(step) < 1e-3 * np.maximum(1.0, np.abs(y)), y - step, y)
    return y
