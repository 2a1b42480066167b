"""Look-up of names in tables of stock parts, with a hint for unknown names.

>>> pick({"6204": 1, "6205": 2, "NU 205": 3}, " nu-205", "bearing")
3
"""

import difflib
import re
from collections.abc import Iterable, Mapping
from typing import TypeVar

from ilmek.errors import ParameterError

Part = TypeVar("Part")


def pick(table: Mapping[str, Part], name: str, what: str) -> Part:
    """The part of a name; case, blanks and hyphens do not count.

    Raises ParameterError with the nearest name of the table for an unknown one.
    """
    if name in table:
        return table[name]
    known = {plain(offered): offered for offered in table}
    found = known.get(plain(name))
    if found is None:
        raise ParameterError(
            f"no {what} {name!r} in the table",
            allowed=f"the nearest offered is {nearest(name, table)!r}",
            do=f"use it, or one of the {len(table)} others",
        )
    return table[found]


def nearest(name: str, offered: Iterable[str]) -> str:
    """The most similar name: the nearest number with the same letters, else the closest spelling.

    >>> nearest("UCF 216", ["UC 216", "UCF 204", "UCF 212"])
    'UCF 212'
    >>> nearest("6204-2RS", ["6204", "6205", "6316"])
    '6204'
    """
    names = list(offered)
    letters, number = _split(name)
    alike = [each for each in names if _split(each)[0] == letters] if number is not None else []
    if alike:
        return min(alike, key=lambda each: abs((_split(each)[1] or 0.0) - (number or 0.0)))
    spelled = {plain(each): each for each in names}
    close = difflib.get_close_matches(plain(name), spelled, n=1, cutoff=0.0)
    return spelled[close[0]]


def plain(name: str) -> str:
    """A name without case, blanks and hyphens."""
    return re.sub(r"[\s\-_]", "", name).casefold()


def _split(name: str) -> tuple[str, float | None]:
    """Letters before the first number, and that number."""
    matched = re.match(r"(\D*)(\d+)", name)
    return (plain(matched[1]), float(matched[2])) if matched else (plain(name), None)
