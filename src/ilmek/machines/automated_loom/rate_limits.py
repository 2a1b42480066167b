"""How far each rate of the cost can move before another loom is cheaper than the chosen one.

Of a rate alone the cost of a carpet on a loom is a + b f(rate), with the same f, which ascends or descends, for all
looms: annuity of life or interest, 1 / hours, the rate itself. So two looms cost the same at one value at most, and
whatever is cheaper at a bound of a rate decides how far the rate can move towards it: the nearest value is found by
halving. The looms are those that the search designed, and the chosen one with a head less and a head more; parts,
time and floor are theirs.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.params import Parameter, declared

_HALVINGS = 40
_LEAST = 1e-3
"""Of a rate that must be above 0: share of its value to which it is moved."""


Limit: TypeAlias = tuple[float, int]
"""A value of a rate from which on another loom is cheaper, and the number of that loom."""


@dataclass(frozen=True, slots=True)
class RateLimits:
    """How far a rate can move from its value, down and up; None: to its bound."""

    rate: Parameter
    now: float
    below: Limit | None
    above: Limit | None


def rate_limits(chosen: CarpetCost, others: Sequence[CarpetCost]) -> tuple[RateLimits, ...]:
    """The nearest values of the rates from which on one of other looms costs less than the chosen one.

    None of them is cheaper at the rates as they are. Rates that cannot change the choice are left out, and the
    availability where it follows from the stops and failures of each loom.
    """
    rates = (rate for rate in declared(CostRates) if rate.name != "availability" or chosen.rates.availability)
    every = (_limits(chosen, others, rate) for rate in rates)
    return tuple(limits for limits in every if limits.below or limits.above)


def _limits(chosen: CarpetCost, others: Sequence[CarpetCost], rate: Parameter) -> RateLimits:
    given = getattr(chosen.rates, rate.name)
    now = float(getattr(chosen, rate.name) if given is None else given)  # what is not given follows from the loom
    least = _LEAST * now if rate.at_least is None else rate.at_least
    most = now if rate.at_most is None else rate.at_most
    below, above = (_nearest(chosen, others, rate.name, now, end) for end in (least, most))
    return RateLimits(rate, now, below, above)


def _nearest(chosen: CarpetCost, others: Sequence[CarpetCost], name: str, now: float, end: float) -> Limit | None:
    """The limit between the value of a rate and a bound of it."""
    cheaper = _cheaper(chosen, others, name, end)
    if cheaper is None:
        return None
    inside, outside = now, end
    for _ in range(_HALVINGS):
        middle = (inside + outside) / 2
        other = _cheaper(chosen, others, name, middle)
        if other is None:
            inside = middle
        else:
            outside, cheaper = middle, other
    return outside, cheaper


def _cheaper(chosen: CarpetCost, others: Sequence[CarpetCost], name: str, value: float) -> int | None:
    """The number of the loom that costs least where a rate has another value; None where it is the chosen one."""
    rates = replace(chosen.rates, **{name: value})
    costs = [float(replace(cost, rates=rates).cost_per_carpet) for cost in (chosen, *others)]
    least = min(range(len(costs)), key=lambda number: costs[number])
    return least - 1 if least else None
