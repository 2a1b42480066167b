"""The parts of the compensator and its bodies: sprung bars on levers, rods, springs, beams.

Axes of a parity as in `geometry`: x to the outside, y up along the warps; z along the width, 0 in its middle. Bars and
rods turn in the saddles of their supports, on two rollers each. The saddle of a bar is welded beside the end of its
lever, its rollers beside the saddle.
"""

import cmath
import math
from collections.abc import Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.materials import MATERIALS, Material
from ilmek.errors import ParameterError
from ilmek.machines.tension_compensator.members import BUSH_WALL, SADDLE, Members, part_id
from ilmek.machines.tension_compensator.params import STEEL, TensionCompensatorParams
from ilmek.machines.tension_compensator.synthesis import SprungLever
from ilmek.part.part import Bought, Part
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.profile import drilled
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, square_tube, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import rounded_hull, strip
from ilmek.records import record
from ilmek.report import Contour, Hole
from ilmek.report.scene import SceneMotion
from ilmek.units import format_quantity, mm

BRONZE = MATERIALS["tin bronze"]

PLAY = 1 * mm
"""Play of rollers and springs to what is beside them along their axis [m]; assumed by this project."""


@record
class BarSupports:
    """Where the bars and rods of a compensator are supported: at the levers along the width, by saddles of rollers."""

    params: TensionCompensatorParams
    sprung: SprungLever
    members: Members

    @property
    def stations(self) -> tuple[float, ...]:
        """Middles of equal parts of the width [m]."""
        width, number = self.params.cloth.width, self.params.levers
        return tuple(width * ((k + 0.5) / number - 0.5) for k in range(number))

    @property
    def bar(self) -> complex:
        """Axis of the bar from the pivot at rest [m]."""
        return self.sprung.lever.bar_point

    @property
    def reach(self) -> complex:
        """Pin of the springs from the pivot at rest [m]."""
        return complex(self.sprung.lever.reach)

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
    beam: Part


def parts_of(params: TensionCompensatorParams, sprung: SprungLever, members: Members) -> CompensatorParts:
    """The parts for a synthesised lever and the members that were chosen."""
    supports = BarSupports(params, sprung, members)
    thick, pin, roller, section = params.lever_thickness, members.pin, members.roller, members.tube
    flat, turned = "machined link", "pin or bush"
    pins = bar(roller.bore, thick + PLAY + roller.width)
    cylinder = tube(section.outer, section.wall, params.cloth.width)
    return CompensatorParts(
        supports,
        bar=_made("bar", "bar of the compensator", "steel tube", cylinder, f"tube {section.name} mm"),
        rod=_made("rod", "rod of the compensator", "steel tube", cylinder, f"tube {section.name} mm"),
        lever=_made("lever", "lever of the compensator", flat, _lever(supports), _flat(members.lever, thick)),
        bush=_made("bush", "bush of a lever", turned, _bush(pin), _round(pin + 2 * BUSH_WALL), BRONZE),
        pin=_made("pin", "pin of a lever", turned, bar(pin, 2 * pin + 2 * thick), _round(pin)),
        saddle=_made("saddle", "saddle of a bar", "laser-cut part", _saddle(supports), f"plate {_mm(thick)}"),
        roller=Part(
            part_id("roller"),
            "roller of bars and rods",
            "bearing",
            roller.name,
            tube(roller.outer, (roller.outer - roller.bore) / 2, roller.width),
            purchase=Bought(roller.name, roller.mass),
            envelope=True,
        ),
        roller_pin=_made("roller-pin", "pin of a roller", turned, pins, _round(roller.bore)),
        spring_pin=_made("spring-pin", "pin of the springs", turned, bar(pin, _springs_wide(sprung)), _round(pin)),
        spring=_spring(params, sprung),
        beam=_made("beam", "beam of the compensator", "welded frame", _beam(params, members), members.beam.name),
    )


def sprung_bar(
    parts: CompensatorParts, name: str, motion: SceneMotion | None, position: Placement = IDENTITY
) -> RigidBody:
    """What turns about the levers' pivots: a bar with its levers, saddles and rollers.

    position  of the parity's axes in those of the compensator      motion  of the lever; None: it stands at rest
    """
    at, thick = parts.supports, parts.supports.params.lever_thickness
    saddle = at.saddle(at.bar, -at.bar)
    wide = _springs_wide(at.sprung)
    return RigidBody(
        part_id(f"{name} bar"),
        (
            Occurrence(parts.bar, _places([at.bar], [-at.params.cloth.width / 2])),
            Occurrence(parts.lever, _places([0j], at.stations, -thick / 2)),
            Occurrence(parts.bush, _places([0j], at.stations, -at.members.pin)),
            Occurrence(parts.saddle, _places([at.bar], at.stations, thick / 2, turned=-at.bar)),
            *_rollers(parts, saddle, 1.5 * thick),
            Occurrence(parts.spring_pin, _places([at.reach], at.stations, -wide / 2)),
        ),
        joint=Joint(JointKind.PIN, motion=motion),
        positions=(position.after(_along(at.sprung.lever.pivot)),),
    )


def standing(parts: CompensatorParts, name: str, position: Placement = IDENTITY) -> tuple[RigidBody, ...]:
    """The rods of a parity, the rollers that carry them, its beam with the levers' pins, and its springs.

    Nothing carries the rods' saddles, the beam and the springs' anchors yet: these joints are missing.
    """
    at, thick = parts.supports, parts.supports.params.lever_thickness
    lever, path, members = at.sprung.lever, at.sprung.lever.path, at.members
    rods = [complex(-path.radius, side * path.half) for side in (1, -1)]
    beam = lever.pivot - 1j * (members.lever / 2 + members.beam.side / 2 + PLAY)
    springs = _spring_stations(at)
    along = lever.pivot + lever.reach - complex(lever.anchor)
    upwards = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    leaning = placement(about=(0.0, 0.0, 1.0), angle=cmath.phase(along) - math.pi / 2).after(upwards)
    missing = Joint(JointKind.MISSING)
    return (
        RigidBody(
            part_id(f"{name} beam"),
            (
                Occurrence(parts.beam, _places([beam], [-at.params.cloth.width / 2])),
                Occurrence(parts.pin, _places([lever.pivot], at.stations, -members.pin - thick)),
            ),
            joint=missing,
            positions=(position,),
        ),
        RigidBody(
            part_id(f"{name} rods"),
            (
                Occurrence(parts.rod, _places(rods, [-at.params.cloth.width / 2])),
                Occurrence(parts.saddle, _places(rods, at.stations, thick / 2, turned=-1)),
                *_rollers(parts, np.concatenate([at.saddle(rod, -1) for rod in rods]), 1.5 * thick),
            ),
            joint=missing,
            positions=(position,),
        ),
        RigidBody(
            part_id(f"{name} springs"),
            (
                Occurrence(parts.spring, tuple(_along(complex(lever.anchor), z).after(leaning) for z in springs)),
                Occurrence(
                    parts.spring_pin, _places([complex(lever.anchor)], at.stations, -_springs_wide(at.sprung) / 2)
                ),
            ),
            joint=missing,
            positions=(position,),
        ),
    )


def _rollers(parts: CompensatorParts, saddles: ComplexArray, beside: float) -> tuple[Occurrence, ...]:
    """The rollers of saddles on their pins, from `beside` the levers' middle planes [m] on."""
    at = parts.supports
    axes = [complex(axis) for saddle in saddles.reshape(-1, 3) for axis in saddle[::2]]
    return (
        Occurrence(parts.roller, _places(axes, at.stations, beside + PLAY)),
        Occurrence(parts.roller_pin, _places(axes, at.stations, beside - at.params.lever_thickness)),
    )


def _made(  # noqa: PLR0917
    name: str, title: str, process: str, shape: Shape, size: str, material: Material = STEEL
) -> Part:
    return Part(part_id(name), title, process, size, shape, material)


def _mm(length: float) -> str:
    return format_quantity(length, "mm")


def _flat(height: float, thick: float) -> str:
    return f"{format_quantity(height / mm, '')} x {_mm(thick)}"


def _round(diameter: float) -> str:
    return f"round {_mm(diameter)}"


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
    return Prism(drilled(_outline(nodes, 0.8 * bore), holes), at.params.lever_thickness)


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


def _spring(params: TensionCompensatorParams, sprung: SprungLever) -> Part:
    """The spring: its room is that of the coil at rest, between the seats at its pins, about z."""
    wound, title = sprung.spring, "spring of the compensator"
    if wound is None:
        return Part(part_id("spring"), title, "spring", purchase=Bought("none of the table is enough"))
    size = f"{params.wire} {wound.wire_diameter / mm:g} mm, {format_quantity(sprung.rate, 'N/mm', 3)}"
    length = wound.free_length - sprung.preload / sprung.rate
    coil = tube(wound.diameter + wound.wire_diameter, wound.wire_diameter, length)
    seat = (float(sprung.lever.spring_length(0.0)) - length) / 2
    room = Sum((Placed(coil, (placement(z=seat),)),))
    return Part(part_id("spring"), title, "spring", size, room, purchase=Bought(size, wound.mass), envelope=True)


def _spring_pitch(sprung: SprungLever) -> float:
    wound = sprung.spring
    return 0.0 if wound is None else wound.diameter + wound.wire_diameter + PLAY


def _springs_wide(sprung: SprungLever) -> float:
    """Length of the pin that carries the springs of a lever, as far beside it on both sides [m]."""
    return 2 * max((abs(offset) for offset in _beside(sprung, 0.0)), default=0.0) + max(
        _spring_pitch(sprung), 10 * PLAY
    )


def _spring_stations(at: BarSupports) -> list[float]:
    """Positions of the springs along the width [m]: beside their lever, on both sides in turn."""
    return [z + offset for z in at.stations for offset in _beside(at.sprung, at.params.lever_thickness)]


def _beside(sprung: SprungLever, thick: float) -> list[float]:
    """Offsets of the springs from the middle of a lever of a thickness [m]."""
    pitch = _spring_pitch(sprung)
    return [(-1) ** k * (thick / 2 + pitch * (k // 2 + 0.5)) for k in range(sprung.springs)]
