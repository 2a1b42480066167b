"""Cams laid flat: the development of a barrel or end cam, and the wedge cam, which is flat already.

The real axis is the direction of the follower. The imaginary axis is the direction of the cam, which moves by rho theta
towards +i under the follower, as a plate cam whose axis is far away. In the frame of the strip, with B the roller's
centre,

    P = B - i rho theta,   dP = B' - i rho,   d2P = B''

rho is the radius at which the barrel is developed; for a wedge it is the travel per radian of the programme. A follower
that moves straight (B = s) has tan mu = s'/rho and kappa = -rho s'' / (rho^2 + s'^2)^(3/2).
[Rothbart, Cam Design Handbook, 10; Norton, Cam Design and Manufacturing, 7]
"""

import math
from dataclasses import replace
from typing import ClassVar

import numpy as np

from ilmek.arrays import ComplexField, FloatArray, RealField
from ilmek.cams.programme import TURN, CamProgramme, FollowerMotion
from ilmek.cams.trace import CamCurves, CamTrace
from ilmek.errors import ParameterError
from ilmek.plane.vectors import cross
from ilmek.records import value_record
from ilmek.units import format_quantity


def trace_of_strip(
    angle: FloatArray,
    motion: FollowerMotion,
    point: tuple[ComplexField, ComplexField, ComplexField],
    direction: ComplexField,
    *,
    radius: RealField,
    roller_radius: float,
) -> CamTrace:
    """Trace of a roller on a cam that is developed at a radius.

    angle          cam angles [rad], any shape             motion  the follower's motion there
    point          roller's centre B and its derivatives B', B'' by the cam angle [m]
    direction      unit direction in which the roller moves as the displacement grows
    radius         rho [m], one or one per angle                           roller_radius  [m]
    """
    centre, first, second = point
    along = np.asarray(first - 1j * radius)
    square = along.real**2 + along.imag**2
    flow = np.sqrt(square)
    push = 1j * along / flow
    leaning = push * np.conj(direction)
    return CamTrace(
        angle=angle,
        motion=motion,
        pitch=np.asarray(centre - 1j * radius * angle),
        normal=push,
        pressure_angle=np.arctan2(leaning.imag, leaning.real),
        flow=flow,
        turning=np.asarray(-cross(along, np.asarray(second)) / square),
        roller_radius=roller_radius,
    )


@value_record
class WedgeCam(CamCurves):
    """A wedge: a plate that moves to and fro and lifts a roller or a knife edge; lengths in m.

    programme  the follower's motion over the plate; its turn is `length` of travel
    used       travel of the plate [rad of the programme]: the plate ends there
    lean       angle of the follower's direction from the normal of the travel [rad], positive towards the travel

    Raises ParameterError unless length > 0, 0 < used <= 2 pi and |lean| < pi/2.
    """

    programme: CamProgramme
    length: float
    roller_radius: float = 0.0
    used: float = TURN
    lean: float = 0.0
    flat: ClassVar[bool] = False

    def __post_init__(self) -> None:
        if not self.length > 0:
            raise ParameterError(f"length={format_quantity(self.length, 'mm')}", allowed="above 0 mm")
        if not 0 < self.used <= TURN:
            raise ParameterError(f"used={format_quantity(self.used, 'deg')}", allowed="above 0 deg, up to 360 deg")
        if not abs(self.lean) < math.pi / 2:
            raise ParameterError(f"lean={format_quantity(self.lean, 'deg')}", allowed="between -90 and 90 deg")

    @property
    def prime_radius(self) -> float:
        """Travel per radian of the programme [m]: it corresponds to the prime radius of a plate."""
        return self.length / TURN

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Bounds of the travel per radian [m], both excluded."""
        return 0.0, math.inf

    @property
    def knots(self) -> FloatArray:
        """Angles of the programme [rad], ascending, between which the plate is smooth."""
        inner = self.programme.knots
        end = float(inner[0]) + self.used
        return np.append(inner[inner < end], end)

    def resized(self, prime_radius: float) -> "WedgeCam":
        """The same wedge with another travel per radian of the programme [m]."""
        return replace(self, length=prime_radius * TURN)

    def trace_of(self, angle: FloatArray, motion: FollowerMotion) -> CamTrace:
        """The trace at angles of the programme [rad], for the follower's motion there."""
        direction = complex(math.cos(self.lean), math.sin(self.lean))
        point = motion.s * direction, motion.ds * direction, motion.dds * direction
        radius = self.prime_radius
        return trace_of_strip(angle, motion, point, direction, radius=radius, roller_radius=self.roller_radius)
