"""Sources of data: what a value of a file is called in a message, and its quantities and keys."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple, NoReturn, TypeAlias

from ilmek.errors import IlmekError, MechanismError, ParameterError, did_you_mean, shortened
from ilmek.io.line_numbers import KeyLines, Path
from ilmek.records import record
from ilmek.sentences import location, with_location
from ilmek.units import GREATEST, parse_quantity, read_number, real_number

Table: TypeAlias = Mapping[str, Any]
"""A table of a file that has passed its declaration, which says the keys and the kinds of their values."""


class Measured(NamedTuple):
    """A quantity of one of several dimensions: its SI value, and the unit of its dimension; 0 may be of any, ""."""

    value: float
    unit: str


QuantityReader: TypeAlias = Callable[[Any, Sequence[str]], Measured]
"""A number or text, and units of the allowed dimensions -> the quantity. Raises IlmekError for anything else."""


class LocatedError(MechanismError):
    """An error whose message begins with the file and the line; `path`: the keys of the entry that it concerns."""

    path: Path = ()


@record
class SourceText:
    """The source of data: its name in messages, and the line of each key; without lines, data that are no text."""

    name: str
    lines: KeyLines

    def refuse(self, path: Path, error: IlmekError) -> NoReturn:
        """Raise the error again, preceded by the line and the key; a key without a line takes that of its table."""
        while self.lines and path and path not in self.lines:
            path = path[:-1]
        key = ".".join(str(key) for key in path)
        given = with_location(location(self.name, self.lines[path] if self.lines else 0, key), error.given)
        located = LocatedError(given, allowed=error.allowed, do=error.do)
        located.path = path
        raise located from None

    @contextmanager
    def located(self, *path: str | int) -> Iterator[None]:
        """Add the line of the entry that an error concerns, or of `path`, to errors raised inside that have none."""
        try:
            yield
        except LocatedError:
            raise
        except IlmekError as error:
            self.refuse(getattr(error, "about", ()) or path, error)


def key_faults(
    table: Mapping[str, object], known: Iterable[str], *, needs: Iterable[str] = (), noun: str = "key"
) -> Iterator[tuple[str, IlmekError]]:
    """Errors of the keys of a table: missing keys, with "", and unknown ones.

    known  allowed keys, in the order of the message
    needs  required keys
    noun   name of a key in messages
    """
    known, needs = tuple(known), tuple(needs)
    for key in needs:
        if key not in table:
            yield "", ParameterError(f"has no {key!r}", allowed=f"it needs {', '.join(needs)}")
    for key in table:
        if key not in known:
            allowed = f"{noun}s: {', '.join(known)}"
            yield key, ParameterError(f"unknown {noun} {key!r}", allowed=allowed, do=did_you_mean(str(key), known))


def read_quantity(value: object, unit: str) -> float:
    """A number in SI, or a text with its unit, as a number in SI.

    unit  a unit of the same dimension; "" or "1" for a plain number
    Raises UnitError for a text that is no such quantity, ParameterError for another value that is no finite number.
    """
    if isinstance(value, str):
        return parse_quantity(value, unit)
    plain = unit in ("", "1")
    if isinstance(value, bool) or not isinstance(value, int | float):
        allowed = "a plain number" if plain else f"a number in {unit}, or text with its unit"
        raise ParameterError(f"{shown(value)} is not a quantity", allowed=allowed)
    number = finite_number(value)
    if number is None:
        allowed = f"{'a plain number' if plain else f'a number in {unit}'} of at most {GREATEST:g}"
        raise ParameterError(f"{shown(value)} is not a finite number", allowed=allowed)
    return number


def finite_number(value: object) -> float | None:
    """A number, or a text that is one, as a float within the bounds of `ilmek.units`; None for everything else.

    >>> finite_number(2), finite_number(" 2.5"), finite_number("two"), finite_number(True), finite_number(1e999)
    (2.0, 2.5, None, None, None)
    """
    return read_number(value) if isinstance(value, str) else real_number(value)


def shown(value: object) -> str:
    """The value, shortened for a message."""
    text = (
        {True: "true", False: "false", None: "null"}.get(value, "") if isinstance(value, bool | None) else repr(value)
    )
    return shortened(text)
