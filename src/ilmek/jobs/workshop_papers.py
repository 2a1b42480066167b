"""Write the papers of a machine into its folder: pages in each language, lists as CSV, and the index of all files."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from ilmek.io.papers.pdf import write_paper_pdf
from ilmek.io.plc.io_list import HEADER, io_rows
from ilmek.io.plc.sequence_logic import sequence_units
from ilmek.io.plc.sequence_variables import PlcSize, ScanLimits
from ilmek.io.table_csv import rows_csv
from ilmek.loom.operations import ROW_ENDS
from ilmek.machines.automated_loom import LoomDesign
from ilmek.machines.automated_loom.papers.wiring import numbers_of, read_signals
from ilmek.machines.component import AnyComponent
from ilmek.machines.tree_papers import tree_papers
from ilmek.records import JsonObject
from ilmek.report import NO_PAPERS, Column, IndexEntry, Papers, Report, Table
from ilmek.report.sheet import Issue
from ilmek.sentences import LANGUAGES, Sentence
from ilmek.viz.document_page import INDEX_PAGE, document_page, index_page, page_file, printed
from ilmek.viz.drawings.paper import scale_words

PAPER_KINDS = ("page", "list")
"""Kinds of entries of papers: a page for people in a language, a list as CSV."""

DRAWING_KINDS = ("drawings", "assembly", "sheet", "translation")
"""Kinds of entries of drawings, in the order of the index."""


def papers_of(machine: AnyComponent, design: object, report: Report) -> Papers:
    """The papers of a design of a machine with its report; none of a machine without parts.

    Those of a loom with heads have the list of the inputs and outputs of its control besides.
    """
    if machine.papers is not None:
        papers = machine.papers(design, report)
        listed = (_io_list(design),) if isinstance(design, LoomDesign) and design.heads else ()
        return replace(papers, lists=(*papers.lists, *listed))
    if machine.tree is None:
        return NO_PAPERS
    return tree_papers(machine.tree(design), in_space=machine.mechanism is not None)


def _io_list(loom: LoomDesign) -> Table:
    """The list that `ilmek plc` writes, the same for each carpet of a loom, with the parts and sensors of this loom."""
    any_time = ScanLimits(0, 1)  # the list has no times
    *_, program = sequence_units(PlcSize(loom.heads, 1, loom.columns, any_time, (any_time,) * len(ROW_ENDS), any_time))
    rows = io_rows(program, placed=numbers_of(loom), read=read_signals(loom))
    return Table("io", Sentence("paper.io"), tuple(map(Column, HEADER)), tuple(rows))


def write_papers(papers: Papers, report: Report, work: Path, issue: Issue) -> Iterator[JsonObject]:
    """Write the pages as HTML and as PDF, and the lists; an entry for each file. Raises OSError."""
    issue = replace(issue, unreleased=bool(report.failed))
    for paper in papers.pages:
        for language in LANGUAGES:
            shown = printed(paper, report.title, language, issue)
            page, leaf = (page_file(paper.name, language, ending) for ending in ("html", "pdf"))
            (work / page).write_text(document_page(shown, paper.name), encoding="utf-8")
            write_paper_pdf(work / leaf, shown)
            yield from (_entry(report, file, "page", paper.title) | {"language": language} for file in (page, leaf))
    for table in papers.lists:
        file = f"{table.name}.csv"
        (work / file).write_text(rows_csv(table), encoding="utf-8")
        yield _entry(report, file, "list", table.title) | {"rows": len(table.rows)}


def write_index(report: Report, papers: Papers, entries: Iterable[JsonObject], work: Path) -> Iterator[JsonObject]:
    """Write the index in each language, which links all files of the entries; an entry for each of its own."""
    files = [entry for entry in entries if entry["kind"] not in PAPER_KINDS]
    for language in LANGUAGES:
        groups: dict[str, list[IndexEntry]] = {
            Sentence("paper.pages"): [
                IndexEntry(paper.title, page_file(paper.name, language, ending), paper.lead)
                for paper in papers.pages
                for ending in ("html", "pdf")
            ],
            Sentence("paper.lists"): [
                IndexEntry(table.title, f"{table.name}.csv", Sentence("paper.rows", count=len(table.rows)))
                for table in papers.lists
            ],
            Sentence("paper.drawings"): [
                _drawing(entry)
                for kind in DRAWING_KINDS
                for entry in files
                if entry["kind"] == kind and entry.get("language", language) == language
            ],
            Sentence("paper.shapes"): [_file(entry) for entry in files if entry["kind"] in ("space", "dxf", "step")],
            Sentence("paper.motions"): [_file(entry) for entry in files if "points" in entry and "format" in entry],
        }
        text = index_page(report.title, groups, report.reasons, language)
        file = page_file(INDEX_PAGE, language)
        (work / file).write_text(text, encoding="utf-8")
        yield _entry(report, file, INDEX_PAGE, Sentence("paper.index")) | {"language": language}


def _file(entry: JsonObject) -> IndexEntry:
    what = entry["format"] if "format" in entry else f"{entry['kind'].upper()}, {entry['material']}, {entry['number']}×"
    return IndexEntry(entry["title"], entry["file"], what)


def _drawing(entry: JsonObject) -> IndexEntry:
    what = f"PDF, {entry['sheets']}×" if "sheets" in entry else f"{entry['paper']}, {scale_words(entry['scale'])}"
    return IndexEntry(entry["title"], entry["file"], what)


def _entry(report: Report, file: str, kind: str, title: str) -> JsonObject:
    return {"file": file, "kind": kind, "of": report.machine, "title": str(title)}
