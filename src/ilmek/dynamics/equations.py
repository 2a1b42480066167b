"""The equations of Newton and Euler for a planar mechanism, solved group by group.

    Σ f = m a_G        Σ (p - G) x f + Σ t = J alpha        for each moving body, G its mass centre

A group of the plan has three equations a body for just as many unknowns: what its joints bear, two numbers each, and
the efforts of its inputs. The groups are solved from the last to the first; each hands what it finds to the bodies that
it hangs on [Assur's principle]. A joint bears nothing that would do work on its own motion, its `play`:

    one body, one driven joint   the joint gives all that the body needs
    a dyad                       with w the pull of the inner joint on the first body:  play_A(need_1 - w) = 0,
                                 play_B(need_2 + w) = 0, two equations for the two numbers of w, all kinds alike
    any other                    all equations of the group at once
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
"""What its joints must give to each body, its moment about the mass centre."""

Pulls = dict[str, ForceAndMoment]
"""What each joint gives to its `on` body, its moment about the joint's point."""


def needs(posed: PoseBlock, inertias: Mapping[str, Inertia], wrenches: Iterable[Wrench]) -> Needs:
    """The terms m a_G and J alpha of each moving body, less its loads."""
    found = {
        body: ForceAndMoment(inertia.mass * posed.centres[body].acceleration, inertia.moment * posed.bodies[body].alpha)
        for body, inertia in inertias.items()
    }
    for wrench in wrenches:
        at = posed.place(wrench.body, wrench.at).position
        add(found, posed, wrench.body, ForceAndMoment(-wrench.force, -wrench.torque), at)
    return found


def add(to: Needs, posed: PoseBlock, body: str, pull: ForceAndMoment, at: ComplexField) -> None:
    """Add to a body's needs a pull whose moment is about the point `at` [m]; the ground needs nothing."""
    if body != GROUND:
        moment = pull.moment + cross(at - posed.centres[body].position, pull.force)
        to[body] = ForceAndMoment(to[body].force + pull.force, to[body].moment + moment)


def joint_pulls(posed: PoseBlock, needed: Needs) -> Pulls:
    """What the joints give, drives' efforts among it; infinite or NaN at samples whose equations are singular."""
    needed = dict(needed)
    found: Pulls = {}
    driven = {entry.joint for entry in posed.motion.plan.mechanism.inputs}
    for step in reversed(posed.motion.plan.steps):
        own = [
            joint
            for name, joint in posed.joints.items()
            if name not in found and {joint.on, joint.by} & set(step.bodies)
        ]
        found |= _group(posed, needed, step, own, driven)
        for joint in own:
            for body, sign in ((joint.on, -1), (joint.by, +1)):
                if body not in step.bodies:
                    pull = found[joint.name]
                    add(needed, posed, body, ForceAndMoment(sign * pull.force, sign * pull.moment), joint.at)
    return found


def _group(posed: PoseBlock, needed: Needs, step: Step, own: Sequence[JointPoses], driven: set[str]) -> Pulls:
    """What a group's own joints give."""
    if len(step.bodies) == len(own) == 1:
        return {own[0].name: _seen(own[0], step.bodies[0], needed[step.bodies[0]], posed)}
    inner = [joint for joint in own if {joint.on, joint.by} <= set(step.bodies)]
    if len(step.bodies) == 2 and len(own) == 3 and len(inner) == 1 and not any(joint.name in driven for joint in own):
        return _dyad(posed, needed, inner[0], [joint for joint in own if joint is not inner[0]])
    return _any(posed, needed, step, own, driven)


def _seen(joint: JointPoses, body: str, pull: ForceAndMoment, posed: PoseBlock) -> ForceAndMoment:
    """A pull on a body, its moment about the mass centre, as the joint gives it to `on`, its moment about the joint."""
    moment = pull.moment + cross(posed.centres[body].position - joint.at, pull.force)
    return ForceAndMoment(pull.force, moment) if body == joint.on else ForceAndMoment(-pull.force, -moment)


def _dyad(posed: PoseBlock, needed: Needs, inner: JointPoses, outer: Sequence[JointPoses]) -> Pulls:
    """Two bodies, the joint between them and one of each to known bodies: two equations; see the module."""
    first, second = inner.on, inner.by
    a, b = sorted(outer, key=lambda joint: first not in (joint.on, joint.by))
    u, v = inner.bears
    au, av, bu, bv = (joint.play(pull, inner.at) for joint in (a, b) for pull in (u, v))
    ca = a.play(needed[first], posed.centres[first].position)
    cb = -b.play(needed[second], posed.centres[second].position)
    det = au * bv - av * bu
    x, y = np.divide(ca * bv - av * cb, det), np.divide(au * cb - ca * bu, det)
    between = ForceAndMoment(x * u.force + y * v.force, x * u.moment + y * v.moment)
    left = dict(needed)
    add(left, posed, first, ForceAndMoment(-between.force, -between.moment), inner.at)
    add(left, posed, second, between, inner.at)
    return {
        inner.name: between,
        a.name: _seen(a, first, left[first], posed),
        b.name: _seen(b, second, left[second], posed),
    }


def _any(posed: PoseBlock, needed: Needs, step: Step, own: Sequence[JointPoses], driven: set[str]) -> Pulls:
    """All equations of a group at once, three a body, their moments over the mechanism's length."""
    units = [(joint, pull) for joint in own for pull in _units(joint, driven, posed.length)]
    samples = posed.motion.status.shape[0]
    matrix = np.zeros((samples, 3 * len(step.bodies), len(units)))
    right = np.zeros((samples, 3 * len(step.bodies)))
    for row, body in enumerate(step.bodies):
        right[:, 3 * row : 3 * row + 3] = _rows(needed[body], posed.length, samples)
        for column, (joint, pull) in enumerate(units):
            if body in (joint.on, joint.by):
                sign = 1 if body == joint.on else -1
                moment = pull.moment + cross(joint.at - posed.centres[body].position, pull.force)
                seen = ForceAndMoment(sign * pull.force, sign * moment)
                matrix[:, 3 * row : 3 * row + 3, column] = _rows(seen, posed.length, samples)
    sizes = solve_many(matrix, right)
    found = {joint.name: ForceAndMoment(0j, 0.0) for joint in own}
    for column, (joint, pull) in enumerate(units):
        so_far, size = found[joint.name], sizes[:, column]
        found[joint.name] = ForceAndMoment(so_far.force + size * pull.force, so_far.moment + size * pull.moment)
    return found


def _units(joint: JointPoses, driven: set[str], length: float) -> Iterable[ForceAndMoment]:
    """What a joint may give, as pulls of the size of a force."""
    for pull in (*joint.bears, *([joint.drive] if joint.name in driven else [])):
        yield ForceAndMoment(pull.force, pull.moment * length)


def _rows(pull: ForceAndMoment, length: float, samples: int) -> FloatArray:
    """x, y and moment over a length as the last axis, one row a sample."""
    parts = (pull.force.real, pull.force.imag, pull.moment / length)
    return np.stack([np.broadcast_to(part, samples) for part in parts], axis=-1)
