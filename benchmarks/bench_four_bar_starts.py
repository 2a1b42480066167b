"""Start solutions of complete four-bar synthesis, computed from scratch by monodromy: counts and times.

With a file name after `python -m benchmarks.bench_four_bar_starts` the solutions are written there; its SHA-256 goes
into `ilmek.synthesis.alt_burmester.start_sets`.
"""

import hashlib
import sys
import time
from pathlib import Path

from ilmek.synthesis.alt_burmester.start_sets import CLASSES, SEED, computed_start_set, written


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
