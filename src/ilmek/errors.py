"""What can go wrong, as a tree.

    IlmekError                  anything a user can mend; the command line prints it in one line and ends with 2
    ├── UnitError               a quantity that cannot be read, or has the wrong dimension
    ├── ParameterError          a machine parameter that is unknown, out of bounds or contradictory
    ├── MechanismError          a mechanism that cannot close, has no plan, or stands at a dead centre
    ├── PictureError            a picture that cannot be read or is not usable as a carpet
    ├── YarnError               a yarn list that cannot be read or used
    ├── CarpetError             a size, quality or knot that does not exist or does not fit
    ├── LoomError               a loom or programme that cannot make this carpet
    └── OutputError             a file or folder that cannot be written whole

A message says what was given, what is allowed and what to do, in that order.
"""

import difflib
from collections.abc import Iterable


class IlmekError(Exception):
    """A mistake that the user can mend.

    given    what was found wrong, with the value as the user wrote it
    allowed  what would be right ("" when the first part says it)
    do       the next step ("" when it is plain)
    """

    def __init__(self, given: str, *, allowed: str = "", do: str = "") -> None:
        self.given = given
        self.allowed = allowed
        self.do = do
        super().__init__("; ".join(part for part in (given, allowed, do) if part))


class UnitError(IlmekError):
    """A quantity that cannot be read, or has the wrong dimension."""


class ParameterError(IlmekError):
    """A parameter that is unknown, out of bounds or contradicts another."""


class MechanismError(IlmekError):
    """A mechanism that cannot close, cannot be solved, or stands at a dead centre.

    about  the entry of the model that is meant, as a path like ("joints", "A0"); empty where it is the whole, or a
           motion. A file's reader finds its line by it
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
    """The hint that names the known name nearest to a misspelt one; `otherwise` where none is near.

    >>> did_you_mean("lenght", ["length", "width"])
    "did you mean 'length'?"
    """
    near = difflib.get_close_matches(name, list(known), n=1)
    return f"did you mean {near[0]!r}?" if near else otherwise
