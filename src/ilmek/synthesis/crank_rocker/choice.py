"""Choice from a family with one parameter: the best member within given limits, or the limits that exclude each other.

The members are given as a function from the parameter (for a crank-rocker the ratio a / b) to named quantities, to
which limits and objective refer. Members over the whole family are tabulated, and the interval about the best one is
refined repeatedly. A limit is met to about 1e-9 of its value. [search derived here, for the family of the paper]
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, FloatArray
from ilmek.errors import ParameterError
from ilmek.units import format_quantity

Table: TypeAlias = Mapping[str, FloatArray]
"""Quantity -> its values, one per member."""

Tabulate: TypeAlias = Callable[[FloatArray], Table]
"""Parameters of members -> their quantities."""

TOLERANCE = 1e-9
"""Relative violation of a limit that is allowed, by rounding, where no member meets it better."""

MEMBERS, REFINEMENTS = 32, 6
"""Members of a refinement, between the neighbours of the best one so far; number of refinements."""


@dataclass(frozen=True, slots=True)
class Limit:
    """A limit of a quantity.

    quantity  its name in the table        bound  [SI]
    sign      +1: at least, -1: at most
    name      of the limit, for messages   unit   of the bound, for messages
    """

    quantity: str
    bound: float
    sign: int
    name: str
    unit: str = "1"

    def shortage(self, table: Table) -> FloatArray:
        """Violation relative to the bound [1], one per member; 0 or less where the limit is met, inf for NaN values."""
        short = self.sign * (self.bound - table[self.quantity]) / (abs(self.bound) or 1.0)
        return np.asarray(np.nan_to_num(short, nan=np.inf))

    def kept(self, table: Table) -> BoolArray:
        """Whether each member meets the limit, except for rounding."""
        return np.asarray(self.shortage(table) <= TOLERANCE)

    @property
    def words(self) -> str:
        """The limit as text, such as `ratio_max=0.3`."""
        return f"{self.name}={format_quantity(self.bound, self.unit)}"

    def reached(self, table: Table, among: BoolArray) -> str:
        """The best value among some members, as text."""
        values = table[self.quantity][among]
        best = np.nanmax(values) if self.sign > 0 else np.nanmin(values)
        return f"{'at most' if self.sign > 0 else 'at least'} {format_quantity(float(best), self.unit)}"


@dataclass(frozen=True, slots=True)
class Objective:
    """A quantity whose greatest (sign +1) or least (-1) value is best."""

    quantity: str
    sign: int

    def cost(self, table: Table) -> FloatArray:
        """Quantity to be minimised, one value per member."""
        return -self.sign * table[self.quantity]


def choose(
    tabulate: Tabulate,
    members: FloatArray,
    objective: Objective,
    limits: Sequence[Limit] = (),
    preferred: Sequence[Limit] = (),
) -> float:
    """The parameter of the best member that meets all limits.

    tabulate   parameters -> quantities
    members    parameters [1] over the whole family, ascending, shape (members,); the result is within their range
    objective  quantity to be maximised or minimised
    limits     limits to be met
    preferred  limits that apply only if a member meets them together with all others

    Raises ParameterError where no member meets the limits. It names the smallest set of limits that exclude each other,
    and the best value of each with the others met.

    >>> square = lambda x: {"side": x, "area": x**2}
    >>> sides = np.linspace(0, 10, 101)
    >>> choose(square, sides, Objective("side", +1), [Limit("area", 50.0, -1, "area_max")]).__round__(6)
    7.071068
    """
    table = tabulate(members)
    if _all_kept([*limits, *preferred], table).any():
        limits = [*limits, *preferred]
    best = _best(objective, limits, table)
    seen, low, high = members, members[0], members[-1]
    for _ in range(REFINEMENTS):
        low, high = seen[max(best - 1, 0)], seen[min(best + 1, seen.size - 1)]
        # The best member so far is kept, so that no refinement is worse than the last.
        seen = np.unique(np.append(np.linspace(low, high, MEMBERS + 1), seen[best]))
        nearer = tabulate(seen)
        best = _best(objective, limits, nearer)
    if not _all_kept(limits, nearer)[best]:
        raise clash(table, limits)
    return float(seen[best])


def clash(table: Table, limits: Sequence[Limit]) -> ParameterError:
    """The error that names the smallest set of limits that no member meets together."""
    kept = [limit.kept(table) for limit in limits]
    groups = (some for number in range(1, len(limits)) for some in combinations(range(len(limits)), number))
    clashing = (some for some in groups if not _every([kept[index] for index in some], table).any())
    return _clash_error(table, [limits[index] for index in next(clashing, range(len(limits)))])


def _clash_error(table: Table, limits: Sequence[Limit]) -> ParameterError:
    if len(limits) == 1:
        everyone = np.ones(_length(table), dtype=bool)
        return ParameterError(
            f"no crank-rocker of the family has {limits[0].words}",
            allowed=f"it reaches {limits[0].reached(table, everyone)}",
            do="relax this limit, or change swing or crank_rotation",
        )
    reached = []
    for limit in limits:
        others = [other for other in limits if other is not limit]
        with_others = " and ".join(other.words for other in others)
        reach = limit.reached(table, _all_kept(others, table))
        reached.append(f"{limit.name} can be {reach} with {with_others}")
    given = " and ".join(limit.words for limit in limits)
    return ParameterError(f"{given} clash", allowed="; ".join(reached), do="relax one of them")


def _best(objective: Objective, limits: Sequence[Limit], table: Table) -> int:
    """Index of the best member: least violation of the limits, then best objective."""
    failure = np.zeros(_length(table))
    for limit in limits:
        failure = np.maximum(failure, limit.shortage(table))
    return int(np.lexsort((np.nan_to_num(objective.cost(table), nan=np.inf), failure))[0])


def _all_kept(limits: Iterable[Limit], table: Table) -> BoolArray:
    return _every([limit.kept(table) for limit in limits], table)


def _every(kept: Sequence[BoolArray], table: Table) -> BoolArray:
    """Members that meet all of several conditions; all members without conditions."""
    every: BoolArray = np.logical_and.reduce([np.ones(_length(table), dtype=bool), *kept])
    return every


def _length(table: Table) -> int:
    return next(iter(table.values())).size
