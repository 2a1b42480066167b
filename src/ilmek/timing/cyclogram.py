"""The cyclogram: every actuator's track on one master shaft, and the relations that must hold between them."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ilmek.errors import ParameterError
from ilmek.report import Check, Lane, Mark, Timing, at_least
from ilmek.timing.track import Event, Segment, Track, sample
from ilmek.units import deg, turn

__all__ = ["Cyclogram", "Event", "Moment", "Relation", "Segment", "Track", "check", "check_all", "draw", "moment_angle"]


@dataclass(frozen=True, slots=True)
class Cyclogram:
    """Tracks over one turn of the master shaft, which takes `period` [s].

    Raises ParameterError for a period that is not positive or two tracks of one name.
    """

    name: str
    period: float
    tracks: tuple[Track, ...]

    def __post_init__(self) -> None:
        if not self.period > 0:
            raise ParameterError(f"{self.name}: period {self.period:g} s", allowed="above 0 s")
        names = [track.name for track in self.tracks]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise ParameterError(f"{self.name}: two tracks are named {twice!r}", do="give each its own name")

    def track(self, name: str) -> Track:
        """The track of that name. Raises ParameterError where there is none."""
        for track in self.tracks:
            if track.name == name:
                return track
        known = ", ".join(track.name for track in self.tracks)
        raise ParameterError(f"{self.name} has no track {name!r}", allowed=f"its tracks: {known}")

    @property
    def speed(self) -> float:
        """Speed of the master shaft [rad/s]."""
        return turn / self.period


@dataclass(frozen=True, slots=True)
class Moment:
    """An instant of a track: the start or end of one of its motions, or an event; `edge` is start, end or event."""

    track: str
    motion: str
    edge: str = "start"


@dataclass(frozen=True, slots=True)
class Relation:
    """`then` comes at least `gap` [rad of the master] after `first`, within one turn; `why` says what it guards."""

    then: Moment
    first: Moment
    gap: float
    why: str


def moment_angle(cyclogram: Cyclogram, moment: Moment) -> float:
    """Master angle of a moment [rad]. Raises ParameterError for a track, motion, event or edge that is not there."""
    track = cyclogram.track(moment.track)
    if moment.edge in ("start", "end"):
        segment = track.segment(moment.motion)
        return segment.start if moment.edge == "start" else segment.end
    for event in track.events:
        if moment.edge == "event" and event.name == moment.motion:
            return event.angle
    known = ", ".join(event.name for event in track.events)
    raise ParameterError(f"{track.name} has no {moment.edge} {moment.motion!r}", allowed=f"its events: {known}")


def check(cyclogram: Cyclogram, relation: Relation) -> Check:
    """The gap between the two moments of a relation [rad] against what it demands."""
    gap = moment_angle(cyclogram, relation.then) - moment_angle(cyclogram, relation.first)
    name = f"{_said(relation.then)} after {_said(relation.first)}"
    return at_least(name, round(gap, 12), round(relation.gap, 12), "deg", relation.why)


def check_all(cyclogram: Cyclogram, relations: Iterable[Relation]) -> tuple[Check, ...]:
    """A check for each relation, in order."""
    return tuple(check(cyclogram, relation) for relation in relations)


def draw(cyclogram: Cyclogram, title: str, note: str = "", step: float = 1 * deg) -> Timing:
    """The cyclogram as a figure: each track as a share of its stroke, sampled each `step` [rad] and at every joint."""
    lanes = tuple(_lane(track, step) for track in cyclogram.tracks)
    return Timing(cyclogram.name, title, cyclogram.period, lanes, note)


def _lane(track: Track, step: float) -> Lane:
    joints = [angle for segment in track.segments for angle in (segment.start, segment.end)]
    angle = np.unique(np.concatenate([np.linspace(0, turn, round(turn / step) + 1), np.clip(joints, 0, turn)]))
    position = sample(track, angle).position
    share = (position - position.min()) / (track.stroke or 1.0)
    return Lane(track.name, track.actuator, angle, share, tuple(Mark(e.angle, e.name) for e in track.events))


def _said(moment: Moment) -> str:
    edge = {"start": "starts", "end": "ends", "event": ""}[moment.edge]
    return f"{moment.track}: {moment.motion} {edge}".rstrip()
