"""Knot charts as indexed PNG: one pixel per cell, one palette entry per yarn; a cell without a knot has the last entry,
which is transparent.

The pHYs chunk has the knots per metre in both directions, so that viewers that use it show true proportions. Text
chunks have the title, as JSON under `ilmek-chart` all facts of the chart (`carpet_facts`), and under `ilmek-overlay`
its half knots and jufti knots (`overlay_text`), under `ilmek-cells` its map of cells (`cells_text`).
"""

import io
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, UnidentifiedImageError
from PIL.PngImagePlugin import PngInfo

from ilmek.arrays import Indices
from ilmek.carpet.cells import CellMap
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.yarn import Yarn
from ilmek.errors import PictureError
from ilmek.io.carpet_facts import chart_facts, chart_of_facts, read_facts
from ilmek.io.cells_text import cells_text, read_cells
from ilmek.io.overlay_text import overlay_text, read_overlay
from ilmek.io.picture import METRE
from ilmek.io.picture_file import DamagedError, MeteredBytes, check_structure, pillow_settings, read_bytes, shortened
from ilmek.progress import SILENT, Cancelled, Progress

KEY, OVERLAY_KEY, CELLS_KEY = "ilmek-chart", "ilmek-overlay", "ilmek-cells"
_CHUNKS = 1_000_000
"""Reads allowed of a chart: Pillow writes 64 kB in a chunk, and reads it in four pieces."""


class CountedFile(io.FileIO):
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


def chart_picture(knots: Indices, palette: Indices) -> Image.Image:
    """The knots of a chart as a picture with a palette (colours, 3)."""
    picture = Image.frombytes("P", knots.shape[::-1], np.ascontiguousarray(knots).tobytes())
    picture.putpalette(palette.tobytes())
    return picture


def write_chart_png(path: Path, chart: Chart, progress: Progress = SILENT) -> None:
    """Write the chart to `path`."""
    info = PngInfo()
    info.add_text("Title", "Knot chart: one pixel one knot")
    info.add_text("Software", "ilmek")
    info.add_itxt(KEY, chart_facts(chart))
    if len(chart.overlay):
        info.add_itxt(OVERLAY_KEY, overlay_text(chart.overlay, chart.columns))
    if chart.cells is not None:
        info.add_itxt(CELLS_KEY, cells_text(chart.cells), zip=True)
    bare = NO_KNOT in chart.knots
    palette = chart.colour_table[: None if bare else len(chart.yarns)]
    clear = {"transparency": b"\xff" * NO_KNOT + b"\0"} if bare else {}
    dots = (chart.quality.across * METRE, chart.quality.along * METRE)
    with CountedFile(path, chart.knots.size, progress) as file:
        chart_picture(chart.knots, palette).save(file, format="PNG", pnginfo=info, dpi=dots, **clear)


def begins_chart_png(begin: bytes) -> bool:
    """Whether a file that begins with these bytes is a PNG file with the data of a chart."""
    return begin.startswith(b"\x89PNG") and b"iTXt" + KEY.encode() + b"\0" in begin


def read_chart_png(path: Path, progress: Progress = SILENT) -> Chart:
    """The chart that `write_chart_png` wrote, of at most `carpet.design.MOST_KNOTS` knots.

    Raises PictureError for any other file.
    """
    data = read_bytes(path, progress.part(0.0, 0.3))
    try:
        with pillow_settings(MOST_KNOTS):
            check_structure(data, progress.part(0.3, 0.6))
            stream = MeteredBytes(data)
            stream.allow(_CHUNKS, 2 * len(data))
            with Image.open(stream, formats=("PNG",)) as picture:
                if picture.mode != "P":
                    raise DamagedError("it has no palette")
                picture.load()
                texts = getattr(picture, "text", {})
                facts = read_facts(str(texts.get(KEY, "")))
                palette = picture.getpalette("RGB") or []
                knots = np.array(picture, dtype=np.uint8)
        cells = read_cells(str(texts.get(CELLS_KEY, "")), knots)
        _require_yarns(knots, palette, facts.yarns, cells)
        overlay = read_overlay(str(texts.get(OVERLAY_KEY, "")), knots, len(facts.yarns))
        chart = replace(chart_of_facts(knots, facts, "a knot chart of ilmek", cells), overlay=overlay)
    except (MemoryError, Cancelled):
        raise
    except UnidentifiedImageError as error:
        raise PictureError(f"{path} is no knot chart (it is no PNG)", allowed="a chart.png written by ilmek") from error
    except Exception as error:  # a decoder may raise any
        raise PictureError(
            f"{path} is no knot chart ({shortened(error)})", allowed="a chart.png written by ilmek"
        ) from error
    progress(1.0)
    return chart


def _require_yarns(knots: Indices, palette: list[int], yarns: Sequence[Yarn], cells: CellMap | None) -> None:
    """Raise DamagedError unless every knot has a yarn, of the colour that the palette has for it."""
    if (knots if cells is None else knots[cells.tied]).max() >= len(yarns):
        raise DamagedError("a knot has no yarn")
    colours = [channel for yarn in yarns for channel in yarn.srgb]
    if palette[: len(colours)] != colours:
        raise DamagedError("its palette was changed after it was written")
