"""Checks of higher pairs, belts and redundant constraints of a mechanism in motion."""

import numpy as np

from ilmek.dynamics.inverse_run import greatest
from ilmek.dynamics.pose_block import characteristic_length, pose_block
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.linkage.model import Pin
from ilmek.linkage.outputs import RelativeAngle, Travel, output_history
from ilmek.linkage.status import Status
from ilmek.plane.vectors import dot
from ilmek.report import Check, at_least, at_most

STANDS = 1e-6
"""Greatest motion of a joint that stands still [rad], or relative to the mechanism's length."""


def standing(run: MechanismRun) -> tuple[Check, ...]:
    """Whether the joints of redundant constraints stand still: else a constraint is violated, and not redundant."""
    checks = []
    for name in run.plan.mechanism.redundant:
        joint, size = run.plan.mechanism.joint(name), characteristic_length(run.plan.mechanism)
        turns = isinstance(joint, Pin)
        moved = output_history(run.motion, RelativeAngle(*joint.bodies) if turns else Travel(name)).value
        limit, unit = (STANDS, "deg") if turns else (STANDS * size, "mm")
        most = float(np.max(np.abs(moved[run.motion.status == Status.OK]), initial=0.0))
        source = "the constraints elsewhere keep it still: its own is redundant"
        cure = "give lengths at which it is, or leave the body out"
        checks.append(at_most(f"{name}: stands still", most, limit, unit, source).with_cure(cure))
    return tuple(checks)


def pressed(run: MechanismRun) -> tuple[Check, ...]:
    """Whether the followers of cams that can only press are pressed on at every sample."""
    if run.forces is None:
        return ()
    forces, checks = run.forces.forces, []
    for cam in run.plan.mechanism.couplings:
        if cam.law is None or not cam.law.one_sided:
            continue
        contact = pose_block(forces.motion, {}).joints[cam.name].tooth
        assert contact is not None
        force = np.asarray(dot(contact.force, forces.reactions[cam.name]))
        least = float(np.min(force[np.isfinite(force)], initial=np.inf))
        source = "a cam without a groove can only press on its follower"
        cure = "a stronger or longer spring, a lower speed, or groove = true"
        checks.append(at_least(f"{cam.name}: force on the follower", least, 0.0, "N", source).with_cure(cure))
    return tuple(checks)


def grip(run: MechanismRun) -> tuple[Check, ...]:
    """Whether flat belts do not slip: the difference of their spans against the limit of Euler and Eytelwein.

    |T_1 - T_2| <= 2 T_0 tanh(mu beta / 2),   beta = pi - 2 |alpha| of an open, pi + 2 |alpha| of a crossed belt
    """
    if run.forces is None:
        return ()
    forces, checks = run.forces.forces, []
    for belt in run.plan.mechanism.couplings:
        if belt.spans is None or belt.spans.friction is None:
            continue
        joint = pose_block(forces.motion, {}).joints[belt.name]
        assert joint.middle is not None
        lean = np.arcsin(belt.spans.lean(belt.ratio, np.nanmax(np.abs(joint.middle - joint.at))))
        wrap = np.pi - 2 * float(np.abs(lean)) * np.sign(belt.ratio)
        limit = 2 * belt.spans.pretension * np.tanh(belt.spans.friction * wrap / 2)
        apart = greatest(forces.torques[belt.name]) * abs(belt.ratio) / belt.spans.radius
        source = f"difference of its spans, by T_1/T_2 = exp(mu beta) at {np.degrees(wrap):.0f} deg of wrap"
        cure = "a higher pretension, a larger pulley, or a toothed belt"
        checks.append(at_most(f"{belt.name}: grip of the belt", apart, float(limit), "N", source).with_cure(cure))
    return tuple(checks)
