"""Pareto front: the non-dominated members."""

from bisect import bisect_right

import numpy as np

from ilmek.arrays import Bool, Float

BLOCK = 512
"""Members compared per step with the present front."""


def front(costs: Float[np.ndarray, "members costs"]) -> Bool[np.ndarray, " members"]:
    """Whether each member is on the front, that is, not dominated. Exact.

    A member dominates another if no cost is higher and at least one is lower.

    costs  (members, costs), to be minimised; quantities to be maximised are given with the opposite sign
    Members with equal costs are on the front together or not at all; a member with a NaN cost is not on the front.
    In lexicographic order only an earlier member can dominate a later one: if they differ, and neither the second nor a
    further cost is higher.

    >>> front(np.array([[1.0, 3.0], [2.0, 2.0], [3.0, 1.0], [2.0, 3.0], [2.0, 2.0]])).tolist()
    [True, True, True, False, True]
    """
    usable = np.flatnonzero(~np.isnan(costs).any(axis=1))
    rows, alike = np.unique(costs[usable], axis=0, return_inverse=True)
    on_front = np.zeros(len(costs), dtype=bool)
    on_front[usable] = _non_dominated(rows[:, 1:])[alike.ravel()]
    return on_front


def _non_dominated(rows: Float[np.ndarray, "rows costs"]) -> Bool[np.ndarray, " rows"]:
    """The rows for which no earlier row has at most the same value in every cost."""
    non_dominated = np.zeros(len(rows), dtype=bool)
    if rows.shape[1] == 1:
        non_dominated[1:] = rows[1:, 0] < np.minimum.accumulate(rows[:-1, 0])
        non_dominated[:1] = True
        return non_dominated
    if rows.shape[1] == 2:
        return _non_dominated_pairs(rows)
    kept = np.empty((0, rows.shape[1]))
    for start in range(0, len(rows), BLOCK):
        part = np.arange(start, min(start + BLOCK, len(rows)))
        part = part[~_weakly_dominates(kept, rows[part]).any(axis=1)]
        part = part[~np.tril(_weakly_dominates(rows[part], rows[part]), -1).any(axis=1)]
        non_dominated[part] = True
        kept = np.concatenate([kept, rows[part]])
    return non_dominated


def _non_dominated_pairs(rows: Float[np.ndarray, "rows 2"]) -> Bool[np.ndarray, " rows"]:
    """The same for two costs: the present front is a staircase, and a row is compared with one step of it."""
    non_dominated = np.zeros(len(rows), dtype=bool)
    across: list[float] = []
    heights: list[float] = []
    for index, (first, second) in enumerate(rows.tolist()):
        step = bisect_right(across, first)
        if step and heights[step - 1] <= second:
            continue
        non_dominated[index] = True
        # The new step replaces further steps that are not lower.
        end = step
        while end < len(across) and heights[end] >= second:
            end += 1
        across[step:end], heights[step:end] = [first], [second]
    return non_dominated


def _weakly_dominates(
    others: Float[np.ndarray, "others costs"], members: Float[np.ndarray, "members costs"]
) -> Bool[np.ndarray, "members others"]:
    """Whether each of the others has at most the same value as each member in every cost."""
    found = np.ones((len(members), len(others)), dtype=bool)
    for theirs, mine in zip(others.T, members.T, strict=True):
        found &= theirs <= mine[:, None]
    return found
