"""A plan of 3,000 carpets on 1,000 looms: seconds, memory, cost and bound, beside the dispatching rules alone.

Limits: 10 minutes, 2 GB.
"""

import resource
import time

from benchmarks.bench_plan import random_factory
from ilmek.factory.annealing import annealed_plan
from ilmek.factory.heuristic import first_plan
from ilmek.factory.model import MONEY, SolveLimits
from ilmek.factory.solver import solve
from ilmek.factory.verification import plan_faults
from ilmek.jobs.plan import MOVES

SECONDS = 300
"""Time limit whose moves the annealing has."""


def run() -> None:
    """Print each step with the time until then and the largest memory."""
    begun = time.perf_counter()

    def say(what: str) -> None:
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        print(f"{time.perf_counter() - begun:6.0f} s {memory:5.2f} GB  {what}", flush=True)

    factory = random_factory(3000, 1000, 4.0)
    say(f"{factory.pairs:,} pairs of a carpet and a loom")
    first = first_plan(factory)
    say(f"rules {first.cost / MONEY:,.0f}, {len(first.late)} late")
    plan, _ = annealed_plan(first, MOVES * SECONDS)
    say(f"annealed {plan.cost / MONEY:,.0f}, {len(plan.late)} late")
    solved = solve(factory, plan, SolveLimits(1.0, 1.0))
    assert plan_faults(solved.plan, solved.plan.cost) == ()
    say(f"bound {solved.bound / MONEY:,.0f}, gap {1 - solved.bound / solved.plan.cost:.1%}")
