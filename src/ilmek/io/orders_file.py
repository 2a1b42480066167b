"""Orders of a factory as TOML.

    start = 2026-12-01T06:00:00                 # begin of the plan, local time
    currency = "EUR"
    late = "40 EUR/d"                           # of an order that sets none, by the started hour; default: 1 EUR/d

    [[order]]
    name = "Kazak, first"
    picture = "recipes/kazak.toml"              # picture, chart or recipe, with the keys of `ilmek weave`
    quantity = 2
    due = 2026-12-18T16:00:00                   # a date alone: its end
    earliest = 2026-12-03
    late = "80 EUR/d"
    priority = 2                                # how many times its delay counts

    [[order]]
    name = "Runner"
    programme = "runner/programme.ilmek"        # for the loom that it was compiled for

An order in several `sizes`, or in several colourways, is one of each size in each colourway, named after them. What
only a customer's order has, `customer`, `looms`, and the terms of `order_terms`, changes no plan.

Files are named relative to the folder of the orders and lie in it.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path

from ilmek.carpet.colourways import Colourway
from ilmek.carpet.price_rules import PriceRules, WageRules
from ilmek.carpet.yarn_plan import EURO
from ilmek.errors import IlmekError, ParameterError, restated
from ilmek.io.data_text import read_data
from ilmek.io.factory_entry import LARGEST, FactoryEntry, file_beside
from ilmek.io.order_terms import MOST_COLOURWAYS, read_colourways, read_price, read_wage
from ilmek.io.schema import SourceText, shown
from ilmek.io.yarn_file import SHIPPED
from ilmek.params import Parameter, Setting
from ilmek.sentences import DEFAULT, WEAVERS
from ilmek.units import hour

MOST_ORDERS = 3000
"""Largest number of orders of a file, and of carpets in all of them."""

MOST_PRIORITY = 100

LATE = 1 / (24 * hour)
"""Cost of delay where a file states none: one of its currency a day, so that it counts at all [1/s]."""

ORDER_KEYS = ("name", "picture", "programme", "quantity", "due", "earliest", "late", "priority")
CARPET_KEYS = ("size", "sizes", "quality", "knot", "yarns", "colourway")


@dataclass(frozen=True, slots=True)
class FactoryOrder:
    """An order of one or more equal carpets.

    picture, programme  its file: one of them
    carpet    size, quality, knot as texts, and settings of a carpet by name      yarns  yarn list
    late      cost of a day of delay of one carpet, times the priority [currency/s]
    design    name of its order in the file, of which it is one size in one colourway
    where     file and line, for messages
    """

    name: str
    picture: Path | None
    programme: Path | None
    quantity: int
    earliest: datetime
    due: datetime
    late: float
    priority: int
    carpet: Mapping[str, Setting] = field(default_factory=dict)
    yarns: Path | None = None
    where: str = ""
    design: str = ""
    colourway: Colourway | None = None

    def __hash__(self) -> int:
        return hash((self.name, self.where))


@dataclass(frozen=True, slots=True)
class FactoryOrders:
    """The orders of a file: begin of the plan, currency, orders, and the terms of a customer's order.

    customer  reference of the customer; ""      looms  the factory's file, or None
    language, workshop_language  of the customer's papers, and of the weavers'
    """

    path: Path
    start: datetime
    currency: str
    orders: tuple[FactoryOrder, ...]
    customer: str = ""
    looms: Path | None = None
    price: PriceRules = PriceRules()
    wage: WageRules | None = None
    language: str = DEFAULT
    workshop_language: str = DEFAULT


def read_orders(path: Path, parameters: Mapping[str, Parameter]) -> FactoryOrders:
    """The orders of a .toml file; the pictures are not opened.

    parameters  of a carpet, each under every name that a key may have
    Raises ParameterError with the file, the line and the key for any error in the file.
    """
    text = read_data(path, "orders", ParameterError, largest=LARGEST)
    with restated(ParameterError):
        return _orders(FactoryEntry(text.data, (), SourceText(str(path), text.lines)), path, parameters)


def _orders(root: FactoryEntry, path: Path, parameters: Mapping[str, Parameter]) -> FactoryOrders:
    terms = ("customer", "looms", "price", "wage", "language", "workshop_language")
    root.keys("start", "currency", "late", "order", *terms, needs=("start", "order"))
    currency, start = root.currency(EURO), root.instant("start")
    late = root.money("late", currency, "d")
    late = LATE if late is None else late
    rows = root.rows("order")
    if not 1 <= len(rows) <= MOST_ORDERS:
        root.refuse(ParameterError(f"has {len(rows)} orders", allowed=f"1 to {MOST_ORDERS}"), "order")
    read = _OrderReader(path, start, currency, late, parameters)
    orders, names = list[FactoryOrder](), set[str]()
    for row in rows:
        for order in read.orders(row):
            if order.name in names:
                row.refuse(ParameterError(f"two orders are named {order.name!r}", do="give each its own name"), "name")
            names.add(order.name)
            orders.append(order)
    carpets = sum(order.quantity for order in orders)
    if carpets > MOST_ORDERS:
        root.refuse(ParameterError(f"has {carpets:,} carpets", allowed=f"at most {MOST_ORDERS}"), "order")
    return FactoryOrders(
        path,
        start,
        currency,
        tuple(orders),
        root.label("customer") if root.has("customer") else "",
        read.file(root, "looms"),
        read_price(root, currency),
        read_wage(root, currency),
        _language(root, "language"),
        _language(root, "workshop_language"),
    )


def _language(root: FactoryEntry, key: str) -> str:
    text = root.text(key, DEFAULT)
    if text not in WEAVERS:
        root.refuse(ParameterError(f"{shown(text)} is no language", allowed=", ".join(WEAVERS)), key)
    return text


@dataclass(frozen=True, slots=True)
class _OrderReader:
    """Reads an order; `late`: cost of delay of one that sets none [currency/s]."""

    path: Path
    start: datetime
    money: str
    late: float
    parameters: Mapping[str, Parameter]

    def orders(self, row: FactoryEntry) -> Iterator[FactoryOrder]:
        """An order of each size in each colourway."""
        order = self.order(row)
        for size in self._sizes(row):
            sized = replace(order, carpet={**order.carpet, **({} if size is None else {"size": size})})
            named = order.name if size is None else f"{order.name}, {size}"
            colourways = read_colourways(row)
            if not colourways:
                yield replace(sized, name=named)
            for own, colourway in colourways:
                yield replace(
                    sized,
                    name=f"{named}, {colourway.name}",
                    quantity=own.count("quantity", order.quantity, 1, MOST_ORDERS),
                    yarns=self._yarns(own) or order.yarns,
                    where=f"{self.path}, line {own.source.lines.get(own.path, 1)}",
                    colourway=colourway,
                )

    def _sizes(self, row: FactoryEntry) -> Sequence[str | None]:
        if not row.has("sizes"):
            return (None,)
        sizes = row.data["sizes"]
        fits = isinstance(sizes, list) and 1 <= len(sizes) <= MOST_COLOURWAYS and all(isinstance(s, str) for s in sizes)
        if not fits or row.has("size"):
            allowed = f'a list of 1 to {MOST_COLOURWAYS} sizes, like ["80x120cm"], without size'
            row.refuse(ParameterError(f"{shown(sizes)} are no sizes", allowed=allowed), "sizes")
        return tuple(sizes)

    def _yarns(self, row: FactoryEntry) -> Path | None:
        return Path(row.text("yarns")) if row.data.get("yarns") in SHIPPED else self.file(row, "yarns")

    def order(self, row: FactoryEntry) -> FactoryOrder:
        """The order of a table, without sizes and colourways."""
        row.keys(*ORDER_KEYS, *CARPET_KEYS, *self.parameters, needs=("name", "due"))
        if row.has("picture") == row.has("programme"):
            given = "has both picture and programme" if row.has("picture") else "has neither picture nor programme"
            row.refuse(ParameterError(given, do="give one of the two"))
        programme, late = self.file(row, "programme"), row.money("late", self.money, "d")
        for key in (*CARPET_KEYS, *self.parameters):
            if programme is not None and row.has(key):
                row.refuse(ParameterError(f"{key} of a programme cannot be set", do=f"leave {key} out"), key)
        return FactoryOrder(
            row.label("name"),
            self.file(row, "picture"),
            programme,
            row.count("quantity", 1, 1, MOST_ORDERS),
            max(row.instant("earliest", self.start), self.start),
            row.instant("due", late=True),
            self.late if late is None else late,
            row.count("priority", 1, 1, MOST_PRIORITY),
            {} if programme is not None else _settings(row, self.parameters),
            self._yarns(row),
            f"{self.path}, line {row.source.lines.get(row.path, 1)}",
            row.label("name"),
        )

    def file(self, row: FactoryEntry, key: str) -> Path | None:
        """The file of a key in the folder of the orders; None where it is missing."""
        if not row.has(key):
            return None
        try:
            return file_beside(self.path.parent, row.text(key), "orders")
        except ParameterError as error:
            row.refuse(error, key)


def _settings(row: FactoryEntry, parameters: Mapping[str, Parameter]) -> dict[str, Setting]:
    """Size, quality, knot and the parameters of a carpet that are given, by name."""
    settings: dict[str, Setting] = {key: row.text(key) for key in ("size", "quality", "knot") if row.has(key)}
    for key, parameter in parameters.items():
        if not row.has(key):
            continue
        value = row.data[key]
        try:
            if not isinstance(value, str | int | float) or parameter.name in settings:
                raise ParameterError(f"{shown(value)} is not a value, or given twice", do='write it like "8mm" or 8')
            parameter.check(parameter.read(value))
        except IlmekError as error:
            row.refuse(error, key)
        settings[parameter.name] = value
    return settings
