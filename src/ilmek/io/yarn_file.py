"""Yarn lists in: TOML (a `[[yarn]]` table each) or CSV (a header line, a yarn a line).

    [[yarn]]
    name = "madder red"
    srgb = "#8c1f28"          # or lab = [31.5, 45.0, 27.0]: CIELAB under D65
    nm = 5.0                  # metric count of the single strand: metres a gram
    ply = 3
    price = 14.5              # a kilogram; may be left out

A CSV file has the columns name, srgb or lab ("31.5 45 27"), nm, ply, price; commas, semicolons or tabs between them.
Empty lines, and lines that begin with #, are left out.
Here only the file is read; `ilmek.carpet.yarn` judges the values.
"""

import difflib
import re
import tomllib
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path
from typing import TypeAlias

from ilmek.carpet.yarn import FIELDS, Yarn, yarns_from_records
from ilmek.errors import YarnError
from ilmek.io.csv_lines import csv_lines, decimal_points
from ilmek.io.text_file import read_text

LARGEST = 1_000_000
"""Most bytes of a yarn list; 255 yarns need far less."""

Record: TypeAlias = Mapping[str, object]

_MISSING = "check the path, or leave --yarns out for the wool list that is built in"


def read_yarns(path: Path) -> tuple[Yarn, ...]:
    """The yarns of a TOML or CSV file. Raises YarnError, naming the file and the line or yarn."""
    readers = {".toml": _toml_records, ".csv": _csv_records}
    reader = readers.get(path.suffix.lower())
    try:
        if reader is None and path.is_file():
            raise YarnError(f"ends in {path.suffix!r}", allowed="a yarn list is a .toml or .csv file")
        text = read_text(path, noun="yarn list, .toml or .csv", largest=LARGEST, error=YarnError, do=_MISSING)
        return yarns_from_records((reader or _toml_records)(text))
    except YarnError as error:
        raise YarnError(f"yarn list {path}: {error.given}", allowed=error.allowed, do=error.do) from None


def default_yarns() -> tuple[Yarn, ...]:
    """The sixteen wool yarns that come with ilmek."""
    text = resources.files("ilmek.data").joinpath("wool16.toml").read_text(encoding="utf-8")
    return yarns_from_records(_toml_records(text))


def _toml_records(text: str) -> Sequence[Record]:
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise YarnError(f"not TOML: {error}", do="mend that line") from None
    except (RecursionError, ValueError):  # brackets in brackets, or a number of thousands of digits
        raise YarnError("not a yarn list, though it may be TOML", do="write each yarn as a [[yarn]] table") from None
    strangers = [key for key in data if key != "yarn"]
    if strangers:
        raise YarnError(f"unknown entry {strangers[0]!r}", do="write each yarn as a [[yarn]] table")
    records = data.get("yarn", [])
    if not isinstance(records, list) or not all(isinstance(record, dict) for record in records):
        raise YarnError("'yarn' is not a list of tables", do="write each yarn as a [[yarn]] table")
    return records


def _check_columns(names: Sequence[str], line: int) -> None:
    for place, name in enumerate(names):
        if name not in FIELDS:
            near = difflib.get_close_matches(name, FIELDS, n=1)
            hint = f"did you mean {near[0]!r}?" if near else "the first line names the columns"
            raise YarnError(f"line {line}: unknown column {name!r}", allowed=f"columns: {', '.join(FIELDS)}", do=hint)
        if name in names[:place]:
            raise YarnError(f"line {line}: the column {name!r} comes twice", do="give each column once")


def _csv_records(text: str) -> Sequence[Record]:
    delimiter, (first, header), lines = csv_lines(text, YarnError)
    names = [name.lower() for name in header]
    _check_columns(names, first)
    return [_csv_record(names, cells, line, delimiter) for line, cells in lines]


def _csv_record(names: Sequence[str], cells: Sequence[str], line: int, delimiter: str) -> Record:
    if len(cells) > len(names):
        raise YarnError(f"line {line} has {len(cells)} cells", allowed=f"{len(names)} columns", do="quote a comma")
    said = {name: cell for name, cell in zip(names, cells, strict=False) if cell}
    return {name: _csv_value(name, cell, line, delimiter) for name, cell in said.items()}


def _csv_value(name: str, cell: str, line: int, delimiter: str) -> object:
    if name in ("name", "srgb"):
        return cell
    numbers = decimal_points(cell.strip("[]()"), delimiter)
    try:
        values = [float(word) for word in re.split(r"[\s,;/]+", numbers.strip())]
    except ValueError:
        raise YarnError(f"line {line}: {name} {cell!r} is not a number", do="mend that cell") from None
    if name == "lab":
        return values
    if len(values) != 1:
        raise YarnError(f"line {line}: {name} {cell!r} is not one number", do="mend that cell")
    return int(values[0]) if name == "ply" and values[0].is_integer() else values[0]
