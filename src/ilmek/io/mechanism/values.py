"""Named values of a mechanism file, and its quantities: every quantity with a dimension needs its unit."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

from ilmek.errors import IlmekError, ParameterError, UnitError
from ilmek.io.mechanism.expressions import (
    FUNCTIONS,
    NUMBER,
    NUMBER_HEAD,
    Amount,
    evaluate,
    is_unit,
    names_in,
    printed_dimension,
)
from ilmek.io.schema import Measured, SourceText, Table, read_quantity, shown
from ilmek.records import record
from ilmek.units import has_unit, parse_quantity, parse_unit, read_number, similar_units

MOST_VALUES = 200
"""Largest number of named values of a file."""


@record
class NamedValues:
    """Named values, and quantities that use them.

    known  name -> amount      si  whether numbers without a unit are in SI
    """

    known: Mapping[str, Amount]
    si: bool = False

    def quantity(self, value: Any, units: Sequence[str]) -> Measured:
        """A quantity of the dimension of one of the units.

        Raises UnitError for a number without its unit, for an expression that cannot be evaluated, and for another
        dimension; ParameterError for another value that is no number.
        """
        plain = [unit for unit in units if unit in ("", "1")]
        if isinstance(value, str) and has_unit(value) and not self.known.keys() & names_in(value):
            literal = _literal(value, units)
            if literal is not None:
                return literal
        number = read_number(value) if isinstance(value, str) else read_quantity(value, "1" if plain else units[0])
        if number is not None:
            if plain or self.si or number == 0:
                return Measured(number, plain[0] if plain else units[0] if len(units) == 1 else "")
            raise _no_unit(value, units[0])
        found = evaluate(value, self.known)
        for unit in units:
            if parse_unit(unit).dimension == found.dimension:
                return Measured(found.value, unit)
        given = f"{value!r} is {printed_dimension(found.dimension)}"
        wanted = " or ".join("a plain number" if unit in ("", "1") else f"a quantity in {unit}" for unit in units)
        raise UnitError(given, allowed=f"{wanted} is required")


def named_values(texts: Any, source: SourceText, *, si: bool) -> NamedValues:
    """The values of the table `values`: each may use others. Raises MechanismError with the line of the first error."""
    if not isinstance(texts, Mapping):
        source.refuse(("values",), ParameterError(f"{shown(texts)} is not a table"))
    if len(texts) > MOST_VALUES:
        given = f"has {len(texts)} values"
        source.refuse(("values",), ParameterError(given, allowed=f"at most {MOST_VALUES}"))
    known: dict[str, Amount] = {}
    for name in texts:
        _add(name, texts, source, known)
    return NamedValues(known, si)


def _add(first: str, texts: Table, source: SourceText, known: dict[str, Amount]) -> None:
    """Evaluate a value after those that it uses."""
    waiting = [first]
    while waiting:
        name = waiting[-1]
        if name in known:
            waiting.pop()
            continue
        try:
            _check_name(name)
            value = texts[name]
            needed = names_in(value) if isinstance(value, str) else set()
            later = [other for other in texts if other in needed and other not in known]
            circle = next((other for other in later if other in waiting), None)
            if circle is not None:
                names = " -> ".join([*waiting[waiting.index(circle) :], circle])
                raise UnitError(f"the values {names} depend on one another")
            if not later:
                known[waiting.pop()] = _evaluated(value, known)
        except IlmekError as error:
            source.refuse(("values", name), error)
        waiting += later[:1]


def _evaluated(value: Any, known: Mapping[str, Amount]) -> Amount:
    if isinstance(value, str):
        return evaluate(value, known)
    return Amount(read_quantity(value, "1"), NUMBER)


def _literal(text: str, units: Sequence[str]) -> Measured | None:
    """A number with a unit; None for an expression. Raises UnitError for a unit of another dimension."""
    for unit in units:
        with suppress(UnitError):
            return Measured(parse_quantity(text, unit), unit)
    try:
        parse_unit(NUMBER_HEAD.sub("", text.strip()))
    except UnitError:
        return None
    return Measured(parse_quantity(text, units[0]), units[0])  # raises: the unit has another dimension


def _no_unit(value: object, unit: str) -> UnitError:
    text = str(value).strip()
    written = [f'"{text}{one.removeprefix("1")}"' for one in (*similar_units(unit)[:1], unit)]
    return UnitError(f"{shown(value)} has no unit", do=f"write {', or '.join(written)}")


def _check_name(name: str) -> None:
    """Raise UnitError for a name that an expression cannot use."""
    if not name.isidentifier():
        raise UnitError(f"{name!r} is not a name", allowed="letters, digits and _, the first a letter")
    if name in FUNCTIONS or name == "pi":
        raise UnitError(f"{name!r} is a function or constant", do="choose another name")
    if is_unit(name):
        raise UnitError(f"{name!r} is a unit", do=f"choose another name, like {name}1")
