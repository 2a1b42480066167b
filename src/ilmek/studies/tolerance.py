"""Tolerances: yield of random parts, worst case of their limits, and which tolerance contributes how much.

yield = share of the designs of which every check holds, with the 95 % interval of Clopper and Pearson
contribution of variable i = (r_i b_i) / sum_j (r_j b_j): the share of the variance that a linear fit gives to it,
b the standardised coefficients of the fit, r the correlations with the result (Pratt's measure)
"""

from itertools import product

import numpy as np
from scipy.stats import binomtest

from ilmek.arrays import Float
from ilmek.records import JsonObject, record
from ilmek.studies.variable import Variable

MOST_CORNERS = 10
"""Largest number of variables of which every corner of the limits is a design: 1,024."""


@record
class Yield:
    """Share of the designs that hold, with its 95 % interval."""

    value: float
    low: float
    high: float

    def as_json(self) -> JsonObject:
        """Plain data."""
        return {"value": self.value, "low": self.low, "high": self.high}


@record
class ResultSpread:
    """The spread of a result: mean, standard deviation, 0.135 % and 99.865 % quantiles, worst case of the corners [SI].

    contributions  variable -> its share of the variance that a linear fit explains; their sum is `explained`
    """

    result: str
    mean: float
    deviation: float
    low: float
    high: float
    worst_low: float
    worst_high: float
    contributions: dict[str, float]
    explained: float

    def as_json(self) -> JsonObject:
        """Plain data."""
        names = ("result", "mean", "deviation", "low", "high", "worst_low", "worst_high", "explained")
        return {name: getattr(self, name) for name in names} | {"contributions": self.contributions}


def yield_of(feasible: np.ndarray) -> Yield:
    """The yield of random designs.

    >>> round(yield_of(np.arange(100) < 90).low, 3)
    0.824
    """
    interval = binomtest(int(feasible.sum()), len(feasible)).proportion_ci(0.95, "exact")
    return Yield(float(feasible.mean()), float(interval.low), float(interval.high))


def corners(variables: tuple[Variable, ...]) -> Float[np.ndarray, "n variables"]:
    """All combinations of the limits of up to `MOST_CORNERS` variables; of more, each limit with the others nominal."""
    ends = [(variable.low, variable.high) for variable in variables]
    if len(variables) <= MOST_CORNERS:
        return np.array(list(product(*ends)))
    nominal = np.array([variable.nominal for variable in variables])
    points = np.repeat(nominal[None], 2 * len(variables), axis=0)
    for number, limits in enumerate(ends):
        points[2 * number : 2 * number + 2, number] = limits
    return points


def spread_of(
    result: str,
    variables: tuple[Variable, ...],
    points: Float[np.ndarray, "n variables"],
    values: Float[np.ndarray, " n"],
    at_corners: Float[np.ndarray, " m"],
) -> ResultSpread:
    """The spread of a result over random designs, and over the corners of their limits."""
    usable = np.isfinite(values)
    x, y = points[usable], values[usable]
    low, high = np.quantile(y, [0.00135, 0.99865])
    deviation = float(np.std(y))
    shares = np.zeros(len(variables))
    if deviation > 0 and len(y) > len(variables):
        scaled = (x - x.mean(axis=0)) / np.where(np.ptp(x, axis=0) > 0, x.std(axis=0), 1.0)
        standard = (y - y.mean()) / deviation
        slopes = np.linalg.lstsq(scaled, standard, rcond=None)[0]
        shares = slopes * (scaled * standard[:, None]).mean(axis=0)
    contributions = {variable.name: float(share) for variable, share in zip(variables, shares, strict=True)}
    ends = at_corners[np.isfinite(at_corners)]
    worst = (float(ends.min()), float(ends.max())) if len(ends) else (np.nan, np.nan)
    return ResultSpread(
        result, float(y.mean()), deviation, float(low), float(high), *worst, contributions, float(shares.sum())
    )
