"""The tree of a planar linkage: each link a plate in a plane of its own, pins across the planes, a plate that stands.

Axes are those of the linkage's ground, z along the pins from the plate that stands on. The frame of a link lies at
z = 0 with the axes that the link has in the mechanism, its plate at the level of the link. A pin is fixed in the plate
that stands, else in the link of the lower level; all others turn on it.
"""

import itertools
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import field
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.elements.materials import MATERIALS, Material
from ilmek.linkage.model import GROUND, Mechanism, Pin, Slide
from ilmek.linkage.motion import Motion
from ilmek.part.link_motion import carriers, closures, link_motions, resting
from ilmek.part.part import Part, Seat
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import drilled
from ilmek.part.shapes import Prism, bar
from ilmek.part.tree import Closure, Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import rounded_hull
from ilmek.records import record
from ilmek.report import Hole
from ilmek.report.scene import SceneMotion
from ilmek.units import turn

GAP = 0.4
"""Distance of neighbouring levels, over the greatest thickness of a link: assumed by this project."""

BRIDGE = 1.5
"""Least distance of two holes of a link, over their diameter; assumed by this project."""

PIN_STEEL = MATERIALS["heat-treatable steel"]

FRAME = "frame"
"""Last part of the id of the plate that stands."""

JOURNAL = "journal"
"""Seat of a pin."""

TURN = "turn"
"""Drive of a linkage in space: a turn of its crank, or its way to and fro."""

Direction: TypeAlias = tuple[float, float, float]

_Z: Direction = (0.0, 0.0, 1.0)


@record
class LinkSize:
    """Size of a link's plate: width, thickness, diameter of its holes [m], and its material."""

    width: float
    thickness: float
    hole: float
    material: Material


@record
class Levels:
    """Planes of a linkage, from the plate that stands on.

    bodies  names of those in each plane, the ground in the first      sizes  of each body's plate
    pins    diameters by name of those that are not as large as the holes of both their links [m]
    """

    bodies: tuple[tuple[str, ...], ...]
    sizes: Mapping[str, LinkSize]
    pins: Mapping[str, float] = field(default_factory=dict)

    @property
    def bottoms(self) -> dict[str, float]:
        """Height of the lower face of each body's plate [m]."""
        thick = [max(self.sizes[body].thickness for body in level) for level in self.bodies]
        gap = GAP * max(thick)
        heights = itertools.accumulate((one + gap for one in thick[:-1]), initial=0.0)
        return {body: height for level, height in zip(self.bodies, heights, strict=True) for body in level}

    def across(self, bodies: Sequence[str]) -> tuple[float, float]:
        """Least and greatest height of the plates of bodies [m]."""
        bottoms = self.bottoms
        ends = [(bottoms[body], bottoms[body] + self.sizes[body].thickness) for body in bodies]
        return min(low for low, _ in ends), max(high for _, high in ends)

    def lowest(self, bodies: Sequence[str]) -> str:
        """The body of the lowest plate, of several the first."""
        return min(bodies, key=self.bottoms.__getitem__)


def bored(pins: Mapping[str, complex], least: float) -> dict[str, complex]:
    """The pins of a link that have a bridge between their holes: each at least so far [m] from those before it.

    >>> bored({"A": 0j, "B": 0.1 + 0j, "E": 0.104 + 0j}, 0.015)
    {'A': 0j, 'B': (0.1+0j)}
    """
    kept: dict[str, complex] = {}
    for name, point in pins.items():
        if all(abs(point - other) >= least for other in kept.values()):
            kept[name] = point
    return kept


def link_part(name: str, title: str, pins: Mapping[str, complex], size: LinkSize) -> Part:
    """A link's plate from z = 0: round about its pins, bored for those that have a bridge between them.

    pins  names and positions in the link's frame [m]
    Raises ParameterError for holes that leave nothing of it.
    """
    points = np.array(list(pins.values()), dtype=complex)
    holes = [Hole(point, size.hole / 2) for point in bored(pins, BRIDGE * size.hole).values()]
    shape = Prism(drilled(rounded_hull(points, size.width / 2), holes), size.thickness)
    seats = {pin: Seat(placement(point.real, point.imag), size.hole) for pin, point in pins.items()}
    return Part(name, title, "machined link", shape, size.material, seats=seats)


def pin_part(name: str, title: str, diameter: float, length: float) -> Part:
    """A pin about z from z = 0 [m]."""
    shape = bar(diameter, length)
    return Part(name, title, "pin or bush", shape, PIN_STEEL, seats={JOURNAL: Seat(placement(), diameter)})


@record
class LinkageParts:
    """Parts of a linkage: the plate of each body, of the ground the one that stands; the pin of each joint, by name."""

    machine: str
    levels: Levels
    plates: Mapping[str, Part]
    pins: Mapping[str, Part]

    @property
    def ids(self) -> dict[str, str]:
        """Ids of the parts by the names of links and pins, for checks."""
        return {name: part.id for name, part in (*self.plates.items(), *self.pins.items())}


def linkage_parts(
    machine: str,
    mechanism: Mechanism,
    levels: Levels,
    formed: Mapping[str, Part] = MappingProxyType({}),
    shafts: Collection[str] = (),
    *,
    of: str = "",
) -> LinkageParts:
    """The plates of a linkage's bodies and the pins of its turning joints; pins of the same size are one part.

    machine  first part of the ids      formed  plates of another form, by their bodies
    shafts   joints that are no pins, but shafts      of  what the links and pins belong to, for their titles
    """
    plates, pins, sizes = {}, dict[str, Part](), dict[tuple[float, float], Part]()
    joints = [one for one in mechanism.joints if isinstance(one, Pin) and set(one.bodies) <= set(levels.sizes)]
    for body, size in levels.sizes.items():
        if body in formed:
            plates[body] = formed[body]
            continue
        points = mechanism.body(body).points
        if body == GROUND:
            points = {one.name: points[one.name] for one in joints if one.name in points}
        title = "frame plate" if body == GROUND else f"{body} {of}".strip()
        plates[body] = link_part(body_id(machine, body), title, points, size)
    for joint in joints:
        if joint.name in shafts:
            continue
        low, high = levels.across(joint.bodies)
        least = min(levels.sizes[body].hole for body in joint.bodies)
        made = levels.pins.get(joint.name, least), round(high - low, 9)
        if made not in sizes:
            sizes[made] = pin_part(f"{machine}/pin{f'-{len(sizes) + 1}' if sizes else ''}", f"pin {of}".strip(), *made)
        pins[joint.name] = sizes[made]
    return LinkageParts(machine, levels, plates, pins)


def linkage_tree(
    parts: LinkageParts,
    motion: Motion,
    others: Mapping[str, Sequence[Occurrence]] = MappingProxyType({}),
    angle: FloatArray | None = None,
) -> Tree:
    """The bodies of a linkage at the first sample of a motion, and their motions over all of it.

    others   parts of the bodies beside plates and pins, in the frames of the bodies
    angle    of the drive at the samples, ascending from 0 to 2 pi [rad]; default: evenly
    What carries the plate that stands is not designed.
    """
    fixed = (*_fixed(parts, motion.plan.mechanism, GROUND), *others.get(GROUND, ()))
    ground = RigidBody(body_id(parts.machine, GROUND), fixed, joint=Joint(JointKind.MISSING))
    bodies = linkage_bodies(parts, motion, others, angle)
    return Tree((ground, *bodies), linkage_closures(parts.machine, motion.plan.mechanism))


def linkage_closures(machine: str, mechanism: Mechanism, suffix: str = "") -> tuple[Closure, ...]:
    """The joints that close the loops of the bodies of `linkage_bodies`."""
    ids = {body: body_id(machine, body) + suffix for body in mechanism.moving}
    return closures(mechanism, {GROUND: body_id(machine, GROUND), **ids})


def linkage_bodies(
    parts: LinkageParts,
    motion: Motion,
    others: Mapping[str, Sequence[Occurrence]] = MappingProxyType({}),
    angle: FloatArray | None = None,
    *,
    z: float = 0.0,
    suffix: str = "",
) -> tuple[RigidBody, ...]:
    """The moving bodies of `linkage_tree`, z [m] above the plate that stands; suffix: of their ids."""
    mechanism = motion.plan.mechanism

    def fixed(body: str) -> tuple[Occurrence, ...]:
        return (*_fixed(parts, mechanism, body), *others.get(body, ()))

    def seats(body: str, joint: str) -> tuple[str, ...]:
        pin, plate = parts.pins.get(joint), parts.plates.get(body)
        return (f"{plate.id}:{joint}", f"{pin.id}:{JOURNAL}") if pin and plate else ()

    return jointed_bodies(parts.machine, motion, fixed, seats, angle, z=z, suffix=suffix)


def jointed_bodies(
    machine: str,
    motion: Motion,
    occurrences: Callable[[str], tuple[Occurrence, ...]],
    seats: Callable[[str, str], tuple[str, ...]],
    angle: FloatArray | None = None,
    *,
    line: Callable[[str, str], Direction] = lambda _body, _slide: _Z,
    z: float = 0.0,
    suffix: str = "",
) -> tuple[RigidBody, ...]:
    """The moving bodies of a linkage at the first sample of a motion, each on the body that carries it.

    occurrences  what is fixed in a body      seats  that meet in the joint by which a body is carried
    line         direction of the slide by which a body is carried
    angle        as of `linkage_tree`      z  height above what stands [m]      suffix  of the ids
    """
    mechanism, carried = motion.plan.mechanism, carriers(motion.plan.mechanism)
    motions = _motions(motion, {body: parent for body, (parent, _) in carried.items()}, angle)
    bodies = []
    for body, (parent, number) in carried.items():
        joint, on_ground = mechanism.joints[number], parent == GROUND
        slides = isinstance(joint, Slide)
        kind, along = (JointKind.SLIDE, line(body, joint.name)) if slides else (JointKind.PIN, _Z)
        bodies.append(
            RigidBody(
                body_id(machine, body) + suffix,
                occurrences(body),
                body_id(machine, parent) + ("" if on_ground else suffix),
                Joint(kind, along, motions.get(body), seats(body, joint.name)),
                (placement(z=z if on_ground else 0.0).after(resting(motion, body, parent)),),
            )
        )
    return tuple(bodies)


def body_id(machine: str, body: str) -> str:
    """Id of a linkage's body in the tree, and of its plate."""
    return f"{machine}/{FRAME if body == GROUND else body.replace(' ', '-')}"


def link_inertias(
    parts: LinkageParts, mechanism: Mechanism, others: Mapping[str, Sequence[Occurrence]] = MappingProxyType({})
) -> dict[str, Inertia]:
    """Inertia of each moving body of a linkage, of all that is fixed in it; others as in `linkage_tree`."""
    return {body: inertia_of((*_fixed(parts, mechanism, body), *others.get(body, ()))) for body in mechanism.moving}


def inertia_of(occurrences: Sequence[Occurrence]) -> Inertia:
    """Inertia in the plane of motion of parts in the frame of their body; of those that are weighed."""
    moments = RigidBody("", tuple(occurrences)).moments
    return Inertia(moments.zeroth, complex(*moments.centre[:2]), float(moments.inertia[2, 2]))


def _fixed(parts: LinkageParts, mechanism: Mechanism, body: str) -> tuple[Occurrence, ...]:
    """The plate of a body, and the pins that are fixed in it."""
    if body not in parts.plates:
        return ()
    levels = parts.levels
    positions: dict[str, list[Placement]] = {}
    pins = {pin.id: pin for pin in parts.pins.values()}
    for joint in mechanism.joints:
        if joint.name in parts.pins and levels.lowest(joint.bodies) == body:
            point, low = mechanism.body(body).points[joint.name], levels.across(joint.bodies)[0]
            positions.setdefault(parts.pins[joint.name].id, []).append(placement(point.real, point.imag, low))
    plate = Occurrence(parts.plates[body], (placement(z=levels.bottoms[body]),))
    return (plate, *(Occurrence(pins[name], tuple(places)) for name, places in positions.items()))


def _motions(motion: Motion, parents: Mapping[str, str], angle: FloatArray | None) -> dict[str, SceneMotion]:
    """The motions in space; none of a single sample."""
    if len(motion) < 2:
        return {}
    return link_motions(motion, motion, parents, TURN, np.linspace(0.0, turn, len(motion)) if angle is None else angle)
