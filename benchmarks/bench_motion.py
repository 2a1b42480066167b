"""Motions: tasks of three and four poses with limits that a planted four-bar fulfils with 5 to 10 % of slack.

None may come back empty, and every answer is judged again against every limit; processor time of each search.
"""

import time
from collections import Counter

import numpy as np

from benchmarks.planted_motion import planted_motion
from ilmek.machines.motion_four_bar import MotionFourBarParams, design

TASKS = 150
"""Tasks of three poses, and of four."""


def run() -> None:
    for poses in (3, 4):
        report(poses, range(TASKS))


def report(poses: int, seeds: range) -> None:
    """Search every planted task and print what was found."""
    design(MotionFourBarParams.read(planted_motion(0, poses).settings))
    taken, counts, certified, transmission = [], Counter[int](), 0, []
    empty = []
    for seed in seeds:
        planted = planted_motion(seed, poses)
        started = time.process_time()
        made = design(MotionFourBarParams.read(planted.settings))
        taken.append(time.process_time() - started)
        kept = made.choice.kept
        counts[len(kept)] += 1
        certified += sum(one.certified for one in kept)
        if kept:
            transmission.append(kept[0].candidate.least_transmission)
        else:
            empty.append(seed)
    total = sum(number * count for number, count in counts.items())
    print(f"{poses} poses, {len(seeds)} planted tasks: {len(empty)} without answer {empty}")
    print(f"  answers {dict(sorted(counts.items()))}; proven {certified} of {total}")
    print(f"  {np.median(taken):.2f} s of processor time, at most {max(taken):.2f} s")
