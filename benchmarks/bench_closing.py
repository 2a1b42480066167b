"""Closing ranges of random mechanisms: distance of their ends from det J = 0, and the time of a search."""

import time

import numpy as np

from benchmarks.campaign.random_closing import CLASS_II, CLASS_III, check, four_bar, plate_behind_a_dyad, stephenson
from ilmek.linkage.closing import closing
from ilmek.linkage.one_input import one_input
from ilmek.linkage.structure import plan

MECHANISMS = 100
"""Mechanisms of class II, and of class III."""


def run() -> None:
    """Print the errors and the times."""
    rng = np.random.default_rng(1)
    for name, kinds in (("II", CLASS_II), ("III", (*CLASS_III, plate_behind_a_dyad))):
        found = [check(kinds[k % len(kinds)](rng), 721) for k in range(MECHANISMS)]
        error = np.degrees(max(one.error for one in found))
        dead, missed = (sum(getattr(one, what) for one in found) for what in ("dead", "missed"))
        print(f"class {name:3}  {len(found)} mechanisms, {dead} dead centres, {missed} missed")
        print(f"           ends at most {error:.1e} deg from det J = 0")
    for make in (four_bar, stephenson):
        moved = [one_input(plan(make(rng))) for _ in range(20)]
        begin = time.process_time()
        for one in moved:
            closing(one, -np.pi, np.pi)
        each = (time.process_time() - begin) / len(moved)
        print(f"closing ranges of a new mechanism, {make.__name__:10}  {each * 1e3:6.1f} ms")
