"""What the frame holds beat and weft with: posts under the beat's beam, and the tube behind the shuttle's bar.

Axes of the scene, as in `own_parts`. The posts stand on the feet of the frame, beside the cylinders; a foot too short
for that is lengthened. Each bears half of what the beam carries, across at its end: stress F h c / (2 I) and deflection
F h³ / (6 E I) [cantilevers]. The tube lies between the columns and stiffens the bar, which reaches beyond them: it
bears the pull of the magnets, across, in its middle.
"""

from collections.abc import Iterator

from ilmek.elements.columns import STEEL, HollowSquare, ascending
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import LoomFrame, part_id
from ilmek.machines.beat_up.beam import POST, BeatBeam
from ilmek.machines.beat_up.carriage import beam_corner
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.weft import Shuttle
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, placement
from ilmek.part.shapes import square_tube
from ilmek.part.tree import Occurrence
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.units import format_quantity, mm

POST_SAFETY = 2.0
"""Of the posts against yielding; assumed by this project."""

POST_SWAY = 1 / 1000
"""Allowed deflection of a post's end over its height; assumed by this project."""

TUBE_SAG = 0.5 * mm
"""Allowed deflection of the tube by the magnets' pull [m]: it widens their gap; assumed by this project."""


@record
class LoomSupports:
    """Section and height [m] of the posts, section of the tube; None where there is nothing to hold."""

    post: HollowSquare | None
    height: float
    force: float
    tube: HollowSquare | None
    span: float
    pull: float

    @property
    def checks(self) -> tuple[Check, ...]:
        """Strength and stiffness of both."""
        posts = () if self.post is None else _post_checks(self.post, self.height, self.force)
        return (*posts, *(() if self.tube is None else _tube_checks(self.tube, self.span, self.pull)))


def supports(loom: LoomDesign, frame: LoomFrame) -> LoomSupports:
    """The lightest sections that keep their checks; the largest where none does."""
    beat, made = beat_beam(loom), loom.weft.carried
    post, height, force = None, 0.0, 0.0
    if beat is not None:
        linkage, beam = beat
        height = beam_corner(linkage).imag - loom.side.floor - frame.column.side
        force = beam.carried / 2
        post = next(
            (one for one in ascending() if all(check.ok for check in _post_checks(one, height, force))), ascending()[-1]
        )
    pull = made.coupling.pull if isinstance(made, Shuttle) else 0.0
    tube = None
    if isinstance(made, Shuttle):
        sections = (one for one in ascending() if all(c.ok for c in _tube_checks(one, loom.task.width, pull)))
        tube = next(sections, ascending()[-1])
    return LoomSupports(post, height, force, tube, loom.task.width, pull)


def beat_beam(loom: LoomDesign) -> tuple[BeatUp, BeatBeam] | None:
    """The crank-rocker and the beam that carries all of them; None where there is none."""
    beat = loom.beat
    if isinstance(beat.design, BeatUp):
        return beat.design, beat.use.beam
    linkage = beat.design.linkage
    return None if linkage is None else (linkage.one, linkage.beam)


def _post_checks(section: HollowSquare, height: float, force: float) -> tuple[Check, Check]:
    stress = force * height * section.side / 2 / section.inertia
    sway = force * height**3 / (3 * STEEL.modulus * section.inertia)
    cure, parts = "set a lower speed of the crank", (part_id("beat-post"),)
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
    if held.post is not None:
        yield from _posts(loom, frame, held.post, held.height)
    if held.tube is not None:
        yield _tube(loom, held.tube)


def _posts(loom: LoomDesign, frame: LoomFrame, post: HollowSquare, height: float) -> Iterator[Occurrence]:
    beat, side, foot = beat_beam(loom), loom.side, frame.column.side
    assert beat is not None
    linkage, beam = beat
    front = beam_corner(linkage).real + beam.section.side / 2
    ends = [(loom.task.width + POST) / 2 * sign for sign in (-1, 1)]
    yield Occurrence(
        _member("beat-post", "post of the beat", post, height),
        tuple(placement(x, side.floor + foot, front).after(UPRIGHT) for x in ends),
    )
    begin = side.column + foot / 2 + frame.task.depth
    short = front + post.side / 2 - begin
    if short > 0:
        beside = (loom.task.width + foot) / 2
        yield Occurrence(
            _member("longer-foot", "end of a foot", frame.column, short),
            tuple(placement(x, side.floor + foot / 2, begin) for x in (-beside, beside)),
        )


def _tube(loom: LoomDesign, section: HollowSquare) -> Occurrence:
    """Behind the bar, its upper side level with that of the bar."""
    middle = loom.side.carrier.corner + loom.side.carrier.size / 2
    depth = middle.real + loom.weft.bodies.guide.rear - section.side / 2
    along = placement(-loom.task.width / 2, middle.imag - section.side / 2, depth).after(ALONG_WIDTH)
    return Occurrence(_member("weft-tube", "tube behind the shuttle's bar", section, loom.task.width), (along,))


def _member(name: str, title: str, section: HollowSquare, length: float) -> Part:
    size = f"{section.name}, {format_quantity(length, 'mm', 4)}"
    return Part(part_id(name), title, "welded frame", size, square_tube(section.side, section.wall, length), STEEL)
