"""Freudenstein's equation as a synthesis polynomial: the design error of a function generator, in three criteria.

Both start angles said, it is linear in R1, R2, R3. With one of them free, the link W that turns from it is a vector,
and the equation over the other link's length has four parameters and two products with a common factor,

    crank start free     P0 - X cos(th4 - phi) - Y sin(th4 - phi) - s X cos phi + s Y sin phi = -cos th4
                         P0 = K / c, W = X + i Y = a e^{i alpha}, s = 1 / c
    rocker start free    P0 - X cos(psi - th2) + Y sin(psi - th2) + s X cos psi - s Y sin psi = cos th2
                         P0 = K / a, W = X + i Y = c e^{i beta}, s = 1 / a

with 2 K = 1 + a^2 - b^2 + c^2, so that all answers are known: two at most through four pairs of angles, nine stationary
ones at most for the squares. With both start angles free there are four products: see `function_generator`.
[Freudenstein 1955; the form with vectors as in `freudenstein`; Todorov, Mech. Mach. Theory 37 (2002) 1505]
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.synthesis.approximation.function_error import Generator, Weight, design_table
from ilmek.synthesis.approximation.polynomial import (
    Approximation,
    SynthesisPolynomial,
    chebyshev_nodes,
    interpolation,
    least_squares,
    minimax,
    range_nodes,
)
from ilmek.synthesis.function import Function


class GeneratorDesign(NamedTuple):
    """A generator and what is said of its design error."""

    generator: Generator
    error: Approximation


class GeneratorDesigns(NamedTuple):
    """Generators, the best by the criterion first, and in words what came out that is none."""

    found: tuple[GeneratorDesign, ...]
    left_out: tuple[str, ...]


def design_polynomial(
    function: Function,
    *,
    crank_start: float | None = None,
    rocker_start: float | None = None,
    weight: Weight | None = None,
) -> SynthesisPolynomial:
    """The synthesis polynomial of the design error over x: in R1, R2, R3, or in P0, X, Y, s where one start is free.

    Raises ParameterError where both are free.
    """
    if crank_start is not None and rocker_start is not None:
        starts = crank_start, rocker_start
        return SynthesisPolynomial(
            lambda x: design_table(function, starts, x)[0],
            lambda x: design_table(function, starts, x)[1],
            weight=weight,
        )
    if crank_start is None and rocker_start is None:
        raise ParameterError(
            "both start angles of the design error are free",
            allowed="one of them",
            do="`function_approximations` takes both",
        )
    # Either way: W turns by `own`, the other link stands at `other`, and only signs differ.
    sign = -1.0 if crank_start is None else 1.0

    def angles(x: FloatArray) -> tuple[FloatArray, FloatArray]:
        if crank_start is not None:
            return function.rocker(x), crank_start + function.crank(x)
        assert rocker_start is not None
        return function.crank(x), rocker_start + function.rocker(x)

    def terms(x: FloatArray) -> FloatArray:
        own, other = angles(x)
        return np.stack([np.ones(len(x)), -np.cos(own - other), np.sin(own - other), np.zeros(len(x))], axis=-1)

    def products(x: FloatArray) -> FloatArray:
        own, _ = angles(x)
        return sign * np.stack([np.cos(own), -np.sin(own)], axis=-1)

    def wanted(x: FloatArray) -> FloatArray:
        return np.asarray(sign * np.cos(angles(x)[1]))

    return SynthesisPolynomial(terms, wanted, ((3, 1), (3, 2)), products, weight)


def design_generators(
    function: Function,
    criterion: str,
    *,
    crank_start: float | None = None,
    rocker_start: float | None = None,
    weight: Weight | None = None,
) -> GeneratorDesigns:
    """All generators that are best by a criterion for the design error, one start angle at least being said.

    criterion  "interpolation" at Chebyshev's places, "least squares" (every stationary answer) or "minimax"
    Raises ParameterError for another criterion, and where both start angles are free.
    """
    polynomial = design_polynomial(function, crank_start=crank_start, rocker_start=rocker_start, weight=weight)
    low, high = sorted((function.start, function.stop))
    places = range_nodes(low, high)
    if criterion == "interpolation":
        count = 4 if polynomial.products else 3
        answers, words = interpolation(polynomial, chebyshev_nodes(low, high, count), places)
    elif criterion in {"least squares", "minimax"}:
        answers, words = (minimax if criterion == "minimax" else least_squares)(polynomial, places)
    else:
        raise ParameterError(
            f"criterion {criterion!r} of a design error", allowed="interpolation, least squares, minimax"
        )
    found = [GeneratorDesign(_generator(one.parameters, crank_start, rocker_start), one) for one in answers]
    return GeneratorDesigns(tuple(found), words)


def _generator(parameters: FloatArray, crank_start: float | None, rocker_start: float | None) -> Generator:
    """The generator that parameters of the polynomial stand for."""
    if crank_start is not None and rocker_start is not None:
        r1, r2, r3 = (float(ratio) for ratio in parameters)
        return Generator(r1, r2, r3, crank_start, rocker_start)
    p0, x, y, by_other = (float(one) for one in parameters)
    by_own, start = 1 / np.hypot(x, y), float(np.arctan2(y, x))
    if crank_start is None:
        assert rocker_start is not None
        return Generator(float(by_own), by_other, p0 * float(by_own), start, rocker_start)
    return Generator(by_other, float(by_own), p0 * float(by_own), crank_start, start)
