"""Wage sheet of a carpet as PDF: its knots, the rules of its wage, what is woven, and each payment."""

from decimal import Decimal
from pathlib import Path

from ilmek.carpet.price_rules import WagePayment, WageRules
from ilmek.io.chart.legend import thousands
from ilmek.io.chart.printing import printed_file
from ilmek.io.selling.page import ROOM, OrderPage, PageColumn
from ilmek.io.selling.quotation import money, percent
from ilmek.records import record
from ilmek.report.paper import BOX
from ilmek.sentences import Name, Sentence

_PAYMENTS = (
    PageColumn(BOX, 0.0),
    PageColumn(Sentence("order.after-row"), 90.0, end=True),
    PageColumn(Sentence("order.knots"), 150.0, end=True),
    PageColumn(Sentence("order.flat"), 220.0, end=True),
    PageColumn(Sentence("order.earned"), 290.0, end=True),
    PageColumn(Sentence("order.deducted"), 380.0, end=True),
    PageColumn(Sentence("order.paid"), ROOM, end=True),
)


@record
class WageSheet:
    """The wage of a carpet by its rules; done: rows that are woven, of which the payments are due."""

    rules: WageRules
    currency: str
    rows: int
    colours: int
    payments: tuple[WagePayment, ...]
    done: int = 0

    @property
    def wage(self) -> Decimal:
        """Of the whole carpet."""
        return sum((one.earned for one in self.payments), Decimal(0))

    @property
    def knots(self) -> int:
        """Of the whole carpet."""
        return sum(one.knots for one in self.payments)

    @property
    def flat(self) -> int:
        """Cells of flat weave of the whole carpet."""
        return sum(one.flat for one in self.payments)

    @property
    def advance(self) -> Decimal:
        """Paid before the first row."""
        return sum((one.deducted for one in self.payments), Decimal(0))

    @property
    def due(self) -> Decimal:
        """What has been earned by rows that are done, less its part of the advance."""
        return sum((one.paid for one in self.payments if one.row <= self.done), Decimal(0))


def write_wages(path: Path, name: str, sheet: WageSheet) -> None:
    """Write the wage sheet in the language that is spoken. Raises OSError."""
    title, rules = Sentence("order.wages"), sheet.rules
    with printed_file(path, title) as canvas:
        page = OrderPage(canvas, title, name)
        page.heading(name, 15.0)
        amount = money(Decimal(repr(rules.amount)).quantize(Decimal("0.01")), sheet.currency)
        facts = [(Sentence("order.rule"), Name(rules.region))] if rules.region else []
        facts += [(Sentence("order.rate"), Sentence("order.rate-text", amount=amount, knots=thousands(rules.knots)))]
        if rules.supplement:
            share = percent(rules.supplement)
            text = Sentence("order.supplement-text", share=share, colours=rules.colours, used=sheet.colours)
            facts += [(Sentence("order.supplement"), text)]
        facts += [(Sentence("order.knots"), thousands(sheet.knots))]
        if sheet.flat:
            share = Sentence("order.flat-rate-text", share=percent(rules.flat))
            facts += [(Sentence("order.flat"), thousands(sheet.flat)), (Sentence("order.flat-rate"), share)]
        facts += [
            (Sentence("order.wage"), money(sheet.wage, sheet.currency)),
            (Sentence("order.advance"), money(sheet.advance, sheet.currency)),
            (Sentence("order.woven"), Sentence("order.woven-text", done=sheet.done, rows=sheet.rows)),
            (Sentence("order.due"), money(sheet.due, sheet.currency)),
        ]
        page.facts(facts, beside=140.0)
        page.heading(Sentence("order.payments"))
        rows = [
            (
                "✓" if one.row <= sheet.done else BOX,
                str(one.row),
                thousands(one.knots),
                thousands(one.flat) if one.flat else "–",
                money(one.earned),
                money(one.deducted),
                money(one.paid),
            )
            for one in sheet.payments
        ]
        total = (
            "",
            "",
            thousands(sheet.knots),
            thousands(sheet.flat) if sheet.flat else "–",
            money(sheet.wage),
            money(sheet.advance),
            money(sheet.wage - sheet.advance),
        )
        page.table(_PAYMENTS, [*rows, total], sums=1)
        page.end()
