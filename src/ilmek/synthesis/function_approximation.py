"""Four-bars that generate a function as well as they can over its whole range, not only at three to five places.

Two errors are told apart. The design error is what Freudenstein's equation misses by,

    R1 cos th4 - R2 cos th2 + R3 - cos(th2 - th4),    R1 = 1 / a, R2 = 1 / c, R3 = (1 + a^2 - b^2 + c^2) / (2 a c)

with ground 1, crank a, coupler b, rocker c: linear in R1, R2, R3 where both start angles are said. The structural
error is what the rocker misses by, and it is the one that is made small. The design error is solved outright, on a
grid of start angles where they are free; every local least of it that closes, and every four-bar through Chebyshev's
places, starts a descent on the structural error in the closed form of the linkage. (`approximation_design` has the
design error for its own sake, in all three criteria.)
[Freudenstein, Trans. ASME 77 (1955); Todorov, Mech. Mach. Theory 37 (2002) 1505, for Chebyshev's approximation of the
design error; Liu and Angeles, Mech. Mach. Theory 27 (1992) 501, for the difference of the two errors]
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np
from jaxtyping import Bool, Float

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.errors import ParameterError
from ilmek.synthesis.approximation_design import design_generators
from ilmek.synthesis.approximation_exchange import PROVEN, extremes, minimax_over_range
from ilmek.synthesis.approximation_generator import (
    Generator,
    StructuralErrors,
    Weight,
    design_fit,
    margin,
    of_four_bar,
    structural_error,
)
from ilmek.synthesis.approximation_squares import squares_descent
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.freudenstein import generators_of
from ilmek.synthesis.function import ErrorCurve, Function, error_curve
from ilmek.units import deg

Starts: TypeAlias = tuple[float | None, float | None]
"""Start angles of crank and rocker [rad], None where free."""

Free: TypeAlias = Bool[np.ndarray, "5"]
"""Which numbers of a generator are free."""

CRITERIA = ("interpolation", "least squares", "minimax")
"""What `function_approximations` can be asked for."""

PLACES = 129
"""Places of the range on which a minimax begins; its extremes are added to them."""

NODES = 48
"""Gauss's nodes for the integral of the squares."""

GRID = {1: 90, 2: 24}
"""Directions tried of each free start angle, by how many are free; half a turn is enough, as links may be negative."""

STARTS = 8
"""Local leasts on the grid from which descents are begun."""

DEAD = 1e-5
"""Margin at which a four-bar stands in a dead centre: the rocker within 0.2 degrees of the line to the crank's pin."""

NOTHING = 1e-10
"""Error [rad] that counts as none."""

UNEVEN = 1000.0
"""Longest by shortest link at which a four-bar runs off to infinity instead of ending."""

SAME = 1e-4
"""Distance of their pins, in ground links, below which two four-bars are one: flat minima are known no better."""


@dataclass(frozen=True, slots=True)
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


NONE = {
    True: "no four-bar goes through Chebyshev's places with this start angle",
    False: "no four-bar of least design error closes all over the range, whatever its free start angles",
}
"""What is said where there is nothing to begin with: of interpolation, and of other criteria."""


UNPROVEN = {
    True: "a four-bar that shows Chebyshev's places on both of its branches",
    False: "a search that came to no end: a valley without a floor, or one too flat to be followed",
}
"""What is said of an end that is not proven: of interpolation, and of other criteria."""


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
    left_out: list[str] = []
    ends = [_End(*start, 0.0, math.nan) for start in _starts(function, starts, weight, left_out, criterion)]
    if not ends:
        left_out.append(NONE[criterion == "interpolation"])
    free = np.array([True, True, True, *(start is None for start in starts)])
    for descent in DESCENTS[criterion]:
        ended = _different(function, [descent(function, end, free, weight) for end in ends], left_out, criterion)
        ends = ended if ended or descent is DESCENTS[criterion][-1] else ends
    measured = [_measured(function, criterion, end, ground, weight) for end in ends]
    ranked = sorted(measured, key=lambda one: one.rms if criterion == "least squares" else one.worst)
    return FunctionApproximations(tuple(ranked), tuple(dict.fromkeys(left_out)))


class _End(NamedTuple):
    """Where a descent stands."""

    sense: int
    generator: Generator
    gap: float
    bound: float


def _range(function: Function, count: int) -> FloatArray:
    """Places over the range, denser towards its ends."""
    middle, half = 0.5 * (function.start + function.stop), 0.5 * abs(function.stop - function.start)
    return np.asarray(middle - half * np.cos(np.linspace(0, np.pi, count)))


def _gauss(function: Function, weight: Weight | None) -> tuple[FloatArray, FloatArray]:
    """Gauss's nodes over the range and the weights with which squares there add up to their mean over it."""
    nodes, shares = np.polynomial.legendre.leggauss(NODES)
    x = 0.5 * (function.start + function.stop) + 0.5 * (function.stop - function.start) * nodes
    return x, 0.5 * shares * (1.0 if weight is None else weight(x) ** 2)


def _starts(
    function: Function, starts: Starts, weight: Weight | None, left_out: list[str], criterion: str
) -> Iterator[tuple[int, Generator]]:
    """Senses and generators from which descents begin."""
    points = 3 + sum(start is None for start in starts)
    at = float(function.nodes(points)[0])
    exact = generators_of(function, points, crank_start=starts[0], rocker_start=starts[1])
    left_out.extend(exact.left_out)
    for four_bar in exact.four_bars:
        yield of_four_bar(four_bar, function, at, starts)
    if criterion == "interpolation":
        return
    if points < 5:
        try:
            answers = design_generators(
                function, "least squares", crank_start=starts[0], rocker_start=starts[1], weight=weight
            ).found
        except ParameterError:  # a range so small that terms look alike; the grid does not mind
            answers = ()
        for design in answers:
            if design.error.kind == "minimum" and margin(function, design.generator) > DEAD:
                yield _better_sense(function, design.generator), design.generator
    if points > 3:
        yield from _grid(function, starts, weight)


def _better_sense(function: Function, one: Generator) -> int:
    """The sense with the smaller structural error."""
    x = _range(function, PLACES)
    worst = [float(np.max(np.abs(structural_error(function, one, sense, x)))) for sense in (+1, -1)]
    return +1 if worst[0] <= worst[1] else -1


def _grid(function: Function, starts: Starts, weight: Weight | None) -> Iterator[tuple[int, Generator]]:
    """The local leasts of the structural error among the generators of least design error on the grid."""
    directions = np.linspace(0, np.pi, GRID[sum(start is None for start in starts)], endpoint=False)
    axes = [directions if start is None else np.array([start]) for start in starts]
    alpha, beta = np.meshgrid(*axes, indexing="ij")
    x, shares = _gauss(function, weight)
    fitted = design_fit(function, (alpha, beta), x, shares)
    squares = np.stack(
        [np.sum(shares * structural_error(function, fitted, sign, x) ** 2, axis=-1) for sign in (+1, -1)]
    )
    squares = np.where(np.isfinite(squares), squares, np.inf)
    least = np.min(squares, axis=0)
    low = np.isfinite(least)
    for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):
        low &= least <= np.roll(least, step, axis=axis)
    rows = np.argwhere(low)
    found = 0
    for i, j in sorted(rows.tolist(), key=lambda at: float(least[at[0], at[1]])):
        one = Generator(*(float(np.asarray(number)[i, j]) for number in fitted))
        if found < STARTS and margin(function, one) > DEAD:
            found += 1
            yield (+1 if squares[0, i, j] <= squares[1, i, j] else -1), one


def _least_squares(function: Function, end: _End, free: Free, weight: Weight | None) -> _End:
    """The nearest least mean square of the structural error."""
    errors = StructuralErrors(function, end.sense, end.generator.numbers, free)
    x, shares = _gauss(function, weight)
    root = np.sqrt(shares)

    def shared(parameters: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        found, slopes = errors(parameters, x)
        return root * found, root[:, None] * slopes

    best = squares_descent(shared, errors.known[free], x)
    gap = best.slope if best.squares > NOTHING**2 else 0.0
    return _End(end.sense, errors.generator(best.parameters), gap, math.nan)


def _minimax(function: Function, end: _End, free: Free, weight: Weight | None) -> _End:
    """The nearest least greatest structural error, and the bound that proves it."""
    errors = StructuralErrors(function, end.sense, end.generator.numbers, free, weight)
    best = minimax_over_range(errors, errors.known[free], _range(function, PLACES), least=NOTHING)
    gap = best.gap if best.worst > NOTHING else 0.0
    return _End(end.sense, errors.generator(best.parameters), gap, best.level)


def _interpolated(function: Function, end: _End, free: Free, _: Weight | None) -> _End:
    """The same, with the error at Chebyshev's places: a four-bar may show some of them on its other branch."""
    nodes = function.nodes(int(np.sum(free)))
    missed = float(np.max(np.abs(structural_error(function, end.generator, end.sense, nodes))))
    return _End(end.sense, end.generator, missed, math.nan)


DESCENTS = {
    "interpolation": (_interpolated,),
    "least squares": (_least_squares,),
    "minimax": (_least_squares, _minimax),
}
"""What follows the starts, for each criterion."""


def _different(function: Function, ends: list[_End], left_out: list[str], criterion: str) -> list[_End]:
    """Ends that are four-bars, each once, the proven ones if there are any; what goes is said."""
    kept: list[_End] = []
    places: list[ComplexArray] = []
    for end in ends:
        words = _defect(function, end)
        if words:
            left_out.append(words)
            continue
        drawn = end.generator.drawn(function, function.start, end.sense, 1.0)
        at = np.array([drawn.a, drawn.b])
        if all(np.max(np.abs(at - other)) > SAME * np.max(np.abs(at)) for other in places):
            kept.append(end)
            places.append(at)
    proven = [end for end in kept if end.gap <= PROVEN]
    if len(proven) < len(kept):
        left_out.append(UNPROVEN[criterion == "interpolation"])
    return proven if criterion == "interpolation" else proven or kept


def _defect(function: Function, end: _End) -> str:
    """Why a generator is none; empty where it is one."""
    links = np.abs([1.0, *end.generator.links])
    if not np.max(links) <= UNEVEN * np.min(links):
        return f"a four-bar that runs off: its links become more than {UNEVEN:g} to 1"
    free = margin(function, end.generator)
    if free < 0:
        return "a four-bar that does not close all over the range"
    if not free > DEAD:
        return "a four-bar that the range takes into a dead centre"
    return ""


def _measured(
    function: Function, criterion: str, end: _End, ground: float, weight: Weight | None
) -> FunctionApproximation:
    """What there is to be said of a generator."""
    error = partial(structural_error, function, end.generator, end.sense)
    drawn_at = _vanishing(function, error)
    four_bar = end.generator.drawn(function, drawn_at, end.sense, ground)
    x, shares = _gauss(function, None)

    def weighted(x: FloatArray) -> FloatArray:
        return np.asarray(error(x) * (1.0 if weight is None else weight(x)))

    at = extremes(weighted, _range(function, PLACES))
    peaks = at if weight is None else extremes(error, _range(function, PLACES))
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
    x = _range(function, 4 * PLACES)
    seen = error(x)
    changes = np.flatnonzero(np.sign(seen[1:]) != np.sign(seen[:-1]))
    if not len(changes):
        return float(x[np.argmin(np.abs(seen))])
    low, high = float(x[changes[0]]), float(x[changes[0] + 1])
    sign = np.sign(seen[changes[0]])
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if sign * float(error(np.array([middle]))[0]) > 0 else (low, middle)
    return 0.5 * (low + high)


def _check(
    function: Function,
    criterion: str,
    starts: Starts,
    ground: float,
    weight: Weight | None,
) -> None:
    x = _range(function, PLACES)
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
