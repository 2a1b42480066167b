"""The branches with which a mechanism is assembled as in a given pose: of a mechanism that is drawn, not described."""

import dataclasses
from collections.abc import Mapping

import numpy as np

from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import PointMotion
from ilmek.linkage.initial_pose import bodies_in_pose, inputs_in_pose
from ilmek.linkage.model import Mechanism
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan, solvable_steps

Pose = Mapping[str, tuple[complex, float]]
"""Body -> origin [m] and angle [rad]."""


def required_branches(mechanism: Mechanism) -> tuple[str, ...]:
    """The joints whose groups require a branch; those of groups that can be solved, if not all can.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> required_branches(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1))
    ('B',)
    """
    every = {joint.name: +1 for joint in mechanism.joints} | dict(mechanism.branches)
    most = len(solvable_steps(dataclasses.replace(mechanism, branches=every))[0])

    def needed(joint: str) -> bool:
        others = {name: sign for name, sign in every.items() if name != joint}
        return len(solvable_steps(dataclasses.replace(mechanism, branches=others))[0]) < most

    return tuple(joint for joint in every if needed(joint))


def branches_in_pose(mechanism: Mechanism, pose: Pose, names: tuple[str, ...]) -> dict[str, int]:
    """The signs of the branches `names` with which the mechanism is assembled nearest to a pose.

    pose  of the bodies; the inputs have in it the values that its bodies show
    One sign after the other, in the order of solution: each group depends on those before it only. Signs of groups that
    do not close there stay as they are.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.solve import solve
    >>> other = solve(plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=-1)), 1.0).pose()
    >>> branches_in_pose(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1), other, ("B",))
    {'B': -1}
    """
    posed = dataclasses.replace(mechanism, pose=pose)
    expected, values = bodies_in_pose(posed), inputs_in_pose(posed)
    signs = {name: mechanism.branches.get(name, +1) for name in names}
    given = dict(mechanism.branches)

    def gap(branches: Mapping[str, int], joint: str) -> float:
        """Distance of a joint from its position in the pose [m]; infinite where it does not close."""
        try:
            motion = solve(plan(dataclasses.replace(mechanism, branches=given | dict(branches))), values)
        except MechanismError:
            return float("inf")
        at = 0.0
        for body in mechanism.joint(joint).bodies:
            local = mechanism.point(body, joint)
            wanted: PointMotion = expected[body].carry(local)
            apart = abs(
                complex(np.ravel(motion.point(body, joint).position)[0]) - complex(np.ravel(wanted.position)[0])
            )
            at = max(at, apart if np.isfinite(apart) else float("inf"))
        return at

    for name in _in_order(dataclasses.replace(mechanism, branches=given | signs), names):
        other = signs | {name: -signs[name]}
        if gap(other, name) < gap(signs, name):
            signs = other
    return signs


def _in_order(mechanism: Mechanism, names: tuple[str, ...]) -> list[str]:
    """Joints in the order in which their bodies are solved."""
    whole: Plan = plan(mechanism)
    rank = {body: number for number, step in enumerate(whole.steps) for body in step.bodies}
    return sorted(names, key=lambda name: max(rank.get(body, -1) for body in mechanism.joint(name).bodies))
