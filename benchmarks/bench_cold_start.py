"""Processor time of short commands from a shell, as ratios to `python -c "import numpy"`.

A ratio holds on any machine: importing numpy takes about 0.2 s of processor time on the one the limits were set on.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
RUNS = 5
COMMANDS = {
    "ilmek machines": (["machines"], 1.5),
    "ilmek design warp-tension --json -": (["design", "warp-tension", "--json", "-"], 2.5),
    "ilmek knot PATH.csv --json -": (["knot", "examples/gripper_path.csv", "--json", "-"], 1.5),
    "ilmek weave PICTURE": (["weave", "examples/medallion.png", "--quality", "25x25/dm", "--force", "--out"], 20.0),
}
"""Arguments and greatest ratio of each command."""


def seconds(arguments: list[str]) -> float:
    """Least processor time of a run of Python [s]."""

    def once() -> float:
        before = os.times()
        subprocess.run([sys.executable, *arguments], cwd=ROOT, check=True, capture_output=True)
        after = os.times()
        return after.children_user + after.children_system - before.children_user - before.children_system

    return min(once() for _ in range(RUNS))


def run() -> None:
    """Print the times and ratios."""
    numpy = seconds(["-c", "import numpy"])
    print(f"{'import numpy':36s} {numpy:6.3f} s")
    with tempfile.TemporaryDirectory() as folder:
        for name, (arguments, limit) in COMMANDS.items():
            out = [str(Path(folder) / "out")] if arguments[-1] == "--out" else []
            took = seconds(["-m", "ilmek", *arguments, *out])
            print(f"{name:36s} {took:6.3f} s   {took / numpy:5.2f} times numpy   (limit {limit:g})")
