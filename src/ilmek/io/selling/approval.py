"""Approval sheet of an order as PDF: each carpet whole, with its colour card, a part at true size, the strike-off."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from reportlab.lib.units import cm

from ilmek.carpet.yarn import Yarn
from ilmek.io.chart.lettering import cut_line
from ilmek.io.chart.printing import printed_file
from ilmek.io.chart.symbols import SIGNS, symbols
from ilmek.io.selling.offer import Offer, OfferedCarpet
from ilmek.io.selling.page import LEFT, LOW, ROOM, OrderPage, PageColumn
from ilmek.io.selling.quotation import carpet_facts
from ilmek.sentences import Sentence

_CARD = (
    PageColumn(Sentence("order.symbol"), 34.0),
    PageColumn(Sentence("order.number"), 108.0, end=True),
    PageColumn(Sentence("order.yarn"), 124.0),
    PageColumn("sRGB", 300.0),
    PageColumn(Sentence("order.knots"), 420.0, end=True),
    PageColumn(Sentence("order.lots"), ROOM, end=True),
)
WIDEST = 0.45
"""Greatest part of the lines' width that the carpet takes beside the facts of its strike-off."""

_SIGNED = ("order.approved", "order.changes", "order.signed")


def write_approval(path: Path, offer: Offer) -> None:
    """Write the approval sheet in the language that is spoken. Raises OSError."""
    title = Sentence("order.approval")
    with printed_file(path, title) as canvas:
        page = OrderPage(canvas, title, offer.reference)
        for number, carpet in enumerate(offer.carpets):
            if number:
                page.begin()
            _whole(page, carpet)
            _true_size(page, carpet)
        page.end()


def _whole(page: OrderPage, carpet: OfferedCarpet) -> None:
    """The whole carpet beside its facts, what is to be signed, and the colour card."""
    page.heading(carpet.name, 14.0)
    top, wide, high = page.y, 0.56 * ROOM, 420.0
    page.picture(carpet.shown.whole, LEFT, top - high, wide, high)
    page.y = top - 10.0
    page.facts(carpet_facts(carpet), LEFT + wide + 14.0, 66.0)
    page.y -= 20.0
    for key in _SIGNED:
        page.write(LEFT + wide + 14.0, page.y, Sentence(key), 9)
        page.rule(page.y - 22.0, LEFT + wide + 14.0, ROOM - wide - 14.0)
        page.y -= 44.0
    page.y = top - high - 12.0
    chart, signs = carpet.chart, symbols(carpet.chart.yarns)
    lines = [
        (chart.yarns[index], signs[index], f"{chart.tied.of(index):,}".replace(",", "\u202f"), str(need.lots))
        for index, need in zip(chart.used, carpet.bill.pile, strict=True)
    ]
    page.heading(Sentence("order.card"), 11.0)
    _draw_card(page, _CARD, lines)


def write_card(path: Path, yarns: Sequence[Yarn], lots: Mapping[str, str], reference: str) -> None:
    """Write the colour card of a shelf in the language that is spoken; lots: those in stock. Raises OSError."""
    title = Sentence("order.card")
    columns = (*_CARD[:4], PageColumn("", 420.0, end=True), PageColumn(Sentence("order.lot"), ROOM, end=True))
    with printed_file(path, title) as canvas:
        page = OrderPage(canvas, title, reference)
        page.heading(title, 15.0)
        signs = symbols(yarns)
        lines = [(yarn, sign, "", lots.get(yarn.name, "–")) for yarn, sign in zip(yarns, signs, strict=True)]
        _draw_card(page, columns, lines)
        page.end()


def _draw_card(page: OrderPage, columns: Sequence[PageColumn], lines: Sequence[tuple[Yarn, str, str, str]]) -> None:
    """Swatch, symbol, number of the shelf, name, sRGB, knots, dye lots of each yarn."""
    page.table(columns, ())
    page.y += 4.0
    for yarn, sign, knots, own in lines:
        if page.y - 14.0 < LOW:
            page.begin()
            page.table(columns, ())
            page.y += 4.0
        page.swatch(LEFT, page.y - 1.5, yarn.srgb, (26.0, 10.0))
        page.canvas.setFillGray(0.1)
        page.canvas.setFont(SIGNS, 9)
        page.canvas.draw_sign(page.canvas.side(LEFT + 44.0), page.y, sign)
        name = cut_line(page.canvas.name_of(yarn.name), 8.5, 170.0)
        values = (str(yarn.number or "–"), name, yarn.hex, knots, own)
        for column, text in zip(columns[1:], values, strict=True):
            page.write(LEFT + column.x, page.y, text, 8.5, end=column.end)
        page.y -= 14.0


def _true_size(page: OrderPage, carpet: OfferedCarpet) -> None:
    """A part of the carpet at true size, and where the strike-off is cut."""
    page.begin()
    shown = carpet.shown
    page.heading(Sentence("order.true-size"), 12.0)
    wide, long = (100 * cm * side for side in shown.detail_size)
    page.picture(shown.detail, LEFT, page.y - long, wide, long)
    page.y -= long + 12.0
    page.write(LEFT, page.y, Sentence("order.scale", length="5"), 8, grey=True)
    page.y -= 8.0
    left = page.canvas.side(LEFT, 5 * cm)
    page.canvas.setStrokeGray(0.1)
    page.canvas.setLineWidth(1.0)
    page.canvas.line(left, page.y, left + 5 * cm, page.y)
    for x in (left, left + 5 * cm):
        page.canvas.line(x, page.y - 3.0, x, page.y + 3.0)
    page.y -= 16.0
    page.heading(Sentence("order.strike-off"), 12.0)
    _strike_off(page, carpet)


def _strike_off(page: OrderPage, carpet: OfferedCarpet) -> None:
    chart, sample, shown = carpet.chart, carpet.shown.sample, carpet.shown
    scale = min(min(190.0, page.y - LOW - 20.0) / shown.whole.height, WIDEST * ROOM / shown.whole.width)
    high, wide = scale * shown.whole.height, scale * shown.whole.width
    page.picture(shown.whole, LEFT, page.y - high, wide, high)
    left, top, across, down = shown.pile
    corner = page.canvas.side(LEFT, wide) + wide * (left + across * sample.left / chart.columns)
    size = wide * across * sample.columns / chart.columns, high * down * sample.rows / chart.rows
    lower = page.y - high * (top + down * sample.top / chart.rows) - size[1]
    for width, grey in ((2.4, 1.0), (1.0, 0.0)):
        page.canvas.setLineWidth(width)
        page.canvas.setStrokeGray(grey)
        page.canvas.rect(corner, lower, *size, stroke=1, fill=0)
    page.y -= 12.0
    low = chart.rows - sample.top - sample.rows + 1
    sides = (sample.columns / chart.quality.across, sample.rows / chart.quality.along)
    across_cm, along_cm = (f"{100 * side:.1f}" for side in sides)
    page.facts(
        [
            (Sentence("order.size"), Sentence("chart.size", width=across_cm, length=along_cm)),
            (Sentence("order.rows"), Sentence("order.from-to", first=low, last=low + sample.rows - 1)),
            (
                Sentence("order.cells"),
                Sentence("order.from-to", first=sample.left + 1, last=sample.left + sample.columns),
            ),
        ],
        LEFT + wide + 20.0,
        90.0,
    )
    page.y -= 6.0
    page.paragraph(Sentence("order.strike-note"), LEFT + wide + 20.0, 8, grey=True)
