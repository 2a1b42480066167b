"""Approximation by a synthesis polynomial: parameters that come in linearly, and one or two products of them.

    sum_k P_k f_k(x) + sum_j P_a P_b g_j(x)  ~  F(x)        error e(x) = q(x) (F(x) - left side)

Three criteria: e = 0 at as many nodes as there are parameters; the least sum of squares; the least greatest error.
With products each of them has several answers, and all real ones are wanted. The first two are solved outright
(`approximation.products`). The third begins at all answers of the second, at the levelled errors of n + 1 places (the
superposition of the first, with the level for one parameter more) and at the low places of the minimax along a factor
that is in every product; from there it goes on by exchange (`approximation.exchange`).
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
    errors_of,
    gradient,
    hub_of,
    scaled,
    scales,
    solve_products,
    stationary,
)

Terms: TypeAlias = Callable[[FloatArray], FloatArray]
"""x -> what there is at each x, place by place."""

NODES = 64
"""Gauss's nodes for the integral of the squares over a range."""

SAME = 1e-4
"""Difference of even parameters, of the greatest, below which two answers are one."""

FAR = 1e4
"""Even parameter beyond which a minimax runs off."""

TURNS = 32
"""Directions of a common factor in which a minimax is looked for."""

NOTHING = 1e-13
"""Error, of the greatest wanted value, that counts as none."""


@record
class SynthesisPolynomial:
    """What is to be approximated, and by what.

    terms    f: x -> (places, n)      wanted  F: x -> (places)
    products pairs (a, b) of parameters, none, one or two      product_terms  g: x -> (places, products)
    weight   q: x -> (places), above 0; 1 where it is not said
    between  whether x is a range, so that errors between places count too; False for given places alone

    Raises ParameterError for more than two products, and for products without terms.
    """

    terms: Terms
    wanted: Terms
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
        """The weighted equations at places x. Raises ParameterError where they are not finite."""
        weight = np.ones(len(x)) if self.weight is None else np.asarray(self.weight(x), dtype=float)
        products = np.zeros((len(x), 0)) if self.product_terms is None else self.product_terms(x)
        found = EquationRows(weight[:, None] * self.terms(x), weight[:, None] * products, weight * self.wanted(x))
        if not all(np.isfinite(part).all() for part in found):
            raise ParameterError("the synthesis polynomial is not finite everywhere", do="choose another range of x")
        if not np.min(weight) > 0:
            raise ParameterError(f"a weight of the error is {np.min(weight):g}", allowed="above 0")
        return found

    def errors(self, parameters: FloatArray, x: FloatArray) -> FloatArray:
        """Weighted errors at x."""
        return errors_of(self.rows(x), self.products, parameters)[0]


def of_table(
    terms: Float[np.ndarray, "places n"],
    wanted: Float[np.ndarray, " places"],
    products: Products = (),
    product_terms: Float[np.ndarray, "places products"] | None = None,
    weight: Float[np.ndarray, " places"] | None = None,
) -> SynthesisPolynomial:
    """The polynomial of given places, a row of each table for each: x are their numbers, 0., 1., 2. ..."""

    def row(table: FloatArray | None) -> Terms | None:
        return None if table is None else (lambda x: table[np.asarray(x, dtype=int)])

    given = row(terms), row(wanted)
    assert given[0] is not None
    assert given[1] is not None
    return SynthesisPolynomial(given[0], given[1], products, row(product_terms), row(weight), between=False)


@record
class Approximation:
    """One answer.

    parameters P      kind  "interpolation", "minimum", "saddle" (of the sum of squares) or "minimax"
    at, errors the alternation: places of the local extremes of the weighted error, ends included, and the errors there;
               of given places all of them
    worst      greatest size of the weighted error      rms  root of its mean square
    bound      minimax only: no small change of P brings the greatest error below it; NaN for the others
    gap        what is not proven. Interpolation: greatest error at a node by greatest error. Squares: greatest cosine
               between errors and slopes, which vanishes where they are stationary. Minimax: 1 - bound / worst
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
        """Whether it is what its kind says, to rounding."""
        return self.gap <= PROVEN


class Approximations(NamedTuple):
    """All real answers, the best by their criterion first, and in words what is none."""

    found: tuple[Approximation, ...]
    left_out: tuple[str, ...]


def range_nodes(start: float, stop: float, count: int = 129) -> Float[np.ndarray, " count"]:
    """Places over a range, both ends among them, denser towards the ends: the extremes of Chebyshev's polynomial."""
    _check_range(start, stop)
    return np.asarray(0.5 * (start + stop) - 0.5 * (stop - start) * np.cos(np.linspace(0, np.pi, count)))


def chebyshev_nodes(start: float, stop: float, count: int) -> Float[np.ndarray, " count"]:
    """Nodes at which an error of interpolation is spread about evenly: the zeros of Chebyshev's polynomial.

        x_i = (x0 + x1) / 2 - (x1 - x0) / 2 cos((2 i - 1) pi / (2 n))

    >>> chebyshev_nodes(0.0, 2.0, 3).round(6)
    array([0.133975, 1.      , 1.866025])
    """
    _check_range(start, stop)
    cosines = np.cos((2 * np.arange(count) + 1) * np.pi / (2 * count))
    return np.asarray(0.5 * (start + stop) - 0.5 * (stop - start) * cosines)


def interpolation(polynomial: SynthesisPolynomial, nodes: FloatArray, places: FloatArray) -> Approximations:
    """All P without an error at as many nodes as there are parameters; the least greatest error at `places` first.

    Raises ParameterError for another number of nodes, nodes that are not different, and where a whole family does it.
    """
    rows = polynomial.rows(nodes)
    count = rows.terms.shape[1]
    if len(nodes) != count or len(np.unique(nodes)) < count:
        given = f"{len(np.unique(nodes))} different nodes for {count} parameters"
        raise ParameterError(given, allowed="as many", do="`least_squares` and `minimax` take any number of places")
    solved = solve_products(rows, polynomial.products)
    found = []
    for parameters in solved.parameters:
        missed = float(np.max(np.abs(polynomial.errors(parameters, nodes))))
        found.append(_told(polynomial, parameters, "interpolation", places, (np.nan, missed)))
    return Approximations(tuple(sorted(found, key=lambda one: one.worst)), solved.left_out)


def least_squares(polynomial: SynthesisPolynomial, places: FloatArray) -> Approximations:
    """All P at which the mean square of the error is stationary, the least first.

    places  with `between`, only the ends of the range count, and the mean is the integral's; else the mean is over them
    With one product, or two that have a factor in common, these are all there are. Raises ParameterError where terms
    make up one another.
    """
    x, root = _quadrature(polynomial, places)
    rows = EquationRows(*((root if part.ndim == 1 else root[:, None]) * part for part in polynomial.rows(x)))
    solved = stationary(rows, polynomial.products)
    sizes = scales(rows, polynomial.products)
    found = []
    for parameters in solved.parameters:
        curvature = gradient(rows, polynomial.products, parameters)[1] * np.outer(sizes, sizes)
        kind = "minimum" if np.min(np.linalg.eigvalsh(curvature)) > 0 else "saddle"
        slope = cosine(*errors_of(rows, polynomial.products, parameters))
        found.append(_told(polynomial, parameters, kind, places, (np.nan, slope)))
    return Approximations(tuple(sorted(found, key=lambda one: one.rms)), solved.left_out)


def minimax(polynomial: SynthesisPolynomial, places: FloatArray) -> Approximations:
    """All P at which the greatest error is locally least, the least first, each with the bound that proves it.

    places  where the exchange begins, rising, more than there are parameters; with `between` all extremes between them
            are taken in, else they are all that counts
    What is not proven is answered only where nothing else is. Raises ParameterError as `least_squares` does.
    """
    rows = polynomial.rows(places)
    count = rows.terms.shape[1]
    if len(places) <= count:
        given = f"{len(places)} places for {count} parameters"
        raise ParameterError(given, allowed="more places than parameters", do="`interpolation` takes as many")
    sizes = scales(rows, polynomial.products)
    least = NOTHING * float(np.max(np.abs(rows.wanted)))
    errors = _even_errors(polynomial, sizes)
    starts = _starts(polynomial, places, rows, sizes)
    ends = _different(minimax_descent(errors, start, places, least=least) for start in starts)
    if polynomial.between:
        ends = _different(minimax_over_range(errors, end.parameters, places, least=least) for end in ends)
    found = [_told(polynomial, sizes * end.parameters, "minimax", places, (end.level, end.gap)) for end in ends]
    near = [one for one in found if np.max(np.abs(one.parameters / sizes)) < FAR]
    proven = [one for one in near if one.proven]
    words = ["a search that runs off: a parameter without end"] if len(near) < len(found) else []
    words += ["a search that came to no end"] if len(proven) < len(near) else []
    return Approximations(tuple(sorted(proven or near, key=lambda one: one.worst)), tuple(words))


def _different(ends: Iterable[Descent]) -> list[Descent]:
    """Each end once."""
    kept: list[Descent] = []
    for end in ends:
        if all(np.max(np.abs(end.parameters - one.parameters)) > SAME * np.max(np.abs(one.parameters)) for one in kept):
            kept.append(end)
    return kept


def _even_errors(polynomial: SynthesisPolynomial, sizes: FloatArray) -> Errors:
    def errors(parameters: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        found, slopes = errors_of(polynomial.rows(x), polynomial.products, sizes * parameters)
        return found, slopes * sizes

    return errors


def _starts(
    polynomial: SynthesisPolynomial, places: FloatArray, rows: EquationRows, sizes: FloatArray
) -> Iterator[FloatArray]:
    """Even parameters from which a minimax is sought."""
    products, count = polynomial.products, rows.terms.shape[1]
    if not products:
        yield np.zeros(count)
        return
    for one in least_squares(polynomial, places).found:
        yield one.parameters / sizes
    even = scaled(rows, products, sizes)
    yield from (one[:count] for one in _levelled(even, products))
    hub = hub_of(products)
    if hub is not None:
        yield from _along_factor(even, products, hub)


def _levelled(rows: EquationRows, products: Products) -> Iterator[FloatArray]:
    """All P and levels E with errors of E and -E in turns at n + 1 places: one parameter more than interpolation."""
    count = rows.terms.shape[1]
    at = np.round((len(rows.wanted) - 1) * np.arange(count + 1) / count).astype(int)
    turns = np.where(np.arange(count + 1) % 2, -1.0, 1.0)
    table = EquationRows(np.column_stack([rows.terms[at], turns]), rows.products[at], rows.wanted[at])
    try:
        yield from solve_products(table, products).parameters
    except ParameterError:  # a family on these places says nothing of others
        return


def _along_factor(rows: EquationRows, products: Products, hub: int) -> Iterator[FloatArray]:
    """The low places of the minimax along the factor that is in every product: with it said, all is linear."""
    partners = [b if a == hub else a for a, b in products]
    factors = np.tan(np.pi * (np.arange(TURNS) + 0.5) / TURNS - np.pi / 2)
    ends, worst = [], np.empty(TURNS)
    for k, factor in enumerate(factors):
        columns = rows.terms.copy()
        columns[:, hub] = 0
        columns[:, partners] += factor * rows.products
        best = linear_minimax(columns, rows.wanted - factor * rows.terms[:, hub])
        best.change[hub] = factor
        ends.append(best.change)
        worst[k] = best.worst
    low = (worst <= np.roll(worst, 1)) & (worst <= np.roll(worst, -1))
    yield from (end for end, lowest in zip(ends, low, strict=True) if lowest)


def _quadrature(polynomial: SynthesisPolynomial, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Places at which squares are added up to their mean, and the roots of their shares."""
    if not polynomial.between:
        return places, np.full(len(places), len(places) ** -0.5)
    nodes, shares = np.polynomial.legendre.leggauss(NODES)
    return 0.5 * (places[0] + places[-1]) + 0.5 * (places[-1] - places[0]) * nodes, np.sqrt(0.5 * shares)


def _told(
    polynomial: SynthesisPolynomial, parameters: FloatArray, kind: str, places: FloatArray, proof: tuple[float, float]
) -> Approximation:
    """What there is to be said of an answer; `proof` is its bound and gap, of interpolation the error at the nodes."""
    error = partial(polynomial.errors, parameters)
    at = extremes(error, places) if polynomial.between else places
    errors = error(at)
    x, root = _quadrature(polynomial, places)
    worst, size = float(np.max(np.abs(errors))), float(np.max(np.abs(polynomial.rows(at).wanted)))
    bound, gap = proof[0], proof[1] / max(worst, 1e-300) if kind == "interpolation" else proof[1]
    if worst <= NOTHING * size:  # nothing is left to be proven
        gap = 0.0
    return Approximation(
        parameters, kind, at, errors, worst, float(np.linalg.norm(root * error(x))), float(bound), float(gap)
    )


def _check_range(start: float, stop: float) -> None:
    if not (np.isfinite(start) and np.isfinite(stop) and start < stop):
        raise ParameterError(f"x from {start:g} to {stop:g}", allowed="finite ends, the first below the last")
