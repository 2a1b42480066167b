"""TOML output: nested tables of plain values in a readable layout, with exact numbers.

>>> print(toml_text({"name": "arm", "joints": {"A0": {"pin": ["ground", "arm"]}}, "bodies": {"arm": {"points": {}}}}))
name = "arm"
<BLANKLINE>
[joints]
A0 = { pin = ["ground", "arm"] }
<BLANKLINE>
[bodies.arm]
points = {}
<BLANKLINE>
"""

import json
import re
from collections.abc import Mapping, Sequence

from ilmek.errors import UnitError
from ilmek.io.schema import Table
from ilmek.units import in_bounds, parse_quantity, parse_unit

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml_text(data: Mapping[str, object]) -> str:
    """The data as TOML text: texts, integers, reals, lists and tables, nested to any depth.

    An entry of a table of tables has its own heading if it contains a table, else one line. Reals are written with
    enough digits to read the same number again.
    """
    plain = [_line(key, value) for key, value in data.items() if not isinstance(value, Mapping)]
    parts = ["\n".join(plain)] if plain else []
    for key, table in data.items():
        if isinstance(table, Mapping):
            parts += _tables(_key(key), table)
    return "\n\n".join(parts) + "\n"


def toml_section(path: Sequence[str], table: Mapping[str, object], *, many: bool = False) -> str:
    """A table, or an entry of a list of tables, under its own heading; one line per entry.

    >>> print(toml_section(("tracks", "the die"), {"unit": "mm"}))
    [tracks."the die"]
    unit = "mm"
    """
    heading = ".".join(map(_key, path))
    lines = (_line(key, value) for key, value in table.items())
    return "\n".join([f"[[{heading}]]" if many else f"[{heading}]", *lines])


def toml_list(key: str, entries: Sequence[object]) -> str:
    """A list with one line per entry.

    >>> print(toml_list("edits", ["set 1,1 ivory"]))
    edits = [
        "set 1,1 ivory",
    ]
    """
    return "\n".join([f"{_key(key)} = [", *(f"    {_value(entry)}," for entry in entries), "]"])


def _tables(heading: str, table: Table) -> list[str]:
    """A table under its heading; entries that contain tables follow, each under its own heading."""
    deep = {
        key: value
        for key, value in table.items()
        if isinstance(value, Mapping) and any(isinstance(inner, Mapping) for inner in value.values())
    }
    if deep and len(deep) == len(table):
        lines = [(f"{heading}.{_key(key)}", entry) for key, entry in table.items()]
        return ["\n".join([f"[{own}]", *(_line(key, value) for key, value in entry.items())]) for own, entry in lines]
    return ["\n".join([f"[{heading}]", *(_line(key, value) for key, value in table.items())])]


def _line(key: str, value: object) -> str:
    return f"{_key(key)} = {_value(value)}"


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _text(key)


def _value(value: object) -> str:
    if isinstance(value, Mapping):
        inside = ", ".join(_line(key, inner) for key, inner in value.items())
        return f"{{ {inside} }}" if inside else "{}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(_value(inner) for inner in value)}]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return _text(value) if isinstance(value, str) else repr(value)


def _text(text: str) -> str:
    """A string in quotes with escapes that both TOML and JSON accept."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def written_quantity(value: float, unit: str) -> str | float:
    """The number in its unit if that is read as the same number again, else in SI."""
    shown = value / parse_unit(unit).factor
    tries: Sequence[str] = [f"{shown:.{digits}g}{unit.removeprefix('1')}" for digits in (4, 8, 12, 16, 17)]
    shows = unit not in ("", "1") and in_bounds(value)
    plain = [text for text in tries if shows and _is_same(text, unit, value)]
    return plain[0] if plain else float(value)


def _is_same(text: str, unit: str, value: float) -> bool:
    try:
        return parse_quantity(text, unit) == value
    except UnitError:  # rounded up beyond the bounds
        return False
