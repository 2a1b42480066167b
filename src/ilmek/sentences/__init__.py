"""Sentences for people, by key: English on the terminal, and the language of whoever reads in the studio.

A `Sentence` is its English text, and knows its key and values, so that it can be said in another language later. Parts
of it may be sentences themselves.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from importlib import import_module
from typing import Any, NamedTuple

from ilmek.sentences.english import ENGLISH
from ilmek.sentences.nouns_turkish import named, phrased
from ilmek.sentences.terminal_turkish import WORDS
from ilmek.sentences.weaver_english import NOUNS

LATIN, PERSIAN, DEVANAGARI = "0123456789", "۰۱۲۳۴۵۶۷۸۹", "०१२३४५६७८९"


class Language(NamedTuple):
    """A language of people.

    module    of its catalogue           digits  0 to 9
    leftward  lines begin at the right   local   digits have the forms that a font has for it (locl of OpenType)
    point     before decimals, on paper
    """

    module: str
    digits: str = LATIN
    leftward: bool = False
    local: bool = False
    point: str = "."


DEFAULT = "en"
LANGUAGES = {"en": Language("english"), "tr": Language("turkish", point=",")}
"""The languages that have every sentence."""

WEAVERS = LANGUAGES | {
    "fa": Language("persian", PERSIAN, leftward=True),
    "ar": Language("arabic", "٠١٢٣٤٥٦٧٨٩", leftward=True),
    "ur": Language("urdu", PERSIAN, leftward=True, local=True),
    "hi": Language("hindi", DEVANAGARI),
    "ne": Language("nepali", DEVANAGARI),
}
"""The languages of the weaver's papers; those that have no other sentences say them in English."""

_SPOKEN = ContextVar("language", default=DEFAULT)
_TECHNIQUE = ContextVar("technique", default="")


GIVEN = frozenset(("choices", "file", "key", "name", "option"))
"""Places in sentences for what a person calls it: files, their keys, parameters and what these may be."""


class Sentence(str):
    """A text of the catalogue.

    key     in the catalogue of each language      values  texts in the places of its braces

    >>> print(Sentence("picture.empty-part", crop="1,1 1,2"))
    crop='1,1 1,2' leaves no pixel
    """

    key: str
    values: Mapping[str, str]

    def __new__(cls, key: str, /, **values: object) -> "Sentence":  # noqa: D102
        texts = {name: value if isinstance(value, str) else str(value) for name, value in values.items()}
        made = super().__new__(cls, ENGLISH[key].format(**texts))
        made.key, made.values = key, texts
        return made

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, str]]:
        return (self.key,), dict(self.values)


class Name(str):
    """A name that somebody gave: it is said in no other language, and keeps its digits."""

    __slots__ = ()


_NOUNS = {text: key for key, text in NOUNS.items()}


def noun(text: str) -> str:
    """The sentence of the weaver's nouns whose English text this is; another text stays as it is.

    A colour may have a word before it and a number behind it.

    >>> with in_language("tr"):
    ...     translated(noun("seccade-large")), translated(noun("dark green 2")), translated(noun("Zeynep's red"))
    ('büyük seccade', 'koyu yeşil 2', "Zeynep's red")
    """
    if text in _NOUNS:
        return Sentence(_NOUNS[text])
    first, _, number = text.rpartition(" ")
    if number.isdecimal() and isinstance(known := noun(first), Sentence):
        return Sentence("colour.number", colour=known, number=number)
    word, _, colour = text.partition(" ")
    key = _NOUNS.get(f"{word} {{colour}}")
    if key is not None and isinstance(known := noun(colour), Sentence):
        return Sentence(key, colour=known)
    return text


def changed(text: str, change: Callable[[str], str]) -> str:
    """A text changed; of a sentence its values, and those of the sentences in it."""
    if not isinstance(text, Sentence):
        return change(text)
    return Sentence(text.key, **{name: changed(value, change) for name, value in text.values.items()})


def location(file: str, line: int = 0, key: str = "") -> Sentence:
    """A place in a file, or in data of a file that have no lines (0).

    >>> print(location("carpet.toml", 3, "size"), "|", location("carpet.toml", key="size"))
    carpet.toml, line 3, size | carpet.toml, size
    """
    about = {"file": file} | ({"line": str(line)} if line else {}) | ({"key": key} if key else {})
    return Sentence("place." + "-".join(about), **about)


def with_location(where: str, text: str) -> Sentence:
    """A text with the place that it concerns before it."""
    return Sentence("at", where=where, text=text)


def file_of(text: str) -> str:
    """The file that a place, or a text with a place before it, names; "" where it names none."""
    if not isinstance(text, Sentence):
        return ""
    return file_of(text.values["where"]) if text.key == "at" else text.values.get("file", "")


def joined(first: str, second: str) -> str:
    """Two sentences as one, parted by a semicolon."""
    return Sentence("joined", first=first, second=second) if first and second else first or second


@contextmanager
def in_language(language: str, technique: str = "") -> Iterator[None]:
    """Say sentences in a language; an unknown one is English.

    technique  of a carpet: what it has another noun for is said by its own sentence, the key TECHNIQUE.KEY

    >>> with in_language("en", "kilim"):
    ...     translated(Sentence("chart.order"))
    'Rows are counted from the bottom, cells from the left.'
    """
    tokens = _SPOKEN.set(language if language in WEAVERS else DEFAULT), _TECHNIQUE.set(technique)
    try:
        yield
    finally:
        _SPOKEN.reset(tokens[0])
        _TECHNIQUE.reset(tokens[1])


def translated(text: str) -> str:
    """A text in the language that is spoken; of one that is no sentence the nouns of machines, where they are known.

    What stands in the places of GIVEN stays.

    >>> with in_language("tr"):
    ...     translated(Sentence("size.one-side", text="120cm")), translated("120cm")
    ("'120cm' boyutunun tek kenarı var", '120cm')
    """
    if not isinstance(text, Sentence):
        return named(text) if _SPOKEN.get() == "tr" else text
    own = f"{_TECHNIQUE.get()}.{text.key}"
    key = own if own in ENGLISH else text.key
    template = catalogue_of(_SPOKEN.get()).get(key, ENGLISH[key])
    stays = {place: value for place, value in text.values.items() if place in GIVEN and type(value) is str}
    return template.format(**{place: translated(value) for place, value in text.values.items()} | stays)


def headed(text: str) -> str:
    """A heading of a table, or the name of a value beside it, in the language that is spoken.

    >>> with in_language("tr"):
    ...     headed("colour changes")
    'renk değişimleri'
    """
    return (WORDS.get(text) if _SPOKEN.get() == "tr" else None) or translated(text)


def worded_error(text: str) -> str:
    """What an error says, in the language that is spoken; of one that is no sentence what is known as a whole."""
    return translated(text) if isinstance(text, Sentence) or _SPOKEN.get() != "tr" else phrased(text)


def language_spoken() -> Language:
    """The language that is spoken."""
    return WEAVERS[_SPOKEN.get()]


def numerals(text: str) -> str:
    """A text with the digits of the language that is spoken."""
    return text.translate(str.maketrans(LATIN, language_spoken().digits))


def spoken(text: str) -> tuple[str, ...]:
    """A text in each language, each wording once.

    >>> spoken(Sentence("sheet.mass"))
    ('Mass', 'Kütle')
    """
    texts = []
    for language in LANGUAGES:
        with in_language(language):
            texts.append(translated(text))
    return tuple(dict.fromkeys(texts))


def catalogue_of(language: str) -> Mapping[str, str]:
    """The sentences of a language by their keys."""
    name = WEAVERS[language].module
    found: Any = import_module(f"ilmek.sentences.{name}")
    catalogue: Mapping[str, str] = getattr(found, name.upper())
    return catalogue
