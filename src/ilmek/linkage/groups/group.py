"""What a group is to the plan: some bodies that can be solved together once the bodies they hang on are known.

A file of this package holds one kind of group: its leaf formulas, the step that applies them, and the function that
recognises it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol, TypeAlias

from ilmek.arrays import ComplexField, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.model import Input, Joint, Mechanism

Columns: TypeAlias = tuple[ComplexField, ...]
"""What is kept of a body's motion, one field each: enough for `Step.place` to give all of it back."""

Known: TypeAlias = Mapping[str, BodyMotion]
"""Motions of the bodies already solved, by name."""


@dataclass(frozen=True, slots=True)
class Drive:
    """An input's course: value [rad or m], speed and acceleration, a number or one a sample."""

    value: RealField
    speed: RealField
    acceleration: RealField


@dataclass(frozen=True, slots=True)
class Solved:
    """A step's answer: the columns of each of its bodies, and how far from a dead centre it stands.

    margin  1 at best, 0 at a dead centre, NaN where the step cannot be solved; either sign; None where it cannot fail
    """

    columns: Mapping[str, Columns]
    margin: RealField | None = None


class Step(Protocol):
    """A group ready to be solved. Steps are frozen records of numbers; they keep nothing of a motion."""

    @property
    def bodies(self) -> tuple[str, ...]:
        """The bodies it solves."""

    @property
    def parents(self) -> tuple[str, ...]:
        """The bodies it hangs on."""

    @property
    def words(self) -> str:
        """What it is, for people."""

    def solve(self, known: Known, drives: Mapping[str, Drive]) -> Solved:
        """The bodies' columns at every sample."""

    def place(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The bodies' motions from their columns."""

    @property
    def size(self) -> float:
        """Its largest length [m]."""

    @property
    def failure(self) -> str:
        """Name of the Status of a sample that it cannot solve."""

    def gap(self, known: Known) -> RealField:
        """By how much it fails to close [m], 0 where it closes."""

    def shortfall(self, known: Known) -> tuple[str, str]:
        """The worst gap of the samples in words, and what would mend it."""


@dataclass(frozen=True, slots=True)
class Sure:
    """Part of a step that cannot fail."""

    @property
    def size(self) -> float:
        """Nothing to measure."""
        return 0.0

    @property
    def failure(self) -> str:
        """It never fails."""
        return "OK"

    def gap(self, known: Known) -> RealField:  # noqa: ARG002
        """It always closes."""
        return 0.0

    def shortfall(self, known: Known) -> tuple[str, str]:  # noqa: ARG002
        """Nothing is short."""
        return "", ""


@dataclass(frozen=True, slots=True)
class Group:
    """Bodies whose joints and inputs, to each other and to known bodies, leave them no freedom."""

    mechanism: Mechanism
    bodies: tuple[str, ...]
    joints: tuple[Joint, ...]
    inputs: tuple[Input, ...]

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
        touched = {body for joint in self.outer for body in joint.bodies} - set(self.bodies)
        return tuple(body.name for body in self.mechanism.bodies if body.name in touched)

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
            )
        return arm

    def branch(self, joint: str) -> int:
        """The branch said for a free joint. Raises MechanismError where none is."""
        branches = self.mechanism.branches
        if joint not in branches:
            raise MechanismError(
                f"{self.mechanism.name} has no branch for the free pin {joint!r} of {' and '.join(self.bodies)}",
                allowed="+1 or -1",
                do=f"say branches={{{joint!r}: +1}}",
            )
        return branches[joint]
