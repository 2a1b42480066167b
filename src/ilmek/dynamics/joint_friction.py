"""Friction in pins and slides: Coulomb's, which follows from the forces that it changes, and viscous.

    pin      T = -mu r |F| sgn(omega) - c omega                        F the pin's force, r its radius
    slide    F = -mu (|N_1| + |N_2|) sgn(v) - c v                      N_1, N_2 at the ends of a guidance of length b
             N_1,2 = N / 2 +- C / b,   |N_1| + |N_2| = max(|N|, 2 |C| / b)
                                                                       N across the line, C the couple

The joints' forces are linear in the frictions x, F = F_0 + Σ x_k G_k, each G_k the answer to a unit of friction. Thus
x + sgn mu |F(x)| = 0 is solved by Newton's method on as many numbers as joints rub. Where it has no solution, no force
of the drive keeps up the motion: the mechanism locks itself. A solution that is not joined to the frictionless one as
mu grows from nought (the Jacobian's determinant has turned negative on the way) is one of those too.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, RealField
from ilmek.dynamics.equations import Needs, add, joint_pulls
from ilmek.dynamics.friction import MOMENT
from ilmek.dynamics.pose_block import ForceAndMoment, JointPoses, PoseBlock
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import carried_acceleration
from ilmek.linkage.model import Mechanism, Pin, Slide
from ilmek.num.linear import solve_many
from ilmek.plane.vectors import dot

ROUNDS = 50
TOLERANCE = 1e-12
"""Friction is consistent with the forces to this part of the greatest friction of its joint that the forces allow."""


@dataclass(frozen=True, slots=True)
class PinFriction:
    """A pin that rubs: `radius` [m], coefficient mu, and viscous `drag` c [N m s]."""

    joint: str
    radius: float
    coefficient: float
    drag: float = 0.0

    def __post_init__(self) -> None:
        _require(self.joint, radius=self.radius, coefficient=self.coefficient, drag=self.drag)

    def size(self, held: JointPoses, pull: ForceAndMoment) -> RealField:  # noqa: ARG002
        """The greatest torque [N m] that Coulomb's friction gives under a pin's force."""
        return self.coefficient * self.radius * np.abs(pull.force)

    def slope(self, held: JointPoses, pull: ForceAndMoment, change: ForceAndMoment) -> RealField:  # noqa: ARG002
        """How `size` follows a small change of the pull."""
        force = np.abs(pull.force)
        along = np.divide(dot(pull.force, change.force), force, out=np.zeros_like(force), where=force > 0)
        return self.coefficient * self.radius * along


@dataclass(frozen=True, slots=True)
class SlideFriction:
    """A slide that rubs: `breadth` b of the guidance along the line [m], mu, and viscous `drag` c [N s/m].

    The guidance reaches as far to either side of the body's point of the slide's name.
    """

    joint: str
    breadth: float
    coefficient: float
    drag: float = 0.0

    def __post_init__(self) -> None:
        _require(self.joint, coefficient=self.coefficient, drag=self.drag)
        if not (math.isfinite(self.breadth) and self.breadth > 0):
            raise MechanismError(f"breadth of slide {self.joint!r} is {self.breadth:g} m", allowed="finite and above 0")

    def size(self, held: JointPoses, pull: ForceAndMoment) -> RealField:
        """The greatest force [N] that Coulomb's friction gives under a slide's force and couple."""
        across, couple = self._parts(held, pull)
        return self.coefficient * np.maximum(np.abs(across), np.abs(couple))

    def slope(self, held: JointPoses, pull: ForceAndMoment, change: ForceAndMoment) -> RealField:
        """How `size` follows a small change of the pull."""
        across, couple = self._parts(held, pull)
        to_across, to_couple = self._parts(held, change)
        leaning = np.abs(across) >= np.abs(couple)
        return self.coefficient * np.where(leaning, np.sign(across) * to_across, np.sign(couple) * to_couple)

    def _parts(self, held: JointPoses, pull: ForceAndMoment) -> tuple[RealField, RealField]:
        """N and 2 C / b."""
        line = held.line if held.line is not None else 1 + 0j
        return dot(1j * line, pull.force), 2 * pull.moment / self.breadth


JointFriction: TypeAlias = PinFriction | SlideFriction


def check_joints(mechanism: Mechanism, rubbing: Sequence[JointFriction]) -> None:
    """Raise MechanismError for friction in a joint that is unknown, of the other kind, or named twice."""
    for one in rubbing:
        joint, wanted = mechanism.joint(one.joint), Pin if isinstance(one, PinFriction) else Slide
        if not isinstance(joint, wanted):
            raise MechanismError(
                f"{type(one).__name__} is given for {one.joint!r}, a {type(joint).__name__.lower()}",
                allowed=f"it is for a {wanted.__name__.lower()}",
            )
        if sum(other.joint == one.joint for other in rubbing) > 1:
            raise MechanismError(f"friction in joint {one.joint!r} is given twice", do="give it once")


def frictions(
    posed: PoseBlock, needed: Needs, rubbing: Sequence[JointFriction], side: RealField
) -> tuple[dict[str, FloatArray], BoolArray]:
    """Friction on each rubbing joint's `on` body [N m, or N along the line], and where the mechanism locks itself.

    needed  without friction        side  where a joint turns round: +1 just after in time, -1 just before
    """
    samples = posed.motion.status.shape[0]
    joints = [posed.joints[one.joint] for one in rubbing]
    rates = np.stack([np.broadcast_to(posed.rate(joint), samples) for joint in joints])
    viscous = -np.array([[one.drag] for one in rubbing]) * rates
    rest = loaded(posed, needed, dict(zip((one.joint for one in rubbing), viscous, strict=True)))
    frictionless = joint_pulls(posed, rest)
    nothing = {body: ForceAndMoment(0j, 0.0) for body in needed}
    answers = [joint_pulls(posed, loaded(posed, nothing, {joint.name: np.ones(samples)})) for joint in joints]
    signs = np.sign(rates + _moment(posed, side) * np.stack([_second_rate(posed, joint) for joint in joints]))
    coulomb, locked = _consistent(joints, rubbing, signs, frictionless, answers)
    return {one.joint: found for one, found in zip(rubbing, viscous + coulomb, strict=True)}, locked


def loaded(posed: PoseBlock, needed: Needs, efforts: Mapping[str, FloatArray]) -> Needs:
    """The needs under efforts in joints [N m, or N], each on the joint's `on` body and back on the other."""
    changed = dict(needed)
    for name, effort in efforts.items():
        joint = posed.joints[name]
        for body, sign in ((joint.on, -1), (joint.by, +1)):
            pull = ForceAndMoment(sign * effort * joint.drive.force, sign * effort * joint.drive.moment)
            add(changed, posed, body, pull, joint.at)
    return changed


def _consistent(
    joints: Sequence[JointPoses],
    rubbing: Sequence[JointFriction],
    signs: FloatArray,
    frictionless: Mapping[str, ForceAndMoment],
    answers: Sequence[Mapping[str, ForceAndMoment]],
) -> tuple[FloatArray, BoolArray]:
    """Coulomb's frictions, one row a joint, and where there are none; Newton's method on all samples at once."""
    x = np.zeros_like(signs)
    greatest = np.zeros_like(signs)
    for _ in range(ROUNDS):
        pulls = [_sum(frictionless[joint.name], [answer[joint.name] for answer in answers], x) for joint in joints]
        sizes = np.stack([one.size(joint, pull) for one, joint, pull in zip(rubbing, joints, pulls, strict=True)])
        greatest = np.fmax(greatest, sizes)
        residual = x + signs * sizes
        slopes = [
            [one.slope(joint, pull, answer[joint.name]) for answer in answers]
            for one, joint, pull in zip(rubbing, joints, pulls, strict=True)
        ]
        matrix = np.eye(len(joints)) + np.moveaxis(signs[:, None] * np.array(slopes), -1, 0)
        off = np.abs(residual) > TOLERANCE * greatest
        if not off.any():
            break
        x = x - solve_many(matrix, np.ascontiguousarray(residual.T)).T
    joined = np.linalg.det(np.where(np.isfinite(matrix), matrix, 0.0)) > 0
    locked: BoolArray = off.any(axis=0) | ~joined | ~np.isfinite(x).all(axis=0)
    return np.where(locked, np.nan, x), locked


def _sum(rest: ForceAndMoment, answers: Sequence[ForceAndMoment], x: FloatArray) -> ForceAndMoment:
    force = rest.force + sum(size * answer.force for size, answer in zip(x, answers, strict=True))
    return ForceAndMoment(
        force, rest.moment + sum(size * answer.moment for size, answer in zip(x, answers, strict=True))
    )


def _moment(posed: PoseBlock, side: RealField) -> RealField:
    """The time by which a joint's turning round is judged early or late [s]."""
    speeds = [np.abs(np.asarray(drive.speed, dtype=float)) for drive in posed.motion.drives.values()]
    fastest = np.asarray(sum(speeds))
    if not fastest.all():
        raise MechanismError(
            f"friction in {posed.motion.plan.mechanism.name} has no direction: its inputs stand still",
            do="give an input a speed",
        )
    moment: RealField = np.asarray(side) * MOMENT / fastest
    return moment


def _second_rate(posed: PoseBlock, joint: JointPoses) -> FloatArray:
    """Rate of the joint's rate where that is zero [rad/s², m/s²]."""
    on, by = posed.bodies[joint.on], posed.bodies[joint.by]
    if joint.line is None:
        second = on.alpha - by.alpha
    else:
        first, other = (
            carried_acceleration(moved.anchor.acceleration, joint.at - moved.anchor.position, moved.omega, moved.alpha)
            for moved in (on, by)
        )
        second = dot(joint.line, first - other)
    return np.broadcast_to(np.asarray(second, dtype=float), posed.motion.status.shape)


def _require(joint: str, **sizes: float) -> None:
    for name, size in sizes.items():
        if not (math.isfinite(size) and size >= 0):
            raise MechanismError(f"{name} of joint {joint!r} is {size:g}", allowed="finite and not negative")
