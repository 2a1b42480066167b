"""Sensitivity of results to variables: derivatives at a design, Morris' elementary effects, Sobol' indices."""

from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import ParameterError
from ilmek.records import JsonObject, record
from ilmek.studies.variable import Variable

STEP = 1e-3
"""Step of central differences, relative to the range of a variable; half of it too, for the error."""

LEVELS = 4
"""Levels of Morris' grid."""

Evaluate = Callable[[Float[np.ndarray, "n variables"]], Float[np.ndarray, "n results"]]
"""Values of the variables -> results, a row a design; NaN where there is none."""


@record
class SensitivityIndex:
    """A measure of how a result depends on a variable.

    value     derivative [SI], mean of |effect| [of the result], or index [1]
    interval  half the width of its 95 % interval, or the error of the derivative; the same unit
    """

    result: str
    variable: str
    measure: str
    value: float
    interval: float

    def as_json(self) -> JsonObject:
        """Plain data."""
        return {name: getattr(self, name) for name in ("result", "variable", "measure", "value", "interval")}


def local(
    variables: tuple[Variable, ...], results: tuple[str, ...], evaluate: Evaluate
) -> tuple[SensitivityIndex, ...]:
    """Derivatives at the nominal design by central differences, extrapolated (Richardson).

        d = (4 D(h/2) - D(h)) / 3,   D(h) = (f(x + h) - f(x - h)) / 2h,   error |d - D(h/2)|

    At a bound the step goes inwards: the differences are then about the nearest point h from the bound. Raises
    ParameterError for variables that are no real numbers.
    """
    _continuous(variables, "derivatives")
    step = np.array([STEP * (v.high - v.low) for v in variables])
    low, high = (np.array([getattr(v, name) for v in variables]) for name in ("low", "high"))
    centre = np.clip([v.nominal for v in variables], low + step, high - step)
    points = [
        centre + sign * share * step[number] * np.eye(len(variables))[number]
        for number in range(len(variables))
        for share in (1.0, 0.5)
        for sign in (+1.0, -1.0)
    ]
    values = evaluate(np.array(points)).reshape(len(variables), 2, 2, len(results))
    slopes = (values[:, :, 0] - values[:, :, 1]) / (2 * step[:, None, None] * np.array([1.0, 0.5])[:, None])
    best = (4 * slopes[:, 1] - slopes[:, 0]) / 3
    error = np.abs(best - slopes[:, 1])
    return tuple(
        SensitivityIndex(result, variable.name, "derivative", float(best[i, j]), float(error[i, j]))
        for j, result in enumerate(results)
        for i, variable in enumerate(variables)
    )


def morris(
    variables: tuple[Variable, ...], results: tuple[str, ...], evaluate: Evaluate, count: int, seed: int
) -> tuple[SensitivityIndex, ...]:
    """Morris' mean of absolute elementary effects over the range of each variable, with its interval (SALib).

    count  number of designs; so many trajectories are taken as fit
    """
    problem = _problem(variables)
    trajectories = max(count // (len(variables) + 1), 2)
    unit = _salib("sample.morris").sample(problem, trajectories, num_levels=LEVELS, seed=seed)
    values = evaluate(_values(variables, unit))
    found = []
    for number, result in enumerate(results):
        kept = _whole_groups(values[:, number], len(variables) + 1, result)
        analyze = _salib("analyze.morris").analyze
        indices = analyze(problem, unit[kept], values[kept, number], num_levels=LEVELS, seed=seed)
        rows = zip(variables, indices["mu_star"], indices["mu_star_conf"], indices["sigma"], strict=True)
        for variable, mean, interval, sigma in rows:
            found.append(SensitivityIndex(result, variable.name, "mean |effect|", float(mean), float(interval)))
            found.append(SensitivityIndex(result, variable.name, "deviation of effects", float(sigma), np.nan))
    return tuple(found)


def sobol(
    variables: tuple[Variable, ...], results: tuple[str, ...], evaluate: Evaluate, count: int, seed: int
) -> tuple[SensitivityIndex, ...]:
    """Sobol' indices of first order and total, with 95 % intervals by bootstrap (SALib: Saltelli 2010, Jansen).

    count  number of designs; the base sample is the largest power of two that fits, at least 8
    """
    problem = _problem(variables)
    base = 2 ** max(3, int(np.log2(max(count / (len(variables) + 2), 1))))
    unit = _salib("sample.sobol").sample(problem, base, calc_second_order=False, seed=seed)
    values = evaluate(_values(variables, unit))
    found = []
    for number, result in enumerate(results):
        kept = _whole_groups(values[:, number], len(variables) + 2, result)
        indices = _salib("analyze.sobol").analyze(problem, values[kept, number], calc_second_order=False, seed=seed)
        for measure, key in (("first order", "S1"), ("total", "ST")):
            rows = zip(variables, indices[key], indices[f"{key}_conf"], strict=True)
            found += [SensitivityIndex(result, v.name, measure, float(value), float(i)) for v, value, i in rows]
    return tuple(found)


def _whole_groups(values: Float[np.ndarray, " n"], size: int, result: str) -> np.ndarray:
    """Which designs belong to a trajectory, or to a row of the base sample, all of whose designs have the result.

    Raises ParameterError where fewer than two do.
    """
    whole = np.isfinite(values.reshape(-1, size)).all(axis=1)
    if whole.sum() < 2:
        given = f"{result} exists in {int(np.isfinite(values).sum())} of {len(values)} designs"
        raise ParameterError(given, allowed="two groups of designs that all have it", do="narrow the ranges")
    return np.repeat(whole, size)


def _continuous(variables: tuple[Variable, ...], purpose: str) -> None:
    for variable in variables:
        if not variable.continuous:
            raise ParameterError(f"{variable.name} is no real number", allowed=f"{purpose} need real numbers")


def _problem(variables: tuple[Variable, ...]) -> JsonObject:
    return {"num_vars": len(variables), "names": [v.name for v in variables], "bounds": [[0.0, 1.0]] * len(variables)}


def _values(variables: tuple[Variable, ...], unit: Float[np.ndarray, "n v"]) -> Float[np.ndarray, "n v"]:
    """Values of shares of probability; the ends of an unbounded distribution are moved inwards."""
    inside = np.clip(unit, 1e-6, 1 - 1e-6)
    columns = [v.at(unit[:, n] if v.spread == "uniform" else inside[:, n]) for n, v in enumerate(variables)]
    return np.column_stack(columns)


def _salib(module: str) -> Any:
    """A module of SALib. Raises ParameterError without the extra."""
    try:
        return import_module(f"SALib.{module}")
    except ImportError:
        raise ParameterError("global sensitivities need the extra study", do="pip install 'ilmek[study]'") from None
