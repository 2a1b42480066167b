"""Expressions of quantities: numbers with units, named values, + - * / ^, parentheses and some functions.

    2*r + 10mm      sqrt(a^2 + b^2)      4 r      hypot(a, b)/2      r*cos(30deg)      -z1/z2

A number directly before a unit, a name or a parenthesis multiplies it: `10mm`, `4 r`. Dimensions are checked in every
step. Nothing of the text is executed: a parser of its own evaluates it, bounded in length and depth.

>>> evaluate("2*r + 10mm", {"r": Amount(0.04, (1, 0, 0, 0))})
Amount(value=0.09, dimension=(1, 0, 0, 0))
"""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from ilmek.errors import UnitError, did_you_mean, shortened
from ilmek.units import GREATEST, HIGHEST_POWER, UNITS, Dimension, in_bounds, parse_unit

LONGEST_EXPRESSION = 200
"""Largest number of characters of an expression."""

DEEPEST_EXPRESSION = 20
"""Largest depth of parentheses, signs and functions of an expression."""

NUMBER: Dimension = (0, 0, 0, 0)
ANGLE: Dimension = (0, 0, 0, 1)

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)|(?P<name>[^\W\d]\w*|[°%])"
    r"|(?P<sign>\*\*|[-+*/^(),])|(?P<other>\S))"
)
NUMBER_HEAD = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?\s*")
"""The number of a quantity, before its unit."""

_SIGNS = str.maketrans("·×−", "**-")


class Amount(NamedTuple):
    """A value in SI, and its dimension: the exponents of metre, kilogram, second and radian."""

    value: float
    dimension: Dimension


def evaluate(text: str, values: Mapping[str, Amount]) -> Amount:
    """The amount of an expression of named values. Raises UnitError, with the text, for any error in it."""
    if len(text) > LONGEST_EXPRESSION:
        raise UnitError(f"{text[:20]!r}... is too long", allowed=f"at most {LONGEST_EXPRESSION} characters")
    parser = _Parser(text, _tokens(text), values)
    if (
        len(parser.tokens) == 1
        and parser.kind == "name"
        and parser.token not in {*values, "pi"}
        and is_unit(parser.token)
    ):
        raise parser.error("is a unit without a number", allowed=f"write it like 60{parser.token}")
    amount = parser.sum(0)
    if parser.at < len(parser.tokens):
        raise parser.unexpected()
    return amount


def names_in(text: str) -> set[str]:
    """The names of values, units and functions in an expression.

    >>> sorted(names_in("2*r + sqrt(a2)*10mm"))
    ['a2', 'mm', 'r', 'sqrt']
    """
    return {token for kind, token in _tokens(text[: LONGEST_EXPRESSION + 1]) if kind == "name"}


@lru_cache(maxsize=1024)
def is_unit(name: str) -> bool:
    """Whether a name is the symbol of a unit."""
    try:
        return bool(name) and not name[-1].isdigit() and parse_unit(name) is not None
    except UnitError:
        return False


def printed_dimension(dimension: Dimension) -> str:
    """A dimension in base units.

    >>> printed_dimension((1, 1, -2, 0)), printed_dimension((0, 0, 0, 0))
    ('m*kg/s^2', 'a plain number')
    """
    names = list(zip(("m", "kg", "s", "rad"), dimension, strict=True))
    above = "*".join(_power(name, power) for name, power in names if power > 0)
    below = "".join(f"/{_power(name, -power)}" for name, power in names if power < 0)
    return f"{above or '1'}{below}" if above or below else "a plain number"


def _power(name: str, power: int) -> str:
    return name if power == 1 else f"{name}^{power}"


def _tokens(text: str) -> list[tuple[str, str]]:
    return [(token.lastgroup or "", token[token.lastgroup or 0]) for token in _TOKEN.finditer(text.translate(_SIGNS))]


@dataclass(slots=True)
class _Parser:
    """A recursive descent through the tokens of an expression."""

    text: str
    tokens: list[tuple[str, str]]
    values: Mapping[str, Amount]
    at: int = 0

    def sum(self, depth: int) -> Amount:
        if depth > DEEPEST_EXPRESSION:
            raise self.error("is nested too deeply", allowed=f"at most {DEEPEST_EXPRESSION} levels")
        total = self.product(depth)
        while sign := self.take("+", "-"):
            right = self.product(depth)
            self.same((total, right), "+" if sign == "+" else "-")
            total = self.checked(total.value + (right.value if sign == "+" else -right.value), total.dimension)
        return total

    def product(self, depth: int) -> Amount:
        total = self.signed(depth, divided=False)
        while sign := self.take("*", "/"):
            right = self.signed(depth, divided=sign == "/")
            if sign == "/" and right.value == 0:
                raise self.error("divides by 0")
            value = total.value * right.value if sign == "*" else total.value / right.value
            total = self.checked(value, _combined(total.dimension, right.dimension, 1 if sign == "*" else -1))
        return total

    def signed(self, depth: int, *, divided: bool) -> Amount:
        if sign := self.take("+", "-"):
            if depth >= DEEPEST_EXPRESSION:
                raise self.error("is nested too deeply", allowed=f"at most {DEEPEST_EXPRESSION} levels")
            inner = self.signed(depth + 1, divided=divided)
            return Amount(-inner.value, inner.dimension) if sign == "-" else inner
        is_number = self.kind == "number"
        amount = self.power(depth)
        if not is_number or not (self.kind == "name" or self.token == "("):
            return amount
        if divided and not self.is_unit_next:
            raise self.error(f"is ambiguous at {self.token!r}", allowed="write * or parentheses there")
        right = self.power(depth)
        return self.checked(amount.value * right.value, _combined(amount.dimension, right.dimension, 1))

    def power(self, depth: int) -> Amount:
        base = self.atom(depth)
        if not self.take("^", "**"):
            return base
        sign = -1 if self.take("-") else 1
        if self.kind != "number" or not self.token.isdigit() or int(self.token[:4]) > HIGHEST_POWER:
            raise self.error("has a power that is not allowed", allowed=f"whole numbers up to {HIGHEST_POWER}")
        power = sign * int(self.token)
        self.at += 1
        if self.take("^", "**"):
            raise self.error("has a power of a power", allowed="one power, or parentheses: (a^2)^3")
        if base.value == 0 and power < 0:
            raise self.error("divides by 0")
        try:
            value = base.value**power
        except OverflowError:
            value = math.inf
        return self.checked(value, _combined(NUMBER, base.dimension, power))

    def atom(self, depth: int) -> Amount:
        kind, token = self.kind, self.token
        if self.take("("):
            return self.closed(self.sum(depth + 1))
        if kind not in ("number", "name"):
            raise self.unexpected()
        self.at += 1
        if kind == "number":
            return self.checked(float(token), NUMBER)
        if self.token == "(" and token in FUNCTIONS:
            return self.call(token, depth)
        amount = Amount(math.pi, NUMBER) if token == "pi" else self.values.get(token)
        if amount is not None:
            return amount
        if is_unit(token):
            unit = parse_unit(token)
            return Amount(unit.factor, unit.dimension)
        allowed = "a value of [values], a unit, pi or a function"
        near = did_you_mean(token, [*self.values, *UNITS, *FUNCTIONS])
        raise UnitError(f"{shortened(repr(self.text))} has an unknown name {token!r}", allowed=allowed, do=near)

    def call(self, name: str, depth: int) -> Amount:
        self.take("(")
        given = [self.sum(depth + 1)]
        while self.take(","):
            given.append(self.sum(depth + 1))
        self.closed(given[0])
        function = FUNCTIONS[name]
        if not function.least <= len(given) <= function.most:
            raise self.error(f"gives {len(given)} numbers to {name}", allowed=f"{function.least} to {function.most}")
        if function.of is not None and any(one.dimension != function.of for one in given):
            raise self.error(f"gives {name} {printed_dimension(given[0].dimension)}", allowed=function.allowed)
        self.same(given, name)
        try:
            value = function.value(*(one.value for one in given))
        except (ValueError, OverflowError, ZeroDivisionError):
            value = math.nan
        if name == "sqrt" and any(power % 2 for power in given[0].dimension):
            raise self.error(f"takes the root of {printed_dimension(given[0].dimension)}")
        made = function.gives
        if made is None:
            made = _halved(given[0].dimension) if name == "sqrt" else given[0].dimension
        return self.checked(value, made)

    def closed(self, found: Amount) -> Amount:
        if not self.take(")"):
            raise self.unexpected()
        return found

    def same(self, amounts: Sequence[Amount], what: str) -> None:
        for amount in amounts:
            if amount.dimension != amounts[0].dimension:
                both = f"{printed_dimension(amounts[0].dimension)} and {printed_dimension(amount.dimension)}"
                raise self.error(f"joins {both} by {what}", allowed="quantities of one dimension")

    def checked(self, value: float, dimension: Dimension) -> Amount:
        if not in_bounds(value):
            raise self.error("has no finite value", allowed=f"at most {GREATEST:g} in every step")
        if any(abs(power) > HIGHEST_POWER for power in dimension):
            raise self.error("has too high a power of a unit", allowed=f"at most {HIGHEST_POWER}")
        return Amount(value, dimension)

    @property
    def kind(self) -> str:
        return self.tokens[self.at][0] if self.at < len(self.tokens) else "end"

    @property
    def token(self) -> str:
        return self.tokens[self.at][1] if self.at < len(self.tokens) else ""

    @property
    def is_unit_next(self) -> bool:
        return self.kind == "name" and self.token not in self.values and is_unit(self.token)

    def take(self, *signs: str) -> str:
        token = self.token
        if self.kind == "sign" and token in signs:
            self.at += 1
            return token
        return ""

    def unexpected(self) -> UnitError:
        return self.error(f"is incomplete at {self.token!r}" if self.token else "is incomplete")

    def error(self, what: str, *, allowed: str = "") -> UnitError:
        return UnitError(f"{shortened(repr(self.text))} {what}", allowed=allowed)


class _Function(NamedTuple):
    """A function: its value, its numbers of arguments, their dimension (None: any, all the same), and its result's.

    gives  None: the dimension of the arguments
    """

    value: Callable[..., float]
    least: int
    most: int
    of: Dimension | None = None
    gives: Dimension | None = None
    allowed: str = ""


FUNCTIONS = {
    **{
        name: _Function(getattr(math, name), 1, 1, ANGLE, NUMBER, "an angle, like 30deg")
        for name in ("sin", "cos", "tan")
    },
    **{
        name: _Function(getattr(math, name), 1, 1, NUMBER, ANGLE, "a plain number") for name in ("asin", "acos", "atan")
    },
    "atan2": _Function(math.atan2, 2, 2, None, ANGLE),
    "sqrt": _Function(math.sqrt, 1, 1),
    "abs": _Function(abs, 1, 1),
    "hypot": _Function(math.hypot, 2, 10),
    "min": _Function(min, 2, 10),
    "max": _Function(max, 2, 10),
}
"""Functions of expressions."""


def _combined(first: Dimension, second: Dimension, power: int) -> Dimension:
    a, b, c, d = (one + power * other for one, other in zip(first, second, strict=True))
    return a, b, c, d


def _halved(dimension: Dimension) -> Dimension:
    a, b, c, d = (power // 2 for power in dimension)
    return a, b, c, d
