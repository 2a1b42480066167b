"""Rules of a price and of a weaver's wage, and what follows from them.

    unit price = cost (1 + margin),   net = quantity · unit price (1 - discount),   total = net (1 + tax)

Each is rounded to a hundredth of the currency, half up, as it is printed: a sum of printed amounts is a printed amount.

    wage = (knots + share · flat cells)/unit · amount (1 + supplement · colours beyond those that are free)

The wage of a region is counted in units of its own: 1,000 knots, 6,000 (a day's work), 12,000 or 14,000. A cell of flat
weave is the place of a knot without one, two warps and a row of wefts. That it earns a tenth of a knot is an
assumption: at 25 × 25/dm a square metre of it then is a day's work of 6,250 knots.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal

import numpy as np

from ilmek.carpet.cells import OUTSIDE
from ilmek.carpet.chart import Chart

CENT = Decimal("0.01")

FLAT = 0.1
"""What a cell of flat weave is in time and wage, of a knot [-]."""


def cents(amount: float | Decimal) -> Decimal:
    """An amount rounded to hundredths, half up.

    >>> str(cents(2.675)), str(cents(0.125))
    ('2.68', '0.13')
    """
    return Decimal(repr(amount) if isinstance(amount, float) else amount).quantize(CENT, ROUND_HALF_UP)


@dataclass(frozen=True, slots=True)
class QuotedPrice:
    """The price of equal carpets, without tax; discount: a share [-]."""

    cost: Decimal
    unit: Decimal
    quantity: int
    discount: float
    net: Decimal


@dataclass(frozen=True, slots=True)
class PriceRules:
    """margin on the cost, tax on the net price [-]; discounts: from a number of carpets of the order on, a share.

    valid      days for which a quotation holds
    finishing  cost of washing, shearing and inspection of a square metre; None: that of the loom's rates, in euros
    carving    cost of a metre of carved lines; None: that of the loom's rates, in euros
    """

    margin: float = 0.30
    tax: float = 0.0
    discounts: tuple[tuple[int, float], ...] = ()
    valid: int = 30
    finishing: float | None = None
    carving: float | None = None

    def discount(self, carpets: int) -> float:
        """The discount of an order of so many carpets [-].

        >>> PriceRules(discounts=((2, 0.03), (5, 0.08))).discount(4)
        0.03
        """
        return max((share for least, share in self.discounts if carpets >= least), default=0.0)

    def quoted(self, cost: float, quantity: int, carpets: int) -> QuotedPrice:
        """The price of equal carpets of a cost each, in an order of so many carpets.

        >>> price = PriceRules(0.25, 0.19, ((2, 0.1),)).quoted(100.0, 2, 2)
        >>> str(price.unit), str(price.net)
        ('125.00', '225.00')
        """
        spent, share = cents(cost), self.discount(carpets)
        unit = cents(spent * (1 + Decimal(repr(self.margin))))
        net = cents(quantity * unit * (1 - Decimal(repr(share))))
        return QuotedPrice(spent, unit, quantity, share, net)

    def taxed(self, net: Decimal) -> Decimal:
        """The tax on the net price of an order: of the sum, as who checks it computes it.

        >>> str(PriceRules(tax=0.19).taxed(Decimal("635.55")))
        '120.75'
        """
        return cents(net * Decimal(repr(self.tax)))


@dataclass(frozen=True, slots=True)
class WagePayment:
    """A payment after a row, of the knots and flat cells since the one before: earned, less its part of the advance."""

    row: int
    knots: int
    flat: int
    earned: Decimal
    deducted: Decimal

    @property
    def paid(self) -> Decimal:
        """What is paid out."""
        return self.earned - self.deducted


@dataclass(frozen=True, slots=True)
class WageRules:
    """A wage by knots: amount per `knots`, a supplement for each colour beyond `colours` [-], an advance [-].

    rows    after which a payment is due; 0: once, at the end      region  whose rules they are
    flat    share of the wage of a knot that a cell of flat weave earns [-]
    """

    amount: float
    knots: int = 1000
    colours: int = 0
    supplement: float = 0.0
    advance: float = 0.0
    rows: int = 100
    region: str = ""
    flat: float = FLAT

    def rate(self, colours: int) -> float:
        """What a knot earns in a design of so many colours."""
        more = max(0, colours - self.colours) if self.supplement else 0
        return self.amount / self.knots * (1 + self.supplement * more)

    def wage(self, knots: int, colours: int, flat: int = 0) -> Decimal:
        """The wage of a carpet of so many knots and cells of flat weave.

        >>> rules = WageRules(9.0, 10_000, colours=8, supplement=0.02)
        >>> str(rules.wage(135_360, 10)), str(rules.wage(135_360, 10, flat=10_000))
        ('126.70', '127.63')
        """
        return cents(self.rate(colours) * (knots + self.flat * flat))

    def of(self, chart: Chart) -> Decimal:
        """The wage of the carpet of a chart."""
        knots, flat = np.sum(woven_in_rows(chart), axis=0).tolist()
        return self.wage(knots, chart.colours, flat)

    def payments(self, in_rows: Sequence[tuple[int, int]], colours: int) -> tuple[WagePayment, ...]:
        """The payments of a carpet of so many knots and flat cells in each row, row 1 first; together its wage."""
        done = np.cumsum([(0, 0), *in_rows], axis=0).tolist()
        whole = self.wage(done[-1][0], colours, done[-1][1])
        advance = cents(whole * Decimal(repr(self.advance)))
        step = self.rows or len(in_rows)
        payments, earned, deducted = list[WagePayment](), Decimal(0), Decimal(0)
        for first in range(0, len(in_rows), step):
            row = min(first + step, len(in_rows))
            knots, flat = done[row]
            due = self.wage(knots, colours, flat)
            back = cents(advance * due / whole) if whole else Decimal(0)
            since = knots - done[first][0], flat - done[first][1]
            payments.append(WagePayment(row, *since, due - earned, back - deducted))
            earned, deducted = due, back
        return tuple(payments)


def woven_in_rows(chart: Chart) -> list[tuple[int, int]]:
    """The knots and the cells of flat weave in each row, row 1 first; a cell with two half knots is a knot.

    >>> from ilmek import read_yarns
    >>> from ilmek.carpet.shape import with_ends
    >>> woven_in_rows(with_ends(Chart([[0, 0], [0, 0]], read_yarns()[:1], "2x2cm", "10x10/dm", "symmetric"), 1))
    [(0, 2), (2, 0), (2, 0), (0, 2)]
    """
    tied = chart.knots < len(chart.yarns)  # a cell without a knot has the code of no yarn
    flat = np.zeros_like(tied) if chart.cells is None else ~tied & ~chart.cells.are(OUTSIDE)
    counts = (np.count_nonzero(cells, axis=1)[::-1].tolist() for cells in (tied, flat))
    return list(zip(*counts, strict=True))
