"""A body turned by an input about a pin on a known body: theta = theta_carrier + input.

Its rates are the sums of those of carrier and input; its points move as in `linkage.body_motion` [Norton, Design of
Machinery, chapters 6 and 7: relative motion].
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.body_jerk import BodyJerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.kernels import ALPHA, BLOCK, BODY, DIRECTION, OMEGA, Instruction, pair, put
from ilmek.linkage.model import GROUND, Pin, Rotation
from ilmek.linkage.tape import Tape
from ilmek.num.compiled import compiled
from ilmek.num.sincos import sincos
from ilmek.plane.vectors import unit


def pinned(on: BodyMotion, hinge: complex, at: complex, columns: Columns) -> BodyMotion:
    """A body pinned at `at` [m] of its frame to `hinge` [m] of a known body; columns: direction, omega, alpha."""
    direction, omega, alpha = columns
    return BodyMotion(on.carry(hinge), at, direction, omega, alpha)


_sincos = compiled(sincos)


@compiled
def _kernel(body: FloatArray, carrier: FloatArray, drive: FloatArray, count: int, numbers: ComplexArray) -> None:
    """Direction and rates of a driven body; its anchor is already written. Number: sign."""
    sign = numbers[0].real
    for i in range(min(count, BLOCK)):
        sine, cosine = _sincos(sign * drive[i])
        put(body, DIRECTION * BLOCK + i, pair(carrier, DIRECTION * BLOCK + i) * complex(cosine, sine))
        body[OMEGA * BLOCK + i] = carrier[OMEGA * BLOCK + i] + sign * drive[BLOCK + i]
        body[ALPHA * BLOCK + i] = carrier[ALPHA * BLOCK + i] + sign * drive[2 * BLOCK + i]


@dataclass(frozen=True, slots=True)
class DrivenCrank(Step):
    """A driven body, pinned at `hinge` of the carrier and `at` of its own frame [m]; `sign` -1 turns it backwards."""

    kind: ClassVar[str] = "input"
    instruction: ClassVar[Instruction] = Instruction(_kernel)

    body: str
    carrier: str
    entry: str
    hinge: complex
    at: complex
    sign: int

    @property
    def bodies(self) -> tuple[str, ...]:
        """The driven body."""
        return (self.body,)

    @property
    def parents(self) -> tuple[str, ...]:
        """The carrier."""
        return (self.carrier,)

    @property
    def description(self) -> str:
        """Description of the step for users."""
        return f"{self.body} turned by the input on {self.carrier}"

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:
        """Direction, angular velocity and acceleration of the driven body."""
        carrier, drive = known[self.carrier], drives[self.entry]
        value, speed, acceleration = drive.value, drive.speed, drive.acceleration
        if self.sign < 0:
            value, speed, acceleration = -value, -speed, -acceleration
        direction = unit(value) if self.carrier == GROUND else carrier.direction * unit(value)
        return GroupSolution({self.body: (direction, carrier.omega + speed, carrier.alpha + acceleration)})

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The driven body, anchored at its pin."""
        return {self.body: pinned(known[self.carrier], self.hinge, self.at, columns[self.body])}

    def jerk(
        self,
        known: KnownJerks,
        located: Known,
        columns: Mapping[str, Columns],  # noqa: ARG002 - common signature
        drives: Mapping[str, InputMotion],
    ) -> Mapping[str, BodyJerk]:
        """Jerk of the driven body: the input's jerk plus the carrier's."""
        carrier, jerk = known[self.carrier], drives[self.entry].jerk
        beta = carrier.beta + (jerk if self.sign > 0 else -jerk)
        return {self.body: BodyJerk(located[self.body], carrier.carry(self.hinge), beta)}

    @classmethod
    def recognise(cls, group: Group) -> Step | None:
        """The group as a driven turning body, or None."""
        if len(group.bodies) != 1 or len(group.joints) != 1:
            return None
        (body,), (joint,), mechanism = group.bodies, group.joints, group.mechanism
        entry = next((entry for entry in group.inputs if entry.joint == joint.name), None)
        if not isinstance(joint, Pin) or not isinstance(entry, Rotation):
            return None
        carrier = group.beyond(joint, body)
        sign = 1 if entry.body == body else -1
        hinge, at = mechanism.point(carrier, joint.name), mechanism.point(body, joint.name)
        return cls(body, carrier, entry.name, hinge, at, sign)

    def write(self, tape: Tape) -> None:
        """The pin, then the turned body."""
        to = tape.room(BODY)
        tape.pinned(self.body, self.carrier, to)
        tape.add(self.instruction, to, tape.rows[self.carrier], tape.drive(self.entry), (self.sign,))
