"""The cam and its follower as a tree of bodies: the cam turns, a slide or an arm carries the roller.

Axes lie in the cam's middle, z along its shaft; x and y as it is drawn, a slide upright. A wedge slides to the left. Of
the follower, stem or arm is room alone: its mass is the moving mass that the forces count, less its rollers'. The
shaft, the guide and the pivot are those of the machine that the cam is for.
"""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.limits import largest_cutter
from ilmek.cams.profile_tolerance import BAND, increment_tolerance
from ilmek.cams.programme import TURN
from ilmek.cams.trace import CamRole
from ilmek.elements.materials import MATERIALS
from ilmek.machines.cam import developed_cams
from ilmek.machines.cam.animation import pivot_of, swings, upright
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.parts import cutouts, hub_notes, outline_angles, rim_radius, zero_mark
from ilmek.machines.cam.round_cams import flanked, solid_plate
from ilmek.part.part import CUTTER, PITCH, ZERO, Bought, CamMaking, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, box, disc, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import area, circle, polygon
from ilmek.report import Plate, WorkPiece
from ilmek.report.scene import SceneMotion
from ilmek.units import deg, in_mm, mm, round_size, turn

CAM, FOLLOWER = "cam/cam", "cam/follower"
"""Ids of the bodies."""

POSES = 181
"""Poses over a turn of the cam."""

BETWEEN = 0.2
"""Distance of two conjugate cams over the width of one; assumed by this project."""

STEM = 10 * mm
"""Least side of the follower's stem or arm [m]; assumed by this project."""

_Z = (0.0, 0.0, 1.0)


@lru_cache(maxsize=8)
def tree(design: CamDesign) -> Tree:
    """The bodies at the cam angle 0; none where no surface can guide the follower."""
    cams = tuple(cam_parts(design))
    if not cams:
        return Tree()
    standing = RigidBody("cam/machine", (), joint=Joint(JointKind.MISSING))
    apart = (1 + BETWEEN) * design.face_width
    placed = tuple(Occurrence(part, (placement(z=at * apart),)) for at, part in enumerate(cams))
    wedge = design.params.kind == "wedge"
    angle = np.linspace(0.0, TURN, POSES)
    over = float(design.cam.knots[-1]) * (1 - np.abs(angle / np.pi - 1)) if wedge else angle
    joint = Joint(JointKind.SLIDE if wedge else JointKind.PIN, _Z, _of_cam(design, angle, over))
    positions = (placement(about=_Z, angle=0.0 if design.params.laid_flat else float(np.angle(upright(design)))),)
    cam = RigidBody(CAM, placed, standing.id, joint, positions)
    return Tree((standing, cam, _follower(design, angle, over)))


def cam_parts(design: CamDesign) -> Iterator[Part]:
    """The cam, or both conjugate ones; nothing where no surface can guide the follower."""
    if design.undercut:
        return
    title, kind = f"cam, lift {in_mm(design.params.lift)}", design.params.kind
    if kind == "wedge":
        yield _wedge(design, title)
    elif design.params.laid_flat:
        yield _round(design, title)
    elif kind == "grooved":
        yield _grooved(design, title)
    else:
        yield _disc(design, design.cam, CAM, title)
        if design.cams.pair is not None:
            yield _disc(design, design.cams.pair.second, f"{CAM}-2", f"second {title}")


def mass_of(design: CamDesign) -> float | None:
    """Mass of the cam, bored, or of both [kg]; None where undercut leaves no face."""
    bodies = tree(design)
    return bodies.body(CAM).moments.zeroth if bodies.bodies else None


def _disc(design: CamDesign, cam: CamRole, name: str, title: str) -> Part:
    """A cam as a plate."""
    trace, params = cam.trace(outline_angles(cam)), design.params
    cutter = params.cutter_radius or cam.roller_radius
    paths = {PITCH: trace.pitch} if cam.roller_radius > 0 else {}
    if cutter > 0:
        paths[CUTTER] = trace.parallel(cutter - cam.roller_radius)
    return Part(
        name,
        title,
        "cam plate",
        Prism(Profile(polygon(trace.surface), cutouts(design, cam), smooth=True), design.face_width),
        MATERIALS[params.material],
        paths=paths,
        marks={ZERO: zero_mark(design)},
        notes=hub_notes(design),
        cam=_making(design, cam, cutter),
    )


def _making(design: CamDesign, cam: CamRole, cutter: float) -> CamMaking:
    """How a cam is cut; errors of its profile may take the force that holds the follower on it."""
    held, params = design.follower_load, design.params
    motion = design.programme.at(outline_angles(cam))
    room = float(held.force(motion.s, motion.dds).min())
    sprung = held.mass > 0 and not params.led
    spare = max(0.0, room) / held.mass * params.per_unit if sprung else math.inf
    increment = increment_tolerance(spare, params.speed, deg)
    return CamMaking(cutter, largest_cutter(cam), BAND, increment, spare, params.speed)


def _cutter_note(radius: float) -> tuple[str, ...]:
    return (f"cutter of {in_mm(2 * radius)}",) if radius > 0 else ()


def _wedge(design: CamDesign, title: str) -> Part:
    section = Profile(polygon(developed_cams.wedge_outline(design)), smooth=True)
    return Part(
        CAM,
        title,
        "cam plate",
        Prism(section, design.face_width),
        MATERIALS[design.params.material],
        notes=_cutter_note(design.params.cutter_radius or design.cam.roller_radius),
    )


def _round(design: CamDesign, title: str) -> Part:
    """A barrel or an end cam, drawn laid flat."""
    ends = developed_cams.axial_ends(design)
    shape = flanked(design, ends)
    material = MATERIALS[design.params.material]
    return Part(CAM, title, "turned part", shape, material, drawing=solid_plate(design, title, ends))


def _grooved(design: CamDesign, title: str) -> Part:
    """A disc with a groove, drawn with the groove's flanks as paths."""
    cam, params, width = design.cam, design.params, design.face_width
    trace, radius, material = cam.trace(outline_angles(cam)), rim_radius(design), MATERIALS[params.material]
    bore, inner, outer = cutouts(design, cam), trace.surface, trace.parallel(cam.roller_radius)
    lifted = (placement(z=params.rim),)
    floor = Prism(disc(radius, *bore), params.rim)
    land = Prism(Profile(polygon(inner), bore, smooth=True), width)
    shape = Sum((Placed(floor), Placed(land, lifted), Placed(Prism(disc(radius, polygon(outer)), width), lifted)))
    cutter = min(params.cutter_radius or cam.roller_radius, cam.roller_radius)
    paths = {"pitch curve": trace.pitch, "inner flank": inner, "outer flank": outer}
    paths["cutter path"] = trace.parallel(cutter - cam.roller_radius)
    depth, wide = (in_mm(size) for size in (width, 2 * cam.roller_radius))
    size, outline = round_size(2 * radius), circle(0j, radius)
    drawn = Plate(
        name="cam",
        title=title,
        outline=outline,
        thickness=width + params.rim,
        material=params.material,
        cutouts=bore,
        paths=paths,
        marks={"zero": zero_mark(design)},
        area=area(outline),
        notes=(f"groove {wide} wide, {depth} deep", *hub_notes(design)),
        solid=WorkPiece("cam", title, size, params.material, 1, shape, shape.volume),
    )
    return Part(CAM, title, "cam plate", shape, material, drawing=drawn)


def _of_cam(design: CamDesign, angle: FloatArray, over: FloatArray) -> SceneMotion:
    """The motion of the cam: a turn; of a wedge its way to the left and back."""
    still = np.zeros((len(angle), 3))
    if design.params.kind != "wedge":
        return SceneMotion("turn", angle, still, angle)
    still[:, 0] = -design.cam.prime_radius * over
    return SceneMotion("turn", angle, still, np.zeros_like(angle))


def _follower(design: CamDesign, angle: FloatArray, over: FloatArray) -> RigidBody:
    """Slide or arm with its rollers, in the axes of the machine."""
    start, moves = _starts(design), np.zeros((len(angle), 3))
    rise = design.programme.at(over).s
    rise = rise - rise[0]
    first = complex(start[0])
    if swings(design):
        pivot = pivot_of(design)
        sense = 1.0 if (np.conj(first) * 1j * (first - pivot)).real > 0 else -1.0
        held = Joint(JointKind.PIN, _Z, SceneMotion("turn", angle, moves, sense * rise))
        position = placement(pivot.real, pivot.imag)
        return RigidBody(FOLLOWER, tuple(_on_follower(design, start - pivot)), "cam/machine", held, (position,))
    moves[:, 2 if _around(design) else 1] = rise
    held = Joint(JointKind.SLIDE, _Z, SceneMotion("turn", angle, moves, np.zeros_like(angle)))
    return RigidBody(FOLLOWER, tuple(_on_follower(design, start)), "cam/machine", held)


def _around(design: CamDesign) -> bool:
    """Whether the follower moves along the cam's axis: beside a barrel or an end cam."""
    return design.params.laid_flat and design.params.kind != "wedge"


def _starts(design: CamDesign) -> ComplexArray:
    """Middle of the roller, or the contact, on each cam at the cam angle 0 [m]."""
    zero = np.zeros(1)
    if design.params.laid_flat:
        return np.asarray(1j * design.programme.at(zero).s)
    pair = design.cams.pair
    traces = pair.traces(zero) if pair else (design.cam.trace(zero),)
    return np.array([upright(design) * complex(trace.pitch[0]) for trace in traces])


def _on_follower(design: CamDesign, middles: ComplexArray) -> Iterator[Occurrence]:
    """Rollers of the table at their middles [m], in the follower's frame, with their studs up to the stem or arm, and
    the room of that.
    """
    row, apart, weighed = design.roller, (1 + BETWEEN) * design.face_width, 0.0
    side = max(STEM, row.stud if row else 0.0)
    places = [_roller_place(design, complex(middle), at * apart) for at, middle in enumerate(middles)]
    if row is not None:
        ring, bought = tube(row.diameter, (row.diameter - row.stud) / 2, row.width), Bought(row.name, row.mass)
        end = 1.5 * design.face_width - side / 2 if _around(design) else row.width
        begin = 0.0 if _around(design) else -side / 2
        stud = Placed(bar(row.stud, max(end, row.width) - begin), (placement(z=begin),))
        shape = Sum((Placed(ring), stud))
        roller = bought_part("cam/roller", "roller of the follower", "bearing", shape, bought, size=row.name)
        weighed = row.mass * len(places)
        yield Occurrence(roller, tuple(places))
    length = abs(complex(middles[0])) if swings(design) else 2 * design.params.lift + 4 * side
    mass = max(design.params.mass - weighed, 0.0)
    stem = bought_part(
        "cam/follower",
        "arm of the follower" if swings(design) else "stem of the follower",
        "part to design",
        box(side, side, length),
        Bought("to design", mass),
        size="not designed",
    )
    yield Occurrence(stem, (_stem_place(design, complex(middles[0]), side),))


def _roller_place(design: CamDesign, middle: complex, z: float) -> Placement:
    """A roller's position: its axis along the cam's, beside a barrel towards the cam's axis."""
    if not _around(design):
        return placement(middle.real, middle.imag, z)
    outer = design.cam.prime_radius - design.face_width / 2
    return placement(outer, z=middle.imag, about=(0.0, 1.0, 0.0), angle=turn / 4)


def _stem_place(design: CamDesign, middle: complex, side: float) -> Placement:
    """A bar along z from the roller on: upwards, along a barrel's axis, or along the arm from its pivot."""
    if _around(design):
        return placement(design.cam.prime_radius + design.face_width, z=middle.imag)
    along = np.angle(middle) if swings(design) else turn / 4
    origin = 0j if swings(design) else middle
    lying = placement(about=(0.0, 1.0, 0.0), angle=turn / 4)  # z along x
    return placement(origin.real, origin.imag, -side, about=_Z, angle=float(along)).after(lying)
