"""Quality: knots per metre across (along a row) and along (rows per metre of length).

Each notation of the trade is one line below: its form, and the length (or area) over which its numbers are counted.
Reading is exact (rational arithmetic, rounded once). Writing gives the shortest text that reads back to the same
quality.

    pair      A × B knots over a length across and a length along     25x25/dm, 9x16/in, 9/60 (India)
    line      N knots over a length, in both directions               40 raj (per gereh, 7 cm; 40raj/6.5cm for another),
                                                                      90 line (per foot)
    area      N knots over an area, equal in both directions          130 kpsi (knots per square inch), 62500/m2

Sources: raj = knots per gereh of 6.5 to 7 cm by town (Kerman and Tabriz 7); India A/B (bis/bhutan) = A knots in 0.9 in
across and B in 4.5 in along, hence A·B/4.05 knots per square inch; Chinese line = knots per foot.

>>> parse_quality("40x40/dm")
Quality(across=400.0, along=400.0)
>>> round(parse_quality("40 raj").knots_per_area)
326531
>>> write_quality(parse_quality("9/60"), "kpsi", digits=3)
'133kpsi'
"""

import math
import re
from dataclasses import dataclass
from decimal import Context
from fractions import Fraction

from ilmek.errors import CarpetError
from ilmek.records import shown_value
from ilmek.sentences import Sentence
from ilmek.units import LONGEST, format_number, format_quantity, real_number

COARSEST, FINEST = 10.0, 5000.0
"""Limits of knots per metre: 1 per decimetre, and 50 per centimetre (the finest known carpet has 33)."""


@dataclass(frozen=True, slots=True)
class Quality:
    """Knots per metre across and along [1/m]. Raises CarpetError outside COARSEST to FINEST."""

    across: float
    along: float

    def __post_init__(self) -> None:
        for name in ("across", "along"):
            count = real_number(getattr(self, name))
            if count is None:
                given = f"a quality of {getattr(self, name)!r} {name}"
                raise CarpetError(given, allowed="a number of knots per metre", do=EXAMPLE)
            object.__setattr__(self, name, count)
            if count < COARSEST:
                raise CarpetError(
                    Sentence("quality.too-coarse", count=format_number(count / 10)),
                    allowed=Sentence("quality.least"),
                    do=EXAMPLE,
                )
            if count > FINEST:
                raise CarpetError(
                    Sentence(
                        "quality.too-fine", count=format_number(count / 10), pitch=format_quantity(0.5 / count, "mm")
                    ),
                    allowed=Sentence("quality.most", count=format_number(FINEST / 10)),
                    do=EXAMPLE,
                )

    @property
    def knots_per_area(self) -> float:
        """Knots per m²."""
        return self.across * self.along

    @property
    def warp_pitch(self) -> float:
        """Distance between neighbouring warps [m]; a knot is tied on two."""
        return 0.5 / self.across

    def __str__(self) -> str:
        return write_quality(self, "dm", digits=4)


EXAMPLE = Sentence("quality.example")


@dataclass(frozen=True, slots=True)
class Notation:
    """A notation of a quality.

    pattern  group 1 is the first number, group 2 the second, if any, group 3 the gereh [cm]
    across, along  lengths over which knots are counted [m]; along 0: `across` is an area [m²]
    form     template: {0} and {1} are the numbers; with one number, both directions are equal
    """

    pattern: re.Pattern[str]
    across: Fraction
    along: Fraction
    form: str

    @property
    def is_pair(self) -> bool:
        """Whether the notation has a number for each direction."""
        return "{1}" in self.form


_NUMBER = r"([+-]?(?:[0-9]{1,15}(?:\.[0-9]{0,40})?|\.[0-9]{1,40}))"
INCH, GEREH = Fraction("0.0254"), Fraction("0.07")


def _pair(unit: str, spellings: str, across: Fraction, along: Fraction) -> Notation:
    per = rf"\s*(?:/|per)\s*(?:{spellings})\.?" if spellings else ""
    between = r"[x×*/]" if spellings != "" else "/"
    text = rf"{_NUMBER}(?:\s*{between}\s*{_NUMBER}){'?' if spellings else ''}{per}"
    return Notation(re.compile(text, re.IGNORECASE), across, along, "{0}x{1}/" + unit if unit else "{0}/{1}")


def _single(spellings: str, across: Fraction, along: Fraction, form: str) -> Notation:
    return Notation(re.compile(rf"{_NUMBER}()\s*{spellings}", re.IGNORECASE), across, along, form)


def _area(unit: str, length: Fraction) -> Notation:
    spelling = rf"(?:(?:knots?)?\s*(?:/|per)\s*{unit}(?:\^?2|²))"
    return _single(spelling, length**2, Fraction(0), "{0}/" + unit + "2")


NOTATIONS: dict[str, Notation] = {
    "dm": _pair("dm", "dm", Fraction(1, 10), Fraction(1, 10)),
    "cm": _pair("cm", "cm", Fraction(1, 100), Fraction(1, 100)),
    "m": _pair("m", "m", Fraction(1), Fraction(1)),
    "inch": _pair("in", "in|inch|inches", INCH, INCH),
    "india": _pair("", "", INCH * 9 / 10, INCH * 9 / 2),
    "raj": _single(r"(?:raj|redj|radj)(?:\s*[/@(]\s*([\d.]+)\s*cm\s*\)?)?", GEREH, GEREH, "{0}raj"),
    "line": _single(r"lines?", INCH * 12, INCH * 12, "{0}line"),
    "kpsi": _single(r"kpsi", INCH**2, Fraction(0), "{0}kpsi"),
    "m2": _area("m", Fraction(1)),
    "dm2": _area("dm", Fraction(1, 10)),
    "cm2": _area("cm", Fraction(1, 100)),
}


def carpet_quality(quality: object) -> Quality:
    """A quality, or that of a text. Raises CarpetError for anything else.

    >>> carpet_quality("40x40/dm") == carpet_quality(Quality(400, 400))
    True
    """
    if isinstance(quality, str):
        return parse_quality(quality)
    if not isinstance(quality, Quality):
        raise CarpetError(f"the quality is {shown_value(quality)}", allowed="a text or a Quality", do=EXAMPLE)
    return quality


def parse_quality(text: str) -> Quality:
    """The quality of a text in any of the notations. Raises CarpetError for another text and outside the limits."""
    if len(text) > LONGEST:
        raise CarpetError(f"quality {text[:20]!r}... is too long", allowed=f"at most {LONGEST} characters", do=EXAMPLE)
    for notation in NOTATIONS.values():
        matched = notation.pattern.fullmatch(text.strip())
        if matched is not None:
            return _read(notation, *matched.groups())
    raise CarpetError(Sentence("quality.unknown", text=text), allowed=Sentence("quality.allowed"), do=EXAMPLE)


def gereh_note(text: str) -> str:
    """The gereh that a quality in raj is counted over, where the text leaves it open; "" for any other text.

    >>> gereh_note("40 raj")
    '40 raj is counted over a gereh of 7 cm; write 40raj/6.5cm for another'
    """
    matched = NOTATIONS["raj"].pattern.fullmatch(text.strip())
    if matched is None or matched[3] is not None:
        return ""
    return f"{matched[1]} raj is counted over a gereh of 7 cm; write {matched[1]}raj/6.5cm for another"


def _read(notation: Notation, first: str, second: str | None, gereh: str | None = None) -> Quality:
    """The quality of one or two numbers as text."""
    across, along = Fraction(first), Fraction(second or first)
    if gereh is not None:
        notation = _with_gereh(notation, _gereh(gereh))
    if notation.along == 0:
        side = math.sqrt(max(across / notation.across, Fraction(0)))
        return Quality(side, side)
    return Quality(float(across / notation.across), float(along / notation.along))


def _gereh(text: str) -> Fraction:
    """The town's gereh [m] from centimetres."""
    if not re.fullmatch(r"[0-9]{1,15}(\.[0-9]{0,40})?", text) or not 5 <= Fraction(text) <= 10:
        raise CarpetError(
            f"a gereh of {text} cm is out of bounds", allowed="5 to 10 cm; usual 6.5 to 7", do="like 40raj/6.5cm"
        )
    return Fraction(text) / 100


def _with_gereh(notation: Notation, gereh: Fraction) -> Notation:
    return Notation(notation.pattern, gereh, gereh, notation.form)


def write_quality(quality: Quality, notation: str, *, gereh: float = 0.07, digits: int | None = None) -> str:
    """The quality in a notation, a key of NOTATIONS.

    gereh   of the town [m], for raj
    digits  significant digits; default: the shortest text that reads back to the same quality
    A notation with one number for both directions gives that of the same knots per area.
    Raises CarpetError for an unknown notation.
    """
    if notation not in NOTATIONS:
        raise CarpetError(f"unknown quality notation {notation!r}", allowed=f"one of {', '.join(NOTATIONS)}")
    form = NOTATIONS[notation]
    town = Fraction(str(gereh))
    if notation == "raj" and town != GEREH:
        form = Notation(form.pattern, town, town, f"{{0}}raj/{_plain(town * 100, 12)}cm")
    if form.is_pair:
        across = _shortest(Fraction(quality.across) * form.across, form.across, digits)
        return form.form.format(across, _shortest(Fraction(quality.along) * form.along, form.along, digits))
    side = Fraction(math.sqrt(quality.knots_per_area))
    if form.along:
        return form.form.format(_shortest(side * form.across, form.across, digits))
    return form.form.format(_shortest(side**2 * form.across, form.across, digits, root=True))


def _shortest(value: Fraction, counted_over: Fraction, digits: int | None, *, root: bool = False) -> str:
    """`value` with the fewest decimals that read back to the same number of knots per metre."""
    if digits is not None:
        return _plain(value, digits)

    def read(number: Fraction) -> float:
        return math.sqrt(number / counted_over) if root else float(number / counted_over)

    texts = (_plain(value, count) for count in range(1, 40))
    return next(text for text in texts if read(Fraction(text)) == read(value))


def _plain(value: Fraction, digits: int) -> str:
    """A positive rational rounded to `digits` significant digits, without exponent or trailing zeros."""
    rounded = Context(prec=digits).divide(value.numerator, value.denominator)
    text = f"{rounded:f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def shortest_quality(quality: Quality) -> str:
    """The quality in knots per dm, or where that is long in the shortest notation that reads back to the same.

    >>> shortest_quality(Quality(250.0, 250.0))
    '25x25/dm'
    """
    pair = write_quality(quality, "dm")
    texts = (write_quality(quality, notation) for notation in NOTATIONS)
    return min((text for text in texts if parse_quality(text) == quality), key=len) if len(pair) > 12 else pair
