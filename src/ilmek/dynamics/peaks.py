"""Greatest values over a turn: suprema, not the greatest of some samples.

A curve may jump, where a load sets in or friction turns round. Between its breaks it is smooth, and on each piece, both
ends included, it has a greatest value; at an end that is the limit from inside the piece.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, IntArray
from ilmek.units import turn

Curves: TypeAlias = Callable[[FloatArray], Mapping[str, FloatArray]]
"""Angles [rad] -> named values, one an angle; of period 2 pi and smooth near their maxima."""

SidedCurves: TypeAlias = Callable[[FloatArray, FloatArray], Mapping[str, FloatArray]]
"""Angles [rad] and sides -> named values: where a curve jumps, its limit from above (side +1) or from below (-1)."""

RIVAL = 0.01
"""Local maxima of the samples within this part of the greatest are all refined."""


@dataclass(frozen=True, slots=True)
class Peak:
    """A greatest value and the angle [rad] in [0, 2 pi) where it is reached.

    side  +1: it is the limit from above at a break of the curve, -1: from below, 0: it lies within a smooth piece
    """

    value: float
    angle: float
    side: int = 0


class Piece(NamedTuple):
    """A smooth piece of the turn, from `start` to `end` [rad], start < end."""

    start: float
    end: float

    def sides(self, angle: FloatArray) -> FloatArray:
        """The side that looks into the piece."""
        return np.where(angle < (self.start + self.end) / 2, 1.0, -1.0)


def pieces(breaks: Iterable[float]) -> tuple[Piece, ...]:
    """The smooth pieces of a turn between its breaks [rad], in any order and turn; the whole turn where there are none.

    >>> pieces([3.0, 1.0])
    (Piece(start=1.0, end=3.0), Piece(start=3.0, end=7.283185307179586))
    """
    sorted_breaks = sorted({angle % turn for angle in breaks}) or [0.0]
    return tuple(
        Piece(start, end)
        for start, end in zip(sorted_breaks, [*sorted_breaks[1:], sorted_breaks[0] + turn], strict=True)
    )


def peaks(curves: Curves, *, samples: int = 720, rounds: int = 4) -> dict[str, Peak]:
    """The greatest value of each smooth curve over a turn, to about 1e-12 of itself."""
    return suprema(lambda angle, _: curves(angle), samples=samples, rounds=rounds)


def suprema(
    curves: SidedCurves, breaks: Iterable[float] = (), *, samples: int = 720, rounds: int = 4
) -> dict[str, Peak]:
    """The supremum of each curve over a turn, to about 1e-12 of itself, with its limits at the breaks [rad].

    Every local maximum of a piece's samples that rivals the greatest of all is bracketed by its neighbours; each round
    divides all brackets by 8 in one evaluation. A maximum is flat, so that its value converges with the square of its
    place; at the end of a piece it need not be flat, but there its place is known.
    """
    cut = pieces(breaks)
    grids = [np.linspace(p.start, p.end, max(8, round(samples * (p.end - p.start) / turn)) + 1) for p in cut]
    values = curves(np.concatenate(grids), np.concatenate([p.sides(grid) for p, grid in zip(cut, grids, strict=True)]))
    ends = np.cumsum([grid.size for grid in grids])[:-1]
    found = [
        (name, piece, grid[place], grid[1] - grid[0])
        for name in values
        for piece, grid, rivals in zip(cut, grids, np.split(_rivals(values[name], ends), ends), strict=True)
        for place in np.flatnonzero(rivals)
    ]
    return _highest(_refined(curves, found, rounds))


Candidate: TypeAlias = tuple[str, Piece, float, float]
"""A maximum of the samples: curve, piece, angle, distance of the neighbours."""


def _refined(curves: SidedCurves, found: Sequence[Candidate], rounds: int) -> list[tuple[str, Piece, float, float]]:
    """Curve, piece, value and angle of every candidate, its bracket narrowed."""
    lowest = np.array([piece.start for _, piece, _, _ in found])
    highest = np.array([piece.end for _, piece, _, _ in found])
    where = np.array([angle for _, _, angle, _ in found])
    width = np.array([step for _, _, _, step in found])
    heights = np.zeros(len(found))
    grid = np.linspace(-1.0, 1.0, 17)
    for _ in range(rounds):
        tried = np.clip(where[:, None] + width[:, None] * grid, lowest[:, None], highest[:, None])
        sides = np.array([piece.sides(row) for (_, piece, _, _), row in zip(found, tried, strict=True)])
        finer = curves(np.ravel(tried), np.ravel(sides))
        values = np.array([np.reshape(finer[name], tried.shape)[row] for row, (name, *_) in enumerate(found)])
        best = np.argmax(values, axis=1)[:, None]
        where, heights = np.take_along_axis(tried, best, 1)[:, 0], np.take_along_axis(values, best, 1)[:, 0]
        width = width / 8
    return [
        (name, piece, float(height), float(angle))
        for (name, piece, *_), height, angle in zip(found, heights, where, strict=True)
    ]


def _rivals(values: FloatArray, ends: IntArray) -> BoolArray:
    """Samples not below their neighbours in their piece and near the greatest of all; `ends`: where pieces begin."""
    top, spread = np.max(values), np.max(values) - np.min(values)
    if not spread > 1e-12 * abs(top):  # a constant curve is everywhere a maximum: one will do
        constant: BoolArray = np.arange(values.size) == 0
        return constant
    rises = np.diff(values)
    rises[ends - 1] = np.nan  # no neighbours across a break
    from_left, to_right = np.append(np.nan, rises), np.append(rises, np.nan)
    rivals: BoolArray = ~(from_left < 0) & ~(to_right > 0) & (values >= top - RIVAL * spread)
    return rivals


def _highest(tops: Iterable[tuple[str, Piece, float, float]]) -> dict[str, Peak]:
    highest: dict[str, tuple[Piece, float, float]] = {}
    for name, piece, value, angle in tops:
        if name not in highest or (value, angle) > highest[name][1:]:
            highest[name] = piece, value, angle
    return {name: Peak(value, angle % turn, _side(piece, angle)) for name, (piece, value, angle) in highest.items()}


def _side(piece: Piece, angle: float) -> int:
    """+1 at the start of a piece, -1 at its end; 0 within, and everywhere on a turn without breaks."""
    if piece == Piece(0.0, turn):
        return 0
    return int(angle == piece.start) - int(angle == piece.end)
