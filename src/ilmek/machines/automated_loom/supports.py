"""What the frame holds beat and weft with: posts under the beat's beam, and the tube behind the shuttle's bar.

Axes of the scene, as in `own_parts`. The posts stand on the feet of the frame, beside the cylinders; a foot too short
for that is lengthened. Each bears half of what the beam carries, across at its end: stress F h c / (2 I) and deflection
F h³ / (6 E I) [cantilevers]. The tube lies between the columns and stiffens the bar, which reaches beyond them: it
bears the pull of the magnets, across, in its middle.
"""

from collections.abc import Iterator

from ilmek.elements.columns import STEEL, HollowSquare, ascending, euler
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import LoomFrame, part_id
from ilmek.machines.beat_up.beam import POST, BeatBeam
from ilmek.machines.beat_up.carriage import beam_corner
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.hammer.tree import beam_of
from ilmek.machines.weft import Shuttle
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, placement
from ilmek.part.shapes import square_tube
from ilmek.part.tree import Occurrence
from ilmek.records import record
from ilmek.report import Check, at_least, at_most
from ilmek.units import format_quantity, mm

COLUMN_FRONT = 40 * mm
"""Front of the columns before the axis of the spacer cylinder [m]: thicker ones reach farther back; assumed here."""

POST_SAFETY = 2.0
"""Of the posts against yielding; assumed by this project."""

BUCKLING = 3.0
"""Of a post against buckling; assumed by this project."""

POST_SWAY = 1 / 1000
"""Allowed deflection of a post's end over its height; assumed by this project."""

TUBE_SAG = 0.5 * mm
"""Allowed deflection of the tube by the magnets' pull [m]: it widens their gap; assumed by this project."""


@record
class LoomSupports:
    """Section, height [m] and force [N] of a post, whether it is across; section of the tube, None where there is none,
    its span [m] and the pull on it [N].
    """

    post: HollowSquare
    height: float
    force: float
    across: bool
    tube: HollowSquare | None
    span: float
    pull: float

    @property
    def checks(self) -> tuple[Check, ...]:
        """Strength and stiffness of both."""
        posts = _post_checks(self.post, self.height, self.force, across=self.across)
        return (*posts, *(() if self.tube is None else _tube_checks(self.tube, self.span, self.pull)))


def supports(loom: LoomDesign, frame: LoomFrame) -> LoomSupports:
    """The lightest sections that keep their checks; the largest where none does."""
    made, (beam, corner) = loom.weft.carried, beat_beam(loom)
    height, across = corner.imag - loom.side.floor - frame.column.side, loom.beat.crank_rockers > 0
    # The axes of a comb press along the posts; their beam counts half of what is spread over it.
    force = beam.carried / 2 if across else beam.carried
    posts = (one for one in ascending() if all(check.ok for check in _post_checks(one, height, force, across=across)))
    post = next(posts, ascending()[-1])
    pull = made.coupling.pull if isinstance(made, Shuttle) else 0.0
    tube = None
    if isinstance(made, Shuttle):
        sections = (one for one in ascending() if all(c.ok for c in _tube_checks(one, loom.task.width, pull)))
        tube = next(sections, ascending()[-1])
    return LoomSupports(post, height, force, across, tube, loom.task.width, pull)


def column_front(loom: LoomDesign) -> float:
    """Front of the columns, behind the shuttle's bar, whatever their section [m]."""
    return loom.side.column + COLUMN_FRONT


def beat_beam(loom: LoomDesign) -> tuple[BeatBeam, complex]:
    """The beam that carries what beats, and its lower corner towards the warps in the side view [m]."""
    beat = loom.beat
    return (beat.use.beam, beam_corner(beat.design)) if isinstance(beat.design, BeatUp) else beam_of(beat.design)


def _post_checks(section: HollowSquare, height: float, force: float, *, across: bool) -> tuple[Check, ...]:
    """A force across at the end of a post, or along it, free at its end: buckling of twice its height."""
    parts = (part_id("beat-post"),)
    if not across:
        cure = "set a lower comb_acceleration"
        share, source = euler(2 * height, section) / force, "Euler's load, assumed by this project"
        return (at_least("posts of the beat against buckling", share, BUCKLING, "1", source, cure=cure, parts=parts),)
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
            cure=cure,
            parts=parts,
        ),
        at_most(
            "deflection of a post of the beat",
            sway,
            POST_SWAY * height,
            "mm",
            "height over 1000, assumed by this project",
            cure=cure,
            parts=parts,
        ),
    )


def _tube_checks(section: HollowSquare, span: float, pull: float) -> tuple[Check]:
    return (
        at_most(
            "deflection behind the shuttle's bar",
            pull * span**3 / (48 * STEEL.modulus * section.inertia),
            TUBE_SAG,
            "mm",
            "it widens the magnets' gap; assumed by this project",
            cure="set a narrower carpet, or weft=rapier",
            parts=(part_id("weft-tube"),),
        ),
    )


def support_bodies(loom: LoomDesign, frame: LoomFrame) -> Iterator[Occurrence]:
    """Posts with what lengthens the feet, and the tube; they belong to the frame's body."""
    held = supports(loom, frame)
    yield from _posts(loom, frame, held.post, held.height)
    if held.tube is not None:
        yield from _tube(loom, held.tube)


def _posts(loom: LoomDesign, frame: LoomFrame, post: HollowSquare, height: float) -> Iterator[Occurrence]:
    (beam, corner), side, foot = beat_beam(loom), loom.side, frame.column.side
    front = corner.real + beam.section.side / 2
    beside = loom.task.width / 2 + POST - post.side / 2
    ends = [beside * sign for sign in (-1, 1)]
    yield Occurrence(
        _member("beat-post", "post of the beat", post, height),
        tuple(placement(x, side.floor + foot, front).after(UPRIGHT) for x in ends),
    )
    begin = column_front(loom) + frame.task.depth
    short = front + post.side / 2 - begin
    if short > 0:
        apart = (loom.task.width + foot) / 2
        yield Occurrence(
            _member("longer-foot", "end of a foot", frame.column, short),
            tuple(placement(x, side.floor + foot / 2, begin) for x in (-apart, apart)),
        )


def _tube(loom: LoomDesign, section: HollowSquare) -> Iterator[Occurrence]:
    """Behind the bar, its upper side level with the bar's; distance pieces where the columns stand farther back."""
    middle = loom.side.carrier.corner + loom.side.carrier.size / 2
    rear, half = middle.real + loom.weft.bodies.guide.rear, section.side / 2
    wide, height = loom.task.width, middle.imag - half
    along = placement(-wide / 2, height, rear - half).after(ALONG_WIDTH)
    yield Occurrence(_member("weft-tube", "tube behind the shuttle's bar", section, wide), (along,))
    front = column_front(loom)
    if rear - front > section.wall:
        ends = tuple(placement(side * (wide / 2 + half), height, front) for side in (-1, 1))
        yield Occurrence(_member("weft-distance", "distance piece of the shuttle's bar", section, rear - front), ends)


def _member(name: str, title: str, section: HollowSquare, length: float) -> Part:
    size = f"{section.name}, {format_quantity(length, 'mm', 4)}"
    return Part(part_id(name), title, "welded frame", size, square_tube(section.side, section.wall, length), STEEL)
