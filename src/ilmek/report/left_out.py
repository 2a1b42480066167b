"""What illustrates a result never stops a job: a figure, a picture or a page that cannot be made is left out, with a
warning that names it.

With the environment variable ILMEK_LEAVE_NOTHING_OUT set, the error is raised: the tests set it, so that a defect of
ours never hides behind the guard.
"""

import os
from collections.abc import Callable, Iterable
from functools import partial
from typing import TypeAlias, TypeVar

from ilmek.errors import OutputError
from ilmek.progress import Cancelled
from ilmek.report.figure import Figure

T = TypeVar("T")

LazyFigure: TypeAlias = partial[Figure]
"""A figure that is yet to be made: a partial of a function with the figure's name."""

SWITCH = "ILMEK_LEAVE_NOTHING_OUT"
"""Environment variable that turns the guard off."""

_LONGEST = 200
"""Largest number of characters of a reason."""


def made_or_left_out(what: str, make: Callable[[], T], left_out: list[str]) -> T | None:
    """What `make` returns; where it raises, None, and a warning is appended to `left_out`.

    what  name of the thing in the warning: "figure 'Weaving time'", "report.html"
    Raises Cancelled, and OSError and OutputError, which concern the job's files and not the thing.
    """
    try:
        return make()
    except (Cancelled, OSError, OutputError):
        raise
    except Exception as error:
        # The guard for every defect of a figure; `SWITCH` shows them.
        if os.environ.get(SWITCH):
            raise
        reason = next(iter(str(error).splitlines()), "") or type(error).__name__
        left_out.append(f"{what} is left out: {reason[:_LONGEST]}")
        return None


def made_figures(make: Callable[[], Iterable[Figure | LazyFigure]], left_out: list[str]) -> tuple[Figure, ...]:
    """The figures that can be made. A lazy one is left out alone; an error in `make` leaves out all."""
    figures = []
    for each in made_or_left_out("every figure", lambda: tuple(make()), left_out) or ():
        if not isinstance(each, partial):
            figures.append(each)
        elif figure := made_or_left_out(f"figure {each.func.__name__.replace('_', ' ')!r}", each, left_out):
            figures.append(figure)
    return tuple(figures)
