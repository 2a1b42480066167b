"""The jaws of the grippers: rail on the follower, rocker on the carriage, collar and wire in the gripper, finger.

A rocker hangs on the carriage that moves the gripper. Its roller runs on the rail of the jaws' follower, which is as
long as the carriage's way, so that the jaws close and open wherever the carriage is. The rail lifts the roller by s, at
the arm c; the tip of the other arm, b long, moves the collar on the gripper, which a spring presses away:

    sin phi = (s - h/2) / c,    the collar moves by b sin phi,    c = b / i

The wire leads the collar's motion through the bore of the gripper to its end, as in forceps for endoscopes, where a
finger opens by the jaw's width.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.elements.pin_joints import side_play
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.jaw_hinge import JawHinge
from ilmek.machines.weaver.motions import CENTRE_GRASP, SIDE_GRASP
from ilmek.machines.weaver.opener import STEEL
from ilmek.machines.weaver.outlines import hull_of_circles
from ilmek.machines.weaver.return_springs import longest, shortest, spring_part, stroke_at
from ilmek.machines.weaver.stations import station
from ilmek.machines.weaver.tool_parts import (
    CENTRE,
    CENTRE_GRIPPER,
    JAW,
    LEFT,
    PLATES,
    RIGHT,
    SIDE_GRIPPER,
    TO_THE_TIP,
    part_id,
    wire_of,
)
from ilmek.part.part import Part
from ilmek.part.placement import IN_SIDE_VIEW, UPRIGHT, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, rectangle, shape_box, stepped, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle, polygon
from ilmek.records import record
from ilmek.report import Contour
from ilmek.units import mm, turn

ROCKER, AXLE, ROLLER, FACE, ARM, TIP = 12 * mm, 3 * mm, 9 * mm, 5 * mm, 2.4 * mm, 1.2 * mm
"""Arm of a rocker to its collar, diameters of its axle and its roller, width of this, thickness of its arms, and half
the width of their tips [m]; assumed by this project, as all sizes here."""

EYE, LUG = 3 * mm, 2.5 * mm
"""Radius of a rocker's eye on its axle, and thickness of the lugs that hold the axle [m]."""

PIN, PIN_HEAD, HEAD = 3 * mm, 5 * mm, 1 * mm
"""Diameters of a roller's pin and of its head, and thickness of this, which holds the roller on its arm [m]."""

APART = 0.3 * mm
"""From a spring, or a collar in the middle of its stroke, to what it must not touch [m]."""

PLAY, BRAZED = 0.1 * mm, 0.1 * mm
"""Room of a wire's peg in the gripper's slot, and throat of the peg's brazing [m]."""

HUB, FLANGE, GROOVE, WALL = 4 * mm, 7 * mm, 2.8 * mm, 0.8 * mm
"""Diameters of a collar's hub and flanges, width of its groove and thickness of its flanges [m]."""


@record
class Rail:
    """The rail of a jaws' follower: from begin to end from the warps, and the height of its top at lift 0 [m]."""

    begin: float
    end: float
    top: float


@record
class Rocker:
    """A rocker while its carriage is at rest.

    axle  z + i y [m]      tips  height of the axis of each gripper over its arm's tip, x of it: x + i y [m]
    track  of the jaws     travel  of the carriage forward and back [m]
    """

    track: str
    axle: complex
    grippers: tuple[complex, ...]
    travel: tuple[float, float]


def rocker(weaver: Weaver, track: str) -> Rocker:
    """The rocker of the jaws of a track."""
    by, tied, params = weaver.grippers, weaver.tool_bodies.tied, weaver.params
    under = ROCKER + HUB / 2 + TIP
    if track == SIDE_GRASP:
        rods = tuple(complex(hand * by.axis, tied + hand * by.lift / 2) for hand in (-1, 1))
        axle = complex(weaver.shape.carriage - _before(weaver, track), tied - under)
        return Rocker(track, axle, rods, (params.opening + by.crossing, params.pull_back))
    height, below = tied + by.height, tied + by.lift / 2
    axle = complex(weaver.tool_bodies.tools.centre_carriage - _before(weaver, track), min(height - under, below))
    return Rocker(track, axle, (1j * height,), (params.centre_stroke, 0.0))


def _before(weaver: Weaver, track: str) -> float:
    """From a carriage to the axle of its rocker [m]: the spring, and half a collar, in the middle of its stroke."""
    return longest(weaver, track) - stroke_at(weaver.cam(track)) / 2 + GROOVE / 2 + WALL + APART


def arm_of(weaver: Weaver, track: str) -> float:
    """Arm of a rocker to its roller [m]: of those to the collars the mean, over the ratio."""
    by = rocker(weaver, track)
    return sum(_length(rod, by) for rod in by.grippers) / len(by.grippers) / weaver.cam(track).ratio


def _length(rod: complex, by: Rocker) -> float:
    """Arm of a rocker to the collar on a gripper, x + i y [m]."""
    return rod.imag - HUB / 2 - TIP - by.axle.imag


def turned(weaver: Weaver, track: str, lift: RealField) -> FloatArray:
    """Angle of a rocker [rad] at lifts of its follower [m]: the roller, nearer to the warps, goes up."""
    share = (lift - weaver.cam(track).lift / 2) / arm_of(weaver, track)
    return np.asarray(-np.arcsin(np.clip(share, -1.0, 1.0)))


def drawn(weaver: Weaver, track: str, number: int, lift: RealField) -> FloatArray:
    """How far a collar is from its middle position, to the front [m]."""
    by = rocker(weaver, track)
    length = _length(by.grippers[number], by)
    return np.asarray(-length * np.sin(turned(weaver, track, lift)))


def rail_of(weaver: Weaver, track: str) -> Rail:
    """The rail of a jaws' follower."""
    by, cam = rocker(weaver, track), weaver.cam(track)
    forward, back = by.travel
    roller = by.axle.real - arm_of(weaver, track)
    top = by.axle.imag - ROLLER / 2 - cam.lift / 2
    return Rail(roller - forward - ROLLER / 2, roller + back + ROLLER / 2, top)


def lugs(weaver: Weaver, track: str, front: float, sides: tuple[float, ...]) -> Placed:
    """Lugs of a carriage on its front that hold its rocker's axle, in the head's axes, by the x of their right faces
    [m].
    """
    axle = rocker(weaver, track).axle
    deep = front - axle.real
    corners = np.array([-EYE - 1j * EYE, deep - 1j * EYE, deep + 1j * EYE, -EYE + 1j * EYE])
    section = Profile(polygon(corners), (circle(0j, AXLE / 2),))
    return Placed(Prism(section, LUG), tuple(placement(x, axle.imag, axle.real).after(IN_SIDE_VIEW) for x in sides))


def rocker_id(track: str) -> str:
    """Id of the rocker of the jaws of a track, and of its body."""
    return part_id(f"{track.replace(' ', '-')}-rocker")


def wire_id(track: str) -> str:
    """Id of the wire of the jaws of a track."""
    return part_id("side-wire" if track == SIDE_GRASP else "centre-wire")


def collar_body(name: str) -> str:
    """Id of the body of the collar on a gripper."""
    return f"{name}'s collar"


def finger_body(name: str) -> str:
    """Id of the body of a gripper's finger."""
    return f"{name}'s finger"


def jaw_bodies(weaver: Weaver) -> Iterator[RigidBody]:
    """Rockers on the carriages, collars with wires on the grippers, fingers at their ends, at angle 0."""
    for track, carriage, grippers in ((SIDE_GRASP, PLATES, (LEFT, RIGHT)), (CENTRE_GRASP, CENTRE, (CENTRE,))):
        by = rocker(weaver, track)
        start = float(weaver.cam(track).motion.s[0])
        own = weaver.tool_bodies.frame(carriage).inverse
        at = own.after(placement(0.0, by.axle.imag, by.axle.real)).after(IN_SIDE_VIEW)
        rest = at.after(placement(about=(0.0, 0.0, 1.0), angle=float(turned(weaver, track, start))))
        yield RigidBody(rocker_id(track), tuple(_rocker_parts(weaver, by)), carriage, Joint(JointKind.PIN), (rest,))
        for number, name in enumerate(grippers):
            along = by.axle.real + float(drawn(weaver, track, number, start))
            yield _collar(weaver, by, name, along)
            if (finger := _finger(weaver, name)) is not None:
                yield finger


def _rocker_parts(weaver: Weaver, by: Rocker) -> Iterator[Occurrence]:
    """Axle along the row, arm with roller over the rail, an arm to each collar; z to the weaver's left."""
    side, arm = station(weaver, by.track), arm_of(weaver, by.track)
    rods = [rod.real for rod in by.grippers]
    towards = 1 if max(rods) > side else -1
    near, name = side + towards * FACE / 2, "side" if by.track == SIDE_GRASP else "centre"
    left, right = min(near, *(rod - 2 * ARM for rod in rods)), max(near, *(rod + 2 * ARM for rod in rods))
    title = f"axle of the {name} jaws' rocker"
    axle = Part(part_id(f"{name}-axle"), title, "pin or bush", bar(AXLE, right - left), STEEL)
    yield Occurrence(axle, (placement(z=-right),))
    hole = (circle(0j, AXLE / 2),)
    eye = circle(complex(-arm), PIN / 2)
    level = Prism(Profile(hull_of_circles(EYE, 0.8 * ROLLER / 2, complex(-arm)), (*hole, eye)), ARM)
    title = f"roller's arm of the {name} jaws"
    roller_arm = Part(part_id(f"{name}-roller-arm"), title, "machined link", level, STEEL)
    yield Occurrence(roller_arm, (placement(z=-max(near, near + towards * ARM)),))
    yield Occurrence(_ROLLER_PART, (placement(-arm, 0.0, -side - (FACE - side_play(FACE)) / 2),), turning=True)
    head = placement(
        -arm, 0.0, -side + towards * (FACE / 2 + HEAD), about=(0.0, 1.0, 0.0), angle=(1 + towards) * turn / 4
    )
    yield Occurrence(_PIN_PART, (head,))
    for number, rod in enumerate(by.grippers):
        long = _length(rod, by)
        shape = Prism(Profile(hull_of_circles(EYE, TIP, 1j * long), hole), ARM)
        title = f"collar's arm {number + 1} of the {name} jaws"
        part = Part(part_id(f"{name}-arm-{number + 1}"), title, "machined link", shape, STEEL)
        yield Occurrence(part, (placement(z=-rod.real - ARM / 2),))


_ROLLER_PART = Part(
    part_id("jaw-roller"),
    "roller of the jaws",
    "pin or bush",
    tube(ROLLER, (ROLLER - PIN) / 2, FACE - side_play(FACE)),
    STEEL,
)
_PIN_PART = Part(
    part_id("jaw-roller-pin"),
    "pin of the jaws' roller",
    "turned part",
    stepped((PIN_HEAD, HEAD), (PIN, FACE + ARM)),
    STEEL,
)


def _collar(weaver: Weaver, by: Rocker, name: str, along: float) -> RigidBody:
    """A collar with its peg and wire in a gripper's frame; along: where its middle is [m from the warps]."""
    collar, peg, wire = _collar_parts(weaver, by.track)
    middle = along - weaver.tool_bodies.tip(name)
    about = placement(z=middle, about=(0.0, 0.0, 1.0), angle=turn / 2 if name == LEFT else 0.0)
    parts = (
        Occurrence(collar, (placement(z=middle - GROOVE / 2 - WALL),)),
        Occurrence(peg, (about.after(placement(y=wire_of(weaver.params) / 2)).after(UPRIGHT),)),
        Occurrence(wire, (placement(z=JAW if name == CENTRE else 0.0),)),
    )
    return RigidBody(collar_body(name), parts, name, Joint(JointKind.SLIDE))


@lru_cache(maxsize=8)
def _collar_parts(weaver: Weaver, track: str) -> tuple[Part, Part, Part]:
    """The collar on a gripper, the wire that it pulls, from the gripper's tip to it, and the peg brazed to both."""
    params, side = weaver.params, track == SIDE_GRASP
    kind = "side" if side else "centre"
    bore = circle(0j, params.finger / 2) if side else rectangle(params.finger, params.finger)
    flange, hub = (Profile(circle(0j, size / 2), (bore,)) for size in (FLANGE, HUB))
    flanges = Placed(Prism(flange, WALL), (placement(), placement(z=GROOVE + WALL)))
    ring = Sum((flanges, Placed(Prism(hub, GROOVE), (placement(z=WALL),))))
    begin = weaver.tool_bodies.tip(LEFT) if side else weaver.tool_bodies.tip(CENTRE) + JAW
    diameter, long = wire_of(params), rocker(weaver, track).axle.real + HUB / 2 - begin
    collar = Part(part_id(f"{kind}-collar"), f"collar of the {kind} jaws", "turned part", ring, STEEL)
    title, shape = f"wire of the {kind} jaws", bar(diameter, long)
    wire = Part(wire_id(track), title, "pin or bush", shape, STEEL)
    title, shape = f"peg of the {kind} jaws' wire", bar(diameter - PLAY, (params.finger - diameter) / 2)
    joins = collar.id, wire.id
    peg = Part(part_id(f"{kind}-peg"), title, "pin or bush", shape, STEEL, joins=joins, throat=BRAZED)
    return collar, peg, wire


def slotted(weaver: Weaver, gripper: Occurrence) -> Occurrence:
    """A gripper with the slot in its bar in which the peg of the jaws' wire moves; another tool as it is."""
    track = {SIDE_GRIPPER: SIDE_GRASP, CENTRE_GRIPPER: CENTRE_GRASP}.get(gripper.part.id)
    return gripper if track is None else replace(gripper, part=_slotted(weaver, track, gripper.part))


@lru_cache(maxsize=8)
def _slotted(weaver: Weaver, track: str, gripper: Part) -> Part:
    """The bar, the first member, of three lengths, the second open above its bore over the collar's motion."""
    names = (LEFT, RIGHT) if track == SIDE_GRASP else (CENTRE,)
    middle, half, lifts = rocker(weaver, track).axle.real, wire_of(weaver.params) / 2, (0.0, weaver.cam(track).lift)
    ends = [
        middle + float(drawn(weaver, track, number, lift)) - weaver.tool_bodies.tip(name)
        for number, name in enumerate(names)
        for lift in lifts
    ]
    outer, shape = weaver.params.finger / 2, gripper.shape
    assert isinstance(shape, Sum)
    rod, *others = shape.members
    begin = float(rod.positions[0].origin[2])
    end = begin + float(shape_box(rod.shape)[1][2])
    if track == SIDE_GRASP:
        lean = math.asin(half / outer)
        points = outer * np.exp(1j * np.array([turn / 4 + lean, turn / 2, -turn / 4, 0.0, turn / 4 - lean]))
        rise, quarter = math.tan((turn / 4 - lean) / 4), math.tan(turn / 16)
        bulges = [rise, quarter, quarter, rise]
    else:
        points = outer * np.array([1j - half / outer, -1 + 1j, -1 - 1j, 1 - 1j, 1 + 1j, 1j + half / outer])
        bulges = [0.0] * 5
    below = half * np.array([1.0, -1j, -1.0])
    slot = Contour(np.concatenate([points, below]), np.array([*bulges, 0.0, *[-math.tan(turn / 16)] * 2, 0.0]))
    marks = [begin, min(ends) - half - PLAY, max(ends) + half + PLAY, end]
    square = Profile(rectangle(2 * outer, 2 * outer), (circle(0j, half),))
    lengths = [high - low for low, high in pairwise(marks)]
    round_ = track == SIDE_GRASP
    bars = [tube(2 * outer, outer - half, long) if round_ else Prism(square, long) for long in lengths]
    bars[1] = Prism(Profile(slot), lengths[1])
    placed = (Placed(own, (placement(z=low),)) for own, low in zip(bars, marks, strict=False))
    return replace(gripper, shape=Sum((*placed, *others)))


def opened(weaver: Weaver, track: str, lift: RealField) -> FloatArray:
    """Angle of the jaws' fingers [rad] at lifts of their follower [m], 0 when they are closed."""
    long = _hinge(weaver, track == SIDE_GRASP)
    length = long.length - long.root
    widest = math.asin(min(weaver.params.jaw / length, 0.5)) if length > 0 else 0.0
    return np.asarray(widest * (1 - lift / weaver.cam(track).lift))


def _hinge(weaver: Weaver, side: bool) -> JawHinge:
    """The hinge of the side or the centre jaws."""
    return JawHinge(weaver.tool_bodies.jaw if side else JAW, weaver.params.finger)


def _finger(weaver: Weaver, name: str) -> RigidBody | None:
    """The finger at a gripper's end, in the gripper's frame, open; None where its arm is too short."""
    side = name != CENTRE
    hinge, level = _hinge(weaver, side), weaver.params.finger / 4
    if hinge.length <= 0:
        return None
    angle = float(opened(weaver, SIDE_GRASP if side else CENTRE_GRASP, 0.0))
    if side:
        half_turn = placement(about=(0.0, 0.0, 1.0), angle=math.pi if name == LEFT else 0.0)
        rest = half_turn.after(placement(weaver.grippers.arm - hinge.length + hinge.root, level))
    else:
        rest = placement(0.0, level, JAW - hinge.root).after(TO_THE_TIP)
    position = rest.after(placement(about=(0.0, 0.0, 1.0), angle=angle))
    return RigidBody(
        finger_body(name), (Occurrence(_finger_part(weaver, side)),), name, Joint(JointKind.PIN), (position,)
    )


@lru_cache(maxsize=8)
def _finger_part(weaver: Weaver, side: bool) -> Part:
    kind, shape = "side" if side else "centre", _hinge(weaver, side).finger
    title = f"finger of the {kind} jaws"
    return Part(part_id(f"{kind}-finger"), title, "machined link", shape, STEEL)


def jaw_springs(weaver: Weaver, track: str) -> tuple[Occurrence, ...]:
    """The springs of the jaws on their grippers, before the carriage, in its axes."""
    part = spring_part(weaver, track)
    if part is None:
        return ()
    by = rocker(weaver, track)
    front = by.axle.real + _before(weaver, track) - shortest(weaver, track)
    return (Occurrence(part, tuple(placement(rod.real, rod.imag, front) for rod in by.grippers)),)
