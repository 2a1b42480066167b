"""The legend of a printed chart: the yarns with their symbols, knots and need, the ground, and the mounting."""

import math
from collections.abc import Iterator, Sequence

from ilmek.carpet.bill import YarnBill, YarnNeed
from ilmek.carpet.cells import OUTSIDE
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.mounting import TENS, Mounting
from ilmek.carpet.usual_pile import usual_pile_height
from ilmek.io.chart.grid import hatch
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.lettering import cut_line, line_width, two_lines
from ilmek.io.chart.printing import PrintCanvas, Printing
from ilmek.io.chart.symbols import NO_SIGN, SIGNS, STRONG, TEXT
from ilmek.records import JsonObject
from ilmek.sentences import Name, Sentence, noun, translated
from ilmek.units import cm, format_number, g, mm

_LEFT, _TOP, _LOW = 54.0, 800.0, 50.0
_GREY, _RULE = (0.36, 0.40, 0.44), 0.75
_LINE, _GAP = 19.0, 26.0
"""Height of an entry, and of the gap between two parts of the page [pt]."""

_ALONE, _WIDTH, _ACROSS = 330.0, 295.0, 487.0
"""Width of an entry with its knots and share, alone and with the columns of the need at its right, and of a note [pt].
"""

_COLUMNS = (
    (Sentence("legend.length"), 348.0),
    (Sentence("legend.mass"), 397.0),
    (Sentence("legend.to-buy"), 450.0),
    (Sentence("legend.hanks"), 487.0),
)
"""Headings of the need, and ends of its columns from the side where lines begin [pt]."""

_ROOM = 38.0
"""Width of a column of numbers, whose ones stand below each other in every language [pt]."""

_NAME, _SMALL = 9.0, 6.5
"""Sizes of a name's letters, and of those of a long name [pt]."""


def thousands(number: int) -> str:
    """A whole number with its thousands separated."""
    return f"{number:,}".replace(",", "\u202f")


def colours_in_words(number: int) -> Sentence:
    """A number of colours."""
    return Sentence("count.colours" if number != 1 else "count.colour", count=number)


def draw_legend(canvas: PrintCanvas, chart: Chart, inks: Inks, printing: Printing) -> None:
    """Draw the legend: swatch with symbol, symbol alone, name, count, share and need of every yarn that is used, then
    the need of the ground, and the mounting.
    """
    tied = chart.tied
    total = tied.total
    needs = dict(zip(chart.used, printing.bill.pile, strict=True)) if printing.bill else {}
    canvas.bookmarkPage("legend")
    canvas.addOutlineEntry(canvas.numerals(Sentence("legend.outline")), "legend", 0)
    title = Sentence("legend.title", colours=colours_in_words(len(chart.used)), knots=thousands(total))
    y = _begin(canvas, title, bool(needs))
    for index in chart.used:
        y = _room(canvas, y, _LINE, bool(needs))
        draw_entry(canvas, chart, inks, (index, tied.of(index), total), (_LEFT, y, _WIDTH if needs else _ALONE))
        if index in needs:
            _write_need(canvas, needs[index], y)
    if (chart.knots == NO_KNOT).any():
        y = _room(canvas, y, _LINE, bool(needs))
        _swatch(canvas, inks, NO_KNOT, _LEFT, y)
        canvas.setFont(TEXT, 9)
        canvas.write(_LEFT + 52.0, y, Sentence("rows.text-plain", sign=NO_SIGN))
    if chart.cells is not None and chart.cells.number(OUTSIDE):
        y = _room(canvas, y, _LINE, bool(needs))
        hatch(canvas, [(canvas.side(_LEFT, 24.0), y - 4.0, 24.0, 14.0)])
        canvas.setFillGray(0.1)
        canvas.setFont(TEXT, 9)
        canvas.write(_LEFT + 52.0, y, Sentence("legend.outside"))
    for note in (*_of_the_pile(chart, printing.pile), *printing.notes):
        rest = canvas.numerals(note)
        while rest:
            line, rest = two_lines(rest, 9, _ACROSS)
            y = _room(canvas, y, _LINE, bool(needs))
            canvas.setFont(TEXT, 9)
            canvas.setFillGray(0.1)
            canvas.write(_LEFT, y, Name(line))
    if printing.bill:
        y = _draw_ground(canvas, printing.bill, y)
    if printing.mounting:
        _draw_mounting(canvas, chart, printing.mounting, y)
    canvas.showPage()


def _of_the_pile(chart: Chart, pile: float | None) -> Iterator[Sentence]:
    """The heights of the pile and the lines that are carved into it; pile: as of `Printing`."""
    cells = chart.cells
    if cells is None:
        return
    knotted = [pair for pair in zip(cells.kinds, cells.counts, strict=True) if pair[0].knotted]
    usual = usual_pile_height(chart.quality) if pile is None else pile
    for kind, knots in knotted if len(knotted) > 1 else ():
        height = format_number((usual if kind.height is None else kind.height) / mm, 3)
        yield Sentence("legend.pile-loop" if kind.loop else "legend.pile", height=height, knots=thousands(knots))
    if len(knotted) > 1:
        yield Sentence("legend.pile-border")
    if cells.carving is not None:
        groove = {
            "depth": format_number(cells.carving.depth / mm, 3),
            "angle": format_number(math.degrees(cells.carving.angle), 3),
        }
        names = ", ".join(translated(noun(name)) for name in cells.carving.yarns)
        yield Sentence("legend.carve-round", **groove, yarns=names) if names else Sentence("legend.carve", **groove)


def draw_entry(
    canvas: PrintCanvas, chart: Chart, inks: Inks, counts: tuple[int, int, int], box: tuple[float, float, float]
) -> None:
    """Draw the entry of a yarn in the legend.

    counts  index of the yarn, its number of knots and that of all yarns
    box     where it begins from the side where lines begin, baseline and width [pt]
    """
    (index, count, total), (x, y, width) = counts, box
    _swatch(canvas, inks, index, x, y)
    canvas.setFont(TEXT, 9)
    share = 100 * count / total
    number = thousands(count)
    _write_number(canvas, x + width, y, f"{share:.1f} %" if share >= 0.05 else "< 0.1 %")
    _write_number(canvas, x + width - 44.0, y, number)
    used = max(canvas.text_width(number), _ROOM) if canvas.leftward else canvas.text_width(number)
    _write_name(canvas, chart.yarns[index].name, (x + 52.0, y), width - 106.0 - used)


def _swatch(canvas: PrintCanvas, inks: Inks, index: int, x: float, y: float) -> None:
    """Draw the colour of a code of the chart with its sign, and the sign alone beside it."""
    canvas.setFillColorRGB(*inks.fills[index])
    canvas.setStrokeGray(0.4)
    canvas.setLineWidth(0.4)
    canvas.rect(canvas.side(x, 24.0), y - 4.0, 24.0, 14.0, stroke=1, fill=1)
    canvas.setFont(SIGNS, 10)
    canvas.setFillGray(1.0 if inks.white[index] else 0.0)
    canvas.draw_sign(canvas.side(x + 12.0), y, inks.symbols[index])
    canvas.setFillGray(0.1)
    canvas.draw_sign(canvas.side(x + 38.0), y, inks.symbols[index])


def _write_number(canvas: PrintCanvas, end: float, y: float, text: str) -> None:
    """Write a number in the column that ends there from the side where lines begin, its ones below those above."""
    canvas.drawRightString(canvas.side(end) + (_ROOM if canvas.leftward else 0.0), y, text)


def _write_name(canvas: PrintCanvas, name: str, at: tuple[float, float], room: float) -> None:
    """Write a name in one line, or smaller in two."""
    (x, y), name = at, canvas.name_of(name)
    if line_width(name, _NAME) <= room:
        canvas.write_name(x, y, name, _NAME)
        return
    first, more = two_lines(name, _SMALL, room)
    canvas.write_name(x, y + 4.0 if more else y, cut_line(first, _SMALL, room), _SMALL)
    canvas.write_name(x, y - 3.5, cut_line(more, _SMALL, room), _SMALL)


def _begin(canvas: PrintCanvas, title: str, needs: bool) -> float:
    """Write the title of a page and the headings of its columns; the baseline above the first entry [pt]."""
    canvas.setFillColorRGB(0.1, 0.1, 0.1)
    canvas.setFont(STRONG, 13)
    canvas.write(_LEFT, _TOP, title)
    if needs:
        knots, share = Sentence("legend.knots"), Sentence("legend.share")
        _write_headings(canvas, _TOP - 17.0, ((knots, _WIDTH - 44.0), (share, _WIDTH), *_COLUMNS))
    return _TOP - 17.0


def _room(canvas: PrintCanvas, y: float, height: float, needs: bool = False) -> float:
    """The baseline below y, on a new page where the height [pt] does not fit."""
    if y - height < _LOW:
        canvas.showPage()
        y = _begin(canvas, Sentence("legend.continued"), needs)
    return y - _LINE


def _write_headings(canvas: PrintCanvas, y: float, headings: Sequence[tuple[str, float]]) -> None:
    canvas.setFont(TEXT, 7)
    canvas.setFillColorRGB(*_GREY)
    for heading, right in headings:
        _write_number(canvas, _LEFT + right, y, heading)


def _write_need(canvas: PrintCanvas, need: YarnNeed, y: float) -> None:
    """Length, mass, mass to buy and hanks of a line of the bill."""
    canvas.setFont(TEXT, 9)
    canvas.setFillGray(0.1)
    values = (need.length, need.mass / g, need.to_buy / g)
    texts = (*(f"{value:,.{0 if value >= 10 else 1}f}".replace(",", "\u202f") for value in values), str(need.hanks))
    for text, (_, right) in zip(texts, _COLUMNS, strict=True):
        _write_number(canvas, _LEFT + right, y, text)


def _draw_ground(canvas: PrintCanvas, bill: YarnBill, y: float) -> float:
    """Draw the lines of the ground's yarns and of all yarns; the last baseline [pt]."""
    y = _heading(canvas, Sentence("legend.ground"), y, _LINE * (len(bill.ground) + 1))
    for need in bill.ground:
        y -= _LINE * 0.8
        canvas.setFillGray(0.1)
        canvas.setFont(TEXT, 9)
        canvas.write(_LEFT + 52.0, y, need.name)
        _write_need(canvas, need, y)
    y -= _LINE
    canvas.setFont(STRONG, 9)
    canvas.write(_LEFT + 52.0, y, Sentence("legend.all"))
    mass, to_buy = bill.mass / g, sum(need.to_buy for need in bill.needs) / g
    for value, (_, right) in zip((mass, to_buy), _COLUMNS[1:3], strict=True):
        _write_number(canvas, _LEFT + right, y, thousands(round(value)))
    return y


def _draw_mounting(canvas: PrintCanvas, chart: Chart, made: Mounting, y: float) -> None:
    """Draw what the loom is set up and the weaving is checked by."""
    lines = mounting_lines(chart, made)
    y = _heading(canvas, Sentence("mounting.title"), y, _LINE * len(lines))
    for name, text in lines:
        y -= _LINE * 0.8
        canvas.setFont(TEXT, 9)
        canvas.setFillColorRGB(*_GREY)
        canvas.write(_LEFT + 52.0, y, name)
        canvas.setFillGray(0.1)
        canvas.write(_LEFT + 150.0, y, text)


def _heading(canvas: PrintCanvas, title: str, y: float, height: float) -> float:
    """A rule and the title of a part of a height, on a new page where it does not fit; its baseline [pt]."""
    if y - height - 2 * _GAP < _LOW:
        canvas.showPage()
        y = _begin(canvas, Sentence("legend.continued"), False)
    y -= _GAP
    canvas.setStrokeGray(_RULE)
    canvas.setLineWidth(0.4)
    left, width = canvas.side(_LEFT, _COLUMNS[-1][1]), _COLUMNS[-1][1]
    canvas.line(left, y + 14.0, left + width, y + 14.0)
    canvas.setFillGray(0.1)
    canvas.setFont(STRONG, 10)
    canvas.write(_LEFT, y, title)
    return y


def mounting_lines(chart: Chart, made: Mounting) -> tuple[tuple[Sentence, Sentence], ...]:
    """The mounting in words, each with its name; lengths in cm and mm, as they are measured on the loom.

    >>> from ilmek import read_yarns
    >>> from ilmek.carpet.mounting import mounting
    >>> made = Chart([[0] * 5, [1] * 5, [0] * 5], read_yarns()[:2], "10x6cm", "5x5/dm", "symmetric")
    >>> dict(mounting_lines(made, mounting(made)))["middle row"]
    'in row 2, 3.1 cm from the lower edge'
    """
    across, along = (10 * cm * TENS / mark for mark in (made.knot_mark, made.row_mark))
    halves = made.row_mark * chart.rows / TENS / 2, made.knot_mark * chart.columns / TENS / 2

    def line(key: str, text: str = "", **values: object) -> tuple[Sentence, Sentence]:
        return Sentence(f"mounting.{key}", count=TENS), Sentence(f"mounting.{text or f'{key}-text'}", **values)

    return (
        line("warps", warps=thousands(made.warps), edges=made.selvedge_warps),
        line("pitch", pitch=format_number(made.pitch / mm), width=_cm(made.width)),
        line("length", length=_cm(made.warp_length), fringe=_cm(made.fringe)),
        line("dense", across=format_number(round(across, 1)), along=format_number(round(along, 1))),
        line("middle-row", **_middle("row", made.middle_row), length=_cm(round(halves[0], 3))),
        line("middle-knot", **_middle("knot", made.middle_knot), length=_cm(round(halves[1], 3))),
        line("each-row", length=_cm(made.row_mark), count=TENS),
        line("each-knot", length=_cm(made.knot_mark)),
    )


def _cm(length: float) -> str:
    return format_number(length / cm)


def _middle(what: str, after: float) -> JsonObject:
    """The sentence of where a middle lies, and its numbers: between two of an even number, in one of an odd number."""
    if after == int(after):
        return {"text": f"between-{what}s", "number": round(after), "next": round(after) + 1}
    return {"text": f"in-{what}", "number": round(after + 0.5)}
