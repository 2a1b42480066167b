"""The weft side as bodies: the carrier with its carriage, the axis that moves it, boxes or what serves a rapier.

Axes: x along the width to the weaver's right, 0 in the middle of the cloth; y up along the warps and z to the front,
both 0 at the axis of the carrier. Bodies lie at rest as a row begins.
"""

from collections.abc import Iterator
from functools import lru_cache

from ilmek.machines.weft.axis import BeltAxis
from ilmek.machines.weft.carriers import (
    BOX,
    BOX_MOTOR,
    MAGNET,
    MOTOR,
    along,
    bobbin,
    fittings,
    magnet,
    magnet_positions,
    part_id,
    shuttle_wood,
)
from ilmek.machines.weft.guide import ShuttleGuide
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.passage import WeftPassage
from ilmek.machines.weft.rapier import Rapier
from ilmek.machines.weft.rapier_tree import RapierSide
from ilmek.machines.weft.shuttle import Shuttle
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.tree import Closure, Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.records import record

STRAIGHT, SINUOUS = part_id("shuttle of the straight weft"), part_id("shuttle of the sinuous weft")
LEFT_BOX, RIGHT_BOX = part_id("box at the left edge"), part_id("box at the right edge")
DRAGGING = part_id("carriage of the shuttle")
"""Ids of the bodies that move."""


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

    @property
    def stand(self) -> Tree:
        """What carries a rapier's side where the machine is alone; the guide of shuttles is one piece."""
        return Tree() if isinstance(self.carried, Shuttle) else Tree((self.rapier.stand(),))

    def bodies(self) -> Iterator[RigidBody]:
        """Each body."""
        if isinstance(self.carried, Shuttle):
            yield from self._shuttles(self.carried)
        else:
            yield from self.rapier.bodies()

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

    @property
    def rapier(self) -> RapierSide:
        """What moves the rapier. Raises TypeError for shuttles."""
        if isinstance(self.carried, Shuttle):
            raise TypeError("shuttles have a guide behind the warps")
        return RapierSide(self.params, self.carried, self.passage, self.axis)

    def _shuttles(self, shuttle: Shuttle) -> Iterator[RigidBody]:
        """Both shuttles in their boxes, as a row begins, the carriage behind the left one, and what guides them."""
        wood, core, (fitted, eyes) = (
            shuttle_wood(self.params, shuttle.bobbin),
            bobbin(self.params, shuttle.bobbin),
            fittings(self.params, shuttle.bobbin),
        )
        guide, wide = self.guide, shuttle.bobbin.length
        cells = guide.box()
        parts = [Occurrence(wood), Occurrence(fitted, eyes), Occurrence(core, (along(-wide / 2),))]
        if self.params.nose > 0:
            backs = (placement(x, z=-shuttle.depth / 2) for x in magnet_positions(self.params, shuttle.bobbin))
            parts.append(Occurrence(magnet(self.params, shuttle.bobbin), tuple(backs)))
        half = guide.stroke / 2
        yield RigidBody(part_id("guide"), (*guide.standing(), *guide.slides(), self._spare(core, shuttle)))
        for name, side in ((LEFT_BOX, -1), (RIGHT_BOX, 1)):
            shifted = Joint(JointKind.SLIDE, (0.0, 1.0, 0.0), motor=BOX_MOTOR)
            yield RigidBody(name, (Occurrence(cells, (guide.box_position(side),)),), joint=shifted)
        yield _sliding(STRAIGHT, tuple(parts), placement(-half))
        yield _sliding(SINUOUS, tuple(parts), placement(half, guide.pitch))
        yield _sliding(DRAGGING, tuple(guide.carried()), placement(-half), MOTOR)

    def _spare(self, core: Part, shuttle: Shuttle) -> Occurrence:
        """A wound bobbin for each shuttle, for the next change: on the ends of the bar, behind the boxes."""
        guide, radius, wall = self.guide, shuttle.bobbin.core / 2, self.params.wall
        depth = max((guide.front + guide.rear) / 2, guide.rear + radius)
        starts = (wall - guide.box_end, guide.box_end - wall - shuttle.bobbin.length)
        return Occurrence(core, tuple(placement(x, radius, depth).after(along(0.0)) for x in starts))


@lru_cache(maxsize=16)
def _tree(bodies: WeftBodies) -> Tree:
    """The tree, made once for a design."""
    across, up = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    shuttles = (STRAIGHT, SINUOUS) if isinstance(bodies.carried, Shuttle) else ()
    # The magnets draw a shuttle along; the guide, and at the right edge the box, hold its height.
    drawn = (Closure(JointKind.TRANSMISSION, (DRAGGING, one), kept_by=(MAGNET,), along=across) for one in shuttles)
    held = (Closure(JointKind.TRANSMISSION, (RIGHT_BOX, shuttle), kept_by=(BOX,), along=up) for shuttle in shuttles)
    return Tree(tuple(bodies.bodies()), (*drawn, *held))


def _sliding(name: str, parts: tuple[Occurrence, ...], start: Placement, motor: str = "") -> RigidBody:
    return RigidBody(name, parts, joint=Joint(JointKind.SLIDE, (1.0, 0.0, 0.0), motor=motor), positions=(start,))
