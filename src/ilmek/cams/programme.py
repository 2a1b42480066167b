"""A cam's programme: rises, falls and dwells that fill one turn.

    s(theta) = base + change * law.s(u),   u = (theta - begin) / span     within each segment

>>> from ilmek.cams.laws import LAWS
>>> shed = Programme((rise(math.pi / 2, 0.06, LAWS["harmonic"]), fall(math.pi / 2, 0.06, LAWS["harmonic"]),
...                   dwell(math.pi)))
>>> float(shed.at(np.array(math.pi / 2)).s)
0.06
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import REST, Law
from ilmek.errors import ParameterError
from ilmek.units import deg, format_quantity

TURN = 2 * math.pi
_FIT = 1e-9


class Course(NamedTuple):
    """Displacement [m] and its derivatives by the cam angle [m/rad, m/rad^2, m/rad^3]; times w, w^2, w^3 by time."""

    s: FloatArray
    ds: FloatArray
    dds: FloatArray
    ddds: FloatArray


@dataclass(frozen=True, slots=True)
class Segment:
    """A part of the turn: `change` [m] of the follower over `span` [rad] by a law."""

    name: str
    span: float
    change: float
    law: Law


@dataclass(frozen=True, slots=True)
class Jump:
    """A step in a derivative by the cam angle: of `order` 2 the acceleration [m/rad^2]."""

    angle: float
    order: int
    before: float
    after: float
    place: str


def rise(span: float, lift: float, law: Law) -> Segment:
    """The follower goes `lift` [m] outwards over `span` [rad]."""
    return Segment("rise", span, lift, law)


def fall(span: float, lift: float, law: Law) -> Segment:
    """The follower comes back by `lift` [m] over `span` [rad]."""
    return Segment("fall", span, -lift, law)


def dwell(span: float) -> Segment:
    """The follower stands still over `span` [rad]."""
    return Segment("dwell", span, 0.0, REST)


@dataclass(frozen=True, slots=True)
class Programme:
    """Segments that fill one turn and come back to where they began.

    start  cam angle [rad] where the first segment begins
    Raises ParameterError where the segments do not fill the turn, or do not come back.
    """

    segments: tuple[Segment, ...]
    start: float = 0.0

    def __post_init__(self) -> None:
        spans = [segment.span for segment in self.segments]
        if min(spans, default=0.0) <= 0 or abs(sum(spans) - TURN) > _FIT:
            said = " + ".join(f"{segment.name} {format_quantity(segment.span / deg, '')}" for segment in self.segments)
            raise ParameterError(
                f"a cam of {said or 'no parts'} degrees", allowed="its parts must add up to 360 degrees"
            )
        left = sum(segment.change for segment in self.segments)
        if abs(left) > _FIT * max(abs(segment.change) for segment in self.segments):
            shown = format_quantity(left, "mm")
            raise ParameterError(f"the follower ends a turn {shown} from where it began", allowed="it must come back")

    def shifted(self, angle: float) -> "Programme":
        """The same programme, later by `angle` [rad]."""
        return replace(self, start=self.start + angle)

    @property
    def edges(self) -> FloatArray:
        """Where each segment begins, and where the last ends, from the start [rad]."""
        ends = np.cumsum([segment.span for segment in self.segments[:-1]])
        return np.concatenate(([0.0], ends, [TURN]))

    @property
    def knots(self) -> FloatArray:
        """Cam angles [rad], ascending over one turn, between which the motion is smooth."""
        inner = [
            begin + at * segment.span
            for begin, segment in zip(self.edges, self.segments, strict=False)
            for at in (0.0, *segment.law.breaks)
        ]
        return self.start + np.array([*inner, TURN])

    def at(self, angle: FloatArray) -> Course:
        """Motion at cam angles [rad] of any shape and any turn; at a boundary, that of the segment which begins."""
        phase = np.mod(angle - self.start, TURN)
        edges = self.edges
        index = np.searchsorted(edges[1:-1], phase, side="right")
        out = np.empty((4, *phase.shape))
        base = 0.0
        for i, segment in enumerate(self.segments):
            here = index == i
            out[:, here] = _course(segment, base, (phase[here] - edges[i]) / segment.span)
            base += segment.change
        return Course(*out)


def jumps(programme: Programme, order: int = 2) -> tuple[Jump, ...]:
    """Where the derivative of `order` (1 velocity, 2 acceleration, 3 jerk) jumps, in the order of the cam angle."""
    segments = programme.segments
    found = []
    for i, segment in enumerate(segments):
        previous = segments[i - 1]
        begin = programme.start + float(programme.edges[i])
        place = f"from {previous.name} to {segment.name}"
        found.append(Jump(begin, order, _one_side(previous, 1.0, order), _one_side(segment, 0.0, order), place))
        for u in segment.law.breaks:
            before, after = (_one_side(segment, float(np.nextafter(u, side)), order) for side in (0.0, 1.0))
            found.append(Jump(begin + u * segment.span, order, before, after, f"inside the {segment.name}"))
    scale = max(abs(segment.change) / segment.span**order for segment in segments)
    return tuple(jump for jump in found if abs(jump.after - jump.before) > _FIT * scale)


def _course(segment: Segment, base: float, u: FloatArray) -> FloatArray:
    """Rows s, s', s'', s''' at u in [0, 1] of a segment that begins at displacement `base`."""
    u = np.clip(u, 0.0, 1.0)
    law, step = segment.law, segment.change
    rows = (law.s(u), law.v(u) / segment.span, law.a(u) / segment.span**2, law.j(u) / segment.span**3)
    out = step * np.stack([np.asarray(row) for row in rows])
    out[0] += base
    return out


def _one_side(segment: Segment, u: float, order: int) -> float:
    return float(_course(segment, 0.0, np.array(u))[order])
