"""Choice from a family of one parameter: the best member within any mix of limits, or which limits clash.

The members are handed in as a function from the parameter, for a crank-rocker the ratio a / b, to whatever quantities
limits and objective name; what those are, this module need not know. Members over the whole family are tabulated, and
the best place is then looked at ever more closely: a limit is met to about 1e-9 of itself, from inside.
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
"""Quantity -> its values, one a member."""

Tabulate: TypeAlias = Callable[[FloatArray], Table]
"""Parameters of members -> their quantities."""

TOLERANCE = 1e-9
"""Part of a limit by which it may be overstepped where no member keeps it better: by rounding."""

NEARER, ROUNDS = 32, 6
"""Members of a closer look, between the neighbours of the best so far; closer looks."""


@dataclass(frozen=True, slots=True)
class Limit:
    """A quantity that must be at least (sign +1) or at most (-1) a bound [SI]; name and unit as its giver says them."""

    quantity: str
    bound: float
    sign: int
    name: str
    unit: str = "1"

    def shortage(self, table: Table) -> FloatArray:
        """By which part of the bound each member fails it; 0 or less where it holds, infinite where it has no value."""
        short = self.sign * (self.bound - table[self.quantity]) / (abs(self.bound) or 1.0)
        return np.nan_to_num(short, nan=np.inf)

    def kept(self, table: Table) -> BoolArray:
        """Whether each member keeps it, but for rounding."""
        return np.asarray(self.shortage(table) <= TOLERANCE)

    @property
    def words(self) -> str:
        """`ratio_max=0.3`."""
        return f"{self.name}={format_quantity(self.bound, self.unit)}"

    def reached(self, table: Table, among: BoolArray) -> str:
        """The best that some members reach, in words."""
        values = table[self.quantity][among]
        best = np.nanmax(values) if self.sign > 0 else np.nanmin(values)
        return f"{'at most' if self.sign > 0 else 'at least'} {format_quantity(float(best), self.unit)}"


@dataclass(frozen=True, slots=True)
class Objective:
    """A quantity whose greatest (sign +1) or least (-1) value is best."""

    quantity: str
    sign: int

    def cost(self, table: Table) -> FloatArray:
        """What is to be small."""
        return -self.sign * table[self.quantity]


def choose(
    tabulate: Tabulate,
    members: FloatArray,
    objective: Objective,
    limits: Sequence[Limit] = (),
    preferred: Sequence[Limit] = (),
) -> float:
    """The parameter of the best member that keeps every limit.

    members    parameters over the whole family, ascending; its ends are not left
    preferred  limits that hold only where some member keeps them as well as all others

    Raises ParameterError where no member keeps the limits, which names the fewest that clash and what each leaves of
    the others; two wherever two do.

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
    for _ in range(ROUNDS):
        low, high = seen[max(best - 1, 0)], seen[min(best + 1, seen.size - 1)]
        # The best so far stays among them, so that no look is worse than the last.
        seen = np.unique(np.append(np.linspace(low, high, NEARER + 1), seen[best]))
        nearer = tabulate(seen)
        best = _best(objective, limits, nearer)
    if not _all_kept(limits, nearer)[best]:
        raise clash(table, limits)
    return float(seen[best])


def clash(table: Table, limits: Sequence[Limit]) -> ParameterError:
    """The fewest limits that no member keeps together, in words: one that none reaches, else two, else more."""
    kept = [limit.kept(table) for limit in limits]
    groups = (some for number in range(1, len(limits)) for some in combinations(range(len(limits)), number))
    clashing = (some for some in groups if not _every([kept[place] for place in some], table).any())
    return _words(table, [limits[place] for place in next(clashing, range(len(limits)))])


def _words(table: Table, limits: Sequence[Limit]) -> ParameterError:
    if len(limits) == 1:
        everyone = np.ones(_length(table), dtype=bool)
        return ParameterError(
            f"no crank-rocker of the family has {limits[0].words}",
            allowed=f"it reaches {limits[0].reached(table, everyone)}",
            do="ease that limit, or change swing or crank_rotation",
        )
    reached = []
    for limit in limits:
        others = [other for other in limits if other is not limit]
        with_others = " and ".join(other.words for other in others)
        reach = limit.reached(table, _all_kept(others, table))
        reached.append(f"{limit.name} can be {reach} with {with_others}")
    said = " and ".join(limit.words for limit in limits)
    return ParameterError(f"{said} clash", allowed="; ".join(reached), do="ease one of them")


def _best(objective: Objective, limits: Sequence[Limit], table: Table) -> int:
    """Place of the best member: the one that fails the limits least, and of those that keep them the objective's."""
    failure = np.zeros(_length(table))
    for limit in limits:
        failure = np.maximum(failure, limit.shortage(table))
    return int(np.lexsort((np.nan_to_num(objective.cost(table), nan=np.inf), failure))[0])


def _all_kept(limits: Iterable[Limit], table: Table) -> BoolArray:
    return _every([limit.kept(table) for limit in limits], table)


def _every(kept: Sequence[BoolArray], table: Table) -> BoolArray:
    """Members that are in every set; all of them where there is none."""
    every: BoolArray = np.logical_and.reduce([np.ones(_length(table), dtype=bool), *kept])
    return every


def _length(table: Table) -> int:
    return next(iter(table.values())).size
