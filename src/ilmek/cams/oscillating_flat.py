"""Plate cam with an oscillating flat-faced follower: formulas at one cam angle, and the cam.

The cam turns counter-clockwise by theta about 0; the face swings about the pivot c on the x axis, by psi from the line
pivot - axis; psi grows as the face moves out. The face lies f beyond the pivot, away from the cam. In the world its
normal m, its distance h from the axis and the contact point K are, with tau = 1 + side psi',

    m = i side exp(-i side psi),   h = c sin psi + f,   K = (h - i h'/tau) m,   h' = c cos psi psi'

tau is the rate of the normal's direction as seen from the cam. The envelope of the faces has the radius of curvature

    rho = h + h''/tau^2 - h' tau'/tau^3,   h'' = c (cos psi psi'' - sin psi psi'^2),   tau' = side psi''

which must be above 0, and tau too. The contact force acts along m: the pressure angle is arctan(f / distance of K from
the pivot along the face), 0 for a face through the pivot. side +1: face above the line (trailing), -1: below it.
[support function: do Carmo, Differential Geometry of Curves and Surfaces, 1-7]
"""

import math
from typing import ClassVar, Literal

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.programme import CamProgramme, FollowerMotion
from ilmek.cams.trace import CamCurves, CamTrace
from ilmek.errors import ParameterError
from ilmek.num.piecewise import infimum, supremum
from ilmek.plane.vectors import unit
from ilmek.records import value_record
from ilmek.units import format_quantity


@value_record
class OscillatingFlatCam(CamCurves):
    """A plate cam with an oscillating flat-faced follower; the programme's displacement is in rad.

    prime_radius  least distance [m] of the face from the axis, where the displacement is 0
    pivot         distance of the follower's pivot from the axis [m]
    face_offset   distance of the face beyond the pivot, away from the cam [m]
    side          +1: face above the line from axis to pivot (trailing), -1: below it

    Raises ParameterError where the face cannot reach the base circle, or swings to a right angle.
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
                do="reduce the swing, or move the pivot away" if most <= 0 else "",
            )

    @property
    def start_angle(self) -> float:
        """The face's angle psi [rad] where the displacement is 0."""
        return math.asin((self.prime_radius - self.face_offset) / self.pivot)

    @property
    def swing(self) -> float:
        """Largest swing of the face from displacement 0 [rad]."""
        return self.programme.bounds[1]

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Bounds of the base radius [m], both excluded: the face must not swing past a right angle."""
        return 0.0, self.pivot * math.cos(min(self.swing, math.pi)) + self.face_offset

    def trace_of(self, angle: FloatArray, motion: FollowerMotion) -> CamTrace:
        """The trace at cam angles [rad], for the follower's motion there; the pitch curve is the surface itself."""
        swung = self.pivot * unit(self.start_angle + motion.s)
        far = swung.imag + self.face_offset
        first, second = swung.real * motion.ds, swung.real * motion.dds - swung.imag * motion.ds**2
        turning = 1 + self.side * motion.ds
        wander = first / turning
        normal = 1j * self.side * unit(-self.side * (self.start_angle + motion.s) - angle)
        flow = far * turning + (second - wander * self.side * motion.dds) / turning
        return CamTrace(
            angle=angle,
            motion=motion,
            pitch=np.asarray((far - 1j * wander) * normal),
            normal=np.asarray(normal),
            pressure_angle=np.arctan2(self.side * self.face_offset, swung.real - self.side * wander),
            flow=np.asarray(flow),
            turning=np.asarray(turning),
            roller_radius=0.0,
        )

    def contact_distance(self, angle: FloatArray) -> FloatArray:
        """Distance [m] of the contact from the foot of the pivot on the face, towards the cam, at cam angles [rad]."""
        at = self.programme.at(angle)
        foot = self.pivot * np.cos(self.start_angle + at.s)
        return np.asarray(foot * (1 - self.side * at.ds / (1 + self.side * at.ds)))


def face_span(cam: OscillatingFlatCam) -> tuple[float, float]:
    """Least and largest distance [m] of the contact from the pivot along the face: the face must cover both."""
    knots = cam.programme.knots
    return infimum(cam.contact_distance, knots).value, supremum(cam.contact_distance, knots).value
