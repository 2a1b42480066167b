"""What the frame holds beat and weft with: posts under the beat's beam, and the tube behind the shuttle's bar, or what
holds a rapier's side [`rapier_support`].

Axes of the scene, as in `own_parts`. The posts stand on a beam across between the front feet. Each bears half of what
the beat's beam carries, across at its end: stress F h c / (2 I) and deflection F h³ / (6 E I) [cantilevers]. The tube
lies before the columns, on arms, and stiffens the bar, which reaches beyond them: it bears the pull of the magnets,
across, in its middle. Each arm bears half of the weight W of the weft side and of the tube, and half of the inertia m a
of what runs, at its end: stress sqrt(W² + (m a)²) l c / (2 I) and deflection sqrt(W² + (m a)²) l³ / (6 E I).
"""

import math
from collections.abc import Iterator
from functools import lru_cache

from ilmek.elements.columns import STEEL, HollowSquare, ascending, euler
from ilmek.elements.materials import GRAVITY
from ilmek.machines.automated_loom.brackets import brackets_of
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.feet import FOOT
from ilmek.machines.automated_loom.frame import CARRIED, END_PLATE, ROOM, LoomFrame, member, part_id
from ilmek.machines.automated_loom.rapier_support import LEAST, RapierSupport, rapier_support, rapier_supports
from ilmek.machines.automated_loom.shaking import least_frequency, stiff_post
from ilmek.machines.beat import BeatDrive
from ilmek.machines.beat_up.beam import PAST_RAIL, BeatBeam
from ilmek.machines.beat_up.carriage import beam_corner
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.hammer.tree import beam_of
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.machines.weft import Shuttle
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, placement
from ilmek.part.tree import Occurrence
from ilmek.records import record
from ilmek.report import Check, at_least, at_most
from ilmek.units import mm

POST_SAFETY = 2.0
"""Of the posts against yielding; assumed by this project."""

BUCKLING = 3.0
"""Of a post against buckling; assumed by this project."""

POST_SWAY = 1 / 1000
"""Allowed deflection of a post's end over its height; assumed by this project."""

TUBE_SAG = 0.5 * mm
"""Allowed deflection of the tube by the magnets' pull [m]: it widens their gap; assumed by this project."""


@record
class TubeLoads:
    """What the tube behind the shuttle's bar and its arms bear.

    span     between the middles of the columns [m]       pull      of the magnets [N]
    front    of the columns, rear: of the guide's bar in the side view [m]
    weight   of the weft side [N]                         inertia   of what runs along it [N]
    """

    span: float
    pull: float
    front: float
    rear: float
    weight: float
    inertia: float

    def checks(self, section: HollowSquare) -> tuple[Check, ...]:
        """Deflection of the tube, stress and deflection of its arms, all of a section."""
        reach = max(self.rear - section.side / 2 - self.front, 0.0)
        force = math.hypot(self.weight + section.line_mass * GRAVITY * self.span, self.inertia) / 2
        arm, rigidity = (part_id("weft-arm"),), STEEL.modulus * section.inertia
        source, cure = "weight and inertia of the weft side", "set a lower weft.acceleration, or weft=rapier"
        return (
            at_most(
                "deflection behind the shuttle's bar",
                self.pull * self.span**3 / (48 * rigidity),
                TUBE_SAG,
                "mm",
                "it widens the magnets' gap; assumed by this project",
            ).with_cure("set a narrower carpet, or weft=rapier", part_id("weft-tube")),
            at_most(
                "stress of an arm of the tube",
                force * reach * section.side / 2 / section.inertia,
                STEEL.strength / POST_SAFETY,
                "MPa",
                f"{source}; yield of S235 over 2, assumed by this project",
            ).with_cure(cure, *arm),
            at_most(
                "deflection of an arm of the tube",
                force * reach**3 / (3 * rigidity),
                TUBE_SAG,
                "mm",
                f"{source}; assumed by this project",
            ).with_cure(cure, *arm),
        )


@record
class LoomSupports:
    """Section, height [m] and force [N] of a post, whether it is across; section of the tube with what it bears, None
    where there is none; what holds a rapier's side, or None.
    """

    post: HollowSquare
    height: float
    force: float
    across: bool
    tube: HollowSquare | None
    loads: TubeLoads | None
    rapier: RapierSupport | None

    @property
    def checks(self) -> tuple[Check, ...]:
        """Strength and stiffness of all."""
        posts = post_checks(self.post, self.height, self.force, across=self.across)
        tube = () if self.tube is None or self.loads is None else self.loads.checks(self.tube)
        return (*posts, *tube, *(() if self.rapier is None else self.rapier.checks))


@lru_cache(maxsize=4)
def supports(loom: LoomDesign, frame: LoomFrame) -> LoomSupports:
    """The lightest sections that keep their checks, of the posts one that is stiff too; the largest where none does."""
    made, (beam, corner) = loom.weft.carried, beat_beam(loom.beat)
    height, across = corner.imag - floor_top(loom, frame), loom.beat.crank_rockers > 0
    # The axes of a comb press along the posts; their beam counts half of what is spread over it.
    force = beam.carried / 2 if across else beam.carried
    post = post_for(
        height, force, sum(part.mass_all for part in loom.beat.parts) / 2, least_frequency(loom), across=across
    )
    if not isinstance(made, Shuttle):
        rapier = rapier_support(loom, brackets_of(loom).face, frame.column.side)
        return LoomSupports(post, height, force, across, None, None, rapier)
    loads = TubeLoads(
        span=2 * brackets_of(loom).face + frame.column.side,
        pull=made.coupling.pull,
        front=loom.side.column + frame.column.side / 2,
        rear=(loom.side.carrier.corner + loom.side.carrier.size / 2).real + loom.weft.bodies.guide.rear,
        weight=loom.weft.bodies.tree.mass * GRAVITY,
        inertia=loom.weft.axis.mass * loom.weft.passage.acceleration,
    )
    tube = next((square for square in ascending() if all(c.ok for c in loads.checks(square))), ascending()[-1])
    return LoomSupports(post, height, force, across, tube, loads, None)


@lru_cache(maxsize=16)
def beat_beam(beat: BeatDrive) -> tuple[BeatBeam, complex]:
    """The beam that carries what beats, and its lower corner towards the warps in the side view [m]."""
    return (beat.use.beam, beam_corner(beat.design)) if isinstance(beat.design, BeatUp) else beam_of(beat.design)


@lru_cache(maxsize=64)
def post_for(height: float, force: float, mass: float, least: float, *, across: bool) -> HollowSquare:
    """The lightest section of a post of the beat that keeps its checks and is stiff, else that is strong.

    height  [m]      force, mass  at its end [N, kg]      least  natural frequency of the frame [Hz]
    """
    strong = (
        square for square in ascending() if all(check.ok for check in post_checks(square, height, force, across=across))
    )
    return stiff_post(strong, height, mass, least) or ascending()[-1]


def post_checks(section: HollowSquare, height: float, force: float, *, across: bool) -> tuple[Check, ...]:
    """A force across at the end of a post, or along it, free at its end: buckling of twice its height."""
    parts = (part_id("beat-post"),)
    if not across:
        cure = "set a lower comb_acceleration"
        share, source = euler(2 * height, section) / force, "Euler's load, assumed by this project"
        return (at_least("posts of the beat against buckling", share, BUCKLING, "1", source).with_cure(cure, *parts),)
    stress = force * height * section.side / 2 / section.inertia
    sway = force * height**3 / (3 * STEEL.modulus * section.inertia)
    cure = "set a lower speed of the crank"
    return (
        at_most(
            "stress of a post of the beat",
            stress,
            STEEL.strength / POST_SAFETY,
            "MPa",
            "yield of S235 over 2, assumed by this project",
        ).with_cure(cure, *parts),
        at_most(
            "deflection of a post of the beat",
            sway,
            POST_SWAY * height,
            "mm",
            "height over 1000, assumed by this project",
        ).with_cure(cure, *parts),
    )


def rail_middle(loom: LoomDesign) -> complex:
    """Back of the heads' rail, where its axes of the retreat begin, in the side view [m]."""
    rail = loom.side.of_heads.rail
    return rail.corner + rail.size / 2


def post_depth(loom: LoomDesign, frame: LoomFrame) -> float:
    """Axis of the posts of the beat in the side view [m]: under the middle of its beam, or as near to it as the arms of
    the rail leave room.
    """
    beam, corner = beat_beam(loom.beat)
    middle, half = corner.real + beam.section.side / 2, supports(loom, frame).post.side / 2
    if loom.side.heads is None:
        return middle
    arm, apart = rail_middle(loom), RAIL_AXIS / 2 + ROOM + half
    if corner.imag <= arm.imag - RAIL_AXIS / 2 or abs(middle - arm.real) >= apart:
        return middle
    under = corner.real, corner.real + beam.section.side
    free = [depth for depth in (arm.real - apart, arm.real + apart) if under[0] <= depth <= under[1]]
    return min(free, key=lambda depth: abs(depth - middle), default=middle)


def base_section(loom: LoomDesign, frame: LoomFrame) -> HollowSquare:
    """Section of feet and beams at the floor: the columns', or the largest under the lowest bracket and reducer."""
    return within(frame.column, _under(loom) - ROOM - loom.side.floor - FOOT)


@lru_cache(maxsize=16)
def _under(loom: LoomDesign) -> float:
    """The lowest of the brackets and of the lower cylinder's reducer, in the side view [m]."""
    plates = (float(plate.nodes.imag.min()) - plate.radius for plate in brackets_of(loom).plates)
    return min(*plates, loom.side.lower.at.imag - loom.side.reducer)


def within(section: HollowSquare, room: float) -> HollowSquare:
    """The section, or where it is higher than its room [m] the largest that is not."""
    if section.side <= room:
        return section
    return next((other for other in reversed(ascending()) if other.side <= room), ascending()[0])


def floor_top(loom: LoomDesign, frame: LoomFrame) -> float:
    """Upper side of feet and beams at the floor, on which posts stand [m]."""
    return loom.side.floor + FOOT + base_section(loom, frame).side


def support_bodies(loom: LoomDesign, frame: LoomFrame, face: float) -> Iterator[Occurrence]:
    """Posts, and the tube with its arms; they belong to the frame's body.

    face  of the columns from the middle of the width [m]
    """
    held = supports(loom, frame)
    least = CARRIED + RAIL_AXIS + END_PLATE + ROOM + held.post.side / 2  # beside the rail's axis on its arm
    aside = loom.task.rail_length / 2 + max(PAST_RAIL - held.post.side / 2, least)
    ends = (-aside, aside)
    yield Occurrence(
        member("beat-post", "post of the beat", held.post, held.height),
        tuple(placement(x, floor_top(loom, frame), post_depth(loom, frame)).after(UPRIGHT) for x in ends),
    )
    if held.tube is not None:
        yield from _tube(loom, frame, held.tube, face)
    if held.rapier is not None:
        yield from rapier_supports(held.rapier)


def _tube(loom: LoomDesign, frame: LoomFrame, section: HollowSquare, face: float) -> Iterator[Occurrence]:
    """Behind the bar, its upper side level with that of the bar, on arms from the fronts of the columns.

    The arms stand at the columns' inner sides, or as far in as the drive of a narrow loom requires.
    """
    middle = loom.side.carrier.corner + loom.side.carrier.size / 2
    guide, half = loom.weft.bodies.guide, section.side / 2
    depth = middle.real + guide.rear - half
    beside = min(face + half, guide.drive_inner - loom.params.clearance - half)
    height, reach = middle.imag - half, beside + half
    along = placement(-reach, height, depth).after(ALONG_WIDTH)
    yield Occurrence(member("weft-tube", "tube behind the shuttle's bar", section, 2 * reach), (along,))
    front = loom.side.column + frame.column.side / 2
    gap = depth - half - front
    if gap > LEAST:
        arm = member("weft-arm", "arm of the tube", section, gap)
        yield Occurrence(arm, tuple(placement(x, height, front) for x in (-beside, beside)))
