"""The parts of the compensator and its bodies: sprung bars on levers, rods, springs, beams.

Axes of a parity as in `geometry`: x to the outside, y up along the warps; z along the width, 0 in its middle. Bars and
rods turn in the saddles of their supports, on two rollers each. The saddles of the rods are welded beside their
cross-pieces, that of a bar on the other side of its lever, so that they pass each other; the rollers are beside them.
"""

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.materials import MATERIALS, Material
from ilmek.errors import ParameterError
from ilmek.machines.tension_compensator.members import BUSH_WALL, SADDLE, Members, part_id
from ilmek.machines.tension_compensator.params import STEEL, TensionCompensatorParams
from ilmek.machines.tension_compensator.synthesis import PLAY, SprungLever
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, square_tube, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle, polygon, rounded_hull, strip
from ilmek.records import record
from ilmek.report import Contour, Hole
from ilmek.report.scene import SceneMotion
from ilmek.units import format_quantity, in_mm, mm

BRONZE = MATERIALS["tin bronze"]

BEHIND = 5 * mm
"""The rods' beam before the axis of the rear rod [m]: it leaves room for that of the back rest; assumed."""

CUT = "laser-cut part"


@record
class BarSupports:
    """Where the bars and rods of a compensator are supported: at the levers along the width, by saddles of rollers."""

    params: TensionCompensatorParams
    sprung: SprungLever
    members: Members

    @property
    def stations(self) -> tuple[float, ...]:
        """Middles of equal parts of the width [m]."""
        number = self.params.levers
        step = self.params.cloth.width / number
        return tuple(step * (k + 0.5 - number / 2) for k in range(number))

    @property
    def springs_wide(self) -> float:
        """Length of the pin that carries the springs of a lever, as far beside it on both sides [m]."""
        beside = math.ceil(self.sprung.springs / 2) * self.sprung.pitch
        return self.params.lever_thickness + 2 * max(beside, 5 * PLAY)

    @property
    def spring_stations(self) -> tuple[float, ...]:
        """Positions of the springs along the width [m]: beside their lever, on both sides in turn."""
        pitch, thick = self.sprung.pitch, self.params.lever_thickness
        offsets = [(-1) ** k * (thick / 2 + pitch * (k // 2 + 0.5)) for k in range(self.sprung.springs)]
        return tuple(z + offset for z in self.stations for offset in offsets)

    @property
    def bar(self) -> complex:
        """Axis of the bar from the pivot at rest [m]."""
        return self.sprung.lever.bar_point

    @property
    def reach(self) -> complex:
        """Pin of the springs from the pivot at rest [m]."""
        return complex(self.sprung.lever.reach)

    @property
    def clear(self) -> float:
        """From a pivot to the face of its beam, of which the lever keeps clear as it turns [m]."""
        return self.members.lever / 2 + PLAY + self.members.beam.side / 2 * math.sin(abs(self.sprung.angle))

    @property
    def apart(self) -> float:
        """From the springs' anchor to the face of its beam [m]."""
        return 2 * self.members.pin

    @property
    def along(self) -> complex:
        """Direction of the springs at rest, from their anchor to the lever."""
        lever = self.sprung.lever
        strut = lever.pivot + lever.reach - complex(lever.anchor)
        return strut / abs(strut)

    @property
    def cross(self) -> ComplexArray:
        """Corners of the piece that carries the saddles of both rods [m]: inside of the bar at rest, flat on its beam.

        Its front is half as high as its rear: (1 + u) / 2 is nowhere below sqrt(u), the height of equal stress.
        """
        path, lever, strip, members = self.sprung.lever.path, self.sprung.lever, self.strip, self.members
        high, half = members.cross, path.half
        top = float(self.saddle(complex(-path.radius), -1)[1].real) + strip
        inside = min(top, lever.rest.real - path.radius - PLAY)
        flat = max(half - BEHIND - members.beam.side / 2, -half)
        corners = [top - 1j * (half + strip), top - 1j * (half - strip), inside - 1j * (half - strip)]
        corners += [inside + 1j * (half - strip), top + 1j * (half - strip), top + 1j * (half + strip)]
        corners += [inside - high + 1j * (half + strip), inside - high + 1j * flat]
        corners += [inside - max(high / 2, 2 * strip) - 1j * (half + strip)]
        return np.array([one for k, one in enumerate(corners) if abs(one - corners[k - 1]) > 1e-9])

    @property
    def low(self) -> float:
        """The most that the cross-pieces reach inside of the sheet, x [m]."""
        return float(self.cross.real.min())

    @property
    def strip(self) -> float:
        """Half of the width of a saddle [m]."""
        return 0.8 * self.members.roller.bore

    @property
    def beams(self) -> tuple[tuple[complex, complex], ...]:
        """Axes of the beams of levers, rods and springs [m], and the directions of their sides."""
        lever, half = self.sprung.lever, self.members.beam.side / 2
        rods = complex(self.low - half, lever.path.half - BEHIND)
        springs = complex(lever.anchor) - (self.apart + half) * self.along
        beside = max(lever.pivot.real, half + 3 * PLAY)  # a wide beam reaches to the sheet of the warps
        levers = complex(beside, lever.pivot.imag - self.clear - half)
        return (levers, 1 + 0j), (rods, 1 + 0j), (springs, self.along)

    def saddle(self, axis: complex, towards: complex) -> ComplexArray:
        """Centres of a roller, of the saddle's corner and of the other roller, behind a bar in a direction [m]."""
        out, radius, roller = towards / abs(towards), self.sprung.lever.path.radius, self.members.roller
        apart = radius + roller.outer / 2
        corner = radius + 1.25 * roller.outer
        turned = cmath.exp(1j * SADDLE)
        return axis + out * np.array([apart * turned, corner, apart / turned])


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
    spring: Part
    eye: Part
    beam: Part
    pivot_lug: Part
    anchor_lug: Part
    cross_piece: Part


def parts_of(params: TensionCompensatorParams, sprung: SprungLever, members: Members) -> CompensatorParts:
    """The parts for a synthesised lever and the members that were chosen."""
    supports = BarSupports(params, sprung, members)
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
        saddle=_made("saddle", "saddle of a bar", CUT, _saddle(supports)),
        roller=catalogue.bearing(part_id("roller"), "roller of bars and rods", roller),
        roller_pin=_made("roller-pin", "pin of a roller", turned, pins),
        spring_pin=_made("spring-pin", "pin of the springs", turned, bar(pin, supports.springs_wide)),
        spring=_spring(supports),
        eye=replace(
            _made("eye", "eye of a spring", flat, _eye(supports)),
            fixing="its spring pulls it onto its pin",
        ),
        beam=_made("beam", "beam of the compensator", "welded frame", _beam(params, members)),
        pivot_lug=_made("pivot-lug", "lug of a pivot", CUT, _lug(supports, supports.clear)),
        anchor_lug=_made("anchor-lug", "lug of the springs", CUT, _lug(supports, supports.apart)),
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
            Occurrence(parts.spring_pin, _places([at.reach], at.stations, -at.springs_wide / 2)),
            *_eyes(parts, at.reach, -at.along),
        ),
        joint=Joint(JointKind.PIN, motion=motion, passive="its springs hold it against the warps"),
        positions=(_along(at.sprung.lever.pivot),),
    )


def standing(parts: CompensatorParts, name: str, position: Placement = IDENTITY) -> RigidBody:
    """What stands of a parity: beams with the levers' pins, the rods with the rollers that carry them, the springs.

    A spring is as long as in the open shed: the lever comes so near to it.
    """
    at, thick = parts.supports, parts.supports.params.lever_thickness
    lever, path, members = at.sprung.lever, at.sprung.lever.path, at.members
    rods = [complex(-path.radius, side * path.half) for side in (1, -1)]
    anchor, middle = complex(lever.anchor), -thick / 2
    upwards = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    leaning = placement(about=(0.0, 0.0, 1.0), angle=cmath.phase(at.along) - math.pi / 2).after(upwards)
    springs = at.spring_stations
    lugs = [pin + aside for pin in at.stations for aside in (-members.pin - thick, members.pin)]
    own = Occurrence(
        parts.beam,
        tuple(seat for axis, side in at.beams for seat in _places([axis], [-at.params.cloth.width / 2], turned=side)),
    )
    return RigidBody(
        part_id(f"{name} stand"),
        (
            own,
            Occurrence(parts.pin, _places([lever.pivot], at.stations, -members.pin - thick)),
            Occurrence(parts.pivot_lug, _places([lever.pivot], lugs, turned=1j)),
            Occurrence(parts.rod, _places(rods, [-at.params.cloth.width / 2])),
            Occurrence(parts.saddle, _places(rods, at.stations, thick / 2, turned=-1)),
            Occurrence(parts.cross_piece, _places([0j], at.stations, middle)),
            *_rollers(parts, rods, -1, 1),
            Occurrence(parts.anchor_lug, _places([anchor], at.stations, middle, turned=at.along)),
            Occurrence(parts.spring, tuple(_along(anchor, z).after(leaning) for z in springs)),
            *_eyes(parts, anchor, at.along),
            Occurrence(parts.spring_pin, _places([anchor], at.stations, -at.springs_wide / 2)),
        ),
        positions=(position,),
    )


def _eyes(parts: CompensatorParts, pin: complex, towards: complex) -> tuple[Occurrence, ...]:
    """The eyes of the springs, which swing on their pins at a point, in a direction; none where no spring is enough."""
    at = parts.supports
    places = _places([pin], at.spring_stations, turned=towards)
    return () if at.sprung.spring is None else (Occurrence(parts.eye, places, turning=True),)


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


def _flat(height: float, thick: float) -> str:
    return f"{format_quantity(height / mm, '')} x {in_mm(thick)}"


def _along(point: complex, z: float = 0.0) -> Placement:
    return placement(point.real, point.imag, z)


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
    holes = [Hole(0j, at.members.pin / 2 + BUSH_WALL, "bush"), Hole(at.reach, at.members.pin / 2, "springs")]
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


def _lug(at: BarSupports, far: float) -> Prism:
    """A plate with the bore of a pin at its origin, from the face of a beam at x = -far [m]."""
    pin = at.members.pin
    corners = np.array([-far - 1j * pin, pin - 1j * pin, pin + 1j * pin, -far + 1j * pin])
    return Prism(Profile(polygon(corners), (circle(0j, pin / 2),)), at.params.lever_thickness)


def _cross(at: BarSupports) -> Prism:
    """The piece that carries the saddles of both rods, on their beam."""
    return Prism(Profile(polygon(at.cross)), at.params.lever_thickness)


def _spring_seat(at: BarSupports) -> float:
    """From a pin of a spring to its end [m]: its eye reaches there."""
    wound, pin, sprung = at.sprung.spring, at.members.pin, at.sprung
    if wound is None:
        return pin
    at_rest = float(sprung.lever.spring_length(0.0))
    return max((at_rest - wound.free_length + sprung.preload / sprung.rate) / 2, 0.75 * pin)


def _eye_wide(sprung: SprungLever) -> float:
    return max(sprung.pitch - 2 * PLAY, PLAY)


def _eye(at: BarSupports) -> Sum:
    """A block on a pin along z, from behind it to the end of its spring at x, with the bore of the pin."""
    pin, wide, far = at.members.pin, _eye_wide(at.sprung), _spring_seat(at)
    high = 0.5j * max(wide, 2 * pin)
    corners = np.array([-pin - high, far - high, far + high, -pin + high])
    block = Prism(Profile(polygon(corners), (circle(0j, pin / 2),)), wide)
    return Sum((Placed(block, (placement(z=-wide / 2),)),))


def _spring(at: BarSupports) -> Part:
    """The spring: its room is that of the coil in the open shed, on the eye at its anchor, about z."""
    sprung, title = at.sprung, "spring of the compensator"
    wound = sprung.spring
    if wound is None:
        return Part(part_id("spring"), title, "spring", purchase=Bought("none of the table is enough"))
    size = f"{wound.wire} {wound.wire_diameter / mm:g} mm, {format_quantity(sprung.rate, 'N/mm', 3)}"
    shape = (wound.diameter / mm, wound.free_length / mm, wound.coils + 2)
    data = f"{size}, mean coil {shape[0]:.3g} mm, free length {shape[1]:.3g} mm, {shape[2]:.3g} coils, ends ground"
    seat = _spring_seat(at)
    dips = PLAY + max(_eye_wide(sprung), 2 * at.members.pin) / 2 * math.sin(abs(sprung.angle))
    length = max(float(sprung.lever.spring_length(sprung.angle)) - 2 * seat - dips, wound.wire_diameter)
    coil = tube(wound.diameter + wound.wire_diameter, wound.wire_diameter, length)
    room = Sum((Placed(coil, (placement(z=seat),)),))
    bought = Bought(size, wound.mass, data=data)
    return Part(part_id("spring"), title, "spring", room, purchase=bought, envelope=True, size=size)
