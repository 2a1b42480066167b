"""Carpet sizes: Turkish standard names, and any width × length; a side that is `auto` follows from the picture.

Source: thesis, Table 1.1 (which gives length × width in cm).

>>> parse_size("seccade")
CarpetSize(width=1.2, length=1.8, name='seccade')
>>> parse_size("120 × 180 cm") == parse_size("1.2x1.8m") == CarpetSize(1.2, 1.8)
True
"""

import difflib
import re
import unicodedata
from dataclasses import dataclass
from fractions import Fraction

from ilmek.errors import CarpetError
from ilmek.records import shown_value
from ilmek.sentences import Sentence
from ilmek.units import LONGEST, cm, format_number, format_quantity, real_number


@dataclass(frozen=True, slots=True)
class CarpetSize:
    """A carpet's width (along a row of knots) and length (along the warps) [m]; name: standard name, or "".

    Raises CarpetError for a side outside 1 cm to 50 m.
    """

    width: float
    length: float
    name: str = ""

    def __post_init__(self) -> None:
        for name in ("width", "length"):
            side = real_number(getattr(self, name))
            if side is None:
                given = f"the {name} {getattr(self, name)!r} of a carpet"
                raise CarpetError(given, allowed="a number in metres", do=EXAMPLE)
            object.__setattr__(self, name, side)
            if not SMALLEST <= side <= LARGEST:
                raise CarpetError(
                    Sentence("size.not-woven", side=format_quantity(side, "cm")),
                    allowed=Sentence(
                        "size.bounds", least=format_quantity(SMALLEST, "cm"), most=format_quantity(LARGEST, "m")
                    ),
                    do=EXAMPLE if side > 0 else Sentence("size.above-zero"),
                )

    @property
    def area(self) -> float:
        """Width × length [m²]."""
        return self.width * self.length

    def __str__(self) -> str:
        sides = f"{format_number(self.width / cm)} × {format_number(self.length / cm)} cm"
        return f"{self.name}, {sides}" if self.name else sides


SMALLEST, LARGEST = 0.01, 50.0
EXAMPLE = Sentence("size.example")
OPEN_EXAMPLE = Sentence("size.open-example")
AUTO = "auto"
"""The side, or the size, that follows from the picture."""

STANDARD_SIZES: dict[str, CarpetSize] = {
    size.name: size
    for size in (
        CarpetSize(0.25, 0.40, "küçük yastık"),
        CarpetSize(0.60, 1.00, "yastık"),
        CarpetSize(0.90, 1.35, "çeyrek"),
        CarpetSize(1.20, 1.80, "seccade"),
        CarpetSize(1.30, 2.00, "seccade-large"),
        CarpetSize(1.50, 2.20, "karyola"),
        CarpetSize(2.00, 3.00, "kelle"),
    )
}
"""Thesis, Table 1.1; it gives seccade as 180 × 120 to 200 × 130 cm, here the two ends of that range."""

LEAST_BARE = 10
"""Least number without a unit that is taken for centimetres beside `auto`: 1.2 may be metres."""

_OTHER_NAMES = {"seccade-130x200": "seccade-large", "seccade-120x180": "seccade"}
_OPEN_NAMES = {
    "taban": "a taban is any carpet above 6 m²: give its size, like 250x350cm",
    "yolluk": "a yolluk (runner) has any size: give it, like 80x300cm",
}
_UNITS = {
    **dict.fromkeys(("mm", "millimetre", "millimeter"), Fraction(1, 1000)),
    **dict.fromkeys(("cm", "centimetre", "centimeter"), Fraction(1, 100)),
    **dict.fromkeys(("dm", "decimetre", "decimeter"), Fraction(1, 10)),
    **dict.fromkeys(("m", "metre", "meter"), Fraction(1)),
    **dict.fromkeys(("in", "inch", '"', "″"), Fraction("0.0254")),
    **dict.fromkeys(("ft", "foot", "feet", "'", "′"), Fraction("0.3048")),
}
_NUMBER = r"([+-]?(?:[0-9]{1,15}(?:\.[0-9]{0,40})?|\.[0-9]{1,40}))"
_ONE_SIDE = re.compile(rf"\s*{_NUMBER}\s*[^\d\s.×x*]*\s*[x×*]?\s*")
_OPEN_SIDES = re.compile(
    rf"\s*(?:{_NUMBER}\s*([^\d\s.×x*]*)|auto)\s*[x×*]\s*(?:{_NUMBER}\s*(\S*?)|auto)\s*", re.IGNORECASE
)
_SIDES = re.compile(rf"\s*{_NUMBER}\s*([^\d\s.×x*]*)\s*[x×*]\s*{_NUMBER}\s*(\S*?)\s*", re.IGNORECASE)


def carpet_size(size: object) -> CarpetSize:
    """A size, or that of a text. Raises CarpetError for anything else.

    >>> carpet_size("1x2m") == CarpetSize(1.0, 2.0) == carpet_size(CarpetSize(1, 2))
    True
    """
    if isinstance(size, str):
        return parse_size(size)
    if not isinstance(size, CarpetSize):
        raise CarpetError(f"the size is {shown_value(size)}", allowed="a text or a CarpetSize", do=EXAMPLE)
    return size


def parse_size(text: str) -> CarpetSize:
    """The size of a standard name (with or without Turkish letters, any case) or of `width x length unit`.

    Units: mm, cm, dm, m, in, ft, one for both sides.
    Raises CarpetError for any other text.
    """
    if len(text) > LONGEST:
        raise CarpetError(
            Sentence("value.too-long", value=f"size {text[:20]!r}..."),
            allowed=Sentence("value.at-most-characters", count=LONGEST),
            do=EXAMPLE,
        )
    named = _BY_KEY.get(_key(text))
    if named is not None:
        return named
    if _key(text) in _OPEN_NAMES:
        raise CarpetError(f"{text.strip()!r} names no size", allowed=_OPEN_NAMES[_key(text)])
    matched = _SIDES.fullmatch(text)
    if _ONE_SIDE.fullmatch(text):
        raise CarpetError(Sentence("size.one-side", text=text), allowed=Sentence("size.sides"), do=OPEN_EXAMPLE)
    if matched is None:
        raise CarpetError(Sentence("size.unknown", text=text), allowed=_near_names(text), do=Sentence("size.or"))
    unit = _common_unit(text, matched[2].lower(), matched[4].lower())
    return CarpetSize(float(Fraction(matched[1]) * unit), float(Fraction(matched[3]) * unit))


def parse_open_size(text: str) -> tuple[CarpetSize | None, dict[str, float]]:
    """The size of a text as `parse_size`, or the sides [m] that it gives where others are `auto`.

    A side beside `auto` without a unit is in centimetres.

    >>> parse_open_size("120x180cm") == (CarpetSize(1.2, 1.8), {})
    True
    >>> parse_open_size("120cm x auto"), parse_open_size("autox180"), parse_open_size("auto")
    ((None, {'width': 1.2}), (None, {'length': 1.8}), (None, {}))
    """
    if text.strip().lower() == AUTO:
        return None, {}
    matched = _OPEN_SIDES.fullmatch(text) if len(text) <= LONGEST else None
    if matched is None or None not in (matched[1], matched[3]):
        return parse_size(text), {}
    found = {}
    for name, number, unit in (("width", matched[1], matched[2]), ("length", matched[3], matched[4])):
        if number is not None:
            if not unit and Fraction(number) < LEAST_BARE:
                raise CarpetError(Sentence("size.no-unit", text=text), allowed=Sentence("size.units"), do=OPEN_EXAMPLE)
            found[name] = float(Fraction(number) * _common_unit(text, *2 * (unit.lower() or "cm",)))
    return None, found


def _common_unit(text: str, first: str, second: str) -> Fraction:
    """The factor [m] of the common unit, which is given once or twice."""
    for symbol in (first, second):
        if symbol and symbol not in _UNITS:
            raise CarpetError(Sentence("size.unknown-unit", text=text, unit=symbol), allowed=Sentence("size.units"))
    if not first and not second:
        raise CarpetError(Sentence("size.no-unit", text=text), allowed=Sentence("size.units"), do=EXAMPLE)
    if not second:
        raise CarpetError(Sentence("size.no-second-unit", text=text), do=EXAMPLE)
    if first and _UNITS[first] != _UNITS[second]:
        raise CarpetError(
            Sentence("size.mixed", text=text, first=first, second=second), allowed=Sentence("size.one-unit"), do=EXAMPLE
        )
    return _UNITS[second]


def _key(name: str) -> str:
    """A name without case, Turkish letters, spaces, hyphens and underscores."""
    plain = unicodedata.normalize("NFKD", name.casefold().replace("ı", "i").replace("×", "x"))
    return re.sub(r"[\s_-]+", "", "".join(letter for letter in plain if not unicodedata.combining(letter)))


def _near_names(text: str) -> str:
    """The standard names, the nearest first where one is near."""
    near = difflib.get_close_matches(_key(text), [*_BY_KEY, *_OPEN_NAMES], n=1, cutoff=0.6)
    nearest = _BY_KEY[near[0]].name if near and near[0] in _BY_KEY else "".join(near)
    sizes = ", ".join(STANDARD_SIZES)
    return Sentence("size.near", name=nearest, sizes=sizes) if nearest else Sentence("size.standard", sizes=sizes)


_BY_KEY = {_key(name): size for name, size in STANDARD_SIZES.items()} | {
    _key(other): STANDARD_SIZES[name] for other, name in _OTHER_NAMES.items()
}
