"""The branches that a drawing shows: the coordinates of a mechanism are given data.

Bodies are drawn in the mechanism's pose, by default with their frames in the world's place. A group is drawn where its
joints coincide in both of their bodies, and the bodies to which it is attached are drawn. Of its two assemblies one is
then the drawing. Both are computed, and the sign is that of the nearer one; at a dead centre, where they meet, the
drawing shows none.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from ilmek.errors import MechanismError
from ilmek.linkage.groups.group import Known, Step
from ilmek.linkage.initial_pose import bodies_in_pose, inputs_in_pose
from ilmek.linkage.model import GROUND, Joint, Mechanism, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, solvable_steps
from ilmek.plane.vectors import cross, unit
from ilmek.records import with_fields

DRAWN = 1e-3
"""Greatest distance of a joint's points in its two bodies relative to the mechanism's size: coordinates are rounded."""

CLEARER, LEAST = 10.0, 1e-6
"""The other assembly is farther from the drawing than the nearer one by this factor, and by this part of the size."""

OTHER = 1e-2
"""Least distance of another assembly from the drawing, relative to the mechanism's size."""


def as_drawn(mechanism: Mechanism) -> Mechanism:
    """The mechanism with the branches that its drawing shows and that it does not state.

    Raises MechanismError for a branch, or a pose of a group without a closed form, that contradicts the drawing.

    >>> from ilmek.linkage.model import Body, Pin, Rotation
    >>> points = {"A": 0, "B": 1, "C": 4 + 2j, "D": 4}
    >>> links = {"ground": "AD", "crank": "AB", "rod": "BC", "rocker": "CD"}
    >>> bodies = tuple(Body(name, {point: points[point] for point in ends}) for name, ends in links.items())
    >>> joints = {"A": "ground crank", "B": "crank rod", "C": "rod rocker", "D": "rocker ground"}
    >>> pins = tuple(Pin(name, *ends.split()) for name, ends in joints.items())
    >>> as_drawn(Mechanism(bodies, pins, (Rotation("crank", "A"),))).branches
    {'C': 1}
    """
    drawn = branches_as_drawn(mechanism)
    for joint, sign in mechanism.branches.items():
        if drawn.get(joint, sign) != sign:
            raise MechanismError(
                f"branch {joint} = {sign:+d} of {mechanism.name} contradicts the coordinates as drawn",
                allowed=f"the drawing has {joint} = {drawn[joint]:+d}",
                do="leave the branch out, or draw the other assembly",
                about=("branches", joint),
            )
    lacking = drawn.keys() - mechanism.branches
    whole = replace(mechanism, branches={**drawn, **mechanism.branches}) if lacking else mechanism
    _check_poses(whole)
    return whole


def branches_as_drawn(mechanism: Mechanism) -> dict[str, int]:
    """Joint -> branch that the drawing shows, of the groups that can be solved; others are left out."""
    names = [joint.name for joint in mechanism.joints]
    above, _ = solvable_steps(with_fields(mechanism, branches=dict.fromkeys(names, +1)))
    drawn = {step.bodies for step in _drawn_steps(mechanism, above) if step.free}
    signs: dict[str, int] = {}
    if not drawn:
        return signs
    below, _ = solvable_steps(with_fields(mechanism, branches=dict.fromkeys(names, -1)))
    bodies, size = bodies_in_pose(mechanism), _size(mechanism)
    for first, second in zip(above, below, strict=True):
        if first.bodies in drawn:
            gaps = [_distance(mechanism, step, bodies, size) for step in (first, second)]
            if max(gaps) > max(CLEARER * min(gaps), LEAST * size) and min(gaps) < np.inf:
                signs[first.free] = +1 if gaps[0] < gaps[1] else -1
    return signs


def _check_poses(mechanism: Mechanism) -> None:
    """Raise MechanismError for a stated pose of a group without a closed form whose coordinates show another assembly.

    From the pose the mechanism is moved to the inputs' values of the drawing, all frames in the world's place.
    """
    if not mechanism.pose:
        return
    steps, _ = solvable_steps(mechanism)
    flat = replace(mechanism, pose={})
    posed = [step.bodies for step in steps if step.kind == "general" and mechanism.pose.keys() & set(step.bodies)]
    shown = [step for step in _drawn_steps(flat, steps) if step.bodies in posed] if posed else []
    if not shown:
        return
    motion = solve(Plan(mechanism, steps), inputs_in_pose(flat))
    for body in (body for step in shown for body in step.bodies):
        points = mechanism.body(body).points
        moved = max(abs(complex(np.ravel(motion.point(body, name).position)[0]) - at) for name, at in points.items())
        if moved > OTHER * _size(flat):
            raise MechanismError(
                f"pose of {body} of {mechanism.name} contradicts the coordinates as drawn",
                allowed="the drawing has all bodies in place: it is assembled with their frames at 0",
                do="leave the pose out, or draw the other assembly",
                about=("pose", body),
            )


def _drawn_steps(mechanism: Mechanism, steps: Iterable[Step]) -> list[Step]:
    """The steps whose joints coincide as drawn, and which are attached to drawn bodies only."""
    bodies, drawn, size = bodies_in_pose(mechanism), {GROUND}, _size(mechanism)
    shown = []
    for step in steps:
        gaps = (_gap(mechanism, joint, bodies) for joint in _joints_of(mechanism, step))
        if set(step.parents) <= drawn and all(gap <= DRAWN * size for gap in gaps):
            drawn.update(step.bodies)
            shown.append(step)
    return shown


def _joints_of(mechanism: Mechanism, step: Step) -> list[Joint]:
    """The joints of a step's bodies to one another and to the bodies to which they are attached."""
    own = set(step.bodies)
    known = own | set(step.parents)
    return [joint for joint in mechanism.joints if own & set(joint.bodies) and set(joint.bodies) <= known]


def _ends(mechanism: Mechanism, joint: Joint, bodies: Known) -> tuple[complex, complex]:
    """A joint's point in each of its bodies, in the world [m]."""
    first, second = (complex(bodies[body].carry(mechanism.point(body, joint.name)).position) for body in joint.bodies)
    return first, second


def _size(mechanism: Mechanism) -> float:
    """The largest distance of two joints as drawn [m]."""
    bodies = bodies_in_pose(mechanism)
    at = np.array([end for joint in mechanism.joints for end in _ends(mechanism, joint, bodies)])
    return float(np.max(np.abs(at[:, None] - at), initial=0.0))


def _gap(mechanism: Mechanism, joint: Joint, bodies: Known) -> float:
    """Distance [m] by which a joint is not closed as drawn; infinite for a slide whose body is turned otherwise."""
    first, second = _ends(mechanism, joint, bodies)
    if not isinstance(joint, Slide):
        return abs(first - second)
    body, guide = (complex(bodies[name].direction) for name in joint.bodies)
    turned = abs(body - guide * complex(unit(joint.turned))) > DRAWN
    return np.inf if turned else float(np.abs(cross(guide * complex(unit(joint.along)), first - second)))


def _distance(mechanism: Mechanism, step: Step, bodies: Known, size: float) -> float:
    """The largest distance [m] of a step's joints from the drawing, its other bodies as drawn; inf: it cannot close."""
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        located = dict(bodies) | dict(step.locate(bodies, step.solve(bodies, {}).columns))
    moved: list[float] = [
        abs(end - drawn)
        for joint in _joints_of(mechanism, step)
        for end, drawn in zip(_ends(mechanism, joint, located), _ends(mechanism, joint, bodies), strict=True)
    ]
    moved += [size * abs(complex(located[body].direction) - complex(bodies[body].direction)) for body in step.bodies]
    gap = max(moved)
    return gap if np.isfinite(gap) else np.inf
