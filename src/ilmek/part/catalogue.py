"""Bought parts from the rows of catalogues, each with the room that it takes: motors, reducers, bearings, guides."""

import math
from dataclasses import replace
from functools import lru_cache

from ilmek.elements.bearing_table import RollingBearing
from ilmek.elements.belts import BeltType
from ilmek.elements.columns import STEEL
from ilmek.elements.holding_brakes import brake_for
from ilmek.elements.locknuts import Locknut
from ilmek.elements.machine_screws import SOCKET_SCREWS, MachineScrew
from ilmek.elements.materials import MATERIALS
from ilmek.elements.motors import FLANGE_HOLES, STEPPER, Motor
from ilmek.elements.parallel_keys import KeyedEnd
from ilmek.elements.reducers import Reducer, flange_for
from ilmek.elements.springs import CompressionSpring
from ilmek.part.part import CLAMP, SET_SCREW, Bought, HolePattern, Part, Seat, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, box, disc, rectangle, shape_box, stepped, tube
from ilmek.part.tree import Occurrence, RigidBody
from ilmek.plane.contours import as_hole, as_keyed, bounds, circle, keyed_bore
from ilmek.report import Contour
from ilmek.units import format_quantity, in_mm, mm

HOLDING_BRAKE = "holding brake"
"""Kind by which a motor's brake is bought."""

SPECIAL_FACE = 80 * mm
"""Flange of a motor that is in no table [m]; assumed by this project."""

REDUCER_LENGTH = 1.2
"""Length of a reducer over its flange; assumed by this project."""

HOLLOW, WALL = 0.5 * mm, 5 * mm
"""Play of a turning key in the room of a reducer's hollow shaft, and least wall about it [m]; assumed."""

_REDUCER_FLANGE = 2.2
"""Thickness of a coaxial reducer's flanges over its screws' diameter: their heads are sunk in it; assumed."""

ADAPTER, _ADAPTER_FILLED = 0.3, 0.5
"""Length of a motor's adapter, with its coupling, over its face, and share of its room that is aluminium; assumed by
this project.
"""

_CORNERS = 4
"""Screws of a flange that stand in the corners of a square."""

BEFORE_KEY = 5 * mm
"""From the face that a reducer sits on to the key in its hollow shaft [m]; assumed by this project."""

SPECIAL_SHAFT = 19 * mm
"""Diameter of the shaft of a motor that is in no table [m]; assumed by this project."""

RIM, RIM_HEIGHT, BESIDE = 1 * mm, 1.5 * mm, 0.25 * mm
"""Thickness of a pulley's flange, its height over the teeth, its play beside the belt [m]; makers' usual sizes."""

_SET_SCREWS = ((14 * mm, 3 * mm), (30 * mm, 4 * mm), (50 * mm, 5 * mm), (math.inf, 6 * mm))
"""Largest hub, and thread of its set screw [m]: makers' usual sizes."""

_LOCKING = ((28 * mm, 27 * mm), (40 * mm, 25 * mm), (65 * mm, 30 * mm), (80 * mm, 35 * mm), (math.inf, 45 * mm))
"""Largest shaft, and how much larger the bore about its locking assembly is [m]: makers' usual sizes."""

FEEDBACK = "absolute multi-turn encoder"
"""What a motor of an axis has: its zero is set once, and the axis is homed without a switch of its own."""


def stroke_of(travel: float) -> str:
    """What the order of an axis states of its travel [m]: its length is the maker's.

    >>> stroke_of(0.25)
    'stroke at least 250 mm'
    """
    return f"stroke at least {in_mm(travel)}"


FLANGE = 14 * mm
"""Thickness of the flange of a bearing's housing [m]; makers differ by some millimetres."""


REAR_THREADS = "threads as in its flange also in its rear cover"
"""How a motor is ordered that stands on its rear cover."""


def motor(  # noqa: PLR0917
    name: str,
    title: str,
    row: Motor | None,
    torque: float,
    speed: float,
    together: int = 1,
    *,
    shaft: tuple[float, float] | None = None,
    rear: bool = False,
    standing: bool = False,
) -> Part:
    """A motor, which drives an axis of the control: its flange at z = 0, its shaft towards +z.

    together  how many of them move one body      shaft  diameter and length of its end in a hub [m]; None: not drawn
    row  of the table; None: a special servo for a torque [N m] at a speed [rad/s], priced by its power
    rear  it has a rear shaft end, for a brake or an encoder behind it
    standing  it stands on its rear cover, which is ordered with the threads of its flange
    """
    feedback = ", ".join((FEEDBACK, *["rear shaft end"] * rear, *[REAR_THREADS] * standing))
    holes = tuple(replace(own, tapped=True, faces=(-1,)) if standing else own for own in flange_holes(row))
    if row is not None:
        peak = "holding" if row.kind == STEPPER else "peak"
        data = f"{peak} {format_quantity(row.peak, 'Nm', 3)}, {_flange_of(row)}, {feedback}"
        bought = Bought(row.name, row.mass, power=row.power, drives=together, data=data, holes=holes)
        room, kind = box(row.face, row.face, row.length), row.kind
    else:
        required = f"to measure: {format_quantity(torque, 'Nm', 3)} at {format_quantity(speed, 'rpm', 3)}"
        bought = Bought(required, power=torque * speed, drives=together, holes=holes)
        room, kind = box(SPECIAL_FACE, SPECIAL_FACE, 2 * SPECIAL_FACE), "servo"
    stub = (Placed(bar(*shaft)),) if shaft else ()
    behind = Sum((Placed(room, (placement(z=-room.length),)), *stub))
    return bought_part(name, title, kind, behind, bought)


def adapted(
    name: str, title: str, drive: Part, side: float, flanges: tuple[Placement, ...]
) -> tuple[tuple[Occurrence, ...], tuple[Placement, ...]]:
    """The adapters with couplings between axes of a side [m] and motors or reducers with a larger flange; and where the
    flanges of these are then, that were at the ends of the axes, z into them. None before a smaller flange.
    """
    face, bought = face_of(drive), drive.purchase
    assert bought is not None
    if face <= side:
        return (), flanges
    (holes,) = (row for row in bought.holes if 1 in row.faces)
    own, long = replace(holes, tapped=True, faces=(-1,)), ADAPTER * face
    data = f"flange {in_mm(face)}, {_holes_text(own)}, for {bought.row}"
    room = box(face, face, long)
    mass = _ADAPTER_FILLED * room.volume * MATERIALS["aluminium alloy"].density
    row = Bought("motor adapter with coupling", mass, data=data, holes=(own,), drilled=True)
    behind = tuple(own.after(placement(z=-long)) for own in flanges)
    return (Occurrence(bought_part(name, title, "motor adapter", room, row), behind),), behind


def holding_brake(name: str, title: str, motor: Part, torque: float) -> Part:
    """The brake behind a motor, in its axes, that holds a torque at its shaft [N m]."""
    assert motor.shape is not None
    row, rear = brake_for(torque), float(shape_box(motor.shape)[0][2])
    room = Sum((Placed(bar(row.diameter, row.length), (placement(z=rear - row.length),)),))
    assert motor.purchase is not None
    bought = Bought(row.name, row.mass, power=row.power, data=f"built by its maker onto {motor.purchase.row}")
    return bought_part(name, title, HOLDING_BRAKE, room, bought, fixing="built onto its motor by the maker")


def brakes_of(body: RigidBody) -> dict[str, Part]:
    """The brakes in a body by the id of the motor behind which each is."""
    motors = {own.positions: own.part.id for own in body.occurrences if own.part.purchase and own.part.purchase.drives}
    return {motors[own.positions]: own.part for own in body.occurrences if own.part.process == HOLDING_BRAKE}


def motor_shaft(row: Motor | None) -> float:
    """Diameter of the shaft of a motor, or of one that is in no table [m]."""
    return row.shaft if row is not None else SPECIAL_SHAFT


def reducer(  # noqa: PLR0917
    name: str,
    title: str,
    by: Reducer,
    row: Motor | None,
    end: KeyedEnd | None = None,
    output: tuple[float, Sum] | None = None,
    *,
    least: float = 0.0,
) -> Part:
    """A reducer, priced by the power of its motor: from the motor's flange at z = 0 towards its output.

    end  of the shaft that its hollow shaft takes: the room of both is open
    output  of an angle reducer: diameter of its own shaft, and the shape of that across its input
    least  width of its flange [m]
    """
    given = max(by.output_torque(row.torque) if row else 0.0, end.torque if end else 0.0)
    motor_face = row.face if row else SPECIAL_FACE
    shaft, keyed, hollow = "" if output is None else f"output shaft {in_mm(output[0])}", 0.0, 0.0
    if end is not None:
        corner = complex(end.diameter / 2 + end.keyway.in_hub, end.keyway.width / 2)  # the key's
        hollow, keyed = abs(corner) + HOLLOW, BEFORE_KEY + end.length
        shaft = f"hollow shaft {in_mm(end.diameter)} H7, keyway DIN 6885-1"
    flange = flange_for(given, least, around := 2 * (hollow + WALL) if hollow else 0.0)
    face, behind, across = max(motor_face, flange.face), max(motor_face, around), output is not None
    thick, pitch = _REDUCER_FLANGE * SOCKET_SCREWS[flange.thread].diameter, flange.circle / math.sqrt(2)
    long = max(REDUCER_LENGTH * face, keyed + (0.0 if across else thick))
    ring, faces = flange.number if flange.number > _CORNERS else 0, (0,) if across else (1,)
    holes = HolePattern(pitch, pitch, flange.thread, ring=ring, tapped=across, faces=faces)
    bores = (circle(0j, hollow),) if hollow else ()
    room: Shape = Prism(Profile(rectangle(face, face), bores), long)
    if not across:  # screws from behind a flange at its output
        room = Sum(
            (
                Placed(box(behind, behind, thick)),
                Placed(Prism(Profile(circle(0j, flange.waist / 2), bores), long - 2 * thick), (placement(z=thick),)),
                Placed(Prism(Profile(rectangle(face, face), bores), thick), (placement(z=long - thick),)),
            )
        )
    motors = (f"output {format_quantity(given, 'Nm', 3)}", f"for a motor with {_flange_of(row)}") if row else ()
    threads = f"{_holes_text(holes)} at its output and in its sides" if across else _holes_text(holes)
    data = ", ".join((*filter(None, (shaft,)), f"flange {in_mm(face)}", threads, *motors))
    kind = f"right-angle {by.kind}" if across else by.kind
    both = holes, replace(*flange_holes(row), tapped=True, faces=(-1,))
    bought = Bought(f"{kind} {by.ratio:g}:1", flange.mass, power=row.power if row else 0.0, data=data, holes=both)
    return bought_part(name, title, "reducer", Sum((Placed(room), Placed(output[1]))) if output else room, bought)


def reducer_face(by: Reducer, row: Motor) -> float:
    """Width of the reducer of a motor, if it has a shaft of its own [m]."""
    return max(row.face, flange_for(by.output_torque(row.torque)).face)


def screwed_radius(driven: Part) -> float:
    """Radius about the axis of a reducer that a plate needs for its screws with their heads [m]."""
    assert driven.purchase is not None
    holes = driven.purchase.holes[0]
    return abs(complex(holes.across, holes.along)) / 2 + head_room(driven)


def head_room(driven: Part) -> float:
    """Room about the axis of a screw of a reducer for its head [m]."""
    assert driven.purchase is not None
    return SOCKET_SCREWS[driven.purchase.holes[0].thread].sink / 2 + mm


def _holes_text(holes: HolePattern) -> str:
    """Number, thread and circle of the holes of a flange."""
    circle_of_holes = in_mm(round(abs(complex(holes.across, holes.along)), 4))
    return f"{holes.number} {'threads' if holes.tapped else 'holes for'} {holes.thread} on ⌀{circle_of_holes}"


def _flange_of(row: Motor) -> str:
    (holes,) = flange_holes(row)
    return f"flange {in_mm(row.face)}, {_holes_text(holes)}, shaft {in_mm(row.shaft)}"


def toothed_pulley(  # noqa: PLR0917
    name: str,
    title: str,
    belt: BeltType,
    teeth: int,
    width: float,
    bore: Contour,
    hub: tuple[float, float] | None = None,
    *,
    flanged: bool = True,
    clamped: bool = False,
) -> Part:
    """A toothed pulley about z for a belt of a width [m], its teeth from z = 0, bought with its bore.

    With flanges its teeth are wider than the belt by `BESIDE` on both sides. Its hub, of a diameter and a length [m],
    is beyond its teeth, and has a set screw. A clamped one sits on its shaft by a tapered bush.
    """
    face, rim = (width + 2 * BESIDE, RIM) if flanged else (width, 0.0)
    members = [Placed(Prism(Profile(belt.pulley_outline(teeth), (bore,)), face))]
    if flanged:
        flange = Prism(disc(belt.tip_radius(teeth) + RIM_HEIGHT, bore), rim)
        members.append(Placed(flange, (placement(z=-rim), placement(z=face))))
    seats = {CLAMP: Seat(placement(), 2 * bounds(bore)[1].imag)} if clamped else {}
    if hub is not None:
        members.append(Placed(Prism(disc(hub[0] / 2, bore), hub[1]), (placement(z=face + rim),)))
        seats[SET_SCREW] = Seat(placement(z=face + rim + hub[1] / 2), set_screw(hub[0]))
    shape, keyed, hole = Sum(tuple(members)), as_keyed(bore), as_hole(bore)
    radius = keyed.radius if keyed else hole.radius if hole else 0.0
    words = (
        f"pulley {belt.name}, {teeth} teeth, {in_mm(width)} wide",
        *(("2 flanges",) if flanged else ()),
        *(("tapered bush",) if clamped else ()),
        f"bore {in_mm(2 * radius)}" + " H7" * (not clamped),
        *(("keyway DIN 6885-1",) if keyed else ()),
        *((f"set screw M{seats[SET_SCREW].size / mm:g}",) if hub is not None else ()),
    )
    bought = Bought(", ".join(words), shape.volume * MATERIALS["aluminium alloy"].density)
    return Part(name, title, "toothed pulley", shape=shape, purchase=bought, seats=seats)


def locking_assembly(name: str, title: str, shaft: float, width: float) -> Part:
    """A locking assembly between a shaft and a hub, about z from z = 0: diameter of the shaft, its width [m].

    Its rings are tightened by screws along the shaft, and hold the hub round and along it.
    """
    shape = tube(locked_bore(shaft), (locked_bore(shaft) - shaft) / 2, width)
    bought = Bought(f"locking assembly {shaft / mm:g} x {locked_bore(shaft) / mm:g}", shape.volume * STEEL.density)
    return Part(name, title, "fastener", shape=shape, purchase=bought, seats={CLAMP: Seat(placement(), shaft)})


def locked_bore(shaft: float) -> float:
    """Bore of a hub about a locking assembly on a shaft [m]: makers' sizes, 20 x 47 to 28 x 55 to 50 x 80 to 100 x 145.

    >>> [round(locked_bore(shaft * mm) / mm) for shaft in (20, 40, 50, 100)]
    [47, 65, 80, 145]
    """
    return shaft + next(more for most, more in _LOCKING if shaft <= most + 1e-9)


def set_screw(hub: float) -> float:
    """Thread of the set screw of a hub of a diameter [m]: M3 to 14 mm, then M4, M5 from 30 mm, M6 from 50 mm.

    >>> set_screw(0.02)
    0.004
    """
    return next(thread for most, thread in _SET_SCREWS if hub <= most + 1e-9)


def flange_holes(row: Motor | None) -> tuple[HolePattern, ...]:
    """The holes of the flange of a motor, or of one that is in no table."""
    pitch, thread, tapped = FLANGE_HOLES[row.face if row else SPECIAL_FACE]
    return (HolePattern(pitch, pitch, thread, tapped=tapped, faces=(1,)),)


def keyed_journal(end: KeyedEnd) -> Prism:
    """The end of a shaft about z from z = 0, with its groove towards +x; a second one opposite."""
    return Prism(Profile(keyed_bore(end.diameter / 2, end.keyway.width, -end.keyway.in_shaft, end.number)), end.length)


def keys(name: str, title: str, end: KeyedEnd, *positions: Placement) -> Occurrence:
    """The keys of such an end, in their grooves, with the end at positions."""
    row = end.keyway
    block = box(row.height, row.width, end.length)
    middle = placement(x=end.diameter / 2 - row.in_shaft + row.height / 2)
    bought = Bought(end.designation, block.volume * STEEL.density)
    part = Part(name, title, "fastener", shape=Sum((Placed(block, (middle,)),)), purchase=bought)
    turned = [placement(about=(0.0, 0.0, 1.0), angle=2 * math.pi * k / end.number) for k in range(end.number)]
    return Occurrence(part, tuple(position.after(one) for position in positions for one in turned))


def locked(name: str, title: str, row: Locknut, *, washer: bool = False) -> Part:
    """A locknut about z from z = 0, or its tab washer."""
    thick, designation = (row.washer, row.washer_designation) if washer else (row.width, row.designation)
    shape = tube(row.outer, (row.outer - row.thread) / 2, thick)
    return bought_part(name, title, "fastener", shape, Bought(designation, shape.volume * STEEL.density))


def length_of(part: Part) -> float:
    """Length along its axis of a bought part whose room begins at z = 0 [m]."""
    assert part.shape is not None
    return float(shape_box(part.shape)[1][2])


@lru_cache(maxsize=1024)
def face_of(part: Part) -> float:
    """Width of a motor or reducer [m]."""
    assert part.shape is not None
    low, high = shape_box(part.shape)
    return float(high[0] - low[0])


@lru_cache(maxsize=256)
def bearing(name: str, title: str, row: RollingBearing, holes: tuple[Contour, ...] = ()) -> Part:
    """A rolling bearing about z from z = 0, with its square flange, drilled for its screws, if it has one."""
    ring = Placed(tube(row.outer, (row.outer - row.bore) / 2, row.width))
    shape = Sum((ring,)) if row.flange <= 0 else Sum((ring, _flange(row, holes)))
    return bought_part(name, title, "bearing", shape, Bought(row.name, row.mass, data=f"{row.name}{row.standard}"))


def _flange(row: RollingBearing, holes: tuple[Contour, ...]) -> Placed:
    """The housing's flange about the outer ring."""
    bores = circle(0j, row.outer / 2), *holes
    return Placed(Prism(Profile(rectangle(row.flange, row.flange), bores), FLANGE))


def screw(name: str, title: str, row: MachineScrew, length: float) -> Part:
    """A screw along z, of steel: its head below z = 0, with its washer, its thread above."""
    washer, thickness = row.washer
    steps = (row.across, row.head), (washer, thickness), (row.diameter, length - thickness)
    shape = stepped(*(step for step in steps if min(step) > 0))
    bought = Bought(row.designation(length), shape.volume * STEEL.density)
    placed = Sum((Placed(shape, (placement(z=-row.head - thickness),)),))
    return bought_part(name, title, "fastener", placed, bought)


def spring_part(name: str, title: str, row: CompressionSpring, length: float) -> Part:
    """A compression spring about z from z = 0, drawn at a length [m]; its mass is that of all coils."""
    wire, coil = row.wire_diameter, row.diameter
    bought = Bought(row.designation, row.mass * (row.coils + 2) / row.coils)
    return bought_part(name, title, "spring", tube(coil + wire, wire, length), bought)
