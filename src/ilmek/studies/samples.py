"""Designs of a sweep: Sobol' sequence, Latin hypercube, grid; each from a seed."""

import math

import numpy as np
from scipy.stats import qmc

from ilmek.arrays import Float
from ilmek.errors import ParameterError
from ilmek.studies.variable import Variable

SAMPLINGS = ("sobol", "latin", "grid")
"""Sobol' sequence, scrambled; Latin hypercube; grid of equal steps."""

MOST_DESIGNS = 10_000_000
"""Largest number of designs of a study."""


def sampled(variables: tuple[Variable, ...], sampling: str, count: int, seed: int) -> Float[np.ndarray, "n variables"]:
    """Values of the designs [SI], a row a design.

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
    return np.column_stack([variable.at(unit[:, number]) for number, variable in enumerate(variables)])


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
