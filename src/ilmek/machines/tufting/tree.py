"""The needle mechanisms as a tree of bodies: side by side along the main shaft, each with its own driven shaft.

Axes are those of the paper, z along the shafts. Each mechanism runs between two bearing plates; its main shaft is
driven in line. What guides the needle bars and what carries the bearing plates is not designed.
"""

import cmath
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.elements.materials import MATERIALS
from ilmek.elements.reducers import DIRECT
from ilmek.linkage.model import GROUND
from ilmek.linkage.motion import Motion
from ilmek.machines.link_tree import TURN, body_id, linkage_bodies, linkage_closures
from ilmek.machines.shaft_stand import lantern
from ilmek.machines.tufting.design import Tufting
from ilmek.machines.tufting.links import NAME, WALL, driven_shaft, mechanism_depth, needle_parts, shaft_part
from ilmek.machines.tufting.model import move
from ilmek.machines.tufting.strength import needle_sizes, needle_strength
from ilmek.part import catalogue
from ilmek.part.flat_link import eyed_link
from ilmek.part.part import Part, Seat
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.part.tree import Closure, Joint, JointKind, Occurrence, RigidBody, Tree, in_line
from ilmek.plane.contours import circle, rounded_hull
from ilmek.report.scene import SceneMotion
from ilmek.units import turn

POSES = 91
"""Poses over a turn of the main shaft."""


@lru_cache(maxsize=8)
def tree(design: Tufting) -> Tree:
    """The bodies where the crank of the first mechanism lies along x."""
    return needle_drives(design, design_pitch(design), motors=tuple(_drive(design)))


def design_pitch(design: Tufting) -> float:
    """Distance of mechanisms side by side [m]: their depth, their bearing plates, and as much again for the shafts."""
    low, high = mechanism_depth(design.params, needle_sizes(design))
    return high - low + 2 * max(catalogue.length_of(bearing_plate(design)), needle_sizes(design).driven)


def needle_drives(
    design: Tufting,
    pitch: float,
    *,
    motors: tuple[Part, ...] = (),
    needle: tuple[Occurrence, ...] = (),
    feet: tuple[complex, ...] = (),
    welded: tuple[str, ...] = (),
    shaft: tuple[float, float] | None = None,
) -> Tree:
    """The mechanisms at a distance from each other [m], the first with its lowest plane at z = 0.

    motors  in line with the main shaft      needle  in place of the needle bar of each, in its frame
    feet    points that the bearing plates reach [m]      welded  ids of what they are welded to
    shaft   ends of the main shaft along z [m]; default: a diameter beyond the mechanisms
    """
    params, sizes = design.params, needle_sizes(design)
    (low, high), bearings = mechanism_depth(params, sizes), _bearings(design)
    plate, away = replace(bearing_plate(design, feet), joins=welded), _driven_shaft_at(design)
    thick, leaning = catalogue.length_of(plate), cmath.phase(away)
    stations = range(params.bars)
    heights = [low + side + station * pitch for station in stations for side in (-thick, high - low)]
    beside = [placement(z=height, about=(0.0, 0.0, 1.0), angle=leaning) for height in heights]
    frame = RigidBody(
        body_id(NAME, GROUND),
        (
            Occurrence(plate, tuple(beside)),
            *(_at(part, x, beside) for part, x in zip(bearings, (0.0, abs(away)), strict=True)),
            *(in_line(motors, low - thick) if motors else ()),
        ),
        joint=Joint(JointKind.MISSING),
    )
    first, last = shaft or (low - thick - sizes.main, low - thick + sizes.main + params.bars * pitch)
    main = shaft_part("main-shaft", "main shaft", sizes.main, last - first)
    turned = Joint(JointKind.PIN, motion=_turning())
    loops: list[Closure] = []
    bodies = [frame, RigidBody(f"{NAME}/main-shaft", (Occurrence(main, (placement(z=first),)),), frame.id, turned)]
    parts, driven = needle_parts(params, sizes), driven_shaft(params, sizes)
    carried = {"rocker": (driven,), "needle": needle}
    if needle:
        parts = replace(parts, plates={name: part for name, part in parts.plates.items() if name != "needle"})
    for station in stations:
        suffix = "" if params.bars == 1 else f" {station + 1}"
        moved = _motion(design, station)
        own = linkage_bodies(parts, moved, carried, z=station * pitch, suffix=suffix)
        fixed = {body_id(NAME, "arm") + suffix: None, body_id(NAME, "crank") + suffix: bodies[1]}
        bodies += (keyed(body, fixed[body.id]) if body.id in fixed else body for body in own)
        loops += linkage_closures(NAME, moved.plan.mechanism, suffix)
    return Tree(tuple(bodies), tuple(loops))


def _at(part: Part, x: float, plates: Sequence[Placement]) -> Occurrence:
    """A bearing in each plate, at x of the plate [m]."""
    return Occurrence(part, tuple(plate.after(placement(x)) for plate in plates))


def keyed(body: RigidBody, shaft: RigidBody | None) -> RigidBody:
    """A crank, fixed on its shaft; or the arm, which is fixed on the driven shaft as the rocker is, its parent."""
    joint = replace(body.joint, kind=JointKind.FIXED, motion=None)
    if shaft is None:
        return replace(body, joint=joint)
    (on_shaft,) = shaft.positions
    positions = tuple(on_shaft.inverse.after(position) for position in body.positions)
    return replace(body, joint=joint, parent=shaft.id, positions=positions)


def _turning() -> SceneMotion:
    """The main shaft over a turn."""
    angle = np.linspace(0.0, turn, POSES)
    return SceneMotion(TURN, angle, np.zeros((POSES, 3)), angle)


def _motion(design: Tufting, station: int) -> Motion:
    """A mechanism over a turn of the first: its crank lags."""
    angle = np.linspace(0.0, turn, POSES) - station * design.params.phase
    return move(design.params, design.plan, angle)


def _bearings(design: Tufting) -> tuple[Part, Part]:
    """Bearings of the main and of the driven shaft."""
    strength = needle_strength(design)
    return (
        catalogue.bearing(f"{NAME}/main-bearing", "bearing of the main shaft", strength.main.bearing),
        catalogue.bearing(f"{NAME}/driven-bearing", "bearing of the driven shaft", strength.driven.bearing),
    )


def bearing_plate(design: Tufting, feet: tuple[complex, ...] = ()) -> Part:
    """A plate with the seats of both bearings, x from the main to the driven shaft, as thick as the wider of them.

    feet  points that it reaches with the radius about its greater seat, in the axes of the mechanism [m]
    """
    strength, shaft = needle_strength(design), _driven_shaft_at(design)
    away = abs(shaft)
    rows = strength.main.bearing, strength.driven.bearing
    thick, (first, second) = max(row.width for row in rows), (row.outer / 2 for row in rows)
    holes = [circle(0j, first), *([circle(complex(away), second)] if away > first + second else [])]
    eyes = [radius * (1 + 2 * WALL) for radius in (first, second)]
    outline = eyed_link(away, *eyes)
    if feet:
        turned = np.array([0, shaft, *feet]) * abs(shaft) / shaft
        outline = rounded_hull(turned, max(eyes))
    return Part(
        body_id(NAME, GROUND),
        "bearing plate",
        "laser-cut part",
        Prism(Profile(outline, tuple(holes)), thick),
        MATERIALS["structural steel"],
        machined=True,
        seats={"O": Seat(placement(), 2 * first), "C": Seat(placement(away), 2 * second)},
    )


def _driven_shaft_at(design: Tufting) -> complex:
    return complex(design.params.shaft_distance, design.params.shaft_height)


def _drive(design: Tufting) -> Iterator[Part]:
    """The lantern on the first bearing plate, and behind it the servo of the main shaft with its reducer."""
    strength, driven = needle_strength(design), list[Part]()
    row, reducer = strength.motor or (None, DIRECT)
    if reducer.ratio != 1:
        driven.append(catalogue.reducer(f"{NAME}/reducer", "reducer of the main shaft", reducer, row))
    torque, speed = reducer.motor_torque(strength.motor_torque), design.params.speed * reducer.ratio
    driven.append(catalogue.motor(f"{NAME}/motor", "servo of the main shaft", row, torque, speed))
    main = needle_sizes(design).main
    yield lantern(f"{NAME}/lantern", "main shaft", driven[0], main, main)
    yield from driven
