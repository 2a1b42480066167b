"""Which loom weaves what when, by the solver CP-SAT of OR-tools (extra `planning`).

Minimised is the cost; then, among plans of the least cost found, the sum of the ends. The bound is that of the first,
or that of the looms' capacity (`bound`).
"""

import importlib
import time
from dataclasses import dataclass, replace
from typing import Any

from ilmek.errors import ParameterError
from ilmek.factory.bound import MOST_PAIRS, capacity_bound
from ilmek.factory.calendar import DAY, MOST_DAYS, WEEK
from ilmek.factory.model import Factory, FactoryPlan, SolveLimits, carpet_on, in_turn, left_shifted, lone_cost
from ilmek.factory.search import LEAST_SECONDS
from ilmek.factory.solver_model import FactoryModel

FIRST_SHARE = 0.75
"""Share of the time in which the cost is minimised; in the rest the ends are."""


@dataclass(frozen=True, slots=True)
class SolvedPlan:
    """A plan and a bound of the cost of every plan within the horizon [min].

    status      optimal, feasible (a better plan may exist), or none (the plan is the one given)
    repeatable  whether no clock stopped the solver: it then gives the same plan again
    fine        of a late carpet in the search; no plan that costs less than it has fewer than `least_late` late ones
    """

    plan: FactoryPlan
    bound: int
    horizon: int
    status: str
    repeatable: bool
    fine: int = 0
    least_late: int = 0


def import_solver() -> Any:
    """The module of CP-SAT. Raises ParameterError, naming the extra, where it is not installed."""
    try:
        return importlib.import_module("ortools.sat.python.cp_model")
    except ImportError:
        raise ParameterError(
            "the planner needs OR-tools, which is not installed", do="pip install 'ilmek[planning]'"
        ) from None


def horizon_of(plan: FactoryPlan) -> int:
    """A week after the latest due date, end of a given plan, or end of a carpet alone [min]: plans end before it."""
    factory = plan.factory
    lone = [carpet_on(factory, job, loom, 0).end for job, what in enumerate(factory.jobs) for loom in what.weaving]
    return min(max(plan.end, *(job.due for job in factory.jobs), *lone) + WEEK * DAY, MOST_DAYS * DAY)


def lone_costs(factory: Factory) -> int:
    """The bound of the cost of all plans in which no carpet waits for another."""
    return sum(lone_cost(factory, job) for job in range(len(factory.jobs)))


def cost_bound(factory: Factory, horizon: int) -> int:
    """The bound of the cost of all plans that end before a horizon [min], without the solver."""
    return max(lone_costs(factory), capacity_bound(factory, horizon))


def without_fine(solved: SolvedPlan, factory: Factory, fine: int) -> SolvedPlan:
    """A plan of a factory with a fine as one of it without; with the least number of late carpets.

    A plan that costs less than the fine costs less than n + 1 fines with those of its n late carpets.
    """
    plan = FactoryPlan(factory, solved.plan.carpets)
    bound = min(cost_bound(factory, solved.horizon), plan.cost)
    return replace(solved, plan=plan, bound=bound, fine=fine, least_late=min(solved.bound // fine, len(plan.late)))


def solve(
    factory: Factory, given: FactoryPlan, limits: SolveLimits, *, in_time: frozenset[int] = frozenset()
) -> SolvedPlan:
    """The best plan found from a given one, never worse than it.

    in_time  jobs that must not be late; where the solver finds no such plan, the status is "none"
    Beyond MOST_PAIRS the plan is the given one, and the bound that of each carpet by itself.
    Raises ParameterError where OR-tools is not installed.
    """
    begun, cp, given = time.monotonic(), import_solver(), in_turn(given)
    horizon = horizon_of(given)
    if factory.pairs > MOST_PAIRS:
        return SolvedPlan(given, cost_bound(factory, horizon), horizon, "feasible", repeatable=True)
    model = FactoryModel(cp, factory, horizon, in_time)
    model.hint(given)
    model.minimise_cost()
    first = model.run(_part(limits, FIRST_SHARE, FIRST_SHARE * limits.seconds - (time.monotonic() - begun)))
    floor = lone_costs(factory) if in_time else cost_bound(factory, horizon)
    if first.sequences is None:
        return SolvedPlan(given, floor, horizon, "none", first.repeatable)
    best = left_shifted(factory, first.sequences, first.floors)
    if not in_time and given.merit < best.merit:
        best = given
    bound = min(max(first.bound, floor), best.cost) if not in_time else floor
    rest = _part(limits, 1 - FIRST_SHARE, limits.seconds - (time.monotonic() - begun))
    best = in_turn(best)
    model.hint(best)
    model.minimise_ends(best.cost)
    second = model.run(rest)
    if second.sequences is not None:
        found = left_shifted(factory, second.sequences, second.floors)
        best = min(best, found, key=lambda plan: plan.merit)
    status = "optimal" if bound >= best.cost and not in_time else "feasible"
    return SolvedPlan(best, bound, horizon, status, first.repeatable and second.repeatable)


def _part(limits: SolveLimits, share: float, seconds: float) -> SolveLimits:
    """A share of the deterministic time, and the seconds that are left for it."""
    return SolveLimits(share * limits.deterministic, max(seconds, LEAST_SECONDS))
