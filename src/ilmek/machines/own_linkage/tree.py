"""The tree of an own mechanism: its parts in bodies, from the plate that stands up, and their motions.

Axes are those of the mechanism's ground, z from the upper face of the plate that stands along the pins. The frame of a
body lies at z = 0 with the axes that the body has in the mechanism.
"""

import cmath
import math
from collections.abc import Iterator
from functools import lru_cache, partial

import numpy as np

from ilmek.linkage.model import GROUND
from ilmek.machines.link_tree import JOURNAL, body_id, jointed_bodies, linkage_closures
from ilmek.machines.own_linkage.axes import PinAxis, SlideLine
from ilmek.machines.own_linkage.construction import PLAY, Construction, rail_ends
from ilmek.machines.own_linkage.layers import RingSide
from ilmek.machines.own_linkage.parts import LOOSE, PartStock, base_part, link_plate_part
from ilmek.machines.own_linkage.shafts import housing_length, key_direction, shaft_lengths, shaft_seat
from ilmek.machines.own_linkage.sizes import shaft_bearing
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.records import record

_Z = (0.0, 0.0, 1.0)
_FLUSH = 1e-7
"""Height [m] below which there is nothing between a carriage and its link."""


@record
class PlacedPart:
    """A part in a body."""

    body: str
    part: Part
    position: Placement


@lru_cache(maxsize=16)
def own_tree(built: Construction) -> Tree:
    """The tree of a construction: at the first sample of its motion, with the motions over all of it."""
    placed = tuple(_placed(built, PartStock(built.name)))
    parts = {one.part.id: one.part for one in placed}
    ground = RigidBody(body_id(built.name, GROUND), _occurrences(placed, GROUND), joint=Joint(JointKind.MISSING))
    bodies = jointed_bodies(
        built.name,
        built.motion,
        partial(_occurrences, placed),
        partial(_seats, built, parts, placed),
        line=partial(_direction, built),
    )
    return Tree((ground, *bodies), linkage_closures(built.name, built.machine.mechanism))


def _direction(built: Construction, body: str, slide: str) -> tuple[float, float, float]:
    line = next(one for one in built.lines if one.name == slide)
    along = line.forward if line.body == body else line.along
    return along.real, along.imag, 0.0


def _seats(
    built: Construction, parts: dict[str, Part], placed: tuple[PlacedPart, ...], body: str, joint: str
) -> tuple[str, ...]:
    """The seats that meet in the joint that carries a body: of its plate, and of the pin."""
    axis = next((one for one in built.axes if joint in one.joints), None)
    if axis is None:
        return ()
    fixed = built.fixed(axis)
    pins = (
        part.part.id
        for part in placed
        if part.body == fixed and JOURNAL in part.part.seats
        if abs(complex(*part.position.origin[:2]) - axis.points[fixed]) < _FLUSH
    )
    pin = next(pins, "")
    return (f"{parts[body_id(built.name, body)].id}:{axis.name}", f"{pin}:{JOURNAL}") if pin else ()


def _occurrences(placed: tuple[PlacedPart, ...], body: str) -> tuple[Occurrence, ...]:
    """The parts of a body, each with all its positions."""
    positions: dict[str, list[Placement]] = {}
    parts: dict[str, Part] = {}
    for one in placed:
        if one.body == body:
            parts[one.part.id] = one.part
            positions.setdefault(one.part.id, []).append(one.position)
    return tuple(Occurrence(part, tuple(positions[name])) for name, part in parts.items())


def _placed(built: Construction, stock: PartStock) -> Iterator[PlacedPart]:
    """All parts of a construction where they lie in their bodies."""
    yield PlacedPart(GROUND, base_part(built), placement(z=built.bottoms[GROUND]))
    for body in built.machine.mechanism.moving:
        yield PlacedPart(body, link_plate_part(built, body), placement(z=built.bottoms[body]))
    for axis in built.axes:
        yield from _shaft(built, stock, axis) if axis.driven else _pin(built, stock, axis)
        yield from _turning(built, stock, axis)
    for line in built.lines:
        yield from _slide(built, stock, line)


def _on(axis: PinAxis, body: str, z: float) -> Placement:
    point = axis.points[body]
    return placement(point.real, point.imag, z)


def _running(built: Construction, axis: PinAxis) -> list[str]:
    """The bodies that turn on a pin or shaft, from the lowest layer up; not the ground on a shaft."""
    return [body for body in built.order(axis) if body not in {built.fixed(axis), GROUND}]


def _pin(built: Construction, stock: PartStock, axis: PinAxis) -> Iterator[PlacedPart]:
    fixed, running, stud = built.fixed(axis), _running(built, axis), built.studs[axis.name]
    foot = built.foot(axis)
    if built.side(axis) is RingSide.BELOW:
        begin, seat, end = built.top(fixed), built.end(axis, running[-1]), built.bottoms[running[0]] - PLAY
        lies = _on(axis, fixed, begin).after(placement(about=(1.0, 0.0, 0.0), angle=math.pi))
        ring = end - stud.ring.thickness
    else:
        plated = any(line.body == fixed and built.riser(line)[1] for line in built.lines)
        begin, seat = built.bottoms[fixed] + PLAY * plated, built.bottoms[running[0]]
        end = built.end(axis, running[-1]) + PLAY
        lies, ring = _on(axis, fixed, begin), end
    yield PlacedPart(fixed, stock.pin(stud, abs(foot - begin), abs(seat - foot), abs(end - seat)), lies)
    yield PlacedPart(fixed, stock.ring(stud.ring), _on(axis, fixed, ring))


def _turning(built: Construction, stock: PartStock, axis: PinAxis) -> Iterator[PlacedPart]:
    """Bushes or bearings of the bodies that turn on an axis, and spacers between them; a collar is the first spacer."""
    stud, fixed = built.studs[axis.name], built.fixed(axis)
    running = _running(built, axis)
    for body in running:
        row, low = stud.bearing, built.bottoms[body]
        part = stock.bearing(row) if row else stock.bush(stud.journal, built.end(axis, body) - low)
        yield PlacedPart(body, part, _on(axis, body, low))
    stacked = [body for body in built.order(axis) if body != GROUND] if axis.driven else running
    tops = [0.0] * bool(axis.driven) + [built.end(axis, body) for body in stacked]
    for top, body in zip(tops, stacked[not axis.driven :], strict=False):
        spacer = stock.spacer(stud.collar, stud.journal + LOOSE, built.bottoms[body] - top)
        yield PlacedPart(fixed, spacer, _on(axis, fixed, top))


def _shaft(built: Construction, stock: PartStock, axis: PinAxis) -> Iterator[PlacedPart]:
    """The shaft of a driven body with its keys and rings; its housing and bearings in the plate that stands."""
    body, stud, key = axis.driven, built.studs[axis.name], built.key(axis)
    long, lengths, ring = housing_length(stud), shaft_lengths(built, axis), stud.ring
    at, angle = axis.points[body], cmath.phase(key_direction(built, axis))
    low = built.bottoms[body]
    ends = [low - lengths.stub - lengths.plain, low]

    def along(z: float) -> Placement:
        return placement(at.real, at.imag, z, about=_Z, angle=angle)

    yield PlacedPart(body, stock.ring(ring), _on(axis, body, -long - ring.thickness))
    if lengths.hub:
        yield PlacedPart(body, stock.shaft(stud, lengths, key), along(ends[0]))
        yield PlacedPart(body, stock.ring(ring), _on(axis, body, low + lengths.hub + lengths.beyond + PLAY))
    if key is not None:
        name = f"{built.name}/key-{body.replace(' ', '-')}"
        keys = catalogue.keys(name, "key", key, *map(along, ends if lengths.hub else ends[:1]))
        yield from (PlacedPart(body, keys.part, position) for position in keys.positions)
    yield PlacedPart(GROUND, stock.housing(stud), _on(axis, GROUND, -long))
    row, wide = shaft_bearing(stud.journal), shaft_seat(stud)[1]
    seat = stock.bearing(row) if row else stock.bush(stud.journal, wide)
    yield from (PlacedPart(GROUND, seat, _on(axis, GROUND, z)) for z in (-wide, -long))


def _slide(built: Construction, stock: PartStock, line: SlideLine) -> Iterator[PlacedPart]:
    """The rail of a slide on its guide, the carriage and what is between it and the sliding body."""
    row = built.guides[line.name]
    above = built.bottoms[line.body] > built.bottoms[line.guide]
    face = built.top(line.guide) if above else built.bottoms[line.guide]
    first, last = rail_ends(line, row)
    rail = stock.rail(row, abs(last - first))
    yield PlacedPart(line.guide, rail, _laid((first + last) / 2, line.along, face, abs(last - first), above=above))
    yield PlacedPart(line.body, stock.carriage(row), _laid(line.at, line.forward, face, row.block_length, above=above))
    end = face + row.height if above else face - row.height
    other = built.bottoms[line.body] if above else built.top(line.body)
    if abs(other - end) > _FLUSH:
        at = placement(line.at.real, line.at.imag, min(end, other), about=_Z, angle=cmath.phase(line.forward))
        yield PlacedPart(line.body, stock.riser(row, built.riser(line)[0], abs(other - end)), at)


def _laid(middle: complex, along: complex, z: float, length: float, *, above: bool) -> Placement:
    """A rail or carriage, which lies along its own z with its y up from its base, along a line at a height."""
    start = middle - along * length / 2
    up = 1.0 if above else -1.0
    x = np.array([-along.imag, along.real, 0.0]) * up  # y cross z
    axes = np.stack([x, np.array([0.0, 0.0, up]), np.array([along.real, along.imag, 0.0])], axis=1)
    assert math.isclose(float(np.linalg.det(axes)), 1.0, abs_tol=1e-9)
    return Placement(np.array([start.real, start.imag, z]), axes)
