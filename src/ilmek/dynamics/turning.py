"""A turn of a curve that may jump: where it is zero, and its integral, piece by smooth piece."""

import math
from collections.abc import Callable, Iterable, Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.peaks import Piece, SidedCurves, pieces
from ilmek.units import turn

HALVINGS = 60
NODES = 24
"""Nodes of Gauss and Legendre on each part: exact for polynomials of degree 47."""

PARTS = 16
"""Parts of a turn that are integrated one by one."""


def zeros(curve: Callable[[FloatArray], FloatArray], samples: int = 720) -> FloatArray:
    """Angles in [0, 2 pi) where a continuous curve of period 2 pi changes its sign, ascending, to rounding.

    Two changes closer than the samples are not seen.
    >>> zeros(lambda angle: np.cos(angle - 1)).round(12).tolist()
    [2.570796326795, 5.712388980385]
    """
    angle = np.arange(samples + 1) * (turn / samples)
    positive = curve(angle) > 0
    places = np.flatnonzero(positive[1:] != positive[:-1])
    low, high, below = angle[places], angle[places + 1], positive[places]
    for _ in range(HALVINGS if places.size else 0):
        middle = (low + high) / 2
        left = (curve(middle) > 0) == below
        low, high = np.where(left, middle, low), np.where(left, high, middle)
    return np.sort(np.mod(high, turn))


def integrals(curves: SidedCurves, breaks: Iterable[float] = ()) -> dict[str, float]:
    """Integral of each curve over a turn, smooth between the `breaks` [rad], by Gauss and Legendre on each piece.

    >>> round(integrals(lambda angle, _: {"square": np.cos(angle) ** 2})["square"] / np.pi, 12)
    1.0
    """
    return {name: math.fsum(found) for name, found in piecewise(curves, breaks, PARTS)[1].items()}


def piecewise(
    curves: SidedCurves, breaks: Iterable[float], parts: int
) -> tuple[tuple[Piece, ...], dict[str, FloatArray]]:
    """The turn cut at the breaks and into even parts, and the integral of each curve over each piece of it."""
    cut = pieces((*breaks, *(turn / parts * np.arange(parts))))
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    half = np.array([[(piece.end - piece.start) / 2] for piece in cut])
    angle = np.array([[piece.start] for piece in cut]) + half * (1 + nodes)
    side = np.array([piece.sides(row) for piece, row in zip(cut, angle, strict=True)])
    values: Mapping[str, FloatArray] = curves(np.ravel(angle), np.ravel(side))
    return cut, {name: np.sum(half * weights * np.reshape(value, side.shape), axis=1) for name, value in values.items()}
