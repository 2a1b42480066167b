"""Validation of data by a schema; an error names the key and the line of the first invalid value.

A schema is data in the vocabulary of JSON Schema. Supported: type, properties, required, additionalProperties, items,
minItems, maxItems, minimum, maximum, enum, oneOf (tables are distinguished by their first required key, other values by
their type), $ref within the schema. Two keywords are added, which other validators ignore: `unit`, for a quantity, and
`units`, for a quantity of one of several dimensions.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple, NoReturn, TypeAlias

from ilmek.errors import IlmekError, MechanismError, ParameterError, did_you_mean, shortened
from ilmek.io.line_numbers import KeyLines, Path
from ilmek.records import record
from ilmek.sentences import location, with_location
from ilmek.units import GREATEST, parse_quantity, read_number, real_number

Schema: TypeAlias = Mapping[str, Any]

Table: TypeAlias = Mapping[str, Any]
"""A table of a file that has passed its schema, which says the keys and the kinds of their values."""

_NAMES = {"object": "a table", "array": "a list", "string": "text in quotes", "boolean": "true or false"}
_TYPES: Mapping[str, type] = {"object": dict, "array": list, "string": str, "boolean": bool}


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


@record
class Reader:
    """Reads data by a schema."""

    schema: Schema
    source: SourceText
    quantity: QuantityReader

    def read(self, data: object) -> Any:
        """The data with every quantity as an SI number, or `Measured`. Raises MechanismError for the first error."""
        return self._value(data, self.schema, ())

    def _value(self, value: object, schema: Schema, path: Path) -> Any:
        schema = self._resolved(value, schema, path)
        if "enum" in schema:
            return self._one_of(value, schema["enum"], path)
        if "unit" in schema:
            return self._quantity(value, (schema["unit"],), path).value
        if "units" in schema:
            return self._quantity(value, schema["units"], path)
        kind: str = schema["type"]
        if kind == "integer":
            return self._whole(value, schema, path)
        if not isinstance(value, _TYPES[kind]):
            description = schema.get("description", "") if path else ""
            self._refuse(path, f"{shown(value)} is not {_NAMES[kind]}", description)
        given: Any = value
        if kind == "object":
            return self._table(given, schema, path)
        return self._list(given, schema, path) if kind == "array" else given

    def _resolved(self, value: object, schema: Schema, path: Path) -> Schema:
        """The schema itself, for a reference or a choice."""
        if "$ref" in schema:
            found: Any = self.schema
            for key in schema["$ref"].removeprefix("#/").split("/"):
                found = found[key]
            return self._resolved(value, {**found, **{k: v for k, v in schema.items() if k != "$ref"}}, path)
        if "oneOf" in schema:
            return self._resolved(value, self._chosen(value, schema, path), path)
        return schema

    def _chosen(self, value: object, schema: Schema, path: Path) -> Schema:
        """The choice of a `oneOf` that fits the value's type, and of tables the one whose first key is given."""
        found = [self._resolved(None, one, path) if "$ref" in one else one for one in schema["oneOf"]]
        tables = [one for one in found if one.get("type") == "object"]
        plain = [one for one in found if one.get("type") != "object"]
        if isinstance(value, dict) and tables:
            keys = {table["required"][0]: table for table in tables}
            picked = next((one for key, one in keys.items() if key in value), None)
            if picked is None:
                near = next((hint for key in value if (hint := did_you_mean(str(key), keys))), "")
                self._refuse(path, f"has none of {', '.join(keys)}", "one of them is required", near)
            return picked
        is_list = isinstance(value, list)
        fitting = next((one for one in plain if (one.get("type") == "array") == is_list), None)
        if fitting is None or isinstance(value, dict):
            allowed = schema.get("description", "") if plain else ""
            self._refuse(path, f"{shown(value)} is not {'a table' if not plain else 'allowed here'}", allowed)
        return fitting

    def _table(self, table: Mapping[str, object], schema: Schema, path: Path) -> dict[str, Any]:
        known, others = schema.get("properties", {}), schema.get("additionalProperties", False)
        allowed = known if others is False else table
        for key, error in key_faults(table, allowed, needs=schema.get("required", ())):
            self.source.refuse((*path, key) if key else path, error)
        return {key: self._value(value, known.get(key, others), (*path, key)) for key, value in table.items()}

    def _list(self, entries: list[Any], schema: Schema, path: Path) -> list[Any]:
        least, most = schema["minItems"], schema["maxItems"]
        if not least <= len(entries) <= most:
            count = str(least) if least == most else f"{least} to {most}"
            noun = "entry" if len(entries) == 1 else "entries"
            self._refuse(path, f"has {len(entries)} {noun}", f"{count}: {schema['description']}")
        return [self._value(entry, schema["items"], (*path, index)) for index, entry in enumerate(entries)]

    def _one_of(self, value: Any, choices: Sequence[Any], path: Path) -> Any:
        if type(value) is not type(choices[0]) or value not in choices:
            near = did_you_mean(value, choices) if isinstance(value, str) and isinstance(choices[0], str) else ""
            self._refuse(path, f"is {shown(value)}", f"allowed: {', '.join(str(choice) for choice in choices)}", near)
        return value

    def _whole(self, value: object, schema: Schema, path: Path) -> int:
        least, most = schema["minimum"], schema["maximum"]
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
            self._refuse(path, f"{shown(value)} is not a whole number from {least} to {most}")
        return value

    def _quantity(self, value: object, units: Sequence[str], path: Path) -> Measured:
        try:
            return self.quantity(value, units)
        except IlmekError as error:
            self.source.refuse(path, error)

    def _refuse(self, path: Path, given: str, allowed: str = "", do: str = "") -> NoReturn:
        self.source.refuse(path, MechanismError(given, allowed=allowed, do=do))


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
