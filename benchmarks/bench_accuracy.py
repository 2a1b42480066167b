"""How right the engine is: 10^5 random mechanisms of every group of class II, and 10^5 crank-rockers.

`ILMEK_CAMPAIGN=2000 python -m benchmarks accuracy` runs fewer of each; 10^5 take about twenty minutes.
"""

import os
import time

import numpy as np

from benchmarks.campaign.accuracy import accuracy
from benchmarks.campaign.branches import STEPS, crank_rockers
from benchmarks.campaign.near_limits import SAMPLES, near_limits
from benchmarks.campaign.random_linkages import KINDS

CHAINS = [(kind, dyads, True) for dyads in (1, 2, 3) for kind in KINDS] + [(kind, 1, False) for kind in KINDS]
"""Last dyad, dyads in a row, closed forms or Newton's method."""


def run() -> None:
    count = int(os.environ.get("ILMEK_CAMPAIGN", "100000"))
    began = time.process_time()
    print(f"{count:,} mechanisms a line; errors are the worst of all")
    print(f"{'':6s}{'closure':>10s}{'- Newton':>10s}{'velocity':>10s}{'acceleration':>14s}")
    for seed, kind in enumerate(KINDS):
        one = accuracy(kind, count, np.random.default_rng(seed))
        print(f"{kind:6s}{one.closure:10.1e}{one.newton:10.1e}{one.velocity:10.1e}{one.acceleration:14.1e}", flush=True)
    print("\n1e-14 to 1e-3 rad beside limits, links of 1e-4 to 1, up to 1,000 from the origin, against forty digits")
    heads = f"{'':14s}{'close':>8s}{'OK':>8s}{'worst':>10s}{'silently wrong':>16s}{'wrongly open':>14s}"
    print(f"{heads}{'four digits':>13s}{'of these not OK':>17s}")
    for kind, dyads, closed_forms in CHAINS:
        each = min(count, 10_000) // SAMPLES // (1 if closed_forms else 4)
        beside = near_limits(kind, each, np.random.default_rng(dyads), dyads=dyads, closed_forms=closed_forms)
        name = f"{kind} {'x ' + str(dyads) if closed_forms else 'by Newton'}"
        row = f"{name:14s}{beside.samples:8d}{beside.ok:8d}{beside.worst:10.1e}{beside.silent:16d}"
        row += f"{beside.misjudged:14d}{beside.good:13d}"
        print(f"{row}{beside.refused / max(1, beside.good):17.1%}", flush=True)
    found = crank_rockers(count, np.random.default_rng(9))
    steps = ", ".join(str(step) for step in STEPS)
    print(f"\n{found.mechanisms:,} crank-rockers, Grashof ratio up to {found.greatest:.6f}, at {steps} steps a turn:")
    print(f"{found.wrong} of {found.samples:,} samples on a wrong branch")
    print(f"({time.process_time() - began:.0f} s of processor time)")
