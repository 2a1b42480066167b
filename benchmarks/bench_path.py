"""Approximate path synthesis: cases 1 to 5 of the literature, 50 seeded runs each, beside what others report.

Then four-bars planted at random, each to be found again from points of its own path: how often, and how long.
"""

import statistics
import sys
import time

import numpy as np

from benchmarks.path_cases import CASES, PathCase, met
from ilmek.synthesis.path.links import random_links
from ilmek.synthesis.path.model import coupler_point
from ilmek.synthesis.path.search import path_four_bars
from ilmek.synthesis.path.task import PathTask

RUNS = 50
PLANTED = 50
FOUND = 1e-5
"""Greatest distance from a point, in sizes of the path, at which a planted four-bar counts as found again."""


def case(of: PathCase, runs: int) -> None:
    errors, seconds, evaluations = [], [], []
    for seed in range(runs):
        begin = time.perf_counter()
        best = path_four_bars(of.task, seed=seed)[0]
        seconds.append(time.perf_counter() - begin)
        errors.append(best.squared_error)
        evaluations.append(best.search.evaluations)
    rate = sum(met(of, error) for error in errors) / runs
    print(
        f"  {of.name:<26}{of.best:>11.5g}{statistics.median(errors):>13.6g}{max(errors):>13.6g}{rate:>7.0%}"
        f"{statistics.median(seconds):>9.3f} s{max(seconds):>9.3f} s{statistics.median(evaluations):>9.0f}"
    )
    print(f"      others: {of.peers}")


def planted(seed: int, count: int) -> PathTask:
    """Points of a random crank-rocker's own path, the whole of it or half a turn; its size is within the bounds."""
    rng = np.random.default_rng(seed)
    part = 1.0 if seed % 2 else 0.5
    while True:
        links = random_links(rng, 1, (np.full(4, 1e-6), np.full(4, 1e6)), kind=+1, kappa=np.cos(np.radians(20)))[0]
        design = np.r_[links, links[2] * rng.uniform(-1.5, 1.5, 2), rng.normal(size=2), rng.uniform(0, 6), 0.0]
        angles = rng.uniform(0, 6) + 2 * np.pi * part * np.arange(count) / count
        points = np.array([coupler_point(design, float(angle), +1) for angle in angles])
        task = PathTask(points, closed=part == 1.0)
        low, high = task.limits()
        if ((low <= design) & (design <= high))[:8].all():
            return task


def again(count: int, runs: int) -> None:
    found, seconds = 0, []
    for seed in range(runs):
        task = planted(seed, count)
        begin = time.perf_counter()
        best = path_four_bars(task, seed=seed)[0]
        seconds.append(time.perf_counter() - begin)
        found += best.greatest_error <= FOUND * task.size
    print(f"  {count:>4} points{found / runs:>12.0%}{statistics.median(seconds):>9.3f} s{max(seconds):>9.3f} s")


def run(runs: int = RUNS) -> None:
    path_four_bars(CASES[0].task, starts=1)
    print(f"  {runs} seeded runs a case, two threads; reached: within 1e-3 of the best value known (case 1: 1e-20)")
    print("  sum of squared errors           best       median        worst  reached  median      worst evaluations")
    for of in CASES:
        case(of, runs)
    print(f"\n  planted four-bars found again, to {FOUND:g} of the path's size")
    for count in (6, 12, 36, 120):
        again(count, min(runs, PLANTED))


if __name__ == "__main__":
    run(*map(int, sys.argv[1:]))
