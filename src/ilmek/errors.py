"""Errors of the package, as a tree.

    IlmekError                  an error that a user can correct; the command line prints it in one line and ends with 2
    ├── UnitError               a quantity that cannot be read, or has the wrong dimension
    ├── ParameterError          a machine parameter that is unknown, out of bounds or contradictory
    ├── MechanismError          a mechanism that cannot close, has no plan, or is at a dead centre
    ├── PictureError            a picture that cannot be read or is not usable as a carpet
    ├── YarnError               a yarn list that cannot be read or used
    ├── CarpetError             a size, quality or knot that does not exist or does not fit
    ├── LoomError               a loom or programme that cannot make this carpet
    └── OutputError             a file or folder that cannot be written whole

A message states what was given, what is allowed and what to do, in that order.
"""

import difflib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from ilmek.sentences import Sentence


def joined_message(given: str, allowed: str, do: str) -> str:
    """A message in one line: what was given, what is allowed, what to do; an empty part is left out."""
    return "; ".join(part for part in (given, allowed, do) if part)


class IlmekError(Exception):
    """An error that the user can correct.

    given    the wrong input, with its value as written
    allowed  the allowed input ("" if it follows from the first part)
    do       the next step ("" if it is obvious)

    >>> print(IlmekError("crank is 60 m", allowed="up to 10 m", do="write 60 * mm"))
    crank is 60 m; up to 10 m; write 60 * mm
    """

    def __init__(self, given: str, *, allowed: str = "", do: str = "") -> None:
        self.given = given
        self.allowed = allowed
        self.do = do
        super().__init__(joined_message(given, allowed, do))


class UnitError(IlmekError):
    """A quantity that cannot be read, or has the wrong dimension."""


class ParameterError(IlmekError):
    """A parameter that is unknown, out of bounds or contradicts another."""


class MechanismError(IlmekError):
    """A mechanism that cannot close, cannot be solved, or is at a dead centre.

    about  the entry of the model concerned, as a path like ("joints", "A0"); empty for the whole mechanism or a motion.
           The reader of a file finds the line by it
    """

    def __init__(self, given: str, *, allowed: str = "", do: str = "", about: tuple[str, ...] = ()) -> None:
        self.about = about
        super().__init__(given, allowed=allowed, do=do)


class PictureError(IlmekError):
    """A picture that cannot be read or is not usable as a carpet."""


class YarnError(IlmekError):
    """A yarn list that cannot be read or used."""


class CarpetError(IlmekError):
    """A size, quality or knot that does not exist or does not fit."""


class LoomError(IlmekError):
    """A loom or a programme that cannot make this carpet."""


class OutputError(IlmekError):
    """A file or folder that cannot be written whole."""


def did_you_mean(name: str, known: Iterable[str], *, otherwise: str = "") -> str:
    """A hint with the known name nearest to a misspelt one; `otherwise` if none is near.

    >>> did_you_mean("lenght", ["length", "width"])
    "did you mean 'length'?"
    """
    nearest = difflib.get_close_matches(name[:100], list(known), n=1)
    return Sentence("hint.did-you-mean", name=nearest[0]) if nearest else otherwise


JOINERS = "\u200c\u200d"
"""Zero width non-joiner and joiner, which Persian and Indic words are written with: سرمه‌ای, navy blue."""


def is_printable(text: str) -> bool:
    r"""Whether a text has characters that can be printed, and joiners, and no others.

    >>> is_printable("سرمه\u200cای"), is_printable("two\nlines")
    (True, False)
    """
    return "".join(letter for letter in text if letter not in JOINERS).isprintable()


def printable(text: str) -> str:
    r"""The text as a terminal may show it: other blanks than line ends become spaces, control characters, marks of
    direction and halves of surrogate pairs become �.

    >>> printable("two\tlines\x1b[31m\nof text")
    'two lines�[31m\nof text'
    """
    if text.isprintable():
        return text
    return "".join(c if is_printable(c) or c == "\n" else " " if c.isspace() else "�" for c in text)


def encodable(text: str) -> str:
    """The text without halves of surrogate pairs, as in the name of a file that is not UTF-8: they become ?."""
    return text.encode("utf-8", "replace").decode("utf-8")


def shortened(text: str, most: int = 40) -> str:
    """The text in a message: at most so many characters.

    >>> shortened("a long text", 6)
    'a l...'
    """
    return text if len(text) <= most else f"{text[: most - 3]}..."


@contextmanager
def restated(kind: type[IlmekError], before: str = "", *, of: type[IlmekError] = IlmekError) -> Iterator[None]:
    """Raise errors of a class inside as errors of another, with words before what was given."""
    try:
        yield
    except of as error:
        raise kind(before + error.given if before else error.given, allowed=error.allowed, do=error.do) from None
