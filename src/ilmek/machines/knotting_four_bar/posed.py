"""A four-bar whose coupler takes three poses: its parameters, and its state at the poses.

Each arm (`synthesis.dyad`) carries the coupler through the poses; two of them side by side are a four-bar. The report
takes the differences of their lengths instead, also of their first links, which are two separate links: crank and
rocker.
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray, Float, FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.linkage.quality import least_transmission_angle
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.knotting_four_bar.links import inertias
from ilmek.machines.knotting_four_bar.model import KnottingState, drive_for, evaluate, mechanism
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams, params_of
from ilmek.plane.vectors import unit
from ilmek.records import computed, group, record
from ilmek.report import Json
from ilmek.synthesis.three_poses import ThreePoses, ThreePoseSynthesis, synthesised
from ilmek.units import deg, mm

POINTS: ComplexArray = np.array([0j, 25 + 15j, 30 + 1j]) * mm
"""The report's three positions of the gripping point [m]."""

COUPLER_ANGLES: FloatArray = np.array([10.0, 3.0, -25.0]) * deg
GROUND_RAY = 275 * deg


@record
class PosedFourBar:
    """A four-bar through three poses.

    params  with its links, all others as given        state  at the poses, in their frame
    bodies  inertias of its links
    """

    synthesis: ThreePoseSynthesis = group()
    params: KnottingFourBarParams
    plan: Plan
    state: KnottingState
    bodies: Mapping[str, Inertia]

    @property
    def crank_angles(self) -> FloatArray:
        """At the poses [rad]."""
        return self.state.angle

    @property
    def errors(self) -> tuple[Float[np.ndarray, "3"], Float[np.ndarray, "3"]]:
        """Distance of the hand [m] and angle of the coupler [rad] from the poses, from the four-bar's motion."""
        poses, motion = self.synthesis.poses, self.state.motion
        distances = np.abs(motion.point("coupler", "H").position - poses.points)
        # The coupler's frame looks from O2 to O2', which may be against the poses' direction.
        sense = float(np.sign(self.synthesis.crank.second - self.synthesis.rocker.second))
        return distances, np.abs(np.angle(sense * motion.direction("coupler") * np.conj(unit(poses.angles))))

    @computed(
        "",
        "how the poses are met, from the four-bar's motion: position, coupler's direction, crank angle; errors, number "
        "in the crank's order, branch, circuit, drive torque",
        shown=False,
    )
    def poses(self) -> Json:
        best, poses = self.synthesis.best.candidate, self.synthesis.poses
        distances, turned = self.errors
        return [
            {
                "x": poses.points[at].real,
                "y": poses.points[at].imag,
                "theta2": poses.angles[at],
                "crank_angle": self.crank_angles[at],
                "point_error": distances[at],
                "angle_error": turned[at],
                "order": best.order.index(at + 1) + 1,
                "branch": met.branch,
                "circuit": met.circuit,
                "drive_torque": self.state.torque[at],
            }
            for at, met in enumerate(best.positions)
        ]

    def to_use_instead(self) -> Json:
        """Parameters to set, crank and torque at the poses, gears and servo for the greatest torque there [SI]."""
        drive = drive_for(self.params, self.state.torque_max)
        names = ("ground", "crank", "coupler", "rocker", "hand", "ground_angle", "branch")
        return {
            **{name: getattr(self.params, name) for name in names},
            "crank_angles": self.crank_angles.tolist(),
            "drive_torques": self.state.torque.tolist(),
            "transmission_angle_min": least_transmission_angle(self.state.motion, "O2'"),
            "gear_ratio": drive.gear_ratio,
            "servo": drive.servo_name,
        }


def through_poses(params: KnottingFourBarParams, synthesis: ThreePoseSynthesis, hole: float) -> PosedFourBar:
    """The best four-bar of a synthesis, driven at the arm that leaves the other the better transmission angle.

    hole  diameter of the pins' holes [m]
    """
    made = params_of(params, synthesis)
    planned = plan(mechanism(made, made.ground_angle or 0.0, synthesis.crank.pivot))
    bodies = inertias(made, hole)
    state = evaluate(made, planned, bodies, synthesis.crank_angles, params.speed, params.acceleration)
    return PosedFourBar(synthesis, made, planned, state, bodies)


def through_the_reports_poses(params: KnottingFourBarParams, hole: float) -> PosedFourBar:
    """The four-bar to use instead of the report's: both arms through its three poses, joined."""
    return through_poses(params, synthesised(ThreePoses(POINTS, COUPLER_ANGLES), GROUND_RAY), hole)
