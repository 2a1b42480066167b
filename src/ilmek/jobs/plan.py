"""Plan a factory: several carpets on looms that exist, which loom weaves what when, and at what cost."""

import time
from collections.abc import Mapping
from dataclasses import field, replace
from datetime import datetime, timedelta
from pathlib import Path

from ilmek.carpet.yarn_plan import EURO
from ilmek.errors import LoomError, ParameterError, did_you_mean
from ilmek.factory.annealing import annealed_plan
from ilmek.factory.heuristic import first_plan
from ilmek.factory.model import HOUR, MONEY, FactoryPlan, PlannedCarpet, SolveLimits
from ilmek.factory.rescue import Rescue, rescues
from ilmek.factory.solver import SolvedPlan, import_solver, solve, without_fine
from ilmek.factory.verification import plan_faults
from ilmek.factory.yarn_stock import Purchase, purchases
from ilmek.io.looms_file import read_looms
from ilmek.io.orders_file import FactoryOrders, read_orders
from ilmek.io.plan_file import read_ends
from ilmek.jobs.order import recipe_parameters
from ilmek.jobs.plan_begun import BegunCarpet
from ilmek.jobs.plan_fits import PlannedOrder
from ilmek.jobs.plan_inputs import FactoryInputs, read_inputs
from ilmek.machines.automated_loom.making import ON_LOOM, MakingStep
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.units import minute, parse_quantity

AIMS = ("cost", "late")
"""What is least: the cost, or first the number of late carpets."""

MOVES = 4_000
"""Moves of the annealing in a second of the time limit: it takes about a quarter of it."""

ANNEALING_SHARE = 0.4
"""Share of the time limit after which a clock ends the annealing, on a slow computer."""

LEAST_LIMIT, MOST_LIMIT = 1.0, 3600.0
"""Bounds of --time-limit [s]."""

MOST_RESCUED = 5
"""Largest number of late orders for which measures are searched: those whose delay costs most."""

SOLVER_SHARE = 0.6
"""Share of the time for the solver; the rest is for the first plan and the measures."""

PACE = 0.12
"""Deterministic time of the solver in a second of the time limit: a slow computer gets through it too."""


@record
class LateOrder:
    """A late order, by its index, and the measures that save it."""

    order: int
    rescues: tuple[Rescue, ...]


@record
class PlanResult:
    """Results of the job.

    solved     the plan with its bound; None where no order can be woven
    late       the late orders, those whose delay costs most first; measures for at most MOST_RESCUED of them
    purchases  yarn to buy
    ended      whether the time limit ended the search of measures
    before     ends of the orders in an earlier plan, by name            aim  one of AIMS
    """

    inputs: FactoryInputs
    solved: SolvedPlan | None
    late: tuple[LateOrder, ...]
    purchases: tuple[Purchase, ...]
    time_limit: float
    ended: bool = False
    before: Mapping[str, datetime] = field(default_factory=dict)
    aim: str = AIMS[0]

    @property
    def plan(self) -> FactoryPlan:
        """The plan; without carpets where no order can be woven."""
        return FactoryPlan(self.inputs.factory, ()) if self.solved is None else self.solved.plan

    @property
    def gap(self) -> float:
        """Share of the cost above the bound: no plan costs less than 1 - gap times this one [-]."""
        cost = self.plan.cost
        return 0.0 if self.solved is None or cost == 0 else (cost - self.solved.bound) / cost

    def carpets(self, order: int) -> list[PlannedCarpet]:
        """The carpets of an order in the order of time."""
        jobs = self.inputs.jobs[order]
        return sorted(
            (carpet for carpet in self.plan.carpets if carpet.job in jobs), key=lambda one: (one.start, one.end)
        )

    def begun(self, order: int) -> list[BegunCarpet]:
        """The carpets of an order that are on looms when the plan begins."""
        return [carpet for carpet in self.inputs.begun if carpet.order == order]

    def end(self, order: int) -> int | None:
        """The end of an order's last carpet [min]; None where it is not woven."""
        ends = [carpet.end for carpet in self.carpets(order)] + [carpet.end for carpet in self.begun(order)]
        return max(ends, default=None)

    def cost(self, carpet: PlannedCarpet) -> int:
        """The cost of a carpet: of its loom and its delay."""
        factory = self.inputs.factory
        looms = factory.loom_cost(carpet.job, carpet.loom, same=carpet.same)
        return looms + factory.jobs[carpet.job].late_cost(carpet.end)

    def overdue(self, order: int) -> int:
        """The delay of an order's last carpet [min]."""
        end, due = self.end(order), self.inputs.orders[order].entry.due
        return 0 if end is None else max(end - (due - self.inputs.origin) // timedelta(minutes=1), 0)

    def steps(self, carpet: PlannedCarpet) -> tuple[MakingStep, ...]:
        """The steps of making of a carpet: on the loom at the file's cost; after it at the loom's rates, in euros."""
        inputs = self.inputs
        job, loom = inputs.factory.jobs[carpet.job], inputs.factory.looms[carpet.loom]
        times = loom.dressing_time(same=carpet.same), job.weaving[carpet.loom], loom.doffing
        on_loom = (
            MakingStep(name, minute * time, loom.cost_of(time) / MONEY)
            for name, time in zip(ON_LOOM, times, strict=True)
        )
        finishing = inputs.orders[job.order].fits[carpet.loom].finishing
        known = inputs.orders_file.currency == EURO
        return (*on_loom, *(step if known else replace(step, cost=None) for step in finishing))

    @property
    def checks(self) -> tuple[Check, ...]:
        """Of every order: it is in time; or the checks that fail on the loom that comes nearest to weaving it."""
        checks: list[Check] = []
        for index, order in enumerate(self.inputs.orders):
            name = order.entry.name
            if order.possible:
                cure = next(
                    (rescue_text(self, one.rescues[0]) for one in self.late if one.order == index and one.rescues), ""
                )
                late = minute * self.overdue(index)
                checks.append(at_most(f"{name}: delay", late, 0.0, "h", "the due date").with_cure(cure))
            else:
                checks += _not_woven(self.inputs, order)
        return tuple(checks)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What limits the plan's claims, and what may be a slip in the files."""
        warnings = [*_hopeless_dates(self.inputs), *_unused_yarns(self.inputs)]
        if self.solved is not None and not self.solved.repeatable:
            warnings.append(
                "the time limit ended the search: another computer may find another plan; give a longer --time-limit"
            )
        if self.ended:
            warnings.append("the time limit ended the search of measures for late orders; give a longer --time-limit")
        measured = sum(bool(one.rescues) for one in self.late)
        if measured < len(self.late):
            warnings.append(f"measures are searched for {measured} of {len(self.late)} late orders")
        return tuple(warnings)


def _hopeless_dates(inputs: FactoryInputs) -> list[str]:
    """Orders that are due before they may begin."""
    return [
        f"{order.entry.name}: due {order.entry.due:%Y-%m-%d %H:%M} is before its earliest begin "
        f"{order.entry.earliest:%Y-%m-%d %H:%M}; no plan is in time"
        for order in inputs.orders
        if order.entry.due <= order.entry.earliest
    ]


def _unused_yarns(inputs: FactoryInputs) -> list[str]:
    """Yarns of the looms' file that no carpet of the plan takes: their stock counts for nothing."""
    used = [yarn.name for yarn in inputs.factory.yarns]
    unused = [yarn.name for yarn in inputs.looms_file.yarns if yarn.name not in used]
    if not used or not unused:
        return []
    named = [f"{name!r}" + (f" ({hint})" if (hint := did_you_mean(name, used)) else "") for name in unused[:3]]
    names = ", ".join(named) + (f" and {len(unused) - 3} more" if len(unused) > 3 else "")
    return [f"{inputs.looms_file.path.name}: no carpet of the plan takes the yarn {names}"]


def read_time_limit(text: str) -> float:
    """A time limit with its unit [s]. Raises ParameterError, UnitError."""
    seconds = parse_quantity(text, "s")
    if not LEAST_LIMIT <= seconds <= MOST_LIMIT or text.strip().replace(".", "").isdigit():
        raise ParameterError(f"--time-limit {text!r}", allowed="1 s to 1 h, with its unit", do="write it like 60s")
    return seconds


def default_limit(carpets: int) -> float:
    """The time limit by the number of carpets [s]: 10 s for ten, 60 s for a hundred and more."""
    return min(60.0, max(10.0, 0.6 * carpets))


def plan_factory(
    orders: Path,
    looms: Path,
    *,
    time_limit: float | None = None,
    now: datetime | None = None,
    against: Path | None = None,
    aim: str = AIMS[0],
    progress: Progress = SILENT,
) -> PlanResult:
    """Plan the orders of a file on the looms of another.

    time_limit  [s]; default: `default_limit` of the carpets
    now         begin of the plan in the place of the file's: what is on the looms stays there
    against     JSON of an earlier plan, with whose ends those of the orders are compared
    aim         of AIMS: the least cost, or the fewest late carpets and then the least cost
    Raises an IlmekError for files that cannot be read, LoomError for a plan that fails its verification.
    """
    import_solver()
    before = {} if against is None else read_ends(against)
    ordered = _from_now(read_orders(orders, recipe_parameters()), now)
    inputs = read_inputs(ordered, read_looms(looms), progress.part(0.0, 0.3))
    limit = default_limit(len(inputs.factory.jobs)) if time_limit is None else time_limit
    if not inputs.factory.jobs:
        return PlanResult(inputs, None, (), (), limit, before=before, aim=aim)
    begun = time.monotonic()
    first = first_plan(inputs.factory, progress.part(0.3, 0.35, "first plan"))
    # One late carpet less is worth more than the whole first plan twice.
    fine = max(2 * first.cost, 1) if aim == "late" else 0
    first = FactoryPlan(inputs.factory.with_fine(fine), first.carpets)
    annealed_by = begun + ANNEALING_SHARE * limit
    first, whole = annealed_plan(
        first,
        round(MOVES * limit),
        progress.part(0.35, 0.5, "annealing"),
        ended=lambda: time.monotonic() > annealed_by,
    )
    left = limit - (time.monotonic() - begun)
    share = SOLVER_SHARE if first.late else 1.0
    progress.part(0.5, 0.8, "plan")
    solved = solve(first.factory, first, SolveLimits(PACE * share * limit, max(0.5, share * left)))
    solved = replace(solved, repeatable=solved.repeatable and whole)
    if fine:
        solved = without_fine(solved, inputs.factory, fine)
    faults = plan_faults(solved.plan, solved.plan.cost)
    if faults:
        raise LoomError(f"the plan does not hold: {faults[0]}", do="report this with both files")
    done = PlanResult(inputs, solved, (), purchases(solved.plan), limit, before=before, aim=aim)
    return _with_measures(done, begun + limit, progress.part(0.8, 1.0, "late orders"))


def _from_now(orders: FactoryOrders, now: datetime | None) -> FactoryOrders:
    """The orders with another begin of the plan."""
    if now is None:
        return orders
    later = tuple(replace(order, earliest=max(order.earliest, now)) for order in orders.orders)
    return replace(orders, start=now, orders=later)


def _with_measures(done: PlanResult, deadline: float, progress: Progress) -> PlanResult:
    """The result with its late orders and what saves them; `deadline`: end of the search on the monotonic clock [s]."""
    plan, jobs = done.plan, done.inputs.factory.jobs
    costs = {
        index: sum(jobs[carpet.job].late_cost(carpet.end) for carpet in done.carpets(index))
        for index in range(len(done.inputs.orders))
        if plan.late.intersection(done.inputs.jobs[index])
    }
    found = []
    for number, order in enumerate(sorted(costs, key=lambda index: (-costs[index], index))):
        late = frozenset(done.inputs.jobs[order]) & plan.late
        measures = rescues(plan, late, lambda: time.monotonic() > deadline) if number < MOST_RESCUED else ()
        found.append(LateOrder(order, measures))
        progress(min(1.0, (number + 1) / MOST_RESCUED))
    return replace(done, late=tuple(found), ended=bool(found) and time.monotonic() > deadline)


def _not_woven(inputs: FactoryInputs, order: PlannedOrder) -> list[Check]:
    """The failed checks of an order on the loom with the fewest of them."""
    fits = zip(inputs.looms_file.looms, order.fits, strict=True)
    loom, fit = min(fits, key=lambda pair: len(pair[1].failed))
    return [replace(check, name=f"{order.entry.name} on {loom.name}: {check.name}") for check in fit.failed]


def rescue_text(done: PlanResult, rescue: Rescue) -> str:
    """A measure in words."""
    factory = rescue.plan.factory
    loom = done.inputs.looms_file.looms[rescue.loom].name if rescue.loom >= 0 else ""
    until = f"until {done.inputs.time(rescue.until):%Y-%m-%d}"
    hours, later = f"{rescue.hours} h", rescue.until + HOUR * rescue.hours
    texts = {
        "put first": "put it before orders that are late anyway",
        "overtime": f"{hours} overtime a day on loom {loom} {until}",
        "free days": f"loom {loom} works on its free days {until}",
        "another loom": f"one more loom like {loom}, {len(factory.looms)} in all",
        "earlier start": f"start it {hours} earlier",
        "yarn at once": "get its yarn without lead time",
        "later due date": f"agree the due date {done.inputs.time(later):%Y-%m-%d %H:%M}, {hours} later",
    }
    return texts[rescue.kind]
