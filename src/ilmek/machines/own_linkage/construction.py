"""The construction of an own mechanism: layers of its bodies, sizes of its pins, heights above the plate that stands.

Pins are as thick as their forces ask for in the layers that were found; thicker pins take more room, so that layers are
searched again until both agree.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.dynamics.inverse_run import InverseRun
from ilmek.dynamics.own_machine import FlatMember, OwnMachine
from ilmek.elements.linear_guides import LinearGuide
from ilmek.elements.machine_screws import SOCKET_SCREWS
from ilmek.elements.parallel_keys import KeyedEnd, keyed_end
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND
from ilmek.linkage.motion import Motion
from ilmek.machines.link_tree import PIN_STEEL
from ilmek.machines.own_linkage.axes import JointLoads, PinAxis, SlideLine, joint_loads, pin_axes, slide_lines
from ilmek.machines.own_linkage.forms import Eye, Layer, link_layer, shape_layers
from ilmek.machines.own_linkage.layers import BodyPath, Layering, RingSide, Room, RoomKind, layering, meeting
from ilmek.machines.own_linkage.sizes import (
    DIAMETERS,
    KEYED,
    StudSize,
    StudStress,
    first_studs,
    guide_for,
    journal_stress,
    link_members,
    riser_size,
    shank_stress,
    thicker,
    usual_diameter,
)
from ilmek.part.shapes import rectangle
from ilmek.plane.outlines import Outline
from ilmek.records import record
from ilmek.units import format_quantity, mm

PLAY = 0.1 * mm
"""Play of the bodies of a pin along it [m]; assumed by this project."""

CLEAR_ABOVE = 1 * mm
"""Distance of a ring from the layer above it [m]; assumed by this project."""

BRIDGE = 1 * mm
"""Least wall between two bores of a link [m]; assumed by this project."""

RAIL_END = 5 * mm
"""Rail beyond the carriage at the ends of its travel [m]."""

_ROUNDS = 30
"""Rounds in which pins and layers are made to agree: more than there are diameters."""


@record
class Construction:
    """A mechanism with what its parts follow from.

    name      first part of the ids             motion   over the whole way and back: its first sample is the rest
    members   section of each moving body       studs    pins and shafts by axis       guides  of the slides by name
    loads     greatest forces                   layering layers of the bodies
    """

    name: str
    machine: OwnMachine
    motion: Motion
    axes: tuple[PinAxis, ...]
    lines: tuple[SlideLine, ...]
    members: Mapping[str, FlatMember]
    studs: Mapping[str, StudSize]
    guides: Mapping[str, LinearGuide]
    loads: JointLoads
    layering: Layering

    def order(self, axis: PinAxis) -> list[str]:
        """The bodies of an axis from the lowest layer up."""
        return sorted(axis.points, key=lambda body: self.layering.layers[body])

    def fixed(self, axis: PinAxis) -> str:
        """The body in which the pin or shaft of an axis is fixed."""
        return axis.driven or self.order(axis)[-1 if self.side(axis) is RingSide.BELOW else 0]

    def side(self, axis: PinAxis) -> RingSide:
        """Where the ring of an axis is."""
        return self.layering.sides.get(axis.name, RingSide.ABOVE)

    def key(self, axis: PinAxis) -> KeyedEnd | None:
        """The key of a driven shaft; None: it is pressed in, too thin for one."""
        size, torque = self.studs[axis.name].journal, self.loads.torques.get(axis.driven, 0.0)
        return keyed_end(size, torque, PIN_STEEL.strength) if size > KEYED + 1e-9 else None

    def thickness(self, body: str) -> float:
        """Thickness of a body's plate [m]: at least its key's length, and what the heads of its carriages need."""
        if body == GROUND:
            return base_thickness(self.studs.values())
        if self.machine.shapes.get(body):
            return max(layer.high for layer in self.layers_of(body))
        driven = (self.key(axis) for axis in self.axes if axis.driven == body)
        needed = [key.length for key in driven if key is not None]
        for line in self.lines:
            if line.body == body:
                screw = SOCKET_SCREWS[self.guides[line.name].block_screw]
                needed.append(screw.head + screw.diameter)
        return max(self.members[body].thickness, *needed, 0.0)

    def riser(self, line: SlideLine) -> tuple[float, float]:
        """Length and least height of the plate between a carriage and its link [m]."""
        return riser_size(line, self.guides[line.name], self.studs.values())

    def layers_of(self, body: str) -> tuple[Layer, ...]:
        """The plates of a moving body: its shapes, or one about its eyes."""
        return _layers(self, body)

    def height(self, body: str) -> float:
        """Height of a body with its bushes and bearings [m]."""
        long = (
            self.studs[axis.name].lengths[body]
            for axis in self.axes
            if body in axis.points and self.fixed(axis) != body and body != GROUND
        )
        return max(self.thickness(body), *long, 0.0)

    @property
    def gap(self) -> float:
        """Height between two layers [m]: room for rings."""
        rings = (stud.ring for stud in self.studs.values())
        return max((PLAY + ring.slot + ring.end for ring in rings), default=0.0) + CLEAR_ABOVE

    @property
    def bottoms(self) -> Mapping[str, float]:
        """Height of the lower face of each body's plate over that of the plate that stands [m]; of that below 0."""
        return _bottoms(self)

    def top(self, body: str) -> float:
        """Height of the upper face of a body's plate [m]."""
        return self.bottoms[body] + self.thickness(body)

    def foot(self, axis: PinAxis) -> float:
        """Height at which a pin leaves the body that it is fixed in, a driven shaft its bearings [m]."""
        if axis.driven:
            return 0.0
        return self.bottoms[self.fixed(axis)] if self.side(axis) is RingSide.BELOW else self.top(self.fixed(axis))

    def end(self, axis: PinAxis, body: str) -> float:
        """Upper end of a body on an axis [m]: of its bush or bearing where it turns, else of its plate."""
        if self.fixed(axis) == body:
            return self.top(body)
        return self.bottoms[body] + max(self.studs[axis.name].lengths[body], self.thickness(body))

    def stresses(self, axis: PinAxis) -> tuple[StudStress, StudStress]:
        """What a pin or shaft bears at the foot of its journal, and of its collar."""
        stud, forces = self.studs[axis.name], self.loads.pins.get(axis.name, {})
        bodies = [body for body in self.order(axis) if body != GROUND and (axis.driven or body != self.fixed(axis))]
        loads = {body: forces.get(body, 0.0) for body in bodies}
        middles = {body: self.bottoms[body] + stud.lengths[body] / 2 for body in bodies}
        foot, begin = self.foot(axis), self.bottoms[bodies[0]]
        if axis.driven:
            begin = foot
        elif self.side(axis) is RingSide.BELOW:
            begin = self.end(axis, bodies[-1])
        journal = journal_stress(stud, {body: abs(z - begin) for body, z in middles.items()}, loads)
        return journal, shank_stress(stud, {body: abs(z - foot) for body, z in middles.items()}, loads)


@lru_cache(maxsize=256)
def _layers(built: Construction, body: str) -> tuple[Layer, ...]:
    shapes, member, eyes = built.machine.shapes.get(body), built.members[body], []
    for axis in (axis for axis in built.axes if body in axis.points):
        stud, keyed = built.studs[axis.name], built.key(axis) is not None
        eyes.append(Eye(axis.points[body], stud.eye(body, keyed=keyed), stud.hole(body, keyed=keyed) + BRIDGE))
    if shapes:
        return shape_layers(shapes, eyes)
    eyes += (Eye(at, member.width / 2) for at in _free_points(built, body).values())
    eyes += _slide_eyes(built, body, member.width / 2)
    return (link_layer(eyes, member.width, built.thickness(body)),)


def _free_points(built: Construction, body: str) -> dict[str, complex]:
    """The points of a body that are no joints, such as its tool's."""
    joints = {joint.name for joint in built.machine.mechanism.joints}
    return {name: at for name, at in built.machine.mechanism.body(body).points.items() if name not in joints}


def tool_holes(built: Construction, body: str) -> dict[str, float]:
    """Radius of the hole at each point of a body that is no joint, where there is room beside its joints [m]."""
    radius = usual_diameter(built.members[body].width) / 2
    taken = [
        (axis.points[body], stud.eye(body, keyed=True))
        for axis, stud in ((axis, built.studs[axis.name]) for axis in built.axes)
        if body in axis.points
    ]
    kept: dict[str, float] = {}
    for name, at in _free_points(built, body).items():
        if all(abs(at - other) >= size + radius for other, size in taken):
            kept[name] = radius
            taken.append((at, radius + BRIDGE))
    return kept


def rail_ends(line: SlideLine, guide: LinearGuide) -> tuple[complex, complex]:
    """Ends of a rail on its line, in the guide's frame [m]: whole millimetres apart."""
    middle = line.on + line.along * (sum(line.travel) / 2)
    long = line.travel[1] - line.travel[0] + guide.block_length + 2 * RAIL_END
    half = line.along * math.ceil(long / mm) * mm / 2
    return middle - half, middle + half


def _rail(line: SlideLine, guide: LinearGuide) -> Outline:
    first, last = rail_ends(line, guide)
    side = 0.5j * guide.rail * line.along
    return Outline((first - side, last - side, last + side, first + side), 0.0)


def _slide_eyes(built: Construction, body: str, radius: float) -> Iterator[Eye]:
    """Where a plate must reach under its carriages, and along its rails."""
    for line in built.lines:
        guide = built.guides[line.name]
        if line.body == body:
            x, y = (max(side / 2 - radius, 0.0) for side in (built.riser(line)[0], guide.block))
            inner = dict.fromkeys(complex(*corner) for corner in ((x, y), (-x, y), (-x, -y), (x, -y)))
            yield from (Eye(line.at + line.forward * corner, radius) for corner in inner)
        if line.guide == body:
            yield from (Eye(end, max(radius, guide.rail / 2)) for end in rail_ends(line, guide))


def base_thickness(studs: Iterable[StudSize]) -> float:
    """Thickness of the plate that stands [m]: that of its thickest pin, at least 8 mm."""
    shanks = [stud.shank for stud in studs if GROUND in stud.axis.points and not stud.axis.driven]
    return max(8 * mm, *shanks, 0.0)


@lru_cache(maxsize=64)
def _bottoms(built: Construction) -> Mapping[str, float]:
    layers, gap = built.layering.layers, built.gap
    bottoms = {GROUND: -built.thickness(GROUND)}
    level = gap
    for number in range(1, built.layering.number + 1):
        bodies = [body for body, layer in layers.items() if layer == number]
        for line in built.lines:
            lower, upper = sorted((line.body, line.guide), key=layers.__getitem__)
            if upper in bodies:
                level = max(level, bottoms[lower] + built.thickness(lower) + built.guides[line.name].height)
                level += built.riser(line)[1]
        bottoms |= dict.fromkeys(bodies, level)
        level += max((built.height(body) for body in bodies), default=0.0) + gap
    return bottoms


def rooms(built: Construction) -> tuple[Room, ...]:
    """What takes room: the plates of the moving bodies, pins and their rings, rails and carriages."""
    taken = [
        Room(body, body, (body,), _outlines(built, body), RoomKind.PLATE) for body in built.machine.mechanism.moving
    ]
    for axis in built.axes:
        (body, point), stud = next(iter(axis.points.items())), built.studs[axis.name]
        for kind, diameter in ((RoomKind.PIN, stud.collar), (RoomKind.RING, max(stud.collar, stud.ring.room))):
            disc = Outline((point,), diameter / 2)
            taken.append(Room(axis.name, body, tuple(axis.points), (disc,), kind, _sides(built, axis)))
    for line in built.lines:
        guide, joins = built.guides[line.name], (line.guide, line.body)
        block = line.at + line.forward * rectangle(built.riser(line)[0], guide.block).points
        for body, outline in ((line.guide, _rail(line, guide)), (line.body, Outline(block, 0.0))):
            taken.append(Room(line.name, body, joins, (outline,), RoomKind.SLIDE))
    return tuple(taken)


def _outlines(built: Construction, body: str) -> tuple[Outline, ...]:
    return tuple(outline for layer in built.layers_of(body) for outline in layer.outlines)


def _sides(built: Construction, axis: PinAxis) -> tuple[RingSide, ...]:
    """Where the ring of an axis can be: of a pivot above, of a shaft too, or it is of one piece with its link."""
    if not axis.driven:
        return (RingSide.ABOVE,) if GROUND in axis.points else (RingSide.ABOVE, RingSide.BELOW)
    if len(axis.points) > 2:
        return (RingSide.ABOVE,)
    radius = built.studs[axis.name].bore(keyed=built.key(axis) is not None)
    short = any(
        abs(axis.points[axis.driven] - other.points[axis.driven]) < radius + built.studs[other.name].outer / 2 + BRIDGE
        for other in built.axes
        if other is not axis and axis.driven in other.points
    )
    return (RingSide.NONE,) if short else (RingSide.ABOVE, RingSide.NONE)


def paths(motion: Motion) -> dict[str, BodyPath]:
    """Where the bodies lie at the samples of a motion."""
    ones = np.ones(len(motion), dtype=complex)
    moving = {body: BodyPath(motion.origin(body), motion.direction(body)) for body in motion.plan.mechanism.moving}
    return {GROUND: BodyPath(0 * ones, ones), **moving}


def construction(
    machine: OwnMachine, motion: Motion, run: InverseRun | None = None, name: str = "mechanism"
) -> Construction:
    """The construction of a mechanism: sizes and layers that agree.

    motion  over the whole way      run  its forces; None: pins have their default diameters
    Raises MechanismError for a link that is too short for its pins; ParameterError for a pin without a ring.
    """
    axes, lines = pin_axes(machine.mechanism), slide_lines(motion)
    loads, members = joint_loads(machine.mechanism, axes, run), link_members(machine)
    studs = first_studs(machine, axes, members, loads)
    guides = {line.name: guide_for(line, members[line.body], loads, studs.values()) for line in lines}
    start = Layering({body: at for at, body in enumerate((GROUND, *machine.mechanism.moving))}, False, 0)
    built = Construction(name, machine, motion, axes, lines, members, studs, guides, loads, start)
    moved = paths(motion)
    for _ in range(_ROUNDS):
        taken = rooms(built)
        found = layering(machine.mechanism.moving, taken, tuple(meeting(taken, moved)))
        built = replace(built, layering=found)
        weak = _strengthened(built)
        if not weak:
            break
        studs = {**built.studs, **weak}
        guides = {line.name: guide_for(line, members[line.body], loads, studs.values()) for line in lines}
        built = replace(built, studs=studs, guides=guides)
    _check_bores(built)
    return built


def _strengthened(built: Construction) -> dict[str, StudSize]:
    """The next thicker sizes of the pins that are too weak; of one that is given, only of its shank."""
    stronger: dict[str, StudSize] = {}
    for axis in built.axes:
        stud, allowed = built.studs[axis.name], built.studs[axis.name].member
        if max(stud.journal, stud.shank) >= DIAMETERS[-1] - 1e-9 or (stud.given and axis.driven):
            continue
        for stress, journal in zip(built.stresses(axis), (True, False), strict=True):
            if journal and stud.given:
                continue
            if stress.bending > allowed.bending or stress.shear > allowed.shear or stress.pressure > allowed.pressure:
                stronger[axis.name] = thicker(stronger.get(axis.name, stud), journal=journal)
    return stronger


def bore_radius(built: Construction, axis: PinAxis, body: str) -> float:
    """Radius of a body's bore at an axis [m]: for its bush or bearing, for the shank, or 0 where both are one piece."""
    stud = built.studs[axis.name]
    if axis.driven == body:
        return 0.0 if built.side(axis) is RingSide.NONE else stud.bore(keyed=built.key(axis) is not None)
    return (stud.shank if built.fixed(axis) == body else stud.outer) / 2


def _check_bores(built: Construction) -> None:
    for body in built.machine.mechanism.moving:
        own = [axis for axis in built.axes if body in axis.points]
        for number, first in enumerate(own):
            for other in own[number + 1 :]:
                apart = abs(first.points[body] - other.points[body])
                needed = bore_radius(built, first, body) + bore_radius(built, other, body) + BRIDGE
                if apart < needed:
                    short, least = (format_quantity(value, "mm", 3) for value in (apart, needed))
                    raise MechanismError(
                        f"{body} is too short for its pins: {first.name} and {other.name} are {short} apart",
                        allowed=f"{least} or more with their bores",
                        do=f"make it longer, or set thinner pins: [pins] {other.name}.diameter",
                    )
