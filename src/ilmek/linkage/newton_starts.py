"""Start of Newton's method for the groups without a closed form: on the branch of the mechanism's pose.

Where one input varies the start is interpolated on the traced branch (`pose_branch`). Where several vary, each sample
is reached from the pose on a straight line of the inputs, in small steps. So the result of a sample depends on the pose
and its own inputs, not on the samples before it.
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Float
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.groups.group import InputMotion
from ilmek.linkage.initial_pose import bodies_assembled, inputs_in_pose, newton_bodies, newton_steps, straight
from ilmek.linkage.model import GROUND
from ilmek.linkage.pose_branch import PoseBranch, pose_branch
from ilmek.linkage.structure import Plan

Values = Mapping[str, Float[np.ndarray, " samples"]]


def starts(plan: Plan, drives: Mapping[str, InputMotion]) -> dict[str, BodyMotion]:
    """Start of Newton's method for each body of a group without a closed form, at each sample; else {}.

    NaN for samples beyond the ends of the branch.
    """
    bodies = newton_bodies(plan)
    if not bodies:
        return {}
    values = {name: np.atleast_1d(np.asarray(drive.value, dtype=float)) for name, drive in drives.items()}
    acting = acting_inputs(plan)
    varied = [name for name in acting if np.ptp(values[name]) > 0]
    if not acting or len(varied) > 1:
        return _straight(plan, values)
    name = (varied or acting)[0]
    branch = branch_over(plan, name, values)
    if branch is None:
        return {body: _nowhere(len(values[name])) for body in bodies}
    near = branch.bodies(values[name])
    return {body: near[body] for body in bodies}


def branch_over(plan: Plan, name: str, values: Values) -> PoseBranch | None:
    """The branch over an input that contains its values [rad, m], the others held at their first ones."""
    pose = inputs_in_pose(plan.mechanism)[name]
    locked = {other: float(value[0]) for other, value in values.items() if other != name}
    return pose_branch(plan, name, locked, float(np.max(np.abs(values[name] - pose))))


def acting_inputs(plan: Plan) -> list[str]:
    """The inputs that move the bodies up to the last group without a closed form."""
    bodies = {body for step in newton_steps(plan) for body in step.bodies} | {GROUND}
    mechanism = plan.mechanism
    return [entry.name for entry in mechanism.inputs if set(mechanism.joint(entry.joint).bodies) <= bodies]


def _straight(plan: Plan, values: Values) -> dict[str, BodyMotion]:
    """The bodies at each sample, from the pose on a straight line of all inputs."""
    known, whole = bodies_assembled(plan)
    if not whole:
        return {body: _nowhere(len(next(iter(values.values())))) for body in newton_bodies(plan)}
    return straight(plan, known, inputs_in_pose(plan.mechanism), values)


def _nowhere(samples: int) -> BodyMotion:
    """A body without a start."""
    gone = np.full(samples, np.nan)
    return BodyMotion(PointMotion(gone + 0j, 0j, 0j), 0j, gone + 0j, gone, gone)
