"""Pages and the picture of the carpet: time and size of carpet.png and report.html, beside an upscaled chart.

Where a Chromium is installed, the height of the page at 1,400 px and the width that it needs at 390 px, too; and the
pages of all machines: where their checks begin, what lies outside a phone's screen, errors in 500 loads.
"""

import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks import machine_pages
from benchmarks.bench_rows import chart_of_runs
from benchmarks.browser import Browser, installed
from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart
from ilmek.carpet.statistics import chart_statistics
from ilmek.carpet.usual_pile import with_counts
from ilmek.jobs.carpet_report import page_of
from ilmek.viz.carpet_page import carpet_page
from ilmek.viz.carpet_picture import draw_carpet

KINDS = {"135,000 knots": (450, 300), "2.2 M knots": (1800, 1200), "20 M knots": (5440, 3680)}


def run() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "carpet.png")
        draw_carpet(chart_of_runs(30, 20, 0.3))  # compiles the kernels
        print(f"{'carpet.png of 4 MP':<18} {'s':>7} {'MB':>7} {'chart upscaled by Pillow, s':>28}")
        for name, grid in KINDS.items():
            chart = chart_of_runs(*grid, 0.09)
            seconds = timed(write_carpet, path, chart, 1600)
            peer = timed(upscaled, path.with_name("peer.png"), chart, 1600)
            print(f"{name:<18} {seconds:7.2f} {path.stat().st_size / 1e6:7.1f} {peer:28.2f}")
        print(f"{'report.html':<18} {'s':>7} {'MB':>7} {'px high at 1,400':>17} {'px wide at 390':>15}")
        for name, grid in KINDS.items():
            chart = chart_of_runs(*grid, 0.09)
            page = Path(folder, "report.html")
            seconds = timed(write_page, page, chart)
            measured = f"{measure(page, 1400)[0]:17} {measure(page, 390)[1]:15}" if installed() else ""
            print(f"{name:<18} {seconds:7.2f} {page.stat().st_size / 1e6:7.1f} {measured}")
        if installed():
            machine_pages.measure(Path(folder))


def write_carpet(path: Path, chart: Chart, width: int) -> None:
    """Draw the carpet and write it as PNG."""
    draw_carpet(chart, width).write_png(path)


def timed(work: Callable[..., None], *arguments: object) -> float:
    """Seconds of a function."""
    start = time.perf_counter()
    work(*arguments)
    return time.perf_counter() - start


def upscaled(path: Path, chart: Chart, width: int) -> None:
    """The chart's colours at a width, as a plain picture."""
    palette = np.array([yarn.srgb for yarn in chart.yarns], dtype=np.uint8)
    picture = Image.fromarray(palette[chart.knots])
    picture.resize((width, width * chart.rows // chart.columns), Image.Resampling.BICUBIC).save(path)


def write_page(path: Path, chart: Chart) -> None:
    """The page of a chart, its yarns with the usual counts."""
    chart = replace(chart, yarns=with_counts(chart.yarns, chart.quality, chart.knot))
    source = np.array([yarn.srgb for yarn in chart.yarns], dtype=np.uint8)[chart.knots[::8, ::8]]
    path.write_text(
        carpet_page(
            page_of(
                "carpet", chart, yarn_bill(chart), ("chart.png",), statistics=chart_statistics(chart), source=source
            )
        ),
        encoding="utf-8",
    )


def measure(page: Path, width: int) -> tuple[int, int]:
    """Height and width that a page needs in a window of a width [px]."""
    with Browser() as browser:
        root = browser.open(page, width, 900, phone=width < 500)
        return root.evaluate("document.documentElement.scrollHeight"), root.evaluate(
            "document.documentElement.scrollWidth"
        )


if __name__ == "__main__":
    run()
