"""Formats of knot charts, one row each: commands, options, recipes, pages, Python and the studio read this table."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from ilmek.carpet.chart import Chart
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import CarpetError, OutputError
from ilmek.io.chart.indexed import write_chart_bmp, write_chart_tiff
from ilmek.io.chart.oxs import MOST_OXS_KNOTS, write_chart_oxs
from ilmek.io.chart.oxs_reading import begins_oxs, read_chart_oxs
from ilmek.io.chart.pdf import write_chart_pdf
from ilmek.io.chart.png import begins_chart_png, read_chart_png, write_chart_png
from ilmek.io.chart.printing import PLAIN, Printing
from ilmek.io.chart.wif import write_wif
from ilmek.io.regular_file import open_regular
from ilmek.plugins import Registry
from ilmek.progress import SILENT, Progress
from ilmek.records import record

ReadChart: TypeAlias = tuple[Chart, tuple[str, ...]]
"""A chart, and notes on what of its file is left out."""

_BEGIN = 65_536
"""Bytes by which the format of a file is recognised."""


@record
class ChartFormat:
    """A format of knot charts.

    name      also its ending, its option and its key of a recipe
    note      on the file of a carpet's folder
    doc       of the option that writes it, after "write chart.NAME, "
    write     the file of a chart; of one that is printed, with a Printing
    begins    whether a file that begins with these bytes is a chart of this format; the ending counts as well where
              the format is no picture
    read      the chart of a file, with the size and the quality of an order, of which a file without them needs one,
              and the colour of its cells without a knot; None: it is not read as a chart
    picture   it is a picture, and read as one where it has no facts of a chart
    always    it is in every folder
    printed   it is for people: written where it is not too large
    most      largest number of knots
    """

    name: str
    note: str
    doc: str
    write: Callable[..., None]
    begins: Callable[[bytes], bool] = lambda _: False
    read: Callable[[Path, CarpetSize | None, Quality | None, Progress, str | None], ReadChart] | None = None
    picture: bool = True
    always: bool = False
    printed: bool = False
    most: int | None = None

    @property
    def suffix(self) -> str:
        """Ending of its files."""
        return f".{self.name}"

    @property
    def file(self) -> str:
        """Its file in the folder of a carpet."""
        return f"chart{self.suffix}"

    @property
    def by_option(self) -> bool:
        """Whether it is written where an option requires it."""
        return not self.always and not self.printed

    def save(self, path: Path, chart: Chart, progress: Progress = SILENT, printing: Printing = PLAIN) -> None:
        """Write a chart to a file; printing: what one that is printed has besides the chart.

        Raises OSError, and CarpetError for a chart of too many knots.
        """
        self.require(chart.knots.size)
        self.write(path, chart, progress, **({"printing": printing} if self.printed else {}))

    def require(self, knots: int) -> None:
        """Raise CarpetError for more knots than a file can have."""
        if self.most is not None and knots > self.most:
            do = "chart.png has everything, and --bmp any number of knots"
            raise CarpetError(f"--{self.name}: the chart has {knots:,} knots", allowed=f"at most {self.most:,}", do=do)


def _read_png(
    path: Path,
    size: CarpetSize | None,  # noqa: ARG001 - it has its own, and a knot in every cell
    quality: Quality | None,  # noqa: ARG001
    progress: Progress,
    ground: str | None,  # noqa: ARG001
) -> ReadChart:
    return read_chart_png(path, progress), ()


FORMATS = Registry(
    "ilmek.chart_formats",
    {
        row.name: row
        for row in (
            ChartFormat(
                "png",
                "the knot chart, one pixel one knot; weave and chart read it again",
                "one pixel a knot, with all facts of the chart",
                write_chart_png,
                begins_chart_png,
                _read_png,
                always=True,
            ),
            ChartFormat(
                "bmp",
                "the knot chart as indexed BMP, for carpet CAD programs",
                "an indexed BMP of one pixel a knot, for carpet CAD programs",
                write_chart_bmp,
            ),
            ChartFormat(
                "tiff",
                "the knot chart as indexed TIFF, for carpet CAD programs",
                "an indexed TIFF of one pixel a knot, for carpet CAD programs",
                write_chart_tiff,
            ),
            ChartFormat(
                "oxs",
                "the knot chart for cross-stitch programs; weave and chart read it again",
                "the open XML chart of cross-stitch programs",
                write_chart_oxs,
                begins_oxs,
                read_chart_oxs,
                picture=False,
                most=MOST_OXS_KNOTS,
            ),
            ChartFormat(
                "wif",
                "the ground weave for weaving programs and looms that they drive",
                "the ground weave with its two wefts a row, for weaving programs",
                write_wif,
                picture=False,
            ),
            ChartFormat(
                "pdf",
                "the knot chart to weave from, with symbols and row numbers",
                "sheets with symbols and row numbers",
                write_chart_pdf,
                picture=False,
                printed=True,
            ),
        )
    },
    ChartFormat,
)
"""Formats by name."""


def format_of(path: Path) -> ChartFormat | None:
    """The format of a chart in a file; None: it is none, or cannot be read."""
    for row in FORMATS.values():
        if row.read is not None and not row.picture and path.suffix.lower() == row.suffix:
            return row
    try:
        file, _ = open_regular(path)
        with file:
            begin = file.read(_BEGIN)
    except OSError:
        return None
    return next((row for row in FORMATS.values() if row.read is not None and row.begins(begin)), None)


def read_chart(
    path: Path,
    size: CarpetSize | None = None,
    quality: Quality | None = None,
    progress: Progress = SILENT,
    ground: str | None = None,
) -> ReadChart:
    """The chart of a file in any format that is read.

    size, quality  of the carpet, for a file that states none; default: as of a drawing
    ground         colour of the cells without a knot, which only charts of other programs have
    Raises PictureError for a file that is no chart, CarpetError for a grid that no carpet has; Cancelled.
    """
    chosen = format_of(path) or FORMATS["png"]  # which states what is wrong
    assert chosen.read is not None
    return chosen.read(path, size, quality, progress, ground)


def format_by_ending(path: Path) -> ChartFormat:
    """The format in which a chart is written to a file of this name. Raises OutputError for another ending."""
    chosen = FORMATS.get(path.suffix.lower().removeprefix("."))
    if chosen is None:
        endings = ", ".join(row.suffix for row in FORMATS.values())
        raise OutputError(f"chart {path} ends in {path.suffix!r}", allowed=f"one of {endings}")
    return chosen
