"""Rows to weave by: rows.txt of 20 million knots, and rows.pdf, beside plain Python.

The charts have random runs of 11 knots on average, as a drawn carpet, and of 2 knots, as a dithered photograph.
"""

import itertools
import resource
import tempfile
import time
from pathlib import Path

import numpy as np

from benchmarks.bench_chart import wool
from benchmarks.rows_reading import read_rows
from ilmek.carpet.chart import Chart
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.io.chart.rows_pdf import chart_rows_layout, write_rows_pdf
from ilmek.io.chart.rows_text import write_rows_text
from ilmek.io.chart.symbols import symbols


def chart_of_runs(rows: int, columns: int, share: float) -> Chart:
    """A chart of which `share` of the knots begin a run."""
    rng = np.random.default_rng(1)
    begins = rng.random((rows, columns), dtype=np.float32) < share
    begins[:, 0] = True
    at = np.maximum.accumulate(np.where(begins, np.arange(columns, dtype=np.int32), 0), axis=1)
    knots = np.take_along_axis(rng.integers(0, 16, (rows, columns), dtype=np.uint8), at, axis=1)
    quality = Quality(1000.0, 1000.0)
    return Chart(knots, wool(), CarpetSize(columns / 1000, rows / 1000), quality, "symmetric")


def plain_python(chart: Chart, rows: int) -> float:
    """Time of the runs of some rows in both directions by itertools, for the whole chart."""
    signs = symbols(chart.yarns)
    start = time.perf_counter()
    for row in chart.knots[:rows].tolist():
        runs = [f"{len(list(group))}{signs[yarn]}" for yarn, group in itertools.groupby(row)]
        f"{' '.join(runs)}\n{' '.join(reversed(runs))}\n".encode()
    return (time.perf_counter() - start) * chart.rows / rows


def run() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "rows.txt")
        write_rows_text(path, chart_of_runs(10, 10, 0.5), "runs")  # compiles the kernels
        write_rows_text(path, chart_of_runs(10, 10, 0.5), "colours")
        print(f"{'20 M knots, both directions':<36} {'s':>7} {'MB':>7} {'plain Python, s':>16}")
        for share, split in itertools.product((0.09, 0.5), ("runs", "colours")):
            chart = chart_of_runs(5000, 4000, share)
            start = time.perf_counter()
            write_rows_text(path, chart, split)
            seconds, size = time.perf_counter() - start, path.stat().st_size / 1e6
            peer = f"{plain_python(chart, 250):16.1f}" if split == "runs" else ""
            print(f"{f'rows.txt by {split}, runs of {1 / share:.0f} knots':<36} {seconds:7.2f} {size:7.1f} {peer}")
        chart = chart_of_runs(450, 300, 0.09)
        write_rows_text(path, chart, "runs")
        start = time.perf_counter()
        assert np.array_equal(read_rows(path).knots, chart.knots)
        print(f"{'135,000 knots read back':<36} {time.perf_counter() - start:7.2f}")
        start = time.perf_counter()
        write_rows_pdf(Path(folder, "rows.pdf"), chart)
        seconds, size = time.perf_counter() - start, Path(folder, "rows.pdf").stat().st_size / 1e6
        print(f"{f'rows.pdf, {chart_rows_layout(chart).count} pages of 135,000 knots':<36} {seconds:7.2f} {size:7.1f}")
    print(f"largest memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3:.0f} MB")


if __name__ == "__main__":
    run()
