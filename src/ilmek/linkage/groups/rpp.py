"""RPP dyad: a body on a known pin A slides on a slider, which slides on a known guide.

    A = Q + s e + z f,    A' = Q' + i w (A - Q) + s' e + z' f,    and the same once more for A''

e is the unit direction of the guide's line, f that of the line between the two bodies. The bodies do not turn
against the guide, so that w is the angular velocity of both and the angle between e and f is fixed. Q is the position
of the known pin at zero travel of both slides. There is one assembly, and it always closes
[Artobolevsky, Theory of Mechanisms and Machines: groups of class II, fifth kind]. Scotch yokes, Oldham couplings.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ilmek.arrays import ComplexArray, ComplexField, FloatArray, RealField
from ilmek.linkage.body_jerk import BodyJerk, slid_jerk
from ilmek.linkage.body_motion import carried_acceleration, carried_velocity
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.pairs import SliderPair
from ilmek.linkage.groups.shift import refuse_parallel, track
from ilmek.linkage.kernels import (
    ACCELERATION,
    ALPHA,
    BLOCK,
    DIRECTION,
    OMEGA,
    SECOND,
    TRAVEL,
    VELOCITY,
    ZERO,
    Instruction,
    carried_acceleration_kernel,
    carried_velocity_kernel,
    oblique_kernel,
    pair,
    put,
)
from ilmek.linkage.model import Pin, Slide
from ilmek.linkage.tape import Tape
from ilmek.num.compiled import compiled
from ilmek.plane.vectors import cross, oblique


def gain(r: ComplexField, sliding: ComplexField, w: RealField) -> ComplexField:
    """Right side of s'' e + z'' f = r - 2 i w (s' e + z' f) [m/s^2].

    r  acceleration of A minus that of the guide's point at A [m/s^2]        sliding  s' e + z' f [m/s]
    >>> gain(5 + 0j, 3j, 2.0)
    (17+0j)
    """
    return r - 2j * w * sliding


def zero(
    outer: ComplexField, inner: tuple[ComplexField, ComplexField], at: ComplexField, twists: tuple[complex, complex]
) -> ComplexField:
    """From the slide's point on the guide to the known pin at s = z = 0, in the guide's frame [m].

    outer   the guide's slide's point in the slider's frame [m]     inner  the other slide's points on both [m]
    at      the pin in the link's frame [m]                         twists  of slider, and link on it
    >>> zero(1, (3, 1j), 2 + 1j, (1j, 1))
    4j
    """
    return twists[0] * (inner[0] - outer + twists[1] * (at - inner[1]))


_gain = compiled(gain)


@compiled
def _kernel(dyad: FloatArray, guide: FloatArray, _also: FloatArray, count: int, numbers: ComplexArray) -> None:
    """Direction and rates of the link, travel and rates of the slider; known pin and its zero are already written.

    Numbers: both lines' directions and the link's, in the guide's frame.
    """
    lead, second_lead, twist = numbers[0], numbers[1], numbers[2]
    for i in range(min(count, BLOCK)):
        direction, w, alpha = pair(guide, DIRECTION * BLOCK + i), guide[OMEGA * BLOCK + i], guide[ALPHA * BLOCK + i]
        e, f = direction * lead, direction * second_lead
        d = pair(dyad, i) - pair(dyad, ZERO * BLOCK + i)
        Q1, Q2 = pair(dyad, (ZERO + VELOCITY) * BLOCK + i), pair(dyad, (ZERO + ACCELERATION) * BLOCK + i)
        ds = pair(dyad, VELOCITY * BLOCK + i) - carried_velocity_kernel(Q1, d, w)
        A2 = pair(dyad, ACCELERATION * BLOCK + i)
        dds = _gain(A2 - carried_acceleration_kernel(Q2, d, w, alpha), ds, w)
        put(dyad, DIRECTION * BLOCK + i, direction * twist)
        dyad[OMEGA * BLOCK + i] = w
        dyad[ALPHA * BLOCK + i] = alpha
        dyad[TRAVEL * BLOCK + i] = oblique_kernel(d, e, f)
        dyad[(TRAVEL + 1) * BLOCK + i] = oblique_kernel(ds, e, f)
        dyad[(TRAVEL + 2) * BLOCK + i] = oblique_kernel(dds, e, f)


@dataclass(frozen=True, slots=True)
class CrossSlide(SliderPair):
    """A body on a known pin and the slider between it and a guide.

    lead  direction f in the slider's frame      twist  link against slider
    zero  from the slide's point to A at s = z = 0, in the guide's frame [m]
    """

    kind: ClassVar[str] = "dyad"
    symbol: ClassVar[str] = "RPP"
    instruction: ClassVar[Instruction] = Instruction(_kernel)

    lead: complex
    twist: complex
    zero: complex

    @property
    def description(self) -> str:
        """Description of the step for users."""
        return f"{self.link} on slider {self.slider}, attached to {self.on[0]} and {self.on[1]}: {self.symbol}"

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:  # noqa: ARG002 - needs no input
        """Direction and rates of the link; travel, speed and acceleration of the slider."""
        A, guide = known[self.on[0]].carry(self.hinge), known[self.on[1]]
        Q, w, alpha = guide.carry(self.track.root, self.zero), guide.omega, guide.alpha
        e = guide.direction * self.track.lead
        f = guide.direction * (self.track.twist * self.lead)
        d = A.position - Q.position
        ds = A.velocity - carried_velocity(Q.velocity, d, w)
        dds = gain(A.acceleration - carried_acceleration(Q.acceleration, d, w, alpha), ds, w)
        columns = {
            self.link: (guide.direction * (self.track.twist * self.twist), w, alpha),
            self.slider: (oblique(d, e, f), oblique(ds, e, f), oblique(dds, e, f)),
        }
        return GroupSolution(columns)

    def jerk(
        self,
        known: KnownJerks,
        located: Known,
        columns: Mapping[str, Columns],
        drives: Mapping[str, InputMotion],  # noqa: ARG002 - common signature
    ) -> Mapping[str, BodyJerk]:
        """Jerks: the slider's third rate along e balances those of pin and guide; the link turns with the guide."""
        guide, A = known[self.on[1]], known[self.on[0]].carry(self.hinge)
        turns, link = guide.motion, located[self.link]
        Q, w = turns.carry(self.track.root, self.zero), turns.omega
        d = link.anchor.position - Q.position
        ds = link.anchor.velocity - carried_velocity(Q.velocity, d, w)
        dds = gain(link.anchor.acceleration - carried_acceleration(Q.acceleration, d, w, turns.alpha), ds, w)
        r = A - guide.carry(self.track.root, self.zero) - slid_jerk(1 + 0j, w, turns.alpha, guide.beta, d, ds, dds, 0.0)
        e = turns.direction * self.track.lead
        third = oblique(r, e, turns.direction * (self.track.twist * self.lead))
        return {
            self.link: BodyJerk(link, A, guide.beta),
            self.slider: self.track.jerk(guide, located[self.slider], columns[self.slider], third),
        }

    @classmethod
    def recognise(cls, group: Group) -> Step | None:
        """The group as an RPP dyad, or None. Raises MechanismError where its slides are parallel."""
        between, mechanism = group.inner[0] if group.is_dyad else None, group.mechanism
        slide = next((joint for joint in group.outer if isinstance(joint, Slide)), None)
        hinge = next((joint for joint in group.outer if isinstance(joint, Pin)), None)
        if not isinstance(between, Slide) or slide is None or hinge is None:
            return None
        link = next(body for body in group.bodies if body in hinge.bodies)
        slider = next(body for body in group.bodies if body in slide.bodies)
        on = group.beyond(hinge, link), group.beyond(slide, slider)
        outer, inner = track(mechanism, slide, slider), track(mechanism, between, link)
        refuse_parallel(mechanism, (slide, between), cross(outer.lead, outer.twist * inner.lead))
        at = mechanism.point(link, hinge.name)
        return cls(
            link=link,
            slider=slider,
            on=on,
            hinge=mechanism.point(on[0], hinge.name),
            at=at,
            track=outer,
            lead=inner.lead,
            twist=inner.twist,
            zero=complex(zero(outer.at, (inner.root, inner.at), at, (outer.twist, inner.twist))),
        )

    def write(self, tape: Tape) -> None:
        """The known pin and its zero on the guide, the dyad, then the slider."""
        to, (on, guide), track = tape.room(TRAVEL + 3), self.on, self.track
        tape.pinned(self.link, on, to)
        slide, between = tape.between(self.slider, guide), tape.between(self.link, self.slider)
        inner = tape.point(self.slider, between), tape.point(self.link, between)
        arm = zero(tape.point(self.slider, slide), inner, tape.at[self.link], (track.twist, self.twist))
        tape.carry(guide, tape.point(guide, slide), to + ZERO, arm)
        numbers = track.lead, track.twist * self.lead, track.twist * self.twist
        tape.add(self.instruction, to, tape.rows[guide], numbers=numbers)
        track.write(tape, self.slider, guide, to + SECOND, to + TRAVEL)
