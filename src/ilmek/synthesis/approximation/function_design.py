"""Freudenstein's equation as a synthesis polynomial: design error of a function generator, by three criteria.

With both start angles given it is linear in R1, R2, R3. With one of them free, its link W is a vector, and the equation
divided by the length of the other link has four parameters and two products with a common factor,

    crank start free     P0 - X cos(th4 - phi) - Y sin(th4 - phi) - s X cos phi + s Y sin phi = -cos th4
                         P0 = K / c, W = X + i Y = a e^{i alpha}, s = 1 / c
    rocker start free    P0 - X cos(psi - th2) + Y sin(psi - th2) + s X cos psi - s Y sin psi = cos th2
                         P0 = K / a, W = X + i Y = c e^{i beta}, s = 1 / a

with 2 K = 1 + a^2 - b^2 + c^2. All solutions are known: at most two through four pairs of angles, and at most nine
stationary points of the squares. With both start angles free there are four products: see `function_generator`.
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
    """A generator and its design error."""

    generator: Generator
    error: Approximation


class GeneratorDesigns(NamedTuple):
    """Generators, the best by the criterion first; and descriptions of what was left out."""

    found: tuple[GeneratorDesign, ...]
    left_out: tuple[str, ...]


def design_polynomial(
    function: Function,
    *,
    crank_start: float | None = None,
    rocker_start: float | None = None,
    weight: Weight | None = None,
) -> SynthesisPolynomial:
    """The synthesis polynomial of the design error over x: in R1, R2, R3, or in P0, X, Y, s with one free start angle.

    crank_start, rocker_start  angles at the start of the function [rad]; default: free
    weight                     of the error at each x, above 0; default: 1

    Raises ParameterError where both start angles are free.
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
            do="use `function_approximations` for two free start angles",
        )
    # In both cases W rotates by `own` and the other link has the angle `other`; only signs differ.
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

    def target(x: FloatArray) -> FloatArray:
        return np.asarray(sign * np.cos(angles(x)[1]))

    return SynthesisPolynomial(terms, target, ((3, 1), (3, 2)), products, weight)


def design_generators(
    function: Function,
    criterion: str,
    *,
    crank_start: float | None = None,
    rocker_start: float | None = None,
    weight: Weight | None = None,
) -> GeneratorDesigns:
    """All generators that are optimal by a criterion for the design error, with at least one start angle given.

    criterion                  "interpolation" at Chebyshev nodes, "least squares" (all stationary points) or "minimax"
    crank_start, rocker_start  angles at the start of the function [rad]; default: free
    weight                     of the error at each x, above 0; default: 1

    Raises ParameterError for another criterion, and where both start angles are free.
    """
    polynomial = design_polynomial(function, crank_start=crank_start, rocker_start=rocker_start, weight=weight)
    low, high = sorted((function.start, function.stop))
    points = range_nodes(low, high)
    if criterion == "interpolation":
        count = 4 if polynomial.products else 3
        answers, words = interpolation(polynomial, chebyshev_nodes(low, high, count), points)
    elif criterion in {"least squares", "minimax"}:
        answers, words = (minimax if criterion == "minimax" else least_squares)(polynomial, points)
    else:
        raise ParameterError(
            f"criterion {criterion!r} of a design error", allowed="interpolation, least squares, minimax"
        )
    found = [GeneratorDesign(_generator(answer.parameters, crank_start, rocker_start), answer) for answer in answers]
    return GeneratorDesigns(tuple(found), words)


def _generator(parameters: FloatArray, crank_start: float | None, rocker_start: float | None) -> Generator:
    """The generator of parameters of the polynomial."""
    if crank_start is not None and rocker_start is not None:
        r1, r2, r3 = (float(ratio) for ratio in parameters)
        return Generator(r1, r2, r3, crank_start, rocker_start)
    p0, x, y, by_other = (float(parameter) for parameter in parameters)
    by_own, start = 1 / np.hypot(x, y), float(np.arctan2(y, x))
    if crank_start is None:
        assert rocker_start is not None
        return Generator(float(by_own), by_other, p0 * float(by_own), start, rocker_start)
    return Generator(by_other, float(by_own), p0 * float(by_own), crank_start, start)
