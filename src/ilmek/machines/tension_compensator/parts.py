"""The parts of the compensator and its bodies: sprung bars on levers, rods, springs, beams.

Axes of a parity as in `geometry`: x to the outside, y up along the warps; z along the width, 0 in its middle. Bars and
rods turn in the saddles of their supports, on two rollers each. The saddles of the rods are welded beside their
cross-pieces, that of a bar on the other side of its lever, so that they pass each other; the rollers are beside them.
"""

import cmath
from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.materials import MATERIALS, Material
from ilmek.errors import ParameterError
from ilmek.machines.tension_compensator.members import BUSH_WALL, TOUGH, Members, part_id
from ilmek.machines.tension_compensator.params import STEEL, TensionCompensatorParams
from ilmek.machines.tension_compensator.struts import StrutParts, strut_parts
from ilmek.machines.tension_compensator.supports import BarSupports
from ilmek.machines.tension_compensator.synthesis import PLAY, SprungLever
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.ring_parts import retaining_ring
from ilmek.part.shapes import Prism, Shape, bar, square_tube, stepped, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle, polygon, rounded_hull, strip
from ilmek.records import record
from ilmek.report import Contour, Hole
from ilmek.report.scene import SceneMotion

BRONZE = MATERIALS["tin bronze"]

CUT = "laser-cut part"


@record
class CompensatorParts:
    """The parts of a compensator, each once."""

    supports: BarSupports
    bar: Part
    rod: Part
    lever: Part
    bush: Part
    pin: Part
    saddle: Part
    roller: Part
    roller_pin: Part
    spring_pin: Part
    spring_ring: Part
    struts: StrutParts
    beam: Part
    pivot_lug: Part
    anchor_lug: Part
    cross_piece: Part


def parts_of(params: TensionCompensatorParams, sprung: SprungLever, members: Members) -> CompensatorParts:
    """The parts for a synthesised lever and the members that were chosen."""
    supports = BarSupports(params, sprung, members)
    ring = supports.spring_ring
    thick, pin, roller, section = params.lever_thickness, members.pin, members.roller, members.tube
    flat, turned = "machined link", "pin or bush"
    pins = bar(roller.bore, thick + PLAY + roller.width)
    cylinder = tube(section.outer, section.wall, params.cloth.width)
    return CompensatorParts(
        supports,
        bar=_made("bar", "bar of the compensator", "steel tube", cylinder),
        rod=_made("rod", "rod of the compensator", "steel tube", cylinder),
        lever=_made("lever", "lever of the compensator", flat, _lever(supports)),
        bush=_made("bush", "bush of a lever", turned, _bush(pin), BRONZE),
        pin=_made("pin", "pin of a lever", turned, bar(pin, 2 * pin + 2 * thick)),
        saddle=replace(
            _made("saddle", "saddle of a bar", CUT, _saddle(supports)),
            joins=(part_id("lever"), part_id("cross-piece")),
            throat=members.throat,
        ),
        roller=catalogue.bearing(part_id("roller"), "roller of bars and rods", roller),
        roller_pin=_made("roller-pin", "pin of a roller", turned, pins),
        spring_pin=_made(
            "spring-pin",
            "pin of the springs",
            turned,
            stepped(*reversed(ring.steps), (members.spring_pin, supports.springs_wide), *ring.steps),
            TOUGH,
        ),
        spring_ring=retaining_ring(part_id("spring-ring"), ring),
        struts=strut_parts(supports),
        beam=_made("beam", "beam of the compensator", "welded frame", _beam(params, members)),
        pivot_lug=_made("pivot-lug", "lug of a pivot", CUT, _lug(pin, supports.clear, thick)),
        anchor_lug=_made("anchor-lug", "lug of the springs", CUT, _lug(members.spring_pin, supports.apart, thick)),
        cross_piece=_made("cross-piece", "cross-piece of the rods", CUT, _cross(supports)),
    )


def sprung_bar(parts: CompensatorParts, name: str, motion: SceneMotion | None) -> RigidBody:
    """What turns about the levers' pivots on what stands: a bar with its levers, saddles and rollers.

    motion  of the lever; None: it stands at rest
    """
    at, thick = parts.supports, parts.supports.params.lever_thickness
    return RigidBody(
        part_id(f"{name} bar"),
        (
            Occurrence(parts.bar, _places([at.bar], [-at.params.cloth.width / 2])),
            Occurrence(parts.lever, _places([0j], at.stations, -thick / 2)),
            Occurrence(parts.bush, _places([0j], at.stations, -at.members.pin)),
            Occurrence(parts.saddle, _places([at.bar], at.stations, -1.5 * thick, turned=-at.bar)),
            *_rollers(parts, [at.bar], -at.bar, -1),
            *_sprung_pins(parts, at.reach),
        ),
        joint=Joint(JointKind.PIN, motion=motion, passive="its springs hold it against the warps"),
        positions=(_along(at.sprung.lever.pivot),),
    )


def standing(parts: CompensatorParts, name: str, position: Placement = IDENTITY) -> RigidBody:
    """What stands of a parity and is welded: beams, lugs of the pins, cross-pieces with the saddles of the rods."""
    at, thick = parts.supports, parts.supports.params.lever_thickness
    lever, pin, middle = at.sprung.lever, at.members.pin, -thick / 2
    lugs = [station + aside for station in at.stations for aside in (-pin - thick, pin)]
    seats = (_places([axis], [-at.params.cloth.width / 2], turned=side) for axis, side in at.beams)
    return RigidBody(
        stand_id(name),
        (
            Occurrence(parts.beam, tuple(chain(*seats))),
            Occurrence(parts.pivot_lug, _places([lever.pivot], lugs, turned=1j)),
            Occurrence(parts.saddle, _places(_rods(at), at.stations, thick / 2, turned=-1)),
            Occurrence(parts.cross_piece, _places([0j], at.stations, middle)),
            Occurrence(parts.anchor_lug, _places([complex(lever.anchor)], at.stations, middle, turned=at.along)),
        ),
        positions=(position,),
    )


def stand_id(name: str) -> str:
    """Id of the welded body of a parity."""
    return part_id(f"{name} stand")


def fitted(parts: CompensatorParts, name: str) -> RigidBody:
    """What is put into the stand of a parity: pins of levers and springs, rods with the rollers that carry them."""
    at, lever = parts.supports, parts.supports.sprung.lever
    far = -at.members.pin - at.params.lever_thickness
    return RigidBody(
        part_id(f"{name} rods"),
        (
            Occurrence(parts.pin, _places([lever.pivot], at.stations, far)),
            Occurrence(parts.rod, _places(_rods(at), [-at.params.cloth.width / 2])),
            *_rollers(parts, _rods(at), -1, 1),
            *_sprung_pins(parts, complex(lever.anchor)),
        ),
        parent=stand_id(name),
    )


def _rods(at: BarSupports) -> list[complex]:
    """Axes of the rods [m]."""
    path = at.sprung.lever.path
    return [complex(-path.radius, side * path.half) for side in (1, -1)]


def _rollers(
    parts: CompensatorParts, axes: Sequence[complex], towards: complex, side: int
) -> tuple[Occurrence, Occurrence]:
    """The rollers of the saddles behind some axes, on their pins beside the saddles.

    towards  from the axes to the saddles' corners      side  of the levers' middle planes, +1 or -1
    """
    at, thick, wide = parts.supports, parts.supports.params.lever_thickness, parts.supports.members.roller.width
    far = 1.5 * thick + PLAY + wide
    rollers, pins = (far - wide, thick / 2) if side > 0 else (-far, -far)
    pairs = [(axis, complex(node)) for axis in axes for node in at.saddle(axis, towards)[::2]]
    # A corner of a roller's mesh points to what it carries.
    turned = (_places([node], at.stations, rollers, turned=axis - node) for axis, node in pairs)
    return (
        Occurrence(parts.roller, tuple(chain(*turned))),
        Occurrence(parts.roller_pin, _places([node for _, node in pairs], at.stations, pins)),
    )


def _made(name: str, title: str, process: str, shape: Shape, material: Material = STEEL) -> Part:
    """A part; plates are bored for pins after they are cut."""
    return Part(part_id(name), title, process, shape, material, machined=process == CUT)


def _along(point: complex, z: float = 0.0) -> Placement:
    return placement(point.real, point.imag, z)


def _sprung_pins(parts: CompensatorParts, axis: complex) -> tuple[Occurrence, Occurrence]:
    """The pins of the springs about an axis, with a ring in the groove at each end."""
    at, ring = parts.supports, parts.supports.spring_ring
    half = at.springs_wide / 2
    shifts = (half, -half - ring.thickness)
    rings = tuple(position for shift in shifts for position in _places([axis], at.stations, shift))
    pins = _places([axis], at.stations, -half - ring.slot - ring.end)
    return Occurrence(parts.spring_pin, pins), Occurrence(parts.spring_ring, rings)


def _places(
    points: Sequence[complex], stations: Sequence[float], shift: float = 0.0, *, turned: complex = 1
) -> tuple[Placement, ...]:
    """Each point at each station along the width, further by a shift [m], turned to a direction."""
    angle = cmath.phase(turned)
    return tuple(
        placement(point.real, point.imag, z + shift, about=(0.0, 0.0, 1.0), angle=angle)
        for point in points
        for z in stations
    )


def _lever(at: BarSupports) -> Prism:
    """From the saddle's corner by the pivot to the springs."""
    corner = complex(at.saddle(at.bar, -at.bar)[1])
    holes = [Hole(0j, at.members.pin / 2 + BUSH_WALL, "bush"), Hole(at.reach, at.members.spring_pin / 2, "springs")]
    if abs(at.reach) < sum(hole.radius for hole in holes) + BUSH_WALL:
        holes = holes[:1]
    return Prism(
        drilled(_outline(np.array([corner, 0j, at.reach]), at.members.lever / 2), holes), at.params.lever_thickness
    )


def _saddle(at: BarSupports) -> Prism:
    """A V from roller to roller, behind a bar in its origin in the direction x."""
    nodes, bore = at.saddle(0j, 1), at.members.roller.bore
    holes = [Hole(complex(axis), bore / 2, "roller") for axis in nodes[::2]]
    return Prism(drilled(_outline(nodes, at.strip), holes), at.params.lever_thickness)


def _outline(nodes: ComplexArray, radius: float) -> Contour:
    """The strip along some nodes, or their hull where the pieces are too short for it."""
    try:
        return strip(nodes, radius)
    except ParameterError:
        return rounded_hull(nodes, radius)


def _bush(pin: float) -> Shape:
    return tube(pin + 2 * BUSH_WALL, BUSH_WALL, 2 * pin)


def _beam(params: TensionCompensatorParams, members: Members) -> Shape:
    return square_tube(members.beam.side, members.beam.wall, params.cloth.width)


def _lug(pin: float, far: float, thick: float) -> Prism:
    """A plate with the bore of a pin at its origin, from the face of a beam at x = -far [m]."""
    corners = np.array([-far - 1j * pin, pin - 1j * pin, pin + 1j * pin, -far + 1j * pin])
    return Prism(Profile(polygon(corners), (circle(0j, pin / 2),)), thick)


def _cross(at: BarSupports) -> Prism:
    """The piece that carries the saddles of both rods, on their beam."""
    return Prism(Profile(polygon(at.cross)), at.params.lever_thickness)
