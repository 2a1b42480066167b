"""Where Newton's method starts: followed from the mechanism's pose, never guessed.

A group without a closed form has as many ways to close as its equations have roots. Which one is meant is said by the
mechanism's `pose`. From the inputs in that pose the inputs are moved evenly to those wanted, in steps small enough to
stay on the same way; each step starts from the last one's motion carried on. So a sample's answer depends on the pose
and on its own inputs, not on the samples before it.
"""

import cmath
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Float, Int
from ilmek.linkage.body_motion import STILL, BodyMotion, PointMotion
from ilmek.linkage.equations import relative_angle, travel
from ilmek.linkage.groups.general import GeneralGroup
from ilmek.linkage.groups.group import InputMotion
from ilmek.linkage.model import GROUND, Mechanism, Rotation, Slide
from ilmek.linkage.structure import Plan
from ilmek.units import deg

TURN = 5 * deg
"""Longest step of a rotating input on the way from the pose."""

SHIFT = 0.02
"""Longest step of a sliding input on the way from the pose, of the mechanism's size."""


def starts(plan: Plan, drives: Mapping[str, InputMotion]) -> dict[str, BodyMotion]:
    """A motion near the answer for every body that is left to Newton's method, at each sample."""
    blocks = [step for step in plan.steps if isinstance(step, GeneralGroup)]
    if not blocks:
        return {}
    reference = _inputs_in_pose(plan)
    wanted = {name: np.atleast_1d(np.asarray(drive.value, dtype=float)) for name, drive in drives.items()}
    stride = {
        entry.name: TURN if isinstance(entry, Rotation) else SHIFT * blocks[0].scale for entry in plan.mechanism.inputs
    }
    if len(wanted) > 1:
        return _follow(plan, reference, wanted, _count(reference, wanted, stride))[-1]
    (name,) = wanted
    ends = np.array([min(wanted[name].min(), reference[name]), max(wanted[name].max(), reference[name])])
    count = _count(reference, {name: ends}, stride)
    way = _follow(plan, reference, {name: ends}, count)
    return _nearest(way, reference[name], ends, wanted[name])


def _inputs_in_pose(plan: Plan) -> dict[str, float]:
    """The inputs' values in the mechanism's pose."""
    mechanism = plan.mechanism
    bodies = drawn(plan.mechanism)
    values: dict[str, float] = {}
    for entry in mechanism.inputs:
        joint = mechanism.joint(entry.joint)
        if isinstance(entry, Rotation):
            values[entry.name] = float(relative_angle(mechanism, entry, bodies))
        elif isinstance(joint, Slide):
            values[entry.name] = float(travel(mechanism, joint, bodies))
    return values


def drawn(mechanism: Mechanism) -> dict[str, BodyMotion]:
    """Every body at rest in the mechanism's pose; as drawn in place where none is given."""
    bodies = {}
    for body in mechanism.moving:
        origin, angle = mechanism.pose.get(body, (0j, 0.0))
        bodies[body] = BodyMotion(PointMotion(complex(origin), 0j, 0j), 0j, cmath.rect(1, angle), 0.0, 0.0)
    return bodies | {GROUND: STILL}


def _count(
    reference: Mapping[str, float],
    wanted: Mapping[str, Float[np.ndarray, " samples"]],
    stride: Mapping[str, float],
) -> int:
    """Steps needed to come from the pose to the farthest of the inputs wanted."""
    far = max(float(np.max(np.abs(value - reference[name]))) / stride[name] for name, value in wanted.items())
    return max(1, int(np.ceil(far)))


def _follow(
    plan: Plan,
    reference: Mapping[str, float],
    wanted: Mapping[str, Float[np.ndarray, " samples"]],
    count: int,
) -> list[dict[str, BodyMotion]]:
    """The bodies of the blocks at each of `count` even steps from the pose to the inputs wanted, the pose first."""
    blocks = {body for step in plan.steps if isinstance(step, GeneralGroup) for body in step.bodies}
    near = {body: motion for body, motion in drawn(plan.mechanism).items() if body in blocks}
    way = []
    for k in range(count + 1):
        drives = {
            name: InputMotion(
                reference[name] + (value - reference[name]) * (k / count), (value - reference[name]) / count, 0.0
            )
            for name, value in wanted.items()
        }
        known: dict[str, BodyMotion] = {GROUND: STILL, **near}
        for step in plan.steps:
            known.update(step.place(known, step.solve(known, drives).columns))
        way.append({body: known[body] for body in blocks})
        near = {body: _carried_on(known[body], 1.0) for body in blocks}
    return way


def _carried_on(body: BodyMotion, steps: float | Float[np.ndarray, " samples"]) -> BodyMotion:
    """The body `steps` steps later, if it went on as it does (to second order)."""
    anchor, half = body.anchor, 0.5 * steps * steps
    position = anchor.position + anchor.velocity * steps + anchor.acceleration * half
    direction = body.direction * np.exp(1j * (body.omega * steps + body.alpha * half))
    return BodyMotion(PointMotion(position, 0j, 0j), 0j, direction, 0.0, 0.0)


def _nearest(
    way: list[dict[str, BodyMotion]],
    reference: float,
    ends: Float[np.ndarray, " 2"],
    wanted: Float[np.ndarray, " samples"],
) -> dict[str, BodyMotion]:
    """For one input: each sample's nearest step on the way down (side 0) or up (side 1), carried on to the sample."""
    side = (wanted > reference).astype(int)
    stride = (ends - reference)[side] / (len(way) - 1)
    place = np.where(stride == 0, 0.0, (wanted - reference) / np.where(stride == 0, 1.0, stride))
    step = np.clip(np.rint(place).astype(int), 0, len(way) - 1)
    return {body: _carried_on(_picked([one[body] for one in way], step, side), place - step) for body in way[0]}


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
