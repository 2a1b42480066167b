"""Functions of one argument that are smooth between breaks: suprema, integrals and roots, piece by piece.

A curve of a machine may jump or have a kink where a segment ends, a load sets in or friction reverses. Between these
breaks it is smooth. The domain is therefore cut into `Pieces`; every search and every integral stays within one piece,
and at the ends of a piece the curve has its one-sided limits. A sided curve takes the side as a second argument:
+1 means the limit from above, -1 the limit from below. A curve without sides is evaluated 1e-13 inside its piece.

All curves are evaluated on arrays: one call for all pieces in each step of a search. Arguments and values are in the
units of the curve. [searches derived here; integrals by Gauss-Legendre quadrature]
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, IntArray
from ilmek.num.brackets import bracketed_roots
from ilmek.records import record
from ilmek.units import turn

Curve: TypeAlias = Callable[[FloatArray], FloatArray]
"""Arguments (n,) -> values (n,)."""

SidedCurve: TypeAlias = Callable[[FloatArray, FloatArray], FloatArray]
"""Arguments (n,) and sides (n,), each +1 or -1 -> values (n,): at a jump the limit from above or from below."""

SidedCurves: TypeAlias = Callable[[FloatArray, FloatArray], Mapping[str, FloatArray]]
"""As `SidedCurve`, with several named values."""

INSIDE = 1e-13
"""Distance from the end of a piece at which a curve without sides is evaluated: above the rounding of an angle."""

GRID, LEAST_GRID = 256, 8
"""Intervals of the first grid: in each piece for `supremum`, at least so many in each piece for `suprema`."""

RIVAL, MARGIN = 0.01, 3.0
"""A local maximum of the samples is refined where it lies within RIVAL of the curve's range below the largest sample,
or within MARGIN times its own rise over the neighbouring samples."""

FINEST, FINE = 4e-9, 4e-7
"""Parts of the domain at which the search of one curve and of several curves ends. A smooth maximum is flat: the error
of its value is of the second order, 1e-17 and 1e-12, and no finer argument can be found from values."""

EQUAL = 1e-12
"""Maxima that differ by less than this part of the largest are equal: the first of them counts."""

_ZOOM = np.linspace(-1.0, 1.0, 33)

WHOLE_NODES, PART_NODES = 40, 24
"""Nodes of Gauss' rule on a piece: for pieces integrated as a whole, and for pieces that are cut into parts."""


@dataclass(frozen=True, slots=True)
class Extremum:
    """An extreme value.

    at     argument at which it is reached or approached      value  the extreme value
    side   +1: the limit from above at the start of a piece, -1: from below at the end of one, 0: within a smooth piece
    """

    at: float
    value: float
    side: int = 0


@record
class Pieces:
    """Consecutive pieces of the domain on each of which a curve is smooth.

    starts, ends  (n,), starts < ends      period  of the curve; results are reduced to [0, period). 0: not periodic
    """

    starts: FloatArray
    ends: FloatArray
    period: float = 0.0

    @property
    def widths(self) -> FloatArray:
        """Length of each piece."""
        return np.asarray(self.ends - self.starts)

    def sides(self, x: FloatArray, piece: IntArray) -> FloatArray:
        """The side of each argument that looks into its piece; `piece` broadcasts against x."""
        return np.where(x < 0.5 * (self.starts + self.ends)[piece], 1.0, -1.0)

    def reduced(self, x: float) -> float:
        """The argument within the first period."""
        return x % self.period if self.period else x

    def side(self, x: float, piece: int) -> int:
        """Side of an extreme value: 0 unless it is at an end of its piece that is a break."""
        if self.period and self.starts.size == 1 and self.starts[0] == 0:
            return 0
        return int(x == self.starts[piece]) - int(x == self.ends[piece])


def between(knots: FloatArray) -> Pieces:
    """The pieces between consecutive ascending knots; knots closer than 2e-13 bound no piece.

    >>> between(np.array([0.0, 1.0, 1.0, 3.0])).ends.tolist()
    [1.0, 3.0]
    """
    wide = np.diff(knots) > 2 * INSIDE
    return Pieces(knots[:-1][wide], knots[1:][wide])


def around(breaks: Iterable[float] = (), *, parts: int = 0) -> Pieces:
    """The pieces of a turn, cut at the breaks [rad] and into even parts; the whole turn where there are none.

    breaks  in any order, on any turn, repeated or not; the first piece starts at the first break at or after 0

    >>> one = around([3.0, 1.0 + turn])
    >>> one.starts.round(12).tolist(), one.ends.round(12).tolist()
    ([1.0, 3.0], [3.0, 7.28318530718])
    """
    cuts = (*breaks, *(turn / max(parts, 1) * np.arange(parts)).tolist())
    starts = np.unique(np.mod(np.array(cuts, dtype=float), turn)) if cuts else np.zeros(1)
    return Pieces(starts, np.append(starts[1:], starts[0] + turn), turn)


def supremum(curve: Curve, knots: FloatArray, *, samples: int = GRID) -> Extremum:
    """Least upper bound of a curve over the pieces between consecutive knots, one-sided limits included.

    samples  intervals of the first grid in each piece: a narrower peak may be missed
    The value is exact to rounding, the argument to about 1e-8. The value is NaN where the curve is NaN at a sample.
    Of values that are equal to 1e-12 the first counts.

    >>> supremum(np.sin, np.array([0.0, 1.0, 3.0])).value
    1.0
    """
    pieces = between(knots)
    return _suprema(_sided(curve), pieces, np.full(pieces.starts.size, samples), FINEST)["curve"]


def infimum(curve: Curve, knots: FloatArray) -> Extremum:
    """Greatest lower bound of a curve; see `supremum`."""
    extremum = supremum(lambda x: -curve(x), knots)
    return Extremum(extremum.at, -extremum.value, extremum.side)


def suprema(curves: SidedCurves, pieces: Pieces, *, samples: int = 720) -> dict[str, Extremum]:
    """Least upper bound of each of several curves, searched together: values to about 1e-12; see `supremum`.

    samples  of the first grid, shared among the pieces by their widths, at least 8 for each

    >>> round(suprema(lambda x, _: {"wave": np.cos(x - 2)}, around())["wave"].at, 6)
    2.0
    """
    share = samples * pieces.widths / np.sum(pieces.widths)
    return _suprema(curves, pieces, np.maximum(np.rint(share), LEAST_GRID).astype(np.intp), FINE)


def integral(curve: Curve, knots: FloatArray) -> float:
    """Integral of a curve from the first knot to the last, by Gauss' rule with 40 nodes on each piece.

    >>> round(integral(np.cos, np.array([0.0, 0.3, np.pi / 2])), 12)
    1.0
    """
    return float(np.sum(integrals(_sided(curve), between(knots), nodes=WHOLE_NODES)["curve"]))


def integrals(curves: SidedCurves, pieces: Pieces, *, nodes: int = PART_NODES) -> dict[str, FloatArray]:
    """Integral of each curve over each piece (n,), by Gauss' rule: exact for polynomials of degree 2 nodes - 1.

    >>> found = integrals(lambda x, _: {"square": np.cos(x) ** 2}, around(parts=16))["square"]
    >>> round(float(np.sum(found)) / np.pi, 12)
    1.0
    """
    points, weights = _gauss(nodes)
    half = 0.5 * pieces.widths[:, None]
    x = pieces.starts[:, None] + half * (1 + points)
    sides = pieces.sides(x, np.arange(len(x))[:, None])
    values = curves(np.ravel(x), np.ravel(sides))
    return {name: np.sum(half * weights * np.reshape(value, x.shape), axis=1) for name, value in values.items()}


def crossings(curve: SidedCurve, pieces: Pieces, level: float = 0.0, *, samples: int = 16) -> FloatArray:
    """Arguments within the pieces at which a curve passes a level, piece by piece, to rounding.

    A jump across the level at a break is no crossing. Two crossings within 1/samples of a piece may be missed.

    >>> crossings(lambda x, _: np.cos(x), around(), 0.5).round(12).tolist()
    [1.047197551197, 5.235987755983]
    """
    x = pieces.starts[:, None] + pieces.widths[:, None] * np.linspace(0.0, 1.0, samples + 1)
    sides = pieces.sides(x, np.arange(len(x))[:, None])
    above = np.reshape(curve(np.ravel(x), np.ravel(sides)), x.shape) > level
    piece, column = np.nonzero(above[:, 1:] != above[:, :-1])
    if not piece.size:
        return np.empty(0)
    low, high = x[piece, column], x[piece, column + 1]
    return bracketed_roots(lambda at: curve(at, pieces.sides(at, piece)) - level, low, high)


def roots(curve: Curve, nodes: FloatArray) -> FloatArray:
    """Arguments at which a continuous curve changes its sign between ascending nodes, ascending, to rounding.

    A zero at the first node counts, one at the last node does not, so that adjoining intervals share none. Where the
    curve is zero at inner nodes, the last of these counts, if the signs beside them differ. Intervals with a value
    that is not finite are left out. Two roots between neighbouring nodes are not seen.

    >>> roots(np.sin, np.linspace(0.0, 7.0, 50)).round(12).tolist()
    [0.0, 3.14159265359, 6.28318530718]
    """
    sign = np.sign(curve(nodes))
    before = sign[np.maximum.accumulate(np.where(sign != 0, np.arange(nodes.size), 0))]
    left, right = sign[:-1], sign[1:]
    (found,) = np.nonzero((left * right < 0) | ((left == 0) & (right != 0) & (before[:-1] != right)))
    if not found.size:
        return np.empty(0)
    polished = bracketed_roots(curve, nodes[found], nodes[found + 1])
    return np.unique(polished[np.isfinite(polished)])


def roots_of_turn(curve: Curve, *, samples: int = 720) -> FloatArray:
    """Angles in [0, 2 pi) at which a continuous curve of period 2 pi changes its sign, ascending; see `roots`.

    >>> roots_of_turn(lambda angle: np.cos(angle - 1)).round(12).tolist()
    [2.570796326795, 5.712388980385]
    """
    return np.sort(np.mod(roots(curve, np.arange(samples + 1) * (turn / samples)), turn))


def _sided(curve: Curve) -> SidedCurves:
    return lambda x, side: {"curve": curve(x + INSIDE * side)}


@cache
def _gauss(nodes: int) -> tuple[FloatArray, FloatArray]:
    return np.polynomial.legendre.leggauss(nodes)


def _suprema(curves: SidedCurves, pieces: Pieces, counts: IntArray, finest: float) -> dict[str, Extremum]:
    """The search: local maxima of a grid's samples, each enclosed ever closer by finer grids, all at once."""
    piece = np.repeat(np.arange(counts.size), counts + 1)
    x = np.concatenate([np.linspace(*one) for one in zip(pieces.starts, pieces.ends, counts + 1, strict=True)])
    values = curves(x, pieces.sides(x, piece))
    rivals = {name: np.flatnonzero(_rivals(value, piece)) for name, value in values.items()}
    chosen = np.concatenate(list(rivals.values()))
    owners = [name for name, found in rivals.items() for _ in found]
    piece, step = piece[chosen], (pieces.widths / counts)[piece[chosen]]
    at, top = _refined(curves, pieces, owners, x[chosen], step, piece, finest)
    ends = np.cumsum([0, *(found.size for found in rivals.values())])
    return {
        name: _largest(pieces, at[low:high], top[low:high], piece[low:high])
        for name, low, high in zip(rivals, ends, ends[1:], strict=False)
    }


def _largest(pieces: Pieces, at: FloatArray, top: FloatArray, piece: IntArray) -> Extremum:
    """The largest of the maxima, at the first argument at which it is reached."""
    best = int(np.argmax(top))
    if np.isfinite(top[best]):
        (equal,) = np.nonzero(top >= top[best] - EQUAL * np.abs(top[best]))
        first = int(equal[np.argmin([pieces.reduced(one) for one in at[equal].tolist()])])
    else:
        first = best
    where = float(at[first])
    return Extremum(pieces.reduced(where), float(top[best]), pieces.side(where, int(piece[first])))


def _rivals(value: FloatArray, piece: IntArray) -> BoolArray:
    """Local maxima of the samples in their pieces that may belong to the largest value; the largest sample is one."""
    top = np.max(value)
    with np.errstate(invalid="ignore"):  # samples may be NaN or infinite
        rises = np.where(piece[1:] == piece[:-1], np.diff(value), np.nan)
        from_left, to_right = np.append(np.nan, rises), np.append(rises, np.nan)
        hill = np.fmax(np.fmax(from_left, -to_right), 0.0)
        near = value >= top - np.fmax(MARGIN * hill, RIVAL * (top - np.min(value)))
        rivals: BoolArray = ~(from_left <= 0) & ~(to_right > 0) & near
    rivals[np.argmax(value)] = True
    return rivals


def _refined(  # noqa: PLR0917
    curves: SidedCurves,
    pieces: Pieces,
    owners: list[str],
    at: FloatArray,
    step: FloatArray,
    piece: IntArray,
    finest: float,
) -> tuple[FloatArray, FloatArray]:
    """Argument and value of each maximum that is enclosed within one step to both sides."""
    start, end = pieces.starts[piece][:, None], pieces.ends[piece][:, None]
    top, row, width = np.zeros(at.size), np.arange(at.size), np.max(step) / np.sum(pieces.widths)
    while width > finest:
        tried = np.clip(at[:, None] + step[:, None] * _ZOOM, start, end)
        finer = curves(np.ravel(tried), np.ravel(pieces.sides(tried, piece[:, None])))
        stacked = {name: np.reshape(value, tried.shape) for name, value in finer.items()}
        values = np.array([stacked[name][k] for k, name in enumerate(owners)])
        best = np.argmax(values, axis=1)
        at, top = tried[row, best], values[row, best]
        step, width = step / 16, width / 16
    return at, top
