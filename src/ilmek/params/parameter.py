"""One declared parameter: its kind, unit, bounds and meaning; reading and judging a setting of it."""

import difflib
import math
import typing
from dataclasses import dataclass
from functools import reduce

from ilmek.errors import ParameterError, UnitError
from ilmek.records import shown_value
from ilmek.sentences import Sentence, with_location
from ilmek.units import GREATEST, LEAST, format_quantity, has_unit, parse_quantity, parse_unit, similar_units

Value: typing.TypeAlias = float | int | bool | str | None
"""The value of a parameter: SI, radians."""

Setting: typing.TypeAlias = float | int | bool | str | None
"""What a user sets: a number is SI, a text is read with its unit."""

LONGEST_TEXT = 20_000
"""Largest number of characters of a parameter that is a text; a list of 1,000 points."""

_UNIT_REQUIRED = ("1/dm",)
"""Units of quantities that nobody writes in SI: a bare 40 is never 40 per metre."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """A declared parameter.

    kind      float, int, bool or str
    unit      in which it is shown and explained; bounds and default are SI
    choices   of a text: the only values allowed; empty: any; of a number: words that are allowed besides numbers
    alias     second name under which it can be set, small and capital letters alike
    """

    name: str
    kind: type
    default: Value
    doc: str
    unit: str = ""
    above: float | None = None
    at_least: float | None = None
    below: float | None = None
    at_most: float | None = None
    choices: tuple[str, ...] = ()
    symbol: str = ""
    alias: str = ""

    def read(self, setting: Setting) -> Value:
        """The value of a setting: a number is SI, a text is read with its unit.

        Raises ParameterError where the text is no value of this kind, or has no unit where one is required.
        """
        if not isinstance(setting, str):
            return self._plain(setting)
        text = setting.strip()
        try:
            if self.kind is str or text.lower() in self.choices:
                return text if self.kind is str else text.lower()
            if self.kind is bool:
                return _TRUTH[text.lower()]
            if text.lower() == "none" and self.default is None:
                return None
            number = self._snapped(parse_quantity(text, self.unit))
        except KeyError:
            raise ParameterError(
                Sentence("value.no-truth", name=self.name, value=str(setting)), do="write yes or no"
            ) from None
        except UnitError as error:
            raise ParameterError(with_location(self.name, error.given), allowed=error.allowed, do=error.do) from None
        if self.unit in _UNIT_REQUIRED and number != 0 and not has_unit(text):
            per = self.unit.removeprefix("1")
            raise ParameterError(f"{self.name}={text} has no unit", do=f"did you mean {text}{per}?")
        if has_unit(text) and abs(number) <= GREATEST and not self.within(number):
            raise self._out_of_bounds(number)
        return self._whole(number, setting) if self.kind is int else number

    def _plain(self, setting: object) -> Value:
        """A setting that is no text, as a plain value of Python."""
        value = setting.item() if hasattr(setting, "item") and getattr(setting, "shape", None) == () else setting
        if value is not None and not isinstance(value, bool | int | float | str):
            given = f"{self.name} is {shown_value(value)}"
            raise ParameterError(given, allowed=self.allowed() or "a number or a text")
        return value

    def _whole(self, number: float, setting: Setting) -> int:
        if number != round(number):
            raise ParameterError(Sentence("value.not-whole", name=self.name, value=setting), allowed=self.allowed())
        return round(number)

    def _check_text(self, text: Value) -> None:
        """Raise ParameterError for a value that is no text, is too long, or has characters that cannot be printed."""
        if not isinstance(text, str):
            raise ParameterError(f"{self.name}={text!r} is not a text", allowed=self.allowed())
        given = f"{self.name}={text[:20]!r}{'...' if len(text) > 20 else ''}"
        if len(text) > LONGEST_TEXT:
            raise ParameterError(
                Sentence("value.too-long", value=given),
                allowed=Sentence("value.at-most-characters", count=LONGEST_TEXT),
            )
        if not "".join(text.split()).isprintable():
            raise ParameterError(f"{given} has characters that cannot be printed")

    def check(self, value: Value) -> None:
        """Raise ParameterError unless the value is of the declared kind and within the bounds."""
        if type(value) is float and self.kind is float and LEAST <= abs(value) <= GREATEST and self.within(value):
            return  # as nearly all are
        if value is None and self.default is None:
            return
        if self.kind is str:
            self._check_text(value)
            if self.choices and value not in self.choices:
                near = difflib.get_close_matches(str(value), self.choices, n=1)
                hint = f"did you mean {near[0]}?" if near else ""
                raise ParameterError(
                    Sentence("value.unknown", name=self.name, value=repr(value)), allowed=self.allowed(), do=hint
                )
            return
        if self.kind is bool:
            if not isinstance(value, bool):
                raise ParameterError(f"{self.name}={value!r} is neither true nor false")
            return
        if value not in self.choices:
            self._check_number(value)

    def _check_number(self, value: Value) -> None:
        """Raise ParameterError unless the value is a number within the bounds."""
        if isinstance(value, bool | str) or value is None or not abs(value) < math.inf:
            raise ParameterError(Sentence("value.no-number", name=self.name, value=repr(value)), allowed=self.allowed())
        if abs(value) > GREATEST:
            raise ParameterError(f"{self.name} is too large", allowed=self.allowed() or f"at most {GREATEST:g} in SI")
        if self.kind is int and value != int(value):
            raise ParameterError(Sentence("value.not-whole", name=self.name, value=repr(value)), allowed=self.allowed())
        if 0 < abs(value) < LEAST:
            raise ParameterError(f"{self.name}={value:g} is too small", allowed=self.allowed(), do="did you mean 0?")
        if not self.within(value):
            raise self._out_of_bounds(value, self._likely_slip(value))

    def _out_of_bounds(self, value: float, do: str = "") -> ParameterError:
        shown = format_quantity(value, self.unit)
        return ParameterError(
            Sentence("value.out-of-bounds", name=self.name, value=shown), allowed=self.allowed(), do=do
        )

    def _snapped(self, number: float) -> float:
        """The bound that a number equals but for the rounding of its unit, else the number: 10um is 0.01 mm."""
        bounds = (bound for bound in (self.at_least, self.at_most) if bound is not None)
        return next((bound for bound in bounds if math.isclose(number, bound, rel_tol=1e-12)), number)

    def within(self, value: float) -> bool:
        """Whether a number lies within the declared bounds: `above`, `below` exclude, `at_least`, `at_most` include."""
        return (
            (self.above is None or value > self.above)
            and (self.at_least is None or value >= self.at_least)
            and (self.below is None or value < self.below)
            and (self.at_most is None or value <= self.at_most)
        )

    def allowed(self) -> str:
        """The bounds or choices in words: `allowed: above 0 mm, at most 500 mm`."""
        if self.choices and self.kind is str:
            return Sentence("value.one-of", choices=", ".join(self.choices))
        bounds = self.bounds()
        return bounds and Sentence("value.allowed", bounds=bounds)

    def bounds(self) -> str:
        """The same without the word before bounds: `above 0 mm, at most 500 mm`."""
        if self.choices and self.kind is str:
            return self.allowed()
        limits = (
            ("value.above", self.above),
            ("value.at-least", self.at_least),
            ("value.below", self.below),
            ("value.at-most", self.at_most),
        )
        found = [Sentence(key, limit=format_quantity(limit, self.unit)) for key, limit in limits if limit is not None]
        if not found:
            return ""
        bounds = reduce(lambda first, second: Sentence("value.both", first=first, second=second), found)
        return Sentence("value.or", bounds=bounds, choices=", ".join(self.choices)) if self.choices else bounds

    def _likely_slip(self, value: float) -> str:
        """The unit that was probably forgotten, where the number is short enough to have been typed as it is."""
        if float(f"{value:.6g}") != value:
            return ""
        for unit in (self.unit, *similar_units(self.unit)):
            factor = parse_unit(unit).factor
            if factor != 1.0 and self.within(value * factor):
                written = f"{value:g}{unit.removeprefix('1')}"
                base = {"deg": "radians", "mm": "metres", "cm": "metres"}.get(unit, "SI units")
                return f"did you mean {written}? a bare number is in {base}"
        return ""


_TRUTH = {"yes": True, "true": True, "on": True, "1": True, "no": False, "false": False, "off": False, "0": False}
