"""Redundant constraints of a mechanism that moves all the same: each is replaced by a block that stands still.

A wedge between three slides keeps its angle by each of them; the third crank of a parallelogram keeps its length
already by the other two. Such a constraint leaves the motion as it is, and its force open: any value fulfils the
equations. Without it the count of degrees of freedom is the rank of the constraints:

    slide   its turning is set free: body - pin - block - slide - guide
    pin     of a link with two pins: the link's length is set free, body - pin - block - slide along the link
    cranks  three or more, equal and parallel: the lengths of all but one are set free, and a block that slides in both
            directions keeps the angle of the coupler; by two cranks alone it is lost where they are in line

The block moves against its body only if the constraint is not redundant; a check compares that travel with 0.
[rank of the constraints: `mobility`; Waldron, Kinzel: Kinematics, Dynamics, and Design of Machinery, chapter 1]
"""

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain, permutations

import numpy as np

from ilmek.errors import MechanismError
from ilmek.linkage.constraint_assignment import assigned_constraints
from ilmek.linkage.groups.group import Group
from ilmek.linkage.initial_pose import bodies_in_pose
from ilmek.linkage.mobility import Mobility, mobility
from ilmek.linkage.model import GROUND, Body, Joint, Mechanism, Pin, Slide
from ilmek.plane.vectors import cross

SAME = 1e-9
"""Greatest difference of parallel cranks, relative to the mechanism's size."""


def without_redundant(mechanism: Mechanism) -> Mechanism:
    """The mechanism with every constraint set free that is redundant in its pose; itself where none can be.

    Its `redundant` has the joints that were set free. A mechanism that does not move, one in a singular pose, and one
    with a redundant constraint of another kind stay as they are: their plan is refused.

    >>> from ilmek.linkage.model import Displacement
    >>> bodies = [Body("ground", {"X": 0, "Y": 0}), Body("wedge", {"X": 0, "W": 0}), Body("tappet", {"Y": 0, "W": 0})]
    >>> slides = [Slide("X", "wedge", "ground"), Slide("W", "tappet", "wedge", along=0.3)]
    >>> wedge = Mechanism(bodies, [*slides, Slide("Y", "tappet", "ground", along=1.57)], [Displacement("X")])
    >>> without_redundant(wedge).redundant
    ('Y free',)
    """
    reduced = mechanism
    while assigned_constraints(reduced).excess:
        before = _mobility(reduced)
        if before is None or before.singular or before.surplus < 1:
            return mechanism
        single = (_freed(reduced, joint) for joint in reversed(reduced.joints) if joint.name in before.redundant)
        candidates = chain(_parallel_cranks(reduced), *single)
        found = next((one for one in candidates if _moves_alike(before, one)), None)
        if found is None:
            return mechanism
        reduced = found
    return reduced


def _mobility(mechanism: Mechanism) -> Mobility | None:
    """Mobility in the mechanism's pose; None where it cannot be assembled near it."""
    try:
        return mobility(mechanism)
    except MechanismError:
        return None


def _moves_alike(before: Mobility, mechanism: Mechanism) -> bool:
    """Whether a mechanism has fewer redundant constraints, and moves as before."""
    after = _mobility(mechanism)
    return after is not None and after.ranked == before.ranked and after.surplus < before.surplus


def _parallel_cranks(mechanism: Mechanism) -> Iterator[Mechanism]:
    """The mechanism with the lengths of parallel cranks set free, for each pair of bodies that such cranks connect."""
    pins = {link: [joint for joint in mechanism.joints if link in joint.bodies] for link in mechanism.moving}
    driven = {entry.joint for entry in mechanism.inputs}
    for base, coupler in permutations([body.name for body in mechanism.bodies], 2):
        links = [link for link, ends in pins.items() if _connects(link, ends, base, coupler)]
        if coupler == GROUND or len(links) < 3 or not _parallel(mechanism, [(base, pins[link]) for link in links]):
            continue
        kept = next((link for link in links if driven & {pin.name for pin in pins[link]}), links[0])
        ends = {link: next(pin for pin in pins[link] if coupler in pin.bodies) for link in links if link != kept}
        yield _translating(mechanism, base, coupler, ends)


def _connects(link: str, ends: Sequence[Joint], base: str, coupler: str) -> bool:
    """Whether a link has two joints, a pin on the base and a pin on the coupler."""
    bodies = [pair for pair in ((base, link), (link, coupler)) for pin in ends if set(pin.bodies) == set(pair)]
    return (
        len(ends) == len(bodies) == 2 and len({link, base, coupler}) == 3 and all(isinstance(pin, Pin) for pin in ends)
    )


def _parallel(mechanism: Mechanism, cranks: Sequence[tuple[str, Sequence[Joint]]]) -> bool:
    """Whether cranks, each with its base, are equal and parallel in the mechanism's pose, and not all in one line."""
    bodies, near = bodies_in_pose(mechanism), SAME * Group(mechanism, (), (), ()).reach
    feet, arms = [], []
    for base, ends in cranks:
        foot, head = sorted(ends, key=lambda pin: base not in pin.bodies)
        link = next(body for body in foot.bodies if body in head.bodies)
        at = [complex(bodies[link].carry(mechanism.point(link, pin.name)).position) for pin in (foot, head)]
        feet.append(at[0])
        arms.append(at[1] - at[0])
    spread = np.array(feet) - feet[0]
    apart = np.abs(cross(spread[:, None], spread)).max()
    return bool(np.abs(np.array(arms) - arms[0]).max() <= near and apart > near * np.abs(spread).max())


def _translating(mechanism: Mechanism, base: str, coupler: str, ends: Mapping[str, Joint]) -> Mechanism:
    """The mechanism with cranks' lengths set free, and the coupler's angle kept by a block; link -> its end there."""
    for link, end in ends.items():
        (other,) = (joint for joint in mechanism.joints if link in joint.bodies and joint.name != end.name)
        arm = mechanism.point(link, end.name) - mechanism.point(link, other.name)
        mechanism = with_block(mechanism, end, link, along=cmath.phase(arm))
    block, along, across = (f"{coupler} {name}" for name in ("block", "along", "across"))
    bodies = bodies_in_pose(mechanism)
    turned = cmath.phase(complex(bodies[coupler].direction) / complex(bodies[base].direction))
    own = {base: {along: 0j}, coupler: {across: 0j}}
    slides = Slide(along, block, base), Slide(across, coupler, block, along=math.pi / 2, turned=turned)
    return replace(
        mechanism,
        bodies=(
            *(Body(one.name, {**one.points, **own.get(one.name, {})}) for one in mechanism.bodies),
            Body(block, {along: 0j, across: 0j}),
        ),
        joints=(*mechanism.joints, *slides),
        pose={**mechanism.pose, **({block: mechanism.pose[base]} if base in mechanism.pose else {})},
    )


def _freed(mechanism: Mechanism, joint: Joint) -> Iterator[Mechanism]:
    """The mechanism with one constraint of a joint set free; nothing for a driven one and a pin without a link."""
    if any(entry.joint == joint.name for entry in mechanism.inputs):
        return
    if isinstance(joint, Slide):
        yield with_block(mechanism, joint, joint.body)
        return
    for link in joint.bodies:
        ends = [other for other in mechanism.joints if link in other.bodies]
        if len(ends) == 2 and all(isinstance(end, Pin) for end in ends):
            start, end = (mechanism.point(link, pin.name) for pin in ends)
            yield with_block(mechanism, joint, link, along=cmath.phase(end - start))


def with_block(mechanism: Mechanism, joint: Joint, body: str, *, along: float = 0.0) -> Mechanism:
    """The mechanism with a block between a joint and one of its bodies: in a pin it slides, in a slide it turns.

    joint  of two bodies      body  the one that the block stands for      along  line of the slide in its frame [rad]

    The block has the body's frame. Its joint to the body stands still; `redundant` names it.
    """
    block, free = f"{joint.name} block", f"{joint.name} free"
    first, second = (block if one == body else one for one in joint.bodies)
    at = mechanism.point(body, joint.name)
    between = Pin(free, body, block) if isinstance(joint, Slide) else Slide(free, block, body, along)
    attached: Joint = (
        replace(joint, body=first, guide=second) if isinstance(joint, Slide) else Pin(joint.name, first, second)
    )
    bodies = [Body(one.name, {**one.points, free: at}) if one.name == body else one for one in mechanism.bodies]
    return replace(
        mechanism,
        bodies=(*bodies, Body(block, {joint.name: at, free: at})),
        joints=(*(attached if one is joint else one for one in mechanism.joints), between),
        pose={**mechanism.pose, **({block: mechanism.pose[body]} if body in mechanism.pose else {})},
        redundant=(*mechanism.redundant, free),
    )
