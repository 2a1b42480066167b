"""The parts of an own mechanism's construction: plates, pins, shafts with their housings, bushes, rings, guides.

Parts of the same kind and sizes are one part. A pin has its shank's end at z = 0, a shaft its driven end; all else lies
from z = 0 upwards.
"""

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np

from ilmek.elements.bearing_table import RollingBearing
from ilmek.elements.linear_guides import LinearGuide
from ilmek.elements.materials import MATERIALS, find_material
from ilmek.elements.parallel_keys import KeyedEnd
from ilmek.elements.retaining_rings import RetainingRing
from ilmek.linkage.model import GROUND
from ilmek.machines.link_tree import JOURNAL, PIN_STEEL, body_id
from ilmek.machines.own_linkage.axes import PinAxis
from ilmek.machines.own_linkage.construction import (
    Construction,
    bore_radius,
    rail_ends,
    tool_holes,
)
from ilmek.machines.own_linkage.forms import Layer
from ilmek.machines.own_linkage.layers import RingSide
from ilmek.machines.own_linkage.shafts import (
    ShaftLengths,
    housing_length,
    key_direction,
    shaft_lengths,
    shaft_members,
    shaft_seat,
    shoulder,
)
from ilmek.machines.own_linkage.sizes import StudSize, bush_wall
from ilmek.part import catalogue, guides
from ilmek.part.part import Part, Seat
from ilmek.part.placement import placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.ring_parts import retaining_ring
from ilmek.part.shapes import Placed, Prism, Shape, Sum, Turned, rectangle, stepped, tube
from ilmek.plane.contours import circle, keyed_bore, polygon
from ilmek.report import Contour, Hole
from ilmek.units import mm

BRONZE, PINS, BASE = MATERIALS["tin bronze"], MATERIALS["induction-hardened steel"], MATERIALS["structural steel"]

LOOSE = 0.5 * mm
"""Bore of a spacer over its pin [m]: it does not guide."""

MARGIN, SCREW = 20 * mm, 9 * mm
"""Edge of the plate that stands about all that is on it, and its holes for screws M8: ISO 273, medium [m]."""


@dataclass(frozen=True, slots=True, eq=False)
class PartStock:
    """Parts by kind and sizes: each is made once, and numbered where its kind has several sizes."""

    machine: str
    parts: dict[tuple[object, ...], Part] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)

    def part(self, kind: str, sizes: tuple[object, ...], make: Callable[[str], Part]) -> Part:
        """The part of a kind with sizes; make  id -> part."""
        key = (kind, *(round(size, 9) if isinstance(size, float) else size for size in sizes))
        if key not in self.parts:
            self.counts[kind] = self.counts.get(kind, 0) + 1
            number = f"-{self.counts[kind]}" if self.counts[kind] > 1 else ""
            self.parts[key] = make(f"{self.machine}/{kind}{number}")
        return self.parts[key]

    def made(self, kind: str, process: str, shape: Shape, *sizes: object) -> Part:
        """A turned part; its material by its kind."""
        material = {"bush": BRONZE, "pin": PINS, "shaft": PIN_STEEL}.get(kind, BASE)
        seats = {JOURNAL: Seat(placement(), 0.0)} if kind in {"pin", "shaft"} else {}
        return self.part(kind, sizes, lambda name: Part(name, kind, process, shape, material, seats=seats))

    def bush(self, diameter: float, length: float) -> Part:
        """A bush for a pin of a diameter."""
        outer = diameter + 2 * bush_wall(diameter)
        return self.made("bush", "pin or bush", tube(outer, bush_wall(diameter), length), diameter, length)

    def spacer(self, outer: float, bore: float, length: float) -> Part:
        """A loose spacer."""
        return self.made("spacer", "pin or bush", tube(outer, (outer - bore) / 2, length), outer, bore, length)

    def ring(self, row: RetainingRing) -> Part:
        """A retaining ring, as it lies in its groove."""
        return self.part("ring", (row.shaft,), lambda name: retaining_ring(name, row))

    def bearing(self, row: RollingBearing) -> Part:
        """A rolling bearing."""
        return self.part("bearing", (row.name,), lambda name: catalogue.bearing(name, "bearing", row))

    def rail(self, row: LinearGuide, length: float) -> Part:
        """The rail of a guide."""
        return self.part("rail", (row.name, length), lambda name: guides.guide_rail(name, "rail", row, length))

    def carriage(self, row: LinearGuide) -> Part:
        """The carriage of a guide."""
        return self.part("carriage", (row.name,), lambda name: guides.guide_block(name, "carriage", row))

    def riser(self, row: LinearGuide, length: float, height: float) -> Part:
        """A plate between a carriage and its link."""
        shape = Prism(Profile(rectangle(length, row.block)), height)
        return self.made("riser", "machined link", shape, row.name, length, height)

    def pin(self, stud: StudSize, shank: float, collar: float, journal: float) -> Part:
        """A pin by the lengths of its shank, its collar and its journal up to the ring's groove."""
        ring, thick = stud.ring, stud.collar
        steps = [(stud.shank, shank), (thick, collar), (stud.journal, journal), *ring.steps]
        return self.made("pin", "pin or bush", stepped(*steps), stud.journal, stud.shank, shank, collar, journal)

    def shaft(self, stud: StudSize, lengths: ShaftLengths, key: KeyedEnd | None) -> Part:
        """A driven shaft with a ring above its link."""
        members = shaft_members(stud, lengths, key)
        shape = members[0].shape if len(members) == 1 else Sum(members)
        return self.made("shaft", "turned part", shape, stud.journal, *lengths)

    def housing(self, stud: StudSize) -> Part:
        """The housing of a driven shaft, with a seat for a bearing or a bush at either end."""
        seat, wide, outer = shaft_seat(stud)
        inner, length = seat - 2 * shoulder(stud), housing_length(stud)
        steps = (
            (0.0, seat),
            (wide, seat),
            (wide, inner),
            (length - wide, inner),
            (length - wide, seat),
            (length, seat),
        )
        edge = [complex(z, d / 2) for z, d in (*steps, (length, outer), (0.0, outer))]
        shape = Turned(Profile(polygon(np.array(edge))))
        return self.made("housing", "turned part", shape, stud.journal)


def link_plate_part(built: Construction, body: str) -> Part:
    """The plate of a moving body, bored for its pins and its tool; of one piece with its shaft where it has no bore."""
    holes = [(at, _bore(built, axis, body)) for axis, at in _seats(built, body) if bore_radius(built, axis, body)]
    points = built.machine.mechanism.body(body).points
    holes += [(points[name], circle(points[name], radius)) for name, radius in tool_holes(built, body).items()]
    layers = built.layers_of(body)
    plates = tuple(Placed(_plate(layer, holes), (placement(z=layer.low),)) for layer in layers)
    shafts = tuple(placed for axis in built.axes if axis.driven == body for placed in _own_shaft(built, axis))
    shape = plates[0].shape if len(plates) == 1 and not shafts else Sum((*plates, *shafts))
    shapes = built.machine.shapes.get(body)
    material = find_material(shapes[0].material if shapes else built.members[body].material)
    seats = {
        axis.name: Seat(placement(at.real, at.imag), 2 * bore_radius(built, axis, body))
        for axis, at in _seats(built, body)
    }
    name, process = body.replace("_", " "), "turned part" if shafts else "machined link"
    return Part(body_id(built.name, body), name, process, shape, material, seats=seats)


def _bore(built: Construction, axis: PinAxis, body: str) -> Contour:
    if axis.driven == body and built.key(axis) is not None:
        return keyed_hole(built, axis)
    return circle(axis.points[body], bore_radius(built, axis, body))


def _own_shaft(built: Construction, axis: PinAxis) -> Iterator[Placed]:
    """The shaft of a driven link that is of one piece with it, in the frame of its plate; none where it has a bore."""
    if built.side(axis) is RingSide.NONE:
        at, lengths = axis.points[axis.driven], shaft_lengths(built, axis)
        angle = cmath.phase(key_direction(built, axis))
        low = placement(at.real, at.imag, -lengths.stub - lengths.plain, about=(0.0, 0.0, 1.0), angle=angle)
        for placed in shaft_members(built.studs[axis.name], lengths, built.key(axis)):
            yield Placed(placed.shape, (low.after(placed.positions[0]),))


def _seats(built: Construction, body: str) -> list[tuple[PinAxis, complex]]:
    return [(axis, axis.points[body]) for axis in built.axes if body in axis.points]


def _plate(layer: Layer, holes: list[tuple[complex, Contour]]) -> Prism:
    own = [hole for at, hole in holes if layer.has(at)]
    middle = complex(layer.outlines[0].corners[0])
    return Prism(Profile(layer.contour, (*own, *([circle(middle, layer.bore)] if layer.bore else []))), layer.thickness)


def keyed_hole(built: Construction, axis: PinAxis) -> Contour:
    """The keyed bore of a driven link, in its frame."""
    key = built.key(axis)
    assert key is not None
    bore = keyed_bore(key.diameter / 2, key.keyway.width, key.keyway.in_hub)
    return Contour(axis.points[axis.driven] + key_direction(built, axis) * bore.points, bore.bulges)


def base_part(built: Construction) -> Part:
    """The plate that stands: about all pivots, housings and rails, with holes for screws at its corners."""
    holes, reach = [], []
    for axis in built.axes:
        if GROUND in axis.points:
            stud, at = built.studs[axis.name], axis.points[GROUND]
            radius = shaft_seat(stud)[2] / 2 if axis.driven else stud.shank / 2
            holes.append(Hole(at, radius, axis.name))
            reach += [at + max(radius, stud.ring.room / 2) * side for side in (1, -1, 1j, -1j)]
    for line in built.lines:
        if line.guide == GROUND:
            row = built.guides[line.name]
            reach += [end + row.block * side for end in rail_ends(line, row) for side in (0.5, -0.5, 0.5j, -0.5j)]
    corners = np.array(reach)
    low, high = (
        complex(
            *(side * math.ceil(max(side * along) / mm) * mm + side * MARGIN for along in (corners.real, corners.imag))
        )
        for side in (-1, 1)
    )  # whole millimetres
    size, middle = high - low, (low + high) / 2
    inset = rectangle(size.real - 1.2 * MARGIN, size.imag - 1.2 * MARGIN).points + middle
    screws = [Hole(complex(at), SCREW / 2) for at in inset]
    outline = polygon(rectangle(size.real, size.imag).points + middle)
    thick = built.thickness(GROUND)
    seats = {hole.label: Seat(placement(hole.at.real, hole.at.imag), 2 * hole.radius) for hole in holes}
    return Part(
        body_id(built.name, GROUND),
        "base plate",
        "machined link",
        Prism(drilled(outline, [*screws, *holes]), thick),
        BASE,
        seats=seats,
    )
