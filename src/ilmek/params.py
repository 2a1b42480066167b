"""Declared parameters: one declaration drives validation, command-line options, forms and documentation.

    @dataclass(frozen=True, slots=True)
    class BeatUpParams(Params):
        swing: float = param(30 * deg, unit="deg", above=0.0, below=180 * deg, doc="swing of the rocker", symbol="psi")

A parameter is a float (with a unit), an int, a bool or a str (with `choices`, if any). `| None` with default None makes
it optional. Bounds are in SI. `above`/`below` exclude the bound, `at_least`/`at_most` include it. An `alias` is a
second name under which `Params.read` takes it, small and capital letters alike: the symbol that a paper gives it.
"""

import difflib
import math
import types
import typing
from collections.abc import Mapping
from dataclasses import MISSING, Field, dataclass, field, fields
from functools import cache
from typing import Any, TypeVar

from ilmek.errors import ParameterError, UnitError
from ilmek.units import deg, format_quantity, mm, parse_quantity

Value: typing.TypeAlias = float | int | bool | str | None
P = TypeVar("P", bound="Params")
Setting: typing.TypeAlias = float | int | bool | str | None


NEXT_TO_NOTHING = 1e-60
"""A size below which a number is no quantity of a machine, and its powers are lost to a computer."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """A declared parameter of a machine."""

    name: str
    kind: type
    default: Value
    unit: str
    above: float | None
    at_least: float | None
    below: float | None
    at_most: float | None
    choices: tuple[str, ...]
    doc: str
    symbol: str
    alias: str

    def read(self, setting: Setting) -> Value:
        """The value of a setting: a number is SI, a text is read with its unit. Raises ParameterError."""
        if not isinstance(setting, str):
            return setting
        text = setting.strip()
        try:
            if self.kind is str:
                return text
            if self.kind is bool:
                return _TRUTH[text.lower()]
            if text.lower() == "none" and self.default is None:
                return None
            number = parse_quantity(text, self.unit)
        except KeyError:
            raise ParameterError(f"{self.name}={setting!r} is neither true nor false", do="write yes or no") from None
        except UnitError as error:
            raise ParameterError(f"{self.name}: {error.given}", allowed=error.allowed, do=error.do) from None
        if self.kind is int:
            if number != round(number):
                raise ParameterError(f"{self.name}={setting} is not a whole number", allowed=self.allowed())
            return round(number)
        return number

    def check(self, value: Value) -> None:
        """Raise ParameterError unless the value is within the declared kind and bounds."""
        if value is None and self.default is None:
            return
        if self.kind is str:
            if self.choices and value not in self.choices:
                near = difflib.get_close_matches(str(value), self.choices, n=1)
                hint = f"did you mean {near[0]}?" if near else ""
                raise ParameterError(f"{self.name}={value!r} is unknown", allowed=self.allowed(), do=hint)
            return
        if self.kind is bool:
            if not isinstance(value, bool):
                raise ParameterError(f"{self.name}={value!r} is neither true nor false")
            return
        if isinstance(value, bool | str) or value is None or not math.isfinite(value):
            raise ParameterError(f"{self.name}={value!r} is not a number", allowed=self.allowed())
        if self.kind is int and value != int(value):
            raise ParameterError(f"{self.name}={value!r} is not a whole number", allowed=self.allowed())
        if 0 < abs(value) < NEXT_TO_NOTHING:
            raise ParameterError(
                f"{self.name}={value:g} is next to nothing", allowed=self.allowed(), do="0 may be meant"
            )
        if not self.within(value):
            shown = format_quantity(value, self.unit)
            raise ParameterError(f"{self.name}={shown} is out of bounds", allowed=self.allowed(), do=self._slip(value))

    def within(self, value: float) -> bool:
        """Whether a number lies within the declared bounds."""
        return (
            (self.above is None or value > self.above)
            and (self.at_least is None or value >= self.at_least)
            and (self.below is None or value < self.below)
            and (self.at_most is None or value <= self.at_most)
        )

    def allowed(self) -> str:
        """The bounds or choices in words: `above 0 mm, at most 500 mm`."""
        if self.choices:
            return f"one of {', '.join(self.choices)}"
        limits = (("above", self.above), ("at least", self.at_least), ("below", self.below), ("at most", self.at_most))
        said = [f"{word} {format_quantity(limit, self.unit)}" for word, limit in limits if limit is not None]
        return f"allowed: {', '.join(said)}" if said else ""

    def _slip(self, value: float) -> str:
        """The unit that was probably forgotten, where the number is short enough to have been typed as it is."""
        if float(f"{value:.6g}") != value:
            return ""
        if self.unit == "deg" and self.within(value * deg):
            return f"did you mean {value:g}deg? a bare number is in radians"
        if self.unit == "mm" and self.within(value * mm):
            return f"did you mean {value:g}mm? a bare number is in metres"
        return ""


_TRUTH = {"yes": True, "true": True, "on": True, "1": True, "no": False, "false": False, "off": False, "0": False}


def param(
    default: Value,
    *,
    unit: str = "",
    above: float | None = None,
    at_least: float | None = None,
    below: float | None = None,
    at_most: float | None = None,
    choices: tuple[str, ...] = (),
    doc: str,
    symbol: str = "",
    alias: str = "",
) -> Any:
    """Declare a parameter as the default of a dataclass field; bounds in SI."""
    return field(
        default=default,
        metadata=dict(
            unit=unit,
            above=above,
            at_least=at_least,
            below=below,
            at_most=at_most,
            choices=choices,
            doc=doc,
            symbol=symbol,
            alias=alias,
        ),
    )


@dataclass(frozen=True, slots=True)
class Params:
    """Base of every machine's parameters: a frozen dataclass whose fields are made by `param`."""

    def __post_init__(self) -> None:
        for parameter in declared(type(self)):
            parameter.check(getattr(self, parameter.name))
        self.check_together()

    def check_together(self) -> None:
        """Raise ParameterError where parameters contradict each other; nothing by default."""

    @classmethod
    def read(cls: type[P], settings: Mapping[str, Setting]) -> P:
        """Parameters from settings by name or alias, texts with units allowed.

        Raises ParameterError for an unknown name, and for a parameter set by its name and by its alias.
        """
        known = {parameter.name: parameter for parameter in declared(cls)}
        aliases = {parameter.alias.casefold(): name for name, parameter in known.items() if parameter.alias}
        said: dict[str, str] = {}
        for given in settings:
            name = given if given in known else aliases.get(given.casefold(), "")
            if not name:
                near = difflib.get_close_matches(given, (*known, *aliases), n=1)
                hint = f"did you mean {near[0]}?" if near else ""
                raise ParameterError(f"unknown parameter {given!r}", do=hint or f"known: {', '.join(known)}")
            if name in said:
                raise ParameterError(f"{name} is set twice, as {said[name]} and as {given}", do="set it once")
            said[name] = given
        return cls(**{name: known[name].read(settings[given]) for name, given in said.items()})

    def as_dict(self) -> dict[str, Value]:
        """Name to SI value, in order of declaration."""
        return {parameter.name: getattr(self, parameter.name) for parameter in declared(type(self))}


def declared(cls: type[Params]) -> tuple[Parameter, ...]:
    """The parameters declared by a class, in order."""
    known: Any = cls  # a checker takes a class of dataclasses for one of its objects, which cannot be hashed
    return _declared(known)


@cache
def _declared(cls: Any) -> tuple[Parameter, ...]:
    """The same, looked up once: every set of parameters that is made asks for them."""
    hints = typing.get_type_hints(cls)
    return tuple(_parameter(f, hints[f.name]) for f in fields(cls))


def _parameter(declared_field: "Field[Any]", hint: Any) -> Parameter:
    kinds = [kind for kind in typing.get_args(hint) if kind is not types.NoneType] or [hint]
    if declared_field.default is MISSING or "doc" not in declared_field.metadata:
        raise TypeError(f"{declared_field.name} is not made by param(...)")
    return Parameter(name=declared_field.name, kind=kinds[0], default=declared_field.default, **declared_field.metadata)
