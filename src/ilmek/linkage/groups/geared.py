"""Bodies that couplings drive from the inputs: their angles and displacements are linear in the inputs' values.

Gears in a row, belts, racks, planetary gears with any member driven: however many turns, the angle is known; see
`winding`.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from ilmek.linkage.body_jerk import BodyJerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.groups.attachment import Attachment, hangs, locate_all
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.winding import LinearRelation, courses
from ilmek.plane.vectors import unit


@dataclass(frozen=True, slots=True)
class Geared(Step):
    """Bodies on one joint each, and their courses: angle in the world of one on a pin, way of one on a slide."""

    hangs: tuple[Attachment, ...]
    courses: tuple[LinearRelation, ...]
    through: tuple[str, ...]
    on: tuple[str, ...]

    @property
    def bodies(self) -> tuple[str, ...]:
        """The driven bodies."""
        return tuple(one.body for one in self.hangs)

    @property
    def parents(self) -> tuple[str, ...]:
        """The known bodies that they hang on or are coupled with."""
        return self.on

    @property
    def words(self) -> str:
        """What it is, for people."""
        inputs = {name for course in self.courses for name in course.shares}
        driven = f"driven by {' and '.join(sorted(inputs))}" if inputs else "held"
        return f"{' and '.join(self.bodies)} {driven} through {', '.join(self.through)}"

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:  # noqa: ARG002 - the inputs alone count
        """Direction, angular velocity and acceleration; on a slide way, speed and acceleration."""
        columns: dict[str, Columns] = {}
        for one, course in zip(self.hangs, self.courses, strict=True):
            drive = course.drive(drives)
            value = unit(drive.value) if one.track is None else drive.value
            columns[one.body] = (value, drive.speed, drive.acceleration)
        return GroupSolution(columns)

    def place(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The bodies on their joints."""
        return locate_all(self.hangs, known, columns)

    def jerk(
        self,
        known: KnownJerks,
        placed: Known,
        columns: Mapping[str, Columns],
        drives: Mapping[str, InputMotion],
    ) -> Mapping[str, BodyJerk]:
        """The bodies': their courses' jerks."""
        found = dict(known)
        for one, course in zip(self.hangs, self.courses, strict=True):
            third = course.drive(drives).jerk
            found[one.body] = one.jerk(found[one.on], placed[one.body], columns[one.body], third)
        return {body: found[body] for body in self.bodies}


def recognise(group: Group) -> Geared | None:
    """The group as bodies that couplings drive from the inputs, or None."""
    hung = hangs(group) if group.couplings else None
    if hung is None:
        return None
    found = courses(group.mechanism)
    keys = [("angle", one.body) if one.track is None else ("travel", one.joint) for one in hung]
    if not all(key in found for key in keys):
        return None
    through = tuple(coupling.name for coupling in group.couplings)
    return Geared(hung, tuple(found[key] for key in keys), through, group.parents)
