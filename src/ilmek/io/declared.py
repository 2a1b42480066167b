"""Entries of a data file, declared once: the JSON Schema, the reader and the writer follow from the declaration.

    SECTION = TableEntry("a flat bar", {"width": quantity("m", "in the plane"), "material": TextEntry("of the table")})

An error names the key and the line of the first invalid value. Three keywords are added to JSON Schema, which other
validators ignore: `unit` of a quantity, `units` of a quantity of one of several dimensions, and `refers` of a text, or
of the names of a table, that is the name of another entry.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import field
from types import MappingProxyType
from typing import Any, NoReturn

from ilmek.errors import IlmekError, MechanismError, did_you_mean
from ilmek.io.line_numbers import Path
from ilmek.io.schema import Measured, QuantityReader, SourceText, key_faults, shown
from ilmek.io.toml_text import written_quantity
from ilmek.records import JsonObject, record
from ilmek.report import Json

_WRITTEN = {"m": "mm", "rad": "deg", "m/rad": "mm/rad", "Pa": "MPa", "Pa*m/s": "MPa*m/s"}
"""SI unit -> the unit in which a quantity is written, where that is another."""


@record
class EntryReader:
    """What entries are read with: the source, for messages, and the reader of quantities."""

    source: SourceText
    quantity: QuantityReader

    def refuse(self, path: Path, given: str, allowed: str = "", do: str = "") -> NoReturn:
        """Raise MechanismError with the line and the key."""
        self.source.refuse(path, MechanismError(given, allowed=allowed, do=do))


@record
class DeclaredEntry(ABC):
    """An entry of a file.

    doc   meaning, a phrase
    name  of its definition in the schema, to which each use refers; "": it is written where it is used
    """

    doc: str
    name: str = field(default="", kw_only=True)

    def schema(self, definitions: JsonObject) -> JsonObject:
        """The JSON Schema of the entry; the definitions that it refers to are added to `definitions`."""
        if not self.name:
            form = self._form(definitions)
        else:
            if self.name not in definitions:
                definitions[self.name] = self._form(definitions)
            form = {"$ref": f"#/$defs/{self.name}"}
        return {**form, "description": self.doc} if self.doc else form

    @abstractmethod
    def _form(self, definitions: JsonObject) -> JsonObject:
        """The schema without the meaning."""

    @abstractmethod
    def read(self, value: Any, reader: EntryReader, path: Path = ()) -> Any:
        """The value, every quantity as an SI number, or `Measured`. Raises MechanismError for the first error."""

    def write(self, value: Any, *, si: bool) -> Json:
        """What is read as the same value: quantities as numbers in SI, or as texts with their unit."""
        del si
        return value  # type: ignore[no-any-return]

    def _kind(self, value: object, kind: type, noun: str, reader: EntryReader, path: Path) -> None:
        if not isinstance(value, kind):
            reader.refuse(path, f"{shown(value)} is not {noun}", self.doc if path else "")


@record
class QuantityEntry(DeclaredEntry):
    """A quantity: of one dimension an SI number, of one of several `Measured`.

    units    a unit of each dimension; "1" for a plain number; (): of any dimension
    least, most, above  bounds in SI, the last one excluded      written  unit in which it is written; "": the usual
    """

    units: tuple[str, ...]
    least: float | None = field(default=None, kw_only=True)
    most: float | None = field(default=None, kw_only=True)
    above: float | None = field(default=None, kw_only=True)
    written: str = field(default="", kw_only=True)

    def _form(self, _: JsonObject) -> JsonObject:
        units = {"units": list(self.units)} if len(self.units) > 1 else {"unit": self.units[0]} if self.units else {}
        bounds = {"minimum": self.least, "maximum": self.most, "exclusiveMinimum": self.above}
        return {"type": ["number", "string"], **units, **{key: one for key, one in bounds.items() if one is not None}}

    def read(self, value: Any, reader: EntryReader, path: Path = ()) -> Any:
        """The SI number, or `Measured`."""
        try:
            measured = reader.quantity(value, self.units)
        except IlmekError as error:
            reader.source.refuse(path, error)
        number = measured.value
        if not self._allows(number):
            unit = "" if measured.unit in ("", "1") else f" {measured.unit}"
            do = "" if self.most is None else "check its unit"
            reader.refuse(path, f"is {number:g}{unit}", self._bounds(), do)
        return measured if len(self.units) > 1 else number

    def _allows(self, number: float) -> bool:
        return (
            (self.least is None or number >= self.least)
            and (self.most is None or number <= self.most)
            and (self.above is None or number > self.above)
        )

    def _bounds(self) -> str:
        if self.above is not None:
            return f"above {self.above:g}"
        return f"{self.least:g} or more" if self.most is None else f"{self.least:g} to {self.most:g}"

    def write(self, value: Any, *, si: bool) -> Json:
        """With its unit where `si` is false; 0 without."""
        measured, unit = value if isinstance(value, Measured) else (value, self.units[0])
        number = float(measured)
        if si or number == 0 or unit == "1":
            return number
        text = written_quantity(number, self.written or _WRITTEN.get(unit, unit))
        return text if isinstance(text, str) else f"{number!r}{unit}"


def quantity(units: str | tuple[str, ...], doc: str = "", **more: Any) -> QuantityEntry:
    """A quantity in a unit, or in one of several; bounds and unit of writing as of `QuantityEntry`."""
    return QuantityEntry(doc, (units,) if isinstance(units, str) else units, **more)


@record
class TextEntry(DeclaredEntry):
    """A text; `refers`: what it is the name of, "": of nothing in the file."""

    refers: str = ""

    def _form(self, _: JsonObject) -> JsonObject:
        return {"type": "string", **({"refers": self.refers} if self.refers else {})}

    def read(self, value: Any, reader: EntryReader, path: Path = ()) -> str:
        """The text."""
        self._kind(value, str, "text in quotes", reader, path)
        return value  # type: ignore[no-any-return]


@record
class FlagEntry(DeclaredEntry):
    """True or false."""

    def _form(self, _: JsonObject) -> JsonObject:
        return {"type": "boolean"}

    def read(self, value: Any, reader: EntryReader, path: Path = ()) -> bool:
        """The flag."""
        self._kind(value, bool, "true or false", reader, path)
        return value  # type: ignore[no-any-return]


@record
class WholeEntry(DeclaredEntry):
    """A whole number within bounds."""

    least: int
    most: int

    def _form(self, _: JsonObject) -> JsonObject:
        return {"type": "integer", "minimum": self.least, "maximum": self.most}

    def read(self, value: Any, reader: EntryReader, path: Path = ()) -> int:
        """The number."""
        if isinstance(value, bool) or not isinstance(value, int) or not self.least <= value <= self.most:
            reader.refuse(path, f"{shown(value)} is not a whole number from {self.least} to {self.most}")
        return value


@record
class ChoiceEntry(DeclaredEntry):
    """One of some texts or numbers."""

    choices: tuple[str, ...] | tuple[int, ...]

    def _form(self, _: JsonObject) -> JsonObject:
        return {"enum": list(self.choices)}

    def read(self, value: Any, reader: EntryReader, path: Path = ()) -> str | int:
        """The choice."""
        kind = type(self.choices[0])
        if type(value) is not kind or value not in self.choices:
            near = did_you_mean(value, [str(choice) for choice in self.choices]) if kind is str is type(value) else ""
            allowed = f"allowed: {', '.join(str(choice) for choice in self.choices)}"
            reader.refuse(path, f"is {shown(value)}", allowed, near)
        return value


@record
class ListEntry(DeclaredEntry):
    """A list of some entries; `refers`: what its texts are the name of together, like a body and its point."""

    items: DeclaredEntry
    least: int
    most: int
    refers: str = ""

    def _form(self, definitions: JsonObject) -> JsonObject:
        items = self.items.schema(definitions)
        form = {"type": "array", "items": items, "minItems": self.least, "maxItems": self.most}
        return {**form, **({"refers": self.refers} if self.refers else {})}

    def read(self, value: Any, reader: EntryReader, path: Path = ()) -> list[Any]:
        """All entries."""
        self._kind(value, list, "a list", reader, path)
        if not self.least <= len(value) <= self.most:
            count = str(self.least) if self.least == self.most else f"{self.least} to {self.most}"
            noun = "entry" if len(value) == 1 else "entries"
            reader.refuse(path, f"has {len(value)} {noun}", f"{count}: {self.doc}")
        return [self.items.read(entry, reader, (*path, index)) for index, entry in enumerate(value)]

    def write(self, value: Any, *, si: bool) -> Json:
        """All entries."""
        return [self.items.write(entry, si=si) for entry in value]


@record
class TableEntry(DeclaredEntry):
    """A table; its first required key tells it from the other tables of a `VariantEntry`.

    required, optional  key -> entry      others  entry of every other key; None: there are none
    refers  what the other keys are the names of      most  number of keys
    """

    required: Mapping[str, DeclaredEntry] = field(default_factory=dict)
    optional: Mapping[str, DeclaredEntry] = field(default_factory=dict)
    others: DeclaredEntry | None = None
    refers: str = field(default="", kw_only=True)
    most: int | None = field(default=None, kw_only=True)

    @property
    def entries(self) -> dict[str, DeclaredEntry]:
        """All keys that have a name of their own."""
        return {**self.required, **self.optional}

    def entry(self, key: str) -> DeclaredEntry:
        """The entry of a key. Raises KeyError for one that the table does not have."""
        return self.entries[key] if self.others is None else self.entries.get(key, self.others)

    def _form(self, definitions: JsonObject) -> JsonObject:
        further = {
            "required": list(self.required),
            "properties": {key: entry.schema(definitions) for key, entry in self.entries.items()},
            "propertyNames": {"refers": self.refers} if self.refers else {},
            "maxProperties": self.most,
        }
        others = False if self.others is None else self.others.schema(definitions)
        return {"type": "object", **{key: one for key, one in further.items() if one}, "additionalProperties": others}

    def read(self, value: Any, reader: EntryReader, path: Path = ()) -> JsonObject:
        """All keys, in the order of the file."""
        self._kind(value, dict, "a table", reader, path)
        for key, error in key_faults(value, self.entries if self.others is None else value, needs=self.required):
            reader.source.refuse((*path, key) if key else path, error)
        if self.most is not None and len(value) > self.most:
            reader.refuse(path, f"has {len(value)} {path[-1]}", f"at most {self.most}")
        return {key: self.entry(key).read(one, reader, (*path, key)) for key, one in value.items()}

    def given(self, record: object) -> JsonObject:
        """The fields of a record that are keys of the table; those that are None are left out."""
        fields = {key: getattr(record, key, None) for key in self.entries}
        return {key: value for key, value in fields.items() if value is not None}

    def write(self, value: Any, *, si: bool) -> dict[str, Json]:
        """All keys, in their order."""
        return {key: self.entry(key).write(one, si=si) for key, one in value.items()}


def keys(
    required: Mapping[str, DeclaredEntry], optional: Mapping[str, DeclaredEntry] = MappingProxyType({}), **more: Any
) -> TableEntry:
    """A table of required and optional keys; meaning and name as of `TableEntry`."""
    return TableEntry(more.pop("doc", ""), required, optional, **more)


def names(entry: DeclaredEntry, doc: str, *, refers: str = "", most: int | None = None) -> TableEntry:
    """A table of names and an entry of each."""
    return TableEntry(doc, others=entry, refers=refers, most=most)


@record
class VariantEntry(DeclaredEntry):
    """One of several entries, by the kind of the value; of tables the one whose first required key is given."""

    options: tuple[DeclaredEntry, ...]

    def _form(self, definitions: JsonObject) -> JsonObject:
        titles = {id(entry): f"{self.name} {key}".strip() for key, entry in self._tables().items()}
        options = [(option.schema(definitions), titles.get(id(option))) for option in self.options]
        return {"oneOf": [{**form, "title": title} if title else form for form, title in options]}

    def table(self, value: Mapping[str, object]) -> TableEntry:
        """The table that fits a value. Raises TypeError where there is none."""
        option = self.option(value)
        if not isinstance(option, TableEntry):
            raise TypeError(f"{value!r} is no {self.name or self.doc}")
        return option

    def option(self, value: Any) -> DeclaredEntry | None:
        """The option that fits a value; None: there is none."""
        if isinstance(value, dict):
            return next((table for key, table in self._tables().items() if key in value), None)
        is_list = isinstance(value, list | tuple)
        plain = (option for option in self.options if not isinstance(option, TableEntry))
        return next((option for option in plain if isinstance(option, ListEntry) == is_list), None)

    def _tables(self) -> dict[str, TableEntry]:
        return {next(iter(table.required)): table for table in self.options if isinstance(table, TableEntry)}

    def read(self, value: Any, reader: EntryReader, path: Path = ()) -> Any:
        """As the option that fits reads it."""
        option, tables = self.option(value), self._tables()
        if option is not None:
            return option.read(value, reader, path)
        plain = len(tables) < len(self.options)
        if isinstance(value, dict) and tables:
            given, allowed = f"has none of {', '.join(tables)}", "one of them is required"
            near = next((hint for key in value if (hint := did_you_mean(str(key), tables))), "")
        else:
            given, allowed = (
                f"{shown(value)} is not {'allowed here' if plain else 'a table'}",
                self.doc if plain else "",
            )
            near = ""
        return reader.refuse(path, given, allowed, near)

    def write(self, value: Any, *, si: bool) -> Json:
        """As the option that fits writes it; TypeError where there is none."""
        option = self.option(value)
        if option is None:
            raise TypeError(f"{value!r} is no {self.name or self.doc}")
        return option.write(value, si=si)


def variant(*options: DeclaredEntry, doc: str = "", name: str = "") -> VariantEntry:
    """One of several entries."""
    return VariantEntry(doc, options, name=name)
