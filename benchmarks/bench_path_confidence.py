"""Path search: how often a search with its defaults meets the best value known, and how often it states so rightly.

Random tasks of six kinds, several seeds each. The best value known of a task is the best of all these searches and of
one with 4608 starts. A search whose best is within 0.1 % of it (squares) has met it; the others
have missed a better optimum, and the share that did is compared with the mean of the probabilities that they stated.
"""

import statistics
import sys
import time
from itertools import pairwise

import numpy as np

from benchmarks.path_cases import NEAR, random_path
from ilmek.synthesis.path.search import path_four_bars

TASKS, SEEDS = 36, 3
STARTS = 4608
"""Random starts of the longer search."""

CLASSES = (0.0, 0.0125, 0.05, 0.2, 0.5, 1.01)
"""Limits of the classes of stated probabilities."""

ZERO = 1e-14
"""Squared error of each point, in squared sizes of the path, that counts as none."""


def run(tasks: int = TASKS, seeds: int = SEEDS, first: int = 0) -> None:
    path_four_bars(random_path(0), starts=1)
    stated, missed, seconds, reached = [], [], [], []
    for number in range(first, first + tasks):
        task = random_path(number)
        found = []
        for seed in range(seeds):
            begin = time.perf_counter()
            found.append(path_four_bars(task, seed=seed, count=1)[0])
            seconds.append(time.perf_counter() - begin)
        longer = path_four_bars(task, seed=1000, starts=STARTS, count=1)[0]
        best = min(one.squared_error for one in (*found, longer))
        most = best * NEAR + ZERO * len(task.points) * task.size**2
        misses = [one.squared_error > most for one in found]
        stated += [one.search.missed for one in found]
        missed += misses
        reached.append(1 - np.mean(misses))
        starts = [one.search.starts for one in found]
        print(f"  {number:>3} kind {number % 6}{best:>12.4g}{reached[-1]:>7.0%}  starts {starts}", flush=True)
    full = sum(share == 1 for share in reached)
    print(f"  searches that met the best known: {1 - np.mean(missed):.1%}; tasks where all did: {full} of {tasks}")
    print(f"  seconds: median {statistics.median(seconds):.2f}, most {max(seconds):.2f}")
    print("  stated probability    searches  mean stated  missed a better one")
    for low, high in pairwise(CLASSES):
        chosen = [k for k, p in enumerate(stated) if low <= p < high]
        if chosen:
            mean, share = (np.mean([values[k] for k in chosen]) for values in (stated, missed))
            print(f"  {low:>7.2%} to {high:>7.2%}{len(chosen):>11}{mean:>13.1%}{share:>12.1%}")


if __name__ == "__main__":
    run(*map(int, sys.argv[1:]))
