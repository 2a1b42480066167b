"""RPR dyad: two bodies that slide on one another, each on a known pin, A and B.

    B - A = (t + i o) e,    t = branch sqrt(|B - A|^2 - o^2)
    (B - A)' = t' e + i w (t + i o) e,    and the same once more for (B - A)''

e is the unit direction of the slide, o the fixed distance of B from the line through A along e (left of it: above 0),
t the distance from A to the foot of B on that line. w is the angular velocity of both bodies [Norton,
Design of Machinery, sections 4.7, 6.7, 7.3: inverted slider-crank].
Oscillating cylinders, quick-returns, slotted levers.
The dyad is at a dead centre where t = 0: the slide is normal to A -> B, or B passes through A. There the rates are
infinite.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, FloatArray, RealField
from ilmek.linkage.body_jerk import BodyJerk, slid_jerk
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.pairs import PinnedPair
from ilmek.linkage.groups.shift import SlideTrack, track
from ilmek.linkage.kernels import (
    ACCELERATION,
    ALPHA,
    BLOCK,
    DIRECTION,
    MARGIN,
    OMEGA,
    SECOND,
    VELOCITY,
    Instruction,
    pair,
    put,
)
from ilmek.linkage.model import Pin, Slide
from ilmek.linkage.tape import Tape
from ilmek.num.compiled import compiled
from ilmek.plane.vectors import dot
from ilmek.units import format_quantity


def sliding_distance(d: ComplexField, o: RealField, branch: RealField) -> RealField:
    """Distance t = branch sqrt(|d|^2 - o^2) [m] along the slide from A to the foot of B; NaN where |d| < |o|.

    d  B - A [m]   o  offset [m]   branch  +1: B ahead of A in the slide's direction, -1: behind
    >>> float(sliding_distance(3 + 4j, 3.0, branch=-1))
    -4.0
    """
    return branch * np.sqrt(d.real * d.real + d.imag * d.imag - o * o)


def heading(d: ComplexField, o: RealField, t: RealField) -> ComplexField:
    """Unit direction e = d / (t + i o) of the slide; d = B - A, o and t [m].

    >>> complex(heading(3 + 4j, 3.0, 4.0))
    (0.96+0.28j)
    """
    return d * (t - 1j * o) * (1 / (d.real * d.real + d.imag * d.imag))


def turn_rate(e: ComplexField, r: ComplexField, t: RealField) -> RealField:
    """Angular velocity w [rad/s] of both bodies, from i w d + t' e = r.

    For velocities r = d' [m/s]; with r of `relative_acceleration` the result is alpha [rad/s^2].
    >>> float(turn_rate(0.96 + 0.28j, 2j, 4.0)), float(sliding_speed(0.96 + 0.28j, 2j, 0.48, 3.0))
    (0.48, 2.0)
    """
    return (e.real * r.imag - e.imag * r.real) / t


def sliding_speed(e: ComplexField, r: ComplexField, w: RealField, o: RealField) -> RealField:
    """Sliding speed t' [m/s], from i w d + t' e = r; w is the result of `turn_rate` [rad/s]."""
    return e.real * r.real + e.imag * r.imag + w * o


def relative_acceleration(
    d2: ComplexField, d: ComplexField, e: ComplexField, w: RealField, dt: RealField
) -> ComplexField:
    """Right side r = d'' + w^2 d - 2 i w t' e [m/s^2] of i alpha d + t'' e = r; see `turn_rate`.

    >>> complex(relative_acceleration(1 + 0j, 3 + 4j, 1j, 2.0, 5.0))
    (33+16j)
    """
    return d2 + w * w * d - 2j * (w * dt) * e


def offset(
    first: ComplexField, root: ComplexField, second: ComplexField, at: ComplexField, line: SlideTrack
) -> RealField:
    """Offset o [m] of the second body's known pin from the line through the first's along the slide; constant.

    first, root   the known pin and the slide's point of the guide, in its frame [m]
    second, at    those of the other body, in its frame [m]
    """
    to_b = root - first + line.twist * (second - at)  # from A to B at s = 0, in the guide's frame
    o: RealField = (to_b * line.lead.conjugate()).imag
    return o


def shortness(d: ComplexField, o: RealField) -> RealField:
    """Missing distance max(|o| - |d|, 0) [m] of the known pins; 0 where the dyad closes.

    >>> float(shortness(3 + 4j, -7.0)), float(shortness(3 + 4j, 3.0))
    (2.0, 0.0)
    """
    short: RealField = np.maximum(np.abs(o) - np.abs(d), 0)
    return short


_sliding_distance, _heading = compiled(sliding_distance), compiled(heading)
_turn_rate, _sliding_speed = compiled(turn_rate), compiled(sliding_speed)
_relative_acceleration, _shortness = compiled(relative_acceleration), compiled(shortness)


@compiled
def _kernel(dyad: FloatArray, _of: FloatArray, _also: FloatArray, count: int, numbers: ComplexArray) -> None:
    """Directions, rates and margin of two bodies that slide on one another; the known pins are already written.

    Numbers: offset, branch, the guide's direction against the line, the second body's against the guide, size.
    """
    o, branch, per_lead, twist = numbers[0].real, numbers[1].real, numbers[2], numbers[3]
    for i in range(min(count, BLOCK)):
        d = pair(dyad, SECOND * BLOCK + i) - pair(dyad, i)
        t = _sliding_distance(d, o, branch)
        e = _heading(d, o, t)
        r: ComplexField = pair(dyad, (SECOND + VELOCITY) * BLOCK + i) - pair(dyad, VELOCITY * BLOCK + i)
        w = _turn_rate(e, r, t)
        d2 = pair(dyad, (SECOND + ACCELERATION) * BLOCK + i) - pair(dyad, ACCELERATION * BLOCK + i)
        r = _relative_acceleration(d2, d, e, w, _sliding_speed(e, r, w, o))
        alpha = _turn_rate(e, r, t)
        direction = e * per_lead
        put(dyad, DIRECTION * BLOCK + i, direction)
        put(dyad, (SECOND + DIRECTION) * BLOCK + i, direction * twist)
        for body in (0, SECOND):
            dyad[(body + OMEGA) * BLOCK + i] = w
            dyad[(body + ALPHA) * BLOCK + i] = alpha
        dyad[MARGIN * BLOCK + i] = t


@compiled
def _scale(numbers: ComplexArray) -> tuple[float, float]:
    return numbers[4].real, numbers[4].real


@compiled
def _gap(dyad: FloatArray, _of: FloatArray, numbers: ComplexArray, i: int) -> float:
    return float(_shortness(pair(dyad, SECOND * BLOCK + i) - pair(dyad, i), numbers[0].real))


@dataclass(frozen=True, slots=True)
class SlidingDyad(PinnedPair):
    """Two bodies on known pins, the second sliding on the first.

    track  the second body on the first      offset  o [m]      scale  of its lengths [m]
    """

    kind: ClassVar[str] = "dyad"
    symbol: ClassVar[str] = "RPR"
    instruction: ClassVar[Instruction] = Instruction(_kernel, _scale, _gap)

    slide: str
    branch: int
    track: SlideTrack
    offset: float
    scale: float

    @property
    def description(self) -> str:
        """Description of the step for users."""
        (p, q), (on_p, on_q) = self.links, self.on
        dyad = f"{p} and {q} joined by slide {self.slide} (branch {self.branch:+d})"
        return f"{dyad}, attached to {on_p} and {on_q}: {self.symbol}"

    @property
    def free(self) -> str:
        """The slide between the bodies."""
        return self.slide

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:  # noqa: ARG002 - needs no input
        """Directions of both bodies, their common angular velocity and acceleration."""
        A, B = self.pins(known)
        d = B.position - A.position
        t = sliding_distance(d, self.offset, self.branch)
        e = heading(d, self.offset, t)
        r = B.velocity - A.velocity
        w = turn_rate(e, r, t)
        r = relative_acceleration(B.acceleration - A.acceleration, d, e, w, sliding_speed(e, r, w, self.offset))
        alpha = turn_rate(e, r, t)
        direction = e * self.track.lead.conjugate()
        columns = {self.links[0]: (direction, w, alpha), self.links[1]: (direction * self.track.twist, w, alpha)}
        return GroupSolution(columns, t, self.scale)

    def jerk(
        self,
        known: KnownJerks,
        located: Known,
        columns: Mapping[str, Columns],  # noqa: ARG002 - common signature
        drives: Mapping[str, InputMotion],  # noqa: ARG002 - common signature
    ) -> Mapping[str, BodyJerk]:
        """Jerks of both bodies: i beta d and the third rate of t along e balance the other terms."""
        (p, q), (one, two) = (known[on] for on in self.on), (located[link] for link in self.links)
        jerks = p.carry(self.hinges[0]), q.carry(self.hinges[1])
        A, B, o = one.anchor, two.anchor, self.offset
        e, w, alpha = one.direction * self.track.lead, one.omega, one.alpha
        d, gain = B.position - A.position, B.acceleration - A.acceleration
        t, dt = dot(e, d), sliding_speed(e, B.velocity - A.velocity, w, o)
        ddt = sliding_speed(e, relative_acceleration(gain, d, e, w, dt), alpha, o)
        r = jerks[1] - jerks[0] - slid_jerk(e, w, alpha, 0.0, t + 1j * o, dt, ddt, 0.0)
        beta = turn_rate(e, r, t)
        return {self.links[0]: BodyJerk(one, jerks[0], beta), self.links[1]: BodyJerk(two, jerks[1], beta)}

    @property
    def size(self) -> float:
        """The larger distance of the slide's point from the known pin on either body [m]."""
        return max(abs(self.track.root - self.at[0]), abs(self.at[1] - self.track.at))

    @property
    def shortest(self) -> float:
        """The scale of its lengths [m]."""
        return self.scale

    @property
    def lengths(self) -> tuple[float, ...]:
        """The scale of its lengths [m], for the one angle of both bodies."""
        return self.scale, self.scale

    def gap(self, known: Known) -> RealField:
        """Missing distance [m] of the known pins."""
        A, B = self.pins(known)
        return shortness(B.position - A.position, self.offset)

    def shortfall(self, known: Known) -> tuple[str, str]:
        """The least distance of the known pins against the offset."""
        gap = float(np.nanmax(self.gap(known)))
        near, offset = format_quantity(abs(self.offset) - gap, "mm"), format_quantity(abs(self.offset), "mm")
        pins = f"the known pins of {self.links[0]} and {self.links[1]}"
        return (
            f"{pins} come within {near}, slide {self.slide} requires a distance of {offset}",
            f"reduce the offset of slide {self.slide} by {format_quantity(gap, 'mm')}",
        )

    @classmethod
    def recognise(cls, group: Group) -> Step | None:
        """The group as an RPR dyad, or None; None too for a slide without a branch whose bodies have a pose.

        Raises MechanismError for a slide with neither.
        """
        slide, mechanism = group.inner[0] if group.is_dyad else None, group.mechanism
        if not isinstance(slide, Slide) or not all(isinstance(joint, Pin) for joint in group.outer):
            return None
        if slide.name not in mechanism.branches and mechanism.pose.keys() & set(group.bodies):
            return None
        guide, body = slide.guide, slide.body
        hinges = [group.outer_of(link)[0] for link in (guide, body)]
        on = [group.beyond(hinge, link) for hinge, link in zip(hinges, (guide, body), strict=True)]
        at = [mechanism.point(link, hinge.name) for hinge, link in zip(hinges, (guide, body), strict=True)]
        line = track(mechanism, slide, body)
        return cls(
            links=(guide, body),
            on=(on[0], on[1]),
            slide=slide.name,
            branch=group.branch(slide.name),
            hinges=(mechanism.point(on[0], hinges[0].name), mechanism.point(on[1], hinges[1].name)),
            at=(at[0], at[1]),
            track=line,
            offset=float(offset(at[0], line.root, at[1], line.at, line)),
            scale=group.span,
        )

    def write(self, tape: Tape) -> None:
        """Two known pins, then the dyad."""
        to, (guide, body), line = tape.room(MARGIN + 1), self.links, self.track
        for link, on, row in zip(self.links, self.on, (to, to + SECOND), strict=True):
            tape.pinned(link, on, row)
        root, at = tape.point(guide, self.slide), tape.point(body, self.slide)
        off = offset(tape.at[guide], root, tape.at[body], at, line)
        branch = tape.branch(self.slide, self.branch)
        tape.add(self.instruction, to, numbers=(off, branch, line.lead.conjugate(), line.twist, tape.span))
