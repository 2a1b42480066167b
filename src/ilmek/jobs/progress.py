"""How a job tells how far it is."""

from collections.abc import Callable
from typing import TypeAlias

Told: TypeAlias = Callable[[str, float], None]
"""Called with what is being done and the share of the whole job that is done, 0 to 1."""


def part(told: Told | None, doing: str, start: float, end: float) -> Callable[[float], None] | None:
    """A progress callback for one part of a job, from the share `start` to `end` of the whole.

    >>> part(lambda doing, share: print(doing, share), "chart", 0.2, 0.6)(0.5)
    chart 0.2
    chart 0.4
    """
    if told is None:
        return None
    told(doing, start)
    return lambda share: told(doing, start + share * (end - start))
