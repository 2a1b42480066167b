"""Terms of a customer's order as TOML: price, wage by knots, and the colourways of a design.

[price]
margin = "30%"                              # on the cost
tax = "19%"
discount = { 2 = "3%", 5 = "8%" }           # from so many carpets of the order on
valid = 30                                  # days

[wage]
region = "Hereke"
amount = "9 EUR"                            # for so many knots
knots = 10000
colours = 8                                 # a supplement for each further colour
supplement = "2%"
advance = "20%"
rows = 100                                  # a payment after each 100 rows
flat_weave = "10%"                          # of the wage of a knot, for a cell of flat weave

[[order.colourway]]
name = "indigo"
map = { "madder red" = "indigo navy", camel = "#c8d4dc" }
yarns = "dyed.toml"                         # the shelf; default: that of the order
quantity = 2                                # default: that of the order
"""

from ilmek.carpet.colourways import Colourway
from ilmek.carpet.price_rules import PriceRules, WageRules
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.errors import ParameterError
from ilmek.io.factory_entry import FactoryEntry
from ilmek.io.schema import shown

MOST_COLOURWAYS = 20
"""Largest number of colourways of an order, and of its sizes."""

_LARGEST_COUNT = 1_000_000


def read_price(root: FactoryEntry, currency: str) -> PriceRules:
    """The rules of a price; without the table those of the class."""
    row, usual = root.table("price"), PriceRules()
    row.keys("margin", "tax", "discount", "valid", "finishing", "carving")
    discounts = row.table("discount")
    steps = []
    for key in discounts.data:
        if not key.isdigit() or not 1 <= int(key) <= _LARGEST_COUNT:
            row.refuse(ParameterError(f"{shown(key)} is no number of carpets", do='write { 5 = "8%" }'), "discount")
        steps.append((int(key), discounts.measured(key, "%", most=1.0)))
    return PriceRules(
        row.measured("margin", "%", usual.margin, most=20.0),
        row.measured("tax", "%", usual.tax, most=1.0),
        tuple(sorted(steps)),
        row.count("valid", usual.valid, 1, 1000),
        row.money("finishing", currency, "m^2"),
        row.money("carving", currency, "m"),
    )


def read_wage(root: FactoryEntry, currency: str) -> WageRules | None:
    """The rules of the wage; None without the table."""
    if not root.has("wage"):
        return None
    row, usual = root.table("wage"), WageRules(0.0)
    keys = ("amount", "knots", "colours", "supplement", "advance", "rows", "region", "flat_weave")
    row.keys(*keys, needs=("amount",))
    return WageRules(
        row.money("amount", currency) or 0.0,
        row.count("knots", usual.knots, 1, _LARGEST_COUNT),
        row.count("colours", usual.colours, 0, MOST_YARNS),
        row.measured("supplement", "%", usual.supplement, most=1.0),
        row.measured("advance", "%", usual.advance, most=1.0),
        row.count("rows", usual.rows, 0, _LARGEST_COUNT),
        row.label("region") if row.has("region") else usual.region,
        row.measured("flat_weave", "%", usual.flat, most=10.0),
    )


def read_colourways(order: FactoryEntry) -> list[tuple[FactoryEntry, Colourway]]:
    """The colourways of an order with their tables."""
    rows = order.rows("colourway")
    if len(rows) > MOST_COLOURWAYS:
        order.refuse(ParameterError(f"has {len(rows)} colourways", allowed=f"at most {MOST_COLOURWAYS}"), "colourway")
    read = []
    for row in rows:
        row.keys("name", "map", "yarns", "quantity", needs=("name",))
        exchange = row.table("map")
        read.append((row, Colourway(row.label("name"), {old: exchange.text(old) for old in exchange.data})))
    return read
