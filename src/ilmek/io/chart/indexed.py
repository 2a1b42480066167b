"""Knot charts as indexed BMP and TIFF, as carpet CAD programs pass them: one pixel one knot.

The index of a pixel is the position of its yarn in the creel; the last one has no yarn: plain ground.

Only the colours and, as pixels per metre, the quality are in the file; chart.png and chart.oxs have everything.
"""

from pathlib import Path

import numpy as np

from ilmek.carpet.cells import GROUND_COLOUR
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import CODES, NO_KNOT, recoded
from ilmek.errors import CarpetError
from ilmek.io.chart.png import CountedFile, chart_picture
from ilmek.io.picture import METRE
from ilmek.progress import SILENT, Progress


def write_chart_bmp(path: Path, chart: Chart, progress: Progress = SILENT) -> None:
    """Write the chart to `path` as BMP, 8 bits a knot."""
    _write(path, chart, progress, "BMP")


def write_chart_tiff(path: Path, chart: Chart, progress: Progress = SILENT) -> None:
    """Write the chart to `path` as TIFF, 8 bits a knot, without compression."""
    _write(path, chart, progress, "TIFF")


def _write(path: Path, chart: Chart, progress: Progress, kind: str) -> None:
    positions = chart.positions
    table = np.full(CODES, NO_KNOT, dtype=np.uint8)  # position of each code
    table[: len(positions)] = positions
    knots = recoded(chart.knots, table)
    bare = NO_KNOT in chart.knots
    if bare and NO_KNOT in positions:
        last = f"the last position of the creel, {NO_KNOT}, which the cells without a knot have"
        given = f"--{kind.lower()}: a yarn has {last}"
        raise CarpetError(given, do="give it another position")
    palette = np.zeros((CODES if bare else max(positions) + 1, 3), dtype=np.uint8)
    palette[-1] = GROUND_COLOUR
    palette[list(positions)] = [yarn.srgb for yarn in chart.yarns]
    dots = (chart.quality.across * METRE, chart.quality.along * METRE)
    with CountedFile(path, chart.knots.size, progress) as file:
        chart_picture(knots, palette).save(file, format=kind, dpi=dots)
