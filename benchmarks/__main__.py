"""Run the benchmarks: all of them, or those named. Each has a process of its own, so that memory is its own too."""

import importlib
import subprocess
import sys
from pathlib import Path

NAMES = sorted(path.stem.removeprefix("bench_") for path in Path(__file__).parent.glob("bench_*.py"))


def main(wanted: list[str]) -> None:
    unknown = [name for name in wanted if name not in NAMES]
    if unknown:
        sys.exit(f"unknown benchmark {unknown[0]!r}; there are: {', '.join(NAMES)}")
    if len(wanted) == 1:
        print(f"\n== {wanted[0]}", flush=True)
        importlib.import_module(f"benchmarks.bench_{wanted[0]}").run()
        return
    for name in wanted or NAMES:
        subprocess.run([sys.executable, "-m", "benchmarks", name], check=True)


if __name__ == "__main__":
    main(sys.argv[1:])
