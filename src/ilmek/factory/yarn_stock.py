"""Yarn: which carpets wait for a purchase, and what is bought until when.

A yarn in stock is used by the carpets in the order of their starts; a purchase arrives after its lead time, at the
same instant for all of it. A carpet that starts before that instant is woven from the stock.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ilmek.factory.model import Factory, FactoryPlan


@dataclass(frozen=True, slots=True)
class Purchase:
    """Yarn to buy: the index of the yarn, grams needed and grams to buy, and the start of the first carpet that needs
    more than the stock [min].
    """

    yarn: int
    needed: int
    grams: int
    by: int


def scarce_yarns(factory: Factory) -> tuple[int, ...]:
    """Yarns that must be bought, and arrive after the plan's begin: some carpets wait for them."""
    return tuple(
        index
        for index, yarn in enumerate(factory.yarns)
        if yarn.arrives > 0 and yarn.stock < sum(job.yarns.get(index, 0) for job in factory.jobs)
    )


def waiting_times(factory: Factory, first: Iterable[int]) -> dict[int, int]:
    """The least start of each job that waits for yarn [min], where jobs get the stock in the order `first`."""
    scarce = scarce_yarns(factory)
    left = {index: factory.yarns[index].stock for index in scarce}
    floors: dict[int, int] = {}
    for job in first:
        lacking = [index for index in scarce if factory.jobs[job].yarns.get(index, 0) > left[index]]
        if lacking:
            floors[job] = max(factory.yarns[index].arrives for index in lacking)
        for index in scarce:
            # A job that waits for one yarn leaves the stock of another only if that has arrived by then.
            if floors.get(job, 0) < factory.yarns[index].arrives:
                left[index] -= factory.jobs[job].yarns.get(index, 0)
    return floors


def waiting_in(plan: FactoryPlan) -> dict[int, int]:
    """The least starts of the jobs of a plan that start after a purchase of theirs has arrived [min]."""
    factory, floors = plan.factory, {}
    scarce = scarce_yarns(factory)
    for carpet in plan.carpets:
        used = factory.jobs[carpet.job].yarns
        arrived = [
            factory.yarns[index].arrives
            for index in scarce
            if used.get(index, 0) and carpet.start >= factory.yarns[index].arrives
        ]
        if arrived:
            floors[carpet.job] = max(arrived)
    return floors


def purchases(plan: FactoryPlan) -> tuple[Purchase, ...]:
    """The yarn to buy for all carpets of a plan together, less the stock."""
    purchases = []
    for index, yarn in enumerate(plan.factory.yarns):
        used = needed_grams(plan, index)
        total, by = 0, 0
        for start, grams in sorted(used):
            total += grams
            if total > yarn.stock:
                by = start
                break
        needed = sum(grams for _, grams in used)
        if needed > yarn.stock:
            purchases.append(Purchase(index, needed, needed - yarn.stock, by))
    return tuple(purchases)


def needed_grams(plan: FactoryPlan, yarn: int) -> list[tuple[int, int]]:
    """Start [min] and grams of every carpet that has a yarn."""
    jobs: Mapping[int, Mapping[int, int]] = {carpet.job: plan.factory.jobs[carpet.job].yarns for carpet in plan.carpets}
    return [(carpet.start, jobs[carpet.job][yarn]) for carpet in plan.carpets if jobs[carpet.job].get(yarn, 0)]
