"""The language of what a command prints: `ilmek --lang tr COMMAND`, or after the command."""

from collections.abc import Callable

import click

from ilmek.errors import IlmekError, joined_message, printable
from ilmek.sentences import DEFAULT, LANGUAGES, Sentence, headed, in_language, worded_error

_LANGUAGE = "ilmek.language"
"""Where the context of a command has the language of --lang."""


def speak(context: click.Context, _: click.Parameter, language: str | None) -> str | None:
    """Have a command speak the language of an option; one that has not every sentence leaves it in English."""
    if language in LANGUAGES:
        context.meta[_LANGUAGE] = language
    return language


def printed(text: str) -> str:
    """A sentence in the language of the command, as a terminal may show it; another text as it is."""
    return worded(text) if isinstance(text, Sentence) else printable(text)


def worded(text: str) -> str:
    """A sentence, or words of the engine, in the language of the command: titles, headings, names of checks."""
    return _said(text, headed)


def language_of_command() -> str:
    """The language of --lang."""
    context = click.get_current_context(silent=True)
    language: str = DEFAULT if context is None else context.meta.get(_LANGUAGE, DEFAULT)
    return language


def _said(text: str, speak: Callable[[str], str]) -> str:
    language = language_of_command()
    if language == DEFAULT:
        return printable(text)
    with in_language(language):
        return printable(speak(text))


def error_line(error: IlmekError) -> str:
    """The line of an error in the language of the command."""
    return joined_message(*(_said(text, worded_error) for text in (error.given, error.allowed, error.do)))


def language_option(*, hidden: bool = False) -> click.Option:
    """The option --lang of all commands, and of each."""
    return click.Option(
        ["--lang"],
        type=click.Choice(tuple(LANGUAGES)),
        hidden=hidden,
        expose_value=False,
        is_eager=True,
        callback=speak,
        help="Language of what is printed and of report pages, also after the command; other files and JSON stay.",
    )
