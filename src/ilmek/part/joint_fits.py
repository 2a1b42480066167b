"""Joints that move without a fit: nothing says how close what runs or slides in them is.

A joint has its fit from a bore and what moves in it, from faces that slide on each other, or from a bought part that
brings it: a guide, an axis, or a device that moves in itself. A bore with a keyway has its fit for a shaft that is not
in the tree; an envelope, whose form is not designed, has none; seats that a hand moves in each other have play that
general tolerances keep. What magnets draw along has no bearing, and what a
closure fixes to another body moves in the fit of that.
"""

from collections.abc import Iterator

from ilmek.part.features import features_of_size
from ilmek.part.meetings import guide_seats, meetings, slide_seats
from ilmek.part.part import Part
from ilmek.part.tree import STANDING, JointKind, RigidBody, Tree

MAGNET = "magnet"
"""Process of the parts that hold bodies together across a gap."""


def joints_without_fit(tree: Tree) -> tuple[str, ...]:
    """Ids of the bodies that move in no fit, and of the parts that turn in none."""
    moving = [meeting for meeting in meetings(tree) if meeting.joint is not JointKind.FIXED]
    parts = {part for meeting in moving for part in (meeting.bore.part.id, meeting.inner.part.id)}
    fitted = {meeting.body for meeting in moving} | {seat.body for seat in (*slide_seats(tree), *guide_seats(tree))}
    led = set(_led(tree))

    def loose(body: RigidBody) -> bool:
        own = [occurrence.part for occurrence in body.occurrences]
        brought = all(part.purchase is not None or part.envelope for part in own)
        brought = brought or bool(body.joint.hand and body.joint.seats)
        brought = brought or any(part.id in parts or _keyed(part) for part in own)
        return not (body.joint.kind in STANDING or brought or body.id in fitted or body.id in led)

    turning = (own.part.id for body in tree.bodies for own in body.occurrences if own.turning)
    return (*(body.id for body in tree.bodies if loose(body)), *(part for part in turning if part not in parts))


def _keyed(part: Part) -> bool:
    """Whether it has a bore with a keyway."""
    return part.shape is not None and any(feature.inside and feature.keyway for feature in features_of_size(part.shape))


def _led(tree: Tree) -> Iterator[str]:
    """Ids of the bodies that magnets draw along, or that are fixed to another."""
    magnets = {part.id for part, _ in tree.occurrences() if part.process == MAGNET}
    for closure in tree.closures:
        if closure.kind is JointKind.FIXED or magnets & {*closure.kept_by}:
            yield from closure.bodies[:1] if closure.kind is JointKind.FIXED else closure.bodies[1:]
