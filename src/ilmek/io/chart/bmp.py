"""Knot charts as indexed BMP, as carpet CAD programs pass them: one pixel one knot, whose index is the position of its
yarn in the creel.

Only the colours and, as pixels per metre, the quality are in the file; chart.png and chart.oxs have everything.
"""

from pathlib import Path

import numpy as np

from ilmek.carpet.chart import Chart
from ilmek.io.chart.png import CountedFile, chart_picture
from ilmek.io.picture import METRE
from ilmek.progress import SILENT, Progress


def write_chart_bmp(path: Path, chart: Chart, progress: Progress = SILENT) -> None:
    """Write the chart to `path`, 8 bits a knot."""
    positions = np.array(chart.positions, dtype=np.uint8)
    palette = np.zeros((max(chart.positions) + 1, 3), dtype=np.uint8)
    palette[positions] = [yarn.srgb for yarn in chart.yarns]
    knots = chart.knots if chart.creel is None else positions[chart.knots]
    dots = (chart.quality.across * METRE, chart.quality.along * METRE)
    with CountedFile(path, chart.knots.size, progress) as file:
        chart_picture(knots, palette).save(file, format="BMP", dpi=dots)
