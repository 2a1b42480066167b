"""Tables of a loom's parts and of its price: what each part costs, by what causes, and the rates used."""

from collections.abc import Iterable, Mapping

from ilmek.elements.making import RATES
from ilmek.elements.prices import PriceRates, price_of
from ilmek.report import BillLine, Table, columns


def parts_table(lines: Iterable[BillLine], prices: Mapping[str, PriceRates]) -> Table:
    """The parts of a loom with their masses and prices."""
    heads = columns("part | number | description | material | mass of one [kg] 3 | mass of all [kg] | price of all")
    rows = tuple(
        (
            *(line.name, line.number, line.description, line.material, line.mass),
            line.number * line.mass,
            price_of(line, prices),
        )
        for line in lines
    )
    return Table("loom-parts", "Parts of the loom", heads, rows)


def price_table(shares: Mapping[str, float]) -> Table:
    """Where the price of a loom comes from."""
    whole = sum(shares.values())
    rows = (*((cause, price, price / whole) for cause, price in shares.items()), ("sold", whole, 1.0))
    return Table("loom-machine-cost", "Price of the loom by cause", columns("cause | price | share [%]"), rows)


def prices_tables(prices: Mapping[str, PriceRates]) -> tuple[Table, ...]:
    """Prices of bought parts, and the rates of the workshop."""
    workshop = {rate.kind for rate in RATES}
    bought = ((kind, r.each, r.per_kg, r.per_m, r.per_W) for kind, r in prices.items() if kind not in workshop)
    heads = columns("kind of part", "each", "per kg", "per m", "per W")
    rates = (
        (f"{rate.kind} {rate.label}", prices[rate.kind].rate(rate.label), *rate.usual, rate.source) for rate in RATES
    )
    return (
        Table("loom-prices", "Prices used; set others with `prices`", heads, tuple(bought)),
        Table(
            "loom-workshop",
            "Rates of the workshop; set others with `prices`",
            columns("rate | value | usual, from | to | source"),
            tuple(rates),
        ),
    )
