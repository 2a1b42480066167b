"""Sentences of the engine in the words of the pages: in their language, and an option of the command line is named as
the pages name it.
"""

import re
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

from ilmek.sentences import DEFAULT, LANGUAGES, language_spoken, translated

T = TypeVar("T")

_OPTION = re.compile(r"(?<![\w-])--(?:no-)?([a-z][a-z-]*)(?: [A-Z]+\.\.[A-Z]+)?")

NAMES = {
    "speed": 'the speed in "Motion"',
    "over": 'the range in "Motion"',
    "at": 'the fixed value in "Motion"',
    "fit": "Fit",
    "corners": "corners (Straighten)",
    "colours": "the number of colours",
    "quality": "the quality",
    "yarn-count": "the yarn's count",
    "pile-height": "the pile height",
    "loom": "a loom",
    "pdf": "the chart as PDF",
}
"""What the pages call it, by the name of the option; others by their own words."""


def in_page(text: str) -> str:
    """A sentence in the language of the page, without options of the command line.

    >>> in_page("forces at 1 rad/s; give --speed")
    'forces at 1 rad/s; give the speed in "Motion"'
    >>> in_page("give a longer --time-limit")
    'give a longer time limit'
    """
    return _OPTION.sub(lambda found: NAMES.get(found[1], found[1].replace("-", " ")), translated(text))


def all_in_page(texts: tuple[str, ...]) -> tuple[str, ...]:
    """Sentences without options of the command line."""
    return tuple(map(in_page, texts))


WORDS = frozenset(
    re.findall(
        r"\w+",
        "title note label heading meaning doc summary allowed rows bars kinds check decided_by source cure sieve words "
        "made no_four_bar reasons",
    )
)
"""Fields of records that hold words for people."""

_SHAPES = frozenset(("pieces", "plates"))
"""Fields of a report that are for the workshop: their parts are those of one tree, and no page shows them."""


def spoken(record: T) -> T:
    """A record of a machine with its words in the language of the page: titles, notes, labels, headings, meanings.

    >>> from ilmek.report import Column
    >>> from ilmek.sentences import in_language
    >>> with in_language("tr"):
    ...     spoken(Column("crank angle", "deg")).heading
    'krank açısı'
    """
    spoken_record: T = record if language_spoken() == LANGUAGES[DEFAULT] else _spoken(record, words=False)
    return spoken_record


def _spoken(value: Any, *, words: bool) -> Any:
    if isinstance(value, str):
        return in_page(value) if words else value
    if isinstance(value, dict) and words:
        return {key: _spoken(one, words=words) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return type(value)(_spoken(one, words=words) for one in value)
    if not is_dataclass(value) or isinstance(value, type):
        return value
    names = [one.name for one in fields(value) if one.init and one.name not in _SHAPES]
    return replace(value, **{name: _spoken(getattr(value, name), words=name in WORDS) for name in names})
