"""The write protocol: the whole job on the shipped picture with syncs, manifest and marks, beside the same without."""

import contextlib
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from statistics import median
from typing import Any
from unittest.mock import patch

from ilmek.io.output import Outputs, disk, manifest
from ilmek.io.output.target import Target
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import read_order
from ilmek.jobs.weave import weave

PICTURE = Path(__file__).parents[1] / "examples" / "medallion.png"
RUNS = 9


@contextlib.contextmanager
def careless() -> Iterator[None]:
    """Nothing is synced, listed, marked or compared."""
    with (
        patch.object(disk, "sync", lambda *_: None),
        patch.object(manifest, "finish", lambda _: None),
        patch.object(manifest, "mark", lambda _: None),
        patch.object(manifest, "foreign", lambda _: []),
    ):
        yield


@contextlib.contextmanager
def timed() -> Iterator[list[float]]:
    """The times in the calls of the protocol: on a busy machine the only comparison that means anything."""
    times: list[float] = []

    def wrap(function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any) -> Any:
            begin = time.perf_counter()
            value = function(*arguments)
            times.append(time.perf_counter() - begin)
            return value

        return call

    with (
        patch.object(Outputs, "expect_folder", wrap(Outputs.expect_folder)),
        patch.object(Outputs, "commit", wrap(Outputs.commit)),
        patch.object(Target, "stage", wrap(Target.stage)),
    ):
        yield times


def seconds(folder: Path) -> float:
    """Wall time of one job, over its old result."""
    order = read_order(picture=PICTURE, size="seccade", quality="25x25/dm")
    begin = time.perf_counter()
    weave(order, read_loom_order(order), folder, force=True)
    return time.perf_counter() - begin


def run() -> None:
    """Print the times of both, in turn, and their ratio."""
    with tempfile.TemporaryDirectory(dir=Path.cwd()) as folder:
        careful, plain = Path(folder) / "careful", Path(folder) / "plain"
        seconds(careful)  # compiles, and makes the old results
        seconds(plain)
        times: tuple[list[float], list[float]] = ([], [])
        shares: list[float] = []
        for _ in range(RUNS):
            with timed() as inside:
                times[0].append(seconds(careful))
            shares.append(sum(inside) / times[0][-1])
            with careless():
                times[1].append(seconds(plain))
    protocol, without = min(times[0]), min(times[1])
    print(f"weave, with the write protocol    {protocol:6.3f} s")
    print(f"weave, neither synced nor listed  {without:6.3f} s")
    print(f"ratio                             {protocol / without:6.3f}    (limit 1.05)")
    print(f"share of the calls, median        {median(shares):6.3f}    (limit 0.05)")
