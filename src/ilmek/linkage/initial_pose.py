"""The mechanism's pose: the start of every group without a closed form.

Such a group has as many assemblies as its equations have roots; the mechanism's `pose` selects one. The pose is rough,
the inputs have in it the values that its bodies show (a body without a pose is as drawn). Bodies of closed forms follow
from the inputs and their branches; the others are assembled from the pose by a damped Newton's method. Where the
mechanism does not close at that value of the input, the input is free and all bodies move to a configuration nearby.
"""

import cmath
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import STILL, BodyMotion, PointMotion
from ilmek.linkage.configuration import LAST, Configurations, FreeInput
from ilmek.linkage.equations import relative_angle, travel
from ilmek.linkage.groups.general import GeneralGroup, upright
from ilmek.linkage.groups.group import InputMotion, Known, Step
from ilmek.linkage.model import GROUND, Mechanism, Rotation, Slide
from ilmek.linkage.structure import Plan
from ilmek.num.newton import damped_newton
from ilmek.units import deg, format_quantity

TURN = 5 * deg
"""Longest step of a rotating input on a straight path from the pose [rad]."""

SHIFT = 0.02
"""Longest step of a sliding input on a straight path from the pose, relative to the mechanism's size."""

MOST_STEPS = 2000
"""Largest number of steps on a straight path from the pose: 27 turns."""

NEARBY = 0.2
"""Farthest a body moves from the pose where the mechanism does not close in it, relative to the mechanism's size."""

SAME = 1e-6
"""Greatest distance of equal configurations, relative to the mechanism's size."""


def newton_steps(plan: Plan) -> tuple[Step, ...]:
    """The steps up to the last group without a closed form; () if all have one."""
    last = max((k for k, step in enumerate(plan.steps) if isinstance(step, GeneralGroup)), default=-1)
    return plan.steps[: last + 1]


def newton_bodies(plan: Plan) -> tuple[str, ...]:
    """The bodies of all groups without a closed form."""
    return tuple(body for step in plan.steps if isinstance(step, GeneralGroup) for body in step.bodies)


def inputs_in_pose(mechanism: Mechanism) -> dict[str, float]:
    """The inputs' values [rad, m] in the mechanism's pose."""
    bodies = bodies_in_pose(mechanism)
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
        bodies[body] = _at_rest(complex(origin), cmath.rect(1, angle))
    return bodies | {GROUND: STILL}


def assembled(plan: Plan, free: FreeInput) -> Configurations | None:
    """The configuration of the mechanism's pose, of the bodies of `free`; None where none is found.

    plan  of the whole mechanism      free  its part up to the last group without a closed form, locked as in the pose
    """
    known, whole = bodies_assembled(plan)
    rough = configuration(free, known, np.array([inputs_in_pose(plan.mechanism)[free.name]]))
    return rough if whole else _moved_to_nearest(plan, free, rough)


def bodies_assembled(plan: Plan) -> tuple[dict[str, BodyMotion], bool]:
    """The bodies at the inputs' values in the pose, those that cannot be assembled as in the pose; whether all can."""
    known, whole = bodies_in_pose(plan.mechanism), True
    drives = {name: InputMotion(value, 0.0, 0.0) for name, value in inputs_in_pose(plan.mechanism).items()}
    for step in newton_steps(plan):
        located = _located(step, known, drives)
        if all(np.isfinite(body.anchor.position).all() for body in located.values()):
            known |= {name: _at_rest(body.carry(0j).position, body.direction) for name, body in located.items()}
        else:
            whole = False
    return known, whole


def _located(step: Step, known: Known, drives: Mapping[str, InputMotion]) -> Known:
    """The bodies of a step at rest at one sample; a group without a closed form starts from the bodies in `known`."""
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        if isinstance(step, GeneralGroup):
            return step.settled(known, drives)
        return step.locate(known, step.solve(known, drives).columns)


def _moved_to_nearest(plan: Plan, free: FreeInput, rough: Configurations) -> Configurations | None:
    """A configuration near a rough one, at any value of the input, with the branches of the closed forms; or None."""

    def system(x: Float[np.ndarray, " unknowns"]) -> tuple[Float[np.ndarray, " m"], Float[np.ndarray, "m unknowns"]]:
        matrix, value = free.slope(free.stepped(rough, x[None, :]))
        return value[0], matrix[0]

    x = damped_newton(system, np.zeros(3 * rough.origins.shape[1] + 1), tolerance=LAST * free.size)
    found = free.stepped(rough, x[None, :])
    if not np.max(np.abs(x)) <= NEARBY * free.size or not upright(free.equations(found)):
        return None
    return found if on_branches(plan, free, found)[0] else None


def on_branches(plan: Plan, free: FreeInput, at: Configurations) -> np.ndarray:
    """Whether the closed forms, with their branches, give the same configurations; (rows,) of bool."""
    drives = {name: InputMotion(np.full(len(at), value), 0.0, 0.0) for name, value in free.locked.items()}
    drives[free.name] = InputMotion(at.inputs, 0.0, 0.0)
    known = dict(free.bodies(at))
    same = np.ones(len(at), dtype=bool)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        for step in newton_steps(plan):
            if not isinstance(step, GeneralGroup):
                found = step.locate(known, step.solve(known, drives).columns)
                for name, body in found.items():
                    apart = np.abs(body.carry(0j).position - known[name].anchor.position)
                    turned = np.abs(body.direction - known[name].direction) * free.size
                    same &= np.maximum(apart, turned) <= SAME * free.size
    return same


def configuration(free: FreeInput, known: Known, values: Float[np.ndarray, " rows"]) -> Configurations:
    """The bodies of a mechanism as configurations, one per value of the input."""
    bodies = [known[name] for name in free.mechanism.moving]
    origins = [np.broadcast_to(body.carry(0j).position, values.shape) for body in bodies]
    directions = [np.broadcast_to(body.direction, values.shape) for body in bodies]
    return Configurations(np.stack(origins, axis=-1), np.stack(directions, axis=-1), values)


def straight(
    plan: Plan, start: Known, reference: Mapping[str, float], targets: Mapping[str, Float[np.ndarray, " samples"]]
) -> dict[str, BodyMotion]:
    """The bodies of the groups without a closed form at each sample: all inputs move evenly from the pose to it.

    start  these bodies in the assembled pose      reference  the inputs' values there
    targets  the inputs' values in each sample
    The steps are small enough to stay in the same assembly; each starts from the extrapolated motion of the last one.
    """
    blocks = newton_bodies(plan)
    count = _count(plan, reference, targets)
    near = {body: start[body] for body in blocks}
    for k in range(1, count + 1):
        drives = {
            name: InputMotion(
                reference[name] + (value - reference[name]) * (k / count), (value - reference[name]) / count, 0.0
            )
            for name, value in targets.items()
        }
        known: dict[str, BodyMotion] = {GROUND: STILL, **near}
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            for step in newton_steps(plan):
                known.update(step.locate(known, step.solve(known, drives).columns))
        near = {body: _carried_on(known[body], 1.0 if k < count else 0.0) for body in blocks}
    return near


def _count(plan: Plan, reference: Mapping[str, float], targets: Mapping[str, Float[np.ndarray, " samples"]]) -> int:
    """Number of steps from the pose to the farthest target."""
    scale = max(step.scale for step in plan.steps if isinstance(step, GeneralGroup))
    far = 0.0
    for entry in plan.mechanism.inputs:
        stride = TURN if isinstance(entry, Rotation) else SHIFT * scale
        far = max(far, float(np.max(np.abs(targets[entry.name] - reference[entry.name]))) / stride)
    if far > MOST_STEPS:
        raise MechanismError(
            f"the inputs are {far:.3g} steps from the mechanism's pose, of {format_quantity(TURN, 'deg')} or "
            f"{SHIFT:.0%} of its size",
            allowed=f"at most {MOST_STEPS}",
            do="give a shorter range, or a pose nearer to it",
        )
    return max(1, int(np.ceil(far)))


def _carried_on(body: BodyMotion, steps: float) -> BodyMotion:
    """The body extrapolated by a number of steps, to second order, at rest."""
    anchor, half = body.anchor, 0.5 * steps * steps
    position = anchor.position + anchor.velocity * steps + anchor.acceleration * half
    return _at_rest(position, body.direction * np.exp(1j * (body.omega * steps + body.alpha * half)))


def _at_rest(origin: np.ndarray | complex, direction: np.ndarray | complex) -> BodyMotion:
    return BodyMotion(PointMotion(origin, 0j, 0j), 0j, direction, 0.0, 0.0)
