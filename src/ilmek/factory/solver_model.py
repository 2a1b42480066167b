"""The model of a factory for CP-SAT: variables, constraints, objectives, hints.

Each carpet has a start s and an end e on the attended axis of its loom (`axes`), and both on the axis of weaving, on
which the carpets of a loom do not overlap:

    d = s + dressing,   w = weaving(d) + weaving time,   e = attended(w) + doffing

The maps between the axes are sums of gaps with a Boolean each, exact at every optimum: a carpet that is later than it
must be never costs less.
"""

import itertools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ilmek.factory.axes import WorkAxes, gaps_after, time_before, work_axes
from ilmek.factory.model import (
    HOUR,
    ON_LOOM,
    Factory,
    FactoryPlan,
    PlannedCarpet,
    SolveLimits,
    carpet_on,
    late_hours,
    likeness,
    sequences_of,
)
from ilmek.factory.search import searched
from ilmek.factory.yarn_stock import scarce_yarns, waiting_in
from ilmek.records import record

if TYPE_CHECKING:
    from ortools.sat.python.cp_model import CpSolver, IntVar


@record
class SolverRun:
    """What a run of the solver gives: the jobs of each loom in order, their floors, the bound; None without a plan."""

    sequences: list[list[int]] | None
    floors: Mapping[int, int]
    bound: int
    repeatable: bool


@dataclass(slots=True)
class _Timed:
    """Variables of a job on looms of common axes: start and end on both axes, and whether it is there."""

    present: "IntVar"
    start: "IntVar"
    dressed: "IntVar"
    woven: "IntVar"
    met: "IntVar"
    end: "IntVar"
    woven_start: "IntVar"
    woven_end: "IntVar"


@dataclass(frozen=True, slots=True)
class _Switch:
    """A Boolean that is true where a value of a job on some axes is above a bound; `name`: which value."""

    variable: "IntVar"
    job: int
    group: int
    name: str
    bound: int


class FactoryModel:
    """The model of a factory for the solver; variables are created once, the objective is exchanged."""

    def __init__(self, cp: Any, factory: Factory, horizon: int, in_time: frozenset[int]) -> None:
        self.cp, self.factory, self.horizon, self.in_time = cp, factory, horizon, in_time
        self.model = cp.CpModel()
        self.axes = work_axes(factory.looms, horizon)
        self.on: dict[tuple[int, int], IntVar] = {}
        self.timed: dict[tuple[int, int], _Timed] = {}
        self.follows: dict[tuple[int, int, int], IntVar] = {}
        self.late: list[tuple[int, IntVar, int, int]] = []  # job, variable, its cost, its most
        self.switches: list[_Switch] = []
        self.sizes: list[tuple[IntVar, int, int, int, int]] = []
        self.early: list[tuple[IntVar, int, int]] = []
        for job, what in enumerate(factory.jobs):
            for loom in what.weaving:
                self.on[job, loom] = self.model.new_bool_var(f"on {job} {loom}")
            self.model.add_exactly_one(self.on[job, loom] for loom in what.weaving)
        for group, axes in enumerate(self.axes):
            for loom in axes.looms:
                self._followers(loom)
            for job, what in enumerate(factory.jobs):
                if any(loom in what.weaving for loom in axes.looms):
                    self.timed[job, group] = self._timed(job, group, axes)
            for loom in axes.looms:
                self._one_at_a_time(group, loom)
        for job in range(len(factory.jobs)):
            self._lateness(job)
        self._stock()
        self._alike()

    def _followers(self, loom: int) -> None:
        """A Boolean for each pair of jobs of one setup: the second follows the first on a loom that gains by it."""
        on, jobs = self.factory.looms[loom], self.factory.jobs
        if on.dressing_time(same=True) == on.dressing:
            return
        groups: dict[int, list[int]] = {}
        for job, what in enumerate(jobs):
            if loom in what.weaving:
                groups.setdefault(what.setup, []).append(job)
        for setup, members in groups.items():
            before = (*members, *((ON_LOOM,) if setup == on.setup else ()))
            for first in before:
                pairs = {then: self.model.new_bool_var("") for then in members if then != first}
                for then, follows in pairs.items():
                    self.follows[first, then, loom] = follows
                    if first != ON_LOOM:
                        self.model.add_implication(follows, self.on[first, loom])
                    self.model.add_implication(follows, self.on[then, loom])
                self.model.add_at_most_one(pairs.values())
            for then in members:
                self.model.add_at_most_one(self.follows[first, then, loom] for first in before if first != then)

    def _dressing(self, job: int, axes: WorkAxes) -> Any:
        """The dressing time of a job as a linear expression."""
        looms = [loom for loom in axes.looms if loom in self.factory.jobs[job].weaving]
        full = sum(self.factory.looms[loom].dressing * self.on[job, loom] for loom in looms)
        return full - sum(
            (self.factory.looms[loom].dressing - self.factory.looms[loom].dressing_same) * follows
            for (_, then, loom), follows in self.follows.items()
            if then == job and loom in axes.looms
        )

    def _timed(self, job: int, group: int, axes: WorkAxes) -> _Timed:
        """The variables of a job on one pair of axes, and the relations between them."""
        model, what = self.model, self.factory.jobs[job]
        looms = [loom for loom in axes.looms if loom in what.weaving]
        present = model.new_bool_var(f"present {job} {group}")
        model.add(sum(self.on[job, loom] for loom in looms) == present)
        least = axes.attended.work(what.earliest)
        start = model.new_int_var(least, axes.attended_total, f"start {job} {group}")
        for loom in looms:
            available = axes.attended.work(self.factory.looms[loom].available)
            if available > least:
                model.add(start >= available).only_enforce_if(self.on[job, loom])
        dressed = model.new_int_var(least, axes.attended_total, "")
        model.add(dressed == start + self._dressing(job, axes))
        woven_start = model.new_int_var(0, axes.weaving_total, "")
        model.add(woven_start == self._begin_on_weaving(start, job, group))
        weaving = sum(what.weaving[loom] * self.on[job, loom] for loom in looms)
        woven = model.new_int_var(0, axes.weaving_total, "")
        model.add(woven == self._end_on_weaving(dressed, job, group, "dressed") + weaving)
        met = self._on_attended(woven, job, group)
        end = model.new_int_var(least, axes.attended_total, f"end {job} {group}")
        model.add(end == met + sum(self.factory.looms[loom].doffing * self.on[job, loom] for loom in looms))
        woven_end = model.new_int_var(0, axes.weaving_total, "")
        # Without doffing a carpet may end while nobody is there.
        after_doffing = self._end_on_weaving(end, job, group, "end")
        if all(self.factory.looms[loom].doffing > 0 for loom in looms):
            model.add(woven_end == after_doffing)
        else:
            model.add(woven_end >= woven)
            for loom in looms:
                if self.factory.looms[loom].doffing > 0:
                    model.add(woven_end >= after_doffing).only_enforce_if(self.on[job, loom])
        return _Timed(present, start, dressed, woven, met, end, woven_start, woven_end)

    def _switch(self, job: int, group: int, name: str, bound: int) -> Any:
        """A Boolean of the value of a job, with what it is at a plan."""
        variable = self.model.new_bool_var("")
        self.switches.append(_Switch(variable, job, group, name, bound))
        return variable

    def _end_on_weaving(self, at: "IntVar", job: int, group: int, name: str) -> Any:
        """The weaving time of an end on the attended axis: every gap before it is added."""
        axes = self.axes[group]
        total = at + axes.offset
        for start, gap in zip(axes.starts, axes.gaps, strict=True):
            passed = self._switch(job, group, name, start)
            self.model.add(at <= start).only_enforce_if(~passed)
            total += gap * passed
        return total

    def _begin_on_weaving(self, at: "IntVar", job: int, group: int) -> Any:
        """The weaving time of a begin on the attended axis: a gap is added only where it is before it."""
        axes = self.axes[group]
        total = at + axes.offset
        for start, gap in zip(axes.starts, axes.gaps, strict=True):
            passed = self._switch(job, group, "start", start - 1)
            self.model.add(at >= start).only_enforce_if(passed)
            total += gap * passed
        return total

    def _on_attended(self, woven: "IntVar", job: int, group: int) -> Any:
        """The attended time of an instant on the axis of weaving, or later."""
        axes = self.axes[group]
        found = self.model.new_int_var(0, axes.attended_total, "")
        less = woven - axes.offset
        for start, gap, end in zip(axes.starts, axes.gaps, axes.ends, strict=True):
            passed = self._switch(job, group, "woven", end)
            self.model.add(woven <= end).only_enforce_if(~passed)
            self.model.add(found >= start).only_enforce_if(passed)
            less -= gap * passed
        self.model.add(found >= less)
        return found

    def _one_at_a_time(self, group: int, loom: int) -> None:
        """The carpets of a loom do not overlap, and between two of one setup that follow each other there is none."""
        model, intervals = self.model, []
        for (job, of), timed in self.timed.items():
            if of == group and (job, loom) in self.on:
                size = model.new_int_var(0, self.axes[group].weaving_total, "")
                interval = model.new_optional_interval_var(
                    timed.woven_start, size, timed.woven_end, self.on[job, loom], f"job {job} loom {loom}"
                )
                intervals.append(interval)
                self.sizes.append((size, job, job, group, loom))
        for (first, then, at), follows in self.follows.items():
            if at == loom:
                gap = model.new_int_var(0, self.axes[group].weaving_total, "")
                free = self.axes[group].weaving.work(self.factory.looms[loom].available)
                begin = free if first == ON_LOOM else self.timed[first, group].woven_end
                end = self.timed[then, group].woven_start
                intervals.append(model.new_optional_interval_var(begin, gap, end, follows, ""))
                self.sizes.append((gap, first, then, group, loom))
        model.add_no_overlap(intervals)

    def _lateness(self, job: int) -> None:
        """Started hours of delay of a job, by the windows of attended time after the due date."""
        what, model = self.factory.jobs[job], self.model
        if job in self.in_time:
            for group, axes in enumerate(self.axes):
                if (job, group) in self.timed:
                    self._in_time(job, group, axes)
            return
        most = late_hours(self.horizon, what.due)
        hours = model.new_int_var(0, most, f"late {job}")
        self.late.append((job, hours, what.late, most))
        if what.fine:
            fined = model.new_bool_var("")
            self.late.append((job, fined, what.fine, 1))
            model.add(hours <= most * fined)
        for group, axes in enumerate(self.axes):
            if (job, group) not in self.timed:
                continue
            for end, calendar, literals in self._ends(job, group, axes):
                time = end + time_before(calendar, what.due)
                name = "end" if calendar is axes.attended else "woven_end"
                for start, gap in gaps_after(calendar, what.due, self.horizon):
                    passed = self._switch(job, group, name, start)
                    model.add(end <= start).only_enforce_if(~passed)
                    time += gap * passed
                model.add(HOUR * hours >= time - what.due).only_enforce_if(literals)

    def _ends(self, job: int, group: int, axes: WorkAxes) -> list[tuple[Any, Any, list[Any]]]:
        """The end of a job by the calendar that it is counted in: of weaving, where nobody doffs it."""
        timed, ends = self.timed[job, group], []
        looms = [loom for loom in axes.looms if (job, loom) in self.on]
        doffed = [loom for loom in looms if self.factory.looms[loom].doffing > 0]
        if len(doffed) == len(looms):
            return [(timed.end, axes.attended, [timed.present])]
        for loom in looms:
            if loom in doffed:
                ends.append((timed.end, axes.attended, [self.on[job, loom]]))
            else:
                ends.append((timed.woven_end, axes.weaving, [self.on[job, loom]]))
        return ends

    def _in_time(self, job: int, group: int, axes: WorkAxes) -> None:
        for end, calendar, literals in self._ends(job, group, axes):
            self.model.add(end <= calendar.work(self.factory.jobs[job].due)).only_enforce_if(literals)

    def _stock(self) -> None:
        """Carpets that start before a purchase arrives are woven from the stock."""
        for index in scarce_yarns(self.factory):
            yarn, terms = self.factory.yarns[index], []
            for job, what in enumerate(self.factory.jobs):
                if not what.yarns.get(index, 0):
                    continue
                early = self.model.new_bool_var("")
                self.early.append((early, job, yarn.arrives))
                terms.append(what.yarns[index] * early)
                for group, axes in enumerate(self.axes):
                    if (timed := self.timed.get((job, group))) is not None:
                        waits = timed.start >= axes.attended.work(yarn.arrives)
                        self.model.add(waits).only_enforce_if([~early, timed.present])
            self.model.add(sum(terms) <= yarn.stock)

    def _alike(self) -> None:
        """Of equal jobs the first begins no later than the next, on looms of common calendars."""
        if len(self.axes) > 1 or self.follows:
            return
        before: dict[object, int] = {}
        for job, what in enumerate(self.factory.jobs):
            key = likeness(what)
            if key in before:
                self.model.add(self.timed[before[key], 0].start <= self.timed[job, 0].start)
            before[key] = job

    def _cost(self) -> Any:
        factory = self.factory
        looms = sum(factory.loom_cost(job, loom, same=False) * on for (job, loom), on in self.on.items())
        saved = sum(
            (factory.loom_cost(then, loom, same=False) - factory.loom_cost(then, loom, same=True)) * follows
            for (_, then, loom), follows in self.follows.items()
        )
        return looms - saved + sum(cost * late for _, late, cost, _ in self.late)

    def minimise_cost(self) -> None:
        """Minimise the cost of looms and delays."""
        self.model.minimize(self._cost())

    def minimise_ends(self, cost: int) -> None:
        """Minimise the sum of the ends of plans of at most a cost."""
        self.model.add(self._cost() <= cost)
        ends = []
        for (_, group), timed in self.timed.items():
            axes = self.axes[group]
            weight = max(1, round(100 * self.horizon / max(axes.weaving_total, 1)))
            end = self.model.new_int_var(0, axes.weaving_total, "")
            self.model.add(end == timed.woven_end).only_enforce_if(timed.present)
            ends.append(weight * end)
        self.model.minimize(sum(ends))

    def hint(self, plan: FactoryPlan) -> None:
        """Begin the search at a plan: every variable gets its value there."""
        self.model.clear_hints()
        where = {carpet.job: carpet for carpet in plan.carpets}
        values = {key: self._values(*key, where[key[0]]) for key in self.timed}
        for (job, loom), on in self.on.items():
            self.model.add_hint(on, where[job].loom == loom)
        for (job, group), timed in self.timed.items():
            self.model.add_hint(timed.present, where[job].loom in self.axes[group].looms)
            for name, value in values[job, group].items():
                self.model.add_hint(getattr(timed, name), value)
        for switch in self.switches:
            self.model.add_hint(switch.variable, values[switch.job, switch.group][switch.name] > switch.bound)
        for job, late, _, most in self.late:
            self.model.add_hint(late, min(late_hours(where[job].end, self.factory.jobs[job].due), most))
        for early, job, arrives in self.early:
            self.model.add_hint(early, where[job].start < arrives)
        pairs = {pair for jobs in sequences_of(plan) for pair in itertools.pairwise((ON_LOOM, *jobs))}
        for (first, then, loom), follows in self.follows.items():
            self.model.add_hint(follows, (first, then) in pairs and where[then].loom == loom)
        for size, first, then, group, loom in self.sizes:
            there = where[then].loom == loom and (first == then or (first, then) in pairs)
            begin, end = (values[then, group][name] for name in ("woven_start", "woven_end"))
            if first != then:
                free = self.axes[group].weaving.work(self.factory.looms[loom].available)
                begin, end = free if first == ON_LOOM else values[first, group]["woven_end"], begin
            self.model.add_hint(size, end - begin if there else 0)

    def _values(self, job: int, group: int, one: PlannedCarpet) -> dict[str, int]:
        """The values of the variables of a job at a plan; of one on other looms, as of a carpet without work."""
        axes = self.axes[group]
        weaving, attended = axes.weaving, axes.attended
        if one.loom not in axes.looms:
            least = attended.work(self.factory.jobs[job].earliest)
            end = attended.time_of(least) if least else attended.starts[0]
            begin = weaving.work(attended.time_of(least, begins=True))
            met = dict.fromkeys(("start", "dressed", "met", "end"), least)
            return met | {"woven_start": begin, "woven": weaving.work(end), "woven_end": weaving.work(end)}
        return {
            "start": attended.work(one.start),
            "dressed": attended.work(one.dressed),
            "woven": weaving.work(one.woven),
            "met": attended.work(one.woven),
            "end": attended.work(one.end),
            "woven_start": weaving.work(one.start),
            "woven_end": weaving.work(one.end),
        }

    def run(self, limits: SolveLimits) -> SolverRun:
        """Solve the model within limits."""
        solver, status, repeatable = searched(self.cp, self.model, limits)
        if status not in (self.cp.OPTIMAL, self.cp.FEASIBLE):
            return SolverRun(None, {}, 0, repeatable)
        bound = int(-(-(solver.best_objective_bound - 0.5) // 1))
        return SolverRun(self._sequences(solver), self._floors(solver), max(bound, 0), repeatable)

    def _sequences(self, solver: "CpSolver") -> list[list[int]]:
        sequences: list[list[tuple[int, int, int]]] = [[] for _ in self.factory.looms]
        for (job, group), timed in self.timed.items():
            for loom in self.axes[group].looms:
                if (job, loom) in self.on and solver.value(self.on[job, loom]):
                    sequences[loom].append((solver.value(timed.woven_start), solver.value(timed.woven_end), job))
        return [[job for _, _, job in sorted(sequence)] for sequence in sequences]

    def _floors(self, solver: "CpSolver") -> dict[int, int]:
        """The least starts of the jobs that wait for yarn in the solution."""
        carpets = []
        for (job, group), timed in self.timed.items():
            axes = self.axes[group]
            for loom in axes.looms:
                if (job, loom) in self.on and solver.value(self.on[job, loom]):
                    start = axes.attended.time_of(solver.value(timed.start), begins=True)
                    carpets.append(carpet_on(self.factory, job, loom, start))
        return waiting_in(FactoryPlan(self.factory, tuple(carpets)))
