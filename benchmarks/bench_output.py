"""The write protocol: the whole job on the shipped picture with syncs, manifest and marks, beside the same without."""

import contextlib
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch

from ilmek.io.output import disk, manifest
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
        for _ in range(RUNS):
            times[0].append(seconds(careful))
            with careless():
                times[1].append(seconds(plain))
    protocol, without = min(times[0]), min(times[1])
    print(f"weave, with the write protocol    {protocol:6.3f} s")
    print(f"weave, neither synced nor listed  {without:6.3f} s")
    print(f"ratio                             {protocol / without:6.3f}    (limit 1.05)")
