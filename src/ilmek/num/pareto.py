"""Pareto's front: the members that no other beats in everything."""

from bisect import bisect_right

import numpy as np

from ilmek.arrays import Bool, Float

BLOCK = 512
"""Members compared at a time with the front so far."""


def front(costs: Float[np.ndarray, "members costs"]) -> Bool[np.ndarray, " members"]:
    """Whether each member is on the front: no other is at most as dear in every cost, and cheaper in one. Exact.

    costs  what is to be small; what is to be great is handed in with its sign changed
    Members alike in every cost are on the front together, or not at all; one with a cost that is NaN never is.
    In the dictionary's order of their costs, only an earlier member can beat a later one, and unless they are alike it
    does so where it is not dearer in the second cost and all that follow.

    >>> front(np.array([[1.0, 3.0], [2.0, 2.0], [3.0, 1.0], [2.0, 3.0], [2.0, 2.0]])).tolist()
    [True, True, True, False, True]
    """
    usable = np.flatnonzero(~np.isnan(costs).any(axis=1))
    rows, alike = np.unique(costs[usable], axis=0, return_inverse=True)
    on_front = np.zeros(len(costs), dtype=bool)
    on_front[usable] = _unbeaten(rows[:, 1:])[alike.ravel()]
    return on_front


def _unbeaten(rows: Float[np.ndarray, "rows costs"]) -> Bool[np.ndarray, " rows"]:
    """The rows for which no earlier one is at most as great in every cost."""
    unbeaten = np.zeros(len(rows), dtype=bool)
    if rows.shape[1] == 1:
        unbeaten[1:] = rows[1:, 0] < np.minimum.accumulate(rows[:-1, 0])
        unbeaten[:1] = True
        return unbeaten
    if rows.shape[1] == 2:
        return _under_the_stair(rows)
    kept = np.empty((0, rows.shape[1]))
    for start in range(0, len(rows), BLOCK):
        part = np.arange(start, min(start + BLOCK, len(rows)))
        part = part[~_not_dearer(kept, rows[part]).any(axis=1)]
        part = part[~np.tril(_not_dearer(rows[part], rows[part]), -1).any(axis=1)]
        unbeaten[part] = True
        kept = np.concatenate([kept, rows[part]])
    return unbeaten


def _under_the_stair(rows: Float[np.ndarray, "rows 2"]) -> Bool[np.ndarray, " rows"]:
    """The same for two costs: the best so far are a stair, and a row is compared with the one step at its place."""
    unbeaten = np.zeros(len(rows), dtype=bool)
    across: list[float] = []
    heights: list[float] = []
    for place, (first, second) in enumerate(rows.tolist()):
        step = bisect_right(across, first)
        if step and heights[step - 1] <= second:
            continue
        unbeaten[place] = True
        # Steps farther on and as high or higher are hidden by the new one.
        end = step
        while end < len(across) and heights[end] >= second:
            end += 1
        across[step:end], heights[step:end] = [first], [second]
    return unbeaten


def _not_dearer(
    others: Float[np.ndarray, "others costs"], members: Float[np.ndarray, "members costs"]
) -> Bool[np.ndarray, "members others"]:
    """Whether each of the others is at most as dear as each member in every cost."""
    found = np.ones((len(members), len(others)), dtype=bool)
    for theirs, mine in zip(others.T, members.T, strict=True):
        found &= theirs <= mine[:, None]
    return found
