"""Search for function generators: starts, descent, and selection of the results.

Starts are the four-bars through the Chebyshev nodes, the solutions of least design error, and for free start angles the
local minima of the structural error on a grid of them, each with fitted links. A minimax starts from the ends of the
least-squares descents.
[Freudenstein's equation: `synthesis.freudenstein`; criteria: `approximation.polynomial`; combined here]
"""

import math
from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import Bool, ComplexArray, FloatArray
from ilmek.errors import ParameterError
from ilmek.synthesis.approximation.exchange import PROVEN, minimax_over_range
from ilmek.synthesis.approximation.function_design import design_generators
from ilmek.synthesis.approximation.function_error import (
    Generator,
    StructuralErrors,
    Weight,
    design_fit,
    margin,
    of_four_bar,
    structural_error,
)
from ilmek.synthesis.approximation.least_squares import squares_descent
from ilmek.synthesis.freudenstein import generators_of
from ilmek.synthesis.function import Function

Starts: TypeAlias = tuple[float | None, float | None]
"""Start angles of crank and rocker [rad], None where free."""

Free: TypeAlias = Bool[np.ndarray, "5"]
"""Which of the five numbers of a generator are free."""

SAMPLES = 129
"""Points of the range at which a minimax begins; the extrema are added to them."""

NODES = 48
"""Gauss nodes of the integral of the squares."""

GRID = {1: 90, 2: 24}
"""Number of free start angles -> grid points of each; half a turn suffices, as links may be negative."""

STARTS = 8
"""Local minima on the grid at which descents start."""

DEAD = 1e-5
"""Margin at which a four-bar counts as at a dead centre: rocker within 0.2 degrees of the line to the crank's pin."""

ZERO_ERROR = 1e-10
"""Error [rad] that counts as 0."""

MAX_LINK_RATIO = 1000.0
"""Link ratio at which a descent counts as divergent."""

SAME = 1e-4
"""Relative distance of their pins below which two four-bars count as the same: the accuracy of flat minima."""

NO_START = {
    True: "no four-bar passes through the Chebyshev nodes with this start angle",
    False: "no four-bar of least design error closes over the whole range, for any free start angles",
}
"""Message without any start: for interpolation (True) and for other criteria."""

UNPROVEN = {
    True: "a four-bar that meets the Chebyshev nodes on two branches",
    False: "a search that does not converge: no minimum, or too flat a valley",
}
"""Message for an end without proof: for interpolation (True) and for other criteria."""


class DescentEnd(NamedTuple):
    """State of a descent: a generator with its sense, the optimality gap, and the bound of a minimax [rad]."""

    sense: int
    generator: Generator
    gap: float
    bound: float


def range_samples(function: Function, count: int) -> FloatArray:
    """`count` points x over the range, denser towards its ends.

    x_k = (x0 + x1) / 2 - |x1 - x0| / 2 cos(k pi / (count - 1)),    shape (count,), ascending [unit of x]
    """
    middle, half = 0.5 * (function.start + function.stop), 0.5 * abs(function.stop - function.start)
    return np.asarray(middle - half * np.cos(np.linspace(0, np.pi, count)))


def gauss_nodes(function: Function, weight: Weight | None) -> tuple[FloatArray, FloatArray]:
    """Gauss-Legendre nodes over the range [unit of x], and the weights [1] with which squares sum to their mean.

    weight  w(x) of the error; the mean is then that of (w e)^2; default: 1
    Both have the shape (NODES,).
    """
    nodes, shares = np.polynomial.legendre.leggauss(NODES)
    x = 0.5 * (function.start + function.stop) + 0.5 * (function.stop - function.start) * nodes
    return x, 0.5 * shares * (1.0 if weight is None else weight(x) ** 2)


def generator_search(
    function: Function, criterion: str, starts: Starts, weight: Weight | None
) -> tuple[list[DescentEnd], Counter[str]]:
    """Generators that are local optima by a criterion, without duplicates; and what was left out, with its number.

    criterion  see `function_generator`      starts  start angles of crank and rocker [rad], None where free
    weight     of the error at each x [1]; default: 1

    Ends without proof are included only if there are no others. Raises ParameterError where a family of four-bars
    passes through the Chebyshev nodes.
    """
    left_out: list[str] = []
    ends = [DescentEnd(*start, 0.0, math.nan) for start in _starts(function, starts, weight, left_out, criterion)]
    if not ends:
        left_out.append(NO_START[criterion == "interpolation"])
    free = np.array([True, True, True, *(start is None for start in starts)])
    for descent in DESCENTS[criterion]:
        ended = _different(function, [descent(function, end, free, weight) for end in ends], left_out, criterion)
        ends = ended if ended or descent is DESCENTS[criterion][-1] else ends
    return ends, Counter(left_out)


def _starts(
    function: Function, starts: Starts, weight: Weight | None, left_out: list[str], criterion: str
) -> Iterator[tuple[int, Generator]]:
    """Senses and generators at which descents start."""
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
        except ParameterError:  # terms are dependent on a very small range; the grid is used instead
            answers = ()
        for design in answers:
            if design.error.kind == "minimum" and margin(function, design.generator) > DEAD:
                yield _better_sense(function, design.generator), design.generator
    if points > 3:
        yield from _grid(function, starts, weight)


def _better_sense(function: Function, one: Generator) -> int:
    """The sense with the smaller structural error."""
    x = range_samples(function, SAMPLES)
    worst = [float(np.max(np.abs(structural_error(function, one, sense, x)))) for sense in (+1, -1)]
    return +1 if worst[0] <= worst[1] else -1


def _grid(function: Function, starts: Starts, weight: Weight | None) -> Iterator[tuple[int, Generator]]:
    """Local minima of the structural error among the generators of least design error on the grid."""
    directions = np.linspace(0, np.pi, GRID[sum(start is None for start in starts)], endpoint=False)
    axes = [directions if start is None else np.array([start]) for start in starts]
    alpha, beta = np.meshgrid(*axes, indexing="ij")
    x, shares = gauss_nodes(function, weight)
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


def _least_squares(function: Function, end: DescentEnd, free: Free, weight: Weight | None) -> DescentEnd:
    """Local minimum of the mean square of the structural error."""
    errors = StructuralErrors(function, end.sense, end.generator.numbers, free)
    x, shares = gauss_nodes(function, weight)
    root = np.sqrt(shares)

    def shared(parameters: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        found, slopes = errors(parameters, x)
        return root * found, root[:, None] * slopes

    best = squares_descent(shared, errors.known[free], x)
    gap = best.slope if best.squares > ZERO_ERROR**2 else 0.0
    return DescentEnd(end.sense, errors.generator(best.parameters), gap, math.nan)


def _minimax(function: Function, end: DescentEnd, free: Free, weight: Weight | None) -> DescentEnd:
    """Local minimum of the greatest structural error, with its lower bound."""
    errors = StructuralErrors(function, end.sense, end.generator.numbers, free, weight)
    best = minimax_over_range(errors, errors.known[free], range_samples(function, SAMPLES), least=ZERO_ERROR)
    gap = best.gap if best.worst > ZERO_ERROR else 0.0
    return DescentEnd(end.sense, errors.generator(best.parameters), gap, best.level)


def _interpolated(function: Function, end: DescentEnd, free: Free, _: Weight | None) -> DescentEnd:
    """The same with the error at the Chebyshev nodes: a four-bar may meet some of them on its other branch."""
    nodes = function.nodes(int(np.sum(free)))
    error = float(np.max(np.abs(structural_error(function, end.generator, end.sense, nodes))))
    return DescentEnd(end.sense, end.generator, error, math.nan)


DESCENTS = {
    "interpolation": (_interpolated,),
    "least squares": (_least_squares,),
    "minimax": (_least_squares, _minimax),
}
"""Criterion -> descents after the starts."""


def _different(function: Function, ends: list[DescentEnd], left_out: list[str], criterion: str) -> list[DescentEnd]:
    """Ends that are four-bars, without duplicates, only those with proof if there are any; others go to `left_out`."""
    kept: list[DescentEnd] = []
    points: list[ComplexArray] = []
    for end in ends:
        words = _defect(function, end)
        if words:
            left_out.append(words)
            continue
        drawn = end.generator.drawn(function, function.start, end.sense, 1.0)
        at = np.array([drawn.a, drawn.b])
        if all(np.max(np.abs(at - other)) > SAME * np.max(np.abs(at)) for other in points):
            kept.append(end)
            points.append(at)
    proven = [end for end in kept if end.gap <= PROVEN]
    if len(proven) < len(kept):
        left_out.append(UNPROVEN[criterion == "interpolation"])
    return proven if criterion == "interpolation" else proven or kept


def _defect(function: Function, end: DescentEnd) -> str:
    """Defect of a generator as text; empty without one."""
    links = np.abs([1.0, *end.generator.links])
    if not np.max(links) <= MAX_LINK_RATIO * np.min(links):
        return f"a four-bar that diverges: its link ratio exceeds {MAX_LINK_RATIO:g}"
    free = margin(function, end.generator)
    if free < 0:
        return "a four-bar that does not close over the whole range"
    if not free > DEAD:
        return "a four-bar with a dead centre in the range"
    return ""
