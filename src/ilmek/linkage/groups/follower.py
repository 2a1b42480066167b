"""A body driven through a coupling by a moving source: a wheel on a rocker, the follower of a cam, a Geneva wheel.

    q = at + f(q_source - source_at),   q' = f' q_source',   q'' = f' q_source'' + f'' q_source'^2

f is the ratio times its argument, or the law of a higher pair. q is an angle against the carrier, of a slide its
displacement; the angle of a source is assumed to be within half a turn of `source_at`, where inputs alone do not
determine it with its full turns.
[Willis, Principles of Mechanism: relative angles of epicyclic trains]
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ilmek.arrays import RealField
from ilmek.linkage.body_jerk import BodyJerk, slid_jerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.equations import angle_near
from ilmek.linkage.groups.attachment import Attachment, find_attachments
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.winding import LinearRelation, angles
from ilmek.linkage.model import Coupling, Slide
from ilmek.plane.vectors import unit


@dataclass(frozen=True, slots=True)
class CoupledFollower(Step):
    """A body on one joint that follows a source through a coupling.

    source  the driving body
    slide   for a rack as source: its point in its own frame [m]; the slide's point [m] and direction in the guide's
            frame
    pair    the coupling, its ratio that of the body to its source
    turned  the source's angle and the carrier's with their full turns, where the inputs determine them
    """

    kind: ClassVar[str] = "gears"

    attachment: Attachment
    carrier: str
    source: str
    slide: tuple[complex, complex, complex] | None
    source_at: float
    at: float
    pair: Coupling
    turned: tuple[LinearRelation, LinearRelation] | None = None

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
        return f"{self.attachment.body} driven by {self.source} through {self.pair.name}"

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:
        """Direction, angular velocity and acceleration; on a slide displacement, speed and acceleration."""
        source, carrier = self._source(known, drives), known[self.carrier]
        change, first, second, _ = self.pair.transfer(source.value - self.source_at)
        value, speed = self.at + change, first * source.speed
        acceleration = first * source.acceleration + second * source.speed**2
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
        drives: Mapping[str, InputMotion],
    ) -> Mapping[str, BodyJerk]:
        """Jerk of the driven body: f' q''' + 3 f'' q' q'' + f''' q'^3 of the source, plus the carrier's."""
        carrier, body = known[self.carrier], self.attachment.body
        source = self._source({name: one.motion for name, one in known.items()}, drives)
        _, first, second, rest = self.pair.transfer(source.value - self.source_at)
        third = first * self._source_jerk(known[self.source], carrier)
        third = third + 3 * second * source.speed * source.acceleration + rest * source.speed**3
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

    def _source(self, known: Known, drives: Mapping[str, InputMotion]) -> InputMotion:
        """The source's angle against the carrier, or the displacement of its slide, with its rates."""
        source, carrier = known[self.source], known[self.carrier]
        if self.slide is None:
            angle = angle_near(source.direction, carrier.direction, self.source_at)
            if self.turned is not None and drives:
                angle = self.turned[0].drive(drives).value - self.turned[1].drive(drives).value
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
        (first, _), (second, _) = coupling.ends
        if one.body == second:
            if coupling.slides != (one.track is not None):
                return None
            ends, turned = (coupling.first_at, coupling.second_at), None
            if coupling.law is not None:
                known = angles(group.mechanism)
                source, carrier = known.get(first), known.get(coupling.carrier)
                turned = None if source is None or carrier is None else (source, carrier)
            return cls(one, coupling.carrier, first, None, *ends, coupling, turned)
        if one.body == first and one.track is None and coupling.law is None:
            ends = coupling.second_at, coupling.first_at
            back = replace(coupling, ratio=1 / coupling.ratio)
            return cls(one, coupling.carrier, second, _line(group, coupling), *ends, back)
        return None


def _line(group: Group, coupling: Coupling) -> tuple[complex, complex, complex] | None:
    """A rack's point in its own frame, and its slide's point and direction in the guide's; None for wheels."""
    body, name = coupling.ends[1]
    joint = group.mechanism.joint(name) if coupling.slides else None
    if not isinstance(joint, Slide):
        return None
    points = group.mechanism.point(body, name), group.mechanism.point(joint.guide, name)
    return (*points, complex(unit(joint.along)))
