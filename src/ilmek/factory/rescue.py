"""What would save a late order: each measure is tried on the whole factory, and proved by a plan.

A measure saves an order if there is a plan with it in which the order is in time, and so is every other order that is
in time without it.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from ilmek.factory.calendar import Calendar, joined_windows, with_free_days, with_overtime
from ilmek.factory.heuristic import improved_plan
from ilmek.factory.model import HOUR, Factory, FactoryPlan, SolveLimits, left_shifted, sequences_of
from ilmek.factory.solver import solve
from ilmek.factory.verification import plan_faults
from ilmek.factory.yarn_stock import scarce_yarns, waiting_in, waiting_times

OVERTIME = (1, 2, 4, 8)
"""Hours of overtime a day that are tried."""

MOST_SOLVED = 12
"""Largest number of carpets for which the solver is tried where the moves of single carpets find no plan."""

MOST_LOOMS_TRIED = 2
"""Number of looms of an order on which overtime is tried."""

URGENT = 1000
"""How many times the delay of a carpet that must be in time counts while its plan is searched."""

TRIES = 5_000
"""Placements of a carpet that are timed for a measure; 0.05 s."""

_LIMITS = SolveLimits(0.05, 10.0)


@dataclass(frozen=True, slots=True)
class Rescue:
    """A measure that saves an order.

    kind    put first, overtime, free days, another loom, earlier start, yarn at once or later due date
    loom    on which; -1: none      hours  a day of overtime, or by which start or due date move
    until   end of overtime and work on free days [min]
    plan    the proof: a plan with the measure; its cost leaves out what the measure itself costs
    """

    kind: str
    loom: int
    hours: int
    until: int
    plan: FactoryPlan


def rescues(plan: FactoryPlan, jobs: frozenset[int], ended: Callable[[], bool] = bool) -> tuple[Rescue, ...]:
    """The measures that save the late jobs of an order, the smallest of each kind and loom.

    ended  whether the time is over: then no more measures are tried; default: never
    Where it is enough to put the order before others, measures with a more expensive plan are left out.
    """
    factory, rescues = plan.factory, []
    until = max(factory.jobs[job].due for job in jobs)
    first = _saved(factory, plan, jobs)
    if first is not None:
        rescues.append(Rescue("put first", -1, 0, until, first))
    for attempts in _attempts(factory, plan, jobs, until):
        if ended():
            break
        if len(attempts) > 1 and _saved(attempts[-1][-1], plan, jobs) is None:
            continue  # where the largest measure does not save it, no smaller one does
        for kind, loom, hours, changed in attempts:
            made = _saved(changed, plan, jobs)
            if made is not None and (first is None or made.cost < first.cost):
                rescues.append(Rescue(kind, loom, _moved(kind, hours, plan, made, jobs), until, made))
                break
    overdue = max(carpet.end - factory.jobs[carpet.job].due for carpet in plan.carpets if carpet.job in jobs)
    hours = -(-overdue // HOUR)
    later = tuple(replace(job, due=job.due + HOUR * hours) if k in jobs else job for k, job in enumerate(factory.jobs))
    proof = FactoryPlan(replace(factory, jobs=later), plan.carpets)
    rescues.append(Rescue("later due date", -1, hours, until, proof))
    return tuple(rescues)


_Attempt = tuple[str, int, int, Factory]


def _attempts(factory: Factory, plan: FactoryPlan, jobs: frozenset[int], until: int) -> Iterator[list[_Attempt]]:
    """The measures to try, from the smallest on, for each kind and loom."""
    used = {carpet.loom for carpet in plan.carpets if carpet.job in jobs}
    able = {loom for job in jobs for loom in factory.jobs[job].weaving}
    looms = sorted(able, key=lambda loom: (loom not in used, loom))[:MOST_LOOMS_TRIED]
    for loom in looms:
        longer = ((hours, _overtime(factory, loom, HOUR * hours, until)) for hours in OVERTIME)
        yield [("overtime", loom, hours, changed) for hours, changed in longer]
    for loom in looms:
        yield [("free days", loom, 0, _on_free_days(factory, loom, until))]
    for loom in looms[:1]:
        yield [("another loom", loom, 0, factory.with_copy(loom, f"a second {factory.looms[loom].name}"))]
    if any(factory.jobs[job].earliest > 0 for job in jobs):
        free = tuple(replace(job, earliest=0) if index in jobs else job for index, job in enumerate(factory.jobs))
        yield [("earlier start", -1, 0, replace(factory, jobs=free))]
    needed = {index for index in scarce_yarns(factory) if any(factory.jobs[job].yarns.get(index, 0) for job in jobs)}
    if needed:
        stored = tuple(replace(one, arrives=0) if k in needed else one for k, one in enumerate(factory.yarns))
        yield [("yarn at once", -1, 0, replace(factory, yarns=stored))]


def _overtime(factory: Factory, loom: int, minutes: int, until: int) -> Factory:
    return _with_calendars(factory, loom, lambda own: with_overtime(own, minutes, until))


def _on_free_days(factory: Factory, loom: int, until: int) -> Factory:
    return _with_calendars(factory, loom, lambda own: with_free_days(own, until))


def _with_calendars(factory: Factory, loom: int, longer: Callable[[Calendar], Calendar]) -> Factory:
    """The factory in which both calendars of a loom are longer; attended time is weaving time too."""
    own = factory.looms[loom]
    attended = longer(own.attended)
    weaving = Calendar(joined_windows([*longer(own.weaving).windows, *attended.windows]))
    return factory.with_loom(loom, replace(own, weaving=weaving, attended=attended))


def _saved(changed: Factory, plan: FactoryPlan, jobs: frozenset[int]) -> FactoryPlan | None:
    """A plan of the changed factory in which some jobs and all that were in time are in time; None: none is found."""
    in_time = frozenset(range(len(changed.jobs))) - plan.late | jobs
    urgent = replace(
        changed,
        jobs=tuple(
            replace(job, late=URGENT * max(job.late, 1)) if index in in_time else job
            for index, job in enumerate(changed.jobs)
        ),
    )
    sequences = [*sequences_of(plan), *([] for _ in range(len(changed.looms) - len(plan.factory.looms)))]
    order = [carpet.job for carpet in sorted(plan.carpets, key=lambda one: one.start)]
    floors = waiting_times(changed, order)
    found = improved_plan(left_shifted(urgent, sequences, floors), tries=TRIES)
    made = left_shifted(changed, sequences_of(found), {**waiting_in(found), **_floors(found, floors)})
    if made.late & in_time and len(changed.jobs) <= MOST_SOLVED:
        made = solve(changed, made, _LIMITS, in_time=in_time).plan
    if made.late & in_time or plan_faults(made, made.cost):
        return None
    return made


def _floors(found: FactoryPlan, floors: dict[int, int]) -> dict[int, int]:
    return {carpet.job: floors[carpet.job] for carpet in found.carpets if carpet.job in floors}


def _moved(kind: str, hours: int, plan: FactoryPlan, proof: FactoryPlan, jobs: frozenset[int]) -> int:
    """Hours of the measure; of an earlier start those by which the order's first carpet begins before its release."""
    if kind != "earlier start":
        return hours
    earlier = max(
        plan.factory.jobs[carpet.job].earliest - carpet.start for carpet in proof.carpets if carpet.job in jobs
    )
    return max(1, -(-earlier // HOUR))
