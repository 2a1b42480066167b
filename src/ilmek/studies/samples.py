"""Designs of a sweep: Sobol' sequence, Latin hypercube, grid; each from a seed."""

import math
from collections.abc import Mapping

import numpy as np
from scipy.stats import norm, qmc

from ilmek.arrays import Float
from ilmek.errors import ParameterError, did_you_mean
from ilmek.studies.variable import Variable

SAMPLINGS = ("sobol", "latin", "grid")
"""Sobol' sequence, scrambled; Latin hypercube; grid of equal steps."""

TINY = 1e-15
"""Least share of probability of a design."""

MOST_DESIGNS = 10_000_000
"""Largest number of designs of a study."""


def sampled(
    variables: tuple[Variable, ...],
    sampling: str,
    count: int,
    seed: int,
    correlation: Float[np.ndarray, "v v"] | None = None,
) -> Float[np.ndarray, "n variables"]:
    """Values of the designs [SI], a row a design; correlated by a normal copula.

    grid: the largest number of equal steps of every variable whose grid has at most `count` designs, at least two;
    choices are all taken. Raises ParameterError for a number of designs out of bounds.
    """
    if not 1 <= count <= MOST_DESIGNS:
        raise ParameterError(f"{count} designs", allowed=f"1 to {MOST_DESIGNS:,}")
    if sampling == "grid":
        return _grid(variables, count)
    if sampling == "sobol":
        unit = qmc.Sobol(len(variables), rng=seed).random_base2(math.ceil(math.log2(count)))[:count]
    else:
        unit = qmc.LatinHypercube(len(variables), rng=seed).random(count)
    if correlation is not None:
        inside = np.clip(unit, TINY, 1 - TINY)  # the ends of a normal distribution are infinite
        unit = norm.cdf(norm.ppf(inside) @ np.linalg.cholesky(correlation).T)
    return np.column_stack([variable.at(unit[:, number]) for number, variable in enumerate(variables)])


def correlation_of(
    variables: tuple[Variable, ...], pairs: Mapping[tuple[str, str], float]
) -> Float[np.ndarray, "v v"] | None:
    """The matrix of correlations by pairs of names; None without any.

    Raises ParameterError for a name that does not vary, and for numbers that contradict one another.
    """
    if not pairs:
        return None
    names = [variable.name for variable in variables]
    matrix = np.eye(len(names))
    for (first, second), value in pairs.items():
        for name in (first, second):
            if name not in names:
                raise ParameterError(f"correlation of {name!r}, which does not vary", do=did_you_mean(name, names))
        if first == second or not -1 < value < 1:
            raise ParameterError(f"correlation of {first} and {second}: {value:g}", allowed="two names, -1 < r < 1")
        row, column = names.index(first), names.index(second)
        matrix[row, column] = matrix[column, row] = value
    if np.linalg.eigvalsh(matrix)[0] <= 0:
        raise ParameterError("the correlations contradict one another", allowed="a positive definite matrix")
    return matrix


def _grid(variables: tuple[Variable, ...], count: int) -> Float[np.ndarray, "n variables"]:
    def steps(most: int) -> list[int]:
        lengths = [round(v.high - v.low) + 1 if v.whole or v.choices else MOST_DESIGNS for v in variables]
        return [
            length if variable.choices else min(most, length)
            for variable, length in zip(variables, lengths, strict=True)
        ]

    most = 2
    while math.prod(steps(most + 1)) <= count and steps(most + 1) != steps(most):
        most += 1
    designs = math.prod(steps(most))
    if designs > count:
        raise ParameterError(
            f"a grid of {count} designs over {len(variables)} variables",
            allowed=f"at least {designs}, two values of each",
            do="raise --samples, or take --sampling sobol",
        )
    ends = [
        np.unique(np.round(values)) if variable.whole or variable.choices else values
        for variable, length in zip(variables, steps(most), strict=True)
        for values in (np.linspace(variable.low, variable.high, length),)
    ]
    return np.stack(np.meshgrid(*ends, indexing="ij"), axis=-1).reshape(-1, len(variables))
