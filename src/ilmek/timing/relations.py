"""Relations between the tracks of a cyclogram: an instant after another, and exclusions of two presences."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

from ilmek.errors import ParameterError
from ilmek.timing.windows import Windows
from ilmek.units import deg, format_quantity, turn

Units: TypeAlias = Mapping[str, str]
"""Display unit of the positions of a track, by its name."""

LARGEST = 100 * turn
"""Largest gap between two moments [rad]."""


@dataclass(frozen=True, slots=True)
class Moment:
    """An instant of a track, or of the turn.

    track, motion   a motion of a track, or an event of it
    edge            start or end of the motion; event; past: the motion first passes the position `at` [SI];
                    angle: the master angle `at` [rad], without a track
    """

    track: str
    motion: str
    edge: str = "start"
    at: float = 0.0

    def label(self, units: Units) -> str:
        """The instant in words; units: display units by track."""
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
    """`then` comes at least `gap` and at most `most` [rad of the master] after `first`.

    why     the reason, for the report
    turns   whole turns by which `then` is later: 1 for that of the next knot
    delay   time [s] added to `gap`, for actuators with a delay of their own: a valve, a magnet
    Raises ParameterError where gap > most or delay < 0, and for gaps above 100 turns.
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
                f"{self.label({})}: at least {self.gap / deg:g} deg, at most {self.most / deg:g} deg",
                allowed="the least gap at most the greatest, and a delay of 0 s or more",
            )
        _require_small(self.gap if self.gap > -math.inf else 0.0)
        _require_small(self.most if self.most < math.inf else 0.0)

    def label(self, units: Units) -> str:
        """The relation in words, without its numbers; units: display units by track."""
        later = {0: "", 1: " of the turn before"}.get(self.turns, f" of {self.turns} turns before")
        return f"{self.then.label(units)} after {self.first.label(units)}{later}"


def _require_small(gap: float) -> None:
    if not abs(gap) <= LARGEST:
        raise ParameterError(f"a gap of {gap / deg:g} deg", allowed=f"{LARGEST / turn:g} turns at most")


@dataclass(frozen=True, slots=True)
class Zone:
    """The presence of a track strictly between two positions [SI], for example a tool in the space of another."""

    track: str
    low: float = -math.inf
    high: float = math.inf
    name: str = ""

    def label(self, units: Units) -> str:
        """The zone in words; units: display units by track."""
        if self.name:
            return f"{self.track} {self.name}"
        low, high = (format_quantity(end, units.get(self.track, "")) for end in (self.low, self.high))
        if math.isinf(self.high):
            return f"{self.track} anywhere" if math.isinf(self.low) else f"{self.track} beyond {low}"
        return f"{self.track} below {high}" if math.isinf(self.low) else f"{self.track} between {low} and {high}"


@dataclass(frozen=True, slots=True)
class Spans:
    """Fixed windows of the master angle [rad], from the geometry of a linkage on the master; see `interference`."""

    name: str
    windows: Windows

    def label(self, units: Units) -> str:  # noqa: ARG002 - the signature of a presence
        """Its name."""
        return self.name


Presence: TypeAlias = Zone | Spans
"""Presence of a tool in a region, over the master angle."""


@dataclass(frozen=True, slots=True)
class Exclusion:
    """Two presences exclude each other: their windows are at least `gap` [rad of the master] apart.

    why  the reason, for the report
    Raises ParameterError for a gap above 100 turns.
    """

    first: Presence
    second: Presence
    gap: float = 0.0
    why: str = "never both"

    def __post_init__(self) -> None:
        _require_small(self.gap)

    def label(self, units: Units) -> str:
        """The exclusion in words, without its number; units: display units by track."""
        return f"never both {self.first.label(units)} and {self.second.label(units)}"
