"""A track of a cyclogram: the motion of one actuator over one turn of the master shaft.

    position(q) = begin + (finish - begin) s(u),      u = (q - start)/(end - start)            inside a segment
    position(q) = where the last segment ended                                                 between them: a dwell

Over the master angle q the derivatives are h/beta v(u) and h/beta^2 a(u), with h = finish - begin and
beta = end - start; over time they are multiplied by w and w^2, w = 2 pi / period. The last motion may run through the
end of the turn into the next.
"""

import itertools
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Protocol, TypeAlias, runtime_checkable

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.errors import ParameterError
from ilmek.records import record, value_record
from ilmek.units import format_quantity, turn

Curve: TypeAlias = Callable[[RealField], RealField]
_SAME = 1e-9
_INSIDE = 1e-12
"""Share of a motion by which a jump is approached from either side."""


@runtime_checkable
class MotionLaw(Protocol):
    """A rise of 1 in a time of 1: s, v, a on u in [0, 1], and peaks. `ilmek.cams.laws.Law` is one."""

    def __hash__(self) -> int:
        """A law is compared by identity, or by its values."""

    @property
    def name(self) -> str:
        """The law's name, as written in files."""

    @property
    def s(self) -> Curve:
        """Displacement: from 0 at u = 0 to 1 at u = 1."""

    @property
    def v(self) -> Curve:
        """First derivative."""

    @property
    def a(self) -> Curve:
        """Second derivative."""

    @property
    def j(self) -> Curve:
        """Third derivative."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Values of u inside the motion where a or j jumps."""

    @property
    def velocity_peak(self) -> float:
        """Largest |v|."""

    @property
    def acceleration_peak(self) -> float:
        """Largest |a|; inf where the velocity jumps."""

    @property
    def jerk_peak(self) -> float:
        """Largest third derivative; inf where the acceleration jumps."""

    @property
    def lowest(self) -> float:
        """Least s: below 0 for a law that overshoots."""

    @property
    def highest(self) -> float:
        """Largest s."""

    @property
    def parameters(self) -> Mapping[str, float | tuple[float, ...]]:
        """The law's parameters, as written in files."""


@value_record
class TrackSegment:
    """A motion from `begin` to `finish` [SI] while the master turns from `start` to `end` [rad], by a law."""

    name: str
    start: float
    end: float
    begin: float
    finish: float
    law: MotionLaw

    @property
    def stroke(self) -> float:
        """Displacement [SI], signed."""
        return self.finish - self.begin

    @property
    def beta(self) -> float:
        """Master angle of the motion [rad]."""
        return self.end - self.start

    def angle(self, share: float) -> float:
        """Master angle [rad] at a share [-] of its time."""
        return self.start + share * self.beta


@dataclass(frozen=True, slots=True)
class TrackEvent:
    """A named instant of a track: master angle [rad].

    on, share   a motion, and the share [-] of its time at which the event occurs: the event follows that motion;
                default: the event is independent
    """

    name: str
    angle: float
    on: str = ""
    share: float = 0.0


def riding(name: str, segment: TrackSegment, share: float = 1.0) -> TrackEvent:
    """The event at a share [-] of a motion's time: 0 at its start, 1 at its end."""
    return TrackEvent(
        name, segment.angle(share) % turn if segment.end > turn else segment.angle(share), segment.name, share
    )


@dataclass(frozen=True, slots=True)
class ActuatorLimits:
    """Limits of an actuator: speed, acceleration and jerk [SI/s, SI/s^2, SI/s^3], least time of a motion [s].

    Raises ParameterError for a limit that is not positive, and for a time below 0.
    """

    speed: float = math.inf
    acceleration: float = math.inf
    jerk: float = math.inf
    time: float = 0.0

    def __post_init__(self) -> None:
        for name in ("speed", "acceleration", "jerk"):
            if not getattr(self, name) > 0:
                raise ParameterError(f"{name} limit {getattr(self, name):g}", allowed="above 0; omit it for none")
        if not 0 <= self.time < math.inf:
            raise ParameterError(f"least time of a motion {self.time:g} s", allowed="0 s or more")


@value_record
class Track:
    """One actuator over a turn of the master shaft.

    segments   its motions, ascending and apart; dwells are implied between them
    unit       display unit of the positions (SI inside)
    revolves   the position may change by a whole number of these per turn (a rotating shaft) [SI]; 0: it must return
    limits     of its actuator
    locked     the solver does not change the track

    Raises ParameterError where segments overlap, leave the turn, do not join, or do not return, and where an event is
    not at the given share of its motion.
    """

    name: str
    actuator: str
    segments: tuple[TrackSegment, ...]
    events: tuple[TrackEvent, ...] = ()
    unit: str = "mm"
    revolves: float = 0.0
    limits: ActuatorLimits = ActuatorLimits()
    locked: bool = False

    def __post_init__(self) -> None:
        names = [segment.name for segment in self.segments]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise ParameterError(f"{self.name}: two motions are named {twice!r}", do="give each its own name")
        for segment in self.segments:
            _require_inside(self, segment)
        for first, then in zip(self.segments, self.segments[1:], strict=False):
            _require_apart(self.name, first, then)
            _require_joined(self, first, then, 0.0)
        if self.segments:
            _require_joined(self, self.segments[-1], self.segments[0], self.revolves)
        for event in self.events:
            _require_event(self, event)

    def segment(self, name: str) -> TrackSegment:
        """The motion of that name. Raises ParameterError where there is none."""
        for segment in self.segments:
            if segment.name == name:
                return segment
        known = ", ".join(segment.name for segment in self.segments)
        raise ParameterError(f"{self.name} has no motion {name!r}", allowed=f"its motions: {known}")

    def event(self, name: str) -> TrackEvent:
        """The event of that name. Raises ParameterError where there is none."""
        for event in self.events:
            if event.name == name:
                return event
        known = ", ".join(event.name for event in self.events) or "none"
        raise ParameterError(f"{self.name} has no event {name!r}", allowed=f"its events: {known}")

    @property
    def gain(self) -> float:
        """Change of the position per turn [SI]: 0, or a whole multiple of `revolves`."""
        return self.segments[-1].finish - self.segments[0].begin if self.segments and self.revolves else 0.0

    @property
    def stroke(self) -> float:
        """Largest minus least position [SI]."""
        ends = [part.begin + s * part.stroke for part in self.segments for s in (part.law.lowest, part.law.highest)]
        return max(ends) - min(ends) if ends else 0.0


@record
class TrackMotion:
    """Position of a track [SI] at master angles [rad], and its derivatives by the angle [SI/rad, SI/rad^2]."""

    angle: FloatArray
    position: FloatArray
    slope: FloatArray
    bend: FloatArray


def sample(track: Track, angle: FloatArray) -> TrackMotion:
    """The track's motion at master angles in [0, 2 pi] [rad]; at the joint of two segments, that of the later one."""
    position = np.full(angle.shape, track.segments[0].begin if track.segments else 0.0)
    slope, bend = np.zeros(angle.shape), np.zeros(angle.shape)
    for segment in laid(track):
        after = angle >= segment.start
        position[after], slope[after], bend[after] = segment.finish, 0.0, 0.0
        within = after & (angle <= segment.end)
        stroke, beta = segment.stroke, segment.beta
        u = (angle[within] - segment.start) / beta
        position[within] = segment.begin + stroke * segment.law.s(u)
        slope[within] = stroke / beta * segment.law.v(u)
        bend[within] = stroke / beta**2 * segment.law.a(u)
    return TrackMotion(angle, position, slope, bend)


@record
class TrackCurves:
    """Curves of a track over the turn: master angles [rad], position [SI], and its derivatives by the angle.

    Where a derivative jumps, its angle occurs twice: with the value before, and with that after.
    """

    angle: FloatArray
    position: FloatArray
    slope: FloatArray
    bend: FloatArray
    jolt: FloatArray


def curves(track: Track, steps: int) -> TrackCurves:
    """The curves of a track with all jumps; steps: of a turn, in motion (a dwell has its ends alone)."""
    parts = [part for segment in laid(track) for part in _smooth(segment, steps)]
    parts += _dwells(track, parts)
    rows = sorted(parts, key=lambda one: (float(one[0, 0]), float(one[0, -1])))
    return TrackCurves(*np.concatenate(rows, axis=1))


def _smooth(segment: TrackSegment, steps: int) -> Iterator[FloatArray]:
    """Rows of the curves of a motion within the turn, one array between two jumps."""
    stroke, beta = segment.stroke, segment.beta
    shares = [0.0, *(u for u in segment.law.breaks if 0.0 < u < 1.0), 1.0]
    for first, last in itertools.pairwise(shares):
        low, high = max(segment.angle(first), 0.0), min(segment.angle(last), turn)
        if high <= low:
            continue
        angle = np.linspace(low, high, max(2, math.ceil((high - low) / turn * steps) + 1))
        u = np.clip((angle - segment.start) / beta, first + _INSIDE, last - _INSIDE)
        law = segment.law
        rates = (stroke / beta**order * one(u) for order, one in enumerate((law.s, law.v, law.a, law.j)))
        position, *derivatives = (np.broadcast_to(rate, angle.shape) for rate in rates)
        yield np.stack([angle, segment.begin + position, *derivatives])


def _dwells(track: Track, moving: list[FloatArray]) -> list[FloatArray]:
    """Rows of the curves between the motions."""
    at = track.segments[0].begin if track.segments else 0.0
    dwells, last = [], 0.0
    for one in sorted(moving, key=lambda row: float(row[0, 0])):
        if one[0, 0] > last + _SAME:
            dwells.append(_still(last, float(one[0, 0]), at))
        last, at = float(one[0, -1]), float(one[1, -1])
    if last < turn - _SAME:
        dwells.append(_still(last, turn, at))
    return dwells


def _still(low: float, high: float, at: float) -> FloatArray:
    return np.array([[low, high], [at, at], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]])


def laid(track: Track) -> Iterator[TrackSegment]:
    """The motions over the turn; one that runs through its end appears at the start of the turn too."""
    last = track.segments[-1] if track.segments else None
    if last is not None and last.end > turn + _SAME:
        gone = track.gain
        yield replace(
            last, start=last.start - turn, end=last.end - turn, begin=last.begin - gone, finish=last.finish - gone
        )
    yield from track.segments


def joints(track: Track) -> FloatArray:
    """Master angles in [0, 2 pi] [rad], ascending with both ends, between which the track is smooth."""
    ends = [angle for segment in laid(track) for angle in (segment.start, segment.end)]
    return np.unique(np.clip(np.array([0.0, *ends, turn]), 0.0, turn))


def peak_speed(track: Track, period: float) -> float:
    """Largest speed of the track [SI/s] at a period of the master shaft [s]: max |h| v_peak (w/beta)."""
    w = turn / period
    return max((abs(part.stroke) * part.law.velocity_peak * w / part.beta for part in track.segments), default=0.0)


def peak_acceleration(track: Track, period: float) -> float:
    """Largest acceleration of the track [SI/s^2] at a period of the master shaft [s]: max |h| a_peak (w/beta)^2."""
    w = turn / period
    peaks = (abs(part.stroke) * part.law.acceleration_peak * (w / part.beta) ** 2 for part in track.segments)
    return max(peaks, default=0.0)


def peak_jerk(track: Track, period: float) -> float:
    """Largest jerk of the track [SI/s^3] at a period of the master shaft [s]: max |h| j_peak (w/beta)^3."""
    w = turn / period
    return max((abs(part.stroke) * part.law.jerk_peak * (w / part.beta) ** 3 for part in track.segments), default=0.0)


def shortest_period(track: Track, speed_limit: float, acceleration_limit: float) -> float:
    """The shortest period of the master shaft [s] at which the track keeps both limits [SI/s, SI/s^2].

    Speeds are proportional to 1/T and accelerations to 1/T^2, so T = max(V(1 s)/V_limit, sqrt(A(1 s)/A_limit)) s.
    """
    return max(peak_speed(track, 1.0) / speed_limit, math.sqrt(peak_acceleration(track, 1.0) / acceleration_limit))


def _shown(angle: float) -> str:
    return format_quantity(angle, "deg")


def _require_inside(track: Track, segment: TrackSegment) -> None:
    first = track.segments[0].start
    if segment.start >= turn or not 0 <= segment.start < segment.end <= turn + max(first, 0.0) + _SAME:
        raise ParameterError(
            f"{track.name}: {segment.name} runs from {_shown(segment.start)} to {_shown(segment.end)}",
            allowed="a motion starts before it ends, within 0..360 deg; the last may run on to where the first starts",
            do="move the start or the end",
        )


def _require_event(track: Track, event: TrackEvent) -> None:
    if not 0 <= event.angle <= turn:
        raise ParameterError(f"{track.name}: event {event.name!r} at {_shown(event.angle)}", allowed="0..360 deg")
    if event.on:
        rides = track.segment(event.on).angle(event.share)
        off = (event.angle - rides) / turn
        if not 0 <= event.share <= 1 or abs(off - round(off)) > _SAME:
            raise ParameterError(
                f"{track.name}: event {event.name!r} at {_shown(event.angle)}, {event.share:g} of {event.on}",
                allowed=f"a share from 0 to 1, here {_shown(rides)}",
            )


def _require_apart(track: str, first: TrackSegment, then: TrackSegment) -> None:
    if then.start < first.end - _SAME:
        raise ParameterError(
            f"{track}: {then.name} starts at {_shown(then.start)}, before {first.name} ends at {_shown(first.end)}",
            allowed="the motions of one track follow each other",
            do=f"start {then.name} {_shown(first.end - then.start)} later",
        )


def _require_joined(track: Track, first: TrackSegment, then: TrackSegment, revolves: float) -> None:
    gap = first.finish - then.begin
    if revolves:
        gap -= revolves * round(gap / revolves)
    if abs(gap) > _SAME:
        raise ParameterError(
            f"{track.name}: {first.name} ends at {format_quantity(first.finish, track.unit)}, "
            f"{then.name} begins at {format_quantity(then.begin, track.unit)}",
            allowed="a track never jumps, nor from the end of the turn to its beginning",
            do="start one at the end of the other",
        )
