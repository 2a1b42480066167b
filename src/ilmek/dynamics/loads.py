"""External loads on a mechanism: gravity, forces at points, torques.

A load is resolved into wrenches: a force at a point of a body, and a torque. Forces and torques are constant, given by
sample, or functions of the motion (a spring, a fabric's resistance, air drag). Directions are those of the ground
frame; torques are positive counter-clockwise.
"""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np

from ilmek.arguments import Arguments
from ilmek.arrays import ComplexField, RealField
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.pose_block import cut
from ilmek.errors import MechanismError
from ilmek.linkage.joints import FreePoint, set_points
from ilmek.linkage.motion import Motion
from ilmek.records import record, shown_value

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

    def part(self, part: slice) -> Wrench:
        """The wrench at the samples `part`."""
        return Wrench(self.body, cut(self.force, part), self.at, cut(self.torque, part))


@runtime_checkable
class Load(Protocol):
    """A load that can be resolved into wrenches: `Gravity`, `PointForce`, `Torque`, `Spring`, or a class of one's own.

    >>> isinstance(Gravity(-9.81j), Load)
    True
    """

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:
        """The wrenches of this load over the motion."""


@dataclass(frozen=True, slots=True)
class Gravity:
    """Gravity on every body at its mass centre; `acceleration` [m/s²], complex or (x, y), such as -9.81j.

    Raises MechanismError for a real number other than 0: gravity along x is nearly always a slip.

    >>> Gravity((0, -9.81))
    Gravity(acceleration=-9.81j)
    >>> Gravity(9.81)
    Traceback (most recent call last):
    ...
    ilmek.errors.MechanismError: gravity is 9.81 m/s², along x; it is a vector; write -9.81j, or complex(9.81) along x
    """

    acceleration: complex

    def __post_init__(self) -> None:
        object.__setattr__(self, "acceleration", gravity_vector(self.acceleration))

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench per body."""
        for body, inertia in inertias.items():
            yield Wrench(body, inertia.mass * self.acceleration, inertia.centre)


def gravity_vector(acceleration: object) -> complex:
    """An acceleration of gravity [m/s²]. Raises MechanismError for a real number other than 0."""
    given = Arguments("gravity", MechanismError)
    vector = given.point("acceleration", acceleration, unit="m/s^2")
    if vector and not isinstance(acceleration, complex | np.complexfloating | tuple | list | np.ndarray):
        size = abs(vector.real)
        do = f"write -{size:g}j, or complex({vector.real:g}) along x"
        raise MechanismError(f"gravity is {vector.real:g} m/s², along x", allowed="it is a vector", do=do)
    return vector


def sampled(law: object, motion: Motion, body: str) -> Any:
    """A force or torque on a body over the samples of a motion.

    Raises MechanismError for an unknown body and another number of values.
    """
    motion.plan.mechanism.body(body)
    values = law(motion) if callable(law) else law
    array = np.asarray(values)
    if array.dtype.kind not in "iufc" or not _fits(array.shape, motion.status.shape):
        allowed = f"a number, or one for each of the {len(motion)} samples"
        raise MechanismError(f"the load on {body!r} is {shown_value(values)}", allowed=allowed)
    return values


def _fits(shape: tuple[int, ...], samples: tuple[int, ...]) -> bool:
    """Whether an array is one number, one a sample, or one a variant."""
    own = (1,) * (len(samples) - len(shape)) + shape
    return len(own) == len(samples) and all(n in (1, m) for n, m in zip(own, samples, strict=True))


@record
class PointForce:
    """A force [N] on a point of a body, "body.point".

    The force is complex or (x, y): constant, an array of one per sample (NaN where there is none), or a function of the
    motion.

    >>> PointForce("rocker.E", (0, -60)).force
    -60j
    """

    on: FreePoint
    force: ForceLaw

    def __post_init__(self) -> None:
        given = Arguments("a point force", MechanismError)
        set_points(self, "on")
        if not callable(self.force):
            object.__setattr__(self, "force", given.vectors("force", self.force, "N"))

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        body, local = motion.plan.mechanism.located(self.on)
        yield Wrench(body, sampled(self.force, motion, body), local)


@record
class Torque:
    """A torque [N m] on a body, counter-clockwise: constant, an array of one per sample, or a function of the motion.

    >>> Torque("rocker", "5N*m").torque
    5.0
    """

    body: str
    torque: TorqueLaw

    def __post_init__(self) -> None:
        given = Arguments("a torque", MechanismError)
        object.__setattr__(self, "body", given.text("body", self.body))
        if not callable(self.torque):
            object.__setattr__(self, "torque", given.values("torque", self.torque, "N*m", finite=False))

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        torque = sampled(self.torque, motion, self.body)
        yield Wrench(self.body, 0j, 0j, torque)
