"""A first plan: carpets are dispatched to looms by rules, and the best plan is improved by moving single carpets.

The plan is the hint of the solver, and the result where that finds nothing better in its time. Everything is counted in
evaluations, never in seconds: the same factory gives the same plan on every machine.
"""

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence

from ilmek.factory.model import ON_LOOM, Factory, FactoryPlan, carpet_on, left_shifted, lone_cost, sequences_of
from ilmek.factory.yarn_stock import waiting_times
from ilmek.progress import SILENT, Progress

MOST_TRIES = 400_000
"""Placements of a carpet that the improvement times; 4 µs each. Where one turn takes more there is none."""

MOST_PLACED = 1_000_000
"""Placements of carpets after which no further dispatching rule is tried."""

_ROUNDS = 60


def first_plan(factory: Factory, progress: Progress = SILENT) -> FactoryPlan:
    """The best plan of the dispatching rules, improved by moves of one carpet at a time."""
    tried = max(1, MOST_PLACED // max(factory.pairs, 1))
    plans = (_dispatched(factory, order) for order in itertools.islice(_orders(factory), tried))
    best = min(plans, key=lambda plan: plan.merit)
    return improved_plan(best, progress)


def _orders(factory: Factory) -> Iterator[list[int]]:
    """The jobs in several orders: by due date, by slack, by the cost of their delay, by release."""
    jobs = factory.jobs
    least = [min(job.weaving.values()) for job in jobs]
    keys: tuple[Callable[[int], tuple[float, ...]], ...] = (
        lambda j: (jobs[j].due, -jobs[j].late, j),
        lambda j: (jobs[j].due - least[j], j),
        lambda j: (-jobs[j].late / max(least[j], 1), jobs[j].due, j),
        lambda j: (jobs[j].earliest, jobs[j].due, j),
        lambda j: (jobs[j].setup, jobs[j].due, j),
        lambda j: (len(jobs[j].weaving), jobs[j].due, j),
    )
    for key in keys:
        yield sorted(range(len(jobs)), key=key)


def _dispatched(factory: Factory, order: Sequence[int]) -> FactoryPlan:
    """Each job in turn goes to the end of the loom on which it costs least, and of those ends first."""
    floors = waiting_times(factory, order)
    sequences: list[list[int]] = [[] for _ in factory.looms]
    free = [0] * len(factory.looms)
    for job in order:
        options = []
        for loom in factory.jobs[job].weaving:
            before = sequences[loom][-1] if sequences[loom] else ON_LOOM
            same = factory.same_setup(loom, before, job)
            end = carpet_on(factory, job, loom, max(free[loom], floors.get(job, 0)), same=same).end
            options.append((factory.loom_cost(job, loom, same=same) + factory.jobs[job].late_cost(end), end, loom))
        _, end, loom = min(options)
        free[loom] = end
        sequences[loom].append(job)
    return left_shifted(factory, sequences, floors)


def improved_plan(plan: FactoryPlan, progress: Progress = SILENT, *, tries: int = MOST_TRIES) -> FactoryPlan:
    """Move each carpet to the best position of all looms, while that lowers the merit and tries are left."""
    factory = plan.factory
    if factory.pairs > MOST_TRIES:
        return plan
    sequences = sequences_of(plan)
    floors = waiting_times(factory, [carpet.job for carpet in sorted(plan.carpets, key=lambda one: one.start)])
    merits = [_loom_merit(factory, loom, sequence, floors) for loom, sequence in enumerate(sequences)]
    for turn in range(_ROUNDS):
        progress(turn / _ROUNDS)
        before = _sum(merits)
        for job in _worst_first(factory, sequences, floors):
            tries -= _moved(factory, sequences, merits, floors, job)
            if tries <= 0:
                break
        if _sum(merits) >= before or tries <= 0:
            break
    found = left_shifted(factory, sequences, floors)
    return min(plan, found, key=lambda one: one.merit)


def _worst_first(factory: Factory, sequences: Sequence[Sequence[int]], floors: Mapping[int, int]) -> list[int]:
    """The jobs by what they cost beyond their bound, the most expensive first."""
    plan = left_shifted(factory, sequences, floors)
    beyond = {
        carpet.job: factory.loom_cost(carpet.job, carpet.loom, same=carpet.same)
        + factory.jobs[carpet.job].late_cost(carpet.end)
        - lone_cost(factory, carpet.job)
        for carpet in plan.carpets
    }
    return sorted(beyond, key=lambda job: (-beyond[job], job))


_Merit = tuple[int, int]


def _moved(
    factory: Factory, sequences: list[list[int]], merits: list[_Merit], floors: Mapping[int, int], job: int
) -> int:
    """Move a job to where the merit is least; returns the number of carpets that were timed."""
    source = next(loom for loom, sequence in enumerate(sequences) if job in sequence)
    index = sequences[source].index(job)
    rest = [one for one in sequences[source] if one != job]
    without = _loom_merit(factory, source, rest, floors)
    best, tries = (merits[source], source, index), len(rest)
    for loom in factory.jobs[job].weaving:
        others = rest if loom == source else sequences[loom]
        base = without if loom == source else merits[loom]
        for at in range(len(others) + 1):
            made = _loom_merit(factory, loom, [*others[:at], job, *others[at:]], floors)
            tries += len(others) + 1
            # The merit of both looms after the move, against that of the source loom before it.
            total = made if loom == source else _sum([without, made, (-base[0], -base[1])])
            if total < best[0]:
                best = total, loom, at
    _, loom, at = best
    sequences[source] = rest
    sequences[loom].insert(at, job)
    for changed in {source, loom}:
        merits[changed] = _loom_merit(factory, changed, sequences[changed], floors)
    return tries


def _loom_merit(factory: Factory, loom: int, sequence: Sequence[int], floors: Mapping[int, int]) -> _Merit:
    """Cost, and sum of the ends, of the carpets of one loom."""
    free, cost, ends = 0, 0, 0
    for before, job in itertools.pairwise((ON_LOOM, *sequence)):
        same = factory.same_setup(loom, before, job)
        free = carpet_on(factory, job, loom, max(free, floors.get(job, 0)), same=same).end
        cost += factory.loom_cost(job, loom, same=same) + factory.jobs[job].late_cost(free)
        ends += free
    return cost, ends


def _sum(merits: Sequence[_Merit]) -> _Merit:
    return sum(cost for cost, _ in merits), sum(ends for _, ends in merits)
