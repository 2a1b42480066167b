"""Sentences of the engine in the words of the pages: in their language, and an option of the command line is named as
the pages name it.
"""

import re

from ilmek.sentences import translated

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
