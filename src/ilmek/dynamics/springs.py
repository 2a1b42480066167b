"""Springs and dampers between two bodies, straight and turning.

Either stands between a body and any other, the ground too; the one pulls on both alike, so that it does no work on a
mechanism that moves as a whole.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.dynamics.attached import attached
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Wrench
from ilmek.errors import MechanismError
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import dot


@dataclass(frozen=True, slots=True)
class Spring:
    """A straight spring and damper between points of two bodies: F = k (L - L_0) + c L', a pull where positive.

    stiffness  k [N/m]        length  L_0, unloaded [m]        damping  c [N s/m]; a damper alone has no stiffness

    The pull has no direction where the points coincide: NaN there. Raises MechanismError for numbers that are negative
    or not finite.
    """

    first: str
    first_point: str
    second: str
    second_point: str
    stiffness: float
    length: float
    damping: float = 0.0

    def __post_init__(self) -> None:
        for name in ("stiffness", "length", "damping"):
            _require(name, getattr(self, name), least=0.0)

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """The pull on either body, towards the other."""
        mechanism = motion.plan.mechanism
        ends = (mechanism.point(self.first, self.first_point), mechanism.point(self.second, self.second_point))
        start, end = attached(motion, self.first, ends[0]), attached(motion, self.second, ends[1])
        apart = end.position - start.position
        length = np.abs(apart)
        with np.errstate(invalid="ignore", divide="ignore"):
            along = apart / length
        parting = dot(along, end.velocity - start.velocity)
        pull = (self.stiffness * (length - self.length) + self.damping * parting) * along
        return Wrench(self.first, pull, ends[0]), Wrench(self.second, -pull, ends[1])


@dataclass(frozen=True, slots=True)
class TorsionSpring:
    """A turning spring and damper between two bodies: T = -k (theta - theta_0) - c omega on the second.

    theta is the second body's angle against the first. The spring is wound by less than half a turn either way: every
    sample is judged by itself, and a turn more cannot be told from none.

    stiffness  k [N m/rad]     angle  theta_0, unloaded [rad]     damping  c [N m s/rad]
    """

    first: str
    second: str
    stiffness: float
    angle: float = 0.0
    damping: float = 0.0

    def __post_init__(self) -> None:
        for name in ("stiffness", "damping"):
            _require(name, getattr(self, name), least=0.0)
        _require("angle", self.angle, least=-math.inf)

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """The torque on the second body, and the opposite on the first."""
        turned = motion.direction(self.second) * np.conj(motion.direction(self.first))
        wound = np.angle(turned * np.exp(-1j * self.angle))
        spin = motion.omega(self.second) - motion.omega(self.first)
        torque = -self.stiffness * wound - self.damping * spin
        return Wrench(self.first, 0j, 0j, -torque), Wrench(self.second, 0j, 0j, torque)


def _require(name: str, value: float, *, least: float) -> None:
    if not (math.isfinite(value) and value >= least):
        allowed = "a finite number" if least < 0 else "finite and not negative"
        raise MechanismError(f"{name} of a spring is {value:g}", allowed=allowed)
