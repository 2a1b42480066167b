"""Start of Newton's method: followed from the mechanism's pose, never guessed.

A group without a closed form has as many assemblies as its equations have roots. The mechanism's `pose` selects one.
The inputs move evenly from their values in that pose to the required ones, in steps small enough to stay in the same
assembly; each step starts from the extrapolated motion of the last one. So the result of a sample depends on the pose
and its own inputs, not on the samples before it. [predictor and corrector: Allgower, Georg:
Numerical Continuation Methods]
"""

import cmath
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Float, Int
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import STILL, BodyMotion, PointMotion
from ilmek.linkage.equations import relative_angle, travel
from ilmek.linkage.groups.general import GeneralGroup
from ilmek.linkage.groups.group import InputMotion
from ilmek.linkage.model import GROUND, Mechanism, Rotation, Slide
from ilmek.linkage.structure import Plan
from ilmek.units import deg, format_quantity

TURN = 5 * deg
"""Longest step of a rotating input on the path from the pose [rad]."""

SHIFT = 0.02
"""Longest step of a sliding input on the path from the pose, relative to the mechanism's size."""

MOST_STEPS = 2000
"""Largest number of steps on the path from the pose: 27 turns."""


def starts(plan: Plan, drives: Mapping[str, InputMotion]) -> dict[str, BodyMotion]:
    """Start of Newton's method for each body of a group without a closed form, at each sample; else {}."""
    blocks = [step for step in plan.steps if isinstance(step, GeneralGroup)]
    if not blocks:
        return {}
    reference = _inputs_in_pose(plan)
    targets = {name: np.atleast_1d(np.asarray(drive.value, dtype=float)) for name, drive in drives.items()}
    stride = {
        entry.name: TURN if isinstance(entry, Rotation) else SHIFT * blocks[0].scale for entry in plan.mechanism.inputs
    }
    if len(targets) > 1:
        return _follow(plan, reference, targets, _count(reference, targets, stride))[-1]
    (name,) = targets
    ends = np.array([min(targets[name].min(), reference[name]), max(targets[name].max(), reference[name])])
    count = _count(reference, {name: ends}, stride)
    path = _follow(plan, reference, {name: ends}, count)
    return _nearest(path, reference[name], ends, targets[name])


def _inputs_in_pose(plan: Plan) -> dict[str, float]:
    """The inputs' values in the mechanism's pose."""
    mechanism = plan.mechanism
    bodies = bodies_in_pose(plan.mechanism)
    values: dict[str, float] = {}
    for entry in mechanism.inputs:
        joint = mechanism.joint(entry.joint)
        if isinstance(entry, Rotation):
            values[entry.name] = float(relative_angle(mechanism, entry, bodies))
        elif isinstance(joint, Slide):
            values[entry.name] = float(travel(mechanism, joint, bodies))
    return values


def bodies_in_pose(mechanism: Mechanism) -> dict[str, BodyMotion]:
    """All bodies at rest in the mechanism's pose; default: each body's frame coincides with the world."""
    bodies = {}
    for body in mechanism.moving:
        origin, angle = mechanism.pose.get(body, (0j, 0.0))
        bodies[body] = BodyMotion(PointMotion(complex(origin), 0j, 0j), 0j, cmath.rect(1, angle), 0.0, 0.0)
    return bodies | {GROUND: STILL}


def _count(
    reference: Mapping[str, float],
    targets: Mapping[str, Float[np.ndarray, " samples"]],
    stride: Mapping[str, float],
) -> int:
    """Number of steps from the pose to the farthest target."""
    far = max(float(np.max(np.abs(value - reference[name]))) / stride[name] for name, value in targets.items())
    if far > MOST_STEPS:
        raise MechanismError(
            f"the inputs are {far:.3g} steps from the mechanism's pose, of {format_quantity(TURN, 'deg')} or "
            f"{SHIFT:.0%} of its size",
            allowed=f"at most {MOST_STEPS}",
            do="give a shorter range, or a pose nearer to it",
        )
    return max(1, int(np.ceil(far)))


def _follow(
    plan: Plan,
    reference: Mapping[str, float],
    targets: Mapping[str, Float[np.ndarray, " samples"]],
    count: int,
) -> list[dict[str, BodyMotion]]:
    """The bodies of the general groups at each of `count` even steps from the pose to the targets, the pose first."""
    blocks = {body for step in plan.steps if isinstance(step, GeneralGroup) for body in step.bodies}
    near = {body: motion for body, motion in bodies_in_pose(plan.mechanism).items() if body in blocks}
    path = []
    for k in range(count + 1):
        drives = {
            name: InputMotion(
                reference[name] + (value - reference[name]) * (k / count), (value - reference[name]) / count, 0.0
            )
            for name, value in targets.items()
        }
        known: dict[str, BodyMotion] = {GROUND: STILL, **near}
        for step in plan.steps:
            known.update(step.locate(known, step.solve(known, drives).columns))
        path.append({body: known[body] for body in blocks})
        near = {body: _carried_on(known[body], 1.0) for body in blocks}
    return path


def _carried_on(body: BodyMotion, steps: float | Float[np.ndarray, " samples"]) -> BodyMotion:
    """The body extrapolated by a number of steps, to second order."""
    anchor, half = body.anchor, 0.5 * steps * steps
    position = anchor.position + anchor.velocity * steps + anchor.acceleration * half
    direction = body.direction * np.exp(1j * (body.omega * steps + body.alpha * half))
    return BodyMotion(PointMotion(position, 0j, 0j), 0j, direction, 0.0, 0.0)


def _nearest(
    path: list[dict[str, BodyMotion]],
    reference: float,
    ends: Float[np.ndarray, " 2"],
    targets: Float[np.ndarray, " samples"],
) -> dict[str, BodyMotion]:
    """For one input: the nearest step to each sample, downwards (side 0) or upwards (side 1), extrapolated to it."""
    side = (targets > reference).astype(int)
    stride = (ends - reference)[side] / (len(path) - 1)
    position = np.where(stride == 0, 0.0, (targets - reference) / np.where(stride == 0, 1.0, stride))
    step = np.clip(np.rint(position).astype(int), 0, len(path) - 1)
    return {body: _carried_on(_picked([one[body] for one in path], step, side), position - step) for body in path[0]}


def _picked(
    motions: list[BodyMotion], step: Int[np.ndarray, " samples"], side: Int[np.ndarray, " samples"]
) -> BodyMotion:
    def pick(values: list[object]) -> np.ndarray:
        picked: np.ndarray = np.stack([np.broadcast_to(np.asarray(value), (2,)) for value in values])[step, side]
        return picked

    return BodyMotion(
        PointMotion(
            pick([one.anchor.position for one in motions]),
            pick([one.anchor.velocity for one in motions]),
            pick([one.anchor.acceleration for one in motions]),
        ),
        0j,
        pick([one.direction for one in motions]),
        pick([one.omega for one in motions]),
        pick([one.alpha for one in motions]),
    )
