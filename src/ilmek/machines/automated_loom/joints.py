"""The frame's welded joints, and whether the loom stands: each seam by the loads of what it holds.

A bracket is welded to its column, or to the spacer between, along both edges of that: two seams of the height that they
share, which bear its forces, their moment in the bracket's plane and the one out of it. A post is welded all round its
foot, with the moment that its forces have there. Each seam has the least throat that bears it.

The loom tips about the ends of its feet: the weight on its lever there, over the beat's force on its height.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

from ilmek.elements.fillet_welds import STRENGTH, RoundSquare, TwoSeams, throat_for
from ilmek.machines.automated_loom.brackets import Bracket, brackets_of
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.feet import FOOT
from ilmek.machines.automated_loom.frame import LoomFrame, part_id, welded_to
from ilmek.machines.automated_loom.rail_supports import rail_supports
from ilmek.machines.automated_loom.standing_frame import LEVELLING_FOOT, foot_reach
from ilmek.machines.automated_loom.steady_posts import steady_post
from ilmek.machines.automated_loom.supports import beat_beam, supports
from ilmek.machines.bearing_seats import BRACKET
from ilmek.part.tree import Occurrence, RigidBody
from ilmek.records import record
from ilmek.report import Check, at_least, at_most
from ilmek.units import format_quantity

TIPPING = 1.5
"""Least weight's moment over that of the beat's force; assumed by this project."""

_SOURCE = "EN 1993-1-8, 4.5.3.3, S235"


@record
class Seam:
    """A weld of the frame: what is welded by it, its throat [m], and the force on its length [N/m]."""

    title: str
    part: str
    throat: float
    force: float

    @property
    def check(self) -> Check:
        """Its stress in the throat."""
        label = f"frame: weld of the {self.title}"
        source = f"{_SOURCE}; throat {format_quantity(self.throat, 'mm')}"
        cure = "set a lower tension, or a narrower carpet"
        return at_most(label, self.force / self.throat, STRENGTH, "MPa", source).with_cure(cure, part_id(self.part))


@lru_cache(maxsize=4)
def seams(loom: LoomDesign, frame: LoomFrame) -> tuple[Seam, ...]:
    """The welds of brackets and posts."""
    brackets = brackets_of(loom)
    return (*(_of_bracket(frame, brackets.face, plate) for plate in brackets.plates), *_of_posts(loom, frame))


def with_throats(body: RigidBody, made: tuple[Seam, ...]) -> RigidBody:
    """A body whose parts have the throats of their seams."""
    throats = {part_id(seam.part): seam.throat for seam in made}

    def held(own: Occurrence) -> Occurrence:
        throat = throats.get(own.part.id)
        return own if throat is None else replace(own, part=replace(own.part, throat=throat))

    return replace(body, occurrences=tuple(map(held, body.occurrences)))


def _of_bracket(frame: LoomFrame, face: float, bracket: Bracket) -> Seam:
    section = welded_to(frame, bracket.depth) if face > bracket.outer else frame.column
    weld = TwoSeams(bracket.depth, section.side)
    force = weld.force(bracket.load, *bracket.moment)
    return Seam(bracket.title, bracket.name, throat_for(force, *sorted((section.wall, BRACKET))), force)


def _of_posts(loom: LoomDesign, frame: LoomFrame) -> Iterator[Seam]:
    """Each post at its foot, by its force and the moment of that."""
    held = supports(loom, frame)
    moment = held.force * held.height if held.across else 0.0
    yield post_seam("post of the beat", "beat-post", held.post.side, held.post.wall, held.force, moment)
    for own in rail_supports(loom, frame):
        bent = own.load * own.lever + own.push * own.height
        title = "post of the rail" if own.name == "rail-post" else "post of the rail between its ends"
        yield post_seam(title, own.name, own.post.side, own.post.wall, own.load + own.push, bent)
        arm = title.replace("post", "arm")
        yield post_seam(arm, own.arm_name, own.arm.side, own.arm.wall, own.load, own.load * own.reach)
    post = steady_post(loom, frame, brackets_of(loom))
    if post is not None:
        section, force = post.section, post.force
        yield post_seam("post of the steadies", "steady-post", section.side, section.wall, force, force * post.arm)


def post_seam(  # noqa: PLR0917
    title: str, part: str, side: float, wall: float, force: float, moment: float
) -> Seam:
    """The weld round a post or an arm of a square section at its root, by its force and the moment of that."""
    on_length = RoundSquare(side).force(force, moment)
    return Seam(title, part, throat_for(on_length, wall), on_length)


def joint_checks(loom: LoomDesign, frame: LoomFrame) -> tuple[Check, ...]:
    """Stress of each weld, load of the feet, and whether the loom tips."""
    tips = tipping(loom, frame)
    return (*(seam.check for seam in seams(loom, frame)), foot_check(frame), *((tips,) if tips else ()))


def foot_check(frame: LoomFrame) -> Check:
    """Load of a levelling foot against its rating."""
    source, parts = f"rating of {frame.foot.name}", (LEVELLING_FOOT,)
    cure = "set a narrower carpet"
    return at_most("load of a levelling foot", frame.foot_load, frame.foot.rating, "N", source).with_cure(cure, *parts)


def tipping(loom: LoomDesign, frame: LoomFrame) -> Check | None:
    """Whether the loom stays on its feet while it beats; the weight at the columns' axis, the beat at its beam. None
    where nothing pushes it along the warps.
    """
    held, weight = supports(loom, frame), 2 * frame.number * frame.foot_load
    lever, (_, corner) = min(foot_reach(loom, frame)), beat_beam(loom.beat)
    height = corner.imag - loom.side.floor
    pushes = sum(own.push * len(own.stations) * (own.height + FOOT) for own in rail_supports(loom, frame))
    moment = (loom.beat.frame_force * height if held.across else 0.0) + pushes
    if moment == 0:
        return None
    source = "weight at the columns against the beat at its beam; assumed by this project"
    return at_least("frame: against tipping over its feet", weight * lever / moment, TIPPING, "1", source).with_cure(
        "set a lower speed of the crank, or bolt the feet to the floor", LEVELLING_FOOT
    )
