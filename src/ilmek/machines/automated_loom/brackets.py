"""The brackets of the frame: plates that carry the bearings of cylinders and cam shafts, back rest, and compensator.

A bracket is a plate of the thickness t beside the column, between the column's face and the seats. A force R at a
distance d from the column's axis bends it in its plane, and, as a bearing or the end of a beam stands o beside its
middle, out of it; its height h is that of its outline at the column:

    sigma = 6 sum(R d) / (t h²) + 6 sum(R o) / (h t²)        so that the least height h solves
    s h² - 6 sum(R o) / t² h - 6 sum(R d) / t = 0            s: yield over the safety of the columns      [beam theory]

It is never lower than its housings are wide, nor does it reach to the reducer of a cam shaft.

A shaft comes with its bearings on it, from the side away from the column: there its bore is a slot to the plate's edge.
Each of the two arms beside the slot bears half of the bearing's force, at the farther screw, and is bent as above, d
from that screw to the shaft's axis. The slot of a bearing that slides with the cams is open upwards; a cap closes it
when the shaft is in.
Side view: complex, x to the front, y up from the fell [m].
The back rest lies on a beam from bracket to bracket, which bears the warps' pull P down and to the back, sqrt(2) P.
"""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.beam import uniform
from ilmek.elements.columns import SECTIONS, STEEL, HollowSquare
from ilmek.elements.field_devices import STRAIN
from ilmek.elements.machine_screws import SOCKET_SCREWS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import ROOM, part_id
from ilmek.machines.bearing_seats import BRACKET, BearingSeat, least_height
from ilmek.machines.beat import GUIDED
from ilmek.machines.shedding.tree import bearing_inner, reducer
from ilmek.machines.warp_tension.cylinders import cylinders
from ilmek.machines.warp_tension.tree import winding_reducer
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, rectangle
from ilmek.plane.contours import circle, rounded_hull, slotted
from ilmek.plane.curves import hull
from ilmek.records import record
from ilmek.report import Check, Contour, at_least, at_most
from ilmek.units import mm, um

BACK_REST_SAG = 2e-3
"""Deflection of the back rest's beam over its width, as that of the compensator's; assumed by this project."""


_STEP = 5 * mm
"""Heights of brackets are multiples of this [m]."""

CAP = 20 * mm
"""Height of the cap over the slot of a bearing that slides [m]; assumed by this project."""

_CORNER = 5 * mm
"""Radius of the corners of a bracket with a slot [m]."""

_CURE = "set a lower tension, or a narrower carpet"


@record
class Bracket:
    """A plate of a side of the loom, alike on both sides.

    name, title   of the part                         inner   face from the middle of the width [m]
    nodes         that its outline surrounds [m]          ends    of their hull at the column's axis, its heights [m]
    radius        of the outline about them [m]
    bores         through it beside the shaft's [m]
    seat, axis    of the bearing on it, of its shaft in the side view [m]
    opening       direction in which the shaft's bore is open; None: it is closed
    root          where the slot of that begins in the side view [m]: at the axis, or at the end of its travel
    load, moment  sum of the forces [N], and of their moments about the column's axis in its plane, out of it [N m]
    """

    name: str
    title: str
    inner: float
    nodes: ComplexArray
    ends: tuple[float, float]
    radius: float
    bores: tuple[Contour, ...]
    seat: BearingSeat
    axis: complex
    opening: complex | None
    root: complex
    load: float
    moment: tuple[float, float]

    @property
    def outer(self) -> float:
        """Outer face from the middle of the width [m]."""
        return self.inner + BRACKET

    @property
    def plate(self) -> Prism:
        """The plate in the side view, from z = 0."""
        outline = rounded_hull(self.nodes, self.radius)
        if self.opening is not None:
            outline = slotted(outline, self.root, self.opening, self.seat.bore / 2)
        return Prism(Profile(outline, self.bores), BRACKET)

    @property
    def cap(self) -> tuple[Prism, complex] | None:
        """The plate across the slot of a bearing that slides, and its middle in the side view [m]; None of others."""
        if self.opening is None or self.root == self.axis:
            return None
        edge = self.axis + 1j * (float(self.nodes.imag.max()) + self.radius + CAP / 2 - self.axis.imag)
        return Prism(Profile(rectangle(self.seat.side, CAP)), BRACKET), edge

    @property
    def stress(self) -> float:
        """Greatest stress at the column, or beside the slot [Pa]; a cap makes a slot a closed one."""
        at_column = 6 * self.moment[0] / (BRACKET * self.depth**2) + 6 * self.moment[1] / (self.depth * BRACKET**2)
        closed = self.opening is None or self.cap is not None
        return at_column if closed else max(at_column, arm_stress(self.seat, self.radius))

    @property
    def depth(self) -> float:
        """Height of the outline at the column [m], more where its edges slope there."""
        return self.ends[1] - self.ends[0] + 2 * self.radius


def arm_stress(seat: BearingSeat, edge: float) -> float:
    """Greatest stress beside the slot of a seat's shaft [Pa]; edge  of the plate, from the shaft's axis [m]."""
    height = edge - seat.bore / 2
    lever, aside = float(seat.corners().real.max()), (seat.bearing.width + BRACKET) / 2
    return 3 * seat.force * (lever / (BRACKET * height**2) + aside / (height * BRACKET**2))


@record
class Brackets:
    """The brackets of a side.

    shafts   of spacer, lower cylinder, and each cam shaft        upper   of upper cylinder, back rest and compensator
    beam     section of the back rest's beam, `rest` its axis in the side view [m], `pull` on it [N]
    """

    upper: Bracket
    shafts: tuple[Bracket, ...]
    beam: HollowSquare
    rest: complex
    pull: float

    @property
    def plates(self) -> tuple[Bracket, ...]:
        """All of them."""
        return (self.upper, *self.shafts)

    @property
    def face(self) -> float:
        """Inner face of the columns from the middle of the width [m]."""
        return max(plate.outer for plate in self.plates)


@lru_cache(maxsize=4)
def brackets_of(loom: LoomDesign) -> Brackets:
    """The brackets of a loom, of the heights that their loads need."""
    side, far = loom.side, loom.warp_tension.params.span / 2 + loom.warp_tension.params.stub
    upper, lower, spacer = cylinders(loom.warp_tension)
    pull = math.sqrt(2) * loom.warp_tension.loads.worst
    beam = _beam(loom, pull)
    rest = _beside_the_back_rest(loom, beam)
    seats = [(spacer.name, side.spacer.at, spacer), (lower.name, side.lower.at, lower)]
    most, flange = abs(side.spacer.at - side.lower.at) / 2 - ROOM / 2, winding_reducer(loom.warp_tension)
    shafts = [
        _of_seat(
            *(loom, f"{name}-bracket", f"bracket of the {name} cylinder", far, flange),
            *((at, one.seat, one.reaction), most),
        )
        for name, at, one in seats
    ]
    return Brackets(
        _upper(loom, far, (side.upper.at, upper.seat, upper.reaction), (rest, beam, pull / 2)),
        (*shafts, *_of_cam_shafts(loom)),
        beam,
        rest,
        pull,
    )


@record
class CarriedBeam:
    """A beam of a machine from bracket to bracket: axis in the side view [m], direction of its sides, section."""

    axis: complex
    side: complex
    section: HollowSquare


def compensator_beams(loom: LoomDesign) -> tuple[CarriedBeam, ...]:
    """The beams of the compensator; none without one."""
    machine = loom.machines.get("tension-compensator")
    if machine is None:
        return ()
    room, design = loom.side.compensator, machine.design
    middle, section = room.corner + room.size / 2, design.members.beam
    return tuple(CarriedBeam(middle + 1j * axis, 1j * side, section) for axis, side in design.beams)


def _upper(
    loom: LoomDesign,
    far: float,
    cylinder: tuple[complex, BearingSeat, float],
    rest: tuple[complex, HollowSquare, float],
) -> Bracket:
    """The plate that surrounds upper cylinder, back rest's beam and the compensator's."""
    (at, seat, reaction), (beam, section, force) = cylinder, rest
    column, carried = loom.side.column, compensator_beams(loom)
    nodes = np.array([at, beam, *(one.axis for one in carried)])
    bearing = (seat.bearing.width + BRACKET) / 2
    loads = [(reaction, abs(at.real - column), bearing), (force, abs(beam.real - column), BRACKET / 2)]
    loads += [(force, abs(one.axis.real - column), BRACKET / 2) for one in carried]
    moment = sum(load * lever for load, lever, _ in loads), sum(load * aside for load, _, aside in loads)
    sides = max([section.side, *(one.section.side for one in carried)]) / math.sqrt(2)
    flange = catalogue.screwed_radius(winding_reducer(loom.warp_tension))
    ends = _crossed(nodes, column)
    return Bracket(
        "upper-bracket",
        "bracket of upper cylinder, back rest and compensator",
        far + seat.bearing.width,
        nodes,
        ends,
        _radius(loom, moment, ends, max(seat.radius, sides, flange), _over_reducers(loom, nodes)),
        screw_bores(seat, np.array([at])),
        seat,
        at,
        complex(at.real - column),
        at,
        sum(load for load, *_ in loads),
        moment,
    )


def _crossed(nodes: ComplexArray, x: float) -> tuple[float, float]:
    """Heights at which the hull of some nodes on both sides of x [m] crosses it, the lower first."""
    starts = hull(nodes)
    ends = np.roll(starts, -1)
    over = (starts.real - x) * (ends.real - x) < 0
    starts, along = starts[over], (ends - starts)[over]
    heights = starts.imag + (x - starts.real) * along.imag / along.real
    return float(heights.min()), float(heights.max())


def _over_reducers(loom: LoomDesign, nodes: ComplexArray) -> float:
    """Radius about the hull of some nodes that leaves room for the reducers of the cam shafts below [m]."""
    around, most = hull(nodes), math.inf
    edges = np.roll(around, -1) - around
    for index, cam in enumerate(loom.side.cams):
        share = np.clip((np.conj(edges) * (cam.at - around)).real / np.abs(edges) ** 2, 0.0, 1.0)
        distance = float(np.abs(around + share * edges - cam.at).min())
        most = min(most, distance - catalogue.face_of(reducer(loom.shedding, index)) / math.sqrt(2) - ROOM)
    return most


def _of_seat(  # noqa: PLR0917
    loom: LoomDesign,
    name: str,
    title: str,
    far: float,
    driven: Part,
    carried: tuple[complex, BearingSeat, float],
    most: float = math.inf,
    shift: ComplexArray | None = None,
) -> Bracket:
    """The bracket of a bearing; of one that slides by shifts [m] with a slot.

    far  of the bearing's inner side from the middle [m]      driven  reducer on it
    carried  axis, seat and force      most  radius [m]
    """
    at, seat, force = carried
    moved = at + (np.zeros(1, complex) if shift is None else shift)
    moment = force * abs(at.real - loom.side.column), force * (seat.bearing.width + BRACKET) / 2
    ends, half = (float(moved.imag.min()), float(moved.imag.max())), seat.side / 2
    flange = catalogue.screwed_radius(driven)
    radius = min(_radius(loom, moment, ends, max(seat.radius, flange)), max(most, half, flange))
    if shift is not None:  # square at its end: a round one would reach farther to what lays the weft
        ends, radius = (ends[0] - radius + _CORNER, ends[1] + radius - _CORNER), _CORNER
        moved_ends, beyond = at.real + 1j * np.array(ends), seat.half_width(driven) - _CORNER
    else:
        # Where the outline is lower than the circle about the seat, it reaches farther, about the seat's corners.
        moved_ends, beyond = moved, max(half - math.sqrt(radius**2 - half**2), 0.0) if radius < seat.radius else 0.0
    outer = moved_ends + math.copysign(beyond, at.real - loom.side.column)
    nodes = np.concatenate([outer, loom.side.column + 1j * moved_ends.imag])
    bores, inner = screw_bores(seat, moved), far + seat.bearing.width
    opening: complex | None = complex(at.real - loom.side.column) if shift is None else 1j
    root = complex(moved[np.argmin(moved.imag)])
    if np.ptp(moved.real) > um:  # no straight slot
        bores, opening = (rounded_hull(moved, seat.bore / 2), *bores), None
    return Bracket(name, title, inner, nodes, ends, radius, bores, seat, at, opening, root, force, moment)


def screw_bores(seat: BearingSeat, moved: ComplexArray) -> tuple[Contour, ...]:
    """The bores for the screws of a seat, at its positions [m]: slots where it moves."""
    screw, corners = seat.screws.screw.diameter / 2, seat.corners()
    if len(moved) == 1:
        return tuple(circle(complex(moved[0] + corner), screw) for corner in corners)
    sides = (corners[corners.real > 0], corners[corners.real < 0])
    return tuple(rounded_hull(np.add.outer(moved, side).ravel(), screw) for side in sides)


def _of_cam_shafts(loom: LoomDesign) -> Iterator[Bracket]:
    design, shift = loom.shedding, None
    if loom.params.beat == GUIDED:
        assert loom.beat.path is not None
        shift = loom.beat.path.tip - loom.beat.path.tip[0]
    for index, (cam, shaft) in enumerate(zip(loom.side.cams, design.shafts, strict=True)):
        number = f" {index + 1}" if len(design.shafts) > 1 else ""
        name, title = f"cam-bracket{number.replace(' ', '-')}", f"bracket of the cam shaft{number}"
        far, carried = bearing_inner(design, index), (cam.at, shaft.seat, shaft.shaft.seat.reaction)
        yield _of_seat(loom, name, title, far, reducer(design, index), carried, shift=shift)


def _radius(
    loom: LoomDesign, moment: tuple[float, float], ends: tuple[float, float], least: float, most: float = math.inf
) -> float:
    """Radius about a hull [m] for the height at the column that the moments need, from least to most."""
    height = least_height(moment, STEEL.strength / loom.params.column_safety) - (ends[1] - ends[0])
    return max(min(math.ceil(height / 2 / _STEP) * _STEP, most), least)


def _beam(loom: LoomDesign, pull: float) -> HollowSquare:
    """The lightest section of the back rest's beam that keeps its checks and has threads for its sensor, else the
    largest.
    """
    screws = [SOCKET_SCREWS[holes.thread].engaged(STEEL.name) for holes in STRAIN.holes]
    sections = (HollowSquare(*size) for size in SECTIONS)
    offered = sorted((one for one in sections if one.wall > max(screws) - um), key=lambda one: one.area)
    return next((one for one in offered if all(check.ok for check in _beam_checks(loom, one, pull))), offered[-1])


def _beam_checks(loom: LoomDesign, section: HollowSquare, pull: float) -> tuple[Check, Check]:
    width = loom.task.width
    load = pull / width
    sag = float(uniform.deflection_max(load, width, STEEL.modulus, section.inertia))
    stress = float(uniform.bending_stress(uniform.moment_max(load, width), section.side / 2, section.inertia))
    parts = (part_id("back-rest-beam"), part_id("back-rest"))
    limit = STEEL.strength / loom.params.column_safety
    return (
        at_most("frame: sag of the back rest", sag, BACK_REST_SAG * width, "mm", "2 mm a m").with_cure(_CURE, *parts),
        at_most(
            "frame: stress of the back rest's beam", stress, limit, "MPa", "yield of S235 over column_safety"
        ).with_cure(_CURE, *parts),
    )


def _beside_the_back_rest(loom: LoomDesign, beam: HollowSquare) -> complex:
    """Axis of the beam under the back rest: they touch, and its front keeps off the warps [m]."""
    rest = loom.side.back_rest
    front = rest.at.real + min(beam.side / 4, rest.radius - loom.params.clearance)
    return complex(front - beam.side / 2, rest.at.imag - rest.radius - beam.side / 2)


def bracket_checks(loom: LoomDesign, made: Brackets, column: HollowSquare) -> tuple[Check, ...]:
    """Stress of each bracket, sag and stress of the back rest's beam, and the room of the columns."""
    limit, side = STEEL.strength / loom.params.column_safety, loom.side
    stresses = (
        at_most(
            f"frame: stress of the {plate.title}", plate.stress, limit, "MPa", "yield of S235 over column_safety"
        ).with_cure(_CURE, part_id(plate.name))
        for plate in made.plates
    )
    behind, before = side.column_room
    gap = (before - behind - column.side) / 2
    source = "between the bearings of upper and lower cylinders; assumed by this project"
    room = at_least("frame: room of a column", gap, ROOM, "mm", source).with_cure(_CURE, part_id("column"))
    seats = (
        plate.seat.check(f"frame: bearing on the {plate.title}", _CURE, part_id(plate.name)) for plate in made.plates
    )
    return (*stresses, *seats, *_beam_checks(loom, made.beam, made.pull), room)
