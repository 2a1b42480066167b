"""What acts on a mechanism from outside: weight, forces at points, torques.

A load is turned into wrenches, one a body and sample: a force at a point of the body, and a torque. Forces and torques
may be constant, one value a sample, or a function of the motion (a spring, a cloth's resistance, friction in air).
Directions are those of the world: x and y of the ground, torque counter-clockwise.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Protocol, TypeAlias, runtime_checkable

from ilmek.arrays import ComplexField, RealField
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.pose_block import cut
from ilmek.linkage.motion import Motion

ForceLaw: TypeAlias = ComplexField | Callable[[Motion], ComplexField]
"""A force [N], or how it follows from the motion."""

TorqueLaw: TypeAlias = RealField | Callable[[Motion], RealField]
"""A torque [N m], or how it follows from the motion."""


@dataclass(frozen=True, slots=True)
class Wrench:
    """A force [N] at a point of a body's frame [m], and a torque [N m] on that body: one number, or one a sample."""

    body: str
    force: ComplexField
    at: complex
    torque: RealField = 0.0

    def part(self, part: slice) -> "Wrench":
        """The same over some of the samples."""
        return Wrench(self.body, cut(self.force, part), self.at, cut(self.torque, part))


@runtime_checkable
class Load(Protocol):
    """Anything that can be resolved into wrenches."""

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:
        """The wrenches of this load over the motion."""


@dataclass(frozen=True, slots=True)
class Gravity:
    """Weight of every body at its mass centre; `acceleration` is the free fall [m/s²], such as -9.81j."""

    acceleration: complex

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench a body."""
        for body, inertia in inertias.items():
            yield Wrench(body, inertia.mass * self.acceleration, inertia.centre)


@dataclass(frozen=True, slots=True)
class PointForce:
    """A force [N] on a point of a body: the point by name, or where it is in the body's frame [m]."""

    body: str
    point: str | complex
    force: ForceLaw

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        force = self.force(motion) if callable(self.force) else self.force
        local = motion.plan.mechanism.point(self.body, self.point) if isinstance(self.point, str) else self.point
        yield Wrench(self.body, force, local)


@dataclass(frozen=True, slots=True)
class Torque:
    """A torque [N m] on a body, counter-clockwise."""

    body: str
    torque: TorqueLaw

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        torque = self.torque(motion) if callable(self.torque) else self.torque
        yield Wrench(self.body, 0j, 0j, torque)
