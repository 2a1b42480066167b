"""The weft side as bodies: the carrier with its carriage, the axis that moves it, boxes or what serves a rapier.

Axes: x along the width to the weaver's right, 0 in the middle of the cloth; y up along the warps and z to the front,
both 0 at the axis of the carrier. Bodies lie at rest as a row begins. What holds the axis of a rapier, and the devices
at its edges, is not designed.
"""

import math
from collections.abc import Iterator
from functools import lru_cache

from ilmek.elements.motors import STEPPER, smallest_motor
from ilmek.machines.weft.axis import BeltAxis
from ilmek.machines.weft.carriers import (
    AXIS,
    CARRIAGE,
    GRIPPER,
    MOTOR,
    along,
    bobbin,
    fittings,
    magnet,
    magnet_positions,
    part_id,
    rapier_tube,
    shuttle_wood,
)
from ilmek.machines.weft.guide import ShuttleGuide
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.passage import WeftPassage
from ilmek.machines.weft.rapier import CLAMP, Rapier
from ilmek.machines.weft.shuttle import Shuttle
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part
from ilmek.part.placement import UPRIGHT, Placement, placement
from ilmek.part.shapes import Shape, box
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.records import record
from ilmek.units import format_quantity, mm

STRAIGHT, SINUOUS = part_id("shuttle of the straight weft"), part_id("shuttle of the sinuous weft")
LEFT_BOX, RIGHT_BOX = part_id("box at the left edge"), part_id("box at the right edge")
DRAGGING, RAPIER_BODY = part_id("carriage of the shuttle"), part_id("rapier with its carriage")
"""Ids of the bodies that move."""

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
        else:
            yield from self._rapier(self.carried)
            yield self._devices(self.carried)

    @property
    def half(self) -> float:
        """Half of the cloth's width [m]."""
        return self.params.cloth.width / 2

    @property
    def guide(self) -> ShuttleGuide:
        """What moves the shuttles. Raises TypeError for a rapier."""
        if not isinstance(self.carried, Shuttle):
            raise TypeError("a rapier has no guide behind the warps")
        return ShuttleGuide(self.params, self.carried, self.axis, self.passage.stroke)

    def _shuttles(self, made: Shuttle) -> Iterator[RigidBody]:
        """Both shuttles in their boxes, as a row begins, the carriage behind the left one, and what guides them."""
        wood, core, (fitted, eyes) = (
            shuttle_wood(self.params, made.bobbin),
            bobbin(self.params, made.bobbin),
            fittings(self.params, made.bobbin),
        )
        guide, wide = self.guide, made.bobbin.length
        cells = guide.box()
        parts = [Occurrence(wood), Occurrence(fitted, eyes), Occurrence(core, (along(-wide / 2),))]
        if self.params.nose > 0:
            backs = (placement(x, z=-made.depth / 2) for x in magnet_positions(self.params, made.bobbin))
            parts.append(Occurrence(magnet(self.params, made.bobbin), tuple(backs)))
        half = guide.stroke / 2
        yield RigidBody(part_id("guide"), (*guide.standing(), *guide.slides(), self._spare(core, made)))
        for name, side in ((LEFT_BOX, -1), (RIGHT_BOX, 1)):
            shifted = Joint(JointKind.SLIDE, (0.0, 1.0, 0.0))
            yield RigidBody(name, (Occurrence(cells, (guide.box_position(side),)),), joint=shifted)
        yield _sliding(STRAIGHT, tuple(parts), placement(-half))
        yield _sliding(SINUOUS, tuple(parts), placement(half, guide.pitch))
        yield _sliding(DRAGGING, tuple(guide.carried()), placement(-half))

    def _axis(self, length: float, middle: Placement) -> RigidBody:
        """The belt axis of a rapier about a place in its middle, and its drive, upright below its right end."""
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

    def _spare(self, core: Part, made: Shuttle) -> Occurrence:
        """A wound bobbin for each shuttle, for the next change: on the ends of the bar, behind the boxes."""
        guide, radius, wall = self.guide, made.bobbin.core / 2, self.params.wall
        depth = max((guide.front + guide.rear) / 2, guide.rear + radius)
        starts = (wall - guide.box_end, guide.box_end - wall - made.bobbin.length)
        return Occurrence(core, tuple(placement(x, radius, depth).after(along(0.0)) for x in starts))

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
