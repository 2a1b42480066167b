"""Knot charts as indexed PNG: one pixel per knot, one palette entry per yarn.

The pHYs chunk has the knots per metre in both directions, so that viewers that use it show true proportions. Text
chunks have the title and, as JSON under `ilmek-chart`, yarns, size, quality and knot.
"""

import io
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from ilmek.arrays import Indices
from ilmek.carpet.chart import Chart
from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.errors import PictureError
from ilmek.io.picture_file import MeteredBytes, check_structure, pillow_settings, read_bytes
from ilmek.progress import SILENT, Progress
from ilmek.records import record

KEY = "ilmek-chart"
_CHUNKS = 1_000_000
"""Reads allowed of a chart: Pillow writes 64 kB in a chunk, and reads it in four pieces."""

_METRE = 0.0254
"""Metres per inch: Pillow takes dots per inch and writes dots per metre."""


@record
class ChartPicture:
    """Contents of a chart PNG: indices, yarn names and colours in their order; size [m], quality [knots/m], knot."""

    knots: Indices
    names: tuple[str, ...]
    srgb: tuple[tuple[int, int, int], ...]
    size: tuple[float, float]
    quality: tuple[float, float]
    knot: str


class _Counted(io.FileIO):
    """A file that is written with progress by the bytes written; `most` of them are expected."""

    def __init__(self, path: Path, most: int, progress: Progress) -> None:
        super().__init__(path, "w")
        self._most, self._progress = most, progress

    def write(self, data: Any, /) -> int:
        """As `io.FileIO.write`, but all of the data."""
        view = memoryview(data).cast("B")
        written = 0
        while written < len(view):
            written += super().write(view[written:])
        self._progress(min(1.0, self.tell() / self._most))
        return written


def chart_picture(chart: Chart) -> Image.Image:
    """The chart as a picture with a palette."""
    picture = Image.frombytes("P", (chart.columns, chart.rows), np.ascontiguousarray(chart.knots).tobytes())
    picture.putpalette([channel for yarn in chart.yarns for channel in yarn.srgb])
    return picture


def write_chart_png(path: Path, chart: Chart, progress: Progress = SILENT) -> None:
    """Write the chart to `path`."""
    facts = {
        "yarns": [{"name": yarn.name, "srgb": list(yarn.srgb)} for yarn in chart.yarns],
        "size": [chart.size.width, chart.size.length],
        "quality": [chart.quality.across, chart.quality.along],
        "knot": chart.knot,
    }
    info = PngInfo()
    info.add_text("Title", "Knot chart: one pixel one knot")
    info.add_text("Software", "ilmek")
    info.add_itxt(KEY, json.dumps(facts, ensure_ascii=False))
    dots = (chart.quality.across * _METRE, chart.quality.along * _METRE)
    with _Counted(path, chart.knots.size, progress) as file:
        chart_picture(chart).save(file, format="PNG", pnginfo=info, dpi=dots)


def read_chart_png(path: Path) -> ChartPicture:
    """Read a chart that `write_chart_png` wrote, of at most `carpet.design.MOST_KNOTS` knots.

    Raises PictureError for any other file.
    """
    data = read_bytes(path)
    try:
        with pillow_settings(MOST_KNOTS):
            check_structure(data)
            stream = MeteredBytes(data)
            stream.allow(_CHUNKS, 2 * len(data))
            with Image.open(stream, formats=("PNG",)) as picture:
                if picture.mode != "P":
                    raise ValueError("a chart has a palette")
                picture.load()
                facts = json.loads(str(getattr(picture, "text", {})[KEY]))
                return _chart(np.array(picture, dtype=np.uint8), facts)
    except MemoryError:
        raise
    except Exception as error:  # a decoder may raise any
        raise PictureError(f"{path} is no knot chart", allowed="a chart.png written by ilmek") from error


def _chart(knots: Indices, facts: dict[str, object]) -> ChartPicture:
    """The chart from the JSON of its text chunk. Raises KeyError, TypeError, IndexError or ValueError."""
    yarns, size, quality = facts["yarns"], facts["size"], facts["quality"]
    if not (isinstance(yarns, list) and isinstance(size, list) and isinstance(quality, list)):
        raise TypeError("yarns, size and quality are lists")
    if not int(knots.max()) < len(yarns) <= MOST_YARNS:
        raise ValueError("a knot without a yarn")
    colours = [yarn["srgb"] for yarn in yarns]
    if not all(0 <= channel <= 255 for colour in colours for channel in colour):
        raise ValueError("a colour out of bounds")
    if not all(0 < float(number) < math.inf for number in (*size, *quality)):
        raise ValueError("a size or quality out of bounds")
    return ChartPicture(
        knots,
        tuple(str(yarn["name"]) for yarn in yarns),
        tuple((int(red), int(green), int(blue)) for red, green, blue in colours),
        (float(size[0]), float(size[1])),
        (float(quality[0]), float(quality[1])),
        str(facts["knot"]),
    )
