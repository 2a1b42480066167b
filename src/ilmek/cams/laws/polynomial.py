"""Free polynomial: one term for each condition on s and its derivatives, at both ends and between them.

    s(u) = sum c_k u^k,     s^(m)(u_i) = given                             [Norton, Cam Design and Manufacturing, 4]

From (0, 0, 0) to (1, 0, 0) it is the 3-4-5 polynomial; with one more derivative at each end it is 4-5-6-7. With end
velocities it joins parts of constant speed. A point between the ends is met exactly. A value of nan leaves that
derivative free.

The system is solved in Chebyshev polynomials of z = 2u - 1, which are better conditioned than powers of u. A derivative
given between the ends, or a derivative left free below a given one, can make the system singular. Its condition number
shows this, and an error reports it.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from ilmek.arrays import FloatArray
from ilmek.cams.laws.law import Law, LawFamily
from ilmek.cams.laws.piecewise import Piecewise, law_of_pieces
from ilmek.errors import ParameterError

MOST = 16
"""Largest number of conditions; with more the polynomial oscillates too much between them for any follower."""

_SINGULAR = 1e-10
_NAMES = ("s", "s'", "s''", "s'''")


class Condition(NamedTuple):
    """The derivative of order 0 to 3 at u in [0, 1] equals `value`."""

    u: float
    order: int
    value: float


def law(
    start: Sequence[float],
    end: Sequence[float],
    u: Sequence[float] = (),
    s: Sequence[float] = (),
    orders: Sequence[float] = (),
) -> Law:
    """The polynomial of lowest degree that meets the conditions.

    start, end   s, s', s'', s''' at u = 0 and at u = 1 [-], up to four values each; nan leaves a derivative free
    u, s         points in [0, 1] and the values there, of one length
    orders       order of the derivative (0 to 3) that each value of `s` belongs to; default: 0 for all
    Raises ParameterError for conditions that contradict each other or cannot be met, and for more than 16.

    >>> round(law((0, 0, 0), (1, 0, 0)).acceleration_peak, 6)
    5.773503
    """
    conditions = (*_ends(start, end), *_between(u, s, orders))
    parameters = {
        "start": tuple(map(float, start)),
        "end": tuple(map(float, end)),
        "u": tuple(map(float, u)),
        "s": tuple(map(float, s)),
        "orders": tuple(map(float, orders)),
    }
    return law_of_pieces("polynomial", Piecewise(np.array([0.0, 1.0]), solved(conditions)[None, :]), parameters)


FAMILY = LawFamily(law, {"start": (0.0, 0.0, 0.0), "end": (1.0, 0.0, 0.0), "u": (), "s": (), "orders": ()})


def solved(conditions: Sequence[Condition]) -> FloatArray:
    """Coefficients [1] by u, the constant first, shape (terms,), of the polynomial that meets the conditions.

    Raises ParameterError for no or too many conditions, for contradicting ones, and where no polynomial meets them.
    """
    _check(conditions)
    count = len(conditions)
    basis = np.eye(count)
    derivatives = [
        chebyshev.chebder(basis, order, 2.0, axis=0) if order < count else basis[:1] * 0 for order in range(4)
    ]
    matrix = np.array([chebyshev.chebval(2.0 * at - 1.0, derivatives[order]) for at, order, _ in conditions])
    size = np.abs(matrix).max(axis=1)
    values = np.array([value for _, _, value in conditions])
    if np.min(size) == 0 or np.linalg.cond(matrix / size[:, None]) > 1 / _SINGULAR:
        raise _not_met(conditions)
    by_z = chebyshev.cheb2poly(np.linalg.solve(matrix / size[:, None], values / size))
    return _about_the_start(by_z)


def _about_the_start(by_z: FloatArray) -> FloatArray:
    """Coefficients by u of a polynomial given by z = 2u - 1."""
    by_u = np.zeros(1)
    for coefficient in by_z[::-1]:
        by_u = np.convolve(by_u, [-1.0, 2.0])
        by_u[0] += coefficient
    return by_u[: by_z.size]


def _ends(start: Sequence[float], end: Sequence[float]) -> tuple[Condition, ...]:
    for name, row in (("start", start), ("end", end)):
        if len(row) > len(_NAMES):
            raise ParameterError(f"polynomial: {name} has {len(row)} values", allowed="at most s, s', s'', s'''")
    rows = ((0.0, start), (1.0, end))
    return tuple(
        Condition(u, order, float(value)) for u, row in rows for order, value in enumerate(row) if not math.isnan(value)
    )


def _between(u: Sequence[float], s: Sequence[float], orders: Sequence[float]) -> tuple[Condition, ...]:
    orders = orders or [0.0] * len(u)
    if not len(u) == len(s) == len(orders):
        raise ParameterError(
            f"polynomial: {len(u)} points u, {len(s)} values s, {len(orders)} orders", allowed="as many of each"
        )
    for at, order in zip(u, orders, strict=True):
        if not 0 <= at <= 1 or order not in {0, 1, 2, 3}:
            raise ParameterError(f"polynomial: order {order:g} at u={at:g}", allowed="u from 0 to 1, orders 0 to 3")
    return tuple(Condition(float(at), int(m), float(value)) for at, value, m in zip(u, s, orders, strict=True))


def _check(conditions: Sequence[Condition]) -> None:
    if not 0 < len(conditions) <= MOST:
        raise ParameterError(f"polynomial: {len(conditions)} conditions", allowed=f"1 to {MOST}", do="use a spline")
    seen: dict[tuple[float, int], float] = {}
    for condition in conditions:
        u, order, value = condition
        if not math.isfinite(value):
            raise ParameterError(f"polynomial: {_shown(condition)}", allowed="a finite number")
        other = seen.setdefault((u, order), value)
        if other != value:
            both = f"{_shown(Condition(u, order, other))} and {_shown(condition)}"
            raise ParameterError(f"polynomial: {both} contradict each other", do="give one of them")
    if len(seen) < len(conditions):
        raise ParameterError("polynomial: a condition is given twice", do="give it once")


def _not_met(conditions: Sequence[Condition]) -> ParameterError:
    shown = ", ".join(_shown(condition) for condition in conditions)
    return ParameterError(
        f"polynomial: no polynomial of degree {len(conditions) - 1} meets {shown}, or more than one does",
        allowed="a value of s, and all lower derivatives wherever a derivative is given",
        do="move a point, or give the missing derivatives",
    )


def _shown(condition: Condition) -> str:
    return f"{_NAMES[condition.order]}({condition.u:g}) = {condition.value:g}"
