"""RRP dyad: a link on a known pin A, pinned at C to a slider of known direction.

    |C - A| = a,    C = Q + s e,    C on the `branch` side along e of the foot of A
    C' = A' + i wa (C - A) = Q' + i w s e + s' e,    and the same once more for C''

Q is the position of C at s = 0 (with offsets and the reach of the slider), e the unit direction of the line, w and
alpha the angular velocity and acceleration of the guide, which may move [Norton, Design of Machinery, sections 4.6,
6.7, 7.3]. The dyad is at a dead centre where the link is normal to the line: (C - A) . e = 0. There the rates are
infinite.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, FloatArray, RealField
from ilmek.linkage.body_jerk import BodyJerk, carried_jerk, slid_jerk
from ilmek.linkage.body_motion import PointMotion
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.pairs import SliderPair
from ilmek.linkage.groups.shift import (
    slid_acceleration,
    slid_acceleration_kernel,
    slid_velocity,
    slid_velocity_kernel,
    track,
)
from ilmek.linkage.kernels import (
    ACCELERATION,
    ALPHA,
    BLOCK,
    DIRECTION,
    MARGIN,
    OMEGA,
    SECOND,
    TRAVEL,
    VELOCITY,
    ZERO,
    Instruction,
    pair,
    put,
)
from ilmek.linkage.model import Pin, Slide
from ilmek.linkage.tape import Tape
from ilmek.num.compiled import compiled
from ilmek.units import format_quantity


def position(A: ComplexField, Q: ComplexField, e: ComplexField, a: RealField, branch: RealField) -> RealField:
    """Travel s [m] of the slider; NaN where the link does not reach the line.

    A  known pin [m]   Q  point of C at s = 0 [m]   e  unit direction   a  link's length [m]
    branch  +1: C beyond the foot of A in direction e, -1: before it
    >>> float(position(0j, 1 + 3j, 1 + 0j, 5.0, branch=+1))
    3.0
    """
    return reach(A - Q, e, a, branch)[0]


def reach(
    d: ComplexField, e: ComplexField, a: RealField, branch: RealField
) -> tuple[RealField, ComplexField, RealField]:
    """Travel s [m], link u = C - A [m] and its projection u . e [m], from d = A - Q; NaN as `position`.

        u = (c - i h) e,    c = +-sqrt((a - h) (a + h)),    h = e x d

    >>> [complex(one) for one in reach(-1 - 3j, 1 + 0j, 5.0, +1)]
    [(3+0j), (4+3j), (4+0j)]
    """
    height = e.real * d.imag - e.imag * d.real
    cosine = branch * np.sqrt((a - height) * (a + height))
    return e.real * d.real + e.imag * d.imag + cosine, (cosine - 1j * height) * e, cosine


def turning(u: ComplexField, e: ComplexField) -> RealField:
    """Projection u . e [m] of the link u = C - A on the line's direction e: zero at a dead centre."""
    return u.real * e.real + u.imag * e.imag


def link_rate(e: ComplexField, r: ComplexField, cosine: RealField) -> RealField:
    """Angular velocity wa [rad/s] of the link, from i wa u - s' e = r with cosine = u . e.

    For velocities r = Q' + i w s e - A'; with r of `relative_acceleration` the results are alpha_a and s''.
    >>> float(link_rate(1 + 0j, 8j, 4.0)), float(slider_rate(4 - 3j, 8j, 4.0))
    (2.0, 6.0)
    """
    return (e.real * r.imag - e.imag * r.real) / cosine


def slider_rate(u: ComplexField, r: ComplexField, cosine: RealField) -> RealField:
    """Speed s' [m/s] of the slider along its line, from i wa u - s' e = r with cosine = u . e; see `link_rate`."""
    return -(u.real * r.real + u.imag * r.imag) / cosine


def relative_acceleration(A2: ComplexField, C2: ComplexField, u: ComplexField, wa: RealField) -> ComplexField:
    """Right side r = C2 - (A'' - wa^2 u) [m/s^2] of i alpha_a u - s'' e = r; see `link_rate`.

    C2  acceleration of the slider's pin at s'' = 0: Q'' + (i alpha - w^2) s e + 2 i w s' e
    >>> relative_acceleration(1 + 0j, 5 + 0j, 3j, 2.0)
    (4+12j)
    """
    return C2 - (A2 - wa * wa * u)


def shortness(A: ComplexField, Q: ComplexField, e: ComplexField, a: RealField) -> RealField:
    """Missing length [m] of the link to the line, 0 where it reaches.

    >>> float(shortness(0j, 7j, 1 + 0j, 5.0)), float(shortness(0j, 3j, 1 + 0j, 5.0))
    (2.0, 0.0)
    """
    d = A - Q
    missing: RealField = np.maximum(np.abs(e.real * d.imag - e.imag * d.real) - a, 0)
    return missing


_reach, _link_rate, _slider_rate = compiled(reach), compiled(link_rate), compiled(slider_rate)
_relative_acceleration, _shortness = compiled(relative_acceleration), compiled(shortness)


@compiled
def _kernel(dyad: FloatArray, guide: FloatArray, _also: FloatArray, count: int, numbers: ComplexArray) -> None:
    """Direction and rates of the link, margin, travel and rates of the slider; pin and zero are already written.

    Numbers: a, branch, 1/arm, the line's direction in the guide's frame.
    """
    a, branch, per_arm, lead = numbers[0].real, numbers[1].real, numbers[2], numbers[3]
    for i in range(min(count, BLOCK)):
        e, w, alpha = pair(guide, DIRECTION * BLOCK + i) * lead, guide[OMEGA * BLOCK + i], guide[ALPHA * BLOCK + i]
        s, u, cosine = _reach(pair(dyad, i) - pair(dyad, ZERO * BLOCK + i), e, a, branch)
        sliding = pair(dyad, (ZERO + VELOCITY) * BLOCK + i) + slid_velocity_kernel(e, w, s, 0.0)
        r = sliding - pair(dyad, VELOCITY * BLOCK + i)
        wa, ds = _link_rate(e, r, cosine), _slider_rate(u, r, cosine)
        C2 = pair(dyad, (ZERO + ACCELERATION) * BLOCK + i) + slid_acceleration_kernel(e, w, alpha, s, ds, 0.0)
        r = _relative_acceleration(pair(dyad, ACCELERATION * BLOCK + i), C2, u, wa)
        put(dyad, DIRECTION * BLOCK + i, u * per_arm)
        dyad[OMEGA * BLOCK + i] = wa
        dyad[ALPHA * BLOCK + i] = _link_rate(e, r, cosine)
        dyad[MARGIN * BLOCK + i] = cosine
        dyad[TRAVEL * BLOCK + i] = s
        dyad[(TRAVEL + 1) * BLOCK + i] = ds
        dyad[(TRAVEL + 2) * BLOCK + i] = _slider_rate(u, r, cosine)


@compiled
def _scale(numbers: ComplexArray) -> tuple[float, float]:
    return numbers[0].real, numbers[0].real


@compiled
def _gap(dyad: FloatArray, guide: FloatArray, numbers: ComplexArray, i: int) -> float:
    e = pair(guide, DIRECTION * BLOCK + i) * numbers[3]
    return float(_shortness(pair(dyad, i), pair(dyad, ZERO * BLOCK + i), e, numbers[0].real))


@dataclass(frozen=True, slots=True)
class SliderDyad(SliderPair):
    """A link of length a [m] on a known body, pinned to a slider on another (or the same) known body.

    arm  known pin -> free pin in the link's frame [m]      reach  slide's point -> free pin in the slider's frame [m]
    """

    kind: ClassVar[str] = "dyad"
    symbol: ClassVar[str] = "RRP"
    instruction: ClassVar[Instruction] = Instruction(_kernel, _scale, _gap)

    pin: str
    branch: int
    arm: complex
    a: float
    reach: complex

    @property
    def description(self) -> str:
        """Description of the step for users."""
        return (
            f"{self.link} and slider {self.slider} joined at {self.pin} (branch {self.branch:+d}), "
            f"attached to {self.on[0]} and {self.on[1]}: {self.symbol}"
        )

    @property
    def free(self) -> str:
        """The pin between link and slider."""
        return self.pin

    def known_line(self, known: Known) -> tuple[PointMotion, PointMotion, ComplexField]:
        """Motions of the known pin and of the free pin's point on the line at zero travel, and the line's direction."""
        guide = known[self.on[1]]
        zero = guide.carry(self.track.root, self.track.twist * self.reach)
        return known[self.on[0]].carry(self.hinge), zero, guide.direction * self.track.lead

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:  # noqa: ARG002 - needs no input
        """Direction and rates of the link; travel, speed and acceleration of the slider."""
        A, Q, e = self.known_line(known)
        w, alpha = known[self.on[1]].omega, known[self.on[1]].alpha
        s, u, cosine = reach(A.position - Q.position, e, self.a, self.branch)
        r = Q.velocity + slid_velocity(e, w, s, 0.0) - A.velocity
        wa, ds = link_rate(e, r, cosine), slider_rate(u, r, cosine)
        r = relative_acceleration(A.acceleration, Q.acceleration + slid_acceleration(e, w, alpha, s, ds, 0.0), u, wa)
        columns = {
            self.link: (u * (1 / self.arm), wa, link_rate(e, r, cosine)),
            self.slider: (s, ds, slider_rate(u, r, cosine)),
        }
        return GroupSolution(columns, cosine, self.a)

    def jerk(
        self,
        known: KnownJerks,
        located: Known,
        columns: Mapping[str, Columns],
        drives: Mapping[str, InputMotion],  # noqa: ARG002 - common signature
    ) -> Mapping[str, BodyJerk]:
        """Jerks of link and slider: i beta_a u and the third rate of s along e balance the other terms."""
        guide, link = known[self.on[1]], located[self.link]
        turns, A = guide.motion, known[self.on[0]].carry(self.hinge)
        e, u = turns.direction * self.track.lead, link.direction * self.arm
        s, ds, dds = columns[self.slider]
        Q = guide.carry(self.track.root, self.track.twist * self.reach)
        r = Q + slid_jerk(e, turns.omega, turns.alpha, guide.beta, s, ds, dds, 0.0)
        r = r - carried_jerk(A, u, link.omega, link.alpha, 0.0)
        cosine = turning(u, e)
        third = slider_rate(u, r, cosine)
        return {
            self.link: BodyJerk(link, A, link_rate(e, r, cosine)),
            self.slider: self.track.jerk(guide, located[self.slider], columns[self.slider], third),
        }

    @property
    def size(self) -> float:
        """The larger of the link's length and the distance of the pin from the slider's point [m]."""
        return max(self.a, abs(self.reach))

    @property
    def shortest(self) -> float:
        """Length of the link [m]."""
        return self.a

    @property
    def lengths(self) -> tuple[float, ...]:
        """Length of the link [m]; the slider does not turn on its guide."""
        return self.a, 0.0

    def gap(self, known: Known) -> RealField:
        """Missing length [m] of the link to the line."""
        A, Q, e = self.known_line(known)
        return shortness(A.position, Q.position, e, self.a)

    def shortfall(self, known: Known) -> tuple[str, str]:
        """The largest distance of the known pin from the line against the link."""
        gap = float(np.nanmax(self.gap(known)))
        away, link = format_quantity(self.a + gap, "mm"), format_quantity(self.a, "mm")
        return (
            f"the line of {self.slider} is {away} away from the far pin of {self.link}, {self.link} = {link}",
            f"lengthen {self.link} by {format_quantity(gap, 'mm')}",
        )

    @classmethod
    def recognise(cls, group: Group) -> Step | None:
        """The group as an RRP dyad, or None; raises as all do."""
        if len(group.bodies) != 2 or group.inputs or len(group.inner) != 1 or len(group.outer) != 2:
            return None
        pin, mechanism = group.inner[0], group.mechanism
        slide = next((joint for joint in group.outer if isinstance(joint, Slide)), None)
        hinge = next((joint for joint in group.outer if isinstance(joint, Pin)), None)
        if not isinstance(pin, Pin) or slide is None or hinge is None:
            return None
        link = next(body for body in group.bodies if body in hinge.bodies)
        slider = next(body for body in group.bodies if body in slide.bodies)
        if link == slider:
            return None
        on = group.beyond(hinge, link), group.beyond(slide, slider)
        arm = group.arm(link, hinge.name, pin.name)
        return cls(
            link=link,
            slider=slider,
            on=on,
            pin=pin.name,
            branch=group.branch(pin.name),
            hinge=mechanism.point(on[0], hinge.name),
            at=mechanism.point(link, hinge.name),
            arm=arm,
            a=abs(arm),
            reach=mechanism.point(slider, pin.name) - mechanism.point(slider, slide.name),
            track=track(mechanism, slide, slider),
        )

    def write(self, tape: Tape) -> None:
        """The known pin and the line's zero, the dyad, then the slider on its guide."""
        to, (on, guide) = tape.room(TRAVEL + 3), self.on
        arm = tape.arm(self.link, tape.pinned(self.link, on, to), self.pin)
        self.track.write_zero(tape, self.slider, guide, self.pin, to + ZERO)
        branch = tape.branch(self.pin, self.branch)
        tape.add(self.instruction, to, tape.rows[guide], numbers=(np.abs(arm), branch, 1 / arm, self.track.lead))
        self.track.write(tape, self.slider, guide, to + SECOND, to + TRAVEL)
