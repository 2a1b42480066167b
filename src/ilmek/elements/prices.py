"""Prices of a machine's parts: a small table for editing.

    price of a bought part = number * (each + per_kg mass + per_m length + per_W power)
    price of a made part   = number * (sum of its steps) + set-ups of its steps                     [`making`]

Each kind of bought part, material and process has its rates. Those of bought parts are round numbers assumed by this
project, for no maker or year, in euros. A text with other rates has one line for each that differs from the default:

    servo each = 380            # with its drive
    servo per W = 0.6
    structural steel per kg = 1.5
    milling per h = 70
    milling s per cm3 = 2
"""

import difflib
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from ilmek.elements.making import RATES
from ilmek.errors import ParameterError
from ilmek.report import BillLine, ProcessStep

_RATES = {
    "each": "each",
    "per kg": "per_kg",
    "per m": "per_m",
    "per W": "per_W",
    "per m2": "per_m2",
    "per h": "per_h",
    "h a batch": "set_up",
    "s a piece": "piece",
    "s a feature": "feature",
    "s per m": "time_per_m",
    "s per cm2": "time_per_cm2",
    "s per cm3": "time_per_cm3",
}
"""Labels in a text, and the fields of `PriceRates`."""

_CM = 1e-2
_HOUR = 3600.0


@dataclass(frozen=True, slots=True)
class PriceRates:
    """Rates of one kind of part, material or process.

    each, per_kg, per_m, per_W, per_m2  for each piece, and its mass [1/kg], length [1/m], power [1/W], area [1/m²]
    per_h    of a process, for an hour [1/h]      set_up  for a batch [h]       piece, feature  for each of them [s]
    time_per_m, time_per_cm2, time_per_cm3        for what is cut, removed or joined [s/m, s/cm², s/cm³]
    """

    each: float = 0.0
    per_kg: float = 0.0
    per_m: float = 0.0
    per_W: float = 0.0
    per_m2: float = 0.0
    per_h: float = 0.0
    set_up: float = 0.0
    piece: float = 0.0
    feature: float = 0.0
    time_per_m: float = 0.0
    time_per_cm2: float = 0.0
    time_per_cm3: float = 0.0

    def price(self, mass: float = 0.0, length: float = 0.0, power: float = 0.0) -> float:
        """Price of one bought piece, or of material, of a mass [kg], length [m] and power [W].

        >>> PriceRates(each=10.0, per_kg=2.0).price(mass=3.0)
        16.0
        """
        return self.each + self.per_kg * mass + self.per_m * length + self.per_W * power

    def of_step(self, step: ProcessStep) -> float:
        """Price of a step in the making of a piece, without its set-up.

        >>> milling = PriceRates(per_h=60.0, piece=30.0, time_per_cm3=3.0)
        >>> round(milling.of_step(ProcessStep("milling", volume=10e-6)), 12)
        1.0
        """
        return self.per_kg * step.mass + self.per_m2 * step.area + self.per_h * self.time(step) / _HOUR

    def time(self, step: ProcessStep) -> float:
        """Time of a step [s]."""
        cut = step.length * self.time_per_m + step.area / _CM**2 * self.time_per_cm2
        return self.piece + step.features * self.feature + cut + step.volume / _CM**3 * self.time_per_cm3

    def rate(self, label: str) -> float:
        """The rate of a label, `per kg`."""
        value: float = getattr(self, _RATES[label])
        return value

    @property
    def batch(self) -> float:
        """Price of a set-up, once for all pieces of a part."""
        return self.per_h * self.set_up


_BOUGHT: Mapping[str, PriceRates] = {
    "tool": PriceRates(each=25.0, per_kg=15.0),
    "part to design": PriceRates(each=25.0, per_kg=15.0),
    "levelling foot": PriceRates(each=4.0, per_kg=8.0),
    "fastener": PriceRates(each=0.1, per_kg=5.0),
    "yarn tube": PriceRates(each=15.0),
    "bearing": PriceRates(each=15.0),
    "spring": PriceRates(each=5.0, per_kg=6.0),
    "linear axis": PriceRates(each=150.0, per_m=300.0),
    "linear guide": PriceRates(each=5.0, per_m=60.0),
    "guide carriage": PriceRates(each=20.0),
    "belt and pulleys": PriceRates(each=40.0, per_m=15.0),
    "belt": PriceRates(each=2.0, per_m=15.0),
    "toothed pulley": PriceRates(each=10.0, per_kg=40.0),
    "magnet": PriceRates(each=1.0, per_kg=120.0),
    "stepper": PriceRates(each=90.0, per_W=0.5),
    "servo": PriceRates(each=350.0, per_W=0.5),
    "micro servo": PriceRates(each=6.0, per_W=4.0),
    "micro stepper": PriceRates(each=12.0, per_W=4.0),
    "solenoid": PriceRates(each=20.0, per_W=2.0),
    "reducer": PriceRates(each=180.0, per_W=0.2),
    "motor adapter": PriceRates(each=40.0, per_kg=25.0),
    "clutch and brake": PriceRates(each=350.0, per_kg=10.0),
    "control": PriceRates(each=3000.0),
    "axis of the control": PriceRates(each=120.0),
    "motion controller": PriceRates(each=900.0),
    "power supply": PriceRates(each=60.0, per_W=0.25),
    "braking module": PriceRates(each=110.0),
    "circuit protector": PriceRates(each=80.0),
    "fuse": PriceRates(each=4.0, per_kg=40.0),
    "main switch": PriceRates(each=60.0),
    "cabinet door": PriceRates(each=20.0, per_kg=4.0),
    "fan": PriceRates(each=40.0, per_kg=35.0),
    "outlet filter": PriceRates(each=12.0, per_kg=20.0),
    "protective bar": PriceRates(each=5.0, per_kg=25.0),
    "input module": PriceRates(each=130.0),
    "output module": PriceRates(each=150.0),
    "measuring amplifier": PriceRates(each=190.0),
    "enabling device": PriceRates(each=140.0),
    "holding brake": PriceRates(each=60.0, per_kg=60.0),
    "eye bolt": PriceRates(each=1.0, per_kg=12.0),
    "safety relay": PriceRates(each=180.0),
    "mode selector": PriceRates(each=60.0),
    "terminal": PriceRates(each=2.0),
    "mounting rail": PriceRates(per_m=6.0),
    "mounting plate": PriceRates(each=15.0, per_kg=3.0),
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
    "hinge": PriceRates(each=4.0, per_kg=20.0),
    "guard mesh": PriceRates(each=20.0, per_kg=6.0),
}


def _of_workshop() -> Iterator[tuple[str, PriceRates]]:
    """The rates of materials and processes, by their kinds."""
    for kind in dict.fromkeys(rate.kind for rate in RATES):
        yield kind, PriceRates(**{_RATES[rate.label]: rate.value for rate in RATES if rate.kind == kind})


PRICES: Mapping[str, PriceRates] = {**_BOUGHT, **dict(_of_workshop())}
"""Rates by kind of bought part, material and process."""


def read_prices(text: str | None) -> Mapping[str, PriceRates]:
    """The default prices, changed by the lines of a text, `KIND RATE = NUMBER`.

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
    """Price of all pieces of a part with the set-ups for them, in the currency of the table of prices."""
    return part.number * piece_price(part, prices) + batch_price(part, prices)


def piece_price(part: BillLine, prices: Mapping[str, PriceRates]) -> float:
    """Price of one piece of a part, without set-ups."""
    if part.steps:
        return sum(prices[step.kind].of_step(step) for step in part.steps)
    return prices[part.kind].price(0.0 if math.isnan(part.mass) else part.mass, part.length, part.power)


def batch_price(part: BillLine, prices: Mapping[str, PriceRates]) -> float:
    """Price of the set-ups for all pieces of a made part."""
    return sum(prices[step.kind].batch for step in part.steps)


def _line(entry: str) -> tuple[str, str, float]:
    """Kind, rate and value of a line."""
    left, _, right = entry.partition("=")
    name = left.strip().strip('"')
    rate = max((label for label in _RATES if name.endswith(f" {label}")), key=len, default=None)
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
