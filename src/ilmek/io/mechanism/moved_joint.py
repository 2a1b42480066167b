"""A joint moved in the plane: which numbers of a mechanism file change, and which stay.

The joint moves in the bodies that it joins; every other joint stays where it is at that moment. A number keeps its
form: a length stays a length, a point by radius and angle stays one. Points that are no joints stay where they are in
their body. The frame of a link given by its length follows the link's direction; if it is driven, the value of the
input changes with it.
"""

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from ilmek.errors import MechanismError
from ilmek.io.mechanism.joints import Members, members_of
from ilmek.io.schema import Table
from ilmek.linkage.model import GROUND, Mechanism, Slide
from ilmek.units import deg, mm

Pose = dict[str, tuple[complex, float]]
"""Body -> origin [m] and angle [rad]."""

DIGITS = 7
"""Digits of a written length, from that of the largest of the mechanism on: finer than any workshop, short to read."""

ANGLE_DECIMALS = 5
"""Decimals of a written angle [deg]."""


@dataclass(frozen=True, slots=True)
class FileChange:
    """A new value of an entry of a file: the keys that lead to it, and text, number, list or table."""

    path: tuple[str, ...]
    value: Any


class MovedJoint(NamedTuple):
    """Changes of the file, and the pose of all bodies after them."""

    changes: tuple[FileChange, ...]
    pose: Pose


def moved_joint(data: Table, mechanism: Mechanism, pose: Pose, joint: str, to: complex) -> MovedJoint:
    """The changes that move a joint of the file to a position.

    data   plain data of the file         mechanism  made of them
    pose   of all moving bodies [m, rad]  joint      name in the file; of a slide its point on the guide moves
    to     new position [m]; a pin of a block that slides stays on its line
    Raises MechanismError for an unknown joint, and where the position leaves a link without length.
    """
    members = members_of(data["joints"])
    if joint not in members:
        allowed = f"it has {', '.join(members) or 'none'}"
        raise MechanismError(f"{mechanism.name} has no joint {joint!r}", allowed=allowed)
    moving = _Moving(data, mechanism, {**pose, GROUND: (0j, 0.0)}, members)
    if "slide" in data["joints"][joint]:
        moving.move(data["joints"][joint]["slide"][1], joint, to)
    else:
        for body in members[joint]:
            to = moving.on_its_line(body, to)
        for body in members[joint]:
            moving.move(body, joint, to)
    return MovedJoint(tuple(moving.changes), {body: one for body, one in moving.pose.items() if body != GROUND})


class _Moving:
    """Changes in the making."""

    def __init__(self, data: Table, mechanism: Mechanism, pose: Pose, members: Members) -> None:
        self.data, self.mechanism, self.pose, self.members = data, mechanism, pose, members
        self.changes: list[FileChange] = []
        self.si = data.get("units") == "SI"
        size = max(abs(point) for body in mechanism.bodies for point in body.points.values()) or 1.0
        self.decimals = DIGITS - 1 - math.floor(math.log10(size / mm))

    def move(self, body: str, joint: str, to: complex) -> None:
        """Move a joint of one body."""
        table = self.data["bodies"][body]
        given = table.get("points", {})
        if joint in given:
            local = self._local(body, to)
            self._write(body, joint, local)
            for other, own in self.members.items():  # joints that are given by this one stay
                if body in own and other in given and joint in _used(given[other]):
                    self._write(body, other, self.mechanism.point(body, other), {joint: local})
        elif "length" in table:
            self._stretch(body, joint, to)
        else:  # a block: all its joints at its origin
            _, angle = self.pose[body]
            self.pose[body] = (to, angle)

    def on_its_line(self, body: str, to: complex) -> complex:
        """The nearest position on the line of a block's slide; the position itself for another body."""
        if not self._is_block(body):
            return to
        for joint in self.mechanism.joints:
            if isinstance(joint, Slide) and joint.body == body:
                start = self._world(joint.guide, self.mechanism.point(joint.guide, joint.name))
                along = cmath.rect(1, self.pose[joint.guide][1] + joint.along)
                return start + along * ((to - start) * along.conjugate()).real
        return to

    def _is_block(self, body: str) -> bool:
        table = self.data["bodies"][body]
        return body != GROUND and not table.get("points") and "length" not in table

    def _stretch(self, body: str, joint: str, to: complex) -> None:
        """A link given by its length: its other end stays, its other joints stay, its frame turns."""
        table, given = self.data["bodies"][body], self.data["bodies"][body].get("points", {})
        ends = tuple(
            table.get("between", [one for one, own in self.members.items() if body in own and one not in given])
        )
        other = ends[1] if ends[0] == joint else ends[0]
        fixed = self._world(body, self.mechanism.point(body, other))
        others = [one for one, own in self.members.items() if body in own and one in given]
        kept = {one: self._world(body, self.mechanism.point(body, one)) for one in others}
        line = to - fixed if ends[1] == joint else fixed - to
        if abs(line) == 0:
            raise MechanismError(f"link {body!r} would have no length: {joint} and {other} coincide")
        self.pose[body] = (to if ends[0] == joint else fixed, cmath.phase(line))
        self.changes.append(FileChange(("bodies", body, "length"), self._length(abs(line))))
        for one, at in kept.items():
            self._write(body, one, self._local(body, at), {ends[0]: 0j, ends[1]: complex(abs(line))})

    def _write(self, body: str, point: str, local: complex, moved: Mapping[str, complex] | None = None) -> None:
        """The entry of a point at a new position in the frame of its body, in the form that it has."""
        entry, path = self.data["bodies"][body]["points"][point], ("bodies", body, "points", point)
        points = {**self.mechanism.body(body).points, **(moved or {})}
        if isinstance(entry, list):
            self.changes.append(FileChange(path, self._pair(local)))
            return
        if "sides" in entry:
            table, given = self.data["bodies"][body], self.data["bodies"][body]["points"]
            free = [one for one, own in self.members.items() if body in own and one not in given]
            first, second = (points[name] for name in entry.get("from", table.get("between", free)))
            left = ((second - first).conjugate() * (local - first)).imag >= 0
            sides = [self._length(abs(local - first)), self._length(abs(local - second))]
            self.changes.append(FileChange(path, entry | {"sides": sides, "side": "left" if left else "right"}))
            return
        arm = local - (points[entry["from"]] if "from" in entry else 0j)
        form = (
            {"offset": self._pair(arm)}
            if "offset" in entry
            else {"radius": self._length(abs(arm)), "angle": self._angle(cmath.phase(arm))}
        )
        self.changes.append(FileChange(path, entry | form))

    def _world(self, body: str, local: complex) -> complex:
        origin, angle = self.pose[body]
        return origin + local * cmath.rect(1, angle)

    def _local(self, body: str, at: complex) -> complex:
        origin, angle = self.pose[body]
        return (at - origin) * cmath.rect(1, -angle)

    def _length(self, value: float) -> float | str:
        return value if self.si else f"{_plain(value / mm, self.decimals)}mm"

    def _angle(self, value: float) -> float | str:
        return value if self.si else f"{_plain(value / deg, ANGLE_DECIMALS)}deg"

    def _pair(self, local: complex) -> list[float | str]:
        return [self._length(local.real), self._length(local.imag)]


def _used(entry: Any) -> tuple[str, ...]:
    """The points by which an entry names its position."""
    used = entry.get("from", ()) if isinstance(entry, dict) else ()
    return (used,) if isinstance(used, str) else tuple(used)


def _plain(value: float, decimals: int) -> str:
    """A number without trailing zeros, never in powers of ten.

    >>> _plain(12.50000000001, 4), _plain(-1e-13, 4), _plain(-2.0, 4)
    ('12.5', '0', '-2')
    """
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".") if decimals > 0 else f"{value:.0f}"
    return "0" if float(text) == 0 else text
