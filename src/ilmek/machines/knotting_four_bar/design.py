"""The knotting four-bar's design: where it closes, its pose, motion, forces, and the servo for it."""

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.errors import ParameterError
from ilmek.linkage.quality import Grashof, grashof, input_range, transmission_angle
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.knotting_four_bar.drive import GearedServo, drive_for
from ilmek.machines.knotting_four_bar.model import KnottingState, closing_ground, evaluate, inertias, mechanism, parts
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams, params_of
from ilmek.machines.knotting_four_bar.poses import Synthesis, read_three_poses, synthesised
from ilmek.machines.knotting_four_bar.replacement import Replacement, instead
from ilmek.machines.knotting_four_bar.sides import KnottingSides, both_sides
from ilmek.units import deg, format_quantity, turn

SAMPLES = 360
EDGE = 0.02
"""Part of the crank's range left out of the curves at each dead point, where forces grow without bound."""

STATED = 135 * deg
"""Crank angle to report where none is said [rad]."""


@dataclass(frozen=True, slots=True)
class KnottingFourBar:
    """A designed knotting four-bar.

    params        as in force: with poses, the links that follow from them
    origin        its pivot O1 [m], complex; off 0 only with poses
    crank_angle   asked for [rad]
    ground_angle  direction O1 -> O1' [rad]
    grashof       its class
    range         crank angles between which this assembly closes [rad], about the crank angle asked for; None: all
    working       crank angles from the first pose to the last, the lesser first [rad]; None without poses
    at            at the crank angle asked for
    static, unit  the same at rest, and at 1 rad/s without acceleration
    course        over the working range, or all the range, its edges left out
    standing      the same at rest
    synthesis     of the poses; None without            at_poses  the state there
    instead       the four-bar of both arms through the report's poses; None with poses
    sides         both sides over the course, coupled by gears; None of one side
    """

    params: KnottingFourBarParams
    origin: complex
    crank_angle: float
    plan: Plan
    ground_angle: float
    grashof: Grashof
    range: tuple[float, float] | None
    working: tuple[float, float] | None
    parts: Mapping[str, Inertia]
    inertias: Mapping[str, Inertia]
    at: KnottingState
    static: KnottingState
    unit: KnottingState
    course: KnottingState
    standing: KnottingState
    synthesis: Synthesis | None
    at_poses: KnottingState | None
    instead: Replacement | None
    sides: KnottingSides | None

    @property
    def dead_point_distance(self) -> float:
        """Turn of the crank from the angle asked for, or from its working range, to the nearer dead point [rad].

        Infinite where it turns fully.
        """
        if not self.range:
            return math.inf
        return min(abs(place - end) for end in self.range for place in self.working or (self.crank_angle,))

    @property
    def transmission_angle(self) -> float:
        """Acute angle of coupler and rocker [rad]: at the crank angle asked for; with poses, least on the way."""
        motion = self.course.motion if self.working else self.at.motion
        angle = transmission_angle(motion, "O2'")
        return float(np.min(np.minimum(angle, math.pi - angle)))

    @property
    def load_torque(self) -> float:
        """The torque that the drive is chosen for [N m]: the greatest size, moving or at rest.

        At the crank angle asked for; with poses over the working range.
        """
        states = (self.course, self.standing) if self.working else (self.at, self.static)
        return max(float(np.max(np.abs(state.torque))) for state in states)

    @property
    def drive(self) -> GearedServo:
        """The drive for that torque, or for that of both sides."""
        # Without poses the angle asked for may lie beyond the course, nearer to a dead point; both sides stand there.
        both = max(self.sides.torque, 2 * self.load_torque) if self.sides else self.load_torque
        return drive_for(self.params, both)

    @property
    def onward(self) -> slice:
        """The course in the order of the poses; without poses, of the crank's angle."""
        back = self.synthesis is not None and self.synthesis.crank_angles[0] > self.synthesis.crank_angles[-1]
        return slice(None, None, -1 if back else 1)


def design(params: KnottingFourBarParams) -> KnottingFourBar:
    """Place, move and load a knotting four-bar.

    Raises ParameterError where no ground closes the stated pose, or no four-bar takes the poses, MechanismError where
    the crank angle cannot be taken.
    """
    found = None if params.poses is None else synthesised(read_three_poses(params.poses), params.ground_angle)
    asked = params if found is None else params_of(params, found)
    angle = STATED if asked.crank_angle is None else asked.crank_angle
    params = dataclasses.replace(asked, crank_angle=angle)
    ground_angle = closing_ground(params) if params.ground_angle is None else params.ground_angle
    origin = found.crank.pivot if found else 0j
    planned = plan(mechanism(params, ground_angle, origin))
    at = np.array([angle])
    solve(planned, at).require()
    closes = _range(params, ground_angle, angle)
    working = _working(found, angle)
    course = _course(angle, closes) if working is None else np.linspace(*working, SAMPLES + 1)
    moving = partial(evaluate, params, planned, speed=params.speed, acceleration=params.acceleration)
    return KnottingFourBar(
        params=params,
        origin=origin,
        crank_angle=angle,
        plan=planned,
        ground_angle=ground_angle % turn,
        grashof=grashof(params.ground, params.crank, params.coupler, params.rocker),
        range=closes,
        working=working,
        parts=parts(params),
        inertias=inertias(params),
        at=moving(at),
        static=evaluate(params, planned, at, 0.0),
        unit=evaluate(params, planned, at, 1.0),
        course=moving(course),
        standing=evaluate(params, planned, course, 0.0),
        synthesis=found,
        at_poses=moving(found.crank_angles) if found else None,
        instead=None if found else instead(params),
        sides=both_sides(params, planned, course) if params.sides > 1 else None,
    )


def _working(found: Synthesis | None, angle: float) -> tuple[float, float] | None:
    """The crank's range from the first pose to the last. Raises ParameterError for an angle outside."""
    if found is None:
        return None
    low, high = float(np.min(found.crank_angles)), float(np.max(found.crank_angles))
    if not low - 1e-9 <= angle <= high + 1e-9:
        said, ends = format_quantity(angle, "deg"), [format_quantity(end, "deg") for end in (low, high)]
        raise ParameterError(
            f"crank_angle {said} is outside the way through the poses", allowed=f"{ends[0]} to {ends[1]}"
        )
    return low, high


def _range(params: KnottingFourBarParams, ground_angle: float, angle: float) -> tuple[float, float] | None:
    """The interval about the crank angle in which the loop closes; `input_range` counts from the ground link."""
    intervals = input_range(params.ground, params.crank, params.coupler, params.rocker)
    for start, end in intervals:
        if end - start >= turn:
            return None
        # The turn on which the interval lies about the crank angle: its middle is the nearest.
        middle = ground_angle + (start + end) / 2
        middle += turn * round((angle - middle) / turn)
        half = (end - start) / 2
        if abs(angle - middle) <= half:
            return middle - half, middle + half
    raise AssertionError("a crank angle that closes lies in an interval that does")


def _course(angle: float, closes: tuple[float, float] | None) -> FloatArray:
    if closes is None:
        return angle + np.arange(SAMPLES + 1) * (turn / SAMPLES)
    edge = EDGE * (closes[1] - closes[0])
    return np.linspace(closes[0] + edge, closes[1] - edge, SAMPLES + 1)
