"""Attachment of a driven body to a known body, by one pin or one slide [formulas: `turn` and `shift`]."""

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
    track  the slide; None for a pin
    """

    body: str
    on: str
    joint: str
    hinge: complex = 0j
    at: complex = 0j
    track: SlideTrack | None = None

    def locate(self, on: BodyMotion, columns: Columns) -> BodyMotion:
        """The body's motion; columns: direction, omega, alpha; on a slide s, s', s''."""
        return pinned(on, self.hinge, self.at, columns) if self.track is None else self.track.locate(on, columns)

    def jerk(self, on: BodyJerk, located: BodyMotion, columns: Columns, third: RealField) -> BodyJerk:
        """The body's jerk; third: beta in the world, on a slide the third rate of s."""
        if self.track is None:
            return BodyJerk(located, on.carry(self.hinge), third)
        return self.track.jerk(on, located, columns, third)


def attach(group: Group, joint: Joint, body: str) -> Attachment:
    """The attachment of a body by a joint to the other body of the joint."""
    on = group.beyond(joint, body)
    if isinstance(joint, Pin):
        hinge, at = (group.mechanism.point(one, joint.name) for one in (on, body))
        return Attachment(body, on, joint.name, hinge, at)
    return Attachment(body, on, joint.name, track=track(group.mechanism, joint, body))


def find_attachments(group: Group) -> tuple[Attachment, ...] | None:
    """Attachments of a group's bodies in order, one joint each; None where a body has another number of joints."""
    attachments: list[Attachment] = []
    done: set[str] = set()
    for _ in group.bodies:
        for joint in group.joints:
            ends = [body for body in joint.bodies if body in group.bodies and body not in done]
            if len(ends) == 1 and joint.name not in {attachment.joint for attachment in attachments}:
                attachments.append(attach(group, joint, ends[0]))
                done.add(ends[0])
    return tuple(attachments) if len(attachments) == len(group.bodies) == len(group.joints) else None


def locate_all(attached: tuple[Attachment, ...], known: Known, columns: Mapping[str, Columns]) -> dict[str, BodyMotion]:
    """The motions of bodies attached in order to known bodies and to one another."""
    located = dict(known)
    for attachment in attached:
        located[attachment.body] = attachment.locate(located[attachment.on], columns[attachment.body])
    return {attachment.body: located[attachment.body] for attachment in attached}
