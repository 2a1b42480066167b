"""A paper as PDF: headings, paragraphs, pictures, and tables that break over pages with their heads repeated.

    width of a column = longest word + share (longest text - longest word)        the same share of all columns

A paper whose widest table has not even room for its words stands on its side.
"""

import math
from collections import deque
from collections.abc import Iterator
from html import escape
from pathlib import Path

from reportlab.lib.colors import HexColor
from reportlab.lib.enums import TA_RIGHT
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.platypus import Flowable, Paragraph, Table

from ilmek.io.chart.printing import PrintCanvas, printed_file, write_stamp
from ilmek.io.chart.symbols import STRONG, TEXT
from ilmek.io.papers.svg_picture import SvgPicture
from ilmek.report.paper import BOX, PrintedPaper, PrintedSection

MARGIN, HEAD, FOOT = 18 * mm, 22 * mm, 18 * mm
"""Left and right margin of a page, its upper and its lower one [pt]."""

_PALE = HexColor("#55626e")
_PLAIN = ParagraphStyle("plain", fontName=TEXT, fontSize=9, leading=12.5, spaceAfter=4)
_LEAD = ParagraphStyle("lead", _PLAIN, textColor=_PALE, spaceAfter=6)
_TITLE = ParagraphStyle("title", _PLAIN, fontName=STRONG, fontSize=16, leading=20, spaceAfter=4)
_SECTION = ParagraphStyle("section", _PLAIN, fontName=STRONG, fontSize=11.5, leading=15, spaceBefore=8, spaceAfter=4)
_CELL = ParagraphStyle("cell", _PLAIN, fontSize=7.5, leading=9.5, spaceAfter=0)
_WARNING = ParagraphStyle("warning", _PLAIN, fontName=STRONG, textColor=HexColor("#9b2d30"))
_COLUMN = ParagraphStyle("column", _CELL, fontName=STRONG)
_NUMBERS = ParagraphStyle("numbers", _COLUMN, alignment=TA_RIGHT)
_TABLE = [
    ("VALIGN", (0, 0), (-1, -1), "TOP"),
    ("FONT", (0, 0), (-1, -1), TEXT, 7.5, 9.5),
    ("LINEBELOW", (0, 0), (-1, 0), 0.8, HexColor("#1f2933")),
    ("LINEBELOW", (0, 1), (-1, -1), 0.3, HexColor("#9aa5b1")),
    ("LEFTPADDING", (0, 0), (-1, -1), 3),
    ("RIGHTPADDING", (0, 0), (-1, -1), 3),
    ("TOPPADDING", (0, 0), (-1, -1), 2),
    ("BOTTOMPADDING", (0, 0), (-1, -1), 2),
]

_ROOM, _AFTER, _KEPT = 6.5, 8.0, 80.0
"""Room beside a cell on both sides, after a table or picture, and after a heading on its page [pt]."""

_MEASURED = "—" * 6
"""As wide as the field for what was measured."""

Widths = tuple[list[float], list[float]]
Item = tuple[Flowable, float]
"""What a page has under one another, and the room that must be under it on its page [pt]."""


def write_paper_pdf(path: Path, paper: PrintedPaper) -> None:
    """Write a paper as PDF. The same paper gives the same bytes. Raises OSError."""
    with printed_file(path, paper.title, lang=paper.language) as canvas:
        widths = [_widths(section) for section in paper.sections]
        width, height = A4
        if any(sum(least) > width - 2 * MARGIN for least, _ in widths):
            width, height = height, width
        room, top = width - 2 * MARGIN, height - HEAD
        canvas.setPageSize((width, height))
        pages = _pages(canvas, _story(paper, widths, room, top - FOOT), room, top)
        for number, page in enumerate(pages, 1):
            _furniture(canvas, paper, f"{number} / {len(pages)}")
            for item, lower in page:
                item.drawOn(canvas, MARGIN, lower)
            canvas.showPage()


def _pages(canvas: PrintCanvas, story: Iterator[Item], room: float, top: float) -> list[list[tuple[Flowable, float]]]:
    """What each page has, and how high its lower edge is; what does not fit is split, or goes to the next page."""
    pages, left, items = [list[tuple[Flowable, float]]()], top, deque(story)
    while items:
        item, kept = items.popleft()
        high = item.wrapOn(canvas, room, left - FOOT)[1]
        fits = high + kept <= left - FOOT
        pieces = [] if fits or kept else item.split(room, left - FOOT)
        if len(pieces) > 1:
            items.extendleft((piece, 0.0) for piece in reversed(pieces))
        elif fits or left == top:  # what cannot be split stands alone
            left -= high
            pages[-1].append((item, left))
            left -= item.getSpaceAfter()
        else:
            items.appendleft((item, kept))
            pages.append([])
            left = top
    return pages


def _furniture(canvas: PrintCanvas, paper: PrintedPaper, number: str) -> None:
    """What each page has: the stamp below all else, title, revision and date, who made it, its number."""
    width, height = canvas._pagesize
    if paper.stamp:
        write_stamp(canvas, paper.stamp, width, height)
    canvas.setFont(TEXT, 7)
    canvas.setFillColor(_PALE)
    canvas.draw_letters(MARGIN, height - HEAD + 10, paper.title)
    canvas.drawRightString(width - MARGIN, height - HEAD + 10, paper.issue)
    canvas.draw_letters(MARGIN, FOOT - 16, paper.footer)
    canvas.drawRightString(width - MARGIN, FOOT - 16, number)


def _story(paper: PrintedPaper, widths: list[Widths], room: float, high: float) -> Iterator[Item]:
    yield Paragraph(escape(paper.title), _TITLE), _KEPT
    yield Paragraph(escape(paper.lead), _LEAD), 0.0
    yield from ((Paragraph(escape(text), _WARNING), 0.0) for text in paper.warning)
    for section, own in zip(paper.sections, widths, strict=True):
        texts = [Paragraph(escape(text), _PLAIN) for text in section.paragraphs]
        picture = SvgPicture(section.picture, 0.6 * high) if section.picture else None
        under = _KEPT if picture is None else math.fsum(part.wrap(room, high)[1] + _AFTER for part in (*texts, picture))
        yield Paragraph(escape(section.title), _SECTION), under
        yield from ((text, 0.0) for text in texts)
        if picture is not None:
            yield picture, 0.0
        if section.heads:
            yield _table(section, own, room), 0.0


def _widths(section: PrintedSection) -> Widths:
    """Of each column the width of its longest word, and that of its longest text [pt]."""
    columns = list(zip(section.heads, *([cell.text for cell in row] for row in section.rows), strict=True))
    columns += [(section.measured, _MEASURED)] if section.measured else []
    if section.measured:
        columns.insert(0, (BOX, BOX))
    words, whole = list[float](), list[float]()
    for head, *texts in columns:
        longest = [stringWidth(word, STRONG, _CELL.fontSize) for word in head.split(" ")]
        longest += [stringWidth(word, TEXT, _CELL.fontSize) for text in {*texts} for word in text.split(" ")]
        words.append(max(longest, default=0.0) + _ROOM)
        full = (stringWidth(text, TEXT, _CELL.fontSize) + _ROOM for text in {*texts})
        whole.append(max(words[-1], max(full, default=0.0)))
    return words, whole


def _table(section: PrintedSection, widths: Widths, room: float) -> Table:
    words, whole = widths
    spread, free = sum(whole) - sum(words), room - sum(words)
    share = min(1.0, free / spread) if spread > 0 and free > 0 else 0.0
    fitted = [least + share * (most - least) for least, most in zip(words, whole, strict=True)]
    shrunk = min(1.0, room / sum(fitted))
    numeric = [all(row[column].is_number for row in section.rows) for column in range(len(section.heads))]
    before, after, measured = (
        ([BOX], [""], [Paragraph(section.measured, _COLUMN)]) if section.measured else ([], [], [])
    )
    heads = (
        Paragraph(escape(head), _NUMBERS if own else _COLUMN) for head, own in zip(section.heads, numeric, strict=True)
    )
    rows = [[*before, *heads, *measured]]
    rows += [
        [*before, *(cell.text if cell.is_number else Paragraph(escape(cell.text), _CELL) for cell in row), *after]
        for row in section.rows
    ]
    table = Table(
        rows, [shrunk * width for width in fitted], repeatRows=1, spaceAfter=_AFTER, hAlign="LEFT", splitInRow=1
    )
    right = (column for column, own in enumerate(numeric, len(before)) if own)
    table.setStyle([*_TABLE, *(("ALIGN", (column, 0), (column, -1), "RIGHT") for column in right)])
    return table
