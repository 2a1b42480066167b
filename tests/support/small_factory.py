"""Small factories for tests, and every plan of the smallest."""

import itertools
import random
from collections.abc import Iterator

from ilmek.factory.calendar import Calendar, Shift, calendar
from ilmek.factory.model import MONEY, CarpetJob, Factory, FactoryPlan, Loom, StoredYarn, left_shifted

DAY_SHIFT = Shift("day", frozenset(range(5)), 6 * 60, 14 * 60, ((600, 630),))
LATE_SHIFT = Shift("late", frozenset(range(4)), 14 * 60, 22 * 60, (), attended=False)


def calendars(*shifts: Shift, weekday: int = 0) -> tuple[Calendar, Calendar]:
    """The weaving and the attended calendar of shifts."""
    none: frozenset[int] = frozenset()
    return calendar(shifts, weekday, none), calendar(shifts, weekday, none, attended=True)


def small_factory(jobs: int, looms: int, *, seed: int, tight: float = 0.5, same: bool = True) -> Factory:
    """A factory of a seed: looms of two shifts, one attended, and of one shift, some with a
    carpet on them; setups, releases, scarce yarn.

    tight  days between due dates in proportion to the work
    """
    rng, on = random.Random(seed), random.Random(-seed - 1)
    own = calendars(DAY_SHIFT, LATE_SHIFT), calendars(DAY_SHIFT)
    made = tuple(
        Loom(
            f"L{index}",
            *own[index % 2],
            cost=rng.randint(8, 16) * MONEY,
            dressing=480,
            dressing_same=120 if same else 480,
            doffing=rng.choice((0, 60)),
            available=rng.choice((0, 1440)),
            setup=on.choice((-1, 0, 1)) if same else -1,
        )
        for index in range(looms)
    )
    found = []
    for index in range(jobs):
        work = rng.randint(300, 2400)
        able = {loom: int(work * rng.uniform(0.8, 1.5)) for loom in range(looms) if rng.random() < 0.8} or {0: work}
        due = int(rng.uniform(2, 3 + 4 * tight * jobs / looms)) * 1440 + 960
        late, early = rng.randint(1, 6) * MONEY, rng.choice((0, 0, 3 * 1440))
        found.append(
            CarpetJob(index, rng.randint(0, 1 + jobs // 4), able, early, due, late, {0: rng.randint(500, 3000)})
        )
    stock = sum(job.yarns[0] for job in found) // 2
    return Factory(made, tuple(found), (StoredYarn("ivory", stock, 4 * 1440),))


def every_plan(factory: Factory) -> Iterator[FactoryPlan]:
    """Every plan of a small factory: assignments, sequences, and which carpets wait for the yarn."""
    jobs = range(len(factory.jobs))
    for assigned in itertools.product(*(factory.jobs[job].weaving for job in jobs)):
        members = [[job for job in jobs if assigned[job] == loom] for loom in range(len(factory.looms))]
        for sequences in itertools.product(*(itertools.permutations(one) for one in members)):
            for waiting in itertools.product((False, True), repeat=len(factory.jobs)):
                floors = {job: yarn.arrives for yarn in factory.yarns for job in jobs if waiting[job]}
                plan = left_shifted(factory, [list(one) for one in sequences], floors)
                if all(_enough(plan, index) for index in range(len(factory.yarns))):
                    yield plan


def _enough(plan: FactoryPlan, index: int) -> bool:
    yarn, jobs = plan.factory.yarns[index], plan.factory.jobs
    if sum(job.yarns.get(index, 0) for job in jobs) <= yarn.stock:
        return True
    return sum(jobs[one.job].yarns.get(index, 0) for one in plan.carpets if one.start < yarn.arrives) <= yarn.stock
