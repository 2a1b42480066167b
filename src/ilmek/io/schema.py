"""Data held against a schema: the first value that does not fit is named by its key and its line.

A schema is plain data in the words of JSON Schema. Those known here: type, properties, required, additionalProperties,
items, minItems, maxItems, enum, oneOf (told apart by their first required key), $ref within the schema. One word is
ours, and other readers pass it over: `unit`, for a quantity, which may be a number in SI or a text with its unit.
"""

import difflib
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, NoReturn, TypeAlias

from ilmek.errors import IlmekError, MechanismError, UnitError
from ilmek.io.line_numbers import Path, Places
from ilmek.units import parse_quantity

Schema: TypeAlias = Mapping[str, Any]

_NAMES = {"object": "a table", "array": "a list", "string": "text in quotes", "number": "a number"}


@dataclass(frozen=True, slots=True)
class SourceText:
    """Where data come from: what a person calls them, and the line of each key."""

    name: str
    places: Places

    def refuse(self, path: Path, error: IlmekError) -> NoReturn:
        """Raise the error once more, with the line and the key before its words; the nearest key that has a line."""
        while path and path not in self.places:
            path = path[:-1]
        key = ".".join(str(key) for key in path)
        said = f"{self.name}, line {self.places[path]}{f', {key}' if key else ''}: {error.given}"
        raise MechanismError(said, allowed=error.allowed, do=error.do) from None


@dataclass(frozen=True, slots=True)
class Reader:
    """Data read by a schema."""

    schema: Schema
    sheet: SourceText

    def read(self, data: Any) -> Any:
        """The data with every quantity as an SI number. Raises MechanismError at the first value that does not fit."""
        return self._value(data, self.schema, ())

    def _value(self, value: Any, schema: Schema, path: Path) -> Any:
        schema = self._resolved(value, schema, path)
        if "enum" in schema:
            return self._one_of(value, schema["enum"], path)
        if "unit" in schema:
            return self._quantity(value, schema["unit"], path)
        kind: str = schema["type"]
        wanted: Any = {"object": dict, "array": list, "string": str}[kind]
        if not isinstance(value, wanted):
            self._refuse(path, f"{_shown(value)} is not {_NAMES[kind]}", schema.get("description", ""))
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
                self._refuse(path, f"{_shown(value)} is not a table")
            picked = next((one for key, one in choices.items() if key in value), None)
            if picked is None:
                self._refuse(path, f"says none of {', '.join(choices)}", "one of them tells what it is")
            return dict(picked)
        return schema

    def _table(self, table: Mapping[str, Any], schema: Schema, path: Path) -> dict[str, Any]:
        known, others = schema.get("properties", {}), schema.get("additionalProperties", False)
        for key in schema.get("required", ()):
            if key not in table:
                self._refuse(path, f"has no {key!r}", f"it needs {', '.join(schema['required'])}")
        for key in table:
            if key not in known and others is False:
                near = difflib.get_close_matches(key, known, n=1)
                hint = f"did you mean {near[0]!r}?" if near else ""
                self._refuse((*path, key), f"unknown key {key!r}", f"keys: {', '.join(known)}", hint)
        return {key: self._value(value, known.get(key, others), (*path, key)) for key, value in table.items()}

    def _list(self, entries: list[Any], schema: Schema, path: Path) -> list[Any]:
        count = schema["minItems"]
        if len(entries) != count:
            self._refuse(path, f"has {len(entries)} entries", f"it is {count}: {schema['description']}")
        return [self._value(entry, schema["items"], (*path, place)) for place, entry in enumerate(entries)]

    def _one_of(self, value: Any, choices: Iterable[Any], path: Path) -> Any:
        if isinstance(value, bool) or value not in choices or not isinstance(value, int):
            self._refuse(path, f"is {_shown(value)}", f"allowed: {', '.join(str(choice) for choice in choices)}")
        return value

    def _quantity(self, value: Any, unit: str, path: Path) -> float:
        if isinstance(value, str):
            try:
                return parse_quantity(value, unit)
            except UnitError as error:
                self.sheet.refuse(path, error)
        if isinstance(value, bool) or not isinstance(value, int | float):
            self._refuse(path, f"{_shown(value)} is not a quantity", f"a number in {unit}, or text with its unit")
        if (isinstance(value, int) and abs(value) > 10**300) or not math.isfinite(value):
            self._refuse(path, f"{_shown(value)} is not a finite number", f"a number in {unit}")
        return float(value)

    def _refuse(self, path: Path, given: str, allowed: str = "", do: str = "") -> NoReturn:
        self.sheet.refuse(path, MechanismError(given, allowed=allowed, do=do))


def _shown(value: Any) -> str:
    """The value, shortened for a message."""
    said = (
        {True: "true", False: "false", None: "null"}.get(value, "") if isinstance(value, bool | None) else repr(value)
    )
    return said if len(said) <= 40 else f"{said[:37]}..."
