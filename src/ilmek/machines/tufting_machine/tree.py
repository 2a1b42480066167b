"""The tufting machine in space: needle drives and loopers along the width in their frame, rollers, motors, the belt.

Beyond the far end plate are the belt between both shafts and the flywheel, beyond the near one the motors.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.elements.belts import BELTS
from ilmek.elements.motors import Motor
from ilmek.elements.reducers import DIRECT, Reducer
from ilmek.linkage.model import GROUND
from ilmek.machines.link_tree import TURN, body_id, linkage_bodies, linkage_closures
from ilmek.machines.tufting.links import needle_parts as drive_parts
from ilmek.machines.tufting.strength import needle_sizes
from ilmek.machines.tufting.tree import POSES, keyed, needle_drives
from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.machines.tufting_machine.feed import SPIKED_ROLLER, YARN_ROLLER
from ilmek.machines.tufting_machine.frame import (
    BEAMS,
    END_PLATE,
    JOURNAL,
    feet,
    frame_parts,
    roller_axes,
    scroll_height,
)
from ilmek.machines.tufting_machine.latches import latch_places
from ilmek.machines.tufting_machine.layout import TuftingLayout, layout
from ilmek.machines.tufting_machine.needle_parts import DOWN, NEEDLE_BAR, needle_heights, needle_parts
from ilmek.machines.tufting_machine.params import SCROLLS
from ilmek.machines.tufting_machine.rocker_forces import RockerForces
from ilmek.machines.tufting_machine.rocker_parts import CLEAR, NAME
from ilmek.machines.tufting_machine.scrolls import scroll_bodies
from ilmek.machines.tufting_machine.shafts import FLYWHEEL_ID, LOOPER_CRANKS, MAIN_SHAFT, MOTOR_ID, STEEL
from ilmek.part import catalogue
from ilmek.part.flat_link import eyed_link
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Drilling, Placed, Prism, Sum, bar, disc, tube
from ilmek.part.tree import Closure, Joint, JointKind, Occurrence, RigidBody, Tree, in_line
from ilmek.plane.contours import circle
from ilmek.report.scene import SceneMotion
from ilmek.units import format_quantity, in_mm, mm, turn

FRAME = body_id(NAME, GROUND)

PROFILE, TEETH, BELT_WIDTH, BELT = BELTS["HTD 8M"], 48, 30 * mm, 3 * mm
"""The belt from main to looper shaft, teeth of its pulleys, its width and thickness without teeth; assumed by this
project."""

STATION = BELT_WIDTH + 2 * (catalogue.BESIDE + catalogue.RIM)
"""Width of its pulleys with their flanges [m]."""

SKIN, PLUG = 5 * mm, 20 * mm
"""Wall of the rollers, and length of the plugs in their ends; assumed by this project."""


@lru_cache(maxsize=4)
def tree(machine: TuftingMachine) -> Tree:
    """The bodies where the first needle crank lies along x."""
    laid = layout(machine)
    parts = (*frame_parts(laid), *_motors(laid), _belt(laid))
    needles, bars = _needles(laid)
    whole = Tree((RigidBody(FRAME, parts),)).carrying(FRAME, needles)
    loopers, loops = _loopers(laid)
    joined = (Closure(JointKind.ROLLING, (MAIN_SHAFT, LOOPER_CRANKS)), *loops, *bars)
    scrolls = laid.machine.params.pattern.attachment == SCROLLS
    fed = scroll_bodies(laid, scroll_height(laid), FRAME) if scrolls else ()
    return Tree((*whole.bodies, *loopers, *_rollers(laid), *fed), (*whole.closures, *joined))


def _needles(laid: TuftingLayout) -> tuple[Tree, tuple[Closure, ...]]:
    """The needle drives with push rods, needle bar and needles; what closes the bar's loops."""
    machine, params = laid.machine, laid.machine.params
    made, (first, last) = needle_parts(params), laid.ends
    rod = Occurrence(_headed_rod(machine), (placement(z=laid.needle_sides[0]),))
    end = last + END_PLATE + CLEAR + STATION + params.shafts.flywheel
    drives = needle_drives(
        machine.needle, laid.pitch, needle=(rod,), feet=feet(laid), welded=(BEAMS,), shaft=(first - END_PLATE, end)
    )
    wheel, pulley = _flywheel(machine), _pulley("pulley", machine.shafts.diameter)
    beyond = last + END_PLATE + CLEAR
    on_end = placement(z=beyond + STATION)
    turned = (
        Occurrence(pulley, (placement(z=beyond + catalogue.RIM),)),
        Occurrence(wheel, (on_end,)),
        Occurrence(_wheel_clamp(machine), (on_end,)),
    )
    bodies = []
    for body in drives.bodies:
        if body.id == MAIN_SHAFT:
            joint = replace(body.joint, motor=MOTOR_ID)
            bodies.append(replace(body, occurrences=(*body.occurrences, *turned), joint=joint))
        else:
            standing = body.joint.kind == JointKind.MISSING
            bodies.append(replace(body, joint=Joint()) if standing else body)
    names = [f"{body_id('tufting', 'needle')} {drive + 1}" for drive in range(params.drives)]
    length = params.width / made.pieces
    heights = needle_heights(params, machine.carpet.needles)
    bars_by_bores: dict[tuple[float, ...], Part] = {}
    for piece in range(made.pieces):
        # The piece hangs on the first needle that it has; in the frame of this z = 0 is the lowest plane of its drive.
        low = piece * length
        own = tuple(place for place in heights if low <= place.origin[2] < low + length)
        under = tuple(placement(y=-params.needle_bar.height, z=float(place.origin[2]) - low) for place in own)
        inset = (length - catalogue_length(made.bar)) / 2
        rods = [laid.needle_level + drive * laid.pitch - laid.left - low - inset for drive in range(params.drives)]
        pattern = tuple(round(z, 9) for z in rods if 0 < z < length)
        bored = bars_by_bores.setdefault(pattern, _bored_bar(machine, pattern, len(bars_by_bores)))
        parts = (Occurrence(bored, (placement(z=inset),)), Occurrence(made.needle, under), *_latches(machine, own, low))
        at = placement(y=-_rod_length(machine), z=laid.left)
        name = NEEDLE_BAR if made.pieces == 1 else f"{NEEDLE_BAR} {piece + 1}"
        bodies.append(RigidBody(name, parts, names[piece], positions=(at,)))
    bars = () if made.pieces > 1 else tuple(Closure(JointKind.FIXED, (NEEDLE_BAR, name)) for name in names[1:])
    return Tree(tuple(bodies), drives.closures), bars


def _latches(machine: TuftingMachine, own: tuple[Placement, ...], low: float) -> Iterator[Occurrence]:
    """The latches of needles on their piece of the bar, which begins at a height [m]."""
    part = needle_parts(machine.params).latch
    if part is not None:
        heights = tuple(placement(z=float(place.origin[2]) - low) for place in own)
        yield Occurrence(part, latch_places(machine.params, heights))


def catalogue_length(part: Part) -> float:
    """Length of the needle bar's part along z [m]."""
    assert part.shape is not None
    return float(np.ptp(part.shape.mesh(1 * mm).points[:, 2]))


def _rod_length(machine: TuftingMachine) -> float:
    """From the pin E to the needle bar [m]."""
    given = machine.params.needle_bar
    return machine.needle.params.needle - given.needle_length - given.height


@lru_cache(maxsize=8)
def _headed_rod(machine: TuftingMachine) -> Part:
    """A push rod with its eye on the pin E: a round bar in the middle of the links' plane, to half of the bar."""
    needle, plain = machine.needle, needle_parts(machine.params).rod
    parts = drive_parts(needle.params, needle_sizes(needle))
    pin, thick = dict(needle_sizes(needle).pins)["E"], parts.levels.sizes["needle"].thickness
    radius = pin + 4 * mm
    head = Prism(Profile(circle(0j, radius), (circle(0j, pin / 2),)), thick)
    given = machine.params.needle_bar
    diameter, length = given.rod, _rod_length(machine) - radius + given.height / 2
    down = placement(y=-radius, z=thick / 2, about=(1.0, 0.0, 0.0), angle=math.pi / 2)
    shape = Sum((Placed(head), Placed(bar(diameter, length), (down,))))
    return replace(plain, shape=shape)


@lru_cache(maxsize=8)
def _bored_bar(machine: TuftingMachine, rods: tuple[float, ...], before: int) -> Part:
    """A piece of the needle bar with the bores in which push rods are pressed, at their distances from its end [m].

    before  number of pieces bored otherwise, each a part of its own
    """
    given, plain = machine.params.needle_bar, needle_parts(machine.params).bar
    assert isinstance(plain.shape, Sum)
    (lies,) = plain.shape.members
    mouths = (placement(y=given.height / 2, z=z).after(DOWN) for z in rods)
    holes = tuple(Drilling(mouth, ((given.rod, given.height / 2),)) for mouth in mouths)
    assert isinstance(lies.shape, Prism)
    name = f"{plain.id}-{before + 1}" if before else plain.id
    return replace(plain, id=name, shape=Sum((replace(lies, shape=replace(lies.shape, drilled=holes)),)))


def _loopers(laid: TuftingLayout) -> tuple[list[RigidBody], list[Closure]]:
    """The loopers' crank shaft with its pulley, and the looper drives on it and on their shafts."""
    machine = laid.machine
    (first, last), diameter = laid.ends, machine.params.looper.shaft
    end, at = last + END_PLATE + CLEAR + STATION, laid.crank_shaft
    shaft = Part(
        LOOPER_CRANKS, "crank shaft of the loopers", "steel bar", bar(diameter, end - first), STEEL, machined=True
    )
    pulley = _pulley("looper-pulley", diameter)
    parts = (
        Occurrence(shaft, (placement(z=first),)),
        Occurrence(pulley, (placement(z=end - STATION + catalogue.RIM),)),
    )
    angle = np.linspace(0.0, turn, POSES)
    turned = Joint(JointKind.PIN, motion=SceneMotion(TURN, angle, np.zeros((POSES, 3)), angle))
    cranks = RigidBody(LOOPER_CRANKS, parts, FRAME, turned, (placement(at.real, at.imag),))
    bodies, loops = [cranks], list[Closure]()
    for number in range(machine.params.drives):
        for forces in machine.below:
            own, closed = _swung(forces, number, laid, cranks)
            bodies += own
            loops += closed
    return bodies, loops


def _swung(
    forces: RockerForces, number: int, laid: TuftingLayout, cranks: RigidBody
) -> tuple[list[RigidBody], tuple[Closure, ...]]:
    """A drive of loopers or knives, counted from 0, on their crank shaft."""
    suffix, made, needle = f" {number + 1}", forces.parts.rocker, laid.machine.params.needle
    motion = forces.moves.moved(np.linspace(0.0, turn, POSES) - number * needle.phase, needle.speed)
    crank = body_id(NAME, forces.moves.drive.bodies[0]) + suffix
    carried = {forces.moves.drive.bodies[2]: forces.parts.carried(number)}
    z = laid.middle(number) + made.aside - made.level
    own = linkage_bodies(made.linkage, motion, carried, z=z, suffix=suffix)
    bodies = [keyed(body, cranks) if body.id == crank else body for body in own]
    return bodies, linkage_closures(NAME, motion.plan.mechanism, suffix)


def _rollers(laid: TuftingLayout) -> Iterator[RigidBody]:
    """Spiked rollers before and behind the bed, and the yarn feed roller, on journals in the end plates."""
    feed, (first, last) = laid.machine.params.feed, laid.ends
    sizes = {SPIKED_ROLLER: feed.spiked_roller, YARN_ROLLER: feed.yarn_roller}
    titles = {SPIKED_ROLLER: "spiked roller of the backing", YARN_ROLLER: "yarn feed roller"}
    shapes = {name: _roller(diameter, last - first) for name, diameter in sizes.items()}
    parts = {name: Part(name, titles[name], "machined link", shapes[name], STEEL) for name, size in sizes.items()}
    for place, at in roller_axes(laid).items():
        kind, name = _fed_by(place)
        position = placement(at.real, at.imag, first - END_PLATE)
        joint = Joint(JointKind.PIN, motor=f"{NAME}/{kind}-motor")
        yield RigidBody(f"{name} {place}", (Occurrence(parts[name]),), FRAME, joint, (position,))


def _roller(diameter: float, between: float) -> Sum:
    """A tube between end plates so far apart [m], with a plug in each end, on journals as long as these are thick."""
    journal, length, inner = END_PLATE + CLEAR / 2, between - CLEAR, diameter - 2 * SKIN
    end, plug = bar(JOURNAL, journal), bar(inner, PLUG)
    return Sum(
        (
            Placed(end, (placement(), placement(z=journal + length))),
            Placed(plug, (placement(z=journal), placement(z=journal + length - PLUG))),
            Placed(tube(diameter, SKIN, length), (placement(z=journal),)),
        )
    )


def _motors(laid: TuftingLayout) -> Iterator[Occurrence]:
    """Motors with their reducers on the near end plate."""
    machine, begin = laid.machine, laid.ends[0] - END_PLATE
    shafts, feed = machine.shafts, machine.feed
    yield from in_line(
        _driving("motor", "main shaft", shafts.motor, shafts.rms_torque, machine.params.needle.speed), begin
    )
    parts = {
        kind: _driving(f"{kind}-motor", f"{kind} roller", pair, feed.torques[kind], feed.speeds[kind])
        for kind, pair in feed.motors.items()
    }
    for place, at in roller_axes(laid).items():
        yield from in_line(parts[_fed_by(place)[0]], begin, at)


def _fed_by(place: str) -> tuple[str, str]:
    """What feeds with a roller of `roller_axes`, and the id of its part."""
    return ("spiked", SPIKED_ROLLER) if place in {"rear", "front"} else ("yarn", YARN_ROLLER)


def _driving(
    name: str, title: str, pair: tuple[Motor, Reducer] | None, torque: float, speed: float
) -> tuple[Part, ...]:
    """A servo behind its reducer, from the shaft on."""
    row, reducer = pair or (None, DIRECT)
    motor = catalogue.motor(
        f"{NAME}/{name}", f"motor of the {title}", row, reducer.motor_torque(torque), speed * reducer.ratio
    )
    if reducer.ratio == 1:
        return (motor,)
    return catalogue.reducer(f"{NAME}/{name}-reducer", f"reducer of the {title}", reducer, row), motor


def _flywheel(machine: TuftingMachine) -> Part:
    """A disc of the moment of inertia that the speed's fluctuation needs: D^4 = 32 J / (pi rho b) + d^4, of the bore d
    about its locking assembly.
    """
    width, bore = machine.params.shafts.flywheel, catalogue.locked_bore(machine.shafts.diameter)
    diameter = (32 * machine.shafts.flywheel / (math.pi * STEEL.density * width) + bore**4) ** 0.25
    shape = Prism(disc(diameter / 2, circle(0j, bore / 2)), width)
    return Part(FLYWHEEL_ID, "flywheel", "machined link", shape, STEEL)


def _wheel_clamp(machine: TuftingMachine) -> Part:
    title, width = "locking assembly of the flywheel", machine.params.shafts.flywheel
    return catalogue.locking_assembly(f"{NAME}/flywheel-clamp", title, machine.shafts.diameter, width)


def _pulley(name: str, bore: float) -> Part:
    title, edge = "pulley of the loopers' belt", circle(0j, bore / 2)
    return catalogue.toothed_pulley(f"{NAME}/{name}", title, PROFILE, TEETH, BELT_WIDTH, edge, clamped=True)


def _belt(laid: TuftingLayout) -> Occurrence:
    """The belt from the main to the looper crank shaft."""
    away, tips = laid.crank_shaft, PROFILE.tip_radius(TEETH) + 0.05 * mm
    inner, outer = (eyed_link(abs(away), size, size) for size in (tips, tips + BELT))
    length = 2 * abs(away) + math.tau * PROFILE.pitch_radius(TEETH)
    size = format_quantity(length, "mm")
    bought = Bought(f"belt {PROFILE.name}, {in_mm(BELT_WIDTH)} wide, {length / PROFILE.pitch:.0f} teeth", length=length)
    shape = Prism(Profile(outer, (inner,)), BELT_WIDTH)
    belt = bought_part(f"{NAME}/belt", "belt of the loopers", "belt", shape, bought, size=size)
    z = laid.ends[1] + END_PLATE + CLEAR + catalogue.RIM + catalogue.BESIDE
    return Occurrence(belt, (placement(z=z, about=(0.0, 0.0, 1.0), angle=float(np.angle(away))),))
