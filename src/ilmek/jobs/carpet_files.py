"""The files of a carpet's folder: what they are, and what is set for them."""

from collections.abc import Collection
from dataclasses import dataclass

from ilmek.carpet.rows import DIRECTIONS, SPLITS
from ilmek.params import Params, kind, param
from ilmek.viz.carpet_picture import NARROWEST, WIDEST
from ilmek.viz.page_parts import FileNote

FILES = (
    FileNote("report.html", "this page: the carpet, its yarn and statistics"),
    FileNote("loom.html", "the loom: its machines, choices and checks"),
    FileNote("report.json", "the same results as data, SI"),
    FileNote("carpet.png", "the simulated carpet, to show"),
    FileNote("chart.png", "the knot chart, one pixel one knot; weave and chart read it again"),
    FileNote("chart.bmp", "the knot chart as indexed BMP, for carpet CAD programs"),
    FileNote("chart.oxs", "the knot chart for cross-stitch programs; weave and chart read it again"),
    FileNote("chart.pdf", "the knot chart to weave from, with symbols and row numbers"),
    FileNote("wall.pdf", "the whole knot chart on one large sheet"),
    FileNote("rows.pdf", "the rows to weave by, to print and tick off"),
    FileNote("rows.txt", "the rows to weave by as text"),
    FileNote("chart.json", "the results as data, SI"),
    FileNote("yarn.csv", "the yarn to buy"),
    FileNote("proposed.toml", "shades proposed from the picture itself: a yarn list for --yarns"),
    FileNote("programme.ilmek", "the loom programme; show it with `ilmek inspect`"),
    FileNote("machine.json", "the loom and its machines: parameters, results, checks"),
)
"""All files of `weave` and `chart`, in the order of the page."""


@dataclass(frozen=True, slots=True)
class FileParams(Params):
    """What is set for the files of a carpet."""

    carpet_width: int | None = kind.count(
        None,
        at_least=NARROWEST,
        at_most=WIDEST,
        doc="width of carpet.png, the simulated carpet, in pixels; default: 1400 pixels along the longer side",
    )
    rows: str | None = param(
        None,
        choices=(*SPLITS, "none"),
        doc="rows to weave by: the runs of each row, or each colour once per row with its knots; default: runs, where "
        "the carpet has at most 5 million knots",
    )
    rows_direction: str = param(
        "both",
        choices=DIRECTIONS,
        doc="direction in which rows are read: to the right, to the left, both, or odd rows right and even rows left",
    )
    wall: bool = param(False, doc="draw the whole chart on one large sheet, wall.pdf")
    bmp: bool = kind.flag(False, doc="write chart.bmp, an indexed BMP of one pixel a knot, for carpet CAD programs")
    oxs: bool = kind.flag(False, doc="write chart.oxs, the open XML chart of cross-stitch programs")


def file_notes(written: Collection[str]) -> tuple[FileNote, ...]:
    """The files that are written, with their meanings."""
    return tuple(file for file in FILES if file.name in written)
