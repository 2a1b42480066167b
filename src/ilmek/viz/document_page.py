"""Pages of a machine's papers, and the index of the folder in which they are, each in a language."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from markupsafe import Markup

from ilmek.report import Check, Drawing, IndexEntry, Paper, Table
from ilmek.sentences import DEFAULT, LANGUAGES, Sentence, in_language, translated
from ilmek.viz.page import render
from ilmek.viz.svg import svg

INDEX_PAGE = "index"
"""Name of the index."""


def page_file(name: str, language: str) -> str:
    """The file of a page in a language.

    >>> page_file("index", "en"), page_file("index", "tr")
    ('index.html', 'index.tr.html')
    """
    return f"{name}.html" if language == DEFAULT else f"{name}.{language}.html"


def document_page(paper: Paper, machine: str, language: str, *, released: bool) -> str:
    """A paper of a machine as self-contained HTML.

    released  False: across its head stands that the machine must not be made
    """
    with in_language(language):
        sections = [
            {
                "title": translated(section.title),
                "paragraphs": [translated(text) for text in section.paragraphs],
                "table": None if section.table is None else _translated(section.table),
                "boxes": section.boxes,
                "figure": None if section.figure is None else Markup(_drawn(section.figure)),
            }
            for section in paper.sections
        ]
        return render(
            "document.html.j2",
            title=f"{translated(paper.title)}: {machine}",
            lead=translated(paper.lead),
            sections=sections,
            released=released,
            index=page_file(INDEX_PAGE, language),
            **_spoken(paper.name, language),
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


def _drawn(figure: Drawing) -> str:
    return svg(replace(figure, title=translated(figure.title)))


def _translated(table: Table) -> Table:
    heads = tuple(replace(column, heading=translated(column.heading)) for column in table.columns)
    rows = tuple(tuple(translated(cell) if isinstance(cell, str) else cell for cell in row) for row in table.rows)
    return replace(table, title=translated(table.title), columns=heads, rows=rows)
