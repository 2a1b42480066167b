"""A plan improved by simulated annealing of the looms' sequences, before the solver has it as its hint.

A random move of one or two looms changes the energy E by dE and is kept with the probability

    min(1, exp(-dE / T)),   T = T_0 (T_1 / T_0)^(move / moves)     [Kirkpatrick, Gelatt and Vecchi, Science 220, 1983]

Moves: a run of up to four carpets goes to another position of a loom that can weave them; two carpets change places;
the rests of two sequences change looms; a carpet waits for a purchase and leaves the stock to another. Only the carpets
from the first change on are timed again. Everything is counted in moves and drawn from seeds: the same factory gives
the same plan on every machine, unless a clock ends it.
"""

import math
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from ilmek.factory.model import Factory, FactoryPlan, carpet_on, left_shifted, sequences_of
from ilmek.factory.yarn_stock import scarce_yarns, waiting_times
from ilmek.progress import SILENT, Progress

ROUNDS = 2
"""Times that the search begins again, with the best plan and the yarn in its order of starts."""

HOT, COLD = 0.3, 0.003
"""First and last temperature, as shares of the mean cost of a carpet; the last without fines."""

LONGEST_RUN = 4
"""Carpets that move together."""

END = 1e-3
"""What a minute of a carpet's end counts among plans of the same cost [ten-thousandths of the currency]."""

CHECKED = 256
"""Moves between two looks at the clock."""

NOTHING: Mapping[int, int] = {}

_KEPT = 1_000_000
"""Times of carpets that are kept."""


@dataclass(slots=True)
class _Line:
    """The sequence of a loom, when each carpet ends and the energy of all up to it; both with 0 in front."""

    jobs: list[int]
    ends: list[int] = field(default_factory=lambda: [0])
    energies: list[float] = field(default_factory=lambda: [0.0])

    @property
    def energy(self) -> float:
        return self.energies[-1]


def annealed_plan(
    plan: FactoryPlan, moves: int, progress: Progress = SILENT, *, ended: Callable[[], bool] = bool
) -> tuple[FactoryPlan, bool]:
    """The best plan found from a given one in so many moves, never worse than it; and whether no clock ended it.

    ended  whether the time is over; default: never
    """
    factory, best, whole = plan.factory, plan, True
    hot, cold = (share / max(len(plan.carpets), 1) for share in (HOT * plan.cost, COLD * (plan.cost - plan.fines)))
    floors = waiting_times(factory, [carpet.job for carpet in sorted(plan.carpets, key=lambda carpet: carpet.start)])
    for number in range(ROUNDS):
        search = _Annealing(factory, floors, sequences_of(best), random.Random(number))
        part = progress.part(number / ROUNDS, (number + 1) / ROUNDS)
        whole = search.run(moves // ROUNDS, hot / 2**number, cold, part, ended)
        floors = search.best_floors
        best = min(best, left_shifted(factory, search.best, floors), key=lambda made: made.merit)
        if not whole:
            break
    return best, whole


@dataclass(frozen=True, slots=True)
class _Change:
    """The new lines of one or two looms, and new least starts of carpets that wait for yarn, or no longer."""

    lines: Mapping[int, _Line]
    floors: Mapping[int, int] = field(default_factory=dict)


class _Annealing:
    """The state of a search: a line of each loom and the least starts by yarn, and the best of both so far."""

    def __init__(
        self, factory: Factory, floors: Mapping[int, int], sequences: Sequence[Sequence[int]], rng: random.Random
    ) -> None:
        self.factory, self.floors, self.rng = factory, dict(floors), rng
        self.timed: dict[tuple[int, int, int, bool], tuple[int, float]] = {}
        self.scarce = scarce_yarns(factory)
        self.rationed = [index for index, job in enumerate(factory.jobs) if any(map(job.yarns.get, self.scarce))]
        self.lines = [self._line(loom, _Line([]), 0, list(jobs)) for loom, jobs in enumerate(sequences)]
        self.energy = sum(line.energy for line in self.lines)
        self.best, self.best_floors, self.least = [line.jobs for line in self.lines], dict(self.floors), self.energy
        self.able = [tuple(job.weaving) for job in factory.jobs]

    def run(self, moves: int, hot: float, cold: float, progress: Progress, ended: Callable[[], bool]) -> bool:
        """So many moves while the temperature falls; False where the clock ended them."""
        rng, draws = self.rng, [self._moved, self._moved, self._moved, self._exchanged, self._crossed]
        if self.rationed:
            draws.append(self._waiting)
        for move in range(moves):
            if move % CHECKED == 0:
                progress(move / moves)
                if ended():
                    return False
            change = rng.choice(draws)()
            if change is None:
                continue
            lines = change.lines.items()
            energy = self.energy + sum(line.energy - self.lines[loom].energy for loom, line in lines)
            temperature = hot * (cold / hot) ** (move / moves)
            if energy > self.energy and rng.random() >= math.exp((self.energy - energy) / temperature):
                continue
            for loom, line in lines:
                self.lines[loom] = line
            self.floors.update(change.floors)
            self.energy = energy
            if energy < self.least - END / 2:
                self.best, self.least = [line.jobs for line in self.lines], energy
                self.best_floors = dict(self.floors)
        return True

    def _drawn(self) -> tuple[int, int]:
        """A loom and an index of a carpet on it, each carpet as likely."""
        index = self.rng.randrange(len(self.factory.jobs))
        for loom, line in enumerate(self.lines):
            if index < len(line.jobs):
                return loom, index
            index -= len(line.jobs)
        raise AssertionError("a carpet is on no loom")

    def _moved(self) -> _Change | None:
        """A run of carpets goes to another position."""
        source, first = self._drawn()
        jobs, rng = self.lines[source].jobs, self.rng
        longest = rng.randint(1, LONGEST_RUN) if rng.random() < 0.5 else 1
        last = min(first + longest, len(jobs))
        run = jobs[first:last]
        target = rng.choice(self.able[run[0]])
        if any(target not in self.factory.jobs[job].weaving for job in run):
            return None
        if target == source:
            rest = jobs[:first] + jobs[last:]
            to = rng.randint(0, len(rest))
            if to == first:
                return None
            return self._change({source: (min(first, to), [*rest[:to], *run, *rest[to:]])})
        others = self.lines[target].jobs
        to = self._beside(target, run)
        return self._change(
            {source: (first, jobs[:first] + jobs[last:]), target: (to, [*others[:to], *run, *others[to:]])}
        )

    def _beside(self, loom: int, run: Sequence[int]) -> int:
        """A position on a loom: every other time beside a carpet of the same setup, where there is one."""
        jobs, rng = self.lines[loom].jobs, self.rng
        if rng.random() < 0.5:
            setup = self.factory.jobs[run[0]].setup
            alike = [index for index, job in enumerate(jobs) if self.factory.jobs[job].setup == setup]
            if alike:
                return rng.choice(alike) + rng.randint(0, 1)
        return rng.randint(0, len(jobs))

    def _exchanged(self) -> _Change | None:
        """Two carpets change places."""
        (one, first), (other, second) = self._drawn(), self._drawn()
        job, then = self.lines[one].jobs[first], self.lines[other].jobs[second]
        if job == then or other not in self.able[job] or one not in self.able[then]:
            return None
        if one == other:
            jobs = list(self.lines[one].jobs)
            jobs[first], jobs[second] = then, job
            return self._change({one: (min(first, second), jobs)})
        jobs, others = list(self.lines[one].jobs), list(self.lines[other].jobs)
        jobs[first], others[second] = then, job
        return self._change({one: (first, jobs), other: (second, others)})

    def _crossed(self) -> _Change | None:
        """The rests of two looms' sequences change looms."""
        if len(self.lines) < 2:
            return None
        one, other = self.rng.sample(range(len(self.lines)), 2)
        jobs, others = self.lines[one].jobs, self.lines[other].jobs
        first, second = self.rng.randint(0, len(jobs)), self.rng.randint(0, len(others))
        rest, tail = jobs[first:], others[second:]
        if any(other not in self.able[job] for job in rest) or any(one not in self.able[job] for job in tail):
            return None
        return self._change({one: (first, jobs[:first] + tail), other: (second, others[:second] + rest)})

    def _waiting(self) -> _Change | None:
        """A carpet waits for a purchase of its yarn, or no longer; then another may have to leave it the stock."""
        floors = self._rationed_otherwise(self.floors, self.rng.choice(self.rationed))
        if not self._stocked(floors):
            floors = self._rationed_otherwise(floors, self.rng.choice(self.rationed))
            if not self._stocked(floors):
                return None
        changed = {job: floor for job, floor in floors.items() if floor != self.floors.get(job, 0)}
        first: dict[int, tuple[int, list[int]]] = {}
        for loom, line in enumerate(self.lines):
            indices = [index for index, job in enumerate(line.jobs) if job in changed]
            if indices:
                first[loom] = indices[0], line.jobs
        return self._change(first, changed) if changed else None

    def _rationed_otherwise(self, floors: Mapping[int, int], job: int) -> dict[int, int]:
        """The least starts with another of a carpet: at once, or when a purchase of a yarn of it has arrived."""
        used, yarns = self.factory.jobs[job].yarns, self.factory.yarns
        arrivals = {0, *(yarns[index].arrives for index in self.scarce if used.get(index, 0))}
        others = sorted(arrivals - {floors.get(job, 0)})
        return {**floors, job: self.rng.choice(others)}

    def _stocked(self, floors: Mapping[int, int]) -> bool:
        """Whether the stock is enough for the carpets that do not wait."""
        return all(
            sum(job.yarns.get(index, 0) for k, job in enumerate(self.factory.jobs) if floors.get(k, 0) < yarn.arrives)
            <= yarn.stock
            for index, yarn in ((index, self.factory.yarns[index]) for index in self.scarce)
        )

    def _change(self, sequences: Mapping[int, tuple[int, list[int]]], floors: Mapping[int, int] = NOTHING) -> _Change:
        """The change of some looms' sequences, from an index on, and of least starts."""
        lines = {
            loom: self._line(loom, self.lines[loom], index, jobs, floors) for loom, (index, jobs) in sequences.items()
        }
        return _Change(lines, floors)

    def _line(
        self, loom: int, before: _Line, index: int, jobs: list[int], floors: Mapping[int, int] = NOTHING
    ) -> _Line:
        """The line of a sequence that is that of `before` up to an index; floors: least starts that are new."""
        ends, energies = before.ends[: index + 1], before.energies[: index + 1]
        free, energy, timed, what = ends[-1], energies[-1], self.timed, self.factory.jobs
        setup = what[jobs[index - 1]].setup if index else self.factory.looms[loom].setup
        for job in jobs[index:]:
            same = what[job].setup == setup
            least = floors.get(job)
            free = max(free, self.floors.get(job, 0) if least is None else least)
            key = loom, job, free, same
            carpet = timed.get(key)
            if carpet is None:
                carpet = self._timed(loom, job, free, same=same)
                if len(timed) < _KEPT:
                    timed[key] = carpet
            free, cost = carpet
            energy += cost
            ends.append(free)
            energies.append(energy)
            setup = what[job].setup
        return _Line(jobs, ends, energies)

    def _timed(self, loom: int, job: int, free: int, *, same: bool) -> tuple[int, float]:
        """The end of a carpet on a loom that is free from an instant on, and its energy."""
        end = carpet_on(self.factory, job, loom, free, same=same).end
        cost = self.factory.loom_cost(job, loom, same=same) + self.factory.jobs[job].late_cost(end)
        return end, cost + END * end
