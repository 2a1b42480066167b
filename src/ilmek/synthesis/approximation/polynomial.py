"""Approximation by a synthesis polynomial: linear in its parameters except for one or two products of them.

    sum_k P_k f_k(x) + sum_j P_a P_b g_j(x)  ~  F(x)        error e(x) = q(x) (F(x) - left side)

Three criteria: interpolation, e = 0 at as many nodes as there are parameters; least squares; minimax, least greatest
error. With products each of them has several solutions; all real ones are computed. The first two are solved in closed
form (`approximation.products`). The starts of the third are all solutions of the second, the solutions with equal
errors of alternating sign at n + 1 points, and the minima of the minimax along a factor common to all products; it is
solved by exchange (`approximation.exchange`).
[thesis 2.4-2.10, where 2.7 repeats the integrals for the sums, and 2.10 has "if" for "only if"; Alizade; Todorov]

>>> line = SynthesisPolynomial(lambda x: np.stack([np.ones_like(x), x], axis=-1), np.sqrt)
>>> best = minimax(line, range_nodes(0.0, 1.0)).found[0]
>>> best.parameters.round(12), round(best.worst, 12), best.proven
(array([0.125, 1.   ]), 0.125, True)
"""

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.records import record
from ilmek.synthesis.approximation.exchange import (
    PROVEN,
    Descent,
    Errors,
    extremes,
    linear_minimax,
    minimax_descent,
    minimax_over_range,
)
from ilmek.synthesis.approximation.least_squares import cosine
from ilmek.synthesis.approximation.products import (
    EquationRows,
    Products,
    common_factor,
    errors_of,
    gradient,
    scaled,
    scales,
    solve_products,
    stationary,
)

Terms: TypeAlias = Callable[[FloatArray], FloatArray]
"""x -> values at each x, one row per point."""

NODES = 64
"""Gauss nodes of the integral of the squares over a range."""

SAME = 1e-4
"""Relative difference of scaled parameters below which two solutions count as the same."""

FAR = 1e4
"""Scaled parameter beyond which a minimax search diverges."""

TURNS = 32
"""Values of a common factor at which starts of a minimax are computed."""

ZERO_ERROR = 1e-13
"""Error relative to the greatest target value that counts as 0."""


@record
class SynthesisPolynomial:
    """A target function and the terms that approximate it.

    terms          f: x -> shape (points, n)
    target         F: x -> shape (points,)
    products       pairs (a, b) of indices of parameters: none, one or two pairs
    product_terms  g: x -> shape (points, products)
    weight         q: x -> shape (points,), above 0; default: 1
    between        True: x is a range, and errors between points count as well; False: only given points count

    Raises ParameterError for more than two products, and for products without terms.
    """

    terms: Terms
    target: Terms
    products: Products = ()
    product_terms: Terms | None = None
    weight: Terms | None = None
    between: bool = True

    def __post_init__(self) -> None:
        if len(self.products) > 2 or len({frozenset(pair) for pair in self.products}) < len(self.products):
            given = f"products {self.products} of a synthesis polynomial"
            raise ParameterError(given, allowed="two at most, of different parameters")
        if bool(self.products) != (self.product_terms is not None):
            raise ParameterError("products of a synthesis polynomial without their terms", do="give both, or neither")

    def rows(self, x: FloatArray) -> EquationRows:
        """The weighted equations at x, one row per point.

        Raises ParameterError where they are not finite or a weight is not above 0.
        """
        weight = np.ones(len(x)) if self.weight is None else np.asarray(self.weight(x), dtype=float)
        products = np.zeros((len(x), 0)) if self.product_terms is None else self.product_terms(x)
        rows = EquationRows(weight[:, None] * self.terms(x), weight[:, None] * products, weight * self.target(x))
        if not all(np.isfinite(part).all() for part in rows):
            raise ParameterError("the synthesis polynomial is not finite everywhere", do="choose another range of x")
        if not np.min(weight) > 0:
            raise ParameterError(f"a weight of the error is {np.min(weight):g}", allowed="above 0")
        return rows

    def errors(self, parameters: FloatArray, x: FloatArray) -> FloatArray:
        """Weighted errors e at x, in the unit of the target."""
        return errors_of(self.rows(x), self.products, parameters)[0]


def of_table(
    terms: Float[np.ndarray, "points n"],
    target: Float[np.ndarray, " points"],
    products: Products = (),
    product_terms: Float[np.ndarray, "points products"] | None = None,
    weight: Float[np.ndarray, " points"] | None = None,
) -> SynthesisPolynomial:
    """The polynomial of given points: one row of each table per point; x are the indices 0., 1., 2. ..."""

    def row(table: FloatArray | None) -> Terms | None:
        return None if table is None else (lambda x: table[np.asarray(x, dtype=int)])

    given = row(terms), row(target)
    assert given[0] is not None
    assert given[1] is not None
    return SynthesisPolynomial(given[0], given[1], products, row(product_terms), row(weight), between=False)


@record
class Approximation:
    """A solution.

    parameters  P
    kind        "interpolation", "minimum", "saddle" (of the sum of squares) or "minimax"
    at, errors  alternation: x of the local extrema of the weighted error, including the ends, and the errors there; for
                given points all points
    worst       greatest magnitude of the weighted error
    rms         root mean square of the weighted error
    bound       minimax only: lower bound of the greatest error for small changes of P; otherwise NaN
    gap         remaining optimality gap. Interpolation: greatest error at a node / greatest error. Least squares:
                greatest cosine between errors and derivatives, 0 at a stationary point. Minimax: 1 - bound / worst
    """

    parameters: Float[np.ndarray, " n"]
    kind: str
    at: Float[np.ndarray, " extremes"]
    errors: Float[np.ndarray, " extremes"]
    worst: float
    rms: float
    bound: float
    gap: float

    @property
    def proven(self) -> bool:
        """Whether the gap is 0 except for rounding."""
        return self.gap <= PROVEN


class Approximations(NamedTuple):
    """All real solutions, the best by the criterion first; and descriptions of what was left out."""

    found: tuple[Approximation, ...]
    left_out: tuple[str, ...]


def range_nodes(start: float, stop: float, count: int = 129) -> Float[np.ndarray, " count"]:
    """Points over a range including both ends, denser towards the ends: the extrema of a Chebyshev polynomial.

    Raises ParameterError unless start < stop, both finite.
    """
    _check_range(start, stop)
    return np.asarray(0.5 * (start + stop) - 0.5 * (stop - start) * np.cos(np.linspace(0, np.pi, count)))


def chebyshev_nodes(start: float, stop: float, count: int) -> Float[np.ndarray, " count"]:
    """Chebyshev nodes of interpolation over a range [unit of x], ascending: the zeros of a Chebyshev polynomial.

        x_i = (x0 + x1) / 2 - (x1 - x0) / 2 cos((2 i - 1) pi / (2 n))

    >>> chebyshev_nodes(0.0, 2.0, 3).round(6)
    array([0.133975, 1.      , 1.866025])
    """
    _check_range(start, stop)
    cosines = np.cos((2 * np.arange(count) + 1) * np.pi / (2 * count))
    return np.asarray(0.5 * (start + stop) - 0.5 * (stop - start) * cosines)


def interpolation(polynomial: SynthesisPolynomial, nodes: FloatArray, points: FloatArray) -> Approximations:
    """All P with e = 0 at as many nodes as there are parameters; sorted by the greatest error.

    nodes   x of the nodes, different, shape (n,)
    points  x at which the greatest error is computed; with `between` its extrema in between count as well

    Raises ParameterError for another number of nodes, equal nodes, and where a family of solutions exists.
    """
    rows = polynomial.rows(nodes)
    count = rows.terms.shape[1]
    if len(nodes) != count or len(np.unique(nodes)) < count:
        given = f"{len(np.unique(nodes))} different nodes for {count} parameters"
        raise ParameterError(given, allowed="as many", do="`least_squares` and `minimax` take any number of points")
    solved = solve_products(rows, polynomial.products)
    found = []
    for parameters in solved.parameters:
        missed = float(np.max(np.abs(polynomial.errors(parameters, nodes))))
        found.append(_approximation(polynomial, parameters, "interpolation", points, (np.nan, missed)))
    return Approximations(tuple(sorted(found, key=lambda one: one.worst)), solved.left_out)


def least_squares(polynomial: SynthesisPolynomial, points: FloatArray) -> Approximations:
    """All P at which the mean square of the error is stationary, the least first.

    points  with `between`, only the ends of the range count and the mean is that of the integral; otherwise it is the
            mean over the points

    With one product, or two with a common factor, the solutions are complete. Raises ParameterError for linearly
    dependent terms.
    """
    x, root = _quadrature(polynomial, points)
    rows = EquationRows(*((root if part.ndim == 1 else root[:, None]) * part for part in polynomial.rows(x)))
    solved = stationary(rows, polynomial.products)
    sizes = scales(rows, polynomial.products)
    found = []
    for parameters in solved.parameters:
        curvature = gradient(rows, polynomial.products, parameters)[1] * np.outer(sizes, sizes)
        kind = "minimum" if np.min(np.linalg.eigvalsh(curvature)) > 0 else "saddle"
        slope = cosine(*errors_of(rows, polynomial.products, parameters))
        found.append(_approximation(polynomial, parameters, kind, points, (np.nan, slope)))
    return Approximations(tuple(sorted(found, key=lambda one: one.rms)), solved.left_out)


def minimax(polynomial: SynthesisPolynomial, points: FloatArray) -> Approximations:
    """All P found at which the greatest error has a local minimum, the least first, each with its lower bound.

    points  x at which the exchange begins, ascending, more than there are parameters; with `between` the extrema in
            between are added

    Solutions without proof are returned only if there are no others. Raises ParameterError as `least_squares` does.
    """
    rows = polynomial.rows(points)
    count = rows.terms.shape[1]
    if len(points) <= count:
        given = f"{len(points)} points for {count} parameters"
        raise ParameterError(given, allowed="more points than parameters", do="`interpolation` takes as many")
    sizes = scales(rows, polynomial.products)
    least = ZERO_ERROR * float(np.max(np.abs(rows.target)))
    errors = _even_errors(polynomial, sizes)
    starts = _starts(polynomial, points, rows, sizes)
    ends = _different(minimax_descent(errors, start, points, least=least) for start in starts)
    if polynomial.between:
        ends = _different(minimax_over_range(errors, end.parameters, points, least=least) for end in ends)
    found = [
        _approximation(polynomial, sizes * end.parameters, "minimax", points, (end.level, end.gap)) for end in ends
    ]
    near = [one for one in found if np.max(np.abs(one.parameters / sizes)) < FAR]
    proven = [one for one in near if one.proven]
    words = ["a search that diverges: a parameter tends to infinity"] if len(near) < len(found) else []
    words += ["a search that does not converge"] if len(proven) < len(near) else []
    return Approximations(tuple(sorted(proven or near, key=lambda one: one.worst)), tuple(words))


def _different(ends: Iterable[Descent]) -> list[Descent]:
    """The ends without duplicates."""
    kept: list[Descent] = []
    for end in ends:
        if all(
            np.max(np.abs(end.parameters - descent.parameters)) > SAME * np.max(np.abs(descent.parameters))
            for descent in kept
        ):
            kept.append(end)
    return kept


def _even_errors(polynomial: SynthesisPolynomial, sizes: FloatArray) -> Errors:
    def errors(parameters: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        found, slopes = errors_of(polynomial.rows(x), polynomial.products, sizes * parameters)
        return found, slopes * sizes

    return errors


def _starts(
    polynomial: SynthesisPolynomial, points: FloatArray, rows: EquationRows, sizes: FloatArray
) -> Iterator[FloatArray]:
    """Scaled parameters at which the minimax search starts."""
    products, count = polynomial.products, rows.terms.shape[1]
    if not products:
        yield np.zeros(count)
        return
    for one in least_squares(polynomial, points).found:
        yield one.parameters / sizes
    even = scaled(rows, products, sizes)
    yield from (start[:count] for start in _equal_error_starts(even, products))
    common = common_factor(products)
    if common is not None:
        yield from _common_factor_starts(even, products, common)


def _equal_error_starts(rows: EquationRows, products: Products) -> Iterator[FloatArray]:
    """All P and levels E with errors E and -E alternating at n + 1 points: interpolation with one more parameter."""
    count = rows.terms.shape[1]
    at = np.round((len(rows.target) - 1) * np.arange(count + 1) / count).astype(int)
    turns = np.where(np.arange(count + 1) % 2, -1.0, 1.0)
    table = EquationRows(np.column_stack([rows.terms[at], turns]), rows.products[at], rows.target[at])
    try:
        yield from solve_products(table, products).parameters
    except ParameterError:  # a family on these points does not exclude solutions elsewhere
        return


def _common_factor_starts(rows: EquationRows, products: Products, common: int) -> Iterator[FloatArray]:
    """The minima of the minimax along the factor common to all products; with it given, the problem is linear."""
    partners = [b if a == common else a for a, b in products]
    factors = np.tan(np.pi * (np.arange(TURNS) + 0.5) / TURNS - np.pi / 2)
    ends, worst = [], np.empty(TURNS)
    for k, factor in enumerate(factors):
        columns = rows.terms.copy()
        columns[:, common] = 0
        columns[:, partners] += factor * rows.products
        best = linear_minimax(columns, rows.target - factor * rows.terms[:, common])
        best.change[common] = factor
        ends.append(best.change)
        worst[k] = best.worst
    low = (worst <= np.roll(worst, 1)) & (worst <= np.roll(worst, -1))
    yield from (end for end, lowest in zip(ends, low, strict=True) if lowest)


def _quadrature(polynomial: SynthesisPolynomial, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points of the mean square, and the square roots of their weights."""
    if not polynomial.between:
        return points, np.full(len(points), len(points) ** -0.5)
    nodes, shares = np.polynomial.legendre.leggauss(NODES)
    return 0.5 * (points[0] + points[-1]) + 0.5 * (points[-1] - points[0]) * nodes, np.sqrt(0.5 * shares)


def _approximation(
    polynomial: SynthesisPolynomial, parameters: FloatArray, kind: str, points: FloatArray, proof: tuple[float, float]
) -> Approximation:
    """A solution with its errors; `proof` is its bound and gap, for interpolation NaN and the error at the nodes."""
    error = partial(polynomial.errors, parameters)
    at = extremes(error, points) if polynomial.between else points
    errors = error(at)
    x, root = _quadrature(polynomial, points)
    worst, size = float(np.max(np.abs(errors))), float(np.max(np.abs(polynomial.rows(at).target)))
    bound, gap = proof[0], proof[1] / max(worst, 1e-300) if kind == "interpolation" else proof[1]
    if worst <= ZERO_ERROR * size:  # an exact solution needs no proof
        gap = 0.0
    return Approximation(
        parameters, kind, at, errors, worst, float(np.linalg.norm(root * error(x))), float(bound), float(gap)
    )


def _check_range(start: float, stop: float) -> None:
    if not (np.isfinite(start) and np.isfinite(stop) and start < stop):
        raise ParameterError(f"x from {start:g} to {stop:g}", allowed="finite ends, the first below the last")
