"""Springs and dampers between two bodies: linear and torsional.

Either body may be the ground. The forces on the two bodies are equal and opposite: they do no work when both bodies
move together.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arguments import Arguments
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Wrench
from ilmek.errors import MechanismError
from ilmek.linkage.followed import followed_angle
from ilmek.linkage.joints import NamedPoint, set_points
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import dot

_SPRING = Arguments("a spring", MechanismError)


@dataclass(frozen=True, slots=True)
class Spring:
    """A linear spring and damper between points of two bodies: F = k (L - L_0) + c L', tension positive.

    first, second   points of two bodies, "body.point"
    stiffness  k [N/m]; 0 for a damper alone
    length     L_0, unloaded [m]
    damping    c [N s/m]

    The force is NaN where the points coincide: it has no direction there. Raises MechanismError for values that are
    negative or not finite.

    >>> Spring("ground.S", "rocker.E", stiffness="2N/mm", length=0.1).stiffness
    2000.0
    """

    first: NamedPoint
    second: NamedPoint
    stiffness: float
    length: float
    damping: float = 0.0

    def __post_init__(self) -> None:
        set_points(self, "first", "second")
        for name, unit in (("stiffness", "N/m"), ("length", "m"), ("damping", "N*s/m")):
            object.__setattr__(self, name, _SPRING.not_negative(name, getattr(self, name), unit))

    @property
    def ends(self) -> tuple[tuple[str, str], tuple[str, str]]:
        """Body and point of `first` and of `second`."""
        return self.first, self.second  # type: ignore[return-value]  # texts became pairs when it was made

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """The force on each of the two bodies, one value per sample."""
        ends = [motion.plan.mechanism.located(point) for point in self.ends]
        start, end = (motion.carried(*located) for located in ends)
        line = end.position - start.position
        length = np.abs(line)
        with np.errstate(invalid="ignore", divide="ignore"):
            along = line / length
        rate = dot(along, end.velocity - start.velocity)
        pull = (self.stiffness * (length - self.length) + self.damping * rate) * along
        (first, first_local), (second, second_local) = ends
        return Wrench(first, pull, first_local), Wrench(second, -pull, second_local)


@dataclass(frozen=True, slots=True)
class TorsionSpring:
    """A torsional spring and damper between two bodies: T = -k (theta - theta_0) - c omega on the second.

    theta is the angle of the second body relative to the first, counted through full turns: a function of the inputs'
    values (`linkage.followed`). Where inputs and couplings alone fix it, it is linear in them: an arm that an input
    turns about the ground has the angle of the input, at 720° two turns more than at 0°. Any other angle is within half
    a turn, (-pi, pi], with all inputs at 0, or where the mechanism closes nearest to that, and followed from there.

    stiffness  k [N m/rad]     angle  theta_0, unloaded [rad]     damping  c [N m s/rad]

    Raises MechanismError for values that are not finite, and for a negative stiffness or damping.
    """

    first: str
    second: str
    stiffness: float
    angle: float = 0.0
    damping: float = 0.0

    def __post_init__(self) -> None:
        for name, unit in (("stiffness", "N*m/rad"), ("damping", "N*m*s/rad")):
            object.__setattr__(self, name, _SPRING.not_negative(name, getattr(self, name), unit))
        object.__setattr__(self, "angle", _SPRING.number("angle", self.angle, "rad"))

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """The torque on the second body, and the opposite torque on the first, one value per sample."""
        wound = followed_angle(motion.plan, motion.drives, self.second, self.first) - self.angle
        spin = motion.omega(self.second) - motion.omega(self.first)
        torque = -self.stiffness * wound - self.damping * spin
        return Wrench(self.first, 0j, 0j, -torque), Wrench(self.second, 0j, 0j, torque)
