"""Roots and minima within brackets, many at once, to machine precision."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Bool, Float

Reals: TypeAlias = Float[np.ndarray, " brackets"]

GOLDEN = 0.6180339887498949
"""Ratio of successive brackets of the golden section."""


def bracketed_roots(f: Callable[[Reals], Reals], low: Reals, high: Reals, *, steps: int = 200) -> Reals:
    """Root of f within each bracket, to rounding; NaN where f has equal signs at both ends, or is not finite there.

    f  (brackets,) -> (brackets,)      low, high  ends of the brackets (brackets,), in either order
    Inverse quadratic interpolation where it is safe, else bisection [Chandrupatla, A new hybrid quadratic / bisection
    algorithm for finding the zero of a nonlinear function without using derivatives, 1997].

    >>> bracketed_roots(lambda x: x * x - 2, np.array([0.0, 2.0]), np.array([2.0, 3.0]))
    array([1.41421356,        nan])
    """
    x1, x2 = np.array(low, dtype=float), np.array(high, dtype=float)
    f1, f2 = f(x1), f(x2)
    usable: Bool[np.ndarray, " brackets"] = np.sign(f1) * np.sign(f2) <= 0
    x3, f3, share = x1, f1, np.full(x1.shape, 0.5)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for _ in range(steps):
            best = np.where(np.abs(f1) < np.abs(f2), x1, x2)
            width = np.abs(x2 - x1)
            least = 2 * np.finfo(float).eps * np.maximum(np.abs(best), np.finfo(float).tiny) / width
            done = (np.minimum(np.abs(f1), np.abs(f2)) == 0) | ~(least <= 0.5) | ~usable
            if done.all():
                break
            share = np.where(done, 0.0, np.clip(share, least, 1 - least))
            x = x1 + share * (x2 - x1)
            value = f(x)
            same = np.sign(value) == np.sign(f1)
            x3, f3 = np.where(done, x3, np.where(same, x1, x2)), np.where(done, f3, np.where(same, f1, f2))
            x2, f2 = np.where(done | same, x2, x1), np.where(done | same, f2, f1)
            x1, f1 = np.where(done, x1, x), np.where(done, f1, value)
            share = _next_share(x1, x2, x3, f1, f2, f3)
    return np.where(usable, np.where(np.abs(f1) < np.abs(f2), x1, x2), np.nan)


def bracketed_minima(f: Callable[[Reals], Reals], low: Reals, high: Reals, *, steps: int = 60) -> tuple[Reals, Reals]:
    """Argument and value of a minimum of f within each bracket, by golden sections; f may have kinks.

    Of several minima in a bracket one is found. 60 steps reduce a bracket to rounding.
    f  (brackets,) -> (brackets,)      low, high  ends of the brackets, shape (brackets,)
    [Kiefer, Sequential minimax search for a maximum, Proc. AMS 4, 1953]

    >>> at, least = bracketed_minima(lambda x: np.abs(x - 0.3), np.array([0.0]), np.array([1.0]))
    >>> at.round(12).tolist(), least.round(12).tolist()
    ([0.3], [0.0])
    """
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = f(left), f(right)
    for _ in range(steps):
        to_left = at_left < at_right
        low, high = np.where(to_left, low, left), np.where(to_left, right, high)
        fresh = np.where(to_left, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        value = f(fresh)
        left, right = np.where(to_left, fresh, right), np.where(to_left, left, fresh)
        at_left, at_right = np.where(to_left, value, at_right), np.where(to_left, at_left, value)
    return np.where(at_left < at_right, left, right), np.minimum(at_left, at_right)


def _next_share(x1: Reals, x2: Reals, x3: Reals, f1: Reals, f2: Reals, f3: Reals) -> Reals:  # noqa: PLR0917
    """Next fraction between x1 and x2: by the inverse parabola through the points if monotone, else 1/2."""
    xi, phi = (x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2)
    smooth = (phi * phi < xi) & ((1 - phi) ** 2 < 1 - xi)
    parabola = f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
    share: Reals = np.where(smooth & np.isfinite(parabola), parabola, 0.5)
    return share
