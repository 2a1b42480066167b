"""The four-bar to use instead of the report's: both arms through its three poses, side by side.

Each arm (`synthesis.dyad`) carries the coupler through the poses; together they are a four-bar. The report takes the
differences of their lengths, also of their first links, which are two separate links: crank and rocker.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.structure import plan
from ilmek.machines.knotting_four_bar.model import KnottingState, evaluate, mechanism
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams, params_of
from ilmek.machines.knotting_four_bar.poses import HandPoses, synthesised
from ilmek.units import deg, mm

POINTS: ComplexArray = np.array([0j, 25 + 15j, 30 + 1j]) * mm
"""The report's three places of the gripping point [m]."""

COUPLER_ANGLES: FloatArray = np.array([10.0, 3.0, -25.0]) * deg
GROUND_RAY = 275 * deg


@dataclass(frozen=True, slots=True)
class Replacement:
    """A four-bar whose coupler takes the three poses.

    params        its parameters, all else as asked        crank_angles  at the poses [rad]
    origin        its pivot O1 in the frame of the poses [m], complex
    state         at the poses
    """

    params: KnottingFourBarParams
    crank_angles: FloatArray
    origin: complex
    state: KnottingState


def instead(params: KnottingFourBarParams) -> Replacement:
    """The four-bar of both arms, driven at the one that leaves the other the better transmission angle."""
    found = synthesised(HandPoses(POINTS, COUPLER_ANGLES), GROUND_RAY)
    made = params_of(params, found)
    planned = plan(mechanism(made, made.ground_angle or 0.0))
    state = evaluate(made, planned, found.crank_angles, params.speed, params.acceleration)
    return Replacement(made, found.crank_angles, found.crank.pivot, state)
