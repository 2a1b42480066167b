"""Quotation of an order as PDF: prices and days of delivery, the colourways side by side, each carpet in a room."""

from collections.abc import Iterable
from decimal import Decimal
from pathlib import Path

from ilmek.carpet.construction import CarpetConstruction
from ilmek.io.chart.legend import thousands
from ilmek.io.chart.lettering import cut_line
from ilmek.io.chart.printing import printed_file, quality_of, size_of
from ilmek.io.selling.offer import Offer, OfferedCarpet
from ilmek.io.selling.page import LEFT, ROOM, OrderPage, PageColumn
from ilmek.sentences import Name, Sentence, noun, translated
from ilmek.units import cm, deg, format_number, mm

_LINES = (
    PageColumn(Sentence("order.carpet"), 0.0),
    PageColumn(Sentence("order.pieces"), 262.0, end=True),
    PageColumn(Sentence("order.unit-price"), 322.0, end=True),
    PageColumn(Sentence("order.discount"), 372.0, end=True),
    PageColumn(Sentence("order.net"), 436.0, end=True),
    PageColumn(Sentence("order.delivery"), ROOM, end=True),
)
FIBRES = {"wool": "order.fibre-wool", "cotton": "order.fibre-cotton", "silk": "order.fibre-silk"}
"""Keys of the sentences that name the materials of yarns."""

_BESIDE = 4
"""Most colourways beside one another."""


def write_quotation(path: Path, offer: Offer) -> None:
    """Write the quotation in the language that is spoken. Raises OSError."""
    title = Sentence("order.quotation")
    with printed_file(path, title) as canvas:
        page = OrderPage(canvas, title, offer.reference)
        _prices(page, offer)
        for group in offer.designs:
            if len(group) > 1:
                _side_by_side(page, group)
            for carpet in group:
                _in_room(page, offer, carpet)
        page.end()


def money(amount: Decimal, currency: str = "") -> str:
    """An amount as it is printed; the sign ﷼, which the fonts lack, in letters."""
    currency = currency.replace("﷼", "ریال")
    return f"{amount:,.2f}{f' {currency}' if currency else ''}".replace(",", "\u202f")


def percent(share: float) -> str:
    """A share in percent."""
    return f"{format_number(100 * share)} %"


def _prices(page: OrderPage, offer: Offer) -> None:
    page.heading(Sentence("order.quotation"), 20.0)
    dates = [(Sentence("order.reference"), offer.reference)] if offer.reference else []
    dates += [(Sentence("order.date"), offer.date), (Sentence("order.until"), offer.until)]
    page.facts(dates)
    page.heading(Sentence("order.prices"))
    rows = [
        (
            Name(cut_line(carpet.name, 8.5, 205.0)),
            str(carpet.price.quantity),
            money(carpet.price.unit),
            percent(carpet.price.discount) if carpet.price.discount else "–",
            money(carpet.price.net),
            carpet.delivery or "–",
        )
        for carpet in offer.carpets
    ]
    tax = Sentence("order.tax", share=percent(offer.rules.tax))
    sums = [(Sentence("order.net-sum"), "", "", "", money(offer.net), "")]
    if offer.rules.tax:
        sums += [(tax, "", "", "", money(offer.tax), "")]
    sums += [(Sentence("order.total", currency=offer.currency), "", "", "", money(offer.net + offer.tax), "")]
    page.table(_LINES, [*rows, *sums], sums=len(sums))
    page.heading(Sentence("order.costs"))
    for carpet in offer.carpets:
        _costs(page, offer, carpet)


def _costs(page: OrderPage, offer: Offer, carpet: OfferedCarpet) -> None:
    """What the price of a carpet consists of."""
    price = carpet.price
    margin = Sentence("order.margin", share=percent(offer.rules.margin))
    lines = [*carpet.costs, (margin, price.unit - price.cost)]
    page.room(14.0 * (len(lines) + 3))
    page.write(LEFT, page.y, carpet.name, 9, strong=True)
    page.y -= 14.0
    for name, amount in lines:
        page.write(LEFT + 12.0, page.y, name, 8.5, grey=True)
        page.write(LEFT + 262.0, page.y, money(amount), 8.5, end=True)
        page.y -= 12.0
    page.rule(page.y + 8.5, LEFT + 12.0, 250.0)
    page.write(LEFT + 12.0, page.y - 2.0, Sentence("order.of-one"), 8.5)
    page.write(LEFT + 262.0, page.y - 2.0, money(price.unit, offer.currency), 8.5, end=True, strong=True)
    page.y -= 20.0


def _side_by_side(page: OrderPage, group: list[OfferedCarpet]) -> None:
    """The colourways of a design beside one another, each with its yarns."""
    page.begin()
    page.heading(Sentence("order.colourways", name=group[0].design), 14.0)
    across = min(_BESIDE, len(group))
    width = (ROOM - 12.0 * (across - 1)) / across
    for first in range(0, len(group), across):
        row = group[first : first + across]
        most = max(len(carpet.chart.used) for carpet in row)
        high = min(380.0, width * max(one.shown.whole.height / one.shown.whole.width for one in row))
        page.room(high + 24.0 + 13.0 * most)
        top = page.y
        for number, carpet in enumerate(row):
            x = LEFT + number * (width + 12.0)
            page.picture(carpet.shown.whole, x, top - high, width, high)
            page.write(x, top - high - 14.0, Name(cut_line(carpet.name, 8.0, width)), 8.0, strong=True)
            for line, index in enumerate(carpet.chart.used):
                yarn, y = carpet.chart.yarns[index], top - high - 29.0 - 13.0 * line
                page.swatch(x, y - 1.5, yarn.srgb)
                page.write(x + 28.0, y, cut_line(page.canvas.name_of(yarn.name), 8.0, width - 30.0), 8.0)
        page.y = top - high - 36.0 - 13.0 * most


def carpet_facts(carpet: OfferedCarpet) -> list[tuple[str, str]]:
    """Size, quality, knots, construction, mass and colours of a carpet."""
    chart, bill = carpet.chart, carpet.bill
    knots = Sentence("order.knots-text", knots=thousands(bill.knots), knot=noun(chart.knot))
    return [
        (Sentence("order.size"), size_of(chart.size)),
        (Sentence("order.quality"), quality_of(chart.quality)),
        (Sentence("order.knots"), knots),
        *construction_facts(carpet.made),
        (Sentence("order.mass"), Sentence("order.mass-text", mass=f"{bill.mass_per_area * bill.area:.2f}")),
        (Sentence("order.colours"), str(len(chart.used))),
    ]


def outline_facts(made: CarpetConstruction) -> list[tuple[str, str]]:
    """Shape and kilim ends of a carpet in words."""
    shape = (Sentence("order.shape"), Sentence(f"order.shape-{made.shape}"))
    lower, upper = (format_number(round(end / cm, 1)) for end in made.ends)
    ends = (Sentence("order.ends"), Sentence("order.ends-text", lower=lower, upper=upper))
    return [shape, ends] if any(made.ends) else [shape]


def construction_facts(made: CarpetConstruction) -> list[tuple[str, str]]:
    """Outline, edge, flat weave and piles of a carpet in words."""
    facts = outline_facts(made)
    if made.edge:
        sides = {"length": f"{made.edge:.2f}", "width": format_number(made.binding_width / mm)}
        yarn = noun(made.binding_yarn)
        facts += [
            (Sentence("order.binding"), Sentence(f"order.binding-{made.binding or 'none'}", yarn=yarn, **sides)),
        ]
    if made.flat:
        facts += [(Sentence("order.flat"), Sentence("order.flat-area", area=f"{made.flat:.3f}"))]
    for pile in made.piles:
        key = "order.pile-loop" if pile.loop else "order.pile-cut"
        height = format_number(round(pile.height / mm, 2))
        facts += [(Sentence("order.pile"), Sentence(key, height=height, knots=thousands(pile.knots)))]
    if len(made.fibres) > 1:
        facts += [(Sentence("order.pile-fibre"), fibres_in_words(made.fibres))]
    if made.carving is not None:
        depth, angle = format_number(round(made.carving.depth / mm, 2)), format_number(round(made.carving.angle / deg))
        lines = Sentence("order.carving-text", length=f"{made.carved:.1f}", depth=depth, angle=angle)
        facts += [(Sentence("order.carving"), lines)]
    return facts


def fibres_in_words(shares: Iterable[tuple[str, float]]) -> str:
    """Materials with their shares, in the language that is spoken."""
    return ", ".join(f"{translated(Sentence(FIBRES[name]))} {100 * share:.0f} %" for name, share in shares)


def _in_room(page: OrderPage, offer: Offer, carpet: OfferedCarpet) -> None:
    page.begin()
    page.heading(carpet.name, 14.0)
    _, height = page.picture(carpet.shown.room, LEFT, page.y - ROOM * 2 / 3, ROOM, ROOM * 2 / 3)
    page.y -= height + 18.0
    page.facts(
        [
            *carpet_facts(carpet),
            (Sentence("order.unit-price"), money(carpet.price.unit, offer.currency)),
            (Sentence("order.delivery"), carpet.delivery or Sentence("order.not-woven")),
        ]
    )
    page.y -= 4.0
    page.paragraph(Sentence("order.room-note"), LEFT, 7.5, grey=True)
