"""The rapier as bodies: tube with gripper and clamp, the belt axis under it, the devices that serve the cloth's edges.

Axes as in `tree`. The axis stands beside the cloth, its drive upright below its far end. At each edge a plate before
the rapier's path carries what cuts, tucks in and offers the wefts, side by side, with the motors below.
"""

import math
from collections.abc import Iterator

from ilmek.elements.columns import HollowSquare
from ilmek.elements.materials import MATERIALS
from ilmek.elements.motors import STEPPER, smallest_motor
from ilmek.machines.shaft_stand import stock
from ilmek.machines.weft.axis import BeltAxis
from ilmek.machines.weft.carriers import (
    AXIS,
    CARRIAGE,
    GRIPPER,
    MOTOR,
    NEEDLE,
    WEFT_CUTTER,
    along,
    part_id,
    rapier_tube,
)
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.passage import WeftPassage
from ilmek.machines.weft.rapier import CLAMP, Rapier
from ilmek.part import catalogue
from ilmek.part.part import LASER_CUT, Bought, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, box, rectangle
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle
from ilmek.records import record
from ilmek.units import format_quantity, in_mm, mm

RAPIER_BODY, EDGE_MOTOR = part_id("rapier with its carriage"), part_id("edge-motor")
"""Ids of the body that moves, and of the motor of a device at an edge."""

Station = tuple[int, int]

CUTTER, SELECTOR, TUCKER = 0.3, 0.2, 0.5
"""Masses of a weft cutter, of the fingers of the selector and of a tuck-in needle [kg]; assumed by this project."""

AUXILIARY = 0.4
"""Torque of the motors of selector, cutter and tuck-in needles [N m]: the smallest stepper's."""

SIDE = 40 * mm
"""Side of the room for a linear axis, a carriage and a device at the edge [m]; assumed by this project."""

PITCH = 50 * mm
"""Distance of the devices of an edge along the width [m]."""

_WIDE = 3 * PITCH + SIDE
"""Width of an edge's plate [m]."""

PLATE, BEFORE_WAY = 6 * mm, 3 * mm
"""Thickness of an edge's plate and of the consoles on it, and its distance from the path of rapier and carriage [m];
assumed by this project.
"""

BOSS = 24 * mm
"""Bore of a console about the boss of its motor, of 22 mm [NEMA ICS 16], and the hub on its shaft [m]."""

POST_INSET = 0.15
"""From the far end of the axis to what carries it there, clear of its drive [m]: assumed by this project."""

_HEIGHT, _FOOT = 0.8, 0.6
"""Height of the axis over the floor where the machine is alone, and length of its feet [m]; assumed by this project."""

_STAND = HollowSquare(SIDE, 3 * mm)
"""Section of the stand of the machine alone: EN 10219-2."""

EDGE_PLATE = part_id("edge-plate")
"""Id of the plate at an edge."""


@record
class RapierSide:
    """Places of rapier, axis and devices."""

    params: WeftParams
    made: Rapier
    passage: WeftPassage
    axis: BeltAxis

    @property
    def edge(self) -> float:
        """Middle of the devices next to the cloth, from the middle of the width [m]."""
        return self.params.cloth.width / 2 + self.params.edge

    @property
    def rest(self) -> float:
        """Tip of the rapier at rest, from the middle of the width [m]; negative: left of the cloth."""
        return -self.params.cloth.width / 2 - self.passage.run

    @property
    def low(self) -> float:
        """Lower side of the axis [m]."""
        return -self.made.tube[0] / 2 - 2 * SIDE

    @property
    def run(self) -> tuple[float, float]:
        """Left and right end of the axis [m]."""
        left = self.rest - self.made.gripper - self.made.length
        return left, left + self.passage.move.distance + CLAMP

    @property
    def plate_back(self) -> float:
        """Back of the plates at the edges [m]: before the path of rapier and carriage."""
        return max(self.made.depth, SIDE) / 2 + BEFORE_WAY

    def bodies(self) -> Iterator[RigidBody]:
        """The rapier from the left, its tip at rest before the cloth, clamped at its far end; axis and devices."""
        params, made = self.params, self.made
        far = -made.gripper - made.length
        gripper = box(max(made.gripper, made.tube[0]), max(made.gripper, made.tube[1]), made.gripper)
        tall, wide, wall = map(in_mm, made.tube)
        tube = f"{tall} x {wide} x {wall}"
        weighed = Bought("gripper", params.gripper_mass), Bought("carriage", params.carriage_mass)
        jaws = bought_part(
            GRIPPER, "gripper of the rapier", "tool", gripper, weighed[0],
            size=f"two jaws, stub for the bore of a tube {tube}",
            fixing="its stub is bonded in the end of the rapier",
        )  # fmt: skip
        held = box(SIDE, SIDE, CLAMP)
        clamp = bought_part(
            CARRIAGE, "carriage of the rapier", "tool", held, weighed[1],
            size=f"{in_mm(SIDE)} wide, on the carriage of its axis, clamp for a tube {tube}",
            fixing="its clamp grips the end of the rapier with its own screws",
        )  # fmt: skip
        parts = (
            Occurrence(rapier_tube(params, made.tube, made.length), (along(far),)),
            Occurrence(jaws, (along(-made.gripper),)),
            Occurrence(clamp, (placement(0.0, self.low + 1.5 * SIDE).after(along(far)),)),
        )
        slide = Joint(JointKind.SLIDE, (1.0, 0.0, 0.0), motor=MOTOR)
        yield RigidBody(RAPIER_BODY, parts, joint=slide, positions=(placement(self.rest),))
        yield RigidBody(part_id("belt axis"), tuple(self._axis()))
        yield from self._devices()
        yield RigidBody(part_id("devices at the edges"), (*self._standing(), *self._plates()))

    def stand(self) -> RigidBody:
        """What carries the machine alone, where a loom's frame does else: beams on posts, on a rail with two feet.

        The axis lies on the left beam; the plates of the edges are on the fronts of both.
        """
        z, inner, outer = self.plate_back - SIDE / 2, self.edge - SIDE / 2, self.edge - SIDE / 2 + _WIDE
        far, floor, top = min(self.run[0] + POST_INSET, -outer), self.low - _HEIGHT, self.low - SIDE
        levels = (
            ("left-beam", "beam of the axis", far, -inner, top),
            ("right-beam", "beam of the plate at the right edge", inner, outer, top),
            ("rail", "rail at the floor", far, outer, floor + SIDE),
        )
        parts = [
            Occurrence(
                stock(part_id(f"stand-{key}"), f"{title} of the stand", _STAND, end - begin),
                (placement(begin, low + SIDE / 2, z).after(ALONG_WIDTH),),
            )
            for key, title, begin, end, low in levels
        ]
        post = stock(part_id("stand-post"), "post of the stand", _STAND, top - floor - 2 * SIDE)
        ends = far + SIDE / 2, outer - SIDE / 2
        posts = tuple(_upright(x, floor + 2 * SIDE, z) for x in (ends[0], -inner - SIDE / 2, ends[1]))
        foot = stock(part_id("stand-foot"), "foot of the stand", _STAND, _FOOT)
        feet = tuple(placement(x, floor + SIDE / 2, z - _FOOT / 2) for x in ends)
        return RigidBody(part_id("stand"), (*parts, Occurrence(post, posts), Occurrence(foot, feet)))

    def _axis(self) -> Iterator[Occurrence]:
        """The belt axis, and its drive upright below its far end."""
        axis, carrier, (left, right) = self.axis, self.params.carrier, self.run
        wide = "wider than any of the table" if math.isnan(axis.width) else f"{format_quantity(axis.width, 'mm')} wide"
        size = f"belt {axis.belt.belt.name}, {wide}"
        data = f"{in_mm(SIDE)} wide, {size}, {catalogue.stroke_of(self.passage.stroke)}"
        room, bought = box(SIDE, SIDE, right - left), Bought("belt axis", length=self.passage.stroke, data=data)
        belt = bought_part(AXIS, f"axis of the {carrier}", "linear axis", room, bought, size=size)
        yield Occurrence(belt, (placement(0.0, self.low + SIDE / 2).after(along(left)),))
        row, low = axis.drive.motor if axis.drive else None, self.low
        drive = [catalogue.motor(MOTOR, f"motor of the {carrier}", row, axis.torque, axis.turning)]
        if axis.drive is not None and axis.drive.reducer.ratio != 1:
            drive.append(catalogue.reducer(part_id("reducer"), f"reducer of the {carrier}", axis.drive.reducer, row))
        end: tuple[Placement, ...] = (_upright(left + SIDE / 2, low),)  # its pulley's axis
        adapters, end = catalogue.adapted(part_id("adapter"), f"adapter of the {carrier}", drive[-1], SIDE, end)
        yield from adapters
        for geared in drive[1:]:
            end = (end[0].after(placement(z=-catalogue.length_of(geared))),)
            yield Occurrence(geared, end)
        yield Occurrence(drive[0], end)

    def _devices(self) -> Iterator[RigidBody]:
        """Cutters, tuck-in needles and selector before the plates, each moved by a motor below it."""
        size, within = box(SIDE, SIDE, SIDE), " x ".join(3 * (in_mm(SIDE),))
        hub = f"hub bore {in_mm(catalogue.motor_shaft(smallest_motor(AUXILIARY, 0.0, STEPPER)))}"

        def device(body: str, names: tuple[str, str, str], mass: float, joint: Joint, *stations: Station) -> RigidBody:
            name, title, text = names
            part = bought_part(
                name,
                title,
                "tool",
                size,
                Bought(title, mass),
                size=f"{text}, within {within}",
            )
            return RigidBody(part_id(body), (Occurrence(part),), joint=joint, positions=self._beside(*stations))

        shear = Joint(JointKind.PIN, motor=EDGE_MOTOR)
        along = Joint(JointKind.SLIDE, motor=EDGE_MOTOR)
        cutter, needle = (WEFT_CUTTER, "weft cutter"), (NEEDLE, "tuck-in needle")
        selector = part_id("selector"), "weft selector"
        yield device("turning cutters", (*cutter, hub), CUTTER, shear, (-1, 0), (1, 0))
        yield device("needles at the edges", (*needle, "on its slide"), TUCKER, along, (-1, 1), (1, 1))
        yield device("fingers of the selector", (*selector, f"two fingers, {hub}"), SELECTOR, shear, (1, 3))

    def _standing(self) -> Iterator[Occurrence]:
        """The axes of the needles, and the motors of all devices, each under its console."""
        row = smallest_motor(AUXILIARY, 0.0, STEPPER)
        motor = catalogue.motor(EDGE_MOTOR, "motor of selector, cutters and needles", row, AUXILIARY, 0.0)
        long = max(2 * self.params.turn, SIDE)
        data = f"slide {in_mm(SIDE)} wide, rack drive, {catalogue.stroke_of(2 * self.params.turn)}"
        room, bought = box(SIDE, SIDE, long), Bought("slide", length=2 * self.params.turn, data=data)
        name, title = part_id("needle-axis"), "axis of a tuck-in needle"
        slide = bought_part(name, title, "linear axis", room, bought, size="along the edge")
        yield Occurrence(slide, self._beside((-1, 2), (1, 2), high=SIDE / 2 - long))
        stations = ((-1, 0), (-1, 1), (1, 0), (1, 1), (1, 3))
        face, under = catalogue.face_of(motor), -SIDE / 2 - PLATE
        console = Prism(Profile(rectangle(face, face), (circle(0j, BOSS / 2),)), PLATE)
        steel = MATERIALS["structural steel"]
        name, title = part_id("edge-console"), "console of a motor at an edge"
        carrier = Part(name, title, LASER_CUT, console, steel, joins=(EDGE_PLATE,))
        yield Occurrence(carrier, self._beside(*stations, high=under, depth=face))
        yield Occurrence(motor, self._beside(*stations, high=under, depth=face))

    def _beside(self, *stations: Station, high: float = -SIDE / 2, depth: float = SIDE) -> tuple[Placement, ...]:
        """Before the plates at an edge, -1 left, 1 right, as the device of a number from the cloth on."""
        z = self.plate_back + PLATE + depth / 2
        return tuple(_upright(side * (self.edge + number * PITCH), high, z) for side, number in stations)

    def _plates(self) -> Iterator[Occurrence]:
        """The plates, from below the axis to the devices."""
        low, high = self.low - SIDE, SIDE / 2
        title = "plate of the devices at an edge"
        shape = box(_WIDE, high - low, PLATE)
        steel = MATERIALS["structural steel"]
        part = Part(EDGE_PLATE, title, LASER_CUT, shape, steel, machined=True)
        x = self.edge - SIDE / 2 + _WIDE / 2
        yield Occurrence(part, tuple(placement(side * x, (low + high) / 2, self.plate_back) for side in (-1, 1)))


def _upright(x: float, y: float, z: float = 0.0) -> Placement:
    """At a place, z up."""
    return placement(x, y, z).after(UPRIGHT)
