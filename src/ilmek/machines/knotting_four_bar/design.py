"""The knotting four-bar's design: where it closes, its pose, motion, forces, and the servo for it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.linkage.quality import Grashof, grashof, input_range, transmission_angle
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.knotting_four_bar.drive import Drive, drive_for
from ilmek.machines.knotting_four_bar.instead import Instead, instead
from ilmek.machines.knotting_four_bar.model import State, closing_ground, evaluate, inertias, mechanism, parts
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.units import turn

SAMPLES = 360
EDGE = 0.02
"""Part of the crank's range left out of the curves at each dead point, where forces grow without bound."""


@dataclass(frozen=True, slots=True)
class KnottingFourBar:
    """A designed knotting four-bar.

    ground_angle  direction O1 -> O1' [rad]
    grashof       its class
    range         crank angles between which this assembly closes [rad], about the crank angle asked for; None: all
    at            at the crank angle asked for
    static, unit  the same at rest, and at 1 rad/s without acceleration
    course        over the range, its edges left out
    instead       the four-bar of both arms through the report's poses
    """

    params: KnottingFourBarParams
    plan: Plan
    ground_angle: float
    grashof: Grashof
    range: tuple[float, float] | None
    parts: Mapping[str, Inertia]
    inertias: Mapping[str, Inertia]
    at: State
    static: State
    unit: State
    course: State
    instead: Instead

    @property
    def dead_point_distance(self) -> float:
        """Turn of the crank from the angle asked for to the nearer dead point [rad]; infinite where it turns fully."""
        return min(abs(self.params.crank_angle - end) for end in self.range) if self.range else math.inf

    @property
    def transmission_angle(self) -> float:
        """Acute angle between coupler and rocker at the crank angle asked for [rad]."""
        angle = float(transmission_angle(self.at.motion, "O2'")[0])
        return min(angle, math.pi - angle)

    @property
    def drive(self) -> Drive:
        """The drive for the torque at the crank angle asked for, moving or at rest, whichever is greater."""
        return drive_for(self.params, max(abs(float(state.torque[0])) for state in (self.at, self.static)))

    @property
    def drive_instead(self) -> Drive:
        """The drive for the greatest torque of the four-bar to use instead at the report's poses."""
        return drive_for(self.params, float(np.max(np.abs(self.instead.state.torque))))


def design(params: KnottingFourBarParams) -> KnottingFourBar:
    """Place, move and load a knotting four-bar.

    Raises ParameterError where no ground closes the stated pose, MechanismError where the crank angle cannot be taken.
    """
    ground_angle = closing_ground(params) if params.ground_angle is None else params.ground_angle
    planned = plan(mechanism(params, ground_angle))
    asked = np.array([params.crank_angle])
    solve(planned, asked).require()
    closes = _range(params, ground_angle)
    return KnottingFourBar(
        params=params,
        plan=planned,
        ground_angle=ground_angle % turn,
        grashof=grashof(params.ground, params.crank, params.coupler, params.rocker),
        range=closes,
        parts=parts(params),
        inertias=inertias(params),
        at=evaluate(params, planned, asked, params.speed, params.acceleration),
        static=evaluate(params, planned, asked, 0.0),
        unit=evaluate(params, planned, asked, 1.0),
        course=evaluate(params, planned, _course(params, closes), params.speed, params.acceleration),
        instead=instead(params),
    )


def _range(params: KnottingFourBarParams, ground_angle: float) -> tuple[float, float] | None:
    """The interval about the crank angle in which the loop closes; `input_range` counts from the ground link."""
    intervals = input_range(params.ground, params.crank, params.coupler, params.rocker)
    for start, end in intervals:
        if end - start >= turn:
            return None
        # The turn on which the interval lies about the crank angle: its middle is the nearest.
        middle = ground_angle + (start + end) / 2
        middle += turn * round((params.crank_angle - middle) / turn)
        half = (end - start) / 2
        if abs(params.crank_angle - middle) <= half:
            return middle - half, middle + half
    raise AssertionError("a crank angle that closes lies in an interval that does")


def _course(params: KnottingFourBarParams, closes: tuple[float, float] | None) -> FloatArray:
    if closes is None:
        return params.crank_angle + np.arange(SAMPLES + 1) * (turn / SAMPLES)
    edge = EDGE * (closes[1] - closes[0])
    return np.linspace(closes[0] + edge, closes[1] - edge, SAMPLES + 1)
