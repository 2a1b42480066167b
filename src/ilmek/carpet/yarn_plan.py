"""Yarn plan: what the user sets for the yarn of a carpet, and what follows from its quality."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from ilmek.carpet.ground import GroundParams
from ilmek.carpet.pile import PileParams
from ilmek.carpet.quality import Quality
from ilmek.carpet.usual_pile import usual_pile_height, with_counts
from ilmek.carpet.yarn import COUNTS, PLIES, Yarn
from ilmek.errors import ParameterError, UnitError
from ilmek.params import Params, kind
from ilmek.units import format_number, mm, parse_quantity

EURO = "EUR"

OVERCAST, TAPE = "overcast", "tape"
"""The binding with pile yarn, turn beside turn; with a woven tape of cotton, sewn over the hem."""

TAPE_PRICE = 1.0
"""Price of a metre of tape [EUR]; a round number assumed by this project."""

PRICES = {"cotton": 8.0, "wool": 20.0, "silk": 120.0}
"""Prices of a kilogram of yarn by material [EUR]; round numbers assumed by this project."""

_LEAST_HANK, _GREATEST_HANK = 1e-3, 1e6
"""Bounds of a hank [kg or m]."""


@dataclass(frozen=True, slots=True)
class Hank:
    """What a hank holds: a mass [kg] or a length [m]; the other is None."""

    mass: float | None = None
    length: float | None = None


@dataclass(frozen=True, slots=True)
class YarnPlanParams(Params):
    """The yarn of a carpet: what is set, and what follows from the quality where it is left open."""

    pile_height: float | None = kind.length(
        None, at_least=0.0, at_most=100 * mm, doc="height of the cut pile; default: by the quality, 10 mm at 25x25/dm"
    )
    yarn_count: str | None = kind.text(
        None, doc="metric count Nm and ply of all pile yarns, like 5/2; default: of the yarn list, or by the quality"
    )
    calibration: float = kind.ratio(
        1.0, above=0.0, at_most=10.0, doc="length of yarn per knot in your own carpets over the geometric length"
    )
    cut_waste: float = kind.length(
        1 * mm, at_least=0.0, at_most=100 * mm, doc="pile yarn lost by knife and shears at each of a knot's two ends"
    )
    reserve: float = kind.ratio(0.10, unit="%", at_least=0.0, at_most=2.0, doc="yarn to buy beyond the need")
    hank: str = kind.text("100 g", doc="what a hank holds, a mass or a length, like 100 g or 200 m")
    lot: float = kind.mass(20.0, at_least=0.1, at_most=1e6, doc="largest mass of one dye lot, dyed in one bath")
    fringe: float = kind.length(
        100 * mm, at_least=0.0, at_most=1.0, doc="warp beyond the pile at each end: flat-woven end and fringe"
    )
    end_length: float = kind.length(
        20 * mm, at_least=0.0, at_most=1.0, doc="flat-woven end before the first row and after the last"
    )
    binding: str = kind.choice(
        OVERCAST,
        (OVERCAST, TAPE, "none"),
        doc="binding of the edge of a carpet with a shape: pile yarn, or a tape",
    )
    binding_width: float = kind.length(
        8 * mm, at_least=1 * mm, at_most=100 * mm, doc="width of the hem that the binding covers"
    )
    binding_yarn: str | None = kind.text(None, doc="yarn of an overcast binding; default: that with the most knots")
    loom_waste: float = kind.length(400 * mm, at_least=0.0, at_most=10.0, doc="warp lost in the loom, both ends")
    currency: str = kind.text(EURO, doc="currency of all prices, those of the yarn list too")
    pile_price: float | None = kind.ratio(
        None,
        at_least=0.0,
        at_most=1e6,
        doc="price per kg of pile yarn where no list of yours gives one; default: 20 EUR for wool",
    )
    warp_price: float | None = kind.ratio(
        None, at_least=0.0, at_most=1e6, doc="price per kg of the warp; default: 8 EUR for cotton, 20 for wool"
    )
    weft_price: float | None = kind.ratio(
        None, at_least=0.0, at_most=1e6, doc="price per kg of wefts and ends; default: 8 EUR for cotton, 20 for wool"
    )
    tape_price: float | None = kind.ratio(
        None, at_least=0.0, at_most=1e6, doc="price per metre of a tape that binds the edge; default: 1 EUR"
    )

    def check_together(self) -> None:
        """Raise ParameterError where a text cannot be read, or the flat-woven ends are longer than the fringe."""
        if self.yarn_count is not None:
            parse_count(self.yarn_count)
        parse_hank(self.hank)
        if not re.fullmatch(r"[^\W\d_]{1,12}|[€$£¥₺₹﷼]", self.currency):
            allowed = "a code or sign like EUR, TRY or €"
            raise ParameterError(f"currency {self.currency[:20]!r} cannot be used", allowed=allowed)
        if self.end_length > self.fringe:
            raise ParameterError(
                "the flat-woven end is longer than the warp beyond the pile",
                allowed="end_length at most fringe",
                do="give a longer fringe, or a shorter end_length",
            )

    def pile(self, quality: Quality) -> PileParams:
        """The parameters of the pile at a quality."""
        height = usual_pile_height(quality) if self.pile_height is None else self.pile_height
        return PileParams(pile_height=height, cut_waste=self.cut_waste, calibration=self.calibration)

    def ground(self, ground: GroundParams | None = None) -> GroundParams:
        """The parameters of the ground: those given, with the ends of this plan."""
        return replace(
            ground or GroundParams(), fringe=self.fringe, end_length=self.end_length, loom_waste=self.loom_waste
        )

    def counted(self, yarns: Sequence[Yarn], quality: Quality, knot: str) -> tuple[Yarn, ...]:
        """The yarns with a count each: as given here, as in the list, or by the quality."""
        given = None if self.yarn_count is None else parse_count(self.yarn_count)
        return with_counts(yarns, quality, knot, given)

    def priced(self, shipped: Sequence[Yarn]) -> tuple[Yarn, ...]:
        """Yarns that come with ilmek, without their prices [EUR] where another currency or a price is given."""
        holds = self.currency == EURO and self.pile_price is None
        return tuple(shipped) if holds else tuple(replace(yarn, price=None) for yarn in shipped)

    def price(self, use: str, material: str) -> float | None:
        """Price per kg of a use (pile, warp, weft) where no list gives one; None: not known in this currency."""
        given = {"pile": self.pile_price, "warp": self.warp_price, "weft": self.weft_price}[use]
        return PRICES[material] if given is None and self.currency == EURO else given

    @property
    def price_of_tape(self) -> float | None:
        """Price per metre of tape; None: not known in this currency."""
        return TAPE_PRICE if self.tape_price is None and self.currency == EURO else self.tape_price


def parse_count(text: str) -> tuple[float, int]:
    """Metric count and ply of a text: 5/2 is two strands of Nm 5. Raises ParameterError.

    >>> parse_count("Nm 5/2"), parse_count("4.5")
    ((5.0, 2), (4.5, 1))
    """
    matched = re.fullmatch(r"(?:nm)?\s*(\d{1,4}(?:[.,]\d{1,6})?)(?:\s*/\s*(\d{1,3}))?", text.strip(), re.IGNORECASE)
    if matched is not None:
        count, ply = float(matched[1].replace(",", ".")), int(matched[2] or 1)
        if COUNTS[0] <= count <= COUNTS[1] and PLIES[0] <= ply <= PLIES[1]:
            return count, ply
    raise ParameterError(
        f"yarn count {text[:30]!r} cannot be used",
        allowed=f"metric count {COUNTS[0]:g} to {COUNTS[1]:g} and ply {PLIES[0]} to {PLIES[1]}",
        do="write it like 5/2: two strands of 5 m/g",
    )


def write_count(yarn: Yarn) -> str:
    """Metric count and ply of a yarn, like 5/2; a single strand like 5."""
    if yarn.metric_count is None:
        return ""
    count = format_number(yarn.metric_count)
    return count if yarn.ply == 1 else f"{count}/{yarn.ply}"


def parse_hank(text: str) -> Hank:
    """The hank of a text, a mass or a length with its unit. Raises ParameterError.

    >>> parse_hank("100 g"), parse_hank("200m")
    (Hank(mass=0.1, length=None), Hank(mass=None, length=200.0))
    """
    for unit, name in (("kg", "mass"), ("m", "length")):
        try:
            value = parse_quantity(text, unit)
        except UnitError:
            continue
        if re.search(r"[A-Za-z]\s*$", text) and _LEAST_HANK <= value <= _GREATEST_HANK:
            return Hank(**{name: value})
    raise ParameterError(
        f"hank {text[:30]!r} cannot be used", allowed="a mass or a length, 1 g or 1 mm at least", do="like 100g or 200m"
    )
