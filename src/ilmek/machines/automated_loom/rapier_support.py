"""What the frame holds a rapier's side with: on both sides an arm with a beam along the edge, a post under the far end.

Axes of the scene. The arms lead from the fronts of the columns to the front; each carries a beam towards the cloth, to
which the plate of an edge is bolted. The axis of the rapier lies on the left beam, and on the post. With the weight W
of all on the weft side, and the inertia m a of what runs, half on each side as on a cantilever of the length l of arm
and beam, and W along the post of the height h, free at its end:

    s = sqrt(W² + (m a)²) l³ / (6 E I),   W / P,   P = pi² E I / (2 h)²                     [theory of beams; Euler]
"""

import math
from collections.abc import Iterator

from ilmek.elements.columns import STEEL, HollowSquare, ascending, euler
from ilmek.elements.materials import GRAVITY
from ilmek.machines.automated_loom.anchors import anchored
from ilmek.machines.automated_loom.brackets import brackets_of
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import EAR, END_PLATE, end_plate, member, part_id
from ilmek.machines.beat import GUIDED
from ilmek.machines.shedding.tree import reducer
from ilmek.machines.weft.carriers import AXIS
from ilmek.machines.weft.rapier_tree import POST_INSET, SIDE, RapierSide
from ilmek.part import catalogue
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, placement
from ilmek.part.tree import Occurrence
from ilmek.records import record
from ilmek.report import Check, at_least, at_most
from ilmek.units import mm

LEAST = 0.05 * mm
"""Shorter arms are left out [m]."""

SAG = 0.5 * mm
"""Allowed deflection at the end of a beam along the edge [m]: assumed by this project."""

BUCKLING = 3.0
"""Of the post against buckling; assumed by this project."""

SOLE = (150 * mm, 10 * mm)
"""Side and thickness of the post's plate on the floor [m]: assumed by this project."""


@record
class RapierSupport:
    """Section of arms, beams and post; weight on them and inertia [N]; reach of arm and beam, height of the post [m].

    side    the rapier's, its carrier's middle in the side view [m]
    face, front, column  of the columns: inner face from the middle of the width, front in the side view, side [m]
    gap     of the axis from brackets that let cams sink [m], None where they do not; clearance: allowed [m]
    lowest  height to which drives of cams sink over the arms [m]; inf where they do not
    """

    side: RapierSide
    middle: complex
    section: HollowSquare
    weight: float
    inertia: float
    reach: float
    height: float
    face: float
    front: float
    column: float
    gap: float | None
    clearance: float
    lowest: float

    @property
    def drop(self) -> float:
        """How far the arms lie below the beams [m]: level with them, or under them below drives that sink."""
        above = self.middle.imag + self.side.low + self.clearance - self.lowest
        return max(above, self.section.side) if above > 0 else 0.0

    @property
    def bearing(self) -> tuple[Check, Check]:
        """Deflection of arms and beams, buckling of the post."""
        return _checks(self.section, self.weight, self.inertia, self.reach + self.drop, self.height)

    @property
    def checks(self) -> tuple[Check, ...]:
        """What bears, and room before the brackets of the cam shafts."""
        if self.gap is None:
            return self.bearing
        source = "parameter clearance; the axis begins beside the cloth, before the brackets"
        room = at_least(
            "clearance: brackets of the cam shafts and axis of the rapier", self.gap, self.clearance, "mm", source
        ).with_cure("set weft=shuttle with another beat, or a larger lift", AXIS)
        return (*self.bearing, room)


def rapier_support(loom: LoomDesign, face: float, column: float) -> RapierSupport:
    """The lightest section that keeps its checks; the largest where none does.

    face  inner face of the columns from the middle of the width [m]      column  side of their section [m]
    """
    bodies, middle = loom.weft.bodies, loom.side.carrier.corner + loom.side.carrier.size / 2
    rapier, front = bodies.rapier, loom.side.column + column / 2
    weight, inertia = bodies.tree.mass * GRAVITY, loom.weft.axis.mass * loom.weft.passage.acceleration
    reach = middle.real + rapier.plate_back - front + face + column / 2 - rapier.edge
    height = middle.imag + rapier.low - loom.side.floor - SOLE[1]
    # Brackets that let the cams sink reach down to the axis.
    _, _, *of_cams = brackets_of(loom).shafts
    before = middle.real - SIDE / 2 - max(float(own.nodes.real.max()) + own.radius for own in of_cams)
    gap, clearance, lowest = None, loom.params.clearance, math.inf
    if loom.params.beat == GUIDED:
        gap, lowest = before, _lowest_drive(loom)

    def made(section: HollowSquare) -> RapierSupport:
        return RapierSupport(
            rapier, middle, section, weight, inertia, reach, height, face, front, column, gap, clearance, lowest
        )

    sections = ascending()
    supports = map(made, sections)
    return next((own for own in supports if all(check.ok for check in own.bearing)), made(sections[-1]))


def _lowest_drive(loom: LoomDesign) -> float:
    """Height to which reducers and motors of the cam shafts sink [m]."""
    assert loom.beat.path is not None
    sunk = float((loom.beat.path.tip - loom.beat.path.tip[0]).imag.min())
    halves = (catalogue.face_of(reducer(loom.shedding, index)) / 2 for index in range(len(loom.side.cams)))
    return min(cam.at.imag - half for cam, half in zip(loom.side.cams, halves, strict=True)) + sunk


def _checks(section: HollowSquare, weight: float, inertia: float, reach: float, height: float) -> tuple[Check, Check]:
    sag = math.hypot(weight, inertia) / 2 * reach**3 / (3 * STEEL.modulus * section.inertia)
    cure = "set a lower weft.acceleration, or weft=shuttle"
    return (
        at_most(
            "deflection of the arms of the rapier's side", sag, SAG, "mm", "weight and inertia; assumed by this project"
        ).with_cure(cure, part_id("weft-beam")),
        at_least(
            "post of the rapier's axis against buckling",
            euler(2 * height, section) / weight,
            BUCKLING,
            "1",
            "Euler's load, assumed by this project",
        ).with_cure(cure, part_id("weft-post")),
    )


def rapier_supports(support: RapierSupport) -> Iterator[Occurrence]:
    """Arms, beams, and the post on its plate; they belong to the frame's body."""
    side, rapier, middle = support.section.side, support.side, support.middle
    y, z = middle.imag + rapier.low - side / 2, middle.real + rapier.plate_back
    beside, inner = support.face + support.column / 2, rapier.edge - SIDE / 2
    gap = z - side - support.front + (side if support.drop else 0.0)
    if gap > LEAST:
        arm = member("weft-arm", "arm of the rapier's side", support.section, gap)
        yield Occurrence(arm, tuple(placement(x, y - support.drop, support.front) for x in (-beside, beside)))
    if (high := support.drop - side) > LEAST:
        riser = member("weft-riser", "post on an arm of the rapier's side", support.section, high)
        yield Occurrence(
            riser, tuple(placement(x, y - side / 2 - high, z - side / 2).after(UPRIGHT) for x in (-beside, beside))
        )
    long = beside + side / 2 - inner
    beam = member("weft-beam", "beam along an edge of the cloth", support.section, long)
    starts = (-beside - side / 2, inner)
    yield Occurrence(beam, tuple(placement(x, y, z - side / 2).after(ALONG_WIDTH) for x in starts))
    long = support.height - END_PLATE
    post = member("weft-post", "post of the rapier's axis", support.section, long)
    low, x = middle.imag + rapier.low - support.height, rapier.run[0] + POST_INSET
    foot = placement(x, low, middle.real).after(UPRIGHT)
    yield Occurrence(post, (foot,))
    plate = end_plate("weft-post-plate", "plate of the post for the rapier's axis", support.section, EAR)
    yield Occurrence(plate, (foot.after(placement(z=long, about=(0.0, 0.0, 1.0), angle=math.pi / 2)),))
    title, on_floor, half = "plate under the post of the rapier's axis", foot.after(placement(z=-SOLE[1])), SOLE[0] / 3
    holes = [complex(across, along) for across in (-half, half) for along in (-half, half)]
    yield from anchored("weft-sole", title, (SOLE[0], SOLE[0], SOLE[1]), holes, (on_floor,))
