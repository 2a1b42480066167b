"""Groups of bodies that are solved together once the bodies to which they are attached are known.

A module of this package has one kind of group: its formulas, the step that applies them, and its recogniser.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

import numpy as np

from ilmek.arrays import RealField
from ilmek.errors import MechanismError
from ilmek.linkage.anchors import span
from ilmek.linkage.body_jerk import BodyJerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.kernels import Instruction
from ilmek.linkage.model import Coupling, Input, Joint, Mechanism, Slide
from ilmek.linkage.tape import Tape
from ilmek.records import record

Columns: TypeAlias = tuple[Any, ...]
"""The stored part of a body's motion, real and complex fields, from which `Step.locate` recovers all of it."""

Known: TypeAlias = Mapping[str, BodyMotion]
"""Motions of the solved bodies, by name."""

KnownJerks: TypeAlias = Mapping[str, BodyJerk]
"""Motions with jerks of the solved bodies, by name."""


@record
class InputMotion:
    """Motion of an input: value [rad or m] and its first to third rates, constant or (samples,)."""

    value: RealField
    speed: RealField
    acceleration: RealField
    jerk: RealField = 0.0

    def part(self, chosen: Any) -> "InputMotion":
        """The samples of a slice, a mask or an array of indices."""
        fields = (self.value, self.speed, self.acceleration, self.jerk)
        return InputMotion(*(field[chosen] if isinstance(field, np.ndarray) else field for field in fields))


@record
class GroupSolution:
    """The solution of a step: the columns of each body, and the distance from a dead centre.

    margin  at most `best` in magnitude, 0 at a dead centre, NaN where the step cannot be solved; None for a step that
            cannot fail
    """

    columns: Mapping[str, Columns]
    margin: RealField | None = None
    best: float = 1.0


class Step(ABC):
    """A group with all numbers for its solution, independent of any motion.

    A class of steps is a kind of group: one module with its formulas, and one row of `structure.GROUPS`. The defaults
    are those of a step that cannot fail.

    kind         "input", "gears", "dyad" or "general"
    symbol       of a dyad: its joints in order, R turning, P sliding
    instruction  its compiled form; None: it has none
    both_sides   whether it closes on both sides of its dead centre
    """

    __slots__ = ()

    kind: ClassVar[str]
    symbol: ClassVar[str] = ""
    instruction: ClassVar[Instruction | None] = None
    both_sides: ClassVar[bool] = False

    @classmethod
    @abstractmethod
    def recognise(cls, group: "Group") -> "Step | None":
        """The group as a step of this kind, or None.

        Raises MechanismError for a group of this kind that cannot be solved: without its branch, with a link of zero
        length.
        """

    @property
    @abstractmethod
    def bodies(self) -> tuple[str, ...]:
        """The bodies of the group."""

    @property
    @abstractmethod
    def parents(self) -> tuple[str, ...]:
        """The bodies to which it is attached."""

    @property
    @abstractmethod
    def description(self) -> str:
        """Description of the step for users."""

    @property
    def free(self) -> str:
        """The joint whose branch it has; "": it has one assembly."""
        return ""

    @abstractmethod
    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:
        """The bodies' columns at every sample."""

    @abstractmethod
    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The bodies' motions from their columns."""

    @abstractmethod
    def jerk(
        self, known: KnownJerks, located: Known, columns: Mapping[str, Columns], drives: Mapping[str, InputMotion]
    ) -> Mapping[str, BodyJerk]:
        """The bodies' jerks: the equations of `solve` differentiated once more, each with another right side.

        known  jerks of the known bodies         located  the bodies' own motions, from their columns
        """

    def write(self, tape: Tape) -> None:  # noqa: ARG002 - for the steps with a compiled form
        """Append its instructions to a tape. Raises MechanismError for a step without a compiled form."""
        raise MechanismError(
            f"{self.description}: not among the compiled groups",
            allowed="driven bodies and the dyads that have closed forms",
            do="use solve",
        )

    @property
    def size(self) -> float:
        """Its largest length [m]."""
        return 0.0

    @property
    def shortest(self) -> float:
        """The length [m] against which an error of its known points counts: that of its shortest link."""
        return self.size

    @property
    def lengths(self) -> tuple[float, ...]:
        """Lengths [m] by which angular accelerations of its bodies are compared; empty for steps that cannot fail."""
        return ()

    @property
    def failure(self) -> str:
        """Name of the Status of a sample without a solution."""
        return "CANNOT_CLOSE"

    def gap(self, known: Known) -> RealField:  # noqa: ARG002 - for the steps that can fail
        """Gap [m] by which the group does not close; 0 where it closes, NaN where a known body is NaN."""
        return 0.0

    def shortfall(self, known: Known) -> tuple[str, str]:  # noqa: ARG002 - for the steps that can fail
        """The greatest gap of the samples in words, and the remedy."""
        return "", ""


@dataclass(frozen=True, slots=True)
class Group:
    """Bodies with their joints, inputs and couplings to one another and to known bodies."""

    mechanism: Mechanism
    bodies: tuple[str, ...]
    joints: tuple[Joint, ...]
    inputs: tuple[Input, ...]
    couplings: tuple[Coupling, ...] = ()

    @property
    def degrees_of_freedom(self) -> int:
        """Remaining degrees of freedom, 3 bodies - 2 joints - inputs - couplings [Gruebler's criterion]."""
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
        """The known bodies to which it is attached, in the mechanism's order."""
        touched = {body for joint in (*self.outer, *self.couplings) for body in joint.bodies} - set(self.bodies)
        return tuple(body.name for body in self.mechanism.bodies if body.name in touched)

    @property
    def is_dyad(self) -> bool:
        """Whether it is two undriven bodies with a joint between them and one joint each to known bodies."""
        attached = {body for joint in self.outer for body in joint.bodies} & set(self.bodies)
        return len(self.bodies) == len(attached) == len(self.outer) == 2 and len(self.inner) == 1 and not self.inputs

    @property
    def span(self) -> float:
        """Largest distance of a body's point from the body's anchor [m]; see `anchors`."""
        return span(self.mechanism)

    @property
    def reach(self) -> float:
        """Largest coordinate of any body's point [m], including the ground: the scale of lengths; 1 if all are 0."""
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
        """The branch of a free pin or slide. Raises MechanismError where none is given."""
        branches = self.mechanism.branches
        if joint not in branches:
            kind = "slide" if isinstance(self.mechanism.joint(joint), Slide) else "free pin"
            raise MechanismError(
                f"{self.mechanism.name} has no branch for the {kind} {joint!r} of {' and '.join(self.bodies)}",
                allowed="+1 or -1",
                do=f"give one, in a file: branches = {{ {joint} = 1 }}",
                about=("joints", joint),
            )
        return branches[joint]
