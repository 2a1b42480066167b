"""Newton-Euler equations of a planar mechanism, solved Assur group by Assur group.

    Σ f = m a_G        Σ (p - G) x f + Σ t = J alpha        for each moving body, G its mass centre

"Needs" of a body are the force m a_G and the moment J alpha less its loads: the sum that its joints must transmit.
A group has three equations per body and as many unknowns: two constraint forces per joint, and the efforts of its
inputs. The groups are solved from the last to the first. Each passes its joint forces on to the bodies to which it is
attached [Assur's principle; for the equations of each link Norton, Design of Machinery, chapter 11]. Constraint forces
have no generalized force g on the relative motion of their joint:

    one body, one driven joint   the joint transmits all needs of the body
    a dyad                       with w the force of the inner joint on the first body:  g_A(need_1 - w) = 0,
                                 g_B(need_2 + w) = 0; two equations for the two components of w, for all kinds of dyads
    any other group              all its equations at once

Where actuators drive the motion in place of the inputs, their efforts A are those at which those of the inputs vanish:
Q_0 + R A = 0, with R the response of the inputs' efforts to a unit effort of each actuator.            [superposition]
"""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from ilmek.arrays import ComplexField, FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Wrench
from ilmek.dynamics.pose_block import ForceAndMoment, JointPoses, PoseBlock
from ilmek.linkage.groups.group import Step
from ilmek.linkage.model import GROUND
from ilmek.num.linear import solve_many
from ilmek.plane.vectors import cross

Needs = dict[str, ForceAndMoment]
"""Body -> force [N] and moment about the mass centre [N m] that its joints must transmit to it."""

Pulls = dict[str, ForceAndMoment]
"""Joint -> force [N] and moment about the joint's point [N m] on its `on` body."""


def needs(poses: PoseBlock, inertias: Mapping[str, Inertia], wrenches: Iterable[Wrench]) -> Needs:
    """Terms m a_G [N] and J alpha [N m] of each moving body, less its loads; one value per sample."""
    found = {
        body: ForceAndMoment(inertia.mass * poses.centres[body].acceleration, inertia.moment * poses.bodies[body].alpha)
        for body, inertia in inertias.items()
    }
    for wrench in wrenches:
        at = poses.point_motion(wrench.body, wrench.at).position
        add(found, poses, wrench.body, ForceAndMoment(-wrench.force, -wrench.torque), at)
    return found


def add(to: Needs, poses: PoseBlock, body: str, pull: ForceAndMoment, at: ComplexField) -> None:
    """Add a force and moment to the needs of a body; the moment is about `at` [m]. The ground is skipped."""
    if body != GROUND:
        moment = pull.moment + cross(at - poses.centres[body].position, pull.force)
        to[body] = ForceAndMoment(to[body].force + pull.force, to[body].moment + moment)


STILL = 1e-9
"""Motion of an actuator over that of the input, relative to its greatest, at which it stands still: a dead centre."""


def loaded(poses: PoseBlock, needed: Needs, efforts: Mapping[str, FloatArray]) -> Needs:
    """The needs under efforts in joints [N m; N]: on the joint's `on` body, and the opposite on the other; see `drive`.

    Returns needs of the same shapes, [N] and [N m] per sample.
    """
    changed = dict(needed)
    for name, effort in efforts.items():
        joint = poses.joints[name]
        for body, sign in ((joint.on, -1), (joint.by, +1)):
            pull = ForceAndMoment(sign * effort * joint.drive.force, sign * effort * joint.drive.moment)
            add(changed, poses, body, pull, joint.at)
    return changed


def joint_pulls(poses: PoseBlock, needed: Needs) -> Pulls:
    """Forces [N] and moments [N m] of all joints, including the drive efforts, one value per sample.

    poses  the block of samples      needed  of `needs`
    The values are inf or NaN where the equations are singular, NaN where the actuators stand still while inputs move.
    """
    pulls = _pulls_by_inputs(poses, needed)
    if not poses.actuators:
        return pulls
    samples = poses.motion.status.shape[0]
    nothing = {body: ForceAndMoment(0j, 0.0) for body in needed}
    responses = [_response(poses, name, nothing, samples) for name in poses.actuators]
    matrix = np.stack([input_efforts(poses, response, samples) for response in responses], axis=-1)
    size = np.abs(np.linalg.det(matrix))
    matrix[size <= STILL * np.fmax.reduce(size, initial=0.0)] = np.nan
    efforts = solve_many(matrix, -input_efforts(poses, pulls, samples))
    for response, effort in zip(responses, efforts.T, strict=True):
        pulls = {
            name: ForceAndMoment(
                pull.force + effort * response[name].force, pull.moment + effort * response[name].moment
            )
            for name, pull in pulls.items()
        }
    return pulls


def _response(poses: PoseBlock, actuator: str, nothing: Needs, samples: int) -> Pulls:
    """The forces of all joints to a unit effort of an actuator, with that effort in its own joint."""
    pulls = _pulls_by_inputs(poses, loaded(poses, nothing, {actuator: np.ones(samples)}))
    own, unit = pulls[actuator], poses.joints[actuator].drive
    return pulls | {actuator: ForceAndMoment(own.force + unit.force, own.moment + unit.moment)}


def input_efforts(poses: PoseBlock, pulls: Pulls, samples: int) -> FloatArray:
    """Efforts of the inputs, shape (samples, inputs)."""
    joints = [poses.joints[entry.joint] for entry in poses.motion.plan.mechanism.inputs]
    efforts = [joint.generalized_force(pulls[joint.name], joint.at) for joint in joints]
    return np.stack([np.broadcast_to(effort, samples) for effort in efforts], axis=-1)


def _pulls_by_inputs(poses: PoseBlock, needed: Needs) -> Pulls:
    """The forces of all joints where the inputs' own efforts drive the motion."""
    needed = dict(needed)
    found: Pulls = {}
    driven = {entry.joint for entry in poses.motion.plan.mechanism.inputs}
    for step in reversed(poses.motion.plan.steps):
        own = [
            joint
            for name, joint in poses.joints.items()
            if name not in found and {joint.on, joint.by} & set(step.bodies)
        ]
        found |= _group(poses, needed, step, own, driven)
        for joint in own:
            for body, sign in ((joint.on, -1), (joint.by, +1)):
                if body not in step.bodies:
                    pull = found[joint.name]
                    add(needed, poses, body, ForceAndMoment(sign * pull.force, sign * pull.moment), joint.at)
    return found


def _group(poses: PoseBlock, needed: Needs, step: Step, own: Sequence[JointPoses], driven: set[str]) -> Pulls:
    """Forces and moments of the joints of one group."""
    if len(step.bodies) == len(own) == 1:
        return {own[0].name: _at_joint(own[0], step.bodies[0], needed[step.bodies[0]], poses)}
    inner = [joint for joint in own if {joint.on, joint.by} <= set(step.bodies)]
    if len(step.bodies) == 2 and len(own) == 3 and len(inner) == 1 and not any(joint.name in driven for joint in own):
        return _dyad(poses, needed, inner[0], [joint for joint in own if joint is not inner[0]])
    return _general_group(poses, needed, step, own, driven)


def _at_joint(joint: JointPoses, body: str, pull: ForceAndMoment, poses: PoseBlock) -> ForceAndMoment:
    """Force and moment about the mass centre of `body`, converted to those on `on` about the joint's point."""
    moment = pull.moment + cross(poses.centres[body].position - joint.at, pull.force)
    return ForceAndMoment(pull.force, moment) if body == joint.on else ForceAndMoment(-pull.force, -moment)


def _dyad(poses: PoseBlock, needed: Needs, inner: JointPoses, outer: Sequence[JointPoses]) -> Pulls:
    """A dyad: two bodies, their common joint, and one joint of each to other groups; two equations."""
    first, second = inner.on, inner.by
    a, b = sorted(outer, key=lambda joint: first not in (joint.on, joint.by))
    u, v = inner.constraint_forces
    au, av, bu, bv = (joint.generalized_force(pull, inner.at) for joint in (a, b) for pull in (u, v))
    ca = a.generalized_force(needed[first], poses.centres[first].position)
    cb = -b.generalized_force(needed[second], poses.centres[second].position)
    det = au * bv - av * bu
    x, y = np.divide(ca * bv - av * cb, det), np.divide(au * cb - ca * bu, det)
    between = ForceAndMoment(x * u.force + y * v.force, x * u.moment + y * v.moment)
    left = dict(needed)
    add(left, poses, first, ForceAndMoment(-between.force, -between.moment), inner.at)
    add(left, poses, second, between, inner.at)
    return {
        inner.name: between,
        a.name: _at_joint(a, first, left[first], poses),
        b.name: _at_joint(b, second, left[second], poses),
    }


def _general_group(poses: PoseBlock, needed: Needs, step: Step, own: Sequence[JointPoses], driven: set[str]) -> Pulls:
    """All equations of a group at once, three per body; moments are divided by the mechanism's length."""
    units = [(joint, pull) for joint in own for pull in _units(joint, driven, poses.length)]
    samples = poses.motion.status.shape[0]
    matrix = np.zeros((samples, 3 * len(step.bodies), len(units)))
    right = np.zeros((samples, 3 * len(step.bodies)))
    for row, body in enumerate(step.bodies):
        right[:, 3 * row : 3 * row + 3] = _rows(needed[body], poses.length, samples)
        for column, (joint, pull) in enumerate(units):
            if body in (joint.on, joint.by):
                sign = 1 if body == joint.on else -1
                moment = pull.moment + cross(joint.at - poses.centres[body].position, pull.force)
                acting = ForceAndMoment(sign * pull.force, sign * moment)
                matrix[:, 3 * row : 3 * row + 3, column] = _rows(acting, poses.length, samples)
    sizes = solve_many(matrix, right)
    found = {joint.name: ForceAndMoment(0j, 0.0) for joint in own}
    for column, (joint, pull) in enumerate(units):
        so_far, size = found[joint.name], sizes[:, column]
        found[joint.name] = ForceAndMoment(so_far.force + size * pull.force, so_far.moment + size * pull.moment)
    return found


def _units(joint: JointPoses, driven: set[str], length: float) -> Iterable[ForceAndMoment]:
    """Unit forces and moments that a joint transmits; moments times the length, for the scale of a force."""
    if joint.tooth is not None:
        yield joint.tooth
        return
    for pull in (*joint.constraint_forces, *([joint.drive] if joint.name in driven else [])):
        yield ForceAndMoment(pull.force, pull.moment * length)


def _rows(pull: ForceAndMoment, length: float, samples: int) -> FloatArray:
    """Components x, y and moment / length along the last axis, one row per sample."""
    parts = (pull.force.real, pull.force.imag, pull.moment / length)
    return np.stack([np.broadcast_to(part, samples) for part in parts], axis=-1)
