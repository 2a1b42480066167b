"""The head as a tree of bodies: the case on its carriage, the cam shaft, the tools that the cams move, the
knife, the magazine.

Axes of the scene: x along the row, 0 in the middle of the head, y up from the fell, z to the front from the warps.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from ilmek.elements.linear_guides import LINEAR_GUIDES, LinearGuide
from ilmek.machines.weaver.carriage_drive import CARRIAGE_MOTOR, CarriageDrive, carriage_drive, drive_mass, drive_parts
from ilmek.machines.weaver.carriage_guide import carriages, guide_carriages, guide_for, offered_guides
from ilmek.machines.weaver.carriages import carried_parts, standing_parts
from ilmek.machines.weaver.case import closing_parts
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.drive_parts import COLOUR_MOTOR, TIER_MOTOR, cam_drive, colour_motors, shaft_pulley
from ilmek.machines.weaver.followers import follower_bodies, guide
from ilmek.machines.weaver.jaws import jaw_bodies, slotted
from ilmek.machines.weaver.knife import KNIFE_CLOSURE, knife_bodies, knife_stands
from ilmek.machines.weaver.lever_parts import axles, lever_bodies
from ilmek.machines.weaver.magazine_parts import index_sensor, magazine_parts
from ilmek.machines.weaver.parts import MOTOR, cam_id, case_parts, shaft_parts
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.machines.weaver.transmissions import CAM_SHAFT, transmissions
from ilmek.machines.weaver.turning import turning_bodies
from ilmek.machines.weaver.yarn_lead import yarn_guide
from ilmek.part.placement import IN_SIDE_VIEW, Placement, placement
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.units import turn

HEAD, MAGAZINE, LIFT = part_id("head"), part_id("magazine"), part_id("lift of the magazine")
"""Ids of bodies."""


def placed(weaver: Weaver, heads: Sequence[Placement]) -> Tree:
    """The tree of a loom's heads, each at its place."""
    head = head_tree(weaver)
    first, *others = head.bodies
    return head.replaced((replace(first, positions=tuple(heads)), *others))


@lru_cache(maxsize=8)
def head_tree(weaver: Weaver) -> Tree:
    """All that a carriage moves: the case slides on the rail, the rest is in it, each body after what carries it."""
    bare = _without_guide(weaver)
    first, *others = bare.bodies
    driven = guide_carriages(weaver, carriage_guide(weaver)), *drive_parts(weaver, drive_of(weaver))
    return bare.replaced((replace(first, occurrences=(*first.occurrences, *driven)), *others))


def drive_of(weaver: Weaver) -> CarriageDrive:
    """The drive of the head's carriage, by the mass on it."""
    return carriage_drive(weaver, _without_guide(weaver).mass, carriage_guide(weaver))


@lru_cache(maxsize=8)
def carriage_guide(weaver: Weaver) -> LinearGuide:
    """The guide of the head's carriage, by the mass on it: as given, or of all but the carriages, with the heaviest."""
    tied = weaver.params.arms.mass if weaver.params.with_arms else 0.0
    own = max(carriages(weaver, row) * row.block_mass for row in offered_guides())
    bare = _without_guide(weaver).mass
    driven = bare + drive_mass(weaver, carriage_drive(weaver, bare, LINEAR_GUIDES[0]))
    return guide_for(weaver, weaver.params.head_mass or driven + tied + own)


def least_rail(weaver: Weaver, clearance: float) -> float:
    """Least side of the heads' rail [m]: the guide's carriages keep a clearance [m] from what is under and on it."""
    return carriage_guide(weaver).block + 2 * clearance


@lru_cache(maxsize=8)
def _without_guide(weaver: Weaver) -> Tree:
    """The head beside what guides it."""
    axis = weaver.shape.axis
    about = placement(0.0, axis.imag, axis.real).after(IN_SIDE_VIEW)
    case = (
        Occurrence(stands.part, tuple(about.after(position) for position in stands.positions))
        for stands in case_parts(weaver)
    )
    stands = (
        *closing_parts(weaver),
        guide(weaver),
        *axles(weaver),
        *standing_parts(weaver),
        *knife_stands(weaver),
        *yarn_guide(weaver),
    )
    upright, carried = placement(about=(0.0, 0.0, 1.0), angle=turn / 4), carried_parts(weaver)
    tools = (
        replace(body, occurrences=(*(slotted(weaver, own) for own in body.occurrences), *carried.get(body.id, ())))
        for _, body in weaver.tool_bodies.bodies(HEAD)
    )
    return Tree(
        (
            RigidBody(
                HEAD,
                (*case, *stands, *cam_drive(weaver), *colour_motors(weaver), *index_sensor(weaver)),
                joint=Joint(JointKind.SLIDE, (1.0, 0.0, 0.0), motor=CARRIAGE_MOTOR),
            ),
            RigidBody(
                CAM_SHAFT,
                (*shaft_parts(weaver), shaft_pulley(weaver)),
                HEAD,
                Joint(JointKind.PIN, motor=MOTOR),
                (about.after(upright),),
            ),
            *follower_bodies(weaver, HEAD),
            *lever_bodies(weaver, HEAD),
            *tools,
            *(() if weaver.params.with_arms else jaw_bodies(weaver)),
            *turning_bodies(weaver, HEAD),
            *knife_bodies(weaver, HEAD),
            *_magazine(weaver),
        ),
        (*transmissions(weaver), KNIFE_CLOSURE),
    )


def _magazine(weaver: Weaver) -> Iterator[RigidBody]:
    """The magazine, which turns; of several tiers on what lifts it."""
    upright, carrier = (0.0, 1.0, 0.0), HEAD
    if weaver.magazine.tiers > 1:
        yield RigidBody(LIFT, (), HEAD, Joint(JointKind.SLIDE, upright, motor=TIER_MOTOR))
        carrier = LIFT
    turning = Joint(JointKind.PIN, upright, motor=COLOUR_MOTOR)
    yield RigidBody(MAGAZINE, tuple(magazine_parts(weaver)), carrier, turning)


@lru_cache(maxsize=32)
def mass_of(weaver: Weaver) -> Mapping[str, float]:
    """Masses of the head's parts, all pieces of each [kg], by title; arms that tie the knots among them."""
    parts = {
        part.title: number * part.mass for part, number in head_tree(weaver).occurrences() if not math.isnan(part.mass)
    }
    arms = {"arms": weaver.params.arms.mass} if weaver.params.with_arms else {}
    return {**parts, **arms}


def cam_masses(weaver: Weaver) -> Mapping[str, float]:
    """Mass of the plate of each cam, by its name [kg]."""
    masses = {part.id: part.mass for part, _ in head_tree(weaver).occurrences()}
    return {cam.name: masses[cam_id(cam.name)] for cam in weaver.cams}


def head_mass(weaver: Weaver) -> float:
    """Mass of the head on its carriage [kg]: as given, or of its parts."""
    return weaver.params.head_mass or sum(mass_of(weaver).values())
