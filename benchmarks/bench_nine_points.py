"""Complete synthesis of four-bars: planted four-bars found again from nine points, and from poses and points.

A planted four-bar counts as found where it is among the answers (pins to 1e-7 of the path's size) and its cognates too.
"""

import statistics
import sys
import time

import numpy as np

from ilmek.errors import MechanismError
from ilmek.synthesis.alt_burmester.defects import best_drive
from ilmek.synthesis.alt_burmester.four_bars import complete_four_bars
from ilmek.synthesis.alt_burmester.start_sets import start_set
from ilmek.synthesis.alt_burmester.task import FOUR_BARS, PosesAndPoints
from ilmek.synthesis.circuit_loops import circuit_loops
from ilmek.synthesis.cognates import cognates
from ilmek.synthesis.four_bar import FourBar, LinkLengths, from_lengths

PLANTED = 50


def planted(seed: int, poses: int) -> tuple[FourBar, PosesAndPoints]:
    """A random four-bar and positions in order on one of its circuits, at least 0.1 rad of its parameter apart."""
    rng, count = np.random.default_rng([seed, poses]), 10 - poses
    while True:
        try:
            links, tracer = LinkLengths(*rng.uniform(0.03, 0.2, 4)), complex(*rng.normal(size=2)) / 10
            made = from_lengths(links, rng.uniform(0, 6), branch=+1, tracer=tracer)
        except MechanismError:
            continue
        u = np.sort(rng.uniform(0, 2 * np.pi, count))
        if np.diff(np.r_[u, u[0] + 2 * np.pi]).min() > 0.1:
            break
    at = circuit_loops(made)[0].at(u)
    angles = np.full(count, np.nan)
    if poses > 1:
        known = rng.permutation(count)[:poses]
        angles[known] = np.angle(at.coupler)[known]
    return FourBar(made.a0, made.b0, at.a[0], at.b[0], at.tracer[0]), PosesAndPoints(at.tracer, angles)


def among(one: FourBar, answers: list[FourBar], tolerance: float) -> bool:
    """Whether a four-bar is among others, in either direction."""
    pins = np.array([one.a0, one.a, one.b0, one.b])
    both = [(other, other.reversed()) for other in answers]
    listed = np.array([[drawn.a0, drawn.a, drawn.b0, drawn.b] for pair in both for drawn in pair])
    return bool(len(listed)) and float(np.abs(listed - pins).max(axis=1).min()) < tolerance


def campaign(poses: int, runs: int) -> None:
    found = whole = certified = real = usable = 0
    seconds, processor, distances, counts = [], [], [], []
    for seed in range(runs):
        drawn, task = planted(seed, poses)
        begin, before = time.perf_counter(), time.process_time()
        answer = complete_four_bars(task)
        drives = [best_drive(one, task.points) for one in answer.found]
        seconds.append(time.perf_counter() - begin)
        processor.append(time.process_time() - before)
        near, answers = 1e-7 * task.size, [one.four_bar for one in answer.found]
        family = [one for one in cognates(drawn)[:3] if isinstance(one, FourBar)] if poses == 1 else [drawn]
        found += all(among(one, answers, near * (1 + max(one.lengths) / task.size)) for one in family)
        whole += answer.complete
        counts.append(len(answer.found))
        real += len(answer.found)
        certified += sum(one.certified for one in answer.found)
        usable += sum(defect is None for _, defect in drives)
        distances += [one.distance / task.size for one in answer.found]
    print(
        f"{poses:>6}{10 - 2 * poses:>7}{found / runs:>8.0%}{whole / runs:>9.0%}{certified / max(real, 1):>11.2%}"
        f"{statistics.median(counts):>7g}{max(counts):>5}{usable / runs:>8.1f}{np.nanmax(distances):>10.1e}"
        f"{statistics.median(seconds):>9.3f} s{max(seconds):>7.3f} s{statistics.median(processor):>8.3f} s",
        flush=True,
    )


def run(runs: int = PLANTED) -> None:
    for poses in (1, 2, 3, 4, 5):
        start_set(poses)
    print(f"  {runs} planted four-bars of each kind; found: with cognates; usable: without defects; two threads")
    print("  distance: greatest one within which the exact pins lie, in sizes of the task")
    print(" poses points  found complete  certified   real  most  usable  distance   median   worst  processor")
    for poses, _ in FOUR_BARS:
        campaign(poses, runs)


if __name__ == "__main__":
    run(*map(int, sys.argv[1:]))
