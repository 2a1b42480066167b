"""Units: factors to SI, reading and writing quantities.

Inside ilmek every number is an SI float and every angle is in radians. Units are converted at the boundaries, by the
functions here or by a factor: `60 * mm`, `170 * deg`, `15.5 * rpm`.

>>> round(parse_quantity("60mm", "m"), 12)
0.06
>>> parse_quantity("90deg", "rad") == 90 * deg
True
>>> format_quantity(0.06, "mm")
'60 mm'
"""

import difflib
import math
import numbers
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any, TypeAlias

from ilmek.errors import UnitError
from ilmek.records import shown_value

__all__ = [
    "GPa",
    "MPa",
    "Pa",
    "cm",
    "day",
    "deg",
    "dm",
    "foot",
    "format_quantity",
    "from_si",
    "hour",
    "inch",
    "kN",
    "kPa",
    "kg",
    "km",
    "mN",
    "mg",
    "minute",
    "mm",
    "mrad",
    "ms",
    "parse_quantity",
    "parse_unit",
    "rad",
    "rpm",
    "tonne",
    "turn",
    "um",
]
"""What `from ilmek.units import *` gives: not the factors of one letter, `m`, `s`, `g` and `N`, names of variables."""

Dimension: TypeAlias = tuple[int, int, int, int]
"""Exponents of metre, kilogram, second and radian, so that angles are not mistaken for numbers."""


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit as written, its factor to SI, and its dimension."""

    symbol: str
    factor: float
    dimension: Dimension


m, dm, cm, mm, um, km, inch, foot = 1.0, 0.1, 0.01, 1e-3, 1e-6, 1e3, 0.0254, 0.3048
kg, g, mg, tonne = 1.0, 1e-3, 1e-6, 1e3
s, ms, minute, hour, day = 1.0, 1e-3, 60.0, 3600.0, 86400.0
rad, mrad, deg, turn = 1.0, 1e-3, math.pi / 180, 2 * math.pi
rpm = turn / minute
N, kN, mN = 1.0, 1e3, 1e-3
Pa, kPa, MPa, GPa = 1.0, 1e3, 1e6, 1e9
BILLION = 1_000_000_000
"""Nanoseconds in a second, and nanometres in a metre: the loom's clock and yarns count in them."""

_NONE: Dimension = (0, 0, 0, 0)
_LENGTH: Dimension = (1, 0, 0, 0)
_MASS: Dimension = (0, 1, 0, 0)
_TIME: Dimension = (0, 0, 1, 0)
_ANGLE: Dimension = (0, 0, 0, 1)
_FORCE: Dimension = (1, 1, -2, 0)
_PRESSURE: Dimension = (-1, 1, -2, 0)
_ENERGY: Dimension = (2, 1, -2, 0)
_POWER: Dimension = (2, 1, -3, 0)

UNITS: dict[str, tuple[float, Dimension]] = {
    "1": (1.0, _NONE),
    "%": (0.01, _NONE),
    **{name: (factor, _LENGTH) for name, factor in dict(m=m, dm=dm, cm=cm, mm=mm, um=um, km=km, ft=foot).items()},
    "in": (inch, _LENGTH),
    "inch": (inch, _LENGTH),
    **{name: (factor, _MASS) for name, factor in dict(kg=kg, g=g, mg=mg, t=tonne).items()},
    **{name: (factor, _TIME) for name, factor in dict(s=s, ms=ms, min=minute, h=hour, d=day, day=day).items()},
    **{name: (factor, _ANGLE) for name, factor in dict(rad=rad, mrad=mrad, deg=deg, turn=turn, rev=turn).items()},
    "°": (deg, _ANGLE),
    "rpm": (rpm, (0, 0, -1, 1)),
    "Hz": (1.0, (0, 0, -1, 0)),
    **{name: (factor, _FORCE) for name, factor in dict(N=N, kN=kN, mN=mN).items()},
    **{name: (factor, _PRESSURE) for name, factor in dict(Pa=Pa, kPa=kPa, MPa=MPa, GPa=GPa).items()},
    **{name: (factor, _ENERGY) for name, factor in dict(J=1.0, kJ=1e3, Nm=1.0, kWh=3.6e6).items()},
    **{name: (factor, _POWER) for name, factor in dict(W=1.0, kW=1e3).items()},
}
"""Symbol -> factor to SI, and dimension."""

LONGEST = 100
"""Largest number of characters of a quantity or a unit; a double and its unit need less than 50."""

GREATEST, LEAST = 1e30, 1e-30
"""Largest magnitude of a quantity, and smallest of a unit's factor and of a parameter other than 0 [SI]: powers of
numbers beyond them overflow or underflow."""

HIGHEST_POWER = 12
"""Largest exponent in a unit; a second moment of area has 4."""

_NUMBER = re.compile(r"([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)\s*(.*)", re.DOTALL)
_FACTOR = re.compile(r"([a-zA-Z%°]+|1)(?:\^?(-?[0-9]{1,3}))?")
POWERS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_SIGNS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻·µμ", "0123456789-*uu")


@lru_cache(maxsize=1024)
def parse_unit(text: str) -> Unit:
    """The unit written as products and quotients of known ones, `kg/m^3`, `N*m`, `m/s²`, `/dm`; "" is 1.

    Raises UnitError with the nearest known unit for an unknown one, and for a text of more than `LONGEST` characters,
    an exponent above `HIGHEST_POWER` or a factor outside `LEAST` to `GREATEST`.
    """
    factor, dimension = 1.0, _NONE
    for name, power in _factors(text):
        known = UNITS[name]
        factor *= known[0] ** power
        a, b, c, d = (have + power * add for have, add in zip(dimension, known[1], strict=True))
        dimension = (a, b, c, d)
    if not LEAST <= factor <= GREATEST:
        raise UnitError(f"unit {text!r} is {factor:g} in SI", allowed=f"{LEAST:g} to {GREATEST:g}")
    return Unit(text, factor, dimension)


def _factors(text: str) -> Iterator[tuple[str, int]]:
    """The known units in a text and their powers, in its order. Raises UnitError as `parse_unit`."""
    _check_length(text, "unit")
    written = text.translate(_SIGNS).strip()
    sign = 1
    for part in re.split("([*/])", f"1{written}" if written.startswith("/") else written) if written else ():
        if part in ("*", "/"):
            sign = 1 if part == "*" else -1
            continue
        matched = _FACTOR.fullmatch(part.strip())
        if matched is None or matched[1] not in UNITS:
            raise UnitError(f"unknown unit {text!r}", allowed=_allowed_units(part))
        power = sign * int(matched[2] or 1)
        if abs(power) > HIGHEST_POWER:
            raise UnitError(f"unit {text!r} has the exponent {matched[2]}", allowed=f"at most {HIGHEST_POWER}")
        yield matched[1], power


def parse_quantity(text: str, unit: str) -> float:
    """The SI value of `text`, which must have the dimension of `unit`; a number without a unit is in SI.

    Raises UnitError if the text is not a number with a unit of that dimension, has more than `LONGEST` characters, or
    its magnitude is above `GREATEST`.
    """
    _check_length(text, "quantity")
    _check_length(unit, "unit")
    matched = _NUMBER.fullmatch(text.strip())
    example = f"write it like {_example(unit)}"
    if matched is None:
        raise UnitError(f"{text!r} is not a quantity", allowed=example)
    required = parse_unit(unit)
    written = parse_unit(matched[2])
    if matched[2] and written.dimension != required.dimension:
        kind = f"a quantity in {unit}" if unit not in ("", "1") else "a plain number"
        raise UnitError(f"{text!r} has the wrong unit", allowed=f"{kind} is required", do=example)
    value = float(matched[1]) * (written.factor if matched[2] else 1.0)
    if not in_bounds(value):
        raise UnitError(f"{text!r} is too large a number", allowed=f"at most {GREATEST:g} in SI", do=example)
    return value + 0.0  # 0 for -0


def read_number(text: str) -> float | None:
    """The number of a text without a unit; None for any other text and for a number out of bounds.

    >>> read_number(" -2.5 "), read_number("1_000"), read_number("2mm"), read_number("1e999")
    (-2.5, None, None, None)
    """
    matched = _NUMBER.fullmatch(text.strip()) if len(text) <= LONGEST else None
    number = float(matched[1]) if matched is not None and not matched[2] else math.nan
    return number if in_bounds(number) else None


def real_number(value: object) -> float | None:
    """A number of Python or NumPy as a float; None for any other value, a truth value, and a number out of bounds.

    >>> real_number(2), real_number("2"), real_number(True), real_number(math.nan)
    (2.0, None, None, None)
    """
    number: Any = math.nan if isinstance(value, bool) or not isinstance(value, numbers.Real) else value
    return float(number) if in_bounds(number) else None


def in_bounds(value: float) -> bool:
    """Whether a number has a magnitude of at most `GREATEST`; false for infinity and NaN.

    >>> in_bounds(-60.0), in_bounds(1e300), in_bounds(math.nan)
    (True, False, False)
    """
    return abs(value) <= GREATEST


def _check_length(text: str, noun: str) -> None:
    if not isinstance(text, str):
        raise UnitError(f"{shown_value(text)} given for a {noun}", allowed="a text")
    if len(text) > LONGEST:
        raise UnitError(f"{text[:20]!r}... is too long for a {noun}", allowed=f"at most {LONGEST} characters")


@cache
def printed_unit(unit: str) -> str:
    """A unit with superscript powers and product dots, readable by `parse_unit`; "" for 1.

    >>> printed_unit("kg/m^3"), printed_unit("N*m"), printed_unit("1/dm"), printed_unit("1")
    ('kg/m³', 'N·m', '/dm', '')
    """
    head, *powers = unit.removeprefix("1").split("^")
    for power in powers:
        digits = len(power) - len(power.lstrip("-0123456789"))
        head += power[:digits].translate(POWERS) + power[digits:]
    return head.replace("*", "·")


def si_unit(unit: str) -> str:
    """The SI unit of what is written in a unit, with the same powers: the unit of the number that ilmek keeps.

    Its factor is 1. Raises UnitError as `parse_unit`.

    >>> si_unit("mm"), si_unit("rpm"), si_unit("1/dm^2"), si_unit("N*mm"), si_unit("MPa"), si_unit("%"), si_unit("")
    ('m', 'rad/s', '1/m^2', 'N*m', 'Pa', '1', '')
    """
    powers: dict[str, int] = {}
    for name, power in _factors(unit):
        for symbol, inner in _si_powers(name):
            powers[symbol] = powers.get(symbol, 0) + power * inner
    above = "*".join(_raised(symbol, power) for symbol, power in powers.items() if power > 0)
    below = "".join(f"/{_raised(symbol, -power)}" for symbol, power in powers.items() if power < 0)
    return f"{above or '1'}{below}" if unit else ""


def _si_powers(name: str) -> tuple[tuple[str, int], ...]:
    """The SI units of a known unit and their powers; none of a pure number."""
    factor, dimension = UNITS[name]
    if dimension == _NONE:
        return ()
    if name == "rpm":
        return (("rad", 1), ("s", -1))
    return ((name if factor == 1 else next(u for u, known in UNITS.items() if known == (1.0, dimension)), 1),)


def _raised(symbol: str, power: int) -> str:
    return symbol if power == 1 else f"{symbol}^{power}"


def from_si(value: float, unit: str) -> float:
    """The SI value expressed in `unit`."""
    return value / parse_unit(unit).factor


def format_quantity(value: float, unit: str, digits: int = 4) -> str:
    """The SI value written in `unit` with `digits` significant digits, without trailing zeros.

    >>> format_quantity(0.0597375, "mm")
    '59.74 mm'
    """
    number = format_number(from_si(value, unit), digits)
    printed = printed_unit(unit)
    return f"{number}{' ' if printed[:1].isalpha() else ''}{printed}"


def in_mm(length: float) -> str:
    """A length as it stands in a parts list.

    >>> in_mm(0.0597375)
    '59.74 mm'
    """
    return format_quantity(length, "mm")


def round_size(diameter: float) -> str:
    """A diameter as it stands in a parts list.

    >>> round_size(0.012)
    'round 12 mm'
    """
    return f"round {in_mm(diameter)}"


def counted(number: int, noun: str, plural: str = "") -> str:
    """A number with its noun, in the plural where it is not one; default: with an s.

    >>> counted(1, "knot"), counted(2100, "knot"), counted(0, "patch", "patches")
    ('1 knot', '2,100 knots', '0 patches')
    """
    return f"{number:,} {noun if number == 1 else plural or f'{noun}s'}"


def format_number(value: float, digits: int = 4) -> str:
    """A number with `digits` significant digits, plain between 1e-4 and 1e7, else in powers of ten.

    >>> format_number(135000.0), format_number(0.00002), format_number(float("inf"))
    ('135000', '2e-05', 'inf')
    """
    if value == 0 or not math.isfinite(value):
        return "0" if value == 0 else str(value)
    if not 1e-4 <= abs(value) < 1e7:
        return f"{value:.{digits}g}"
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    plain = f"{value:.{decimals}f}"
    return plain.rstrip("0").rstrip(".") if "." in plain else plain


def has_unit(text: str) -> bool:
    """Whether the text of a quantity has a unit after its number.

    >>> has_unit("40/dm"), has_unit("40")
    (True, False)
    """
    matched = _NUMBER.fullmatch(text.strip()) if len(text) <= LONGEST else None
    return matched is not None and bool(matched[2])


def similar_units(unit: str) -> tuple[str, ...]:
    """Units of the same dimension in which numbers are often given without a unit.

    >>> similar_units("m"), similar_units("rad/s")
    (('mm', 'cm'), ('rpm',))
    """
    dimension = parse_unit(unit).dimension
    return tuple(name for name in _OFTEN_LEFT_OUT if name != unit and parse_unit(name).dimension == dimension)


_OFTEN_LEFT_OUT = ("deg", "mm", "cm", "1/dm", "rpm", "MPa", "ms", "g")


def _example(unit: str) -> str:
    return f"60{unit.removeprefix('1')}"


def _allowed_units(part: str) -> str:
    nearest = difflib.get_close_matches(part, UNITS, n=1, cutoff=0.5)
    hint = f"did you mean {nearest[0]!r}? " if nearest else ""
    return f"{hint}known units: {' '.join(name for name in UNITS if name != '1')}"
