"""The files of a carpet's folder: what they are, and what is set for them."""

from collections.abc import Collection
from dataclasses import dataclass, make_dataclass
from typing import TYPE_CHECKING, TypeAlias

from ilmek.carpet.rows import DIRECTIONS, SPLITS
from ilmek.io.chart.formats import FORMATS, ChartFormat
from ilmek.io.chart.printing import DIGITS
from ilmek.params import Params, kind, param
from ilmek.sentences import DEFAULT, WEAVERS
from ilmek.viz.carpet_picture import NARROWEST, WIDEST
from ilmek.viz.page_parts import FileNote

FILES = (
    FileNote("report.html", "this page: the carpet, its yarn and statistics"),
    FileNote("loom.html", "the loom: its machines, choices and checks"),
    FileNote("report.json", "the same results as data, SI"),
    FileNote("carpet.png", "the simulated carpet, to show"),
    *(FileNote(row.file, row.note) for row in FORMATS.values()),
    FileNote("wall.pdf", "the whole knot chart on one large sheet"),
    FileNote("rows.pdf", "the rows to weave by, to print and tick off"),
    FileNote("rows.txt", "the rows to weave by as text"),
    FileNote("chart.json", "the results as data, SI"),
    FileNote("yarn.csv", "the yarn to buy"),
    FileNote("drawing-in.csv", "the drawing-in list: knot, cam or heddle, and slot of each warp"),
    FileNote("proposed.toml", "shades proposed from the picture itself: a yarn list for --yarns"),
    FileNote("paper.html", "the doubtful cells of the squared paper beside their reading, to correct"),
    FileNote("programme.ilmek", "the loom programme; show it with `ilmek inspect`"),
    FileNote("machine.json", "the loom and its machines: parameters, results, checks"),
)
"""All files of `weave` and `chart`, in the order of the page."""


@dataclass(frozen=True, slots=True)
class _FileParams(Params):
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
    lang: str = param(
        DEFAULT,
        choices=tuple(WEAVERS),
        doc="language of chart.pdf, rows.pdf, wall.pdf and rows.txt: English, Turkish, Persian, Arabic, Urdu, Hindi, "
        "Nepali",
    )
    digits: str | None = param(
        None,
        choices=tuple(DIGITS),
        doc="digits of the numbers on chart.pdf, rows.pdf and wall.pdf; default: those of --lang",
    )
    wall: bool = param(False, doc="draw the whole chart on one large sheet, wall.pdf")

    @property
    def formats(self) -> tuple[ChartFormat, ...]:
        """The formats of the chart that are written whatever its size, in the order of the table."""
        return tuple(row for row in FORMATS.values() if row.always or (row.by_option and getattr(self, row.name)))


# With a flag for each format of the chart that an option writes.
if TYPE_CHECKING:
    FileParams: TypeAlias = _FileParams
else:
    FileParams = make_dataclass(
        "FileParams",
        [
            (row.name, bool, kind.flag(False, doc=f"write {row.file}, {row.doc}"))
            for row in FORMATS.values()
            if row.by_option
        ],
        bases=(_FileParams,),
        namespace={"__doc__": _FileParams.__doc__},
        frozen=True,
        slots=True,
    )
    FileParams.__module__ = __name__  # where it is found when it is unpickled


def file_notes(written: Collection[str]) -> tuple[FileNote, ...]:
    """The files that are written, with their meanings."""
    return tuple(file for file in FILES if file.name in written)
