"""RRR dyad: two links joined by a pin C, on two known pins A and B.

    |C - A| = a,    |C - B| = b,    C on the `branch` side of A -> B
    C' = A' + i wa (C - A) = B' + i wb (C - B),    and the same once more for C''

[Norton, Design of Machinery, sections 4.5, 6.7, 7.3, with the angles eliminated: no arc functions.]
The dyad is at a dead centre where its links are in line: (C - A) x (C - B) = 0. There the rates are infinite.
"""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, FloatArray, RealField
from ilmek.linkage.body_jerk import BodyJerk, carried_jerk
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.pairs import PinnedPair
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
from ilmek.linkage.model import Pin
from ilmek.linkage.status import TOUCHING
from ilmek.linkage.tape import Tape
from ilmek.num.compiled import compiled
from ilmek.records import value_record
from ilmek.units import in_mm


def position(A: ComplexField, B: ComplexField, a: RealField, b: RealField, branch: RealField) -> ComplexField:
    """Free pin C [m]; NaN where the dyad cannot close.

    A, B  known pins [m], complex, any shape      a, b  link lengths [m]      branch  +1: C left of A -> B, -1: right
    >>> complex(position(0j, 4 + 0j, 3.0, 5.0, branch=+1))
    3j
    """
    return A + first_link(B - A, a, b, branch)[0]


def first_link(d: ComplexField, a: RealField, b: RealField, branch: RealField) -> tuple[ComplexField, RealField]:
    """Link u = C - A [m] and the cross product u x v [m^2] with v = u - d, from d = B - A; NaN as `position`.

        u = (along + i across) d,    u x v = across |d|^2 = +-1/2 sqrt(((a + b)^2 - |d|^2) (|d|^2 - (a - b)^2))

    Heron's product keeps the digits near a dead centre that sqrt(a^2/|d|^2 - along^2) loses: the error is that of d
    alone [Kahan, Miscalculating Area and Angles of a Needle-like Triangle].
    >>> [complex(one) for one in first_link(4 + 0j, 3.0, 5.0, +1)]
    [3j, (12+0j)]
    """
    total, apart = a + b, a - b
    dd = d.real * d.real + d.imag * d.imag
    per_dd = 1 / dd
    sine = (0.5 * branch) * np.sqrt((total * total - dd) * (dd - apart * apart))
    return (0.5 + (0.5 * total * apart) * per_dd + 1j * (sine * per_dd)) * d, sine


def turning(u: ComplexField, v: ComplexField) -> RealField:
    """Cross product u x v [m^2] of the links u = C - A and v = C - B: a b sin(transmission angle), zero at a dead
    centre.

    >>> float(turning(3j, -4 + 3j))
    12.0
    """
    return u.real * v.imag - u.imag * v.real


def first_rate(v: ComplexField, r: ComplexField, per_sine: RealField) -> RealField:
    """Angular velocity wa [rad/s] of the link on A, from i wa u - i wb v = r with per_sine = 1 / (u x v).

    For velocities r = B' - A' [m/s]; with r of `relative_acceleration` the result is alpha_a [rad/s^2].
    >>> float(first_rate(-4 + 3j, -2 + 0j, 1 / 16)), float(second_rate(3j, -2 + 0j, 1 / 16))
    (0.5, 0.0)
    """
    return (v.real * r.real + v.imag * r.imag) * per_sine


def second_rate(u: ComplexField, r: ComplexField, per_sine: RealField) -> RealField:
    """Angular velocity wb [rad/s] of the link on B, from i wa u - i wb v = r; see `first_rate`."""
    return (u.real * r.real + u.imag * r.imag) * per_sine


def relative_acceleration(  # noqa: PLR0917 - arguments in the order of the equation
    A2: ComplexField, B2: ComplexField, u: ComplexField, v: ComplexField, wa: RealField, wb: RealField
) -> ComplexField:
    """Right side r = (B'' - wb^2 v) - (A'' - wa^2 u) [m/s^2] of i alpha_a u - i alpha_b v = r; see `first_rate`.

    >>> relative_acceleration(1 + 0j, 5 + 0j, 3j, -4 + 3j, 2.0, 1.0)
    (8+9j)
    """
    return (B2 - wb * wb * v) - (A2 - wa * wa * u)


def misfit(A: ComplexField, B: ComplexField, a: RealField, b: RealField) -> RealField:
    """Gap [m] of the dyad: above 0 for known pins too far apart, below 0 for too near, 0 where it closes.

    >>> float(misfit(0j, 9 + 0j, 3.0, 5.0)), float(misfit(0j, 1 + 0j, 3.0, 5.0)), float(misfit(0j, 4 + 0j, 3.0, 5.0))
    (1.0, -1.0, 0.0)
    """
    reach = np.abs(B - A)
    gap: RealField = np.maximum(reach - (a + b), 0) + np.minimum(reach - np.abs(a - b), 0)
    return gap


_first_link, _first_rate, _second_rate = compiled(first_link), compiled(first_rate), compiled(second_rate)
_relative_acceleration, _misfit = compiled(relative_acceleration), compiled(misfit)


@compiled
def _kernel(dyad: FloatArray, _of: FloatArray, _also: FloatArray, count: int, numbers: ComplexArray) -> None:
    """Directions, rates and margin of two links, whose known pins are already written.

    Numbers: a, b, branch, 1/arm of each link.
    """
    a, b, branch, per_a, per_b = numbers[0].real, numbers[1].real, numbers[2].real, numbers[3], numbers[4]
    for i in range(min(count, BLOCK)):
        d = pair(dyad, SECOND * BLOCK + i) - pair(dyad, i)
        u, sine = _first_link(d, a, b, branch)
        v, per_sine = u - d, 1 / sine
        r: ComplexField = pair(dyad, (SECOND + VELOCITY) * BLOCK + i) - pair(dyad, VELOCITY * BLOCK + i)
        wa, wb = _first_rate(v, r, per_sine), _second_rate(u, r, per_sine)
        A2, B2 = pair(dyad, ACCELERATION * BLOCK + i), pair(dyad, (SECOND + ACCELERATION) * BLOCK + i)
        r = _relative_acceleration(A2, B2, u, v, wa, wb)
        put(dyad, DIRECTION * BLOCK + i, u * per_a)
        put(dyad, (SECOND + DIRECTION) * BLOCK + i, v * per_b)
        dyad[OMEGA * BLOCK + i] = wa
        dyad[(SECOND + OMEGA) * BLOCK + i] = wb
        dyad[ALPHA * BLOCK + i] = _first_rate(v, r, per_sine)
        dyad[(SECOND + ALPHA) * BLOCK + i] = _second_rate(u, r, per_sine)
        dyad[MARGIN * BLOCK + i] = sine


@compiled
def _scale(numbers: ComplexArray) -> tuple[float, float]:
    a, b = numbers[0].real, numbers[1].real
    return a * b, min(a, b)


@compiled
def _gap(dyad: FloatArray, _of: FloatArray, numbers: ComplexArray, i: int) -> float:
    return float(_misfit(pair(dyad, i), pair(dyad, SECOND * BLOCK + i), numbers[0].real, numbers[1].real))


@value_record
class RRRDyad(PinnedPair):
    """Two links, of lengths a and b [m], on known bodies and joined by the free pin.

    arms  known pin -> free pin in the links' frames [m]
    """

    kind: ClassVar[str] = "dyad"
    symbol: ClassVar[str] = "RRR"
    instruction: ClassVar[Instruction] = Instruction(_kernel, _scale, _gap)

    pin: str
    known_pins: tuple[str, str]
    branch: int
    arms: tuple[complex, complex]
    a: float
    b: float

    @property
    def description(self) -> str:
        """Description of the step for users."""
        (p, q), (on_p, on_q) = self.links, self.on
        return (
            f"{p} and {q} joined at {self.pin} (branch {self.branch:+d}), attached to {on_p} and {on_q}: {self.symbol}"
        )

    @property
    def free(self) -> str:
        """The pin between the links."""
        return self.pin

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:  # noqa: ARG002 - needs no input
        """Directions, angular velocities and accelerations of the links."""
        A, B = self.pins(known)
        d = B.position - A.position
        u, sine = first_link(d, self.a, self.b, self.branch)
        v, per_sine = u - d, 1 / sine
        r = B.velocity - A.velocity
        wa, wb = first_rate(v, r, per_sine), second_rate(u, r, per_sine)
        r = relative_acceleration(A.acceleration, B.acceleration, u, v, wa, wb)
        columns = {
            self.links[0]: (u * (1 / self.arms[0]), wa, first_rate(v, r, per_sine)),
            self.links[1]: (v * (1 / self.arms[1]), wb, second_rate(u, r, per_sine)),
        }
        return GroupSolution(columns, sine, self.a * self.b)

    def jerk(
        self,
        known: KnownJerks,
        located: Known,
        columns: Mapping[str, Columns],  # noqa: ARG002 - common signature
        drives: Mapping[str, InputMotion],  # noqa: ARG002 - common signature
    ) -> Mapping[str, BodyJerk]:
        """Jerks of the links, from i beta_a u - i beta_b v = r."""
        (one, two), (p, q) = (located[link] for link in self.links), (known[on] for on in self.on)
        u, v = one.direction * self.arms[0], two.direction * self.arms[1]
        A, B = p.carry(self.hinges[0]), q.carry(self.hinges[1])
        r = carried_jerk(B, v, two.omega, two.alpha, 0.0) - carried_jerk(A, u, one.omega, one.alpha, 0.0)
        per_sine = 1 / turning(u, v)
        return {
            self.links[0]: BodyJerk(one, A, first_rate(v, r, per_sine)),
            self.links[1]: BodyJerk(two, B, second_rate(u, r, per_sine)),
        }

    @property
    def size(self) -> float:
        """Length of the longer link [m]."""
        return max(self.a, self.b)

    @property
    def shortest(self) -> float:
        """Length of the shorter link [m]."""
        return min(self.a, self.b)

    @property
    def lengths(self) -> tuple[float, ...]:
        """Lengths of the links [m]."""
        return self.a, self.b

    def gap(self, known: Known) -> RealField:
        """Gap [m]: known pins too far apart (above 0) or too near (below 0)."""
        A, B = self.pins(known)
        return misfit(A.position, B.position, self.a, self.b)

    def shortfall(self, known: Known) -> tuple[str, str]:
        """The worst distance of the known pins against the links."""
        A, B = self.pins(known)
        gaps = np.ravel(self.gap(known))
        worst = int(np.nanargmax(np.abs(gaps)))
        reach, gap = np.ravel(np.abs(B.position - A.position))[worst], gaps[worst]
        reach = 0.0 if reach < TOUCHING * self.a else reach
        (p, q), pins = self.links, "-".join(self.known_pins)
        if gap > 0:
            return (
                f"|{pins}| reaches {in_mm(reach)}, {p} + {q} = {in_mm(self.a + self.b)}",
                f"lengthen one by {in_mm(gap)}",
            )
        longer, shorter = (p, q) if self.a > self.b else (q, p)
        return (
            f"|{pins}| falls to {in_mm(reach)}, {longer} - {shorter} = {in_mm(abs(self.a - self.b))}",
            f"lengthen {shorter} by {in_mm(-gap)}",
        )

    @classmethod
    def recognise(cls, group: Group) -> Step | None:
        """The group as an RRR dyad, or None; raises as all do."""
        if len(group.bodies) != 2 or group.inputs or len(group.inner) != 1 or len(group.outer) != 2:
            return None
        pin, mechanism = group.inner[0], group.mechanism
        if not all(isinstance(joint, Pin) for joint in group.joints):
            return None
        links = pin.bodies
        joints_to_known = [group.outer_of(link) for link in links]
        if any(len(joints) != 1 for joints in joints_to_known):
            return None
        outer = [joints[0] for joints in joints_to_known]
        on = [group.beyond(joint, link) for joint, link in zip(outer, links, strict=True)]
        at = [mechanism.point(link, joint.name) for joint, link in zip(outer, links, strict=True)]
        hinges = [mechanism.point(body, joint.name) for joint, body in zip(outer, on, strict=True)]
        arms = [group.arm(link, joint.name, pin.name) for joint, link in zip(outer, links, strict=True)]
        return cls(
            links=links,
            on=(on[0], on[1]),
            pin=pin.name,
            known_pins=(outer[0].name, outer[1].name),
            branch=group.branch(pin.name),
            hinges=(hinges[0], hinges[1]),
            at=(at[0], at[1]),
            arms=(arms[0], arms[1]),
            a=abs(arms[0]),
            b=abs(arms[1]),
        )

    def write(self, tape: Tape) -> None:
        """Two known pins, then the dyad."""
        to = tape.room(MARGIN + 1)
        (p, q), (on_p, on_q) = self.links, self.on
        arms = tape.arm(p, tape.pinned(p, on_p, to), self.pin), tape.arm(q, tape.pinned(q, on_q, to + SECOND), self.pin)
        a, b = np.abs(arms[0]), np.abs(arms[1])
        tape.add(self.instruction, to, numbers=(a, b, tape.branch(self.pin, self.branch), 1 / arms[0], 1 / arms[1]))
