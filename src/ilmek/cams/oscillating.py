"""Plate cam with an oscillating roller, knife-edge or spherical follower: formulas at one cam angle, and the cam.

The cam turns counter-clockwise by theta about 0; the arm of length l swings about the pivot c on the x axis. psi is
the arm's angle from the line pivot - axis; it grows as the follower moves out. The roller's centre is

    B = c - l e,   e = exp(-i side psi),   B' = i side psi' l e,   B'' = (i side psi'' + psi'^2) l e

side +1: the roller is above the line, and the cam's rotation drags the arm away from its pivot (trailing arm). side -1:
the roller is below the line, and the cam pushes the arm towards its pivot. |B|^2 = c^2 + l^2 - 2 c l cos psi; the
follower's direction is i side e. On an eccentric circle the follower is the rocker of a four-bar: ground c, crank the
eccentricity, coupler the sum of the circle's and the roller's radius, rocker l; the pressure angle is the deviation of
the transmission angle from 90 deg.
[Norton, Cam Design and Manufacturing, 7]
"""

import math
from typing import ClassVar, Literal

import numpy as np

from ilmek.arrays import ComplexField, FloatArray, RealField
from ilmek.cams.programme import CamProgramme, FollowerMotion
from ilmek.cams.trace import CamCurves, CamTrace, trace_of_point
from ilmek.errors import ParameterError
from ilmek.plane.vectors import unit
from ilmek.records import value_record
from ilmek.units import format_quantity


def roller_motion(
    psi: RealField, dpsi: RealField, ddpsi: RealField, *, pivot: float, arm: float, side: int = 1
) -> tuple[ComplexField, ComplexField, ComplexField]:
    """Roller's centre B in the world and its derivatives B', B'' by the cam angle [m].

    psi, dpsi, ddpsi  the arm's angle [rad] and its derivatives by the cam angle [-, 1/rad]
    pivot, arm        distance of the pivot from the axis, length of the arm [m]      side  +1 or -1, as above
    """
    along = arm * unit(-side * psi)
    return pivot - along, 1j * side * dpsi * along, (1j * side * ddpsi + np.square(dpsi)) * along


def arm_angle(reach: RealField, pivot: float, arm: float) -> RealField:
    """The arm's angle psi [rad] at which the roller's centre is `reach` [m] from the axis; NaN out of reach.

    pivot, arm  distance of the pivot from the axis, length of the arm [m]

    >>> round(math.degrees(arm_angle(5.0, 4.0, 3.0)), 9)
    90.0
    """
    return np.arccos((pivot**2 + arm**2 - reach**2) / (2 * pivot * arm))


@value_record
class OscillatingCam(CamCurves):
    """A plate cam with an oscillating roller or knife-edge follower; the programme's displacement is in rad.

    prime_radius  least distance [m] of the roller's centre from the axis, where the displacement is 0
    pivot, arm    distance of the pivot from the axis, length of the arm to the roller's centre [m]
    side          +1: roller above the line from axis to pivot (trailing arm), -1: below it

    Raises ParameterError where the roller is as large as the prime circle, or the arm cannot reach all positions.
    """

    programme: CamProgramme
    prime_radius: float
    pivot: float
    arm: float
    side: Literal[1, -1] = 1
    roller_radius: float = 0.0
    flat: ClassVar[bool] = False

    def __post_init__(self) -> None:
        least, most = self.prime_bounds
        if not least < self.prime_radius < most:
            shown, pivot, arm = (format_quantity(x, "mm") for x in (self.prime_radius, self.pivot, self.arm))
            swing, none = format_quantity(self.swing, "deg"), least >= most
            between = f"above {format_quantity(least, 'mm')}, below {format_quantity(most, 'mm')}"
            raise ParameterError(
                f"prime_radius={shown} with pivot={pivot}, arm={arm} and {swing} of swing",
                allowed="no prime radius: the arm cannot swing so far" if none else between,
                do="reduce the swing, or change pivot or arm" if none else "",
            )

    @property
    def start_angle(self) -> float:
        """The arm's angle psi [rad] where the displacement is 0."""
        return float(arm_angle(self.prime_radius, self.pivot, self.arm))

    @property
    def swing(self) -> float:
        """Largest swing of the arm from displacement 0 [rad]."""
        return self.programme.bounds[1]

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Bounds of the prime radius [m], both excluded: larger than the roller, all positions within reach."""
        c, arm = self.pivot, self.arm
        most = math.sqrt(max(c**2 + arm**2 + 2 * c * arm * math.cos(min(self.swing, math.pi)), 0.0))
        return max(abs(c - arm), self.roller_radius), most

    def trace_of(self, angle: FloatArray, motion: FollowerMotion) -> CamTrace:
        """The trace at cam angles [rad], for the follower's motion there."""
        psi = self.start_angle + motion.s
        point = roller_motion(psi, motion.ds, motion.dds, pivot=self.pivot, arm=self.arm, side=self.side)
        direction = (self.pivot - point[0]) * (1j * self.side / self.arm)
        return trace_of_point(angle, motion, point, direction, self.roller_radius)
