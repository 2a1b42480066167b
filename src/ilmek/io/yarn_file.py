"""Yarn lists from TOML (one `[[yarn]]` table per yarn), CSV (a header line, one line per yarn) or a GIMP palette.

    [[yarn]]
    name = "madder red"
    srgb = "#8c1f28"          # or lab = [31.5, 45.0, 27.0]: CIELAB under D65
    nm = 5.0                  # metric count of the single strand [m/g]; optional: by the quality of the carpet
    ply = 3
    price = 14.5              # per kilogram; optional
    number = 12               # of the shelf, 1 to 255; its symbol belongs to it; default: its place in the list
    material = "silk"         # wool, silk or cotton; default: that of the carpet's pile

A CSV file has the columns name, srgb or lab ("31.5 45 27"), nm, ply, price, number, material; separated by commas,
semicolons or tabs.
They stand in any order. Empty lines are ignored, and lines that begin with # above the header; below it every line is a
yarn.

A palette of GIMP (.gpl) has a colour and a name on each line. Names are made unique by a number; the metric
count follows from the quality of the carpet.

A record is one yarn as read from the file: a mapping with the fields `name`, `srgb` ("#8b1a1a") or `lab` ([L, a, b]),
`nm`, `ply`, `price` and `number`, numbers or texts, and `material`. Prices are per kilogram, in the currency of the
yarn plan.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from importlib import resources
from pathlib import Path
from typing import TypeAlias

import numpy as np

from ilmek.carpet.colour import lab_to_srgb, srgb_to_lab
from ilmek.carpet.picture_points import hex_colour
from ilmek.carpet.yarn import COUNTS, MOST_YARNS, PLIES, Yarn
from ilmek.elements.yarns import MATERIALS
from ilmek.errors import JOINERS, YarnError, did_you_mean, is_printable, restated, shortened
from ilmek.io.csv_lines import csv_lines, decimal_points
from ilmek.io.data_text import LONGEST_NAME, parse_data
from ilmek.io.schema import finite_number, key_faults
from ilmek.io.text_file import read_text
from ilmek.units import counted

LARGEST = 250_000
"""Largest size of a yarn list [bytes]; 255 yarns need far less."""

Record: TypeAlias = Mapping[str, object]

GPL_HEADING = "GIMP Palette"
_GPL_COLOUR = re.compile(r"\s*(\d{1,3})\s+(\d{1,3})\s+(\d{1,3})(?:\s+(.*))?")

FIELDS = ("name", "srgb", "lab", "nm", "ply", "price", "number", "material")

_WHOLE = ("ply", "number")

_MISSING = "check the path, or give --yarns wool: the wools that come with ilmek"

WOOL = "wool"
SHIPPED = {WOOL: "wool16.toml", "natural": "natural.toml"}
"""In the place of a file: lists that come with ilmek, the wools first."""


def read_yarns(path: Path) -> tuple[Yarn, ...]:
    """The yarns of a TOML, CSV or GPL file, or of SHIPPED. Raises YarnError, naming the file and the line or yarn."""
    if str(path) in SHIPPED and not path.exists():
        return default_yarns(str(path))
    reader = _READERS.get(path.suffix.lower())
    with restated(YarnError, f"yarn list {path}: ", of=YarnError):
        if reader is None and path.is_file():
            raise YarnError(f"ends in {path.suffix!r}", allowed="a yarn list is a .toml, .csv or .gpl file")
        text = read_text(path, noun="yarn list, .toml, .csv or .gpl", largest=LARGEST, error=YarnError, do=_MISSING)
        return (reader or _toml_yarns)(text)


@cache
def default_yarns(name: str = WOOL) -> tuple[Yarn, ...]:
    """The yarns of a list that comes with ilmek: sixteen wools, or natural dyes."""
    text = resources.files("ilmek.data").joinpath(SHIPPED[name]).read_text(encoding="utf-8")
    return _toml_yarns(text)


def _toml_yarns(text: str) -> tuple[Yarn, ...]:
    data = parse_data(text, name="TOML", toml=True, error=YarnError).data
    unknown = [key for key in data if key != "yarn"]
    if unknown:
        raise YarnError(f"unknown entry {unknown[0]!r}", do="write each yarn as a [[yarn]] table")
    records = data.get("yarn", [])
    if not isinstance(records, list) or not all(isinstance(record, dict) for record in records):
        raise YarnError("'yarn' is not a list of tables", do="write each yarn as a [[yarn]] table")
    return yarns_from_records(records)


def _check_columns(names: Sequence[str], line: int) -> None:
    for index, name in enumerate(names):
        if name not in FIELDS:
            hint = did_you_mean(name, FIELDS, otherwise="the first line names the columns")
            raise YarnError(f"line {line}: unknown column {name!r}", allowed=f"columns: {', '.join(FIELDS)}", do=hint)
        if name in names[:index]:
            raise YarnError(f"line {line}: the column {name!r} is given twice", do="give each column once")


def _csv_yarns(text: str) -> tuple[Yarn, ...]:
    delimiter, (first, header), lines = csv_lines(text, YarnError)
    names = [name.lower() for name in header]
    _check_columns(names, first)
    records: dict[int, Record] = {}
    for line, cells in lines:
        filled = {name: cell for name, cell in zip(names, cells, strict=False) if cell}
        records[line] = {name: _csv_value(name, cell, line, delimiter) for name, cell in filled.items()}
    return yarns_from_records(list(records.values()), list(records))


def _csv_value(name: str, cell: str, line: int, delimiter: str) -> object:
    if name in ("name", "srgb", "material"):
        return cell
    numbers = decimal_points(cell.strip("[]()"), delimiter)
    try:
        values = [float(word) for word in re.split(r"[\s,;/]+", numbers.strip())]
    except ValueError:
        raise YarnError(f"line {line}: {name} {cell!r} is not a number", do="correct that cell") from None
    if name == "lab":
        return values
    if len(values) != 1:
        raise YarnError(f"line {line}: {name} {cell!r} is not one number", do="correct that cell")
    return int(values[0]) if name in _WHOLE and values[0].is_integer() else values[0]


def _gpl_yarns(text: str) -> tuple[Yarn, ...]:
    lines = text.removeprefix("\ufeff").splitlines()
    if not lines or lines[0].strip() != GPL_HEADING:
        raise YarnError("line 1 is not that of a GIMP palette", allowed=f"{GPL_HEADING!r}", do="export it from GIMP")
    records: list[Record] = []
    seen: dict[str, int] = {}
    for number, line in enumerate(lines[1:], start=2):
        if not line.strip() or line.lstrip().startswith("#") or re.match(r"(Name|Columns):", line):
            continue
        matched = _GPL_COLOUR.fullmatch(line)
        codes = [int(code) for code in matched.groups()[:3]] if matched else []
        if matched is None or max(codes) > 255:
            raise YarnError(f"line {number} {shortened(line)!r} is no colour", allowed="red, green and blue, 0 to 255")
        if len(records) == MOST_YARNS:
            raise YarnError(f"line {number}: the palette has more than {MOST_YARNS} colours", do="leave some out")
        srgb = hex_colour(codes)
        records.append({"name": _unique(_gpl_name(matched[4], srgb), seen), "srgb": srgb})
    return yarns_from_records(records)


_READERS = {".toml": _toml_yarns, ".csv": _csv_yarns, ".gpl": _gpl_yarns}


def _gpl_name(text: str | None, srgb: str) -> str:
    """The name of a colour; its code where it has none."""
    name = (text or "").strip()
    return srgb if not name or name.casefold() == "untitled" else name


def _unique(name: str, seen: dict[str, int]) -> str:
    """The name with the next free number where it was seen before."""
    free, number = name, seen.get(name.casefold(), 1)
    while free.casefold() in seen:
        number += 1
        free = f"{name} {number}"
    seen[name.casefold()] = number
    seen.setdefault(free.casefold(), 1)
    return free


def yarns_from_records(records: Sequence[Record], lines: Sequence[int] = ()) -> tuple[Yarn, ...]:
    """The yarns of a list, checked. Raises YarnError, naming the yarn and the field.

    lines  of the file on which the records stand, for messages; default: not known
    """
    if not 2 <= len(records) <= MOST_YARNS:
        count = "no yarn" if not records else "one yarn only" if len(records) == 1 else counted(len(records), "yarn")
        raise YarnError(
            f"the yarn list has {count}", allowed=f"2 to {MOST_YARNS} yarns", do="a design needs two colours"
        )
    called = [f"line {line}: yarn {number}" for number, line in enumerate(lines, start=1)]
    called = called or [f"yarn {number}" for number in range(1, len(records) + 1)]
    yarns = tuple(_yarn(record, name) for record, name in zip(records, called, strict=True))
    yarns = _numbered(yarns, called)
    has_counts = any(yarn.metric_count is not None for yarn in yarns)
    seen: dict[str, int] = {}
    for number, yarn in enumerate(yarns, start=1):
        if has_counts and yarn.metric_count is None:
            raise _no_count(f"{called[number - 1]} ({shortened(yarn.name)})")
        first = seen.setdefault(yarn.name.casefold(), number)
        if first != number:
            both = f"lines {lines[first - 1]} and {lines[number - 1]}: yarns" if lines else "yarns"
            raise YarnError(
                f"{both} {first} and {number} are both named {yarn.name!r}", do="give each yarn its own name"
            )
    return yarns


def _numbered(yarns: tuple[Yarn, ...], called: Sequence[str]) -> tuple[Yarn, ...]:
    """The yarns with a number each: their own, or their place in the list. Raises YarnError for one of two yarns."""
    found = tuple(replace(yarn, number=yarn.number or place) for place, yarn in enumerate(yarns, start=1))
    first: dict[int | None, int] = {}
    for place, yarn in enumerate(found):
        other = first.setdefault(yarn.number, place)
        if other != place:
            both = f"{called[other]} ({shortened(yarns[other].name)}) and {called[place]} ({shortened(yarn.name)})"
            given, do = f"{both} have the number {yarn.number}", "give every yarn a number, or none"
            raise YarnError(given, allowed="a number each; a yarn without one has its place in the list", do=do)
    return found


def _yarn(record: Record, numbered: str) -> Yarn:
    """The yarn of a record, which is `numbered` in messages: "yarn 3"."""
    name = str(record.get("name") or "").strip().strip(JOINERS)
    called = f"{numbered} ({shortened(name)})" if name else numbered
    for _, error in key_faults(record, FIELDS, noun="field"):
        raise YarnError(f"{called}: {error.given}", allowed=error.allowed, do=error.do)
    if not name:
        raise YarnError(f"{called} has no name", do='give it one, like name = "madder red"')
    if not is_printable(name) or len(name) > LONGEST_NAME:
        allowed = f"at most {LONGEST_NAME} letters, digits and signs on one line"
        raise YarnError(f"{numbered} has the name {shortened(ascii(name))}", allowed=allowed)
    srgb, lab = _colour(record, called)
    count = _number(record, "nm", called)
    ply, place = _number(record, "ply", called), _number(record, "number", called)
    if count is None and ply is not None:
        raise _no_count(called)
    if ply is not None and ply != round(ply):
        raise YarnError(f"{called}: ply {ply:g} is not a whole number", allowed="strands twisted together: 1 to 64")
    if place is not None and place != round(place):
        raise YarnError(f"{called}: number {place:g} is not a whole number", allowed=f"1 to {MOST_YARNS}")
    number = None if place is None else round(place)
    price, material = _number(record, "price", called), _material(record, called)
    return Yarn(name, srgb, lab, count, 1 if ply is None else round(ply), price, number, material)


def _material(record: Record, called: str) -> str | None:
    """The material of a record; None if it is missing or empty."""
    given = str(record.get("material") or "").strip().lower() or None
    if given is not None and given not in MATERIALS:
        hint = did_you_mean(given, MATERIALS)
        raise YarnError(f"{called}: material {shortened(given)!r} is unknown", allowed=", ".join(MATERIALS), do=hint)
    return given


def _no_count(called: str) -> YarnError:
    given, do = f"{called} has no nm", "like nm = 2.5; without any nm and ply the count follows from the quality"
    return YarnError(given, allowed="the metric count, m/g of one strand, of every yarn or of none", do=do)


_BOUNDS: Mapping[str, tuple[float, float]] = {
    "nm": COUNTS,
    "ply": PLIES,
    "price": (0.0, 1e6),
    "number": (1, MOST_YARNS),
}


def _number(record: Record, field: str, called: str) -> float | None:
    """A number of the record within its bounds; None if it is missing or empty."""
    written = record.get(field)
    if written is None or (isinstance(written, str) and not written.strip()):
        return None
    low, high = _BOUNDS[field]
    value = finite_number(written)
    if value is None or not low <= value <= high:
        raise YarnError(f"{called}: {field} {written!r} cannot be used", allowed=f"a number, {low:g} to {high:g}")
    return value


_Srgb = tuple[int, int, int]
_Lab = tuple[float, float, float]


def _colour(record: Record, called: str) -> tuple[_Srgb, _Lab]:
    """The colour of a record as sRGB codes and as CIELAB; the record gives one of them."""
    coded, measured = record.get("srgb") or None, record.get("lab") or None
    if (coded is None) == (measured is None):
        colours = "no colour" if coded is None else "both srgb and lab"
        raise YarnError(f"{called} has {colours}", allowed="one of srgb and lab", do='like srgb = "#8b1a1a"')
    if coded is not None:
        srgb = _srgb(coded, called)
        lightness, a, b = srgb_to_lab(np.array(srgb, dtype=np.uint8)).tolist()
        return srgb, (lightness, a, b)
    lab = _lab(measured, called)
    red, green, blue = lab_to_srgb(np.array(lab)).tolist()
    return (red, green, blue), lab


def _srgb(code: object, called: str) -> _Srgb:
    """Codes of `#8b1a1a`, also without #, or of the short form `#811` (each digit doubled)."""
    written = re.sub(r"^#(.)(.)(.)$", r"#\1\1\2\2\3\3", str(code).strip())
    matched = re.fullmatch(r"#?([0-9a-fA-F]{2})([0-9a-fA-F]{2})([0-9a-fA-F]{2})", written)
    if matched is None:
        raise YarnError(f"{called}: srgb {code!r} is no colour", allowed="six hexadecimal digits", do='like "#8b1a1a"')
    return int(matched[1], 16), int(matched[2], 16), int(matched[3], 16)


def _lab(colour: object, called: str) -> _Lab:
    parts = re.split(r"[\s,;]+", colour.strip(" ()[]")) if isinstance(colour, str) else colour
    read = [finite_number(part) for part in parts] if isinstance(parts, list | tuple) else []
    numbers = [number for number in read if number is not None]
    if len(read) == len(numbers) == 3:
        lightness, a, b = numbers
        if 0 <= lightness <= 100 and max(abs(a), abs(b)) <= 160:
            return lightness, a, b
    given = f"{called}: lab {colour!r} is no colour"
    raise YarnError(given, allowed="L 0 to 100, a and b -160 to 160", do="like lab = [35, 50, 30]")
