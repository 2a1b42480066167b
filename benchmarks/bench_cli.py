"""The command line from a shell: start of the program, and the whole arc on the shipped picture."""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]
WEAVE = ["weave", "examples/medallion.png", "--size", "seccade", "--quality", "25x25/dm", "--force", "--out"]


def seconds(arguments: list[str], cache: str | None = None, module: str = "ilmek") -> float:
    """Wall time of one run of a module; `cache` is the folder for compiled kernels."""
    environment = dict(os.environ, **({"XDG_CACHE_HOME": cache} if cache else {}))
    begin = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", module, *arguments], cwd=ROOT, env=environment, check=True, capture_output=True
    )
    return time.perf_counter() - begin


def processor_seconds(arguments: list[str]) -> float:
    """Processor time of one run, of the user and the system, with warm caches."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds(arguments)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def run() -> None:
    """Print the times."""
    print(f"ilmek --help          {min(seconds(['--help']) for _ in range(5)):6.2f} s   (limit 0.4)")
    listed = min(processor_seconds(["machines"]) for _ in range(5))
    print(f"ilmek machines        {listed:6.2f} s   (of processor; limit 0.3)")
    for name in ("tufting_needle", "jansen_leg", "quick_return", "class_three"):
        file = ["mechanism", f"examples/{name}.toml"]
        moved = min(processor_seconds(file) for _ in range(5))
        print(f"ilmek mechanism       {moved:6.2f} s   (of processor; limit 0.6) {name}")
    with tempfile.TemporaryDirectory() as folder:
        out = str(Path(folder) / "out")
        print(f"ilmek.jobs.warm       {seconds([], folder, 'ilmek.jobs.warm'):6.2f} s   (once, after installing)")
        print(f"ilmek weave           {min(seconds([*WEAVE, out], folder) for _ in range(3)):6.2f} s   (limit 6)")
