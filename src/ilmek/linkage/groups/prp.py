"""PRP dyad: two sliders on known guides, pinned to one another at C.

    C = P + s e = Q + z f,    C' = P' + i w s e + s' e = Q' + i v z f + z' f,    and the same once more for C''

P and Q are the positions of C on each line at zero travel, e and f the unit directions of the lines, w and v the
angular velocities of the guides, which may move. C is the crossing of the lines, so there is one assembly
[Artobolevsky, Theory of Mechanisms and Machines: groups of class II, fourth kind]. Tangent mechanisms, wedges, pins
guided by two slots. The dyad is at a dead centre where the lines are parallel: e x f = 0.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ilmek.arrays import ComplexArray, ComplexField, FloatArray, RealField
from ilmek.linkage.body_jerk import BodyJerk, slid_jerk
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.shift import (
    SlideTrack,
    refuse_parallel,
    slid_acceleration,
    slid_acceleration_kernel,
    slid_velocity,
    slid_velocity_kernel,
    track,
)
from ilmek.linkage.kernels import (
    ACCELERATION,
    ALPHA,
    BLOCK,
    DIRECTION,
    LINE,
    MARGIN,
    OMEGA,
    SECOND,
    TRAVEL,
    VELOCITY,
    ZERO,
    Instruction,
    cross_kernel,
    oblique_kernel,
    pair,
    unable,
)
from ilmek.linkage.model import Pin, Slide
from ilmek.linkage.tape import Tape
from ilmek.num.compiled import compiled
from ilmek.plane.vectors import cross, oblique


@compiled
def _kernel(dyad: FloatArray, first: FloatArray, second: FloatArray, count: int, numbers: ComplexArray) -> None:
    """Travels and rates of two sliders pinned to one another, and the margin; the lines' zeros are already written.

    first, second  the guides        numbers  the lines' directions in the guides' frames
    """
    lead, other_lead, other = numbers[0], numbers[1], ZERO + LINE
    for i in range(min(count, BLOCK)):
        e, w, alpha = pair(first, DIRECTION * BLOCK + i) * lead, first[OMEGA * BLOCK + i], first[ALPHA * BLOCK + i]
        f, v = pair(second, DIRECTION * BLOCK + i) * other_lead, second[OMEGA * BLOCK + i]
        beta = second[ALPHA * BLOCK + i]
        r: ComplexField = pair(dyad, other * BLOCK + i) - pair(dyad, ZERO * BLOCK + i)
        s, z = oblique_kernel(r, e, f), -oblique_kernel(r, f, e)
        r = pair(dyad, (other + VELOCITY) * BLOCK + i) + slid_velocity_kernel(f, v, z, 0.0)
        r = r - pair(dyad, (ZERO + VELOCITY) * BLOCK + i) - slid_velocity_kernel(e, w, s, 0.0)
        ds, dz = oblique_kernel(r, e, f), -oblique_kernel(r, f, e)
        r = pair(dyad, (other + ACCELERATION) * BLOCK + i) + slid_acceleration_kernel(f, v, beta, z, dz, 0.0)
        r = r - pair(dyad, (ZERO + ACCELERATION) * BLOCK + i) - slid_acceleration_kernel(e, w, alpha, s, ds, 0.0)
        dyad[MARGIN * BLOCK + i] = cross_kernel(e, f)
        dyad[TRAVEL * BLOCK + i] = s
        dyad[(TRAVEL + 1) * BLOCK + i] = ds
        dyad[(TRAVEL + 2) * BLOCK + i] = oblique_kernel(r, e, f)
        dyad[(TRAVEL + LINE) * BLOCK + i] = z
        dyad[(TRAVEL + LINE + 1) * BLOCK + i] = dz
        dyad[(TRAVEL + LINE + 2) * BLOCK + i] = -oblique_kernel(r, f, e)


@compiled
def _scale(_numbers: ComplexArray) -> tuple[float, float]:
    return 1.0, 0.0


@dataclass(frozen=True, slots=True)
class CrossedSliders(Step):
    """Two sliders on known bodies joined by a pin.

    reach  slide's point -> pin in the sliders' frames [m]         scale  of its lengths [m]
    """

    kind: ClassVar[str] = "dyad"
    symbol: ClassVar[str] = "PRP"
    instruction: ClassVar[Instruction] = Instruction(_kernel, _scale, unable)
    both_sides: ClassVar[bool] = True

    sliders: tuple[str, str]
    on: tuple[str, str]
    pin: str
    reach: tuple[complex, complex]
    tracks: tuple[SlideTrack, SlideTrack]
    scale: float

    @property
    def bodies(self) -> tuple[str, ...]:
        """Both sliders."""
        return self.sliders

    @property
    def parents(self) -> tuple[str, ...]:
        """The guides."""
        return self.on

    @property
    def description(self) -> str:
        """Description of the step for users."""
        (p, q), (on_p, on_q) = self.sliders, self.on
        return f"sliders {p} and {q} joined at {self.pin}, on {on_p} and {on_q}: {self.symbol}"

    def line(self, known: Known, which: int) -> tuple[BodyMotion, PointMotion, ComplexField]:
        """A guide, the motion of the pin's point on it at zero travel, and the line's direction."""
        guide, line = known[self.on[which]], self.tracks[which]
        return guide, guide.carry(line.root, line.twist * self.reach[which]), guide.direction * line.lead

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:  # noqa: ARG002 - needs no input
        """Travel, speed and acceleration of both sliders."""
        (one, P, e), (two, Q, f) = self.line(known, 0), self.line(known, 1)
        w, v = one.omega, two.omega
        r = Q.position - P.position
        s, z = oblique(r, e, f), -oblique(r, f, e)
        r = Q.velocity + slid_velocity(f, v, z, 0.0) - P.velocity - slid_velocity(e, w, s, 0.0)
        ds, dz = oblique(r, e, f), -oblique(r, f, e)
        r = Q.acceleration + slid_acceleration(f, v, two.alpha, z, dz, 0.0)
        r = r - P.acceleration - slid_acceleration(e, w, one.alpha, s, ds, 0.0)
        columns = {self.sliders[0]: (s, ds, oblique(r, e, f)), self.sliders[1]: (z, dz, -oblique(r, f, e))}
        return GroupSolution(columns, cross(e, f))

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        """The sliders, anchored at their slides' points."""
        return {
            slider: line.locate(known[on], columns[slider])
            for slider, on, line in zip(self.sliders, self.on, self.tracks, strict=True)
        }

    def jerk(
        self,
        known: KnownJerks,
        located: Known,
        columns: Mapping[str, Columns],
        drives: Mapping[str, InputMotion],  # noqa: ARG002 - common signature
    ) -> Mapping[str, BodyJerk]:
        """Jerks of the sliders: the third rates of s along e and z along f balance those of the guides."""
        lines, ends = [], []
        for slider, on, line, reach in zip(self.sliders, self.on, self.tracks, self.reach, strict=True):
            guide, turns, (s, ds, dds) = known[on], known[on].motion, columns[slider]
            e = turns.direction * line.lead
            lines.append(e)
            slid = slid_jerk(e, turns.omega, turns.alpha, guide.beta, s, ds, dds, 0.0)
            ends.append(guide.carry(line.root, line.twist * reach) + slid)
        r = ends[1] - ends[0]
        thirds = oblique(r, lines[0], lines[1]), -oblique(r, lines[1], lines[0])
        return {
            slider: line.jerk(known[on], located[slider], columns[slider], third)
            for slider, on, line, third in zip(self.sliders, self.on, self.tracks, thirds, strict=True)
        }

    @property
    def size(self) -> float:
        """The larger distance of the pin from a slider's point [m]."""
        return max(abs(reach) for reach in self.reach)

    @property
    def shortest(self) -> float:
        """The scale of its lengths [m]."""
        return self.scale

    @property
    def lengths(self) -> tuple[float, ...]:
        """Zero: the sliders do not turn on their guides."""
        return 0.0, 0.0

    def gap(self, known: Known) -> RealField:
        """0: lines that are not parallel cross; NaN where a guide is NaN."""
        (_, _, e), (_, _, f) = self.line(known, 0), self.line(known, 1)
        return 0.0 * cross(e, f)

    @classmethod
    def recognise(cls, group: Group) -> Step | None:
        """The group as a PRP dyad, or None. Raises MechanismError where both lines are parallel lines of one guide."""
        pin, mechanism = group.inner[0] if group.is_dyad else None, group.mechanism
        if not isinstance(pin, Pin):
            return None
        first, second = pin.bodies
        slides = [joint for body in pin.bodies for joint in group.outer_of(body) if isinstance(joint, Slide)]
        if len(slides) != 2:
            return None
        on = group.beyond(slides[0], first), group.beyond(slides[1], second)
        tracks = track(mechanism, slides[0], first), track(mechanism, slides[1], second)
        if on[0] == on[1]:
            refuse_parallel(mechanism, slides, cross(tracks[0].lead, tracks[1].lead))
        return cls(
            sliders=(first, second),
            on=on,
            pin=pin.name,
            reach=(
                mechanism.point(first, pin.name) - mechanism.point(first, slides[0].name),
                mechanism.point(second, pin.name) - mechanism.point(second, slides[1].name),
            ),
            tracks=tracks,
            scale=group.span,
        )

    def write(self, tape: Tape) -> None:
        """Both lines' zeros, the dyad, then both sliders on their guides."""
        to = tape.room(TRAVEL + LINE + 3)
        lines = tuple(zip(self.sliders, self.on, self.tracks, strict=True))
        for k, (slider, guide, line) in enumerate(lines):
            line.write_zero(tape, slider, guide, self.pin, to + ZERO + k * LINE)
        first, second = (tape.rows[guide] for guide in self.on)
        tape.add(self.instruction, to, first, second, tuple(line.lead for line in self.tracks))
        for k, (slider, guide, line) in enumerate(lines):
            line.write(tape, slider, guide, to + k * SECOND, to + TRAVEL + k * LINE)
