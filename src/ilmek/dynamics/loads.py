"""External loads on a mechanism: gravity, forces at points, torques.

A load is resolved into wrenches: a force at a point of a body, and a torque. Forces and torques are constant, given by
sample, or functions of the motion (a spring, a fabric's resistance, air drag). Directions are those of the ground
frame; torques are positive counter-clockwise.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Protocol, TypeAlias, runtime_checkable

from ilmek.arrays import ComplexField, RealField
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.pose_block import cut
from ilmek.linkage.motion import Motion
from ilmek.records import record

ForceLaw: TypeAlias = ComplexField | Callable[[Motion], ComplexField]
"""A force [N], complex: a number, one value per sample, or a function of the motion."""

TorqueLaw: TypeAlias = RealField | Callable[[Motion], RealField]
"""A torque [N m]: a number, one value per sample, or a function of the motion."""


@record
class Wrench:
    """A force [N] at the point `at` of a body's frame [m], and a torque [N m]: numbers, or one value per sample."""

    body: str
    force: ComplexField
    at: complex
    torque: RealField = 0.0

    def part(self, part: slice) -> "Wrench":
        """The wrench at the samples `part`."""
        return Wrench(self.body, cut(self.force, part), self.at, cut(self.torque, part))


@runtime_checkable
class Load(Protocol):
    """A load that can be resolved into wrenches."""

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:
        """The wrenches of this load over the motion."""


@dataclass(frozen=True, slots=True)
class Gravity:
    """Gravity on every body at its mass centre; `acceleration` [m/s²], complex, such as -9.81j."""

    acceleration: complex

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench per body."""
        for body, inertia in inertias.items():
            yield Wrench(body, inertia.mass * self.acceleration, inertia.centre)


@record
class PointForce:
    """A force [N] on a point of a body, given by its name or by its position in the body's frame [m]."""

    body: str
    point: str | complex
    force: ForceLaw

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        force = self.force(motion) if callable(self.force) else self.force
        local = motion.plan.mechanism.point(self.body, self.point) if isinstance(self.point, str) else self.point
        yield Wrench(self.body, force, local)


@record
class Torque:
    """A torque [N m] on a body, counter-clockwise."""

    body: str
    torque: TorqueLaw

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        torque = self.torque(motion) if callable(self.torque) else self.torque
        yield Wrench(self.body, 0j, 0j, torque)
