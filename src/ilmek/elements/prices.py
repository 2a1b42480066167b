"""Prices of a machine's parts: a small table for editing.

    price of a part = number * (each + per_kg mass + per_m length + per_W power)

Each kind of part has its rates. The default rates are round numbers assumed by this project, for no maker or year, in
euros. A text with other rates has one line for each rate that differs from the default:

    laser-cut part per kg = 4.5
    servo each = 380            # with its drive
    servo per W = 0.6
"""

import difflib
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from ilmek.errors import ParameterError
from ilmek.report import BillLine

_RATES = {"each": "each", "per kg": "per_kg", "per m": "per_m", "per W": "per_W"}


@dataclass(frozen=True, slots=True)
class PriceRates:
    """Rates of one kind of part: for each piece, and for its mass [1/kg], length [1/m] and power [1/W]."""

    each: float = 0.0
    per_kg: float = 0.0
    per_m: float = 0.0
    per_W: float = 0.0

    def price(self, mass: float = 0.0, length: float = 0.0, power: float = 0.0) -> float:
        """Price of one piece of a mass [kg], length [m] and power [W].

        >>> PriceRates(each=10.0, per_kg=2.0).price(mass=3.0)
        16.0
        """
        return self.each + self.per_kg * mass + self.per_m * length + self.per_W * power


PRICES: Mapping[str, PriceRates] = {
    "laser-cut part": PriceRates(each=0.5, per_kg=4.0),
    "steel bar": PriceRates(each=20.0, per_kg=2.0),
    "carbon tube": PriceRates(each=25.0, per_kg=15.0),
    "steel tube": PriceRates(each=60.0, per_kg=3.0),
    "welded frame": PriceRates(per_kg=5.0),
    "machined link": PriceRates(each=25.0, per_kg=15.0),
    "cam plate": PriceRates(each=100.0, per_kg=25.0),
    "pin or bush": PriceRates(each=4.0, per_kg=8.0),
    "fastener": PriceRates(each=0.1, per_kg=5.0),
    "turned part": PriceRates(each=15.0, per_kg=6.0),
    "yarn tube": PriceRates(each=15.0),
    "bearing": PriceRates(each=15.0),
    "spring": PriceRates(each=5.0, per_kg=6.0),
    "linear axis": PriceRates(each=150.0, per_m=300.0),
    "linear guide": PriceRates(each=5.0, per_m=60.0),
    "guide carriage": PriceRates(each=20.0),
    "belt and pulleys": PriceRates(each=40.0, per_m=15.0),
    "belt": PriceRates(each=2.0, per_m=15.0),
    "magnet": PriceRates(each=1.0, per_kg=120.0),
    "stepper": PriceRates(each=90.0, per_W=0.5),
    "servo": PriceRates(each=350.0, per_W=0.5),
    "reducer": PriceRates(each=180.0, per_W=0.2),
    "clutch and brake": PriceRates(each=350.0, per_kg=10.0),
    "control": PriceRates(each=3000.0),
    "axis of the control": PriceRates(each=120.0),
    "motion controller": PriceRates(each=900.0),
    "power supply": PriceRates(each=120.0),
    "safety relay": PriceRates(each=180.0),
    "terminal": PriceRates(each=2.0),
    "mounting rail": PriceRates(per_m=6.0),
    "emergency stop": PriceRates(each=45.0),
    "button": PriceRates(each=25.0),
    "interlock": PriceRates(each=160.0),
    "actuator": PriceRates(each=30.0),
    "sensor": PriceRates(each=60.0),
    "load cell": PriceRates(each=350.0),
    "light barrier": PriceRates(each=90.0),
    "light grid": PriceRates(each=350.0),
    "hand tool": PriceRates(each=15.0),
    "string heddle": PriceRates(each=0.05),
    "yarn sensor": PriceRates(each=35.0),
    "yarn brake": PriceRates(each=12.0),
    "yarn package": PriceRates(),
    "duct": PriceRates(per_m=12.0),
    "conduit": PriceRates(per_m=1.5),
    "energy chain": PriceRates(each=20.0, per_m=60.0),
    "guard mesh": PriceRates(each=20.0, per_kg=6.0),
}
"""Rates by kind of part."""


def read_prices(text: str | None) -> Mapping[str, PriceRates]:
    """The default prices, changed by the lines of a text, `KIND each|per kg|per m|per W = NUMBER`.

    Lines end with a new line or a semicolon; a # starts a comment. Raises ParameterError for a line that cannot be
    read, an unknown kind (with the nearest one) and a price below 0.

    >>> read_prices("bearing each = 9; servo per W = 1")["bearing"].each
    9.0
    """
    prices = dict(PRICES)
    for line in (text or "").replace(";", "\n").splitlines():
        entry = line.split("#", 1)[0].strip()
        if entry:
            kind, rate, value = _line(entry)
            prices[kind] = replace(prices[kind], **{rate: value})
    return prices


def price_of(part: BillLine, prices: Mapping[str, PriceRates]) -> float:
    """Price of all pieces of a part, in the currency of the table of prices."""
    weighed = 0.0 if math.isnan(part.mass) else part.mass
    return part.number * prices[part.kind].price(weighed, part.length, part.power)


def written(prices: Mapping[str, PriceRates] = PRICES) -> str:
    """A table as a text for editing and `read_prices`.

    >>> read_prices(written()) == PRICES
    True
    """
    lines = [
        f"{kind} {label} = {getattr(rates, name):g}"
        for kind, rates in prices.items()
        for label, name in _RATES.items()
        if getattr(rates, name)
    ]
    return "\n".join(lines)


def _line(entry: str) -> tuple[str, str, float]:
    """Kind, rate and value of a line."""
    left, _, right = entry.partition("=")
    name = left.strip().strip('"')
    rate = next((short for short in _RATES if name.endswith(f" {short}")), None)
    if rate is None or not right.strip():
        raise ParameterError(
            f"prices: {entry!r} is no price",
            allowed=f"KIND {' | '.join(_RATES)} = NUMBER",
            do="write it like: bearing each = 12.5",
        )
    kind = name.removesuffix(rate).strip()
    if kind not in PRICES:
        nearest = difflib.get_close_matches(kind, PRICES, n=1, cutoff=0.4)
        hint = f"did you mean {nearest[0]}?" if nearest else ""
        raise ParameterError(f"prices: {kind!r} is no kind of part", allowed=", ".join(PRICES), do=hint)
    try:
        value = float(right)
    except ValueError:
        value = -1.0
    if not 0 <= value < _HIGHEST:
        raise ParameterError(f"prices: {entry!r}", allowed="a plain number, 0 or more", do="leave the currency out")
    return kind, _RATES[rate], value


_HIGHEST = 1e9
