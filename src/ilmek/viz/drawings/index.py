"""The first sheets of a book of drawings: every part with its drawing, number, source, material and mass.

Where a design does not do its work, the reasons why nothing is released stand before them.
"""

import math
from collections.abc import Sequence

from ilmek.records import record
from ilmek.report import BillLine, Check, Report
from ilmek.report.sheet import DrawingSheet, Issue, SheetText
from ilmek.sentences import Sentence
from ilmek.units import format_quantity
from ilmek.viz.drawings.compose import merged, status_of
from ilmek.viz.drawings.drawn_part import DrawnPart
from ilmek.viz.drawings.paper import PAPERS, TitleFacts, fitting, frame, row_heights, table, title_block
from ilmek.viz.drawings.picture import SheetPicture

_LINES, _REASONS, _WIDTHS = 37, 8, (12.0, 66.0, 86.0, 14.0, 16.0, 140.0, 22.0, 22.0)
"""Lines of 5 mm and reasons on a sheet, and widths of the columns [mm]."""

HEADER = tuple(
    map(
        Sentence,
        ("sheet.list-number", "sheet.list-drawing", "sheet.list-part", "sheet.pieces", "sheet.list-source",
         "sheet.list-material", "sheet.mass", "sheet.list-all"),
    )
)  # fmt: skip


@record
class PartRow:
    """A line of the parts list: its drawing, or none of a bought part, and what it is."""

    number: int
    drawing: str
    title: str
    pieces: int
    source: str
    material: str
    mass: float

    @property
    def cells(self) -> tuple[str, ...]:
        """Its cells in words."""
        each, every = (_mass(mass) for mass in (self.mass, self.pieces * self.mass))
        return str(self.number), self.drawing, self.title, str(self.pieces), self.source, self.material, each, every


def part_rows(lines: Sequence[BillLine], parts: Sequence[DrawnPart]) -> tuple[PartRow, ...]:
    """A row for each line of a parts list, by its position in it, and for each drawn part that is not in it."""
    drawn = {part.number: part for part in parts}
    rows: list[PartRow] = []
    for number, line in enumerate(lines, 1):
        part = drawn.pop(line.part, None)
        if part is not None:
            rows.append(_row(number, part))
        elif line.kind or line.description:
            source = Sentence("sheet.make") if line.material else Sentence("sheet.buy")
            material = line.material or line.description
            rows.append(PartRow(number, "—", line.name, line.number, source, material, line.mass))
    rows += [_row(number, part) for number, part in enumerate(drawn.values(), len(lines) + 1)]
    return tuple(rows)


def listed_lines(report: Report) -> list[BillLine]:
    """Its parts list; that of the machines in it where it has none."""
    own = list(report.parts)
    known = {line.part for line in own}
    return own + [
        line for child in report.children for line in listed_lines(child) if not own or line.part not in known
    ]


def _row(number: int, part: DrawnPart) -> PartRow:
    return PartRow(number, part.number, part.title, part.pieces, Sentence("sheet.make"), part.material, part.mass)


def _mass(mass: float) -> str:
    if math.isnan(mass):
        return "—"
    return format_quantity(mass, "kg", 3) if mass >= 0.1 else format_quantity(mass, "g", 3)


def index_sheets(report: Report, rows: Sequence[PartRow], issue: Issue) -> tuple[DrawingSheet, ...]:
    """The parts list of a machine on as many sheets as it needs."""
    reasons = report.reasons
    taken = min(len(reasons), _REASONS + 1) + 3 if reasons else 0
    pages, left = list[list[PartRow]]([[]]), 5.0 * (_LINES - taken)
    for row, height in zip(rows, row_heights([row.cells for row in rows], _WIDTHS), strict=True):
        if height > left:
            pages.append([])
            left = 5.0 * _LINES
        pages[-1].append(row)
        left -= height
    return tuple(
        _page(report, page, issue, number, len(pages), reasons if number == 1 else ())
        for number, page in enumerate(pages, 1)
    )


def _page(  # noqa: PLR0917
    report: Report, rows: Sequence[PartRow], issue: Issue, page: int, pages: int, reasons: Sequence[Check]
) -> DrawingSheet:
    paper = "A3"
    width, height = PAPERS[paper]
    top = complex(26.0, height - 16.0)
    pictures = [frame(paper)]
    facts = TitleFacts(
        f"{report.machine}/parts", report.title, Sentence("sheet.parts-list"), "—", "—", "—", str(1), "—", "", "—", (),
        status_of(issue), issue.owner, issue.date, issue.revision,
    )  # fmt: skip
    pictures.append(title_block(facts, paper, 1.0, page, pages))
    if reasons:
        stated = _reasons(reasons)
        pictures.append(stated.moved(top - 1j * stated.box[3]))
        top -= 1j * (stated.box[3] - stated.box[1] + 4.0)
    listed = table(HEADER, [row.cells for row in rows], widths=_WIDTHS)
    pictures.append(listed.moved(top))
    whole = merged(pictures)
    stamp = status_of(issue) if issue.unreleased else ""
    return DrawingSheet(
        facts.number, report.title, paper, width, height, 1.0, whole.lines, whole.texts, (), page, pages, stamp
    )  # fmt: skip


def _reasons(reasons: Sequence[Check]) -> SheetPicture:
    """Why nothing is released: the heaviest failed checks, each with its cure."""
    texts = [SheetText(0j, Sentence("sheet.reasons"), 3.5, bold=True)]
    for reason in reasons[:_REASONS]:
        words, _ = fitting(Sentence("sheet.reason", reason=reason.name, cure=reason.cure), 360.0, 2.5, 2.5)
        texts.append(SheetText(complex(0.0, -5.0 * len(texts) - 1), words, 2.5))
    more = len(reasons) - _REASONS
    if more > 0:
        texts.append(SheetText(complex(0.0, -5.0 * len(texts) - 1), Sentence("sheet.more-reasons", count=more), 2.5))
    return SheetPicture((), tuple(texts), ())
