"""Intersections of two conics: all four points of the projective plane, for batches of pairs.

    sᵀ C s = 0   and   sᵀ D s = 0,      s = (s_1, s_2, s_3), homogeneous coordinates

The resultant of the two is a quartic in one ratio. Its roots are eigenvalues; Newton's method on the conics refines the
points to the last digits. Points at infinity are no exception, since a fixed rotation is applied to the plane first.
[derived from the resultant]
"""

from typing import NamedTuple, TypeAlias

import numpy as np
from scipy.spatial.transform import Rotation

from ilmek.arrays import Bool, BoolArray, Complex, Float, NumberArray
from ilmek.num.pencil3 import REAL, product

Conic: TypeAlias = Float[np.ndarray, "*batch 3 3"]

TURN = Rotation.from_euler("zyx", [0.7133, -0.4719, 1.1327]).as_matrix()
"""The fixed rotation, generic: no practical intersection is at infinity after it."""

STEPS = 4
"""Maximum number of Newton steps."""

SAME = 1e-13
"""Greatest resultant of two conics, normalised, at which they count as having a common line."""

TWICE = 1e-9
"""Greatest distance of unit vectors that count as one double root."""


class Intersections(NamedTuple):
    """Intersections s [unit vectors] of two conics.

    points  four of each pair, complex, with multiplicity
    real    whether the point is real and not a repetition      share  whether the conics have a common line
    """

    points: Complex[np.ndarray, "*batch 4 3"]
    real: Bool[np.ndarray, "*batch 4"]
    share: Bool[np.ndarray, "*batch"]


def meet(C: Conic, D: Conic) -> Intersections:
    """All four intersections of two conics given by symmetric matrices; undefined for conics with a common line.

    C, D  symmetric matrices, shape (..., 3, 3), any factor
    Returns points of shape (..., 4, 3); complex ones and repeated ones are marked as not real.

    >>> found = meet(np.diag([1.0, 1.0, -5.0]), np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -4]]))  # x² + y² = 5, xy = 2
    >>> positions = found.points.real / found.points.real[:, 2:]
    >>> sorted((round(x, 9), round(y, 9)) for x, y, _ in positions.tolist())
    [(-2.0, -1.0), (-1.0, -2.0), (1.0, 2.0), (2.0, 1.0)]
    """
    C, D = (TURN.T @ conic @ TURN for conic in (C, D))
    C, D = (conic / np.maximum(np.max(np.abs(conic), axis=(-2, -1), keepdims=True), 1e-300) for conic in (C, D))
    start, share = _first(C, D)
    s = _upright(_polished(C[..., None, :, :], D[..., None, :, :], start))
    real = np.max(np.abs(s.imag), axis=-1) <= REAL
    s = np.where(real[..., None], s.real + 0j, s)
    s = _polished(C[..., None, :, :], D[..., None, :, :], s)
    return Intersections(s @ TURN.T, real & ~_is_repeated(s, real), share)


def _first(C: Conic, D: Conic) -> tuple[NumberArray, BoolArray]:
    """Points (x, y, 1) by the resultant in y: p x² + q x + r of each conic, p of degree 0, q of 1, r of 2 in y."""
    one, two = ((conic[..., 0, 0, None], 2 * conic[..., [2, 1], [0, 0]], _square(conic)) for conic in (C, D))
    outer = one[0] * two[2] - two[0] * one[2]  # (p r), degree 2
    lower = one[0] * two[1] - two[0] * one[1]  # (p q), degree 1
    upper = _times(one[1], two[2]) - _times(two[1], one[2])  # (q r), degree 3
    quartic = _times(outer, outer) - _times(lower, upper)
    share = np.asarray(np.max(np.abs(quartic), axis=-1) < SAME)
    y = _roots(quartic)
    x = -_value(outer, y) / _value(lower, y)
    x = np.where(np.isfinite(x), x, 0.0)
    return _unit(np.stack([x, y, np.ones(y.shape)], axis=-1)), share


def _square(conic: NumberArray) -> NumberArray:
    """Terms of a conic without x: coefficients of 1, y, y²."""
    return np.stack([conic[..., 2, 2], 2 * conic[..., 1, 2], conic[..., 1, 1]], axis=-1)


def _times(p: NumberArray, q: NumberArray) -> NumberArray:
    """Product of polynomials, coefficients rising, over the last axis."""
    found = np.zeros((*p.shape[:-1], p.shape[-1] + q.shape[-1] - 1))
    for i in range(p.shape[-1]):
        found[..., i : i + q.shape[-1]] += p[..., i, None] * q
    return found


def _value(p: NumberArray, y: NumberArray) -> NumberArray:
    total = np.zeros(y.shape, dtype=complex)
    for i in range(p.shape[-1] - 1, -1, -1):
        total = total * y + p[..., i, None]
    return np.where(total == 0, 1e-300, total)


def _roots(quartic: NumberArray) -> NumberArray:
    companion = np.zeros((*quartic.shape[:-1], 4, 4))
    companion[..., [1, 2, 3], [0, 1, 2]] = 1.0
    lead = np.where(quartic[..., 4:] == 0, 1e-300, quartic[..., 4:])
    companion[..., :, 3] = np.clip(-quartic[..., :4] / lead, -1e150, 1e150)
    return np.linalg.eigvals(companion) + 0j


def _polished(C: NumberArray, D: NumberArray, s: NumberArray) -> NumberArray:
    """Newton's method on both conics, normal to s; steps that do not reduce the error are rejected."""
    best, step = _off(C, D, s)
    for _ in range(STEPS):
        tried = _unit(s - step)
        missed, further = _off(C, D, tried)
        nearer = (missed < best)[..., None]
        s, best = np.where(nearer, tried, s), np.minimum(missed, best)
        step = np.where(nearer, further, 0.0)
    return s


def _off(C: NumberArray, D: NumberArray, s: NumberArray) -> tuple[NumberArray, NumberArray]:
    """Residual of both conics at s, and Newton's step."""
    by_c, by_d = (np.sum(conic * s[..., None, :], axis=-1) for conic in (C, D))
    off_c, off_d = (0.5 * np.sum(s * by, axis=-1, keepdims=True) for by in (by_c, by_d))
    normal = np.conj(s)
    across, along = product(by_d, normal), product(normal, by_c)
    whole = np.sum(by_c * across, axis=-1, keepdims=True)
    step = (off_c * across + off_d * along) / np.where(whole == 0, np.inf, whole)
    return np.maximum(np.abs(off_c), np.abs(off_d))[..., 0], step


def _unit(s: NumberArray) -> NumberArray:
    return np.asarray(s / np.sqrt(np.sum(np.abs(s) ** 2, axis=-1, keepdims=True)))


def _upright(s: NumberArray) -> NumberArray:
    """The same point with a real largest component."""
    largest = np.take_along_axis(s, np.argmax(np.abs(s), axis=-1)[..., None], axis=-1)
    return np.asarray(s * np.conj(largest) / np.abs(largest))


def _is_repeated(s: NumberArray, real: BoolArray) -> BoolArray:
    """Whether a real point is close to an earlier one: the second half of a double root."""
    apart = product(s.real[..., :, None, :], s.real[..., None, :, :])
    close = np.sum(apart * apart, axis=-1) < TWICE**2
    return np.asarray(np.any(np.tril(close & real[..., None, :], -1), axis=-1))
