"""Plate cam with a translating flat-faced follower: formulas of one cam angle, and the cam.

The cam turns counter-clockwise by theta; the face stands across the follower's way, which is +x, at h = Rb + s from
the axis. Seen from the cam, the face is a line that turns about it, and the cam is what all these lines leave over:

    K = (h - i s') exp(-i theta),    rho = h + s'',    n = exp(-i theta)

The push is along the follower's way, so that the pressure angle is 0 all round; instead, the contact wanders along
the face by s' and tilts the follower: its lever about the stem is s' - e. The cam must be convex all round, rho > 0.
Harmonic rise and fall over half a turn each make a circle of radius Rb + L/2.  [Norton, Cam Design and Manufacturing,
7; support function: do Carmo, Differential Geometry of Curves and Surfaces, 1-7]
"""

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ilmek.arrays import ComplexField, FloatArray, RealField
from ilmek.cams.programme import CamProgramme, FollowerMotion
from ilmek.cams.trace import CamCurves, CamTrace
from ilmek.errors import ParameterError
from ilmek.num.piecewise import infimum, supremum
from ilmek.plane.vectors import unit
from ilmek.units import format_quantity


def contact_point(angle: RealField, s: RealField, ds: RealField, base_radius: float) -> ComplexField:
    """Where the face touches the cam, in the cam's frame [m]."""
    return (base_radius + s - 1j * ds) * unit(-angle)


def curvature_radius(s: RealField, dds: RealField, base_radius: float) -> RealField:
    """Radius of curvature of the cam's surface [m]; not above 0 where no surface can guide the face."""
    return base_radius + s + dds


@dataclass(frozen=True, slots=True)
class FlatCam(CamCurves):
    """A plate cam with a translating flat-faced follower; lengths in m.

    prime_radius  radius of the base circle     offset  of the stem, on the line y = -offset; the cam is the same
    Raises ParameterError for a base circle that is not above 0.
    """

    programme: CamProgramme
    prime_radius: float
    offset: float = 0.0
    roller_radius: ClassVar[float] = 0.0
    flat: ClassVar[bool] = True

    def __post_init__(self) -> None:
        if not self.prime_radius > 0:
            shown = format_quantity(self.prime_radius, "mm")
            raise ParameterError(f"prime_radius={shown} is too small", allowed="above 0 mm")

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Between which base radii [m] the cam can be built: all above 0."""
        return 0.0, math.inf

    def resized(self, prime_radius: float) -> "FlatCam":
        """The same cam with another prime radius [m]."""
        return replace(self, prime_radius=prime_radius)

    def trace_of(self, angle: FloatArray, course: FollowerMotion) -> CamTrace:
        """Everything at cam angles [rad], of the course there; the pitch curve is the surface itself."""
        normal = np.asarray(unit(-angle))
        return CamTrace(
            angle=angle,
            course=course,
            pitch=(self.prime_radius + course.s - 1j * course.ds) * normal,
            normal=normal,
            pressure_angle=np.zeros_like(angle),
            flow=np.asarray(curvature_radius(course.s, course.dds, self.prime_radius)),
            turning=np.ones_like(angle),
            roller_radius=0.0,
        )

    def lever(self, angle: FloatArray) -> FloatArray:
        """Lever [m] of the cam's push about the follower's stem, at cam angles [rad]; positive on the rise."""
        return self.programme.at(angle).ds - self.offset


def face_span(cam: FlatCam) -> tuple[float, float]:
    """The least and the largest lever [m] of the contact about the stem: the face must reach from one to the other.

    min s' - e and max s' - e: the face is as long as the sum of the largest speeds out and back.
    """
    knots = cam.programme.knots
    return infimum(cam.lever, knots).value, supremum(cam.lever, knots).value
