"""Papers of a machine: what its maker and its user are given beside drawings, as data without any file format.

Titles, headings and paragraphs are sentences of the catalogue, so that a paper can be written in each language.
"""

from ilmek.records import record
from ilmek.report.figure import Drawing
from ilmek.report.table import Table


@record
class PaperSection:
    """A section of a paper: paragraphs, a picture, a table.

    boxes    each row of the table has a box to tick, and a field for what was measured
    """

    title: str
    paragraphs: tuple[str, ...] = ()
    table: Table | None = None
    boxes: bool = False
    figure: Drawing | None = None


@record
class Paper:
    """A paper of a name, of which its files are named."""

    name: str
    title: str
    lead: str
    sections: tuple[PaperSection, ...]


@record
class Papers:
    """The papers of a machine: pages for people, in each language, and lists for other programs.

    tree  of the package `part`, of which the assemblies are drawn; None: none
    """

    pages: tuple[Paper, ...] = ()
    lists: tuple[Table, ...] = ()
    tree: object = None


NO_PAPERS = Papers()


@record
class IndexEntry:
    """A line of the index of a folder: what a file is of, the file, and what is in it."""

    title: str
    file: str
    what: str
