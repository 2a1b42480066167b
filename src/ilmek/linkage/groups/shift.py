"""A body driven by an input along a slide on a known body: P = G + s e, at a fixed angle to the known body.

    P' = G' + (s' + i w s) e,    P'' = G'' + (s'' + 2 i w s' + (i alpha - w²) s) e

with the term of Coriolis, 2 i w s' e [Norton, Design of Machinery, sections 6.7 and 7.3]
"""

import cmath
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, FloatArray, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.body_jerk import BodyJerk, slid_jerk
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.kernels import ACCELERATION, ALPHA, BLOCK, BODY, DIRECTION, OMEGA, VELOCITY, Instruction, pair, put
from ilmek.linkage.model import Displacement, Mechanism, Slide
from ilmek.linkage.tape import Tape
from ilmek.num.compiled import compiled

PARALLEL = 1e-12
"""Greatest sine of the angle between lines that count as parallel."""


def slid_velocity(e: ComplexField, omega: RealField, s: RealField, ds: RealField) -> ComplexField:
    """Rate (s e)' = (s' + i w s) e [m/s] of a displacement s [m] along the unit direction e of a guide with rate w
    [rad/s].

    >>> slid_velocity(1j, 3.0, 2.0, 5.0)
    (-6+5j)
    """
    return (ds + 1j * (omega * s)) * e


def slid_acceleration(  # noqa: PLR0917 - arguments in the order of the equation
    e: ComplexField, omega: RealField, alpha: RealField, s: RealField, ds: RealField, dds: RealField
) -> ComplexField:
    """Second rate (s e)'' = (s'' - w^2 s + i (alpha s + 2 w s')) e [m/s^2]; see `slid_velocity`.

    >>> slid_acceleration(1j, 3.0, 4.0, 2.0, 5.0, 7.0)
    (-38-11j)
    """
    return (dds - omega * omega * s + 1j * (alpha * s + 2 * omega * ds)) * e


slid_velocity_kernel, slid_acceleration_kernel = compiled(slid_velocity), compiled(slid_acceleration)


@compiled
def _kernel(body: FloatArray, guide: FloatArray, travel: FloatArray, count: int, numbers: ComplexArray) -> None:
    """A slider: its anchor, written at the slide's root, moved along the line; its direction and rates.

    Numbers: the line's direction and the slider's, in the guide's frame.
    """
    lead, twist = numbers[0], numbers[1]
    for i in range(min(count, BLOCK)):
        direction, w, alpha = pair(guide, DIRECTION * BLOCK + i), guide[OMEGA * BLOCK + i], guide[ALPHA * BLOCK + i]
        s, ds, dds, e = travel[i], travel[BLOCK + i], travel[2 * BLOCK + i], direction * lead
        v, a = VELOCITY * BLOCK + i, ACCELERATION * BLOCK + i
        put(body, i, pair(body, i) + s * e)
        put(body, v, pair(body, v) + slid_velocity_kernel(e, w, s, ds))
        put(body, a, pair(body, a) + slid_acceleration_kernel(e, w, alpha, s, ds, dds))
        put(body, DIRECTION * BLOCK + i, direction * twist)
        body[OMEGA * BLOCK + i] = w
        body[ALPHA * BLOCK + i] = alpha


SLIP = Instruction(_kernel, shifts=True)
"""A slider on its guide, from the rows of its travel."""


@dataclass(frozen=True, slots=True)
class SlideTrack:
    """A slide relative to its known body, either of the two.

    The unknown body's point of the slide, `at` [m] in its frame, is at `root` + s `lead` [m] in the known body's frame.
    Its direction is the known body's times `twist`.
    """

    root: complex
    lead: complex
    twist: complex
    at: complex

    def locate(self, on: BodyMotion, columns: Columns) -> BodyMotion:
        """The sliding body anchored at the slide's point; columns: s, s', s''.

        P = G + s e,  P' = G' + (i w s + s') e,  P'' = G'' + ((i alpha - w^2) s + 2 i w s' + s'') e
        """
        s, ds, dds = columns
        root = on.carry(self.root)
        e, w = on.direction * self.lead, on.omega
        anchor = PointMotion(
            root.position + s * e,
            root.velocity + slid_velocity(e, w, s, ds),
            root.acceleration + slid_acceleration(e, w, on.alpha, s, ds, dds),
        )
        return BodyMotion(anchor, self.at, on.direction * self.twist, w, on.alpha)

    def jerk(self, on: BodyJerk, located: BodyMotion, columns: Columns, third: RealField) -> BodyJerk:
        """The sliding body's jerk; columns: s, s', s''; third: the third rate of s."""
        s, ds, dds = columns
        e, w = on.motion.direction * self.lead, on.motion.omega
        anchor = on.carry(self.root) + slid_jerk(e, w, on.motion.alpha, on.beta, s, ds, dds, third)
        return BodyJerk(located, anchor, on.beta)

    def write(self, tape: Tape, body: str, on: str, to: int, travel: int) -> None:
        """Append the body, whose travel and its rates are in the rows from `travel` on, to a tape."""
        slide = tape.between(body, on)
        tape.carry(on, tape.point(on, slide), to)
        tape.add(SLIP, to, tape.rows[on], travel, (self.lead, self.twist))
        tape.rows[body], tape.at[body], tape.travel[body] = to, tape.point(body, slide), travel

    def write_zero(self, tape: Tape, body: str, on: str, pin: str, to: int) -> None:
        """Append the motion of the body's pin at zero travel to a tape."""
        slide = tape.between(body, on)
        reach = tape.point(body, pin) - tape.point(body, slide)
        tape.carry(on, tape.point(on, slide), to, self.twist * reach)


def track(mechanism: Mechanism, slide: Slide, body: str) -> SlideTrack:
    """The slide relative to the known body, for the unknown `body`.

    Its points are in the frames of the two bodies [m], its directions unit vectors.
    """
    along, turned = cmath.rect(1, slide.along), cmath.rect(1, slide.turned)
    on_line, guide = mechanism.point(slide.body, slide.name), mechanism.point(slide.guide, slide.name)
    if body == slide.body:
        return SlideTrack(root=guide, lead=along, twist=turned, at=on_line)
    return SlideTrack(root=on_line, lead=-along * turned.conjugate(), twist=turned.conjugate(), at=guide)


def refuse_parallel(mechanism: Mechanism, slides: Sequence[Slide], sine: RealField) -> None:
    """Raise MechanismError for parallel slides of a group, by the sine [1] of the angle between them."""
    if np.abs(sine) <= PARALLEL:
        first, second = (slide.name for slide in slides)
        raise MechanismError(
            f"slides {first!r} and {second!r} of {mechanism.name} are parallel",
            allowed="a body on both slides could move freely along them",
            do="change the direction of one of them",
        )


@dataclass(frozen=True, slots=True)
class DrivenSlider(Step):
    """A driven slider on its track on the known body `on`."""

    kind: ClassVar[str] = "input"
    instruction: ClassVar[Instruction] = SLIP

    body: str
    on: str
    entry: str
    track: SlideTrack

    @property
    def bodies(self) -> tuple[str, ...]:
        """The driven body."""
        return (self.body,)

    @property
    def parents(self) -> tuple[str, ...]:
        """The guide."""
        return (self.on,)

    @property
    def description(self) -> str:
        """Description of the step for users."""
        return f"{self.body} moved by the input on {self.on}"

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:  # noqa: ARG002 - the slide's s is the input
        """Travel, speed and acceleration of the slide."""
        drive = drives[self.entry]
        columns: tuple[ComplexField, ...] = (drive.value, drive.speed, drive.acceleration)
        return GroupSolution({self.body: columns})

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The driven body, anchored at the slide's point."""
        return {self.body: self.track.locate(known[self.on], columns[self.body])}

    def jerk(
        self, known: KnownJerks, located: Known, columns: Mapping[str, Columns], drives: Mapping[str, InputMotion]
    ) -> Mapping[str, BodyJerk]:
        """Jerk of the driven body: the input's jerk along the track."""
        third = drives[self.entry].jerk
        return {self.body: self.track.jerk(known[self.on], located[self.body], columns[self.body], third)}

    @classmethod
    def recognise(cls, group: Group) -> Step | None:
        """The group as a driven slider, or None."""
        if len(group.bodies) != 1 or len(group.joints) != 1:
            return None
        (body,), (joint,) = group.bodies, group.joints
        entry = next((entry for entry in group.inputs if entry.joint == joint.name), None)
        if not isinstance(joint, Slide) or not isinstance(entry, Displacement):
            return None
        return cls(body, group.beyond(joint, body), entry.name, track(group.mechanism, joint, body))

    def write(self, tape: Tape) -> None:
        """The slider, its travel that of the input."""
        self.track.write(tape, self.body, self.on, tape.room(BODY), tape.drive(self.entry))
