"""Cams laid flat: the development of a barrel or end cam, and the wedge cam, which is flat already.

Real axis: the way of the follower, imaginary: the way of the cam, which moves by rho theta towards +i under it, so that
everything reads as of a plate cam whose axis is far away. In the strip's own frame, with B the roller's centre,

    P = B - i rho theta,   dP = B' - i rho,   d2P = B''

rho is the barrel's radius at which it is cut and laid flat; of a wedge, its travel for a radian of the programme. A
follower that goes straight (B = s) has tan mu = s'/rho and kappa = -rho s'' / (rho^2 + s'^2)^(3/2).
[Rothbart, Cam Design Handbook, 10; Norton, Cam Design and Manufacturing, 7]
"""

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ilmek.arrays import ComplexField, FloatArray
from ilmek.cams.programme import TURN, CamProgramme, FollowerMotion
from ilmek.cams.trace import CamCurves, CamTrace
from ilmek.errors import ParameterError
from ilmek.plane.vectors import cross
from ilmek.units import format_quantity


def trace_of_strip(
    angle: FloatArray,
    course: FollowerMotion,
    motion: tuple[ComplexField, ComplexField, ComplexField],
    way: ComplexField,
    *,
    radius: float,
    roller_radius: float,
) -> CamTrace:
    """Trace of a roller on a cam laid flat at a radius [m]; motion (B, B', B'') and way of the follower as above."""
    point, first, second = motion
    along = np.asarray(first - 1j * radius)
    square = along.real**2 + along.imag**2
    flow = np.sqrt(square)
    push = 1j * along / flow
    leaning = push * np.conj(way)
    return CamTrace(
        angle=angle,
        course=course,
        pitch=np.asarray(point - 1j * radius * angle),
        normal=push,
        pressure_angle=np.arctan2(leaning.imag, leaning.real),
        flow=flow,
        turning=np.asarray(-cross(along, np.asarray(second)) / square),
        roller_radius=roller_radius,
    )


@dataclass(frozen=True, slots=True)
class WedgeCam(CamCurves):
    """A wedge: a plate that moves to and fro and lifts a roller or a knife edge; lengths in m.

    programme  the follower's motion over the plate; its turn is `length` of travel
    used       how far the plate goes [rad of the programme]: what lies behind it is not there
    lean       angle of the follower's way from the normal of the travel [rad], positive towards the travel

    Raises ParameterError for a length not above 0, a part not within a turn, or a lean of a right angle.
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
        """Travel for a radian of the programme [m]; what the prime radius is to a plate."""
        return self.length / TURN

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Between which travels for a radian [m] the wedge can be built: all above 0."""
        return 0.0, math.inf

    @property
    def knots(self) -> FloatArray:
        """Places of the programme [rad] on the plate between which it is smooth."""
        inner = self.programme.knots
        end = float(inner[0]) + self.used
        return np.append(inner[inner < end], end)

    def resized(self, prime_radius: float) -> "WedgeCam":
        """The same wedge with another travel for a radian of the programme [m]."""
        return replace(self, length=prime_radius * TURN)

    def trace_of(self, angle: FloatArray, course: FollowerMotion) -> CamTrace:
        """Everything at places of the programme [rad] where the follower's course is known there."""
        way = complex(math.cos(self.lean), math.sin(self.lean))
        motion = course.s * way, course.ds * way, course.dds * way
        radius = self.prime_radius
        return trace_of_strip(angle, course, motion, way, radius=radius, roller_radius=self.roller_radius)
