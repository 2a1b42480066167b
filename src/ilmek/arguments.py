"""What a caller may give: numbers, points, names and records, each converted at one edge.

A number is in SI and radians, whatever its type; a text carries its unit. A point is a complex number or its two
coordinates. Anything else raises an error of the package that states the argument, what it is and what it may be. The
public functions and the records that a user builds convert their arguments here, so that the formulas behind them see
floats and complex numbers alone.

>>> given = Arguments("a link")
>>> given.length("width", 0.03), given.length("width", "30mm"), given.length("width", np.int8(1))
(0.03, 0.03, 1.0)
>>> given.point("end", (0.1, 0.2)), given.point("end", ("100mm", 0.2)), given.point("end", 0.1 + 0.2j)
((0.1+0.2j), (0.1+0.2j), (0.1+0.2j))
>>> given.length("width", 30)
Traceback (most recent call last):
...
ilmek.errors.ParameterError: width of a link is 30 m; lengths are in metres, up to 10 m; if millimetres were meant, \
write 30 * mm for 30, and so for all lengths
"""

import math
import numbers
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, FloatArray, RealField
from ilmek.errors import IlmekError, ParameterError, UnitError, did_you_mean, restated
from ilmek.records import shown_value
from ilmek.units import GREATEST, format_number, has_unit, parse_quantity, parse_unit

T = TypeVar("T")

Quantity: TypeAlias = float | str
"""A number in SI and radians, or a text with its unit."""

Quantities: TypeAlias = RealField | str | Sequence[Quantity]
"""A quantity, or one value per sample."""

Point: TypeAlias = complex | str | Sequence[Quantity]
"""A planar point or vector: a complex number, or its two coordinates."""

Points: TypeAlias = ComplexArray | FloatArray | Sequence[Point]
"""Planar points: complex numbers, pairs of coordinates, or an array of N x 2 of them."""

LONGEST = 10.0
"""Length [m] above which millimetres were meant; assumed by this project: no link or lift of a loom is that long."""

TURN = 2 * math.pi

COARSE = 0.5
"""Step between two samples [rad] (29 deg) at which a motion of several turns was meant in degrees."""

_USUAL = {"m": "mm", "rad": "deg", "rad/s": "rpm", "kg": "g"}
"""Unit of an example, by the unit in SI."""

_REAL = "iuf"
"""Kinds of numpy's real numbers: signed, unsigned, floating."""


class Arguments:
    """The arguments of one function or record, converted one by one.

    of     what they are arguments of, a phrase for messages: "a pose"
    error  class of the errors
    """

    __slots__ = ("error", "of")

    def __init__(self, of: str, error: type[IlmekError] = ParameterError) -> None:
        self.of = of
        self.error = error

    def _wrong(self, name: str, value: object, allowed: str, do: str = "") -> IlmekError:
        return self.error(f"{self._subject(name)} is {shown_value(value)}", allowed=allowed, do=do)

    def _subject(self, name: str) -> str:
        return f"{name} of {self.of}" if self.of else name

    # quantities

    def number(self, name: str, value: object, unit: str = "", *, most: float = GREATEST) -> float:
        """A finite real number [SI], at most `most` in magnitude; a text has the dimension of `unit`."""
        if type(value) is float:
            number = value
        elif isinstance(value, str):
            number = self._of_text(name, value, unit)
        elif isinstance(value, np.ndarray) and value.ndim == 0:
            return self.number(name, value.item(), unit, most=most)
        elif isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise self._wrong(name, value, _allowed(unit))
        else:
            number = _as_float(value)
        if not abs(number) <= most:
            allowed = _within(most, unit) if math.isfinite(number) else "a finite number"
            raise self._wrong(name, value if isinstance(value, str) else number, allowed)
        return number

    def _of_text(self, name: str, text: str, unit: str) -> float:
        """The quantity of a text; only a pure number and 0 need no unit."""
        with restated(UnitError, f"{self._subject(name)}: ", of=UnitError):
            number = parse_quantity(text, unit)
        if number and unit and not has_unit(text):
            do = f"write {text.strip()}{_USUAL.get(unit, unit).removeprefix('1')}"
            raise UnitError(f"{self._subject(name)}: {text.strip()} has no unit", do=do)
        return number

    def length(self, name: str, value: object, *, least: float = -math.inf, most: float = LONGEST) -> float:
        """A length [m]; one above `most` was probably meant in millimetres."""
        length = self.number(name, value, "m")
        if abs(length) > most:
            shown = value if isinstance(value, str) else f"{length:g}"
            do = f"if millimetres were meant, write {shown} * mm for {shown}, and so for all lengths"
            raise self.error(
                f"{self._subject(name)} is {length:g} m", allowed=f"lengths are in metres, up to {most:g} m", do=do
            )
        if length < least:
            raise self._wrong(name, length, f"at least {least:g} m")
        return length

    def angle(self, name: str, value: object, *, most: float = TURN) -> float:
        """An angle [rad]; one above `most` was probably meant in degrees."""
        angle = self.number(name, value, "rad")
        if abs(angle) > most * (1 + 1e-9):
            allowed = f"angles are in radians, up to {most:.4g} rad here"
            do = f"if degrees were meant, write {angle:g} * deg"
            raise self.error(f"{self._subject(name)} is {angle:g} rad", allowed=allowed, do=do)
        return angle

    def not_negative(self, name: str, value: object, unit: str = "") -> float:
        """A number that is 0 or more [SI]."""
        number = self.number(name, value, unit)
        if number < 0:
            raise self._wrong(name, number, "not negative")
        return number

    def whole(self, name: str, value: object, *, least: int = 0, most: int = 10**9) -> int:
        """A whole number within bounds."""
        number = self.number(name, value)
        if number != round(number) or not least <= number <= most:
            raise self._wrong(name, value, f"a whole number, {least} to {most}")
        return round(number)

    def values(self, name: str, value: object, unit: str = "", *, finite: bool = True) -> RealField:
        """A number, or an array of numbers [SI]; finite: whether NaN and infinity in an array are an error."""
        if isinstance(value, list | tuple | range):
            array = self._of_sequence(name, value, unit)
        elif not isinstance(value, np.ndarray) and not hasattr(value, "__array__"):
            return self.number(name, value, unit)
        else:
            array = np.asarray(value)
            if array.ndim == 0:
                return self.number(name, array, unit)
        if array.dtype.kind == "O":
            array = self._of_sequence(name, list(array.ravel()), unit).reshape(array.shape)
        if array.dtype.kind not in _REAL:
            raise self._wrong(name, array, _allowed(unit))
        if finite and not np.isfinite(array).all():
            raise self._wrong(name, array, "finite numbers")
        return array.astype(float, copy=False)

    def _of_sequence(self, name: str, values: Sequence[object], unit: str) -> FloatArray:
        if all(type(item) is float for item in values):
            return np.array(values)
        return np.array([self.number(f"value {i} of {name}", item, unit) for i, item in enumerate(values, 1)])

    def lengths(self, name: str, value: object) -> RealField:
        """A length, or an array of lengths [m], each at most LONGEST."""
        lengths = self.values(name, value, "m")
        if np.size(lengths):
            self.length(name, float(np.ravel(lengths)[np.argmax(np.abs(lengths))]))
        return lengths

    def together(self, *fields: RealField) -> tuple[RealField, ...]:
        """Numbers and arrays whose shapes must fit one another, as they are."""
        try:
            np.broadcast_shapes(*(np.shape(field) for field in fields))
        except ValueError:
            shapes = " and ".join(str(np.shape(field)) for field in fields if np.ndim(field))
            raise self.error(f"arrays of shapes {shapes} of {self.of}", allowed="shapes that fit one another") from None
        return fields

    def turning(self, name: str, value: object, otherwise: str) -> RealField:
        """Values of an angle that may go on for turns [rad], unless they look like degrees.

        otherwise  for the message: what takes any angle

        They do where they exceed two turns, and either end on a whole number, or end one step before it, or go by steps
        of more than COARSE. Values in radians hardly ever do.
        """
        angles = self.values(name, value, "rad")
        if isinstance(value, str):
            return angles
        samples = np.ravel(angles)
        if samples.size == 0 or np.max(np.abs(samples)) <= 2 * TURN:
            return angles
        greatest = float(samples[np.argmax(np.abs(samples))])
        ends = [greatest, *((float(2 * samples[-1] - samples[-2]),) if samples.size > 1 else ())]
        whole = any(abs(end - round(end)) <= 1e-9 * abs(end) for end in ends)
        coarse = samples.size > 1 and float(np.median(np.abs(np.diff(samples)))) > COARSE
        if whole or coarse:
            given = f"{self._subject(name)} turns to {greatest:g} rad ({greatest / TURN:.1f} turns)"
            do = f"if degrees were meant, multiply by deg; {otherwise} takes any angle"
            raise self.error(given, allowed="angles are in radians", do=do)
        return angles

    # points

    def point(self, name: str, value: object, *, unit: str = "m", most: float = GREATEST) -> complex:
        """A planar point or vector [SI]: a complex number, a real one on the x axis, or its two coordinates."""
        if type(value) is complex:
            point = value
        elif isinstance(value, np.ndarray) and value.ndim == 0:
            return self.point(name, value.item(), unit=unit, most=most)
        elif isinstance(value, numbers.Complex) and not isinstance(value, numbers.Real):
            point = complex(value)
        elif isinstance(value, list | tuple | np.ndarray):
            if len(value) != 2:
                raise self._wrong(name, value, "a complex number, or two coordinates")
            x, y = (self._coordinate(name, item, unit, most) for item in value)
            return complex(x, y)
        else:
            return complex(self._coordinate(name, value, unit, most))
        self._coordinate(name, point.real, unit, most)
        self._coordinate(name, point.imag, unit, most)
        return point

    def _coordinate(self, name: str, value: object, unit: str, most: float) -> float:
        return self.length(name, value, most=most) if unit == "m" else self.number(name, value, unit, most=most)

    def near_point(self, name: str, value: object) -> complex:
        """A point with coordinates of at most LONGEST [m]."""
        return self.point(name, value, most=LONGEST)

    def points(self, name: str, value: object, *, most: float = GREATEST) -> ComplexArray:
        """Planar points [m], shape (points,): of complex numbers, of pairs of coordinates, or of an array of N x 2."""
        if isinstance(value, str | Mapping) or not isinstance(value, Iterable):
            raise self._wrong(name, value, _POINTS)
        rows = value if isinstance(value, Sequence | np.ndarray) else np.asarray(value)
        if isinstance(rows, np.ndarray) and (rows.ndim not in {1, 2} or (rows.ndim == 2 and rows.shape[1] != 2)):
            raise self._wrong(name, rows, _POINTS, "transpose it" if rows.ndim == 2 and rows.shape[0] == 2 else "")
        return np.array([self.point(f"point {i} of {name}", row, most=most) for i, row in enumerate(rows, 1)], complex)

    def vectors(self, name: str, value: object, unit: str) -> ComplexField:
        """A vector, or one per sample [SI]: an array of complex numbers, or of N x 2 coordinates.

        Two numbers in a tuple or a list are the coordinates of one vector; an array of one dimension is one per sample.
        """
        if not (isinstance(value, np.ndarray) and value.ndim):
            return self.point(name, value, unit=unit)
        if value.ndim > 2 or value.dtype.kind not in _REAL + "c" or (value.ndim == 2 and value.shape[1] != 2):
            raise self._wrong(name, value, "a vector per sample: complex numbers, or N x 2 coordinates")
        return (value[:, 0] + 1j * value[:, 1]) if value.ndim == 2 else value

    # names, records, files

    def text(self, name: str, value: object) -> str:
        """A text."""
        if not isinstance(value, str):
            raise self._wrong(name, value, "a text")
        return str(value)

    def one_of(self, name: str, value: object, known: Iterable[str]) -> str:
        """One of the known texts."""
        choices = list(known)
        if not isinstance(value, str) or value not in choices:
            do = did_you_mean(value, choices) if isinstance(value, str) else ""
            raise self._wrong(name, value, f"one of {', '.join(choices) or 'none'}", do)
        return value

    def flag(self, name: str, value: object) -> bool:
        """True or False."""
        if not isinstance(value, bool | np.bool_):
            raise self._wrong(name, value, "True or False")
        return bool(value)

    def path(self, name: str, value: object) -> Path:
        """A path."""
        if not isinstance(value, str | os.PathLike) or "\0" in str(value):
            raise self._wrong(name, value, "a path")
        return Path(value)

    def record(self, name: str, value: object, kind: Any) -> Any:
        """An object of a class, or of one of several."""
        if not isinstance(value, kind):
            raise self._wrong(name, value, class_names(kind))
        return value

    def sequence(self, name: str, value: object, kind: Any) -> tuple[Any, ...]:
        """A sequence of objects of a class."""
        if isinstance(value, str | bytes | Mapping) or not isinstance(value, Iterable):
            do = f"write [{name}] for one" if isinstance(value, kind) else ""
            raise self._wrong(name, value, f"a sequence of {class_names(kind)}", do)
        return tuple(self.record(f"entry {i} of {name}", item, kind) for i, item in enumerate(value, 1))

    def pair(self, name: str, value: object, of: str) -> tuple[Any, Any]:
        """Two values in a tuple, a list or an array; of: what they are, for the message."""
        if not isinstance(value, tuple | list | np.ndarray) or (isinstance(value, np.ndarray) and value.ndim != 1):
            raise self._wrong(name, value, of)
        if len(value) != 2:
            raise self._wrong(name, value, of)
        return value[0], value[1]

    def mapping(self, name: str, value: object, read: Callable[[str, Any], T]) -> dict[str, T]:
        """A mapping by name, with each value read by a function of its name and itself."""
        if not isinstance(value, Mapping):
            raise self._wrong(name, value, "a mapping by name")
        return {self.text(f"a key of {name}", key): read(f"{name}[{key!r}]", item) for key, item in value.items()}

    def function(self, name: str, value: object, of: str) -> Callable[..., Any]:
        """A function."""
        if not callable(value):
            raise self._wrong(name, value, f"a function of {of}")
        return value


_POINTS = "complex numbers, pairs of coordinates, or an array of N x 2"


def class_names(kind: type | tuple[type, ...]) -> str:
    """The names of classes in words."""
    return " or ".join(one.__name__ for one in (kind if isinstance(kind, tuple) else (kind,)))


def _as_float(value: numbers.Real) -> float:
    """The nearest float; infinity for a whole number beyond all floats."""
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _allowed(unit: str) -> str:
    if not unit:
        return "a number"
    usual = _USUAL.get(unit, unit)
    return f"a number in {unit}, or a text with its unit, like '40{usual.removeprefix('1')}'"


def _within(most: float, unit: str) -> str:
    shown = format_number(most / parse_unit(unit).factor)
    return f"at most {shown} {unit}".rstrip()
