"""The book of drawings of a design: the list of all parts, the assemblies, and a sheet for every made part."""

import importlib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path

from ilmek.io.drawings.dxf import write_sheet_dxf
from ilmek.io.drawings.pdf import write_sheets_pdf
from ilmek.part.assemblies import AssemblyUnit, assembly_of
from ilmek.part.bill import bill
from ilmek.part.tree import Tree
from ilmek.progress import Progress
from ilmek.records import JsonObject
from ilmek.report import Plate, Report, WorkPiece
from ilmek.report.left_out import made_or_left_out
from ilmek.report.sheet import DrawingSheet, Issue
from ilmek.sentences import DEFAULT, LANGUAGES, Sentence, in_language, translated
from ilmek.units import counted
from ilmek.viz.drawings.assembly import assembly_sheets
from ilmek.viz.drawings.compose import sheets_of
from ilmek.viz.drawings.drawn_part import drawn_piece, drawn_plate
from ilmek.viz.drawings.index import index_sheets, listed_lines, part_rows
from ilmek.viz.drawings.projector import Projector

BOOK = "drawings.pdf"
"""File of the book."""

ASSEMBLY, SHEET, TRANSLATION = "assembly", "sheet", "translation"
"""Kinds of entries of sheets of assemblies, of parts, and of both in another language than the usual one."""


def write_drawings(  # noqa: PLR0917
    report: Report,
    plates: Mapping[str, Plate],
    pieces: Mapping[str, WorkPiece],
    tree: object,
    work: Path,
    left_out: list[str],
    issue: Issue,
    progress: Progress,
) -> list[JsonObject]:
    """Write the sheets of plates and pieces by the names of their files, and the book. Returns entries of the index.

    tree  of which the assemblies are drawn; None: of none
    Parts whose sheet needs the CAD kernel are left out without it, with one note. Raises OSError, Cancelled.
    """
    parts = [drawn_plate(plate, report.machine, name) for name, plate in plates.items()]
    parts += [drawn_piece(piece, report.machine, name) for name, piece in pieces.items()]
    assembled = tree if isinstance(tree, Tree) else Tree()
    counts = {part.id: number for part, number in assembled.occurrences()}
    parts = [replace(part, pieces=counts.get(part.number, part.pieces)) for part in parts]
    lines = bill(assembled) if assembled.bodies else listed_lines(report)
    if not (parts or assembled.bodies):
        return []
    issue = replace(issue, unreleased=bool(report.failed))
    project, entries, book = _projector(), list[JsonObject](), list[DrawingSheet]()
    without = 0
    assemblies = tuple(assembly_of(assembled, report.title).every) if assembled.bodies else ()
    for number, assembly in enumerate(assemblies):
        progress(0.3 * number / len(assemblies))
        drawn = partial(_assembly_sheets, assembled, assembly, issue)
        for sheet in made_or_left_out(f"assembly {assembly.drawing!r}", drawn, left_out) or ():
            entries += _sheet(sheet, f"assembly-{assembly.number}", work, ASSEMBLY)
            book.append(sheet)
    for number, part in enumerate(parts):
        progress(0.3 + 0.7 * number / len(parts))
        sheets = made_or_left_out(f"sheet of {part.number!r}", partial(sheets_of, part, issue, project), left_out)
        without += sheets == ()
        for sheet in sheets or ():
            entries += _sheet(sheet, part.name, work, SHEET)
            book.append(sheet)
    if without:
        sheets_of_sums = counted(
            without, "sheet of a part of several shapes is", "sheets of parts of several shapes are"
        )
        left_out.append(f"{sheets_of_sums} left out: pip install 'ilmek[step]'")
    first = index_sheets(report, part_rows(lines, parts), issue)
    whole = {"kind": "drawings", "of": report.machine, "title": report.title, "sheets": len(first) + len(book)}
    for language in LANGUAGES:
        with in_language(language):
            title = translated(Sentence("sheet.book", title=report.title))
            write_sheets_pdf(work / book_file(language), (*first, *book), title)
        entries.append({"file": book_file(language), **whole, "language": language})
    progress(1.0)
    return entries


def book_file(language: str) -> str:
    """The book in a language: as pages of papers have it.

    >>> book_file("en"), book_file("tr")
    ('drawings.pdf', 'drawings.tr.pdf')
    """
    return BOOK if language == DEFAULT else f"{Path(BOOK).stem}.{language}.pdf"


def _assembly_sheets(tree: Tree, assembly: AssemblyUnit, issue: Issue) -> tuple[DrawingSheet, ...]:
    return tuple(drawn.sheet for drawn in assembly_sheets(tree, assembly, issue))


def _sheet(sheet: DrawingSheet, name: str, work: Path, kind: str) -> Iterator[JsonObject]:
    """Write a sheet in each language; an entry for each file, of other languages than the usual one a translation."""
    stem, common = f"{name}.sheet" if sheet.page == 1 else f"{name}.sheet-{sheet.page}", _facts(sheet, name)
    files = {language: f"{stem}.dxf" if language == DEFAULT else f"{stem}.{language}.dxf" for language in LANGUAGES}
    others = {language: work / file for language, file in files.items() if language != DEFAULT}
    write_sheet_dxf(work / files[DEFAULT], sheet, others)
    for language, file in files.items():
        yield {"file": file, "kind": TRANSLATION if language in others else kind, **common, "language": language}


def _facts(sheet: DrawingSheet, name: str) -> JsonObject:
    return {
        "of": name,
        "title": sheet.title,
        "drawing": sheet.number,
        "paper": sheet.paper,
        "scale": sheet.scale,
        "page": sheet.page,
        "dimensions": len(sheet.dimensions),
        "released": not sheet.stamp,
    }


def _projector() -> Projector | None:
    """Hidden-line removal; None unless the extra `step` is installed."""
    try:
        projected: Projector = importlib.import_module("ilmek.io.hidden_lines").projected
    except ImportError:
        return None
    return projected
