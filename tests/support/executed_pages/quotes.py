"""What a page quotes, compared with what is printed."""

import json
import re
from collections.abc import Iterator
from decimal import Decimal
from typing import Any

GAP = "…"
_RULE = re.compile(r"[─━-]{3,}")


def words(text: str) -> list[str]:
    """The words of a text; lines of a table's frame are none."""
    return [word for word in text.split() if not _RULE.fullmatch(word)]


def difference(quoted: str, printed: str) -> str:
    """What a quotation has that was not printed; "" where they agree. Breaks of lines do not matter, and `…` is a gap.

    >>> difference("checks: 5 … failed", "checks: 5 passed, 0\\nfailed"), difference("5 heads", "6 heads")
    ('', "'5 heads' is not printed; the rest of what is: '6 heads'")
    """
    rest = " ".join(words(printed))
    parts = [" ".join(words(part)) for part in quoted.split(GAP)]
    for number, part in enumerate(parts):
        last = number == len(parts) - 1
        begin = len(rest) - len(part) if last and number else rest.find(part) if number else 0
        fits = begin >= 0 and rest[begin:].startswith(part) and not (last and begin + len(part) < len(rest))
        if not fits:
            return f"{part!r} is not printed; the rest of what is: {rest[:2000]!r}"
        rest = rest[begin + len(part) :].lstrip()
    return ""


def json_difference(quoted: str, printed: str) -> str:
    """What quoted JSON has that was not printed; "" where they agree. Numbers agree in the digits that are quoted.

    >>> json_difference('{"a": 0.30, "…": "…"}', '{"a": 0.2976, "b": 1}')
    ''
    """
    shown = json.loads(quoted, parse_float=Decimal)
    start = min((index for sign in "{[" if (index := printed.find(sign)) >= 0), default=0)
    actual, _ = json.JSONDecoder().raw_decode(printed[start:])
    return next(_differences(shown, actual, "JSON"), "")


def _differences(shown: Any, actual: Any, where: str) -> Iterator[str]:
    if isinstance(shown, dict) and isinstance(actual, dict):
        yield from _of_names(shown, actual, where)
    elif isinstance(shown, list) and isinstance(actual, list):
        yield from _of_lists(shown, actual, where)
    elif shown != GAP and not _same(shown, actual):
        yield f"{where}: {shown!r}, printed: {actual!r}"


def _of_names(shown: dict[str, Any], actual: dict[str, Any], where: str) -> Iterator[str]:
    names = shown.keys() - {GAP}
    if names - actual.keys() or (GAP not in shown and names != actual.keys()):
        yield f"{where}: names {sorted(names)}, printed: {sorted(actual)}"
    for name in names & actual.keys():
        yield from _differences(shown[name], actual[name], f"{where}.{name}")


def _of_lists(shown: list[Any], actual: list[Any], where: str) -> Iterator[str]:
    """Lists agree entry by entry; a gap at the begin or at the end stands for entries that are left out there."""
    if len(shown) > 1 and shown[0] == GAP:
        if all(any(_of_lists(shown[1:], actual[begin:], where)) for begin in range(len(actual))):
            yield f"{where}: no entry is {shown[1]}"
        return
    entries = [entry for entry in shown if entry != GAP]
    if len(entries) > len(actual) or (len(entries) == len(shown) != len(actual)):
        yield f"{where}: {len(entries)} entries, printed: {len(actual)}"
    for number, (entry, printed) in enumerate(zip(entries, actual, strict=False)):
        yield from _differences(entry, printed, f"{where}[{number}]")


def _same(shown: Any, actual: Any) -> bool:
    if isinstance(shown, Decimal) and isinstance(actual, int | float):
        half = Decimal(1).scaleb(int(shown.as_tuple().exponent)) / 2
        return abs(Decimal(actual) - shown) <= half
    if isinstance(shown, str) and isinstance(actual, str):
        return not difference(shown, actual)
    return bool(shown == actual) and isinstance(shown, bool) == isinstance(actual, bool)
