"""The twin over whole carpets: knots a second, many seeds, memory; SimPy's processes on the same events beside it.

Limits: 10^6 knots a second; 20 million knots in 20 s; 1,000 seeds of a carpet of 135,000 knots in 30 s; memory flat
over 30 days of the loom.
"""

import resource
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.bench_programme import COLUMNS, HEADS, ROWS, TIMES, YARNS, medallion, twenty_million
from benchmarks.simpy_twin import SimpyTwin
from ilmek.arrays import UInt8
from ilmek.io.programme_file import open_programme, write_programme
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.operations import LoomProgramme, RowOperations
from ilmek.loom.programme import make_programme
from ilmek.loom.twin.carpet_run import run_carpet
from ilmek.loom.twin.faults import StopParams, fault_table
from ilmek.loom.twin.seed_runs import run_seeds

SEEDS = 1000
"""Runs of the carpet of 135,000 knots."""

SMALL, WIDE = (450, 300, 4), (100, 4000, 13)
"""Rows, columns and heads of that carpet, and of one with long rows."""

DAY = 86_400e9


class Rows:
    """The first rows and columns of a programme with its rows in memory, again and again up to a number of rows."""

    digest = ""

    def __init__(self, programme: LoomProgramme, rows: int, read: int) -> None:
        self.setup = replace(programme.setup, rows=rows)
        self._rows = [programme.operations(number) for number in range(read)]

    def operations(self, number: int) -> RowOperations:
        return replace(self._rows[number % len(self._rows)], number=number)

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        """No chart: the twin does not read it."""
        raise IndexError(number)


def memory() -> float:
    """Peak memory of this process [MB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024) / 1e6


def run() -> None:
    small, wide = _carpet(*SMALL), _carpet(*WIDE)
    table = fault_table(StopParams(), small.setup)
    run_carpet(small, table, 0)
    run_seeds(small, table, range(3))
    _beside_simpy(small)
    _beside_simpy(wide)
    start = time.perf_counter()
    run_seeds(small, table, range(SEEDS))
    print(f"{SEEDS:,} seeds of {small.setup.knots:,} knots: {time.perf_counter() - start:.2f} s of one core (limit 30)")
    _large()
    _days(small)


def _carpet(rows: int, columns: int, heads: int) -> Rows:
    knots = np.ascontiguousarray(medallion(0.03)[:rows, :columns])
    programme = make_programme(knots, YARNS, heads, TIMES)
    return Rows(CompiledProgramme(twenty_million(rows, columns, heads), programme), rows, rows)


def _beside_simpy(small: Rows) -> None:
    table = fault_table(StopParams(), small.setup)
    start = time.process_time()
    ours = run_carpet(small, table, 1)
    middle = time.process_time()
    theirs = SimpyTwin(small, table, 1)
    end = time.process_time()
    assert theirs.time == ours.time
    rates = [small.setup.knots / 1e6 / taken for taken in (middle - start, end - middle)]
    shape = f"{small.setup.rows:,} rows of {small.setup.columns:,} knots, {small.setup.heads} heads"
    print(f"{shape}, {len(ours.faults)} faults, with the digest of all events:")
    print(
        f"  twin {rates[0]:.2f} million knots a second, SimPy {rates[1]:.3f}: {rates[0] / rates[1]:.0f} times as long"
    )


def _large() -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "programme.ilmek"
        programme = make_programme(medallion(0.03), YARNS, HEADS, TIMES)
        write_programme(path, CompiledProgramme(twenty_million(ROWS, COLUMNS, HEADS), programme))
        start = time.perf_counter()
        with open_programme(path) as file:
            opened = time.perf_counter()
            found = run_carpet(file, fault_table(StopParams(), file.setup), 1)
            woven = time.perf_counter()
    print(f"{found.knots / 1e6:.0f} million knots of a file: read and checked {opened - start:.1f} s, ", end="")
    print(f"woven {woven - opened:.1f} s, {found.knots / 1e6 / (woven - opened):.1f} million a second (limit 20 s)")


def _days(small: Rows) -> None:
    """Peak memory before and after 30 days of the loom, row after row."""
    table = fault_table(StopParams(), small.setup)
    days = 30 * DAY
    one = run_carpet(small, table, 1).time
    many = Rows(small, round(small.setup.rows * days / one), small.setup.rows)
    before = memory()
    found = run_carpet(many, table, 1)
    print(f"{found.time / DAY:.1f} days, {found.knots / 1e6:.1f} million knots: memory +{memory() - before:.1f} MB")


if __name__ == "__main__":
    run()
