"""Start solutions of complete four-bar synthesis, computed from scratch by monodromy: counts and times.

With a file name after `python -m benchmarks.bench_four_bar_starts` the solutions are written there; its SHA-256 goes
into `ilmek.synthesis.alt_burmester.start_sets`.
"""

import hashlib
import io
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.monodromy import all_solutions, task_with_solution
from ilmek.synthesis.alt_burmester.homotopy import SolvedTask
from ilmek.synthesis.alt_burmester.start_sets import CLASSES, pose_mask

SEED = 1
"""Of the random tasks that the shipped solutions belong to."""


def computed_start_set(poses: int, seed: int = SEED) -> SolvedTask:
    """The solutions for a number of poses, computed anew: 1 to 40 s."""
    pose = pose_mask(poses)
    return all_solutions(task_with_solution(np.random.default_rng([seed, poses]), pose), seed)


def written(sets: dict[int, SolvedTask]) -> bytes:
    """The file of the solutions, by the number of poses."""
    arrays: dict[str, Any] = {f"task{poses}": one.task for poses, one in sets.items()}
    arrays |= {f"unknowns{poses}": one.unknowns.astype(np.complex64) for poses, one in sets.items()}
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


def run(target: str = "", seed: int = SEED) -> None:
    print("  poses  points  solutions  of the literature       time")
    sets = {}
    for poses, known in CLASSES.items():
        begin = time.perf_counter()
        sets[poses] = computed_start_set(poses, seed)
        seconds = time.perf_counter() - begin
        print(f"{poses:>7}{10 - 2 * poses:>8}{len(sets[poses].unknowns):>11}{known:>19}{seconds:>9.1f} s", flush=True)
    if target:
        content = written(sets)
        Path(target).write_bytes(content)
        print(f"  {len(content)} bytes, SHA-256 {hashlib.sha256(content).hexdigest()}")


if __name__ == "__main__":
    run(sys.argv[1] if sys.argv[1:] else "", int(sys.argv[2]) if sys.argv[2:] else SEED)
