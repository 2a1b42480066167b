"""The drive of a head along its rail: a motor on the head, whose pulley draws it along the heads' belt.

    F = m a + f,   f = s + mu P            a of a step, P load of the guide, s and mu drag and friction of its carriages
    T = F (n + 1) / 2                      tension of the belt at rest, so that n heads leave none of it slack
    T' = F (n + 1)                         greatest tension, where all heads step at once
    e = f l / 4 c                          lag of a head in the middle of a belt of the length l and the stiffness c

Heads keep to their shares of the row, so that at worst head k takes 1 - k / n of its force from one end.
                                                                             [two springs in parallel; derived]
"""

import math
from collections.abc import Iterator

from ilmek.elements.columns import STEEL
from ilmek.elements.linear_guides import LinearGuide
from ilmek.elements.motors import MOTORS, Motor, smallest_motor
from ilmek.machines.weaver.carriage_belt import ASIDE, BELT, CLAMP, LOOP, RADIUS, ROLLER, TEETH, loop
from ilmek.machines.weaver.carriage_guide import carriages, guide_load
from ilmek.machines.weaver.case import ALUMINIUM
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import BEFORE_MAGAZINE, RAIL_AXIS
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, Shape, bar, box, rectangle, tube
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle, polygon
from ilmek.records import record
from ilmek.report import Check, at_most, must
from ilmek.sentences import Sentence
from ilmek.units import format_quantity, in_mm, mm, turn

CARRIAGE_MOTOR, CARRIAGE_PULLEY, BELT_LOOP = part_id("carriage-motor"), part_id("carriage-pulley"), part_id("belt-loop")
HEADS_BELT, BELT_CLAMP, BELT_COVER = (f"automated-loom/{name}" for name in ("heads-belt", "belt-clamp", "belt-cover"))
"""Ids of the parts: on the head, and on the rail."""

DRAG, FRICTION = 3.0, 0.002
"""Drag of the seals of a guide carriage [N], and friction of its balls; usual values of makers."""

SERVICE = 1.4
"""Service factor of the belt's teeth; usual practice."""

PULLEY_AT = 16.5 * mm
"""Axis of the pulley before the end of the bracket [m]: its motor stands between magazine and rail."""

PLATE, PLAY = 5 * mm, 2 * mm
"""Thickness of the motor's plate, and room under and over the belt [m]; assumed by this project, as all sizes here."""

AXLE, HUB_WALL, UNDER_MOTOR = 8 * mm, 4.5 * mm, 0.5 * mm
"""Diameter of the rollers' axles, wall of the pulley's hub, and its room under the motor [m]."""

BLOCK = 20 * mm, 12 * mm
"""Width and depth of a block under the plate [m]."""

BEHIND = PULLEY_AT + BLOCK[1] / 2
"""From the pulley's axis back to the middle of a block [m]; it ends with the bracket, behind the carriages."""

PLATE_BEGIN = PULLEY_AT - BEHIND - BLOCK[1] / 2
"""Rear edge of the motor's plate before the end of the bracket [m]."""

GRIP = 6 * mm
"""Thickness of a clamp's plate [m]: two screws M2 of the guide bar have their threads in it."""

ROUNDED, SLOWEST = 0.98, 0.1
"""Share of an acceleration with which a narrower motor would be enough, and least share of the given one; assumed."""

ROLLER_MASS = 0.04
"""Of a roller with its ball bearing [kg]; makers differ by some grams."""


@record
class CarriageDrive:
    """The drive of a head.

    drag, force  at rest and in a step [N]      width  of the belt, low: its lower edge over the rail's axis [m]
    motor        None where none of the table is enough
    """

    drag: float
    force: float
    width: float
    low: float
    motor: Motor | None

    @property
    def high(self) -> float:
        """Lower side of the motor's plate over the rail's axis [m]."""
        return self.low + self.width + PLAY


def carriage_drive(weaver: Weaver, mass: float, guide: LinearGuide) -> CarriageDrive:
    """The drive of a head of a mass without its motor [kg] on a guide; where it is given, the mass is that."""
    params, seals = weaver.params, DRAG * carriages(weaver, guide)

    def moving(motor: Motor | None) -> CarriageDrive:
        whole = params.head_mass or mass + (motor.mass if motor else 0.0)
        drag, stepped_drag = (
            seals + FRICTION * guide_load(weaver, whole, guide, acceleration)
            for acceleration in (0.0, params.carriage_acceleration)
        )
        force = stepped_drag + whole * params.carriage_acceleration
        chosen = smallest_motor(force * RADIUS, params.carriage_speed / RADIUS)
        low = guide.block / 2 + PLAY + catalogue.RIM + catalogue.BESIDE
        return CarriageDrive(drag, force, _width(weaver, drag), low, chosen)

    return moving(moving(None).motor)


def _width(weaver: Weaver, drag: float) -> float:
    """The narrowest belt with which the head's lag is within the error of the opener; the widest where none is [m]."""
    widths = BELT.widths
    enough = (width for width in widths if _lag(weaver, drag, width) <= weaver.params.opener.placing)
    return next(enough, widths[-1])


def _lag(weaver: Weaver, drag: float, width: float) -> float:
    """Lag of a head in the middle of the row behind its motor [m]."""
    return drag * (weaver.belt_length - 2 * CLAMP) / (4 * BELT.stiffness * width)


def drive_parts(weaver: Weaver, drive: CarriageDrive) -> Iterator[Occurrence]:
    """What is on the head: motor on its plate and blocks, pulley, rollers on their axles, the belt between these."""
    about = placement(0.0, weaver.shape.rail, weaver.shape.front + PULLEY_AT)
    torque, speed = drive.force * RADIUS, weaver.params.carriage_speed / RADIUS
    shaft = catalogue.motor_shaft(drive.motor), drive.width + PLAY + PLATE + catalogue.BESIDE + catalogue.RIM
    motor = catalogue.motor(CARRIAGE_MOTOR, "motor of a carriage", drive.motor, torque, speed, shaft=shaft)
    flange = about.after(placement(y=drive.high + PLATE, about=(1.0, 0.0, 0.0), angle=turn / 2))
    yield Occurrence(motor, (flange.after(UPRIGHT),))
    half, tall = ASIDE + AXLE, drive.high - RAIL_AXIS / 2
    behind, before = BEHIND + BLOCK[1] / 2, max(ROLLER, catalogue.face_of(motor) / 2)
    outline = rectangle(behind + before, 2 * half).points + (before - behind) / 2
    window = circle(0j, BELT.belt.tip_radius(TEETH) + catalogue.RIM_HEIGHT + UNDER_MOTOR)  # the pulley comes through it
    plate = Prism(Profile(polygon(outline), (window,)), PLATE)
    yield _made(part_id("drive-plate"), "plate of a carriage's motor", plate, _upright(about, drive.high))
    back = about.after(placement(z=-BEHIND))
    block = box(BLOCK[1], BLOCK[0], tall)
    yield _made(
        part_id("drive-block"),
        "block under that plate",
        block,
        *_upright_pair(back, RAIL_AXIS / 2, half - BLOCK[0] / 2),
    )
    yield Occurrence(_pulley(drive), (_upright(about, drive.low - catalogue.BESIDE),))
    aside = _upright_pair(about, drive.low, ASIDE)
    ring, name = (
        tube(2 * ROLLER, ROLLER - AXLE / 2, drive.width),
        f"idler {in_mm(2 * ROLLER)}, {in_mm(drive.width)} wide",
    )
    bought = Bought(name, ROLLER_MASS)
    yield Occurrence(
        bought_part(part_id("belt-roller"), "roller of the heads' belt", "bearing", ring, bought),
        aside,
    )
    axle = Part(
        part_id("roller-axle"), "axle of such a roller", "pin or bush", bar(AXLE, drive.high - drive.low), STEEL
    )
    yield Occurrence(axle, aside)
    about_pulley = _belt(
        BELT_LOOP, "heads' belt about a pulley", Prism(Profile(loop()), drive.width), drive.width, LOOP, of=HEADS_BELT
    )
    yield Occurrence(about_pulley, (_upright(about, drive.low),))


def _pulley(drive: CarriageDrive) -> Part:
    """The pulley, its hub under the motor, so that both come through the plate together."""
    bore = catalogue.motor_shaft(drive.motor)
    hub = bore + 2 * HUB_WALL, PLAY + PLATE - UNDER_MOTOR - catalogue.BESIDE - catalogue.RIM
    title, edge = "pulley of a carriage", circle(0j, bore / 2)
    return catalogue.toothed_pulley(CARRIAGE_PULLEY, title, BELT.belt, TEETH, drive.width, edge, hub)


def motor_corner(weaver: Weaver, drive: CarriageDrive) -> complex:
    """Upper corner in front of the motor on a head that knots, in the side view [m]."""
    face, long = (
        (drive.motor.face, drive.motor.length) if drive.motor else (catalogue.SPECIAL_FACE, 2 * catalogue.SPECIAL_FACE)
    )
    at = complex(weaver.shape.front + PULLEY_AT, weaver.shape.rail)
    return at + complex(face / 2, drive.high + PLATE + long)


def drive_mass(weaver: Weaver, drive: CarriageDrive) -> float:
    """Mass of what the drive adds to the head [kg]."""
    return math.fsum(len(drive_part.positions) * drive_part.part.mass for drive_part in drive_parts(weaver, drive))


def rail_belt(weaver: Weaver, drive: CarriageDrive, top: float, heads: int) -> Iterator[Occurrence]:
    """The belt of some heads on its straight line along the rail, and its clamps, which stand at a height [m].

    In the axes of the rail, 0 in its middle: y from its axis, z from its back to the front. A screw on one of the
    clamps sets the tension. Beside a pulley the belt is drawn straight, too.
    """
    long, depth = weaver.belt_length, PULLEY_AT + ROLLER - RAIL_AXIS
    straight = box(drive.width, BELT.height, long)
    line = placement(-long / 2, drive.low + drive.width / 2, depth + BELT.height / 2).after(ALONG_WIDTH)
    whole = f"one length, {format_quantity(long + heads * LOOP, 'm', 4)}, loops at {heads} pulleys included"
    belt = _belt(HEADS_BELT, "belt of the heads", straight, drive.width, long, whole)
    yield Occurrence(belt, (line,))
    under, starts = drive.low + drive.width, (-long / 2, long / 2 - CLAMP)
    for name, title, foot, at in (
        (BELT_CLAMP, "toothed plate of the belt's clamp", top, depth + BELT.height + GRIP / 2),
        (BELT_COVER, "cover of the belt's clamp", drive.low, depth - GRIP / 2),
    ):
        places = (placement(x, (foot + under) / 2, at).after(ALONG_WIDTH) for x in starts)
        teeth = round(CLAMP / BELT.belt.pitch)
        profile = Sentence("sheet.belt-teeth", belt=BELT.belt.name, teeth=str(teeth), pitch=in_mm(BELT.belt.pitch))
        notes = (profile,) if name == BELT_CLAMP else ()
        yield _made(name, title, box(under - foot, GRIP, CLAMP), *places, notes=notes)


def slower(weaver: Weaver, drive: CarriageDrive) -> float:
    """Acceleration of the carriage [m/s²] with which its motor has room behind the magazine: the given one, or less."""
    params = weaver.params
    if drive.motor is not None and drive.motor.face / 2 <= PULLEY_AT + BEFORE_MAGAZINE - params.clearance:
        return params.carriage_acceleration
    narrow = [own for own in MOTORS if own.face / 2 <= PULLEY_AT + BEFORE_MAGAZINE - params.clearance]
    strong = [own.torque for own in narrow if own.speed >= params.carriage_speed / RADIUS]
    left = max(strong, default=0.0) / RADIUS / drive.force  # drag falls with the acceleration, so this is enough
    return max(ROUNDED * left, SLOWEST) * params.carriage_acceleration


def drive_checks(weaver: Weaver, drive: CarriageDrive) -> tuple[Check, ...]:
    """The motor, the belt's teeth on its pulley, and the lag of the head."""
    cure, parts = "set a lower weaver.carriage_acceleration, or lighter tools", (CARRIAGE_PULLEY, BELT_LOOP)
    allowed = (BELT.belt.pull or 0.0) * (TEETH // 2) * drive.width
    source = f"{BELT.belt.name}, {TEETH // 2} teeth in mesh, service factor {SERVICE:g}"
    needed = f"motors of the table; {format_quantity(drive.force * RADIUS, 'Nm', 3)}"
    return (
        must("motor of the carriage", drive.motor is not None, needed).with_cure(cure, CARRIAGE_MOTOR),
        at_most("pull of the heads' belt", SERVICE * drive.force, allowed, "N", source).with_cure(cure, *parts),
        at_most(
            "lag of a head on its belt",
            _lag(weaver, drive.drag, drive.width),
            weaver.params.opener.placing,
            "mm",
            f"parameter opener.placing; {in_mm(drive.width)} wide, drag {format_quantity(drive.drag, 'N', 3)}",
        ).with_cure("set fewer tools or colours, or a narrower carpet", *parts),
    )


def tension_check(drive: CarriageDrive, heads: int) -> Check:
    """The cords of the belt of a number of heads, which all step at once."""
    rest = format_quantity(drive.force * (heads + 1) / 2, "N", 3)
    return at_most(
        "tension of the heads' belt",
        drive.force * (heads + 1),
        BELT.tension * drive.width,
        "N",
        f"allowed by makers for {BELT.belt.name}, {in_mm(drive.width)} wide; at rest {rest}",
    ).with_cure("set fewer heads, or a lower weaver.carriage_acceleration", HEADS_BELT, BELT_CLAMP)


def _belt(  # noqa: PLR0917
    name: str, title: str, shape: Shape, wide: float, long: float, data: str = "", of: str = ""
) -> Part:
    """Belt of a length [m], or a piece of another, which has that besides."""
    row = f"{BELT.belt.name}, {in_mm(wide)} wide"
    bought = Bought(
        row, BELT.belt.mass * wide * long, length=long, data=data or "included in that length, not cut", piece_of=of
    )
    return Part(name, title, "belt", shape=shape, purchase=bought)


def _upright(about: Placement, height: float) -> Placement:
    """A part in plan, its x to the front, its y along the row, at a height."""
    return about.after(placement(y=height)).after(UPRIGHT)


def _upright_pair(about: Placement, height: float, aside: float) -> tuple[Placement, ...]:
    return tuple(_upright(about.after(placement(x)), height) for x in (-aside, aside))


def _made(name: str, title: str, shape: Shape, *positions: Placement, notes: tuple[str, ...] = ()) -> Occurrence:
    return Occurrence(Part(name, title, "machined link", shape, ALUMINIUM, notes=notes), positions)
