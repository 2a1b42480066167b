"""The branches that a drawing shows: the coordinates of a mechanism are given data.

Bodies are drawn in the mechanism's pose, by default with their frames in the world's place. A group is drawn where its
joints coincide in both of their bodies, and the bodies to which it is attached are drawn. Of its two assemblies one is
then the drawing. Both are computed, and the sign is that of the nearer one; at a dead centre, where they meet, the
drawing shows none.
"""

from dataclasses import replace

import numpy as np

from ilmek.errors import MechanismError
from ilmek.linkage.groups.group import Known, Step
from ilmek.linkage.initial_pose import bodies_in_pose
from ilmek.linkage.model import GROUND, Joint, Mechanism, Slide
from ilmek.linkage.structure import solvable_steps
from ilmek.plane.vectors import cross, unit

DRAWN = 1e-3
"""Greatest distance of a joint's points in its two bodies relative to the mechanism's size: coordinates are rounded."""

CLEARER, LEAST = 10.0, 1e-6
"""The other assembly is farther from the drawing than the nearer one by this factor, and by this part of the size."""


def as_drawn(mechanism: Mechanism) -> Mechanism:
    """The mechanism with the branches that its drawing shows and that it does not state.

    Raises MechanismError for a stated branch that contradicts the drawing.

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
    return (
        replace(mechanism, branches={**drawn, **mechanism.branches}) if drawn.keys() - mechanism.branches else mechanism
    )


def branches_as_drawn(mechanism: Mechanism) -> dict[str, int]:
    """Joint -> branch that the drawing shows, of the groups that can be solved; others are left out."""
    names = [joint.name for joint in mechanism.joints]
    above, below = (solvable_steps(replace(mechanism, branches=dict.fromkeys(names, sign)))[0] for sign in (+1, -1))
    bodies, drawn = bodies_in_pose(mechanism), {GROUND}
    size = _size(mechanism, bodies)
    signs: dict[str, int] = {}
    for first, second in zip(above, below, strict=True):
        joints = _joints_of(mechanism, first, drawn)
        if not set(first.parents) <= drawn or any(_gap(mechanism, one, bodies) > DRAWN * size for one in joints):
            continue
        drawn.update(first.bodies)
        if first.free:
            gaps = [_distance(mechanism, step, joints, bodies, size) for step in (first, second)]
            if max(gaps) > max(CLEARER * min(gaps), LEAST * size) and min(gaps) < np.inf:
                signs[first.free] = +1 if gaps[0] < gaps[1] else -1
    return signs


def _joints_of(mechanism: Mechanism, step: Step, known: set[str]) -> list[Joint]:
    """The joints of a step's bodies to one another and to known bodies."""
    own = set(step.bodies)
    return [joint for joint in mechanism.joints if own & set(joint.bodies) and set(joint.bodies) <= own | known]


def _ends(mechanism: Mechanism, joint: Joint, bodies: Known) -> tuple[complex, complex]:
    """A joint's point in each of its bodies, in the world [m]."""
    first, second = (complex(bodies[body].carry(mechanism.point(body, joint.name)).position) for body in joint.bodies)
    return first, second


def _size(mechanism: Mechanism, bodies: Known) -> float:
    """The largest distance of two joints as drawn [m]."""
    at = np.array([end for joint in mechanism.joints for end in _ends(mechanism, joint, bodies)])
    return float(np.max(np.abs(at[:, None] - at), initial=0.0))


def _gap(mechanism: Mechanism, joint: Joint, bodies: Known) -> float:
    """Distance [m] by which a joint is not closed as drawn; infinite for a slide whose body is turned otherwise."""
    first, second = _ends(mechanism, joint, bodies)
    if not isinstance(joint, Slide):
        return abs(first - second)
    body, guide = (complex(bodies[name].direction) for name in joint.bodies)
    turned = abs(body - guide * unit(joint.turned)) > DRAWN
    return np.inf if turned else abs(cross(guide * complex(unit(joint.along)), first - second))


def _distance(mechanism: Mechanism, step: Step, joints: list[Joint], bodies: Known, size: float) -> float:
    """The largest distance [m] of a step's joints from the drawing, its other bodies as drawn; inf: it cannot close."""
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        located = dict(bodies) | dict(step.locate(bodies, step.solve(bodies, {}).columns))
    moved = [
        abs(end - drawn)
        for joint in joints
        for end, drawn in zip(_ends(mechanism, joint, located), _ends(mechanism, joint, bodies), strict=True)
    ]
    turned = [size * abs(complex(located[body].direction) - complex(bodies[body].direction)) for body in step.bodies]
    gap = max(moved + turned)
    return gap if np.isfinite(gap) else np.inf
