"""Many small linear systems at once."""

from typing import TypeAlias

import numpy as np

from ilmek.arrays import Float

Matrices: TypeAlias = Float[np.ndarray, "*batch n n"]
Vectors: TypeAlias = Float[np.ndarray, "*batch n"]


def solve_many(matrix: Matrices, right: Vectors) -> Vectors:
    """Solution x (..., n) of matrix (..., n, n) x = right (..., n); NaN where a system is singular or not finite.

    >>> solve_many(np.array([[[2.0, 0.0], [0.0, 4.0]], [[1.0, 1.0], [1.0, 1.0]]]), np.ones((2, 2)))
    array([[0.5 , 0.25],
           [ nan,  nan]])
    """
    usable = np.isfinite(matrix).all(axis=(-2, -1)) & np.isfinite(right).all(axis=-1)
    size = matrix.shape[-1]
    safe = np.where(usable[..., None, None], matrix, np.eye(size))
    try:
        found = np.linalg.solve(safe, right[..., None])[..., 0]
    except np.linalg.LinAlgError:  # one exactly singular system fails the whole batch: leave such systems out
        regular = np.linalg.matrix_rank(safe) == size
        usable &= regular
        safe = np.where(regular[..., None, None], safe, np.eye(size))
        found = np.linalg.solve(safe, right[..., None])[..., 0]
    return np.where(usable[..., None], found, np.nan)


def reciprocal_condition(matrix: Matrices) -> Float[np.ndarray, "*batch"]:
    """Ratio of the smallest to the largest singular value: 1 at best, 0 if singular, NaN if not finite.

    >>> reciprocal_condition(np.array([[[2.0, 0.0], [0.0, 4.0]]]))
    array([0.5])
    """
    usable = np.isfinite(matrix).all(axis=(-2, -1))
    values = np.linalg.svd(np.where(usable[..., None, None], matrix, np.eye(matrix.shape[-1])), compute_uv=False)
    largest = np.where(values[..., 0] > 0, values[..., 0], 1.0)
    return np.where(usable, values[..., -1] / largest, np.nan)
