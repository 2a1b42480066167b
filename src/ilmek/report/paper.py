"""Papers of a machine: what its maker and its user are given beside drawings, as data without any file format.

Titles, headings and paragraphs are sentences of the catalogue, so that a paper can be written in each language.
"""

from ilmek.records import record
from ilmek.report.check import Check
from ilmek.report.figure import Drawing
from ilmek.report.sheet import Schematic
from ilmek.report.table import Cell, Table


@record
class PaperSection:
    """A section of a paper: paragraphs, a picture, a table.

    boxes    each row of the table has a box to tick, and a field for what was measured
    """

    title: str
    paragraphs: tuple[str, ...] = ()
    table: Table | None = None
    boxes: bool = False
    figure: Drawing | Schematic | None = None


@record
class Paper:
    """A paper of a name, of which its files are named."""

    name: str
    title: str
    lead: str
    sections: tuple[PaperSection, ...]


BOX = "☐"
"""A box to tick."""


@record
class PrintedSection:
    """A section in a language, its numbers as they are printed; `measured`: head of the field; "": no boxes.

    picture  its figure as SVG; "": none
    """

    title: str
    paragraphs: tuple[str, ...]
    heads: tuple[str, ...] = ()
    rows: tuple[tuple[Cell, ...], ...] = ()
    measured: str = ""
    picture: str = ""


@record
class PrintedPaper:
    """A paper in a language, of which its HTML and its PDF are made.

    issue    revision and date; "": none         warning  head and reason where it is not released
    footer   who made it
    """

    language: str
    title: str
    lead: str
    issue: str
    warning: tuple[str, ...]
    sections: tuple[PrintedSection, ...]
    footer: str

    @property
    def stamp(self) -> str:
        """Across each page of a paper that is not released."""
        return self.warning[0] if self.warning else ""


@record
class Papers:
    """The papers of a machine: pages for people, in each language, and lists for other programs.

    checks  what was judged for them, beside the checks of the report
    tree  of the package `part`, of which the assemblies are drawn; None: none
    in_space  whether its parts are written together too: at rest as STEP, in motion as GLB
    """

    pages: tuple[Paper, ...] = ()
    lists: tuple[Table, ...] = ()
    checks: tuple[Check, ...] = ()
    tree: object = None
    in_space: bool = False


NO_PAPERS = Papers()


@record
class IndexEntry:
    """A line of the index of a folder: what a file is of, the file, and what is in it."""

    title: str
    file: str
    what: str
