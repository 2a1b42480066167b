"""Four-bars that generate a function as well as they can over its whole range, not only at three to five places.

Two errors are told apart. The design error is what Freudenstein's equation misses by,

    R1 cos th4 - R2 cos th2 + R3 - cos(th2 - th4),    R1 = 1 / a, R2 = 1 / c, R3 = (1 + a^2 - b^2 + c^2) / (2 a c)

with ground 1, crank a, coupler b, rocker c: linear in R1, R2, R3 where both start angles are said. The structural
error is what the rocker misses by, and it is the one that is made small. The design error is solved outright, on a
grid of start angles where they are free; every local least of it that closes, and every four-bar through Chebyshev's
places, starts a descent on the structural error in the closed form of the linkage (`approximation.search`). The design
error for its own sake, in all three criteria, is in `approximation.function_design`.
[Freudenstein, Trans. ASME 77 (1955); Todorov, Mech. Mach. Theory 37 (2002) 1505, for Chebyshev's approximation of the
design error; Liu and Angeles, Mech. Mach. Theory 27 (1992) 501, for the difference of the two errors]
"""

import math
from functools import partial
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.num.brackets import bracketed_roots
from ilmek.records import record
from ilmek.synthesis.approximation.exchange import PROVEN, extremes
from ilmek.synthesis.approximation.function_error import Weight, structural_error
from ilmek.synthesis.approximation.search import (
    PLACES,
    DescentEnd,
    Starts,
    gauss_nodes,
    generator_search,
    range_samples,
)
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.function import ErrorCurve, Function, error_curve
from ilmek.units import deg

CRITERIA = ("interpolation", "least squares", "minimax")
"""What `function_approximations` can be asked for."""


@record
class FunctionApproximation:
    """A four-bar that generates a function nearly.

    four_bar   drawn where it shows `drawn_at`, a place at which its error vanishes (where none does, is least)
    criterion  for which it is best, one of CRITERIA      curve  its structural error, moved through `linkage`
    at, errors the alternation: every local extreme of the structural error (times its weight) over the range, ends
               included: its places x, and the structural errors there [rad]
    greatest   greatest structural error over the range [rad]
    rms        root of the mean square of the structural error over the range [rad]
    worst      greatest error, times the weight where there is one [rad]
    bound      minimax only: no small change of the links and of the free start angles brings `worst` below this [rad];
               NaN for other criteria
    gap        what is not proven: minimax 1 - bound / worst; least squares the cosine between the errors and their
               slopes, which vanishes where they are stationary; interpolation the greatest error at a node [rad]
    """

    four_bar: FourBar
    drawn_at: float
    criterion: str
    curve: ErrorCurve
    at: Float[np.ndarray, " extremes"]
    errors: Float[np.ndarray, " extremes"]
    greatest: float
    rms: float
    worst: float
    bound: float
    gap: float

    @property
    def proven(self) -> bool:
        """Whether it is locally best by its criterion, to rounding."""
        return self.gap <= PROVEN


class FunctionApproximations(NamedTuple):
    """Four-bars, the best by their criterion first, and in words what came out that is none."""

    found: tuple[FunctionApproximation, ...]
    left_out: tuple[str, ...]


def function_approximations(
    function: Function,
    criterion: str = "minimax",
    *,
    crank_start: float | None = None,
    rocker_start: float | None = None,
    ground: float = 1.0,
    weight: Weight | None = None,
) -> FunctionApproximations:
    """Four-bars that generate a function nearly over its whole range, all that were found, the best first.

    criterion  "interpolation": exact at Chebyshev's places, as many as there are free numbers (3 to 5)
               "least squares": least mean square of the structural error over the range
               "minimax": least greatest structural error, with the bound that proves it
    crank_start, rocker_start  angles at the start of the function [rad] against the ground; None where free
    ground     A0-B0 [m]      weight  of the error at each x, above 0; 1 where it is not said

    Both start angles free give the least errors. What is found is locally best; that nothing better is elsewhere is
    as sure as the grid of start angles is fine. Ends that are not proven are answered only where no other is.
    Raises ParameterError for another criterion, start angles in degrees, a ground or a weight that is not above 0, a
    function that is not finite over its range, and one that a whole family of four-bars generates.

    >>> root = Function(lambda x: np.sqrt(1 + x), 0.0, 3.0, 80 * deg, 60 * deg)
    >>> best = function_approximations(root, crank_start=1.0, rocker_start=0.8).found[0]
    >>> f"{best.greatest / deg:.4f} deg", len(best.at), best.proven
    ('0.8363 deg', 4, True)
    """
    starts = (crank_start, rocker_start)
    _check(function, criterion, starts, ground, weight)
    ends, left_out = generator_search(function, criterion, starts, weight)
    measured = [_measured(function, criterion, end, ground, weight) for end in ends]
    ranked = sorted(measured, key=lambda one: one.rms if criterion == "least squares" else one.worst)
    return FunctionApproximations(tuple(ranked), left_out)


def _measured(
    function: Function, criterion: str, end: DescentEnd, ground: float, weight: Weight | None
) -> FunctionApproximation:
    """What there is to be said of a generator."""
    error = partial(structural_error, function, end.generator, end.sense)
    drawn_at = _vanishing(function, error)
    four_bar = end.generator.drawn(function, drawn_at, end.sense, ground)
    x, shares = gauss_nodes(function, None)

    def weighted(x: FloatArray) -> FloatArray:
        return np.asarray(error(x) * (1.0 if weight is None else weight(x)))

    at = extremes(weighted, range_samples(function, PLACES))
    peaks = at if weight is None else extremes(error, range_samples(function, PLACES))
    return FunctionApproximation(
        four_bar,
        drawn_at,
        criterion,
        error_curve(four_bar, function, drawn_at),
        at,
        error(at),
        float(np.max(np.abs(error(peaks)))),
        math.sqrt(float(shares @ error(x) ** 2)),
        float(np.max(np.abs(weighted(at)))),
        end.bound,
        end.gap,
    )


def _vanishing(function: Function, error: partial[FloatArray]) -> float:
    """The first place at which the error vanishes; where it is least if it never does."""
    x = range_samples(function, 4 * PLACES)
    seen = error(x)
    changes = np.flatnonzero(np.sign(seen[1:]) != np.sign(seen[:-1]))
    if not len(changes):
        return float(x[np.argmin(np.abs(seen))])
    first = changes[0]
    return float(bracketed_roots(error, x[first : first + 1], x[first + 1 : first + 2])[0])


def _check(
    function: Function,
    criterion: str,
    starts: Starts,
    ground: float,
    weight: Weight | None,
) -> None:
    x = range_samples(function, PLACES)
    if criterion not in CRITERIA:
        raise ParameterError(f"criterion {criterion!r} of a function's approximation", allowed=", ".join(CRITERIA))
    if not (math.isfinite(ground) and ground > 0):
        raise ParameterError(f"ground {ground:g} m", allowed="finite and above 0")
    for name, start in zip(("crank_start", "rocker_start"), starts, strict=True):
        if start is not None and not abs(start) <= 2 * math.pi:
            guess = f"{start:g} deg is {start * deg:.6g} rad" if math.isfinite(start) else ""
            raise ParameterError(f"{name} {start:g} rad", allowed="within a turn, 6.283 rad", do=guess)
    function.task(x)
    if weight is not None and not (np.isfinite(weight(x)).all() and np.min(weight(x)) > 0):
        raise ParameterError("a weight of the error is not above 0", allowed="finite and above 0 all over the range")
