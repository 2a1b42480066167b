"""Windows: ranges of the master angle, as sets on the circle of a turn."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

from ilmek.errors import ParameterError
from ilmek.units import turn

_SAME = 1e-12


@dataclass(frozen=True, slots=True)
class Window:
    """Master angles from `start`, in [0, 2 pi), to `end` [rad], which may lie in the next turn.

    Raises ParameterError unless 0 <= start < 2 pi and start < end <= start + 2 pi.
    """

    start: float
    end: float

    def __post_init__(self) -> None:
        if not (0 <= self.start < turn and self.start < self.end <= self.start + turn + _SAME):
            raise ParameterError(
                f"a window from {self.start:g} to {self.end:g} rad", allowed="a start in the turn, then an end"
            )

    @property
    def length(self) -> float:
        """Length [rad]."""
        return self.end - self.start


Windows: TypeAlias = tuple[Window, ...]
"""Disjoint windows, ascending."""

WHOLE: Windows = (Window(0.0, turn),)
"""The whole turn."""


def windows_of(spans: Iterable[tuple[float, float]]) -> Windows:
    """The union of spans (start, end) of master angles [rad] of any turn; touching spans are joined.

    >>> windows_of([(1.0, 2.0), (6.0, 6.5), (1.5, 3.0)])
    (Window(start=1.0, end=3.0), Window(start=6.0, end=6.5))
    """
    joined: list[list[float]] = []
    for start, end in sorted(_cut(spans)):
        if joined and start <= joined[-1][1] + _SAME:
            joined[-1][1] = max(joined[-1][1], end)
        else:
            joined.append([start, end])
    if len(joined) > 1 and joined[0][0] <= _SAME and joined[-1][1] >= turn - _SAME:
        joined[-1][1] = turn + joined.pop(0)[1]
    return tuple(Window(start, end) for start, end in joined)


def common(first: Windows, second: Windows) -> Windows:
    """The intersection: for two tools that exclude each other, the interference.

    >>> common((Window(6.0, 7.0),), (Window(0.5, 3.0),))
    (Window(start=0.5, end=0.7168146928204138),)
    """
    pairs = ((a, b) for a in _cut(_spans(first)) for b in _cut(_spans(second)))
    met = ((max(a[0], b[0]), min(a[1], b[1])) for a, b in pairs)
    return windows_of((start, end) for start, end in met if end > start)


def separation(first: Windows, second: Windows) -> float:
    """The least master angle [rad] between a window of one and a window of the other, in either direction.

    Negative where they overlap: the shift that separates them. A whole turn where one of them is empty.

    >>> round(separation((Window(1.0, 2.0),), (Window(2.5, 3.0),)), 12)
    0.5
    """
    return min((_apart(a, b) for a in first for b in second), default=turn)


def _apart(a: Window, b: Window) -> float:
    """Angle between the end of one and the start of the other; negative: the least shift that separates them."""
    ahead = (b.start - a.start) % turn
    after, before = ahead - a.length, turn - ahead - b.length
    if after + before < 0:  # no turn has room for both
        return after + before
    if after < 0:
        return -min(-after, ahead + b.length)
    return -min(-before, turn - ahead + a.length) if before < 0 else min(after, before)


def _spans(windows: Windows) -> Iterable[tuple[float, float]]:
    return ((window.start, window.end) for window in windows)


def _cut(spans: Iterable[tuple[float, float]]) -> Iterable[tuple[float, float]]:
    """The spans within the turn; those that run through its end are split."""
    for start, end in spans:
        if end - start >= turn:
            yield 0.0, turn
            continue
        shift = turn * (start // turn)
        if end - shift > turn:
            yield 0.0, end - shift - turn
        if start - shift < turn:
            yield start - shift, min(end - shift, turn)
