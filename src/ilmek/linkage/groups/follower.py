"""A body driven through a coupling by a moving source that inputs alone do not determine: a wheel on a rocker.

    q = at + scale (q_source - source_at)

q is an angle against the carrier, of a rack the displacement of its slide; the angle of a source is assumed to be
within half a turn of `source_at`. [Willis, Principles of Mechanism: relative angles of epicyclic trains]
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ilmek.arrays import RealField
from ilmek.linkage.body_jerk import BodyJerk, slid_jerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.equations import angle_near
from ilmek.linkage.groups.attachment import Attachment, find_attachments
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.model import Coupling, Slide
from ilmek.plane.vectors import unit


@dataclass(frozen=True, slots=True)
class CoupledFollower(Step):
    """A body on one joint that follows a source through a coupling.

    source  the driving body
    slide   for a rack as source: its point in its own frame [m]; the slide's point [m] and direction in the guide's
            frame
    """

    kind: ClassVar[str] = "gears"

    attachment: Attachment
    carrier: str
    source: str
    slide: tuple[complex, complex, complex] | None
    source_at: float
    at: float
    scale: float
    coupling: str

    @property
    def bodies(self) -> tuple[str, ...]:
        """The driven body."""
        return (self.attachment.body,)

    @property
    def parents(self) -> tuple[str, ...]:
        """The body to which it is attached, the carrier and the source."""
        return tuple(dict.fromkeys((self.attachment.on, self.carrier, self.source)))

    @property
    def description(self) -> str:
        """Description of the step for users."""
        return f"{self.attachment.body} driven by {self.source} through {self.coupling}"

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:  # noqa: ARG002 - needs no input
        """Direction, angular velocity and acceleration; on a slide displacement, speed and acceleration."""
        source, carrier = self._source(known), known[self.carrier]
        value = self.at + self.scale * (source.value - self.source_at)
        speed, acceleration = self.scale * source.speed, self.scale * source.acceleration
        if self.attachment.track is not None:
            return GroupSolution({self.attachment.body: (value, speed, acceleration)})
        direction = carrier.direction * unit(value)
        return GroupSolution({self.attachment.body: (direction, carrier.omega + speed, carrier.alpha + acceleration)})

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The body on its joint."""
        return {self.attachment.body: self.attachment.locate(known[self.attachment.on], columns[self.attachment.body])}

    def jerk(
        self,
        known: KnownJerks,
        located: Known,
        columns: Mapping[str, Columns],
        drives: Mapping[str, InputMotion],  # noqa: ARG002 - common signature
    ) -> Mapping[str, BodyJerk]:
        """Jerk of the driven body: the scaled jerk of the source plus the carrier's."""
        carrier, body = known[self.carrier], self.attachment.body
        third = self.scale * self._source_jerk(known[self.source], carrier)
        beta = third if self.attachment.track is not None else carrier.beta + third
        return {body: self.attachment.jerk(known[self.attachment.on], located[body], columns[body], beta)}

    def _source_jerk(self, source: BodyJerk, carrier: BodyJerk) -> RealField:
        """Third rate of the source's angle against the carrier, or of its slide's displacement."""
        if self.slide is None:
            return source.beta - carrier.beta
        point, root, lead = self.slide
        p, g, turns = source.motion.carry(point), carrier.motion.carry(root), carrier.motion
        distance, gain, rush = p.position - g.position, p.velocity - g.velocity, p.acceleration - g.acceleration
        back = slid_jerk(1 + 0j, -turns.omega, -turns.alpha, -carrier.beta, distance, gain, rush, 0j)
        jerk = source.carry(point) - carrier.carry(root) + back
        return np.real(jerk * np.conj(turns.direction * lead))

    def _source(self, known: Known) -> InputMotion:
        """The source's angle against the carrier, or the displacement of its slide, with its rates."""
        source, carrier = known[self.source], known[self.carrier]
        if self.slide is None:
            angle = angle_near(source.direction, carrier.direction, self.source_at)
            return InputMotion(angle, source.omega - carrier.omega, source.alpha - carrier.alpha)
        point, root, lead = self.slide
        p, g, w = source.carry(point), carrier.carry(root), carrier.omega
        back = np.conj(carrier.direction * lead)
        distance, gain = p.position - g.position, p.velocity - g.velocity
        spin = (1j * carrier.alpha + w * w) * distance
        return InputMotion(
            np.real(distance * back),
            np.real((gain - 1j * w * distance) * back),
            np.real((p.acceleration - g.acceleration - 2j * w * gain - spin) * back),
        )

    @classmethod
    def recognise(cls, group: Group) -> Step | None:
        """The group as one body driven by another through a coupling, or None; None for a driven carrier too."""
        attached = find_attachments(group) if len(group.couplings) == 1 and not group.inputs else None
        if attached is None or len(attached) != 1:
            return None
        (one,), (coupling,) = attached, group.couplings
        (first, _), (second, _) = coupling.first, coupling.second
        if one.body == second:
            if (coupling.kind == "rack") != (one.track is not None):
                return None
            ends = coupling.first_at, coupling.second_at
            return cls(one, coupling.carrier, first, None, *ends, coupling.ratio, coupling.name)
        if one.body == first and one.track is None:
            ends = coupling.second_at, coupling.first_at
            line = _line(group, coupling)
            return cls(one, coupling.carrier, second, line, *ends, 1 / coupling.ratio, coupling.name)
        return None


def _line(group: Group, coupling: Coupling) -> tuple[complex, complex, complex] | None:
    """A rack's point in its own frame, and its slide's point and direction in the guide's; None for wheels."""
    body, name = coupling.second
    joint = group.mechanism.joint(name) if coupling.kind == "rack" else None
    if not isinstance(joint, Slide):
        return None
    points = group.mechanism.point(body, name), group.mechanism.point(joint.guide, name)
    return (*points, complex(unit(joint.along)))
