"""The independent check of a plan: what it claims is counted again, minute by minute of every window.

Nothing of the arithmetic by which plans are made is used here: no calendar function, no cost function.
"""

from collections.abc import Iterator, Sequence

from ilmek.factory.calendar import Window
from ilmek.factory.model import HOUR, Factory, FactoryPlan, PlannedCarpet


def plan_faults(plan: FactoryPlan, cost: int) -> tuple[str, ...]:
    """What is wrong with a plan, one sentence each; none for a plan that holds.

    cost  claimed of the whole plan
    """
    factory = plan.factory
    if sorted(carpet.job for carpet in plan.carpets) != list(range(len(factory.jobs))):
        return ("not every carpet is planned once",)
    known = [carpet for carpet in plan.carpets if 0 <= carpet.loom < len(factory.looms)]
    faults = [
        f"carpet {carpet.job}: loom {carpet.loom} cannot weave it"
        for carpet in plan.carpets
        if not _can(factory, carpet)
    ]
    if faults or len(known) < len(plan.carpets):
        return tuple(faults)
    for one in known:
        faults += _carpet_faults(factory, one)
    for loom in range(len(factory.looms)):
        faults += _loom_faults(factory, [one for one in known if one.loom == loom])
    faults += _stock_faults(plan)
    recounted = _cost(plan)
    if recounted != cost:
        faults.append(f"the cost is {recounted}, the plan states {cost}")
    return tuple(faults)


def _can(factory: Factory, one: PlannedCarpet) -> bool:
    return one.loom in factory.jobs[one.job].weaving


def _worked(windows: Sequence[Window], start: int, end: int) -> int:
    return sum(max(0, min(end, high) - max(start, low)) for low, high in windows)


def _carpet_faults(factory: Factory, one: PlannedCarpet) -> Iterator[str]:
    loom, job = factory.looms[one.loom], factory.jobs[one.job]
    if not one.start <= one.dressed <= one.woven <= one.end:
        yield f"carpet {one.job}: its times are not in order"
    if one.start < max(job.earliest, loom.available, 0):
        yield f"carpet {one.job}: it starts at {one.start}, before its release or its loom"
    dressing = min(loom.dressing, loom.dressing_same) if one.same else loom.dressing
    phases = (
        ("dressing", loom.attended.windows, one.start, one.dressed, dressing),
        ("weaving", loom.weaving.windows, one.dressed, one.woven, job.weaving[one.loom]),
        ("doffing", loom.attended.windows, one.woven, one.end, loom.doffing),
    )
    for name, windows, start, end, minutes in phases:
        worked = _worked(windows, start, end)
        if worked != minutes:
            yield f"carpet {one.job}: {name} has {worked} working minutes, it takes {minutes}"
        elif minutes and not _worked(windows, end - 1, end):
            yield f"carpet {one.job}: {name} ends at {end}, outside the shifts"
    if not _worked(loom.attended.windows, one.start, one.start + 1):
        yield f"carpet {one.job}: it starts at {one.start}, outside the attended shifts"


def _loom_faults(factory: Factory, carpets: Sequence[PlannedCarpet]) -> Iterator[str]:
    """Overlaps, and setups that are claimed to be the same."""
    ordered = sorted(carpets, key=lambda one: (one.start, one.end))
    for index, one in enumerate(ordered):
        before = ordered[index - 1] if index else None
        if before is not None and one.start < before.end:
            yield f"carpet {one.job}: it starts at {one.start}, before carpet {before.job} is off the loom"
        setup = factory.looms[one.loom].setup if before is None else factory.jobs[before.job].setup
        like = setup == factory.jobs[one.job].setup
        if one.same != like:
            yield f"carpet {one.job}: the setup of the carpet before is {'' if like else 'not '}the same"


def _stock_faults(plan: FactoryPlan) -> Iterator[str]:
    for index, yarn in enumerate(plan.factory.yarns):
        used = {carpet.job: plan.factory.jobs[carpet.job].yarns.get(index, 0) for carpet in plan.carpets}
        total = sum(used.values())
        early = sum(used[carpet.job] for carpet in plan.carpets if carpet.start < yarn.arrives)
        if total > yarn.stock and early > yarn.stock:
            yield f"yarn {yarn.name}: {early} g are needed before the purchase arrives, {yarn.stock} g are in stock"


def _cost(plan: FactoryPlan) -> int:
    total = 0
    for carpet in plan.carpets:
        loom, job = plan.factory.looms[carpet.loom], plan.factory.jobs[carpet.job]
        dressing = min(loom.dressing, loom.dressing_same) if carpet.same else loom.dressing
        minutes = dressing + job.weaving[carpet.loom] + loom.doffing
        whole, rest = divmod(loom.cost * minutes, HOUR)
        total += whole + (2 * rest >= HOUR)
        overdue = carpet.end - job.due
        if overdue > 0:
            total += job.fine + job.late * (overdue // HOUR + (overdue % HOUR > 0))
    return total
