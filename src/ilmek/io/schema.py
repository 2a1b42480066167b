"""Validation of data by a schema; an error names the key and the line of the first invalid value.

A schema is data in the vocabulary of JSON Schema. Supported: type, properties, required, additionalProperties, items,
minItems, maxItems, enum, oneOf (distinguished by the first required key), $ref within the schema. One keyword is added,
which other validators ignore: `unit`, for a quantity, given as a number in SI or a text with its unit.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NoReturn, TypeAlias

from ilmek.errors import IlmekError, MechanismError, ParameterError, did_you_mean, shortened
from ilmek.io.line_numbers import KeyLines, Path
from ilmek.records import record
from ilmek.units import GREATEST, in_bounds, parse_quantity, read_number

Schema: TypeAlias = Mapping[str, Any]

_NAMES = {"object": "a table", "array": "a list", "string": "text in quotes", "number": "a number"}


@record
class SourceText:
    """The source of data: its name in messages, and the line of each key."""

    name: str
    lines: KeyLines

    def refuse(self, path: Path, error: IlmekError) -> NoReturn:
        """Raise the error again, preceded by the line and the key; a key without a line takes that of its table."""
        while path and path not in self.lines:
            path = path[:-1]
        key = ".".join(str(key) for key in path)
        given = f"{self.name}, line {self.lines[path]}{f', {key}' if key else ''}: {error.given}"
        raise MechanismError(given, allowed=error.allowed, do=error.do) from None


@record
class Reader:
    """Reads data by a schema."""

    schema: Schema
    source: SourceText

    def read(self, data: Any) -> Any:
        """The data with every quantity as an SI number. Raises MechanismError for the first invalid value."""
        return self._value(data, self.schema, ())

    def _value(self, value: Any, schema: Schema, path: Path) -> Any:
        schema = self._resolved(value, schema, path)
        if "enum" in schema:
            return self._one_of(value, schema["enum"], path)
        if "unit" in schema:
            return self._quantity(value, schema["unit"], path)
        kind: str = schema["type"]
        expected: Any = {"object": dict, "array": list, "string": str}[kind]
        if not isinstance(value, expected):
            self._refuse(path, f"{shown(value)} is not {_NAMES[kind]}", schema.get("description", ""))
        if kind == "object":
            return self._table(value, schema, path)
        return self._list(value, schema, path) if kind == "array" else value

    def _resolved(self, value: Any, schema: Schema, path: Path) -> Schema:
        """The schema itself, for a reference or a choice."""
        if "$ref" in schema:
            found: Any = self.schema
            for key in schema["$ref"].removeprefix("#/").split("/"):
                found = found[key]
            return self._resolved(value, {**found, **{k: v for k, v in schema.items() if k != "$ref"}}, path)
        if "oneOf" in schema:
            choices = {one["required"][0]: one for one in schema["oneOf"]}
            if not isinstance(value, dict):
                self._refuse(path, f"{shown(value)} is not a table")
            picked = next((one for key, one in choices.items() if key in value), None)
            if picked is None:
                self._refuse(path, f"has none of {', '.join(choices)}", "one of them is required")
            return dict(picked)
        return schema

    def _table(self, table: Mapping[str, Any], schema: Schema, path: Path) -> dict[str, Any]:
        known, others = schema.get("properties", {}), schema.get("additionalProperties", False)
        allowed = known if others is False else table
        for key, error in key_faults(table, allowed, needs=schema.get("required", ())):
            self.source.refuse((*path, key) if key else path, error)
        return {key: self._value(value, known.get(key, others), (*path, key)) for key, value in table.items()}

    def _list(self, entries: list[Any], schema: Schema, path: Path) -> list[Any]:
        count = schema["minItems"]
        if len(entries) != count:
            self._refuse(path, f"has {len(entries)} entries", f"{count}: {schema['description']}")
        return [self._value(entry, schema["items"], (*path, index)) for index, entry in enumerate(entries)]

    def _one_of(self, value: Any, choices: Iterable[Any], path: Path) -> Any:
        if isinstance(value, bool) or value not in choices or not isinstance(value, int):
            self._refuse(path, f"is {shown(value)}", f"allowed: {', '.join(str(choice) for choice in choices)}")
        return value

    def _quantity(self, value: Any, unit: str, path: Path) -> float:
        try:
            return read_quantity(value, unit)
        except IlmekError as error:
            self.source.refuse(path, error)

    def _refuse(self, path: Path, given: str, allowed: str = "", do: str = "") -> NoReturn:
        self.source.refuse(path, MechanismError(given, allowed=allowed, do=do))


def key_faults(
    table: Mapping[str, Any], known: Iterable[str], *, needs: Iterable[str] = (), noun: str = "key"
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


def read_quantity(value: Any, unit: str) -> float:
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


def finite_number(value: Any) -> float | None:
    """A number, or a text that is one, as a float within the bounds of `ilmek.units`; None for everything else.

    >>> finite_number(2), finite_number(" 2.5"), finite_number("two"), finite_number(True), finite_number(1e999)
    (2.0, 2.5, None, None, None)
    """
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return None
    if isinstance(value, str):
        return read_number(value)
    return float(value) if in_bounds(value) else None


def shown(value: Any) -> str:
    """The value, shortened for a message."""
    text = (
        {True: "true", False: "false", None: "null"}.get(value, "") if isinstance(value, bool | None) else repr(value)
    )
    return shortened(text)
