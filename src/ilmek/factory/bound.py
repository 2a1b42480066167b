"""A bound of the cost of every plan, from the capacity of the looms.

The work of each carpet is divided over looms and intervals of time. A carpet of which a share y is made on loom l in
interval t costs at least

    sum over l, t of y_lt (cost_l + delay at the later of the begin of t and the end of the carpet alone on l)

since it ends no earlier than any of its work is done, and the delay does not fall with time. Under the capacity of the
looms this is a linear programme. Whatever prices p_lt >= 0 of a minute of the looms,

    bound = sum over carpets of min over l, t of (cost_lt + minutes_l p_lt) - sum over l, t of minutes of t on l * p_lt

is below its optimum, by duality: the solver's prices need not be exact. It is summed in whole units.
"""

import itertools
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import coo_array

from ilmek.arrays import FloatArray, IntArray
from ilmek.factory.model import Factory, carpet_on

MOST_SHARES = 150_000
"""Largest number of shares of the linear programme; 5 s."""

LEAST_INTERVALS, MOST_INTERVALS = 6, 200

MOST_PAIRS = MOST_SHARES // LEAST_INTERVALS
"""Largest number of pairs of a carpet and a loom for which this bound, and the solver's model, are made."""


@dataclass(frozen=True, slots=True)
class _Shares:
    """The shares: job, cell of loom and interval, cost, minutes of the whole carpet, (n,); capacity of each cell."""

    job: IntArray
    cell: IntArray
    cost: IntArray
    minutes: IntArray
    capacity: IntArray


def capacity_bound(factory: Factory, horizon: int) -> int:
    """The bound of the cost of all plans that end before a horizon [min]; 0: none is found, or too many pairs."""
    if not 0 < factory.pairs <= MOST_PAIRS:
        return 0
    shares = _shares(factory, horizon)
    count = len(shares.job)
    sums = coo_array((np.ones(count), (shares.job, np.arange(count))), shape=(len(factory.jobs), count))
    used = coo_array(
        (shares.minutes.astype(float), (shares.cell, np.arange(count))), shape=(len(shares.capacity), count)
    )
    found = linprog(
        shares.cost.astype(float),
        A_ub=used.tocsr(),
        b_ub=shares.capacity.astype(float),
        A_eq=sums.tocsr(),
        b_eq=np.ones(len(factory.jobs)),
        method="highs",
    )
    if found.status != 0:
        return 0
    return _dual(shares, -np.asarray(found.ineqlin.marginals), len(factory.jobs)) + _first_dressings(factory)


def _first_dressings(factory: Factory) -> int:
    """The cost of one whole dressing for each setup of several carpets, beyond the short one of all of them.

    A setup that is on a loom needs none.
    """
    dressed = {loom.setup for loom in factory.looms}
    groups: dict[int, list[int]] = {}
    for number, job in enumerate(factory.jobs):
        groups.setdefault(job.setup, []).append(number)
    return sum(
        min(
            factory.loom_cost(number, loom, same=False) - factory.loom_cost(number, loom, same=True)
            for number in members
            for loom in factory.jobs[number].weaving
        )
        for setup, members in groups.items()
        if len(members) > 1 and setup not in dressed
    )


def _dual(shares: _Shares, prices: FloatArray, jobs: int) -> int:
    """The bound that any prices of the cells' minutes give, in whole units: prices are rounded down to units."""
    whole = np.maximum(np.floor(prices), 0).astype(np.int64)
    least = np.full(jobs, np.iinfo(np.int64).max)
    np.minimum.at(least, shares.job, shares.cost + shares.minutes * whole[shares.cell])
    return max(int(least.sum() - (shares.capacity * whole).sum()), 0)


def _shares(factory: Factory, horizon: int) -> _Shares:
    """The shares that can be in a plan: after the release of the carpet and when the loom is there."""
    pairs = sum(len(job.weaving) for job in factory.jobs)
    intervals = min(MOST_INTERVALS, max(LEAST_INTERVALS, MOST_SHARES // max(pairs, 1)))
    edges = [horizon * step // intervals for step in range(intervals + 1)]
    capacity = [
        max(loom.weaving.work(end) - loom.weaving.work(max(begin, min(loom.available, end))), 0)
        for loom in factory.looms
        for begin, end in itertools.pairwise(edges)
    ]
    rows: list[tuple[int, int, int, int]] = []
    for number, job in enumerate(factory.jobs):
        same = factory.like(number)
        for loom, weaving in job.weaving.items():
            on = factory.looms[loom]
            cost = factory.loom_cost(number, loom, same=same)
            alone = carpet_on(factory, number, loom, 0, same=same).end
            minutes = on.dressing_time(same=same) + weaving + on.doffing
            for step in range(intervals):
                if edges[step + 1] > job.earliest and capacity[loom * intervals + step]:
                    late = job.late_cost(max(edges[step], alone))
                    rows.append((number, loom * intervals + step, cost + late, minutes))
    table = np.array(rows, dtype=np.int64).reshape(-1, 4)
    return _Shares(table[:, 0], table[:, 1], table[:, 2], table[:, 3], np.array(capacity, dtype=np.int64))
