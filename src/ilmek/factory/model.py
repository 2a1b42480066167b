"""What is planned: carpets to weave, looms that exist, yarn in stock; and the plan.

Times are whole minutes from the midnight at which the plan begins (`calendar`); masses whole grams; money whole
ten-thousandths of the currency, so that every sum is exact.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from ilmek.factory.calendar import Calendar
from ilmek.records import record

MONEY = 10_000
"""Units of money in one unit of the currency."""

HOUR = 60
"""Minutes of an hour."""

ON_LOOM = -1
"""In the place of a job: the carpet that is on a loom before it is available."""


@dataclass(frozen=True, slots=True)
class Loom:
    """A loom that exists.

    weaving       when it weaves                       attended   when carpets are dressed and doffed, part of `weaving`
    cost          of an hour of its work               available  from when on [min]
    dressing      time to dress it for a carpet [min]; `dressing_same`: after a carpet of the same setup
    doffing       time to take a carpet off [min]
    setup         of the carpet that is on it before it is available; -1: none
    """

    name: str
    weaving: Calendar
    attended: Calendar
    cost: int
    dressing: int
    dressing_same: int
    doffing: int
    available: int = 0
    setup: int = -1

    def dressing_time(self, *, same: bool) -> int:
        """The time to dress it [min]; `same`: after a carpet of the same setup."""
        return min(self.dressing, self.dressing_same) if same else self.dressing

    def cost_of(self, minutes: int) -> int:
        """The cost of so many minutes of work, rounded half up."""
        return (2 * self.cost * minutes + HOUR) // (2 * HOUR)


@record
class CarpetJob:
    """One carpet to weave.

    order     index of its order            setup     carpets of one setup have the same width and yarns
    weaving   minutes on each loom that can weave it, by the index of the loom
    earliest  start [min]                   due       [min]
    late      cost of a started hour after the due date     fine  cost of being late at all, in a search
    yarns     grams by the index of the yarn
    """

    order: int
    setup: int
    weaving: Mapping[int, int]
    earliest: int
    due: int
    late: int
    yarns: Mapping[int, int] = field(default_factory=dict)
    fine: int = 0

    def late_cost(self, end: int) -> int:
        """The cost of its delay where it ends at an instant."""
        return self.late * late_hours(end, self.due) + self.fine * (end > self.due)


@dataclass(frozen=True, slots=True)
class StoredYarn:
    """A yarn: grams in stock, and when a purchase arrives [min]."""

    name: str
    stock: int
    arrives: int


@dataclass(frozen=True, slots=True)
class PlannedCarpet:
    """A carpet on a loom, by the indices of job and loom.

    start    of dressing      dressed  end of dressing      woven  end of weaving      end  of doffing [min]
    same     whether the carpet before has the same setup
    """

    job: int
    loom: int
    start: int
    dressed: int
    woven: int
    end: int
    same: bool = False


@dataclass(frozen=True, slots=True)
class SolveLimits:
    """When the solver ends: after so much deterministic time, the same on every machine, at the latest after so many
    seconds.
    """

    deterministic: float
    seconds: float


@dataclass(frozen=True, slots=True)
class Factory:
    """The problem: jobs, looms, yarns by index."""

    looms: tuple[Loom, ...]
    jobs: tuple[CarpetJob, ...]
    yarns: tuple[StoredYarn, ...] = ()

    @property
    def pairs(self) -> int:
        """Pairs of a job and a loom that can weave it: the size of the problem."""
        return sum(len(job.weaving) for job in self.jobs)

    def loom_cost(self, job: int, loom: int, *, same: bool) -> int:
        """The cost of a job on a loom, without its delay; `same`: after a carpet of the same setup."""
        on = self.looms[loom]
        return on.cost_of(on.dressing_time(same=same) + self.jobs[job].weaving[loom] + on.doffing)

    def same_setup(self, loom: int, before: int, job: int) -> bool:
        """Whether a job has the setup of the one before it on a loom, which may be ON_LOOM."""
        return (self.looms[loom].setup if before == ON_LOOM else self.jobs[before].setup) == self.jobs[job].setup

    def like(self, job: int) -> bool:
        """Whether there is another job of its setup, or a carpet of it on a loom."""
        setup = self.jobs[job].setup
        return any(loom.setup == setup for loom in self.looms) or any(
            index != job and other.setup == setup for index, other in enumerate(self.jobs)
        )

    def with_fine(self, fine: int) -> "Factory":
        """The factory in which each late carpet costs a fine too."""
        return replace(self, jobs=tuple(replace(job, fine=fine) for job in self.jobs))

    def with_loom(self, index: int, loom: Loom) -> "Factory":
        """The factory with another loom of that index."""
        return replace(self, looms=(*self.looms[:index], loom, *self.looms[index + 1 :]))

    def with_copy(self, index: int, name: str) -> "Factory":
        """The factory with one more loom like the one of an index, after all others."""
        new = len(self.looms)
        jobs = tuple(
            replace(job, weaving={**job.weaving, new: job.weaving[index]}) if index in job.weaving else job
            for job in self.jobs
        )
        return replace(self, looms=(*self.looms, replace(self.looms[index], name=name, setup=-1)), jobs=jobs)


@dataclass(frozen=True, slots=True)
class FactoryPlan:
    """All carpets of a factory on its looms, in the order of jobs."""

    factory: Factory
    carpets: tuple[PlannedCarpet, ...]

    @property
    def loom_costs(self) -> int:
        """The cost of all looms' work."""
        return sum(self.factory.loom_cost(carpet.job, carpet.loom, same=carpet.same) for carpet in self.carpets)

    @property
    def late_costs(self) -> int:
        """The cost of all delays."""
        return sum(self.factory.jobs[carpet.job].late_cost(carpet.end) for carpet in self.carpets)

    @property
    def cost(self) -> int:
        """The cost of looms and delays."""
        return self.loom_costs + self.late_costs

    @property
    def late(self) -> frozenset[int]:
        """Jobs that end after their due date."""
        return frozenset(carpet.job for carpet in self.carpets if carpet.end > self.factory.jobs[carpet.job].due)

    @property
    def fines(self) -> int:
        """What of the cost is for being late at all."""
        return sum(self.factory.jobs[job].fine for job in self.late)

    @property
    def end(self) -> int:
        """The end of the last carpet [min]; 0 without carpets."""
        return max((carpet.end for carpet in self.carpets), default=0)

    @property
    def merit(self) -> tuple[int, int]:
        """What is minimised: the cost, and among plans of one cost the sum of the carpets' ends."""
        return self.cost, sum(carpet.end for carpet in self.carpets)

    def on_loom(self, loom: int) -> list[PlannedCarpet]:
        """The carpets of a loom in the order of time."""
        return sorted((carpet for carpet in self.carpets if carpet.loom == loom), key=lambda one: (one.start, one.end))


def late_hours(end: int, due: int) -> int:
    """Started hours between the due date and a later end [min].

    >>> late_hours(600, 600), late_hours(601, 600), late_hours(660, 600)
    (0, 1, 1)
    """
    return -(-max(end - due, 0) // HOUR)


def carpet_on(factory: Factory, job: int, loom: int, time: int, *, same: bool = False) -> PlannedCarpet:
    """The earliest carpet on a loom that is free from an instant on [min]; release and the loom's begin are kept."""
    on, what = factory.looms[loom], factory.jobs[job]
    start = on.attended.begin(max(time, what.earliest, on.available))
    dressed = on.attended.finish(start, on.dressing_time(same=same))
    woven = on.weaving.finish(dressed, what.weaving[loom])
    return PlannedCarpet(job, loom, start, dressed, woven, on.attended.finish(woven, on.doffing), same)


def left_shifted(factory: Factory, sequences: Sequence[Sequence[int]], floors: Mapping[int, int]) -> FactoryPlan:
    """The plan in which every carpet of the looms' sequences of jobs begins as early as it can.

    sequences  jobs of each loom, in order      floors  further least starts of jobs, as by their yarn [min]
    """
    carpets: dict[int, PlannedCarpet] = {}
    for loom, sequence in enumerate(sequences):
        free, before = 0, ON_LOOM
        for job in sequence:
            same = factory.same_setup(loom, before, job)
            carpets[job] = carpet_on(factory, job, loom, max(free, floors.get(job, 0)), same=same)
            free, before = carpets[job].end, job
    return FactoryPlan(factory, tuple(carpets[job] for job in sorted(carpets)))


def sequences_of(plan: FactoryPlan) -> list[list[int]]:
    """The jobs of each loom in the order of time."""
    return [[carpet.job for carpet in plan.on_loom(loom)] for loom in range(len(plan.factory.looms))]


def in_turn(plan: FactoryPlan) -> FactoryPlan:
    """The plan in which, of jobs that are alike, the one with the lower index begins first."""
    alike: dict[object, list[PlannedCarpet]] = {}
    for one in plan.carpets:
        job = plan.factory.jobs[one.job]
        alike.setdefault(likeness(job), []).append(one)
    carpets: list[PlannedCarpet] = []
    for members in alike.values():
        numbers = sorted(member.job for member in members)
        ordered = sorted(members, key=lambda one: (one.start, one.end, one.loom))
        carpets += [replace(one, job=number) for number, one in zip(numbers, ordered, strict=True)]
    return FactoryPlan(plan.factory, tuple(sorted(carpets, key=lambda one: one.job)))


def likeness(job: CarpetJob) -> tuple[object, ...]:
    """What two jobs have in common that can be exchanged."""
    return job.order, job.setup, job.earliest, job.due, job.late, job.fine, tuple(sorted(job.weaving.items()))


def lone_cost(factory: Factory, job: int) -> int:
    """A bound of the cost of a job: on its best loom, alone, and dressed in the shorter time where there is a like one.

    No plan costs less than the sum over all jobs.
    """
    what = factory.jobs[job]
    like = factory.like(job)
    costs = (
        factory.loom_cost(job, loom, same=like) + what.late_cost(carpet_on(factory, job, loom, 0, same=like).end)
        for loom in what.weaving
    )
    return min(costs)
