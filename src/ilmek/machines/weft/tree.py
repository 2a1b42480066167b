"""The weft side as bodies: the carrier with its carriage, the axis that moves it, boxes or what serves a rapier.

Axes: x along the width to the weaver's right, 0 in the middle of the cloth; y up along the warps and z to the front,
both 0 at the axis of the carrier. What holds the axis, and boxes and devices at the edges, is not designed.
"""

import math
from collections.abc import Iterator
from functools import lru_cache

from ilmek.elements.drive_parts import PULLEY
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import STEPPER, smallest_motor
from ilmek.machines.weft.axis import BeltAxis
from ilmek.machines.weft.carriers import (
    AXIS,
    BOX,
    CARRIAGE,
    GRIPPER,
    MOTOR,
    along,
    bobbin,
    fittings,
    part_id,
    rapier_tube,
    shuttle_wood,
)
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.passage import WeftPassage
from ilmek.machines.weft.rapier import CLAMP, Rapier
from ilmek.machines.weft.shuttle import BOX_END, Shuttle
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part
from ilmek.part.placement import UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, Shape, box, rectangle
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import polygon
from ilmek.records import record
from ilmek.units import format_quantity, mm

STRAIGHT, SINUOUS = part_id("shuttle of the straight weft"), part_id("shuttle of the sinuous weft")
DRAGGING, RAPIER_BODY = part_id("carriage of the shuttle"), part_id("rapier with its carriage")
"""Ids of the bodies that move."""

SHIFT_SPEED = 0.1
"""Speed of a box from cell to cell [m/s]."""

CUTTER, SELECTOR, TUCKER = 0.3, 0.2, 0.5
"""Masses of a weft cutter, of the fingers of the selector and of a tuck-in needle [kg]; assumed by this project."""

AUXILIARY = 0.4
"""Torque of the motors of selector, cutter and tuck-in needles [N m]: the smallest stepper's."""

SIDE = 40 * mm
"""Side of the room for a linear axis, a carriage and a device at the edge [m]; assumed by this project."""

_MISSING = Joint(JointKind.MISSING)


@record
class WeftBodies:
    """What the bodies are made from."""

    params: WeftParams
    carried: Shuttle | Rapier
    passage: WeftPassage
    axis: BeltAxis

    @property
    def tree(self) -> Tree:
        """The bodies."""
        return _tree(self)

    def bodies(self) -> Iterator[RigidBody]:
        """Each body."""
        if isinstance(self.carried, Shuttle):
            yield from self._shuttles(self.carried)
            yield self._boxes(self.carried)
        else:
            yield from self._rapier(self.carried)
            yield self._devices(self.carried)

    @property
    def half(self) -> float:
        """Half of the cloth's width [m]."""
        return self.params.cloth.width / 2

    @property
    def before_warps(self) -> float:
        """From the axis of the carrier to what runs in front of the lifted warps [m]."""
        params = self.params
        return self.carried.depth / 2 + params.play + params.cloth.carpet_yarns.warp.diameter + params.lift

    def _shuttles(self, made: Shuttle) -> Iterator[RigidBody]:
        """Both shuttles, each with a bobbin, from the left edge on, and the carriage that drags them."""
        wood, core = shuttle_wood(self.params, made.bobbin), bobbin(self.params, made.bobbin)
        fitted, noses = fittings(self.params, made.bobbin)
        start, wide = placement(-self.passage.stroke / 2), made.bobbin.length
        for name in (STRAIGHT, SINUOUS):
            inside = Occurrence(core, (along(-wide / 2),))
            yield _sliding(name, (Occurrence(wood), Occurrence(fitted, noses), inside), start)
        carriage = _bought(
            (CARRIAGE, "carriage of the shuttle", "with magnets"),
            "machined link",
            box(made.width, SIDE, made.length / 2),
            Bought("carriage", self.params.carriage_mass),
        )
        front = placement(-made.length / 4, 0.0, self.before_warps + SIDE / 2).after(along(0.0))
        yield _sliding(DRAGGING, (Occurrence(carriage, (front,)),), start)
        yield self._axis(self.passage.stroke, placement(0.0, 0.0, self.before_warps + 1.5 * SIDE))
        yield self._spare(core, made)

    def _axis(self, length: float, middle: Placement) -> RigidBody:
        """The belt axis about a place in its middle, and its drive, upright below its right end."""
        axis, carrier = self.axis, self.params.carrier
        wide = "wider than any of the table" if math.isnan(axis.width) else f"{format_quantity(axis.width, 'mm')} wide"
        belt = _bought(
            (AXIS, f"axis of the {carrier}", f"belt {axis.belt.belt.name}, {wide}"),
            "linear axis",
            box(SIDE, SIDE, length),
            Bought("belt axis", length=self.passage.stroke),
        )
        motor = axis.drive.motor if axis.drive else None
        driving = catalogue.motor(MOTOR, f"motor of the {carrier}", motor, axis.torque, axis.turning)
        low, stands = -SIDE / 2, []
        if axis.drive is not None and axis.drive.reducer.ratio != 1:
            ratio = axis.drive.reducer.ratio
            geared = catalogue.reducer(part_id("reducer"), f"reducer of the {carrier}", ratio, motor)
            low -= catalogue.length_of(geared)
            stands.append(Occurrence(geared, (_upright(length / 2, low),)))
        along_axis = Occurrence(belt, (along(-length / 2),))
        parts = (along_axis, *stands, Occurrence(driving, (_upright(length / 2, low),)))
        return RigidBody(part_id("belt axis"), parts, joint=_MISSING, positions=(middle,))

    def _boxes(self, made: Shuttle) -> RigidBody:
        """A box of two cells at each edge, one of them in line with the shed, and what shifts it."""
        wall, cell = self.params.wall, made.width + self.params.play
        tall, deep = 2 * cell + 3 * wall, made.depth + self.params.play + 2 * wall
        shift = (cell + wall) / 2
        cells = tuple(polygon(rectangle(cell, deep - 2 * wall).points + side * shift) for side in (-1, 1))
        length = made.length + 2 * BOX_END
        section = _bought(
            (BOX, "box of the shuttles", "two cells"),
            "linear axis",
            Prism(Profile(rectangle(tall, deep), cells), length),
            Bought("slide", length=2 * made.width),
        )
        force = 2 * made.full * GRAVITY
        torque, turning = force * PULLEY, SHIFT_SPEED / PULLEY
        motor = catalogue.motor(
            part_id("box-motor"), "motor of a box", smallest_motor(torque, turning, STEPPER), torque, turning
        )
        ends = (-self.passage.stroke / 2, self.passage.stroke / 2)
        places = tuple(placement(0.0, -shift).after(along(x - length / 2)) for x in ends)
        below = tuple(_upright(x, -shift - tall / 2) for x in ends)
        return RigidBody(part_id("boxes"), (Occurrence(section, places), Occurrence(motor, below)), joint=_MISSING)

    def _spare(self, core: Part, made: Shuttle) -> RigidBody:
        """A wound bobbin for each shuttle, for the next change: beside the right edge, behind the box."""
        beside, size = self.half + self.params.edge, made.bobbin
        behind = made.depth + self.params.edge
        places = tuple(placement(0.0, 0.0, -behind - k * size.diameter).after(along(beside)) for k in (1, 2))
        return RigidBody(part_id("spare bobbins"), (Occurrence(core, places),), joint=_MISSING)

    def _rapier(self, made: Rapier) -> Iterator[RigidBody]:
        """The rapier from the left, its tip at rest before the cloth, clamped at its far end."""
        tube = rapier_tube(self.params, made.tube, made.length)
        jaws = _bought(
            (GRIPPER, "gripper of the rapier", "two jaws"),
            "machined link",
            box(made.gripper, made.gripper, made.gripper),
            Bought("gripper", self.params.gripper_mass),
        )
        clamp = _bought(
            (CARRIAGE, "carriage of the rapier", "with clamp"),
            "machined link",
            box(SIDE, SIDE, CLAMP),
            Bought("carriage", self.params.carriage_mass),
        )
        far = -made.gripper - made.length
        start, under = placement(-self.half - self.passage.run), -(made.tube[0] + SIDE) / 2
        parts = (
            Occurrence(tube, (along(far),)),
            Occurrence(jaws, (along(-made.gripper),)),
            Occurrence(clamp, (placement(0.0, under).after(along(far)),)),
        )
        yield _sliding(RAPIER_BODY, parts, start)
        length = self.passage.move.distance + CLAMP
        middle = placement(-self.half - self.passage.run + far + length / 2, under - SIDE)
        yield self._axis(length, middle)

    def _devices(self, made: Rapier) -> RigidBody:
        """Selector, cutters, tuck-in needles with their axes, and the motors of all of them, at the edges."""
        params = self.params
        left, right = -self.half - params.edge, self.half + params.edge
        motor = catalogue.motor(
            part_id("edge-motor"),
            "motor of selector, cutters and needles",
            smallest_motor(AUXILIARY, 0.0, STEPPER),
            AUXILIARY,
            0.0,
        )

        def device(name: str, title: str, size: str, mass: float) -> Part:
            return _bought((part_id(name), title, size), "machined link", box(SIDE, SIDE, SIDE), Bought(title, mass))

        slide = _bought(
            (part_id("needle-axis"), "axis of a tuck-in needle", "along the edge"),
            "linear axis",
            box(SIDE, SIDE, max(2 * params.turn, SIDE)),
            Bought("slide", length=2 * params.turn),
        )
        front = made.depth / 2 + SIDE
        both = (left, right)

        def beside(row: int, places: tuple[float, ...]) -> tuple[Placement, ...]:
            return tuple(_upright(x, -SIDE / 2, front + row * 1.5 * SIDE) for x in places)

        return RigidBody(
            part_id("devices at the edges"),
            (
                Occurrence(device("selector", "weft selector", "two fingers", SELECTOR), beside(0, (right + SIDE,))),
                Occurrence(device("cutter", "weft cutter", "one at each edge", CUTTER), beside(0, both)),
                Occurrence(device("needle", "tuck-in needle", "one at each edge", TUCKER), beside(1, both)),
                Occurrence(slide, beside(2, both)),
                Occurrence(motor, (*beside(3, (left, right, right + 2 * SIDE)), *beside(5, both))),
            ),
            joint=_MISSING,
        )


@lru_cache(maxsize=16)
def _tree(made: WeftBodies) -> Tree:
    """The tree, made once for a design."""
    return Tree(tuple(made.bodies()))


def _sliding(name: str, parts: tuple[Occurrence, ...], start: Placement) -> RigidBody:
    return RigidBody(name, parts, joint=Joint(JointKind.SLIDE, (1.0, 0.0, 0.0)), positions=(start,))


def _bought(names: tuple[str, str, str], process: str, room: Shape, bought: Bought) -> Part:
    """A part of which the room alone is known; names: id, title, size."""
    name, title, size = names
    return Part(name, title, process, size, room, purchase=bought, envelope=True)


def _upright(x: float, y: float, z: float = 0.0) -> Placement:
    """At a place, z up."""
    return placement(x, y, z).after(UPRIGHT)
