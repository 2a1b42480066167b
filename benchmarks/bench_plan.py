"""Plans of 10 and 100 orders: seconds, cost, bound and gap, beside the plan that the dispatching rules give alone.

Limits: 10 orders in 10 s, 100 orders in 60 s. Due dates are easy (every order can be in time), tight or too tight.
"""

import random
import time

from ilmek.factory.calendar import Shift, calendar
from ilmek.factory.heuristic import first_plan
from ilmek.factory.model import MONEY, CarpetJob, Factory, Loom, SolveLimits, StoredYarn
from ilmek.factory.solver import solve
from ilmek.factory.verification import plan_faults
from ilmek.jobs.plan import PACE, default_limit

SIZES = ((10, 3), (100, 8))
"""Orders and looms."""

DUE = {"easy": 2.0, "tight": 1.1, "too tight": 0.6}
"""Latest due date, as a multiple of the time in which the looms can do all the work."""


def random_factory(orders: int, looms: int, due: float, seed: int = 1) -> Factory:
    """Carpets of 10 to 60 h, ten setups, looms of one attended shift, every other one with a second that is not."""
    rng = random.Random(seed)
    day = Shift("day", frozenset(range(5)), 6 * 60, 14 * 60, ((600, 620),))
    late = Shift("late", frozenset(range(5)), 14 * 60, 22 * 60, attended=False)
    shifts = ([day, late], [day])
    weaving, attended = ([calendar(own, 0, frozenset(), attended=only) for own in shifts] for only in (False, True))
    made = tuple(
        Loom(
            f"L{k}",
            weaving[k % 2],
            attended[k % 2],
            rng.randint(8, 16) * MONEY,
            dressing=600,
            dressing_same=180,
            doffing=90,
        )
        for k in range(looms)
    )
    works = [rng.randint(600, 3600) for _ in range(orders)]
    capacity = sum(loom.weaving.work(70 * 1440) for loom in made) / 70
    days = due * sum(work + 690 for work in works) / capacity
    jobs = []
    for index, work in enumerate(works):
        able = {k: round(work * rng.uniform(0.8, 1.4)) for k in range(looms) if rng.random() < 0.7} or {0: work}
        at = int(rng.uniform(0.15, 1.0) * (days + 5)) * 1440 + 960
        early = rng.choice((0, 0, 0, 3 * 1440))
        grams = {rng.randrange(6): rng.randint(500, 3000) for _ in range(3)}
        jobs.append(CarpetJob(index, rng.randrange(10), able, early, at, rng.randint(1, 5) * MONEY, grams))
    total = [sum(job.yarns.get(k, 0) for job in jobs) for k in range(6)]
    yarns = tuple(StoredYarn(f"yarn {k}", grams // 3, rng.choice((0, 5, 10)) * 1440) for k, grams in enumerate(total))
    return Factory(made, tuple(jobs), yarns)


def run() -> None:
    """Print a line for each size and kind of due dates."""
    headings = ("orders", "looms", "due dates", "rules", "plan", "bound", "gap", "late", "s")
    print("{:>6} {:>5} {:>10} {:>9} {:>9} {:>9} {:>6} {:>4} {:>6}".format(*headings))
    for orders, looms in SIZES:
        for name, due in DUE.items():
            factory = random_factory(orders, looms, due)
            limit, begun = default_limit(orders), time.perf_counter()
            first = first_plan(factory)
            left = limit - (time.perf_counter() - begun)
            solved = solve(factory, first, SolveLimits(PACE * limit, left))
            seconds = time.perf_counter() - begun
            cost, bound = solved.plan.cost, solved.bound
            assert plan_faults(solved.plan, cost) == ()
            figures = (first.cost / MONEY, cost / MONEY, bound / MONEY, 1 - bound / cost)
            shown = "{:9,.0f} {:9,.0f} {:9,.0f} {:6.1%}".format(*figures)
            note = "" if solved.repeatable else "  ended by the clock"
            print(f"{orders:6} {looms:5} {name:>10} {shown} {len(solved.plan.late):4} {seconds:6.1f}{note}", flush=True)
