"""The drawing-in list as CSV: a line for each warp."""

from collections.abc import Callable
from pathlib import Path

from ilmek.io.csv_cells import csv_rows
from ilmek.weaving.warping import DRAWN_IN, WarpEnd, Warping


def write_drawing_in(path: Path, warping: Warping, guide: Callable[[WarpEnd], str]) -> None:
    """Write the list in UTF-8; guide: what lifts a warp."""
    path.write_text(csv_rows((DRAWN_IN, *warping.drawn(guide))), encoding="utf-8")
