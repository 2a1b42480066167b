"""How right the engine is: 10^5 random mechanisms of every group of class II, and 10^5 crank-rockers.

`ILMEK_CAMPAIGN=2000 python -m benchmarks accuracy` runs fewer of each; 10^5 take about twenty minutes.
"""

import os
import time

import numpy as np

from benchmarks.campaign.accuracy import accuracy
from benchmarks.campaign.branches import STEPS, crank_rockers
from benchmarks.campaign.near_dead import near_dead
from benchmarks.campaign.random_linkages import KINDS


def run() -> None:
    count = int(os.environ.get("ILMEK_CAMPAIGN", "100000"))
    began = time.process_time()
    print(f"{count:,} mechanisms a line; errors are the worst of all")
    print(f"{'':6s}{'closure':>10s}{'- Newton':>10s}{'velocity':>10s}{'acceleration':>14s}")
    for seed, kind in enumerate(KINDS):
        one = accuracy(kind, count, np.random.default_rng(seed))
        print(f"{kind:6s}{one.closure:10.1e}{one.newton:10.1e}{one.velocity:10.1e}{one.acceleration:14.1e}", flush=True)
    print("\nbeside dead centres, from 0.03 to 3e-15 rad on either side; rates of samples whose status is OK")
    heads = f"{'':6s}{'samples':>10s}{'OK':>10s}{'velocity':>10s}{'acceleration':>14s}"
    print(f"{heads}{'silently wrong':>16s}{'misjudged':>11s}")
    for seed, kind in enumerate(KINDS[:4]):
        beside = near_dead(kind, count, np.random.default_rng(seed))
        row = f"{kind:6s}{beside.samples:10d}{beside.solved:10d}{beside.velocity:10.1e}{beside.acceleration:14.1e}"
        print(f"{row}{beside.silent:16d}{beside.misjudged:11d}", flush=True)
    found = crank_rockers(count, np.random.default_rng(9))
    steps = ", ".join(str(step) for step in STEPS)
    print(f"\n{found.mechanisms:,} crank-rockers, Grashof ratio up to {found.greatest:.6f}, at {steps} steps a turn:")
    print(f"{found.wrong} of {found.samples:,} samples on a wrong branch")
    print(f"({time.process_time() - began:.0f} s of processor time)")
