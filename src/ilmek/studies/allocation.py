"""Which tolerance to tighten and which to widen: the tolerances of least cost that give a wanted yield.

    cost = sum c_i / s_i            s_i  factor of tolerance i; c_i cost of its present width       [reciprocal cost]
    margin of check k ~ m_k + sum g_ki (x_i - mean_i),  deviation sigma_k^2 = g_k' S R S g_k,  S = diag(s_i sigma_i)
    1 - yield <= sum over k of Phi(-m_k / sigma_k)                  [Boole's inequality, margins normally distributed]

The slopes g come from a linear fit to designs that were made. The bound is conservative where checks fail together; the
yield is therefore computed again with designs of the new tolerances. Of one check the optimum is known in closed form:
s_i^3 is proportional to c_i / (g_i sigma_i)^2                                             [Lagrange's multiplier]
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from scipy.optimize import minimize
from scipy.stats import norm

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.records import JsonObject, record
from ilmek.studies.tolerance import Yield
from ilmek.studies.variable import Variable

LEAST, GREATEST = 0.02, 10.0
"""Bounds of the factor of a tolerance."""


INSIDE = 1e-6
"""Excess of the log of the share that fails at which a solution counts as inside."""


@record
class Allocation:
    """New tolerances for a yield.

    factors   variable -> factor of its tolerance: below 1 it is tightened      cost  over that of the present ones
    expected  yield by the linear fit                                           found  by designs; None: not computed
    explained  least share of a margin's variance that its linear fit explains
    """

    target: float
    factors: dict[str, float]
    cost: float
    expected: float
    explained: float
    found: Yield | None = None

    def as_json(self) -> JsonObject:
        """Plain data."""
        names = ("target", "factors", "cost", "expected", "explained")
        return {name: getattr(self, name) for name in names} | {"found": self.found.as_json() if self.found else None}


def scaled(variables: tuple[Variable, ...], factors: Mapping[str, float]) -> tuple[Variable, ...]:
    """The variables with their tolerances widened by factors, about their middles."""

    def own(variable: Variable) -> Variable:
        middle, factor = (variable.low + variable.high) / 2, factors[variable.name]
        low, high, nominal = (middle + factor * (x - middle) for x in (variable.low, variable.high, variable.nominal))
        return replace(variable, low=low, high=high, nominal=nominal)

    return tuple(own(variable) for variable in variables)


def allocated(  # noqa: PLR0917 - one argument a symbol
    variables: tuple[Variable, ...],
    points: Float[np.ndarray, "n variables"],
    margins: Float[np.ndarray, "n checks"],
    target: float,
    costs: Mapping[str, float],
    correlation: Float[np.ndarray, "v v"] | None = None,
) -> Allocation:
    """The factors of least cost, from designs that were made with the present tolerances.

    margins  negative where a check fails      target  yield [1]      costs  variable -> c_i, default 1
    Raises ParameterError where a check fails at the middle of all tolerances, where none depends on them, and for
    bounds of the factors at which the yield is still lower.
    """
    margins = margins[:, np.isfinite(margins).all(axis=0) & (np.ptp(margins, axis=0) > 0)]
    if not margins.size:
        raise ParameterError("no check depends on the tolerances", do="give a limit with --hold")
    if (margins.mean(axis=0) <= 0).any():
        given = "a check fails at the middle of the tolerances"
        raise ParameterError(given, do="change the nominal values: no tolerance cures it")
    matrix = np.eye(len(variables)) if correlation is None else correlation
    log_misses, explained = _linear_misses(variables, points, margins, matrix)
    cost = np.array([costs.get(variable.name, 1.0) for variable in variables])
    bounds, allowed = (float(np.log(LEAST)), float(np.log(GREATEST))), float(np.log1p(-target))
    starts = [u for u in np.linspace(*bounds, 200) if log_misses(np.full(len(variables), u)) <= allowed]
    if not starts:
        raise ParameterError(f"a yield of {target:.6g}", allowed="one that tolerances of 2 % of these reach")
    best = minimize(
        lambda u: float(cost @ np.exp(-u)) / cost.sum(),
        np.full(len(variables), starts[-1]),
        jac=lambda u: -cost * np.exp(-u) / cost.sum(),
        method="SLSQP",
        bounds=[bounds] * len(variables),
        constraints={"type": "ineq", "fun": lambda u: allowed - log_misses(u)},
        options={"maxiter": 300, "ftol": 1e-12},
    )
    # Where SLSQP ends outside, the best equal factors stand.
    logs = best.x if log_misses(best.x) <= allowed + INSIDE else np.full(len(variables), starts[-1])
    factors = {variable.name: float(s) for variable, s in zip(variables, np.exp(logs), strict=True)}
    reduced = float(cost @ np.exp(-logs)) / cost.sum()
    return Allocation(target, factors, float(reduced), float(-np.expm1(log_misses(logs))), explained)


def _linear_misses(
    variables: tuple[Variable, ...], points: FloatArray, margins: FloatArray, correlation: FloatArray
) -> tuple[Callable[[FloatArray], float], float]:
    """Log of the bound of the share that fails by the logs of the factors, and the least share explained."""
    offset, means = points - points.mean(axis=0), margins.mean(axis=0)
    slopes = np.linalg.lstsq(offset, margins - means, rcond=None)[0].T
    explained = 1 - np.var(margins - means - offset @ slopes.T, axis=0) / np.var(margins, axis=0)
    unit = slopes * np.array([variable.deviation for variable in variables])

    def log_misses(u: FloatArray) -> float:
        acting = unit * np.exp(u)
        sigma = np.sqrt(np.einsum("ki,ij,kj->k", acting, correlation, acting))
        return float(np.logaddexp.reduce(norm.logcdf(-means / np.maximum(sigma, 1e-300))))

    return log_misses, float(explained.min())
