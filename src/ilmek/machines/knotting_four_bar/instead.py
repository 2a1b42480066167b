"""The four-bar to use instead of the report's: both arms through its three poses, side by side.

Each arm (`synthesis.dyad`) carries the coupler through the poses; together they are a four-bar. The report takes the
differences of their lengths, also of their first links, which are two separate links: crank and rocker.
"""

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.structure import plan
from ilmek.machines.knotting_four_bar.model import State, evaluate, mechanism
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.plane.vectors import cross, unit
from ilmek.synthesis.dyad import Dyad, dyads_through_poses, four_bar
from ilmek.units import deg, mm, turn

POINTS: ComplexArray = np.array([0j, 25 + 15j, 30 + 1j]) * mm
"""The report's three places of the gripping point [m]."""

COUPLER_ANGLES: FloatArray = np.array([10.0, 3.0, -25.0]) * deg
GROUND_RAY = 275 * deg


@dataclass(frozen=True, slots=True)
class Instead:
    """A four-bar whose coupler takes the three poses.

    params        its parameters, all else as asked        crank_angles  at the poses [rad]
    origin        its pivot O1 in the frame of the poses [m], complex
    state         at the poses
    """

    params: KnottingFourBarParams
    crank_angles: FloatArray
    origin: complex
    state: State


def instead(params: KnottingFourBarParams) -> Instead:
    """The four-bar of both arms, driven at the one that leaves the other the better transmission angle."""
    arms = dyads_through_poses(POINTS, COUPLER_ANGLES, GROUND_RAY)
    crank, rocker = sorted(arms, key=_sine)
    lengths = four_bar(crank, rocker)
    ground_angle = float(np.angle(rocker.pivot - crank.pivot)) % turn
    crank_angles = np.unwrap(crank.first_angles(POINTS, COUPLER_ANGLES))
    crank_angles = crank_angles - turn * np.floor(crank_angles[-1] / turn)
    O2, far = (POINTS - arm.second * unit(COUPLER_ANGLES) for arm in (crank, rocker))
    made = dataclasses.replace(
        params,
        ground=lengths.ground,
        crank=lengths.crank,
        coupler=lengths.coupler,
        rocker=lengths.rocker,
        ground_angle=ground_angle,
        branch=int(np.sign(cross(rocker.pivot - O2, far - O2))[0]),
        hand=math.copysign(crank.second, crank.second - rocker.second),
        crank_angle=float(crank_angles[0]),
    )
    state = evaluate(made, plan(mechanism(made, ground_angle)), crank_angles, params.speed, params.acceleration)
    return Instead(made, crank_angles, crank.pivot, state)


def _sine(arm: Dyad) -> float:
    """Least sine of the angle between an arm's first link and the coupler at the poses."""
    return float(np.min(np.abs(np.sin(arm.first_angles(POINTS, COUPLER_ANGLES) - COUPLER_ANGLES))))
