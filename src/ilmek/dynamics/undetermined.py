"""Forces that the equations of motion do not determine: belt tensions, and those of redundant constraints.

A belt pulls its two wheels together along their line of centres, by its tension. Gears with a ratio of 1 stand for
wheels that turn alike through an idler or a chain, whose forces on the wheels' middles are open in both directions.
A redundant constraint carries any force along the motion of the joint that it keeps still. Such a force T does no
work: any T fulfils the equations, with the joint forces F_0 + T G and the response G to a unit of it. What has G = 0
is determined. Friction of a joint whose force is open is open too, and what responds to it.
                                                                                       [null space of the equations]
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, ComplexField
from ilmek.dynamics.equations import Needs, add, joint_pulls
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.joint_friction import JointFriction
from ilmek.dynamics.pose_block import ForceAndMoment, JointPoses, PoseBlock, has_tension
from ilmek.linkage.model import GROUND, Coupling
from ilmek.linkage.status import Status
from ilmek.plane.vectors import cross
from ilmek.records import record

RESPONSE = 1e-6
"""Greatest response to a unit force, or to a unit torque over the mechanism's length, that counts as none."""


@record
class Undetermined:
    """What depends on the tension of belts and chains, and on redundant constraints.

    couplings  whose force is open      joints  with an open force      inputs  with an open effort
    frictions  joints with an open friction      bodies  with open forces within, as the strength of a link needs them
    redundant  joints that a redundant constraint keeps still      couples  slides of which only the couple is open
    """

    couplings: frozenset[str] = frozenset()
    joints: frozenset[str] = frozenset()
    inputs: frozenset[str] = frozenset()
    frictions: frozenset[str] = frozenset()
    bodies: frozenset[str] = frozenset()
    redundant: frozenset[str] = frozenset()
    couples: frozenset[str] = frozenset()

    def __or__(self, other: "Undetermined") -> "Undetermined":
        return Undetermined(*(getattr(self, one.name) | getattr(other, one.name) for one in fields(self)))

    def __bool__(self) -> bool:
        return bool(self.couplings or self.redundant)

    @property
    def cause(self) -> str:
        """What the open forces depend on, in words."""
        tension = f"the tension of {', '.join(sorted(self.couplings))}" if self.couplings else ""
        held = f"the redundant constraint at {', '.join(sorted(self.redundant))}" if self.redundant else ""
        return " and ".join(filter(None, (tension, held)))

    @property
    def names(self) -> frozenset[str]:
        """The joints and couplings with an open force, and the inputs with an open effort."""
        return self.couplings | self.joints | self.inputs

    @property
    def listed(self) -> list[str]:
        """All of them in words, with the slides of which the couple is open."""
        return sorted(self.names) + [f"couple of {name}" for name in sorted(self.couples)]


class _Acting(NamedTuple):
    """A force and moment about `at` on a body."""

    body: str
    pull: ForceAndMoment
    at: ComplexField


def undetermined(
    poses: PoseBlock, inertias: Mapping[str, Inertia], joint_frictions: Sequence[JointFriction]
) -> Undetermined:
    """What depends on the tension of the mechanism's belts and chains and on its redundant constraints.

    poses     a block of samples      inertias  body -> inertia, of all moving bodies
    joint_frictions  friction of joints
    """
    mechanism = poses.motion.plan.mechanism
    open_couplings = [coupling for coupling in mechanism.couplings if has_tension(coupling)]
    if not open_couplings and not mechanism.redundant:
        return Undetermined()
    nothing = {body: ForceAndMoment(0j, 0.0) for body in inertias}
    units = [unit for coupling in open_couplings for unit in _tensions(poses, coupling)]
    units += [_along(poses.joints[name]) for name in mechanism.redundant]
    forces, couples, inputs, bodies = set[str](), set[str](), set[str](), set[str]()
    rubbing = {law.joint for law in joint_frictions if law.dry}
    while units:
        acting = units.pop()
        pulls = joint_pulls(poses, _needs_of(poses, nothing, acting))
        response = _Response(poses, acting, pulls)
        forces |= response.forces()
        couples |= response.couples()
        units += [_along(poses.joints[name]) for name in sorted(rubbing & (forces | couples))]
        rubbing -= forces | couples
        inputs |= response.inputs()
        bodies |= response.bodies()
    frictions = (forces | couples) & {law.joint for law in joint_frictions if law.dry}
    names = (coupling.name for coupling in open_couplings)
    found = (names, forces, inputs, frictions, bodies, mechanism.redundant, couples - forces)
    return Undetermined(*map(frozenset, found))


def _tensions(poses: PoseBlock, coupling: Coupling) -> Iterator[list[_Acting]]:
    """The open unit forces of a coupling: along the line of centres of a belt; else any, against the carrier."""
    joint = poses.joints[coupling.name]
    ends = ((joint.on, joint.point_on(joint.on)), (joint.by, joint.at))
    if coupling.kind == "belt":
        offset = ends[0][1] - ends[1][1]
        pull = offset / np.abs(offset)
        yield [
            _Acting(body, ForceAndMoment(sign * pull, 0.0), at) for (body, at), sign in zip(ends, (-1, 1), strict=True)
        ]
        return
    for body, at in ends:
        for force in (1 + 0j, 1j):
            other = _Acting(coupling.carrier, ForceAndMoment(-force, 0.0), at)
            yield [_Acting(body, ForceAndMoment(force, 0.0), at), other]


def _along(joint: JointPoses) -> list[_Acting]:
    """A unit force or torque along the motion of a joint, on both of its bodies: of friction, or of a constraint."""
    effort = joint.drive
    return [
        _Acting(body, ForceAndMoment(sign * effort.force, sign * effort.moment), joint.at)
        for body, sign in ((joint.on, 1), (joint.by, -1))
    ]


def _needs_of(poses: PoseBlock, nothing: Needs, acting: Sequence[_Acting]) -> Needs:
    needed = dict(nothing)
    for body, pull, at in acting:
        add(needed, poses, body, ForceAndMoment(-pull.force, -pull.moment), at)
    return needed


@record
class _Response:
    """The response of the joints to unit forces."""

    poses: PoseBlock
    acting: Sequence[_Acting]
    pulls: Mapping[str, ForceAndMoment]

    def inputs(self) -> set[str]:
        """The inputs, or actuators, whose effort responds."""
        efforts = {name: effort for name, effort in self._efforts().items() if self._responds(effort)}
        return {name for name, joint in self.poses.drivers.items() if joint.name in efforts}

    def forces(self) -> set[str]:
        """The joints and couplings whose force responds, the effort of a drive aside; teeth by their moment too."""
        slides = {joint.name for joint in self.poses.joints.values() if joint.line is not None}
        return {
            name
            for name, pull in self._without_efforts().items()
            if self._responds(ForceAndMoment(pull.force, 0.0) if name in slides else pull)
        }

    def couples(self) -> set[str]:
        """The slides whose couple responds."""
        pulls = self._without_efforts()
        return {
            joint.name
            for joint in self.poses.joints.values()
            if joint.line is not None and self._responds(ForceAndMoment(0j, pulls[joint.name].moment))
        }

    def bodies(self) -> set[str]:
        """The moving bodies on which something is left at a place: the forces within depend on it."""
        by_body: dict[str, list[_Acting]] = {}
        for body, pull, at in self.acting:
            by_body.setdefault(body, []).append(_Acting(body, pull, at))
        for name, pull in self.pulls.items():
            joint = self.poses.joints[name]
            for body, sign in ((joint.on, 1), (joint.by, -1)):
                moment = sign * (pull.moment + cross(joint.at - joint.point_on(body), pull.force))
                acting = _Acting(body, ForceAndMoment(sign * pull.force, moment), joint.point_on(body))
                by_body.setdefault(body, []).append(acting)
        return {body for body, rows in by_body.items() if body != GROUND and self._left(rows)}

    def _left(self, rows: list[_Acting]) -> bool:
        """Whether forces at one place do not cancel, for any of the places."""
        while rows:
            at = rows[0].at
            here = [row for row in rows if not self._any(np.abs(row.at - at) > RESPONSE * self.poses.length)]
            rows = [row for row in rows if all(row is not other for other in here)]
            force, moment = sum(row.pull.force for row in here), sum(row.pull.moment for row in here)
            if self._responds(ForceAndMoment(np.asarray(force), np.asarray(moment))):
                return True
        return False

    def _efforts(self) -> dict[str, ForceAndMoment]:
        """The efforts of the drives, by joint."""
        efforts = {}
        for joint in self.poses.drivers.values():
            effort = joint.generalized_force(self.pulls[joint.name], joint.at)
            efforts[joint.name] = ForceAndMoment(effort * joint.drive.force, effort * joint.drive.moment)
        return efforts

    def _without_efforts(self) -> dict[str, ForceAndMoment]:
        efforts = self._efforts()
        none = ForceAndMoment(0j, 0.0)
        return {
            name: ForceAndMoment(
                pull.force - efforts.get(name, none).force, pull.moment - efforts.get(name, none).moment
            )
            for name, pull in self.pulls.items()
        }

    def _responds(self, pull: ForceAndMoment) -> bool:
        return self._any((np.abs(pull.force) > RESPONSE) | (np.abs(pull.moment) > RESPONSE * self.poses.length))

    def _any(self, samples: BoolArray | np.bool_) -> bool:
        """Whether a comparison holds at any sample that is solved."""
        return bool(np.any(np.asarray(samples) & (self.poses.motion.status == Status.OK)))
