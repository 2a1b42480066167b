"""The side view of a loom: coordinates of all that stands or moves in it, the fell at 0, x to the front, y up [m].

    y
    |  upper cylinder - back rest         warps on x = 0, from the fell to the back rest,
    |      cam shaft  |                   then over it to the back, level, to the upper cylinder
    |      cam shaft  |  comb             the comb reaches through the warps from the front
    |                 | carrier           the weft's carrier runs in the shed
    |                 | head - rail       the heads knot just above the fell
    0           fell  +------------- x
    |        spacer   |
    |        lower    |                   the carpet runs down the fronts of both, is wound on the lower one
    ---------------------- floor

The lower cylinder has room for the whole carpet; only what lies between it and the spacer stays flat [thesis 3.1].
"""

import cmath
import math
from typing import TYPE_CHECKING

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.carpet.pile import leg_length
from ilmek.elements.columns import ascending, mid_loaded
from ilmek.elements.materials import GRAVITY
from ilmek.errors import LoomError
from ilmek.machines.arrangement.cylinders import RoundPart, rolled, under_the_fell
from ilmek.machines.arrangement.spans import (
    BAR,
    LEAF_BEHIND,
    LEAF_REACH,
    ShedRoom,
    ShedSpans,
    cylinder_offset,
    shed_room,
    spans_at,
    warp_length,
)
from ilmek.machines.shedding.tree import front_of
from ilmek.machines.warp_tension.cylinders import spacer_tube
from ilmek.machines.warp_tension.tree import reach_of, winding_reducer
from ilmek.machines.weaver.carriage_drive import motor_corner
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import HeadShape
from ilmek.machines.weaver.tree import drive_of, head_mass, least_rail
from ilmek.records import computed, group, record, result
from ilmek.units import deg, mm

if TYPE_CHECKING:
    from ilmek.machines.beat import BeatPath
    from ilmek.machines.loom_task import LoomTask

ABOVE_FLOOR = 150 * mm
"""The full lower cylinder above the floor [m]."""

_UNDER_REDUCER, _UNDER_LARGE = 140 * mm, 1.05
"""The reducer of the lower cylinder above the floor [m]: a foot of the frame of 80 mm has room there; and over the
reach of a large one, by which more is pulled: the feet are stiffer in proportion; assumed by this project.
"""

ABOVE_CYLINDER = 50 * mm
"""The frame's columns above the upper cylinder [m]."""

_HALF_HOUSING = 90 * mm
"""Half of the housing of a cylinder's bearing, at most [m]."""

_COLUMN_ROOM = ((100 * mm, 150 * mm), (math.inf, 220 * mm))
"""Half of the width of a cylinder's reducer, at most, and least room of the columns beside it [m]: looms with larger
reducers have wider columns; assumed by this project.
"""

RAIL = 80 * mm
"""Side of the room for the linear axis of the heads on their rail [m]."""


RAIL_CARGO, SUNK = 12.0, 1.7
"""Mass of a length of what lies along the rail beside the heads [kg/m], and how much more all of it counts on several
spans, whose supports sink: assumed by this project.
"""

RETREAT = cmath.exp(-55j * deg)
"""Direction in which the heads retreat, in the side view: down and to the front; assumed by this project."""


@record
class SideBox:
    """A rectangle: its lower corner towards the warps' back, and depth + i height [m]."""

    corner: complex
    size: complex


@record
class CamPosition:
    """A cam shaft: its axis, the radius of its guides, the front of these or of its reed before the axis, and the lift
    of its warps [m].
    """

    at: complex
    guide_radius: float
    front: float
    lift: float


HANDS = complex(200 * mm, 120 * mm)
"""Room of weavers' hands that tie: before the warps, and over the fell [m]; assumed by this project."""


_STEPS, _MORE = 65, 1e-4
"""Positions on the heads' retreat, and share of a distance squared that they miss between."""


@record
class HeadsView:
    """The heads in the side view while they knot.

    shape      of a head                       rail   of the heads
    rail_side  side of the rail's section, in front of its axis, before the frame is designed [m]
    motor      upper corner in front of a carriage's motor [m]
    """

    shape: HeadShape
    rail: SideBox
    rail_side: float
    motor: complex
    retreat: float = result(
        "mm", "retreat of the heads for wefts and beats, down and to the front", name="head_retreat"
    )

    @property
    def retreated(self) -> complex:
        """Displacement of the retreated heads [m]."""
        return self.retreat * RETREAT

    @property
    def corners(self) -> tuple[complex, ...]:
        """Upper corners in front of a head, of its carriage's motor, and of its rail [m]."""
        end = self.rail.corner + self.rail.size / 2 + self.rail_side * (1 + 0.5j)
        return *self.shape.corners, self.motor, end

    @property
    def front(self) -> float:
        """The foremost x of the rail of the retreated heads [m]."""
        return (self.rail.corner + self.rail.size + self.retreated).real


@record
class SideView:
    """The side view of a loom.

    room, spans   what the spans of the shed leave room for, and the spans
    cams          the cam shafts, the lowest first
    carrier       of the weft, while it runs through the even shed; in the odd shed it is in the same position
    comb          convex polygons of what beats, at rest: leaves, bar [m]
    back_rest, upper, spacer, lower                                roll  radius of the lower cylinder with the carpet
    compensator   of the warps' tension, between back rest and upper cylinder
    pile          legs of the knots in front of the warps [m]      heads  None where weavers tie
    reducer       half of the width of a cylinder's reducer, across its shaft [m]
    """

    room: ShedRoom
    spans: ShedSpans
    cams: tuple[CamPosition, ...]
    carrier: SideBox
    comb: tuple[ComplexArray, ...]
    back_rest: RoundPart
    compensator: SideBox
    upper: RoundPart
    spacer: RoundPart
    lower: RoundPart
    roll: float
    pile: float
    reducer: float
    heads: HeadsView | None = group()

    front_span = computed("mm", "from the fell to the lowest cam shaft", lambda it: it.spans.front[0])
    back_span = computed("mm", "from the highest cam shaft to the back rest", lambda it: it.spans.back[-1])
    weft_height = computed(
        "mm",
        "laid weft above the fell: the middle of its carrier",
        lambda it: (it.carrier.corner + it.carrier.size / 2).imag,
    )
    beat_stroke = computed("mm", "from the comb at rest, above the carrier, to the fell", lambda it: it.spans.comb)
    cam_shaft_height = computed("m", "lowest cam shaft above the floor", lambda it: it.spans.front[0] - it.floor)
    warp_length = computed(
        "m",
        "from the fell over the back rest to the upper cylinder, at rest",
        lambda it: warp_length(it.room, it.spans),
    )
    fell_height = computed("m", "fell above the floor", lambda it: -it.floor)
    loom_height = computed("m", "height of the frame's columns", lambda it: it.top - it.floor)

    @computed("m", "from the rearmost part to the rail of the retreated heads, or to what beats", name="loom_depth")
    def loom_depth(self) -> float:
        rear = min(
            *(cam.at.real - cam.guide_radius for cam in self.cams),
            *(one.at.real - one.radius for one in (self.upper, self.spacer)),
            self.lower.at.real - self.roll,
        )
        return self.front - rear

    @property
    def front(self) -> float:
        """The foremost x of the rail of the retreated heads, or of what beats where there is none [m]."""
        return self.heads.front if self.heads else max(float(one.real.max()) for one in self.comb)

    @property
    def of_heads(self) -> HeadsView:
        """The heads. Raises LoomError where weavers tie."""
        if self.heads is None:
            raise LoomError("no heads in the side view", allowed="a loom whose knots heads tie")
        return self.heads

    @property
    def tying(self) -> tuple[complex, ...]:
        """Upper corners in front of what ties: heads with their rail, or weavers' hands [m]."""
        return self.heads.corners if self.heads else (HANDS,)

    @property
    def cam_front(self) -> float:
        """The foremost x of guide cams and reeds [m]."""
        return max(cam.at.real + cam.front for cam in self.cams)

    @property
    def lift(self) -> float:
        """Lift of the warps at the lowest cam shaft [m]."""
        return self.cams[0].lift

    @property
    def column(self) -> float:
        """Axis of the columns, x [m]: in the middle of their room."""
        return sum(self.column_room) / 2

    @property
    def column_room(self) -> tuple[float, float]:
        """Room of the columns along x [m]: outside of all, between housings and reducers of the cylinders."""
        upper, lower = self.upper, max(self.lower, self.spacer, key=lambda one: -one.at.real)
        behind, before = (max(min(one.radius, _HALF_HOUSING), self.reducer) for one in (upper, lower))
        return upper.at.real + behind, lower.at.real - before

    @property
    def floor(self) -> float:
        """Height of the floor, the fell at 0 [m]."""
        under = self.reducer + max(_UNDER_REDUCER, _UNDER_LARGE * self.reducer)
        return self.lower.at.imag - max(self.roll + ABOVE_FLOOR, under)

    @property
    def top(self) -> float:
        """Height of the columns' ends over the fell [m]."""
        highest = (self.compensator.corner + self.compensator.size).imag
        return max(self.upper.at.imag + self.upper.radius, highest) + ABOVE_CYLINDER


def laid_out(task: "LoomTask", path: "BeatPath | None" = None) -> SideView:
    """The side view of a loom whose shedding, and head if any, are designed; the cylinders where they are.

    path  of what beats; default: of a comb that goes straight down
    """
    shedding, head = task.shedding, task.weaver
    room, cylinder = shed_room(task), task.warp_tension
    prime, guide = shedding.cam.prime_radius, shedding.stack.guide_radius
    assert shedding.params.spans_of_warp is not None  # the loom sets the spans of its cams
    front, back = shedding.params.spans_of_warp
    along, last = [shaft.beyond for shaft in shedding.shafts], shedding.shafts[-1].beyond
    spans = spans_at(room, prime, guide, tuple(front + one for one in along), tuple(back + last - one for one in along))
    radius = cylinder.outer_radius if cylinder else room.tube
    comb = _comb(room, spans, path)
    spacer, lower, roll = _lower_cylinders(task, radius)
    heads = _heads(task, head, room.clearance + below(path)) if head else None
    lower = _out_of_reach(heads, lower, roll + room.clearance) if heads else lower
    # A wider spacer leaves the columns their room; the warps count as shorter by that, which stretches them more.
    behind, rest = cylinder_offset(room) + spacer.radius - radius, complex(-room.back_rest, spans.back_rest)
    reducer = reach_of(winding_reducer(cylinder)) if cylinder else 0.0
    sides = (max(min(own, _HALF_HOUSING), reducer) for own in (radius, lower.radius))
    columns = next(wide for reach, wide in _COLUMN_ROOM if reducer <= reach)
    front = min(lower.at.real, spacer.at.real)
    behind = max(behind, columns + sum(sides) - front + rest.real)
    return SideView(
        room=room,
        spans=spans,
        cams=tuple(
            CamPosition(
                complex(-shaft.cam.prime_radius, height),
                shaft.stack.guide_radius,
                front_of(shedding, index),
                shaft.params.lift,
            )
            for index, (shaft, height) in enumerate(zip(shedding.shafts, spans.front, strict=True))
        ),
        carrier=_carrier(room, spans),
        comb=comb,
        back_rest=RoundPart(rest, room.back_rest),
        compensator=SideBox(
            rest + 1j * room.back_rest - complex(room.back_rest + room.swing, room.half_depth),
            complex(room.swing, 2 * room.half_depth),
        ),
        upper=RoundPart(rest - behind + 1j * (room.back_rest - radius), radius),
        spacer=spacer,
        lower=lower,
        roll=roll,
        pile=head.drawn / 2 if head else pile_leg(task),
        reducer=reducer,
        heads=heads,
    )


def pile_leg(task: "LoomTask") -> float:
    """Length of a knot's leg in front of the warps, shorn [m]."""
    yarns = task.yarns
    return leg_length(yarns.warp.diameter, yarns.pile.diameter, task.params.pile)


def _heads(task: "LoomTask", head: Weaver, room: float) -> HeadsView:
    """The heads, which retreat until they stand a room [m] below the fell."""
    shape = head.shape
    return HeadsView(
        shape=shape,
        rail=SideBox(complex(shape.front, shape.rail - RAIL / 2), complex(RAIL, RAIL)),
        rail_side=_rail_side(task, head),
        motor=motor_corner(head, drive_of(head)),
        retreat=(shape.top + room) / -RETREAT.imag,
    )


def _rail_side(task: "LoomTask", head: Weaver) -> float:
    """Side of the lightest section that bears the heads in the middle of a span of the rail [m], the largest of all.

    Not smaller than that of the frame, where they stand side by side. One head where their number is open. What lies
    along the rail counts as in the middle too.
    """
    params = task.params
    spans = math.ceil(task.rail_length / params.rail_span - 1e-9)
    span = task.rail_length / spans
    heads = min(params.heads or 1, math.ceil(span / head.width)) * head_mass(head)
    weight = (heads + RAIL_CARGO * span) * (SUNK if spans > 1 else 1) * GRAVITY
    sections = ascending()
    least = least_rail(head, params.clearance)
    bearing = (tube for tube in sections if tube.side >= least and mid_loaded(tube, span, weight)[0] <= params.rail_sag)
    return next(bearing, sections[-1]).side


def _carrier(room: ShedRoom, spans: ShedSpans) -> SideBox:
    """The carrier, next to the warps at rest."""
    corner = complex(room.clearance + room.warp / 2, spans.carrier)
    return SideBox(corner, complex(room.carrier_depth, room.carrier_width))


def rectangle(box: SideBox) -> ComplexArray:
    """Corners of a rectangle, counter-clockwise [m]."""
    return np.asarray(box.corner + np.array([0, box.size.real, box.size, 1j * box.size.imag]))


def _comb(room: ShedRoom, spans: ShedSpans, path: "BeatPath | None") -> tuple[ComplexArray, ...]:
    """What beats, at rest; without its path the usual comb, above the carrier."""
    if path is not None:
        return path.at_rest
    leaves = SideBox(complex(-LEAF_BEHIND, spans.comb), complex(LEAF_BEHIND + LEAF_REACH, room.leaf_height))
    return rectangle(leaves), rectangle(SideBox(complex(LEAF_REACH, spans.comb), complex(BAR, room.leaf_height)))


def below(path: "BeatPath | None") -> float:
    """How far what beats reaches below the fell [m]: the heads stand lower meanwhile."""
    if path is None:
        return 0.0
    return max(0.0, -min(float(path.carried(polygon, path.tip).imag.min()) for polygon in path.outline))


def _lower_cylinders(task: "LoomTask", radius: float) -> tuple[RoundPart, RoundPart, float]:
    """Spacer, lower cylinder of a radius, and the radius of this with the whole carpet wound on it [m]."""
    head, height = task.weaver, task.params.pile.pile_height
    pile = head.params.pile_height if head else height
    roll = rolled(radius, task.params.woven_size[1], pile, task.yarns.warp.diameter)
    made = task.warp_tension
    wide = max(radius, spacer_tube(made.params, radius).outer_radius) if made else radius
    spacer, lower = under_the_fell(radius, wide, roll)
    if made:  # their reducers, of one size, stand over each other
        under = spacer.at.imag - 2 * reach_of(winding_reducer(made))
        lower = RoundPart(complex(lower.at.real, min(lower.at.imag, under)), radius)
    return spacer, lower, roll


def _out_of_reach(heads: HeadsView, lower: RoundPart, reach: float) -> RoundPart:
    """The lower cylinder, so low that rear corners of the retreating heads keep a distance from its axis [m]."""
    boxes = heads.shape.body, heads.shape.magazine, *(tool.corner for tool in heads.shape.tools)
    corners = np.array(boxes)[:, None] + heads.retreated * np.linspace(0.0, 1.0, _STEPS)
    aside = corners.real - lower.at.real
    over = np.sqrt(np.maximum((1 + _MORE) * reach**2 - aside**2, 0.0))
    free = [lower.at.imag, *(corners.imag - over)[np.abs(aside) < reach].tolist()]
    return RoundPart(complex(lower.at.real, min(free)), lower.radius)
