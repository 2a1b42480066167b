"""Pages of a machine's papers, and the index of the folder in which they are, each in a language."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import ilmek
from ilmek.report import Check, Drawing, IndexEntry, Paper, PaperSection, Table
from ilmek.report.paper import BOX, PrintedPaper, PrintedSection
from ilmek.report.sheet import Issue, Schematic
from ilmek.sentences import DEFAULT, LANGUAGES, Sentence, in_language, translated
from ilmek.viz.number_format import cells
from ilmek.viz.page import render, sentence
from ilmek.viz.schematic import draw_schematic
from ilmek.viz.style import FONTS, with_unit
from ilmek.viz.svg import svg

INDEX_PAGE = "index"
"""Name of the index."""


def page_file(name: str, language: str, ending: str = "html") -> str:
    """The file of a page in a language.

    >>> page_file("index", "en"), page_file("risks", "tr", "pdf")
    ('index.html', 'risks.tr.pdf')
    """
    return f"{name}.{ending}" if language == DEFAULT else f"{name}.{language}.{ending}"


def printed(paper: Paper, machine: str, language: str, issue: Issue) -> PrintedPaper:
    """A paper of a machine in a language, with all that its page and its PDF have in common."""
    with in_language(language):
        why = ("paper.not-released", "paper.not-released-why") if issue.unreleased else ()
        return PrintedPaper(
            language,
            f"{translated(paper.title)}: {machine}",
            translated(paper.lead),
            sentence("paper.issue", revision=issue.revision, date=issue.date),
            tuple(map(sentence, why)),
            tuple(_section(section) for section in paper.sections),
            sentence("paper.made-by", version=ilmek.__version__),
        )


def _section(section: PaperSection) -> PrintedSection:
    table = None if section.table is None else _translated(section.table)
    return PrintedSection(
        translated(section.title),
        tuple(map(translated, section.paragraphs)),
        () if table is None else tuple(with_unit(column.heading, column.unit) for column in table.columns),
        () if table is None else tuple(map(tuple, cells(table))),
        sentence("paper.measured") if section.boxes else "",
        "" if section.figure is None else _drawn(section.figure),
    )


def document_page(paper: PrintedPaper, name: str) -> str:
    """A paper as self-contained HTML; where it is not released, that stands across its head."""
    with in_language(paper.language):
        return render(
            "document.html.j2",
            title=paper.title,
            lead=paper.lead,
            paper=paper,
            box=BOX,
            index=page_file(INDEX_PAGE, paper.language),
            **_spoken(name, paper.language),
        )


def index_page(
    machine: str, groups: Mapping[str, Iterable[IndexEntry]], reasons: Sequence[Check], language: str
) -> str:
    """The index of a folder: its files by groups; where checks do not hold, that it is not released, and why."""
    with in_language(language):
        spoken = {
            translated(title): [
                replace(entry, title=translated(entry.title), what=translated(entry.what)) for entry in own
            ]
            for title, own in groups.items()
        }
        return render(
            "index.html.j2",
            title=machine,
            lead="",
            groups={title: own for title, own in spoken.items() if own},
            reasons=reasons,
            released=not reasons,
            **_spoken(INDEX_PAGE, language),
        )


def _spoken(name: str, language: str) -> dict[str, object]:
    """What all pages of a name know of their languages: of each other its code, its name in itself, and its file."""
    others = [(other, _own_name(other), page_file(name, other)) for other in LANGUAGES if other != language]
    return {"language": language, "others": others}


def _own_name(language: str) -> str:
    with in_language(language):
        return translated(Sentence("paper.language"))


def _drawn(figure: Drawing | Schematic) -> str:
    title = translated(figure.title)
    if isinstance(figure, Drawing):
        return svg(replace(figure, title=title))
    texts = tuple(replace(text, words=translated(text.words)) for text in figure.texts)
    return draw_schematic(replace(figure, texts=texts)).svg(title, FONTS)


def _translated(table: Table) -> Table:
    heads = tuple(replace(column, heading=translated(column.heading)) for column in table.columns)
    rows = tuple(tuple(translated(cell) if isinstance(cell, str) else cell for cell in row) for row in table.rows)
    return replace(table, title=translated(table.title), columns=heads, rows=rows)
