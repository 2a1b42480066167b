"""Proof that a system of equations has exactly one root near a computed one (Krawczyk's operator).

    K(X) = x - Y f(x) + (I - Y f'(X)) (X - x),     Y near the inverse of f'(x)

If K(X) lies in the interior of the box X around x, the box contains exactly one root, and the root lies in K(X). f(x)
and f'(X) are intervals; the products with Y are bounded by the error of floating-point sums, n eps sum |Y| |f|.
[Krawczyk 1969; Rump, Verification methods, Acta Numerica 19 (2010), section 13]
"""

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import Bool, Float
from ilmek.num.intervals import Intervals
from ilmek.num.linear import Matrices, Vectors

IntervalSystem: TypeAlias = Callable[[Intervals], tuple[Intervals, Intervals]]
"""X (..., n) -> intervals of f(X) (..., n) and f'(X) (..., n, n)."""

INFLATIONS = (2.0, 16.0, 1e3, 1e5)
"""Trial sizes of the box, in lengths of the last Newton step and of rounding."""


REFINEMENTS = 2
"""Newton steps with f(x) in extended precision, before the proof."""


class CertifiedRoots(NamedTuple):
    """Which systems have a proven root; roots, improved; the distance of the exact ones from them, by unknown."""

    certified: Bool[np.ndarray, "*batch"]
    roots: Vectors
    radius: Vectors


def certified_roots(system: IntervalSystem, near: Vectors) -> CertifiedRoots:
    """Prove the roots near computed ones, for every system of the batch, and improve them.

    system  see `IntervalSystem`; constants that are not exact are intervals in it. It is called with X of double and of
            extended precision: with constants to extended precision (`Intervals.rounded`) also poor roots are proven
    near    x (..., n), computed to rounding (Newton's method)

    A system that is singular, or whose root is not separate from another one by some 1e4 times the rounding, is not
    certified; its radius is NaN.

    >>> def circle_and_line(X):  # x² + y² = 2, x = y
    ...     x, y = X[..., 0], X[..., 1]
    ...     f = stacked([x.square + y.square - 2.0, x - y], -1)
    ...     one = Intervals.of(np.ones(x.low.shape))
    ...     return f, stacked([stacked([x * 2.0, y * 2.0], -1), stacked([one, -one], -1)], -2)
    >>> from ilmek.num.intervals import stacked
    >>> found = certified_roots(circle_and_line, np.array([[1.0, 1.0], [0.0, 0.0]]))
    >>> found.certified.tolist(), bool(found.radius[0].max() < 1e-14)
    ([True, False], True)
    """
    _, slope = system(Intervals.of(near))
    inverse = _inverses(slope.middle)
    for _ in range(REFINEMENTS):
        near = _improved(system, near, inverse)
    step = _product_bound(inverse, _value(system, near))
    certified, radius = np.zeros(near.shape[:-1], dtype=bool), np.full(near.shape, np.nan)
    floor = 4 * np.finfo(float).eps * np.abs(near) + np.finfo(float).tiny
    for inflation in INFLATIONS:
        box = inflation * step + floor
        _, slopes = system(Intervals.around(near, box))
        contraction = _contraction(inverse, slopes)
        reach = (step + (contraction @ box[..., None])[..., 0]) * _safety(near.shape[-1])
        proven = (reach < box).all(axis=-1) & ~certified
        radius[proven], certified = reach[proven], certified | proven
        if certified.all():
            break
    return CertifiedRoots(certified, near, radius)


def _value(system: IntervalSystem, near: Vectors) -> Intervals:
    """f(x), computed in extended precision where the processor has it."""
    value, _ = system(Intervals.of(near.astype(np.longdouble)))
    return value.rounded(np.dtype(float))


def _improved(system: IntervalSystem, near: Vectors, inverse: Matrices) -> Vectors:
    """A step of Newton's method; the given root where it is not finite."""
    value = _value(system, near).middle
    better = near - (inverse @ value[..., None])[..., 0]
    return np.where(np.isfinite(better), better, near)


def _safety(size: int) -> float:
    """Factor above the relative error of sums of that many non-negative terms."""
    return 1 + 4 * (size + 4) * float(np.finfo(float).eps)


def _rounding(size: int) -> float:
    """Error of a sum of products relative to the sum of their magnitudes."""
    return 2 * (size + 4) * float(np.finfo(float).eps)


def _inverses(matrix: Matrices) -> Matrices:
    """Approximate inverses; 0 where there is none: the root is then not certified."""
    found = np.zeros(matrix.shape)
    for index in np.ndindex(matrix.shape[:-2]):
        if np.isfinite(matrix[index]).all():
            try:
                inverse = np.linalg.inv(matrix[index])
            except np.linalg.LinAlgError:
                continue
            found[index] = inverse if np.isfinite(inverse).all() else 0.0
    return found


def _product_bound(inverse: Matrices, value: Intervals) -> Vectors:
    """Upper bound of |Y f|."""
    size, middle = inverse.shape[-1], value.middle[..., None]
    computed = np.abs(inverse @ middle)
    spread = np.abs(inverse) @ (value.radius[..., None] + _rounding(size) * np.abs(middle))
    return np.asarray((computed + spread)[..., 0] * _safety(size))


def _contraction(inverse: Matrices, slopes: Intervals) -> Float[np.ndarray, "*batch n n"]:
    """Upper bound of |I - Y f'(X)|."""
    size, middle = inverse.shape[-1], slopes.middle
    computed = np.abs(np.eye(size) - inverse @ middle)
    spread = np.abs(inverse) @ (slopes.radius + _rounding(size) * np.abs(middle))
    return np.asarray((computed + spread + _rounding(size)) * _safety(size))
