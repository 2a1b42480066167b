"""Knot charts as indexed BMP, as carpet CAD programs pass them: one pixel one knot, the palette in the yarns' order.

Only the colours and, as pixels per metre, the quality are in the file; chart.png and chart.oxs have everything.
"""

from pathlib import Path

from ilmek.carpet.chart import Chart
from ilmek.io.chart.png import CountedFile, chart_picture
from ilmek.io.picture import METRE
from ilmek.progress import SILENT, Progress


def write_chart_bmp(path: Path, chart: Chart, progress: Progress = SILENT) -> None:
    """Write the chart to `path`, 8 bits a knot."""
    dots = (chart.quality.across * METRE, chart.quality.along * METRE)
    with CountedFile(path, chart.knots.size, progress) as file:
        chart_picture(chart).save(file, format="BMP", dpi=dots)
