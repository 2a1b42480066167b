"""Programme of a cam: rises, falls, dwells and parts of constant speed that fill one turn.

    s(theta) = base + change * law.s(u),   u = (theta - begin) / span     within each segment

Angles in rad; s in m, or in rad for an arm; its derivatives by the cam angle. [continuity at the joints: the
fundamental law of cam design, Norton, Cam Design and Manufacturing]

>>> from ilmek.cams.laws import LAWS
>>> shed = CamProgramme((rise(math.pi / 2, 0.06, LAWS["harmonic"]), fall(math.pi / 2, 0.06, LAWS["harmonic"]),
...                   dwell(math.pi)))
>>> float(shed.at(np.array(math.pi / 2)).s)
0.06
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ilmek.arguments import Arguments, Quantities
from ilmek.arrays import FloatArray
from ilmek.cams.segments import CamSegment, OpenSegment, blend, bounds, dwell, even, fall, free, rise
from ilmek.errors import ParameterError
from ilmek.records import value_record
from ilmek.report.framed import Framed
from ilmek.units import deg, format_quantity

__all__ = [
    "TURN",
    "CamProgramme",
    "CamSegment",
    "FollowerMotion",
    "Jump",
    "OpenSegment",
    "all_jumps",
    "blend",
    "dwell",
    "even",
    "fall",
    "free",
    "joined",
    "jumps",
    "rise",
]

TURN = 2 * math.pi
_FIT = 1e-9
_WHOLE = 4.5e-16
_GIVEN, _CAM = Arguments("a cam's programme"), Arguments("the cam")
_DERIVATIVES = ("", "velocity", "acceleration", "jerk")


class FollowerMotion(NamedTuple):
    """Displacement [m] and its derivatives by the cam angle [m/rad, m/rad^2, m/rad^3], arrays of one shape.

    The derivatives by time are these times w, w^2, w^3, with the speed w of the cam.
    """

    s: FloatArray
    ds: FloatArray
    dds: FloatArray
    ddds: FloatArray


@dataclass(frozen=True, slots=True)
class Jump:
    """A step of a derivative by the cam angle.

    angle  cam angle [rad]            order  of the derivative: 1 velocity, 2 acceleration, 3 jerk
    before, after  values [m/rad^order]      where  the parts it lies between or in
    """

    angle: float
    order: int
    before: float
    after: float
    where: str

    def __str__(self) -> str:
        """`the acceleration jumps from 0 to 0.12 m/rad^2 at 90 deg, from dwell to rise`."""
        power = f"^{self.order}" if self.order > 1 else ""
        step = f"from {self.before:.4g} to {self.after:.4g} m/rad{power}"
        at = format_quantity(self.angle % TURN, "deg")
        return f"the {_DERIVATIVES[self.order]} jumps {step} at {at}, {self.where}"


@value_record
class CamProgramme(Framed):
    """Segments that fill one turn and return to the initial displacement.

    start     cam angle [rad] where the first segment begins
    revolves  displacement gained per turn [m], for example of an indexing table; 0: the follower returns
    Raises ParameterError where the segments do not fill the turn or do not return, or a law does not go from 0 to 1.

    >>> shed = CamProgramme((rise(2.0, 0.06, "harmonic"), fall(2.0, 0.06, "harmonic"), dwell(TURN - 4.0)))
    >>> float(shed.at(2.0).s), float(shed.at("1rad").ds) > 0
    (0.06, True)
    """

    segments: tuple[CamSegment, ...]
    start: float = 0.0
    revolves: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "segments", _GIVEN.sequence("segments", self.segments, CamSegment))
        object.__setattr__(self, "start", _GIVEN.number("start", self.start, "rad"))
        object.__setattr__(self, "revolves", _GIVEN.number("revolves", self.revolves, "m"))
        _check_turn(self.segments)
        _check_laws(self.segments)
        left = sum(segment.change for segment in self.segments) - self.revolves
        if abs(left) > _FIT * max(abs(segment.change) for segment in self.segments):
            shown = format_quantity(left, "mm")
            if self.revolves:
                gains = format_quantity(self.revolves, "mm")
                raise ParameterError(f"the parts of a turn miss revolves={gains} by {shown}", do="change a part")
            raise ParameterError(f"the follower ends a turn {shown} from its start", allowed="it must return")

    def shifted(self, angle: float) -> "CamProgramme":
        """The same programme, later by `angle` [rad]."""
        return replace(self, start=self.start + angle)

    def require_continuity(self, order: int) -> "CamProgramme":
        """The programme itself, if no derivative up to the order (1 to 3) jumps.

        Raises ParameterError that names the first jump of the lowest derivative that jumps.
        """
        found = all_jumps(self, order)
        if found:
            more = f", and {len(found) - 1} more" if len(found) > 1 else ""
            allowed = f"no jump up to the {_DERIVATIVES[order]}"
            raise ParameterError(f"{found[0]}{more}", allowed=allowed, do="use a smoother law, or a blend there")
        return self

    @property
    def edges(self) -> FloatArray:
        """Start of each segment and end of the last, from `start` on [rad], (segments + 1,)."""
        ends = itertools.accumulate(segment.span for segment in self.segments[:-1])
        return np.array([0.0, *ends, TURN])

    @property
    def bases(self) -> tuple[float, ...]:
        """Displacement at which each segment begins [m]."""
        return (0.0, *itertools.accumulate(segment.change for segment in self.segments[:-1]))

    @property
    def knots(self) -> FloatArray:
        """Cam angles [rad], ascending over one turn, between which the motion is smooth."""
        inner = [
            begin + at * segment.span
            for begin, segment in zip(self.edges, self.segments, strict=False)
            for at in (0.0, *segment.law.breaks)
        ]
        return self.start + np.array([*inner, TURN])

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and greatest displacement over the first turn [m], including the overshoot of laws."""
        return bounds(self.segments)

    def at(self, angle: Quantities) -> FollowerMotion:
        """Motion at cam angles [rad] of any shape; at a boundary, that of the segment that begins.

        Raises ParameterError for angles that were probably meant in degrees.
        """
        return self.motion(cam_angles(angle))

    def motion(self, angle: FloatArray) -> FollowerMotion:
        """The same at any angles of any turn [rad], as they are."""
        turns, phase = _turn_and_phase(np.asarray(angle - self.start))
        flat = phase.ravel()
        order = None if np.all(flat[1:] >= flat[:-1]) else np.argsort(flat, kind="stable")
        rows = self._ascending(flat if order is None else flat[order])
        if order is not None:
            ordered, rows = rows, np.empty(rows.shape)
            rows[:, order] = ordered
        rows = rows.reshape(4, *phase.shape)
        if self.revolves:
            rows[0] += self.revolves * turns
        return FollowerMotion(*rows)

    def table(self) -> dict[str, FloatArray]:
        """Columns over a turn, the knots among them: displacement and its derivatives by the cam angle."""
        angle = turn_of(self)
        units = ("displacement [m]", "velocity [m/rad]", "acceleration [m/rad^2]", "jerk [m/rad^3]")
        return {"cam angle [rad]": angle, **dict(zip(units, self.motion(angle), strict=True))}

    def _ascending(self, phase: FloatArray) -> FloatArray:
        """Rows s, s', s'', s''' at ascending phases, (4, phases): each segment has one slice."""
        edges, bases = self.edges, self.bases
        ends = (0, *np.searchsorted(phase, edges[1:-1]), phase.size)
        rows = np.zeros((4, phase.size))
        for segment, edge, base, (first, last) in zip(
            self.segments, edges, bases, itertools.pairwise(ends), strict=False
        ):
            if first == last:
                continue
            here = rows[:, first:last]
            if segment.factor:
                u = np.minimum((phase[first:last] - edge) * (1.0 / segment.span), 1.0)
                here[0], here[1], here[2], here[3] = segment.motion(u)
            here[0] += base
        return rows


def turn_of(programme: CamProgramme) -> FloatArray:
    """Cam angles [rad] over a turn from the start: 361 even ones, and the knots."""
    return np.unique(np.concatenate((programme.start + np.linspace(0.0, TURN, 361), programme.knots)))


def cam_angles(angle: Quantities) -> FloatArray:
    """Cam angles [rad] as an array. Raises ParameterError for those that were probably meant in degrees.

    >>> cam_angles(["90deg", 0.5])
    array([1.57079633, 0.5       ])
    """
    return np.asarray(_CAM.turning("angle", angle, "`CamProgramme.motion`"))


def joined(
    parts: Sequence[CamSegment | OpenSegment], order: int = 2, start: float = 0.0, revolves: float = 0.0
) -> CamProgramme:
    """A programme whose open parts are filled so that no derivative up to `order` (1 to 3) jumps at their ends.

    parts            segments, and open parts (`blend`) between them
    start, revolves  cam angle of the first part [rad], displacement gained per turn [m], as in `CamProgramme`

    An open part gets the polynomial whose derivatives 1..order equal those of its neighbours.
    Raises ParameterError for two adjacent open parts, and where jumps remain elsewhere.

    >>> sway = joined((even(1.0, 0.02), blend(1.0, 0.005), dwell(2.0), blend(TURN - 4.0, -0.025)))
    >>> all_jumps(sway, 2)
    ()
    """
    if order not in {1, 2, 3}:
        raise ParameterError(f"continuity of order {order}", allowed="1 (velocity), 2 (acceleration), 3 (jerk)")
    filled = []
    for i, part in enumerate(parts):
        if isinstance(part, CamSegment):
            filled.append(part)
            continue
        before, after = parts[i - 1], parts[(i + 1) % len(parts)]
        if isinstance(before, OpenSegment) or isinstance(after, OpenSegment):
            raise ParameterError("two adjacent blends", do="give the motion of one of them, or join them")
        orders = range(1, order + 1)
        ends = [before.derivative(1.0, k) for k in orders], [after.derivative(0.0, k) for k in orders]
        filled.append(replace(free(part.span, part.change, *ends), name=part.name))
    return CamProgramme(tuple(filled), start, revolves).require_continuity(order)


def jumps(programme: CamProgramme, order: int = 2) -> tuple[Jump, ...]:
    """Jumps of the derivative of `order` (1 velocity, 2 acceleration, 3 jerk) by the cam angle [rad], in its order.

    Empty where the derivative is continuous all round.
    """
    segments = programme.segments
    found = []
    for i, (segment, edge) in enumerate(zip(segments, programme.edges, strict=False)):
        previous, begin = segments[i - 1], programme.start + float(edge)
        where = f"from {previous.name} to {segment.name}"
        found.append(Jump(begin, order, previous.derivative(1.0, order), segment.derivative(0.0, order), where))
        found += [
            Jump(begin + u * segment.span, order, *segment.sides(u, order), f"inside the {segment.name}")
            for u in segment.law.breaks
        ]
    scale = max(segment.size / segment.span**order for segment in segments)
    return tuple(jump for jump in found if abs(jump.after - jump.before) > _FIT * scale)


def all_jumps(programme: CamProgramme, order: int = 3) -> tuple[Jump, ...]:
    """The jumps of all derivatives up to `order`, the lowest derivative first.

    Each with its cam angle [rad]; empty where none jumps.
    """
    return tuple(itertools.chain.from_iterable(jumps(programme, k) for k in range(1, order + 1)))


def _check_turn(segments: tuple[CamSegment, ...]) -> None:
    spans = [segment.span for segment in segments]
    if min(spans, default=0.0) <= 0 or abs(sum(spans) - TURN) > _FIT:
        shown = " + ".join(f"{segment.name} {format_quantity(segment.span / deg, '')}" for segment in segments)
        raise ParameterError(f"a cam of {shown or 'no parts'} degrees", allowed="its parts must add up to 360 degrees")


def _check_laws(segments: tuple[CamSegment, ...]) -> None:
    """Raise ParameterError where a law does not go from 0 to the change of its part."""
    for segment in segments:
        law, factor = segment.law, segment.factor
        off = max(abs(factor * law.first), abs(factor * law.last - segment.change))
        if off > _FIT * segment.size:
            given = f"{segment.name}: its law {law.name} goes from {law.first:g} to {law.last:g}"
            raise ParameterError(given, allowed="from 0 to 1", do="use a law that ends at 1, or `free` for the part")


def _turn_and_phase(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Whole turns and the remainder in [0, 2 pi); a whole turn up to rounding counts as whole."""
    count = angle / TURN
    turns = np.asarray(np.floor(count + _WHOLE * np.abs(count)))
    return turns, np.asarray(np.maximum(angle - turns * TURN, 0.0)) if np.any(turns) else angle
