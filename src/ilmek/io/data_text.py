"""TOML and JSON texts of others: checked before they are parsed, and their names and texts after.

The check bounds what makes a parser slow or deep: brackets, dotted keys, numbers, texts. A name is a key. JSON is read
strictly: no NaN, no Infinity, no key given twice.
"""

import json
import math
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from ilmek.errors import IlmekError, is_printable, restated, shortened
from ilmek.io.line_numbers import KeyLines, Token, json_lines, tokens, toml_lines
from ilmek.io.line_numbers import Path as KeyPath
from ilmek.io.text_file import read_text

LARGEST = 250_000
"""Largest size of a TOML or JSON file [bytes]; it is parsed within 1 s. A large cyclogram has 50,000."""

DEEPEST = 12
"""Largest depth of brackets, and largest number of parts of a dotted key."""

LONGEST_NAME = 100
"""Largest number of characters of a name."""

LONGEST_TEXT = 1000
"""Largest number of characters of a text or a number."""


_SPACES = str.maketrans("\u00a0\u2009\u202f", "   ")
"""Blanks between a number and its unit."""


class DataText(NamedTuple):
    """Data of a text, the line of each key, and the text itself."""

    data: Any
    lines: KeyLines
    text: str


def read_data(
    path: Path, kind: str, error: type[IlmekError], *, largest: int = LARGEST, longest: int = LONGEST_TEXT
) -> DataText:
    """The data of a .toml or .json file.

    kind     of the file in messages: mechanism, cyclogram
    largest  size of the file [bytes]      longest  number of characters of a text or number
    Raises `error` with the file and, for an error in the text, the line.
    """
    noun = f"{kind} file, .toml or .json"
    with restated(error, f"{kind} file {path} ", of=error):
        text = read_text(path, noun=noun, largest=largest, error=error, do="check the path")
        if path.suffix.lower() not in (".toml", ".json"):
            raise error(f"ends in {path.suffix!r}", allowed=f"a {kind} file is .toml or .json")
    return parse_data(text, name=str(path), toml=path.suffix.lower() == ".toml", error=error, longest=longest)


def parse_data(text: str, *, name: str, toml: bool, error: type[IlmekError], longest: int = LONGEST_TEXT) -> DataText:
    """The data of a TOML or JSON text; messages call it `name`. Raises `error` with the line."""
    with restated(error, f"{name}, "):
        found = list(tokens(text))
        _check_tokens(found, longest)
        data, lines = (_toml if toml else _json)(text, found)
        _check_texts(data, lines)
    return DataText(data, lines, text)


def plain_data(data: object, name: str, error: type[IlmekError]) -> Any:
    """Data that were no text, checked as those of a text are; messages call them `name`. Raises `error`."""
    try:
        _check_depth(data, DEEPEST)
        _check_texts(data, {(): 1})
    except IlmekError as failed:
        raise error(
            f"{name}, {failed.given.removeprefix('line 1, ').removeprefix('line 1: ')}",
            allowed=failed.allowed,
            do=failed.do,
        ) from None
    return data


def _check_depth(data: object, left: int) -> None:
    """Raise IlmekError for tables and lists in one another that are too deep."""
    if left < 0:
        raise IlmekError("is nested too deeply", allowed=f"at most {DEEPEST} levels")
    for inner in data.values() if isinstance(data, dict) else data if isinstance(data, list) else ():
        _check_depth(inner, left - 1)


def _toml(text: str, found: list[Token]) -> tuple[object, KeyLines]:
    try:
        return tomllib.loads(text), toml_lines(found)
    except tomllib.TOMLDecodeError as failed:
        reason, _, at = str(failed).removesuffix(")").rpartition(" (at ")
        raise IlmekError(f"{at or 'end'}: {reason[:1].lower()}{reason[1:]}", do="correct that line") from None
    except ValueError as failed:  # a date that does not exist
        raise IlmekError(f"not TOML: {failed}", do="correct that value") from None


def _json(text: str, found: list[Token]) -> tuple[object, KeyLines]:
    try:
        return json.loads(text), json_lines(found)
    except json.JSONDecodeError as failed:
        reason = f"{failed.msg[:1].lower()}{failed.msg[1:]}"
        raise IlmekError(f"line {failed.lineno}, column {failed.colno}: {reason}", do="correct that line") from None


def _check_tokens(found: list[Token], longest: int) -> None:
    """Raise IlmekError for brackets or dotted keys that are too deep, and for a text or number that is too long."""
    depth = dots = 0
    for kind, text, line in found:
        if len(text) > longest and kind != "rest":
            given = f"line {line}: {shortened(text)} is too long"
            raise IlmekError(given, allowed=f"at most {longest} characters in a text or number")
        if kind == "mark" and text != ".":
            depth += (text in "[{") - (text in "]}")
        if kind in ("mark", "newline"):
            dots = dots + 1 if text == "." else 0
        if depth > DEEPEST or dots >= DEEPEST:
            raise IlmekError(f"line {line}: is nested too deeply", allowed=f"at most {DEEPEST} levels")


def _check_texts(data: object, lines: KeyLines) -> None:
    """Raise IlmekError for a name or text that cannot be printed, and for a number that is not finite."""
    for path, value in values(data, ()):
        at = f"line {_line(path, lines)}"
        name = path[-1] if path else 0
        if isinstance(name, str) and not (len(name) <= LONGEST_NAME and is_printable(name)):
            given = f"{at}: the name {shortened(ascii(name))} cannot be used"
            raise IlmekError(given, allowed=f"at most {LONGEST_NAME} letters, digits and signs on one line")
        if isinstance(value, str) and not is_printable(value.translate(_SPACES)):
            given = f"{at}, {name}: {shortened(ascii(value))} cannot be printed"
            raise IlmekError(given, allowed="letters, digits and signs on one line")
        if isinstance(value, float) and not math.isfinite(value):
            raise IlmekError(f"{at}, {'.'.join(map(str, path))}: {value} is not a finite number")


def values(data: object, path: KeyPath) -> Iterator[tuple[KeyPath, Any]]:
    """Every value with its path, tables and lists before what is in them; the depth is bounded by the tokens."""
    yield path, data
    inner = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in inner:
        yield from values(value, (*path, key))


def _line(path: KeyPath, lines: KeyLines) -> int:
    while path not in lines:
        path = path[:-1]
    return lines[path]
