"""Progress of long work: a callable told the share done, 0 to 1."""

from collections.abc import Callable
from typing import TypeAlias

Progress: TypeAlias = Callable[[float], object]


def part(progress: Progress | None, start: float, end: float) -> Progress | None:
    """The progress of a part of the work, told as progress of the whole.

    >>> part(lambda share: print(share), 0.5, 1.0)(0.5)
    0.75
    """
    return None if progress is None else lambda share: progress(start + share * (end - start))
