"""Sentences for people, by key: English on the terminal, and the language of whoever reads in the studio.

A `Sentence` is its English text, and knows its key and values, so that it can be said in another language later. Parts
of it may be sentences themselves.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from importlib import import_module
from typing import Any

from ilmek.sentences.english import ENGLISH
from ilmek.sentences.nouns_turkish import named

DEFAULT = "en"
LANGUAGES = {"en": "english", "tr": "turkish"}
"""The module of each language."""

_SPOKEN = ContextVar("language", default=DEFAULT)


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
def in_language(language: str) -> Iterator[None]:
    """Say sentences in a language; an unknown one is English."""
    token = _SPOKEN.set(language if language in LANGUAGES else DEFAULT)
    try:
        yield
    finally:
        _SPOKEN.reset(token)


def translated(text: str) -> str:
    """A text in the language that is spoken; of one that is no sentence the nouns of machines, where they are known.

    >>> with in_language("tr"):
    ...     translated(Sentence("size.one-side", text="120cm")), translated("120cm")
    ("'120cm' boyutunun tek kenarı var", '120cm')
    """
    if not isinstance(text, Sentence):
        return named(text) if _SPOKEN.get() == "tr" else text
    template = catalogue_of(_SPOKEN.get())[text.key]
    return template.format(**{name: translated(value) for name, value in text.values.items()})


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
    name = LANGUAGES[language]
    found: Any = import_module(f"ilmek.sentences.{name}")
    catalogue: Mapping[str, str] = getattr(found, name.upper())
    return catalogue
