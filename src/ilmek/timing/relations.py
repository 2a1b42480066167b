"""What must hold between the tracks of a cyclogram: one instant after another, and never both in one place."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

from ilmek.errors import ParameterError
from ilmek.timing.windows import Windows
from ilmek.units import deg, format_quantity, turn

Units: TypeAlias = Mapping[str, str]
"""Unit to show the positions of a track in, by its name."""

LARGEST = 100 * turn
"""Largest gap between two moments [rad]."""

EDGES = ("start", "end", "event", "past", "angle")


@dataclass(frozen=True, slots=True)
class Moment:
    """An instant of a track, or of the turn.

    track, motion   a motion of a track, or an event of it
    edge            start or end of the motion; event; past: the motion passes position `at` [SI], the first time;
                    angle: none of a track, but the master angle `at` [rad]
    """

    track: str
    motion: str
    edge: str = "start"
    at: float = 0.0

    def said(self, units: Units) -> str:
        """The instant as a person says it; units of the positions by track."""
        if self.edge == "angle":
            return format_quantity(self.at, "deg")
        if self.edge == "past":
            return f"{self.track}: {self.motion} past {format_quantity(self.at, units.get(self.track, ''))}"
        edge = {"start": "starts", "end": "ends"}.get(self.edge, "")
        return f"{self.track}: {self.motion} {edge}".rstrip()


def fixed(angle: float) -> Moment:
    """A master angle [rad] as a moment."""
    return Moment("", "", "angle", angle)


@dataclass(frozen=True, slots=True)
class Relation:
    """`then` comes at least `gap` and at most `most` [rad of the master] after `first`; `why` says what it guards.

    turns   how many turns later `then` is meant: 1 for the next knot's
    delay   time [s] on top of `gap`, for what does not go with the master: a valve, a magnet
    """

    then: Moment
    first: Moment
    gap: float
    why: str
    most: float = math.inf
    turns: int = 0
    delay: float = 0.0

    def __post_init__(self) -> None:
        if not (self.gap <= self.most and self.gap < math.inf and 0 <= self.delay < math.inf):
            raise ParameterError(
                f"{self.said({})}: at least {self.gap / deg:g} deg, at most {self.most / deg:g} deg",
                allowed="no more at least than at most, and a delay of 0 s or more",
            )
        _require_small(self.gap if self.gap > -math.inf else 0.0)
        _require_small(self.most if self.most < math.inf else 0.0)

    def said(self, units: Units) -> str:
        """The relation without its numbers; units of the positions by track."""
        later = {0: "", 1: " of the turn before"}.get(self.turns, f" of {self.turns} turns before")
        return f"{self.then.said(units)} after {self.first.said(units)}{later}"


def _require_small(gap: float) -> None:
    if not abs(gap) <= LARGEST:
        raise ParameterError(f"a gap of {gap / deg:g} deg", allowed=f"{LARGEST / turn:g} turns at most")


@dataclass(frozen=True, slots=True)
class Zone:
    """A track strictly between two positions [SI]: a tool in a place that another needs too."""

    track: str
    low: float = -math.inf
    high: float = math.inf
    name: str = ""

    def said(self, units: Units) -> str:
        """The zone as a person says it; units of the positions by track."""
        if self.name:
            return f"{self.track} {self.name}"
        low, high = (format_quantity(end, units.get(self.track, "")) for end in (self.low, self.high))
        if math.isinf(self.high):
            return f"{self.track} anywhere" if math.isinf(self.low) else f"{self.track} beyond {low}"
        return f"{self.track} below {high}" if math.isinf(self.low) else f"{self.track} between {low} and {high}"


@dataclass(frozen=True, slots=True)
class Spans:
    """Fixed windows of the master angle, from the geometry of what the master itself turns; see `interference`."""

    name: str
    windows: Windows

    def said(self, units: Units) -> str:  # noqa: ARG002 - as every presence is asked
        """Its name."""
        return self.name


Presence: TypeAlias = Zone | Spans
"""When something is in a place."""


@dataclass(frozen=True, slots=True)
class Exclusion:
    """Never both: between the windows of two presences lie at least `gap` [rad of the master]; `why` says why."""

    first: Presence
    second: Presence
    gap: float = 0.0
    why: str = "never both"

    def __post_init__(self) -> None:
        _require_small(self.gap)

    def said(self, units: Units) -> str:
        """The exclusion without its number; units of the positions by track."""
        return f"never both {self.first.said(units)} and {self.second.said(units)}"
