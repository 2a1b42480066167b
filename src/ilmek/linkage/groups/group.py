"""What a group is to the plan: some bodies that can be solved together once the bodies they hang on are known.

A file of this package holds one kind of group: its leaf formulas, the step that applies them, and the function that
recognises it.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from ilmek.arrays import RealField
from ilmek.errors import MechanismError
from ilmek.linkage.body_jerk import BodyJerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.model import Coupling, Input, Joint, Mechanism

Columns: TypeAlias = tuple[Any, ...]
"""What is kept of a body's motion, real and complex fields: enough for `Step.place` to give all of it back."""

Known: TypeAlias = Mapping[str, BodyMotion]
"""Motions of the bodies already solved, by name."""

KnownJerks: TypeAlias = Mapping[str, BodyJerk]
"""The same with their jerks."""


@dataclass(frozen=True, slots=True)
class InputMotion:
    """An input's course: value [rad or m], speed, acceleration and jerk, a number or one a sample."""

    value: RealField
    speed: RealField
    acceleration: RealField
    jerk: RealField = 0.0

    def part(self, chosen: Any) -> "InputMotion":
        """Some of its samples, as a slice or mask chooses them."""
        fields = (self.value, self.speed, self.acceleration, self.jerk)
        return InputMotion(*(field[chosen] if isinstance(field, np.ndarray) else field for field in fields))


@dataclass(frozen=True, slots=True)
class GroupSolution:
    """A step's answer: the columns of each of its bodies, and how far from a dead centre it stands.

    margin  `best` at best, 0 at a dead centre, NaN where the step cannot be solved; either sign; None where it cannot
            fail
    """

    columns: Mapping[str, Columns]
    margin: RealField | None = None
    best: float = 1.0


class Step(ABC):
    """A group ready to be solved. Steps are frozen records of numbers; they keep nothing of a motion.

    As it stands, a step that cannot fail; the others say by how much they do.
    """

    __slots__ = ()

    @property
    @abstractmethod
    def bodies(self) -> tuple[str, ...]:
        """The bodies it solves."""

    @property
    @abstractmethod
    def parents(self) -> tuple[str, ...]:
        """The bodies it hangs on."""

    @property
    @abstractmethod
    def words(self) -> str:
        """What it is, for people."""

    @abstractmethod
    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:
        """The bodies' columns at every sample."""

    @abstractmethod
    def place(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The bodies' motions from their columns."""

    @abstractmethod
    def jerk(
        self,
        known: KnownJerks,
        placed: Known,
        columns: Mapping[str, Columns],
        drives: Mapping[str, InputMotion],
    ) -> Mapping[str, BodyJerk]:
        """The bodies' jerks: the equations of `solve` differentiated once more, each with another right side.

        known  jerks of the bodies it hangs on         placed  the bodies' own motions, from their columns
        """

    @property
    def size(self) -> float:
        """Its largest length [m]."""
        return 0.0

    @property
    def failure(self) -> str:
        """Name of the Status of a sample that it cannot solve."""
        return "CANNOT_CLOSE"

    def gap(self, known: Known) -> RealField:  # noqa: ARG002 - for the steps that can fail
        """By how much it fails to close [m], 0 where it closes, NaN where what it hangs on is lost."""
        return 0.0

    def shortfall(self, known: Known) -> tuple[str, str]:  # noqa: ARG002 - for the steps that can fail
        """The worst gap of the samples in words, and what would mend it."""
        return "", ""


@dataclass(frozen=True, slots=True)
class Group:
    """Bodies whose joints and inputs, to each other and to known bodies, leave them no freedom."""

    mechanism: Mechanism
    bodies: tuple[str, ...]
    joints: tuple[Joint, ...]
    inputs: tuple[Input, ...]
    couplings: tuple[Coupling, ...] = ()

    @property
    def freedom(self) -> int:
        """Freedoms that joints, couplings and inputs leave by count: 3 a body less 2, 1 and 1 [Gruebler's count]."""
        return 3 * len(self.bodies) - 2 * len(self.joints) - len(self.inputs) - len(self.couplings)

    @property
    def inner(self) -> tuple[Joint, ...]:
        """Joints between two of its bodies."""
        return tuple(joint for joint in self.joints if set(joint.bodies) <= set(self.bodies))

    @property
    def outer(self) -> tuple[Joint, ...]:
        """Joints to known bodies."""
        return tuple(joint for joint in self.joints if not set(joint.bodies) <= set(self.bodies))

    @property
    def parents(self) -> tuple[str, ...]:
        """The known bodies it hangs on, in the mechanism's order."""
        touched = {body for held in (*self.outer, *self.couplings) for body in held.bodies} - set(self.bodies)
        return tuple(body.name for body in self.mechanism.bodies if body.name in touched)

    @property
    def is_dyad(self) -> bool:
        """Whether it is two undriven bodies with a joint between them and one joint each to known bodies."""
        hung = {body for joint in self.outer for body in joint.bodies} & set(self.bodies)
        return len(self.bodies) == len(hung) == len(self.outer) == 2 and len(self.inner) == 1 and not self.inputs

    @property
    def reach(self) -> float:
        """Largest coordinate of any body's point [m], the ground's too: the scale of its lengths; 1 if all are 0."""
        return max(abs(point) for body in self.mechanism.bodies for point in body.points.values()) or 1.0

    def outer_of(self, body: str) -> tuple[Joint, ...]:
        """Joints between that body and known bodies."""
        return tuple(joint for joint in self.outer if body in joint.bodies)

    def beyond(self, joint: Joint, body: str) -> str:
        """The other body at a joint."""
        first, second = joint.bodies
        return second if body == first else first

    def arm(self, body: str, start: str, end: str) -> complex:
        """From one point of a body to another, in its frame [m]. Raises MechanismError where they coincide."""
        arm = self.mechanism.point(body, end) - self.mechanism.point(body, start)
        if arm == 0:
            raise MechanismError(
                f"link {body!r} of {self.mechanism.name} has zero length: {start} and {end} coincide",
                do="give it a length above 0",
                about=("bodies", body, "points", end),
            )
        return arm

    def branch(self, joint: str) -> int:
        """The branch said for a free pin. Raises MechanismError where none is."""
        branches = self.mechanism.branches
        if joint not in branches:
            raise MechanismError(
                f"{self.mechanism.name} has no branch for the free pin {joint!r} of {' and '.join(self.bodies)}",
                allowed="+1 or -1",
                do=f"say branches={{{joint!r}: +1}}",
                about=("joints", joint),
            )
        return branches[joint]
