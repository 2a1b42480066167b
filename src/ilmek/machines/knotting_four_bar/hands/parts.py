"""The hands in space: two equal ones face each other, their fingers in neighbouring planes, on two plates with columns.

Axes are those of the plane of the hands: u along it, y towards the pile, n across it; 0 is the middle of the knot. The
left hand lies below n = 0 with its plate lowest, z = n + `middle`. The right hand is the left one turned half about y.
The fingers' middle planes are e apart, at n = -e/2 and +e/2; for x = u cos b - n sin b the hands lie e tan b apart
along u, that both fingers come up in the same gap of the warps.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.own_machine import FlatMember, OwnMachine
from ilmek.elements.materials import MATERIALS
from ilmek.elements.micro_servos import MicroServo
from ilmek.linkage.model import GROUND
from ilmek.machines.knotting_four_bar.hands.batch import BEARING, COLUMNS, EYE
from ilmek.machines.knotting_four_bar.hands.hand import TyingHand
from ilmek.machines.knotting_four_bar.hands.section import FINGER, FOOT
from ilmek.machines.link_tree import body_id, inertia_of
from ilmek.machines.own_linkage.axes import PinAxis
from ilmek.machines.own_linkage.construction import Construction, construction
from ilmek.machines.own_linkage.shafts import housing_length, shaft_lengths, shaft_seat
from ilmek.machines.own_linkage.sizes import usual_diameter
from ilmek.machines.own_linkage.tree import own_tree
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.shapes import Placed, Prism, Sum, bar, box, shape_box, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import rounded_hull
from ilmek.records import computed, record
from ilmek.report import Contour, Hole
from ilmek.synthesis.four_bar import TRACER
from ilmek.units import mm

NAME = "knotting-four-bar"
STAND, SERVO = f"{NAME}/stand", f"{NAME}/servo"

LINK = FlatMember(6 * mm, 3 * mm, "aluminium alloy")
"""Section and material of the links; assumed by this project."""

STEEL = MATERIALS["structural steel"]

PILLAR, OVER, CLEAR = 5 * mm, 1 * mm, 1 * mm
"""Diameter of a finger's pillar, its plane over all other parts of the hand, columns off what moves [m]; assumed."""

COLUMN, SERVO_SCREW, PLATE, COUPLING = 10 * mm, 6 * mm, 3 * mm, 9 * mm
"""Diameters of columns and of a servo's pillars, thickness of its plate, diameter of its coupling [m]; assumed."""


@record
class HandParts:
    """A hand as it is made: its construction without finger, and heights above the face of its plate [m].

    finger  under side of the finger      middle  of the plane half way between both fingers
    """

    hand: TyingHand
    built: Construction
    bare: Tree
    finger: float
    middle: float

    finger_clearance = computed(
        "mm", "least distance of the fingers from all warps, sure over the whole stroke", lambda it: it.hand.clearance
    )
    finger_radius = computed("mm", "of the fingers' arc, its middle line", lambda it: it.hand.radius)
    finger_depth = computed("mm", "of the fingers' path behind the warps' axes", lambda it: it.hand.depth)
    finger_bent = computed("mm", "bending of a finger's tip in its plane by the yarn", lambda it: it.hand.bent)
    hand_links = computed(
        "", "ground, crank, coupler, rocker of a hand, SI", lambda it: it.hand.four_bar.lengths._asdict(), shown=False
    )
    crank_swing = computed("deg", "of a hand's crank", lambda it: it.hand.swing)
    hand_transmission = computed("deg", "least transmission angle of a hand", lambda it: it.hand.transmission)
    hands_length = computed("mm", "of both hands along their plane", lambda it: 2 * reaches(it)[0])
    hands_height = computed(
        "mm", "over the warps' axes, with plates and columns", lambda it: _column_feet(it)[0].imag + BEARING
    )
    hands_depth = computed("mm", "across the plane over both plates, without servos", lambda it: 2 * plate_back(it))
    knot_time = computed("s", "of a stroke to and fro", lambda it: 2 * it.hand.section.task.stroke_time)
    yarn_led = computed("mm", "path of a finger's tip, by which an end of the yarn is led", lambda it: it.hand.led)

    def inertias(self) -> dict[str, Inertia]:
        """Of the moving bodies, the finger with its coupler."""
        bodies = {body: self.bare.body(body_id(NAME, body)) for body in self.built.machine.mechanism.moving}
        extra = {"coupler": (finger_occurrence(self),)}
        return {name: inertia_of((*body.occurrences, *extra.get(name, ()))) for name, body in bodies.items()}


@lru_cache(maxsize=64)
def hand_parts(hand: TyingHand) -> HandParts | None:
    """The hand as it is made; None where nothing keeps its links apart. Raises MechanismError for links too short."""
    mechanism, motion = hand.four_bar.mechanism(), hand.stroke(97)
    machine = OwnMachine(mechanism, members=dict.fromkeys(mechanism.moving, LINK))
    built = construction(machine, motion, name=NAME)
    if not built.layering.found:
        return None
    bare, task = own_tree(built), hand.section.task
    finger = max(_tops(bare)) + OVER
    return HandParts(hand, built, bare, finger, finger + task.finger_thickness + task.clearance)


def _tops(tree: Tree) -> Iterator[float]:
    """Upper ends of all parts of a hand [m]."""
    for body in tree.bodies:
        for occurrence in body.occurrences:
            assert occurrence.part.shape is not None
            corners = np.array([*map(np.array, shape_box(occurrence.part.shape))])
            yield from (float(np.max(position.points(corners)[:, 2])) for position in occurrence.positions)


def finger_occurrence(made: HandParts) -> Occurrence:
    """The finger in the coupler's frame: spigot in the coupler, pillar, and the blade on it."""
    hand, built, task = made.hand, made.built, made.hand.section.task
    foot = hand.four_bar.tracer_on_coupler
    assert foot is not None
    low, top, hole = built.bottoms["coupler"], built.top("coupler"), usual_diameter(LINK.width)
    members = (
        Placed(bar(hole, top - low), (placement(foot.real, foot.imag, low),)),
        Placed(bar(PILLAR, made.finger - top), (placement(foot.real, foot.imag, top),)),
        Placed(Prism(Profile(_blade(hand)), task.finger_thickness), (placement(z=made.finger),)),
    )
    part = Part(f"{NAME}/finger", "finger with its pillar", "machined link", Sum(members), FINGER)
    return Occurrence(part)


def _blade(hand: TyingHand) -> Contour:
    """Outline of the blade in the coupler's frame: an arc with round ends, from foot to tip and back."""
    half = hand.section.task.finger_width / 2
    centre, low = hand.on_coupler(hand.centre), hand.tip
    out = (low - centre) / abs(low - centre)
    back = out * np.exp(-1j * hand.span)
    corners = [
        centre + radius * side
        for radius, side in (
            (hand.radius + half, back),
            (hand.radius + half, out),
            (hand.radius - half, out),
            (hand.radius - half, back),
        )
    ]
    bulge = math.tan(hand.span / 4)
    return Contour(np.array(corners), np.array([bulge, 1.0, -bulge, 1.0]))


@lru_cache(maxsize=16)
def hands_tree(made: HandParts, servo: MicroServo | None) -> Tree:
    """Both hands with their servos on their plates and columns, at the beginning of a stroke."""
    feet = _column_feet(made)
    bodies = [RigidBody(STAND, tuple(_columns(made, feet)), joint=Joint(JointKind.MISSING))]
    own = {
        body_id(NAME, GROUND): tuple(_standing(made, made.bare.body(body_id(NAME, GROUND)).occurrences, feet, servo)),
        body_id(NAME, "coupler"): (*made.bare.body(body_id(NAME, "coupler")).occurrences, finger_occurrence(made)),
    }
    closures = []
    for suffix, position in _sides(made).items():
        for body in made.bare.bodies:
            parts, joint = own.get(body.id, body.occurrences), body.joint
            if body.id == body_id(NAME, GROUND):
                bodies.append(RigidBody(body.id + suffix, parts, STAND, Joint(), (position,)))
                continue
            if body.id == body_id(NAME, "crank") and servo is not None:
                joint = replace(joint, motor=SERVO)
            bodies.append(RigidBody(body.id + suffix, parts, body.parent + suffix, joint, body.positions))
        for closure in made.bare.closures:
            first, second = closure.bodies
            closures.append(replace(closure, bodies=(first + suffix, second + suffix)))
    return Tree(tuple(bodies), tuple(closures))


def _sides(made: HandParts) -> dict[str, Placement]:
    """The frames of both hands, by the suffix of their bodies."""
    left = placement(-made.hand.section.shift, 0.0, -made.middle)
    return {"-left": left, "-right": placement(about=(0.0, 1.0, 0.0), angle=math.pi).after(left)}


def reaches(made: HandParts) -> tuple[float, float]:
    """Greatest distance from the knot's middle along u, and height over the warps, of what moves in a hand [m]."""
    hand, motion = made.hand, made.hand.stroke(97)
    angles = np.linspace(0.0, hand.span, 40)
    arc = np.array([hand.on_coupler(complex(at)) for at in hand.centre - 1j * hand.radius * np.exp(-1j * angles)])
    finger = motion.origin("coupler")[:, None] + motion.direction("coupler")[:, None] * arc
    pins = (("A", EYE), ("B", EYE), (TRACER, FOOT))
    rooms = [(np.asarray(motion.point("coupler", name).position), room) for name, room in pins]
    rooms.append((np.asarray(finger), hand.section.task.finger_width / 2))
    wide = max(float(np.max(np.abs(points.real - hand.section.shift))) + room for points, room in rooms)
    return wide, max(float(np.max(points.imag)) + room for points, room in rooms)


def _column_feet(made: HandParts) -> tuple[complex, complex]:
    """Axes of the columns in the frame of the knot [m]: over all that moves, as far apart as the pivots at least."""
    pivots = np.array([made.hand.four_bar.a0, made.hand.four_bar.b0]) - made.hand.section.shift
    wide = max(float(np.max(np.abs(pivots.real))), 2 * COLUMN)
    high = max(reaches(made)[1], float(np.max(pivots.imag)) + BEARING) + COLUMNS - BEARING
    return complex(-wide, high), complex(wide, high)


def plate_back(made: HandParts) -> float:
    """From the middle plane to the back of a plate [m]; servos stand behind it."""
    return made.middle + made.built.thickness(GROUND)


def _columns(made: HandParts, feet: tuple[complex, complex]) -> Iterator[Occurrence]:
    """The columns between both plates."""
    length = 2 * made.middle
    part = Part(
        f"{NAME}/column",
        "column between the plates",
        "turned part",
        bar(COLUMN, length),
        STEEL,
    )
    yield Occurrence(part, tuple(placement(at.real, at.imag, -made.middle) for at in feet))


def _standing(
    made: HandParts, bare: tuple[Occurrence, ...], feet: tuple[complex, complex], servo: MicroServo | None
) -> Iterator[Occurrence]:
    """What stands of a hand: its plate instead of the rectangular one, the rest as built, the servo behind it."""
    rows = _servo_pillars(made, servo) if servo else ()
    for occurrence in bare:
        if occurrence.part.id == body_id(NAME, GROUND):
            yield Occurrence(_base(made, occurrence.part, feet, rows), occurrence.positions)
        else:
            yield occurrence
    if servo is not None:
        yield from _servo_parts(made, servo, rows)


def _base(made: HandParts, old: Part, feet: tuple[complex, complex], pillars: tuple[complex, ...]) -> Part:
    """The plate of a hand about its pivots and the columns, over the standoff."""
    pivots = [made.hand.four_bar.a0, made.hand.four_bar.b0]
    local = [foot + made.hand.section.shift for foot in feet]
    outline = rounded_hull(np.array([*pivots, *local, *pillars]), BEARING)
    assert isinstance(old.shape, Prism)
    holes = [Hole(complex(*seat.position.origin[:2]), seat.size / 2) for seat in old.seats.values()]
    holes += [Hole(at, SERVO_SCREW / 4) for at in pillars]
    shape = Prism(drilled(outline, holes), old.shape.length)
    return replace(old, shape=shape, title="plate of a hand")


def _driven(made: HandParts) -> PinAxis:
    """The axis of the crank's shaft."""
    return next(axis for axis in made.built.axes if axis.driven)


def _shaft_end(made: HandParts) -> float:
    """Depth of the driven shaft's end below the face of the plate [m]."""
    axis = _driven(made)
    return shaft_lengths(made.built, axis).stub + housing_length(made.built.studs[axis.name])


def _servo_pillars(made: HandParts, servo: MicroServo) -> tuple[complex, ...]:
    """Axes of both pillars of a servo's plate in the hand's frame [m]: beside it and the crank's housing, along u."""
    housing = shaft_seat(made.built.studs[_driven(made).name])[2]
    aside = max(servo.size[1] / 2 + SERVO_SCREW, housing / 2 + SERVO_SCREW / 2 + CLEAR)
    return made.hand.four_bar.a0 - aside, made.hand.four_bar.a0 + aside


def _servo_parts(made: HandParts, servo: MicroServo, pillars: tuple[complex, ...]) -> Iterator[Occurrence]:
    """Servo, its plate on two pillars, and the coupling to the crank's shaft."""
    at, end = made.hand.four_bar.a0, -_shaft_end(made)
    length, width, height = servo.size
    face, under = end - PLATE, -made.built.thickness(GROUND)
    shaft = made.built.studs[_driven(made).name].journal
    body = box(width, length, height)
    middle = placement(0.0, length / 4, -height)
    bought = Bought(servo.name, servo.mass, power=servo.power, drives=1)
    part = bought_part(SERVO, "servo of a crank", f"micro {servo.kind}", Sum((Placed(body, (middle,)),)), bought)
    yield Occurrence(part, (placement(at.real, at.imag, face - PLATE),))
    outline = rounded_hull(np.array(pillars), SERVO_SCREW)
    holes = [Hole(at, (COUPLING + CLEAR) / 2), *(Hole(one, SERVO_SCREW / 4) for one in pillars)]
    plate = Part(
        f"{NAME}/servo-plate",
        "plate of a servo",
        "machined link",
        Prism(drilled(outline, holes), PLATE),
        MATERIALS[LINK.material],
    )
    yield Occurrence(plate, (placement(z=face - PLATE),))
    pillar = Part(
        f"{NAME}/servo-pillar",
        "pillar of a servo's plate",
        "turned part",
        bar(SERVO_SCREW, under - face),
        MATERIALS[LINK.material],
    )
    yield Occurrence(pillar, tuple(placement(one.real, one.imag, face) for one in pillars))
    long = 2 * shaft
    coupling = Part(
        f"{NAME}/coupling",
        "coupling of servo and shaft",
        "turned part",
        tube(COUPLING, (COUPLING - shaft) / 2, long + 2 * PLATE),
        STEEL,
    )
    yield Occurrence(coupling, (placement(at.real, at.imag, end - 2 * PLATE),))
