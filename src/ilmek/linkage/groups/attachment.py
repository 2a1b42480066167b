"""How a body that is driven, by an input or through a coupling, hangs on a known body: by one pin or one slide."""

from collections.abc import Mapping
from dataclasses import dataclass

from ilmek.arrays import RealField
from ilmek.linkage.body_jerk import BodyJerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.groups.group import Columns, Group, Known
from ilmek.linkage.groups.shift import SlideTrack, track
from ilmek.linkage.groups.turn import pinned
from ilmek.linkage.model import Joint, Pin


@dataclass(frozen=True, slots=True)
class Attachment:
    """A body on one joint.

    hinge  the pin in the frame of the body `on` [m]     at  the same in the body's own frame [m]
    track  the slide in the place of a pin
    """

    body: str
    on: str
    joint: str
    hinge: complex = 0j
    at: complex = 0j
    track: SlideTrack | None = None

    def place(self, on: BodyMotion, columns: Columns) -> BodyMotion:
        """The body's motion; columns: direction, omega, alpha; on a slide s, s', s''."""
        return pinned(on, self.hinge, self.at, columns) if self.track is None else self.track.place(on, columns)

    def jerk(self, on: BodyJerk, placed: BodyMotion, columns: Columns, third: RealField) -> BodyJerk:
        """The body's jerk; third: beta in the world, on a slide the third rate of s."""
        if self.track is None:
            return BodyJerk(placed, on.carry(self.hinge), third)
        return self.track.jerk(on, placed, columns, third)


def attach(group: Group, joint: Joint, body: str) -> Attachment:
    """The body on its joint."""
    on = group.beyond(joint, body)
    if isinstance(joint, Pin):
        hinge, at = (group.mechanism.point(one, joint.name) for one in (on, body))
        return Attachment(body, on, joint.name, hinge, at)
    return Attachment(body, on, joint.name, track=track(group.mechanism, joint, body))


def hangs(group: Group) -> tuple[Attachment, ...] | None:
    """The bodies of a group in the order in which they hang on one another, one joint each; None where they do not."""
    found: list[Attachment] = []
    done: set[str] = set()
    for _ in group.bodies:
        for joint in group.joints:
            ends = [body for body in joint.bodies if body in group.bodies and body not in done]
            if len(ends) == 1 and joint.name not in {one.joint for one in found}:
                found.append(attach(group, joint, ends[0]))
                done.add(ends[0])
    return tuple(found) if len(found) == len(group.bodies) == len(group.joints) else None


def locate_all(hung_on: tuple[Attachment, ...], known: Known, columns: Mapping[str, Columns]) -> dict[str, BodyMotion]:
    """The motions of bodies that hang on one another."""
    placed = dict(known)
    for one in hung_on:
        placed[one.body] = one.place(placed[one.on], columns[one.body])
    return {one.body: placed[one.body] for one in hung_on}
