"""A carpet of 20 million knots to a programme file: time, memory, size, the reading of a random row, and the order
of a slice by the same code in plain Python.

Limits: 10 s in all, 1 GB.
"""

import math
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.io.programme_file import open_programme, write_programme
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.operations import LoomSetup, OperationTimes
from ilmek.loom.programme import Programme, least_heads, make_programme
from ilmek.loom.times import Times

ROWS, COLUMNS, YARNS, HEADS = 5000, 4000, 16, 13
TIMES = Times(knot=2.0, colour_change=0.54, travel=0.0022, weft=12.0)
READS, PLAIN_ROWS = 2000, 10


def medallion(grain: float) -> Indices:
    """Rings of colour round the middle, each knot off by one colour with a probability `grain`."""
    rng = np.random.default_rng(7)
    knots = np.empty((ROWS, COLUMNS), np.uint8)
    x = (np.arange(COLUMNS) - COLUMNS / 2) / COLUMNS
    for first in range(0, ROWS, 250):
        y = (np.arange(first, first + 250) - ROWS / 2)[:, None] / ROWS
        rings = 40 * np.hypot(x, y) + 2 * np.sin(14 * np.arctan2(y, x))
        knots[first : first + 250] = (rings + (rng.random(rings.shape) < grain)) % YARNS
    return knots


def run() -> None:
    """Print the figures for a design with some grain and for one with much."""
    first()
    print(f"programme of {ROWS * COLUMNS / 1e6:.0f} million knots ({COLUMNS} x {ROWS}), {YARNS} yarns")
    for name, knots in (("medallion with grain", medallion(0.03)), ("medallion, much grain", medallion(0.2))):
        _measure(name, knots)


def _measure(name: str, knots: Indices) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "programme.ilmek"
        start = time.perf_counter()
        programme = ordered(knots)
        ordered_at = time.perf_counter()
        write_programme(path, CompiledProgramme(twenty_million(), programme))
        written = time.perf_counter()
        heads = least_heads(knots, YARNS, 1.3 * programme.duration, TIMES, HEADS)
        searched = time.perf_counter()
        size = path.stat().st_size
        row = _read(path)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
    part = np.ascontiguousarray(knots[-PLAIN_ROWS:])
    begun = time.perf_counter()
    ordered(part)
    compiled = time.perf_counter() - begun
    plain = _plain(part)
    over, below = programme.duration / programme.bound - 1, 1 - programme.duration / programme.naive.time
    ratio = plain / compiled
    print(f"  {name}: {programme.work.changes.sum() / knots.size:.3f} changes a knot")
    print(f"    weaving time at most {over:.3%} above the least of any order, {below:.1%} below the naive order")
    print(f"    order {ordered_at - start:.2f} s + file {written - ordered_at:.2f} s   (limit 10 s)")
    print(f"    order of {PLAIN_ROWS} rows {compiled:.3f} s; in plain Python {plain:.1f} s, {ratio:.0f} times that")
    print(f"    heads for a deadline: {heads}, found in {searched - written:.2f} s")
    print(f"    file {size / 1e6:.2f} MB   peak memory {memory / 1e9:.2f} GB (limit 1)")
    print(f"    random row {row * 1e6:.0f} us")


def _plain(knots: Indices) -> float:
    """Time [s] of the order of a chart by the same code in plain Python, without compiled kernels."""
    script = "import sys, numpy as np, time, bench_programme as b; knots = np.load(sys.argv[1]); b.first()\n"
    script += "start = time.perf_counter(); b.ordered(knots); print(time.perf_counter() - start)"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "knots.npy"
        np.save(path, knots)
        paths = os.pathsep.join((str(Path(__file__).parent), *sys.path))
        done = subprocess.run(
            [sys.executable, "-c", script, str(path)],
            env={**os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": paths},
            capture_output=True,
            check=True,
            text=True,
        )
    return float(done.stdout)


def first() -> None:
    """Load all kernels."""
    make_programme(np.zeros((2, 8), np.uint8), 2, 2, TIMES)


def ordered(knots: Indices) -> Programme:
    """The programme of a chart."""
    return make_programme(knots, YARNS, HEADS, TIMES)


def twenty_million(rows: int = ROWS, columns: int = COLUMNS, heads: int = HEADS) -> LoomSetup:
    """The loom and the carpet, or one of other numbers."""
    return LoomSetup(
        loom="0" * 64,
        size=CarpetSize(columns / 1800, rows / 1800),
        quality=Quality(1800.0, 1800.0),
        knot="symmetric",
        yarns=tuple(Yarn(f"yarn {k}", (k, k, k), (0.0, 0.0, 0.0), 2.5, 2) for k in range(YARNS)),
        warp_pitch=0.5 / 1800,
        rows=rows,
        columns=columns,
        heads=heads,
        tubes=YARNS,
        spacing=100,
        times=OperationTimes(TIMES.knot, TIMES.colour_change, TIMES.travel, (3.0, 5.0, 8.0, 10.0, TIMES.weft), 60.0),
        loading=np.tile(np.arange(YARNS, dtype=np.uint8), (heads, 1)),
        packages=np.full((heads, YARNS), 1e5),
        knot_yarn=(0.03,) * YARNS,
    )


def _read(path: Path) -> float:
    """Mean time of a random row [s]; the best of three rounds."""
    numbers = np.random.default_rng(1).integers(0, ROWS, READS).tolist()
    best = math.inf
    with open_programme(path) as programme:
        for _ in range(3):
            start = time.perf_counter()
            for number in numbers:
                programme.operations(number)
            best = min(best, (time.perf_counter() - start) / READS)
    return best


if __name__ == "__main__":
    run()
