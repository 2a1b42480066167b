"""Pages and the picture of the carpet: time and size of carpet.png and report.html, beside an upscaled chart.

Where a Chromium is installed, the height of the page at 1,400 px and the width that it needs at 500 px, too.
"""

import re
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks.bench_rows import chart_of_runs
from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart
from ilmek.carpet.statistics import chart_statistics
from ilmek.carpet.usual_pile import with_counts
from ilmek.jobs.carpet_report import page_of
from ilmek.viz.carpet_page import carpet_page
from ilmek.viz.carpet_picture import draw_carpet

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
MEASURE = "<script>onload=()=>document.title=`${root.scrollHeight} ${root.scrollWidth}`</script>"
KINDS = {"135,000 knots": (450, 300), "2.2 M knots": (1800, 1200), "20 M knots": (5440, 3680)}


def run() -> None:
    """Print the table."""
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "carpet.png")
        draw_carpet(chart_of_runs(30, 20, 0.3))  # compiles the kernels
        print(f"{'carpet.png of 4 MP':<18} {'s':>7} {'MB':>7} {'chart upscaled by Pillow, s':>28}")
        for name, grid in KINDS.items():
            chart = chart_of_runs(*grid, 0.09)
            seconds = timed(write_carpet, path, chart, 1600)
            peer = timed(upscaled, path.with_name("peer.png"), chart, 1600)
            print(f"{name:<18} {seconds:7.2f} {path.stat().st_size / 1e6:7.1f} {peer:28.2f}")
        print(f"{'report.html':<18} {'s':>7} {'MB':>7} {'px high at 1,400':>17} {'px wide at 500':>15}")
        for name, grid in KINDS.items():
            chart = chart_of_runs(*grid, 0.09)
            page = Path(folder, "report.html")
            seconds = timed(write_page, page, chart)
            measured = (
                "" if browser is None else f"{measure(browser, page, 1400)[0]:17} {measure(browser, page, 500)[1]:15}"
            )
            print(f"{name:<18} {seconds:7.2f} {page.stat().st_size / 1e6:7.1f} {measured}")


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


def measure(browser: str, page: Path, width: int) -> tuple[int, int]:
    """Height and width that a page needs in a window of a width [px]."""
    marked = page.with_name("marked.html")
    text = page.read_text(encoding="utf-8").replace("<html ", "<html id=root ", 1)
    marked.write_text(text.replace("<head>", f"<head>{MEASURE}", 1), encoding="utf-8")
    with tempfile.TemporaryDirectory() as profile:
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--user-data-dir={profile}"]
        options += [f"--window-size={width},900", "--virtual-time-budget=3000", "--dump-dom", marked.as_uri()]
        shown = subprocess.run([browser, *options], capture_output=True, text=True, check=True).stdout
    found = re.search(r"<title>(\d+) (\d+)</title>", shown)
    assert found, "the page did not load"
    return int(found[1]), int(found[2])


if __name__ == "__main__":
    run()
