"""Bodies driven by the inputs through couplings: angles and displacements are linear in the inputs' values.

Gear trains, belts, racks, planetary gears with any driven member. Angles count full turns; see `winding`
[Willis, Principles of Mechanism].
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ilmek.linkage.body_jerk import BodyJerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.groups.attachment import Attachment, find_attachments, locate_all
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.winding import LinearRelation, linear_relations
from ilmek.plane.vectors import unit


@dataclass(frozen=True, slots=True)
class Geared(Step):
    """Bodies on one joint each, with the relation of their angle in the world (pin) or displacement (slide)."""

    kind: ClassVar[str] = "gears"

    attachments: tuple[Attachment, ...]
    relations: tuple[LinearRelation, ...]
    through: tuple[str, ...]
    on: tuple[str, ...]

    @property
    def bodies(self) -> tuple[str, ...]:
        """The driven bodies."""
        return tuple(attachment.body for attachment in self.attachments)

    @property
    def parents(self) -> tuple[str, ...]:
        """The known bodies to which they are attached or coupled."""
        return self.on

    @property
    def description(self) -> str:
        """Description of the step for users."""
        inputs = {name for relation in self.relations for name in relation.shares}
        driven = f"driven by {' and '.join(sorted(inputs))}" if inputs else "fixed"
        return f"{' and '.join(self.bodies)} {driven} through {', '.join(self.through)}"

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:  # noqa: ARG002 - needs inputs only
        """Direction, angular velocity and acceleration; on a slide displacement, speed and acceleration."""
        columns: dict[str, Columns] = {}
        for one, relation in zip(self.attachments, self.relations, strict=True):
            drive = relation.drive(drives)
            value = unit(drive.value) if one.track is None else drive.value
            columns[one.body] = (value, drive.speed, drive.acceleration)
        return GroupSolution(columns)

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The bodies on their joints."""
        return locate_all(self.attachments, known, columns)

    def jerk(
        self, known: KnownJerks, located: Known, columns: Mapping[str, Columns], drives: Mapping[str, InputMotion]
    ) -> Mapping[str, BodyJerk]:
        """Jerks of the bodies, from their relations."""
        found = dict(known)
        for one, relation in zip(self.attachments, self.relations, strict=True):
            third = relation.drive(drives).jerk
            found[one.body] = one.jerk(found[one.on], located[one.body], columns[one.body], third)
        return {body: found[body] for body in self.bodies}

    @classmethod
    def recognise(cls, group: Group) -> Step | None:
        """The group as bodies driven by the inputs through couplings, or None."""
        attached = find_attachments(group) if group.couplings else None
        if attached is None:
            return None
        relations = linear_relations(group.mechanism)
        keys = [("angle", one.body) if one.track is None else ("travel", one.joint) for one in attached]
        if not all(key in relations for key in keys):
            return None
        through = tuple(coupling.name for coupling in group.couplings)
        return cls(attached, tuple(relations[key] for key in keys), through, group.parents)
