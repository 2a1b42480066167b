"""Plate cam with an oscillating flat-faced follower: formulas of one cam angle, and the cam.

The cam turns counter-clockwise by theta about 0; the face swings about the pivot c on the x axis, by psi from the line
pivot - axis; psi grows as the face goes out. The face lies f beyond the pivot, away from the cam. In the world its
normal, its distance from the axis and, with tau = 1 + side psi', the contact's way along it are

    m = i side exp(-i side psi),   h = c sin psi + f,   K = (h - i h'/tau) m,   h' = c cos psi psi'

tau is how fast the normal turns as seen from the cam; the envelope of the faces has the radius of curvature

    rho = h + h''/tau^2 - h' tau'/tau^3,   h'' = c (cos psi psi'' - sin psi psi'^2),   tau' = side psi''

which must be above 0, and tau too. The push is along m: the pressure angle is arctan(f / distance of K along the face
from the pivot), 0 for a face through the pivot. side +1: the face above the line (trailing), -1: below it.
[support function: do Carmo, Differential Geometry of Curves and Surfaces, 1-7]
"""

import math
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.programme import CamProgramme, FollowerMotion
from ilmek.cams.trace import CamCurves, CamTrace
from ilmek.errors import ParameterError
from ilmek.num.piecewise import infimum, supremum
from ilmek.plane.vectors import unit
from ilmek.units import format_quantity


@dataclass(frozen=True, slots=True)
class OscillatingFlatCam(CamCurves):
    """A plate cam with an oscillating flat-faced follower; the programme's displacement is in rad.

    prime_radius  least distance [m] of the face from the axis, where the displacement is 0
    pivot         distance of the follower's pivot from the axis [m]
    face_offset   how far the face lies beyond the pivot, away from the cam [m]
    side          +1: face above the line from axis to pivot (trailing), -1: below it

    Raises ParameterError where the face does not reach the base circle, or swings upright.
    """

    programme: CamProgramme
    prime_radius: float
    pivot: float
    face_offset: float = 0.0
    side: Literal[1, -1] = 1
    roller_radius: ClassVar[float] = 0.0
    flat: ClassVar[bool] = True

    def __post_init__(self) -> None:
        most = self.prime_bounds[1]
        if not 0 < self.prime_radius < most:
            shown, pivot = format_quantity(self.prime_radius, "mm"), format_quantity(self.pivot, "mm")
            raise ParameterError(
                f"prime_radius={shown} with pivot={pivot} and {format_quantity(self.swing, 'deg')} of swing",
                allowed=f"above 0 mm, below {format_quantity(most, 'mm')}",
                do="swing less, or put the pivot further away" if most <= 0 else "",
            )

    @property
    def start_angle(self) -> float:
        """The face's angle psi [rad] where the displacement is 0."""
        return math.asin((self.prime_radius - self.face_offset) / self.pivot)

    @property
    def swing(self) -> float:
        """How far the face swings out from where the displacement is 0 [rad]."""
        return self.programme.bounds[1]

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Between which base radii [m] the cam can be built: the face must not swing past a right angle."""
        return 0.0, self.pivot * math.cos(min(self.swing, math.pi)) + self.face_offset

    def resized(self, prime_radius: float) -> "OscillatingFlatCam":
        """The same cam with another prime radius [m]."""
        return replace(self, prime_radius=prime_radius)

    def trace_of(self, angle: FloatArray, course: FollowerMotion) -> CamTrace:
        """Everything at cam angles [rad], of the course there; the pitch curve is the surface itself."""
        swung = self.pivot * unit(self.start_angle + course.s)
        far = swung.imag + self.face_offset
        first, second = swung.real * course.ds, swung.real * course.dds - swung.imag * course.ds**2
        turning = 1 + self.side * course.ds
        wander = first / turning
        normal = 1j * self.side * unit(-self.side * (self.start_angle + course.s) - angle)
        flow = far * turning + (second - wander * self.side * course.dds) / turning
        return CamTrace(
            angle=angle,
            course=course,
            pitch=np.asarray((far - 1j * wander) * normal),
            normal=np.asarray(normal),
            pressure_angle=np.arctan2(self.side * self.face_offset, swung.real - self.side * wander),
            flow=np.asarray(flow),
            turning=np.asarray(turning),
            roller_radius=0.0,
        )

    def contact_distance(self, angle: FloatArray) -> FloatArray:
        """How far from the foot of the pivot on the face, towards the cam, the cam touches [m], at cam angles [rad]."""
        at = self.programme.at(angle)
        foot = self.pivot * np.cos(self.start_angle + at.s)
        return np.asarray(foot * (1 - self.side * at.ds / (1 + self.side * at.ds)))


def face_span(cam: OscillatingFlatCam) -> tuple[float, float]:
    """The least and the largest distance [m] of the contact from the pivot along the face: it must cover them."""
    knots = cam.programme.knots
    return infimum(cam.contact_distance, knots).value, supremum(cam.contact_distance, knots).value
