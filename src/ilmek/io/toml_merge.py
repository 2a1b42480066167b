r"""Changes of a TOML text that keep what is not changed: comments, order, blank lines, the notation of numbers.

>>> print(merged_toml('size = "60x90cm"  # as ordered\npile = 8\n', {"size": "80x120cm", "pile": 8}), end="")
size = "80x120cm"  # as ordered
pile = 8
"""

import tomllib
from collections.abc import Mapping, MutableMapping
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, Array

from ilmek.errors import ParameterError
from ilmek.io.schema import Table
from ilmek.io.toml_text import toml_text

MOST_MERGED = 60_000
"""Largest length of a text whose comments are kept [characters]; it takes about 0.1 s."""


def merged_toml(text: str, data: Mapping[str, object]) -> str:
    """The text with the values of `data`; only what differs is written anew.

    A text that is not TOML, or longer than MOST_MERGED, is written anew as a whole.
    Raises ParameterError for null, which TOML does not have.
    """
    _check(data, ())
    try:
        if tomllib.loads(text) == data and _same_kinds(tomllib.loads(text), data):
            return text
        if len(text) <= MOST_MERGED:
            document = tomlkit.parse(text)
            _merge(document, data)
            written = tomlkit.dumps(document)
            if tomllib.loads(written) == data:
                return written
    except (tomllib.TOMLDecodeError, TOMLKitError, ValueError, TypeError, KeyError, IndexError):
        pass  # some arrangements of dotted keys are not supported: written anew
    return toml_text(data)


def _check(value: object, path: tuple[str, ...]) -> None:
    if value is None:
        raise ParameterError(f"{'.'.join(path)} is null", do="leave the key out")
    if isinstance(value, Mapping):
        for key, inner in value.items():
            _check(inner, (*path, str(key)))
    elif isinstance(value, list | tuple):
        for index, inner in enumerate(value):
            _check(inner, (*path, str(index)))


def _same_kinds(old: Any, new: Any) -> bool:
    """Whether equal data is also true and false in the same entries, which Python takes for 1 and 0."""
    if isinstance(old, bool) != isinstance(new, bool):
        return False
    if isinstance(old, Mapping):
        return all(_same_kinds(value, new[key]) for key, value in old.items())
    if isinstance(old, list):
        return all(map(_same_kinds, old, new))
    return True


def _equal(old: object, new: object) -> bool:
    plain = old.unwrap() if hasattr(old, "unwrap") else old
    return bool(plain == new) and _same_kinds(plain, new)


def _merge(table: MutableMapping[str, object], data: Mapping[str, object]) -> None:
    for key in [key for key in table if key not in data]:
        del table[key]
    for key, value in data.items():
        if key not in table:
            table[key] = _made(value)
            continue
        old = table[key]
        if _equal(old, value):
            continue
        if isinstance(old, MutableMapping) and isinstance(value, Mapping):
            _merge(old, value)
        elif isinstance(old, AoT) and isinstance(value, list) and all(isinstance(one, Mapping) for one in value):
            _merge_tables(old, value)
        elif isinstance(old, Array) and isinstance(value, list):
            _merge_list(old, value)
        else:
            table[key] = _made(value)


def _merge_tables(rows: AoT, data: list[Mapping[str, object]]) -> None:
    for index, entry in enumerate(data):
        if index >= len(rows):
            rows.append(_made(entry))
        elif not _equal(rows[index], entry):
            _merge(rows[index], entry)
    while len(rows) > len(data):
        del rows[len(rows) - 1]


def _merge_list(entries: Array, data: list[Any]) -> None:
    for index in range(min(len(entries), len(data))):
        if not _equal(entries[index], data[index]):
            entries[index] = _inline(data[index])
    while len(entries) > len(data):
        del entries[len(entries) - 1]
    for value in data[len(entries) :]:
        entries.append(_inline(value))


def _made(value: object) -> Any:
    """A value as it is written at a new key: a table of tables under headings, other tables in one line."""
    if isinstance(value, Mapping):
        return _heading(value)
    if isinstance(value, list) and value and all(isinstance(one, Mapping) for one in value):
        rows = tomlkit.aot()
        for one in value:
            rows.append(_heading(one))
        return rows
    return _inline(value)


def _heading(value: Table) -> Any:
    table = tomlkit.table()
    for key, inner in value.items():
        deep = isinstance(inner, Mapping) and any(isinstance(one, Mapping) for one in inner.values())
        table.append(key, _heading(inner) if deep else _inline(inner))
    return table


def _inline(value: object) -> Any:
    if isinstance(value, Mapping):
        table = tomlkit.inline_table()
        for key, inner in value.items():
            table.append(key, _inline(inner))
        return table
    if isinstance(value, list | tuple):
        entries = tomlkit.array()
        for inner in value:
            entries.append(_inline(inner))
        return entries
    return tomlkit.item(value)
