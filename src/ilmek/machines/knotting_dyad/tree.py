"""The head as a tree of bodies: both arms under a plate, their drives, the centre gripper between them.

Axes are those of the section: x from the pair's left warp, y from the warps' axes, the pile upwards. Servos, belts and
shafts: `arm_drives`; the servos of the second links may be in the elbows instead.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.elements.drive_parts import PULLEY
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import smallest_motor
from ilmek.linkage.mirror import other
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.knotting_dyad.arm_drives import (
    ALUMINIUM,
    ELBOW_BELT,
    ELBOW_SCREWS,
    NAME,
    SHAFT,
    behind,
    both,
    drive_levels,
    servo_axis,
    shaft,
    standing_drives,
    standing_servos,
)
from ilmek.machines.knotting_dyad.arms import SERVOS, arm_mechanism, arm_parts, carried, levels_of
from ilmek.machines.knotting_dyad.design import KnottingDyad
from ilmek.machines.knotting_dyad.drives import HeadMotion, JointDrive, head_motion
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.jaw_parts import (
    FOOT,
    FOOT_WIDTH,
    RISE,
    SOLENOID,
    bar_end,
    centre_parts,
    finger_at,
    finger_part,
    on_link,
    rod_at,
    rod_part,
)
from ilmek.machines.knotting_dyad.jaws import Jaws, openness
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.sequence import CENTRE as CENTRE_TIP
from ilmek.machines.knotting_dyad.sequence import LEFT, RIGHT
from ilmek.machines.link_tree import TURN, Levels, LinkageParts, body_id, linkage_tree
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import box
from ilmek.part.tree import Closure, Joint, JointKind, Occurrence, RigidBody, Tree, in_line
from ilmek.report.scene import SceneMotion
from ilmek.units import deg, mm, turn

POSES = 181
"""Poses of the head over its cycle."""

CENTRE = "centre gripper"

AXIS, HANGER = 20 * mm, 6 * mm
"""Side of the section of the centre gripper's axis, and thickness of its hanger [m]; assumed by this project."""

CENTRE_MOTOR = f"{NAME}/centre-motor"
"""Id of the motor of the centre gripper's axis."""

UP = 90 * deg
_TURNED = dict(zip(("link 1", "link 2"), SERVOS, strict=True))


@lru_cache(maxsize=4)
def tree(dyad: KnottingDyad) -> Tree:
    """The bodies of a head at the beginning of its cycle; none where the points of an arm were given."""
    if dyad.head is None:
        return Tree()
    params, head = dyad.params, dyad.head
    motion = head_motion(params, head)
    arm = arm_parts(params, head, motion.hole)
    loads = carried(params, head, motion.hole)
    levels = drive_levels(params, arm.levels.bottoms)
    centre = _centre(dyad, head, motion.jaws, loads["link 2"])
    others = {
        **loads,
        **{other(body): occurrences for body, occurrences in loads.items()},
        CENTRE: centre,
        GROUND: (
            *standing_drives(
                params, head, levels, motion, _depth(params, head, motion.jaws) + head.centre_stroke + HANGER
            ),
            *_servos(dyad, head, motion, levels.plate),
            *_axis(dyad, head, motion.jaws, centre, levels.plate),
        ),
    }
    if params.elbow_drive == "direct":
        bare, *load = loads["link 1"]
        servo = bare, _elbow_servo(motion.joints[1], tuple(load), abs(head.arm.first))
        others |= dict.fromkeys(("link 1", other("link 1")), servo)
    moving = _moving(head, motion)
    linkage = _with_motors(linkage_tree(_both(arm), moving, others), params.elbow_drive == "direct")
    linkage = _with_jaws(linkage, dyad, head, motion)
    return linkage if params.elbow_drive == "direct" else _with_shafts(linkage, shaft(levels, motion.hole), moving)


def _with_shafts(linkage: Tree, made: tuple[Occurrence, ...], moving: Motion) -> Tree:
    """The linkage with the shafts in its pivots, which take their servos' motion to the second links."""
    shafts, belts = [], []
    for named in (str, other):
        first, second = (linkage.body(body_id(NAME, named(body))) for body in ("link 1", "link 2"))
        turned = SceneMotion(
            TURN,
            np.linspace(0.0, turn, len(moving)),
            np.zeros((len(moving), 3)),
            np.unwrap(moving.angle(named("link 2"))),
        )
        own = f"{SHAFT}{second.id.removeprefix(body_id(NAME, 'link 2'))}"
        joint = Joint(JointKind.PIN, motion=turned, motor=SERVOS[1])
        place = (placement(*first.positions[0].origin[:2]),)
        shafts.append(RigidBody(own, made, first.parent, joint, place))
        belts.append(Closure(JointKind.TRANSMISSION, (own, second.id), kept_by=(ELBOW_BELT,)))
    return replace(linkage, bodies=(*linkage.bodies, *shafts), closures=(*linkage.closures, *belts))


def _with_motors(linkage: Tree, direct: bool) -> Tree:
    """The linkage with the motor of each joint that has one; direct: in the elbows too."""
    turned = _TURNED if direct else {"link 1": SERVOS[0]}
    driven = {
        **{body_id(NAME, named(body)): motor for named in (str, other) for body, motor in turned.items()},
        body_id(NAME, CENTRE): CENTRE_MOTOR,
    }
    return linkage.replaced(
        replace(body, joint=replace(body.joint, motor=driven.get(body.id, ""))) for body in linkage.bodies
    )


def needle_level(dyad: KnottingDyad) -> float:
    """Height of the middles of all blades above the plate's back [m]."""
    return levels_of(dyad.params, 0.0).bottoms["link 2"] + dyad.params.link_thickness / 2


def _mechanism(head: Head) -> Mechanism:
    """Both arms and the centre gripper, each driven for itself."""
    arm, pivot, middle = arm_mechanism(head), head.arm.pivot, head.section.middle
    mirrored = complex(2 * middle - pivot.conjugate())
    moving = [body for body in arm.bodies if body.name != GROUND]
    images = [Body(other(body.name), {other(name): point for name, point in body.points.items()}) for body in moving]
    ground = Body(GROUND, {"O": pivot, other("O"): mirrored, CENTRE: complex(middle)})
    return Mechanism(
        name=NAME,
        bodies=(ground, *moving, *images, Body(CENTRE, {CENTRE: 0})),
        joints=(
            *(Pin("O", GROUND, "link 1"), Pin("E", "link 1", "link 2")),
            *(Pin(other("O"), GROUND, other("link 1")), Pin(other("E"), other("link 1"), other("link 2"))),
            Slide(CENTRE, CENTRE, GROUND, along=UP, turned=0.0),
        ),
        inputs=(
            *(Rotation("link 1", "O"), Rotation("link 2", "E")),
            *(Rotation(other("link 1"), other("O")), Rotation(other("link 2"), other("E"))),
            Displacement(CENTRE),
        ),
        branches={},
    )


def _moving(head: Head, motion: HeadMotion) -> Motion:
    """The motion of a cycle, and back to its beginning."""
    cycle = motion.cycle
    time = np.linspace(0.0, cycle.period, POSES)
    values = {CENTRE: np.interp(time, cycle.time, cycle.centre[0])}
    for name, named in ((LEFT, str), (RIGHT, other)):
        first, second = (np.interp(time, cycle.time, angle) for angle in cycle.arms[name].angle.T)
        values |= {named("link 1"): first, named("link 2"): second - first}
    return solve(plan(_mechanism(head)), values).require()


def _both(arm: LinkageParts) -> LinkageParts:
    """The parts of both arms, which are the same."""
    sizes = {**arm.levels.sizes, **{other(body): arm.levels.sizes[body] for body in ("link 1", "link 2")}}
    bodies = tuple((*level, *(other(body) for body in level if body != GROUND)) for level in arm.levels.bodies)
    plates = {body: arm.plates[body] for body in ("link 1", "link 2")}
    plates |= {other(body): plate for body, plate in plates.items()}
    pins = {**arm.pins, **{other(name): pin for name, pin in arm.pins.items()}}
    return LinkageParts(arm.machine, Levels(bodies, sizes), plates, pins)


def _of_centre(dyad: KnottingDyad, head: Head) -> Placement:
    """A gripper's axes in the body of the centre gripper, whose origin is its tip."""
    return placement(0.0, head.arm.second, needle_level(dyad), about=(0.0, 0.0, 1.0), angle=-UP)


def _depth(params: KnottingDyadParams, head: Head, jaws: Jaws) -> float:
    """From the warps' axes to the middle of the centre gripper's axis: at the servos, or as its bar needs [m]."""
    bar = behind(head) + FOOT_WIDTH + jaws.neck + jaws.solenoid.length
    return max(params.room.depth, float(bar - head.centre_stroke))


def _centre(dyad: KnottingDyad, head: Head, jaws: Jaws, of_arm: tuple[Occurrence, ...]) -> tuple[Occurrence, ...]:
    """Bar, blade and jaws of the centre gripper, from its tip back onto its axis; parts that an arm has are the arm's:
    caches may have dropped them since.
    """
    params, at, tip = dyad.params, _of_centre(dyad, head), head.arm.second
    nose = tip + head.section.front - behind(head)
    rear = tip + head.section.front - _depth(params, head, jaws) - head.centre_stroke
    made = (*on_link(params, head, jaws), *centre_parts(params, head, jaws, (nose, rear)))
    shared = {occurrence.part.id: occurrence.part for occurrence in of_arm}
    return tuple(
        Occurrence(shared.get(one.part.id, one.part), tuple(at.after(own) for own in one.positions)) for one in made
    )


def _with_jaws(linkage: Tree, dyad: KnottingDyad, head: Head, motion: HeadMotion) -> Tree:
    """The linkage with the fingers of its grippers and the rods that open them, moved as the cycle's grips say."""
    params, cycle = dyad.params, motion.cycle
    jaws, level = motion.jaws, placement(z=needle_level(dyad))
    rear = bar_end(jaws, head.arm.second + head.section.front - _depth(params, head, jaws) - head.centre_stroke)
    grips = [edge for part in cycle.parts if part.grippers for edge in (part.start, part.end)]
    time = np.unique([0.0, *grips, cycle.period])
    bodies, closures = [], []
    for gripper, link, frame in (
        (LEFT, "link 2", level),
        (RIGHT, other("link 2"), level),
        (CENTRE_TIP, CENTRE, _of_centre(dyad, head)),
    ):
        centre, parent, open_ = gripper == CENTRE_TIP, body_id(NAME, link), openness(cycle, gripper, time)
        finger, rod = (f"{NAME}/{gripper}-{name}" for name in ("finger", "rod"))
        opened = np.stack([0 * time, 0 * time, -jaws.strokes[gripper] * open_], axis=1)
        for name, part, own, turned, shift, joint in (
            (
                *(rod, rod_part(jaws, jaws.arm - rear if centre else RISE, centre), rod_at(jaws, centre)),
                *(0 * time, opened, Joint(JointKind.SLIDE, motor=SOLENOID)),
            ),
            (
                *(finger, finger_part(params, head, jaws, centre), finger_at(jaws)),
                *(-jaws.angle * open_, 0 * opened, Joint(JointKind.PIN, (0.0, 1.0, 0.0))),
            ),
        ):
            begin = placement(*shift[0], about=joint.axis, angle=float(turned[0]))
            moved = SceneMotion(TURN, turn * time / cycle.period, shift - shift[0], turned - turned[0])
            where = frame.after(own).after(begin)
            bodies.append(RigidBody(name, (Occurrence(part),), parent, replace(joint, motion=moved), (where,)))
        closures.append(Closure(JointKind.TRANSMISSION, (rod, finger)))
    return Tree((*linkage.bodies, *bodies), (*linkage.closures, *closures))


def _axis(
    dyad: KnottingDyad, head: Head, jaws: Jaws, centre: tuple[Occurrence, ...], level: float
) -> Iterator[Occurrence]:
    """The axis of the centre gripper under its foot, its motor under that, and what holds it under a level [m]."""
    params, stroke, across = dyad.params, head.centre_stroke, head.section.middle
    long, under = 2 * stroke, needle_level(dyad) + jaws.bar + FOOT
    title, shape, data = "axis of the centre gripper", box(AXIS, long, AXIS), catalogue.stroke_of(stroke)
    bought = Bought("linear axis", length=stroke, data=f"straight, {data}")
    axis = Part(f"{NAME}/centre-axis", title, "linear axis", shape, purchase=bought, envelope=True, size="straight")
    begin = _depth(params, head, jaws) - stroke
    yield Occurrence(axis, (placement(across, begin + long / 2, under),))
    moved = RigidBody(CENTRE, centre).moments.zeroth
    torque, turning = moved * (params.centre_acceleration + GRAVITY) * PULLEY, params.centre_speed / PULLEY
    chosen = smallest_motor(torque, turning, "servo")
    motor = catalogue.motor(CENTRE_MOTOR, "motor of the centre gripper", chosen, torque, turning)
    # Flush with the hanger: nearer to the warps the guide of the followers stands under the axis.
    end = begin + stroke + max(stroke + HANGER - catalogue.face_of(motor) / 2, 0.0)
    upright = placement(across, end, under + AXIS, about=(1.0, 0.0, 0.0), angle=2 * UP)
    name, adapter = f"{NAME}/centre-adapter", "adapter of the centre gripper's axis"
    adapters, flanges = catalogue.adapted(name, adapter, motor, AXIS, (upright,))
    yield from adapters
    yield Occurrence(motor, flanges)
    title = "hanger of the centre gripper's axis"
    hanger = Part(f"{NAME}/centre-hanger", title, "machined link", box(AXIS, HANGER, under + AXIS - level), ALUMINIUM)
    yield Occurrence(hanger, (placement(across, begin + long + HANGER / 2, level),))


def _servos(dyad: KnottingDyad, head: Head, motion: HeadMotion, level: float) -> Iterator[Occurrence]:
    """Servos and reducers that stand under a level [m], one behind the other, their shafts upright."""
    standing = list(zip(SERVOS, motion.joints, strict=True))[: standing_servos(dyad.params)]
    for number, (name, drive) in enumerate(standing):
        parts = tuple(_drive_parts(name, drive))
        lines = [
            _hanging(in_line(parts, -level), axis) for axis in both(head, servo_axis(dyad.params, head, motion, number))
        ]
        for each in zip(*lines, strict=True):
            yield Occurrence(each[0].part, tuple(position for one in each for position in one.positions))


def _hanging(line: tuple[Occurrence, ...], axis: complex) -> tuple[Occurrence, ...]:
    """Parts in line upside down: their shaft towards -z, at an axis [m]."""
    down = placement(axis.real, axis.imag, about=(1.0, 0.0, 0.0), angle=2 * UP)
    return tuple(Occurrence(each.part, tuple(down.after(own) for own in each.positions)) for each in line)


def _drive_parts(name: str, drive: JointDrive) -> Iterator[Part]:
    if drive.gear_ratio != 1:
        title = f"reducer of the {drive.joint}"
        yield catalogue.reducer(f"{name}-reducer", title, drive.reducer, drive.motor)
    yield catalogue.motor(name, f"servo of the {drive.joint}", drive.motor, drive.servo_torque_max, drive.servo_speed)


def _elbow_servo(drive: JointDrive, loads: tuple[Occurrence, ...], x: float) -> Occurrence:
    """The servo in an elbow at x [m]: the load whose mass is given, which the forces count."""
    part = replace(tuple(_drive_parts(SERVOS[1], drive))[-1], fixing=ELBOW_SCREWS)
    assert part.purchase is not None
    if not loads:
        return Occurrence(replace(part, purchase=replace(part.purchase, mass=0.0)), (placement(x),))
    (load,) = loads
    purchase = replace(part.purchase, mass=load.part.mass)
    return replace(load, part=replace(part, shape=load.part.shape, purchase=purchase))
