"""Bobbins of weft: after how many rows each runs out, and the stops of the loom in which it is changed.

A bobbin that lasts R rows is changed before the loom rows R, 2 R, 3 R, ... ; the first is in the shuttle when the loom
starts. Bobbins that run out at the same row are changed in one stop, one after the other.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.errors import LoomError


@dataclass(frozen=True, slots=True)
class Bobbin:
    """A bobbin: name of its yarn, rows that it lasts, time to change it [s].

    Raises LoomError for less than a row, and for a time below 0 or not finite.
    """

    yarn: str
    rows: int
    time: float

    def __post_init__(self) -> None:
        if self.rows < 1 or not 0 <= self.time < float("inf"):
            raise LoomError(
                f"a bobbin of {self.yarn} for {self.rows} rows, changed in {self.time:g} s",
                allowed="at least a row, and a finite time of 0 s or more",
            )

    def changes(self, rows: int) -> int:
        """Changes while a number of rows is woven.

        >>> Bobbin("straight weft", 36, 90.0).changes(72), Bobbin("straight weft", 36, 90.0).changes(73)
        (1, 2)
        """
        return max(0, rows - 1) // self.rows


@dataclass(frozen=True, slots=True)
class ChangeStop:
    """A stop of the loom before a row, 0 at the carpet's bottom edge: yarns whose bobbins are changed, time [s]."""

    row: int
    yarns: tuple[str, ...]
    time: float


def change_stops(bobbins: Sequence[Bobbin], rows: int) -> tuple[ChangeStop, ...]:
    """All stops while a number of rows is woven, in order.

    >>> change_stops((Bobbin("straight weft", 2, 90.0), Bobbin("sinuous weft", 4, 90.0)), 5)[-1]
    ChangeStop(row=4, yarns=('straight weft', 'sinuous weft'), time=180.0)
    """
    at = sorted({number * bobbin.rows for bobbin in bobbins for number in range(1, bobbin.changes(rows) + 1)})
    due = {row: tuple(bobbin for bobbin in bobbins if row % bobbin.rows == 0) for row in at}
    return tuple(
        ChangeStop(row, tuple(one.yarn for one in ones), sum(one.time for one in ones)) for row, ones in due.items()
    )


def stop_count(bobbins: Sequence[Bobbin], rows: int) -> int:
    """Number of stops while a number of rows is woven.

    >>> stop_count((Bobbin("straight weft", 2, 90.0), Bobbin("sinuous weft", 3, 90.0)), 7)
    4
    """
    return len(
        np.unique(np.concatenate([np.arange(0), *(np.arange(bobbin.rows, rows, bobbin.rows) for bobbin in bobbins)]))
    )


def stop_time(bobbins: Sequence[Bobbin], rows: int) -> float:
    """Time of all stops [s] while a number of rows is woven."""
    return sum(bobbin.changes(rows) * bobbin.time for bobbin in bobbins)
