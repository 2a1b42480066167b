"""Plate cam with a translating flat-faced follower: formulas of one cam angle, and the cam.

The cam turns counter-clockwise by theta; the face is perpendicular to the follower's direction, which is +x, at
h = Rb + s from the axis. Seen from the cam, the face is a line that turns about it; the cam is their envelope:

    K = (h - i s') exp(-i theta),    rho = h + s'',    n = exp(-i theta)

The contact force acts along the follower's direction, so the pressure angle is always 0. The contact moves along the
face by s' and tilts the follower: its lever arm about the stem is s' - e. The cam must be convex all round, rho > 0.
Harmonic rise and fall over half a turn each make a circle of radius Rb + L/2.  [Norton, Cam Design and Manufacturing,
7; support function: do Carmo, Differential Geometry of Curves and Surfaces, 1-7]
"""

import math
from typing import ClassVar

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.cams.programme import CamProgramme, FollowerMotion
from ilmek.cams.trace import CamCurves, CamTrace
from ilmek.errors import ParameterError
from ilmek.num.piecewise import infimum, supremum
from ilmek.plane.vectors import unit
from ilmek.records import value_record
from ilmek.units import format_quantity


def curvature_radius(s: RealField, dds: RealField, base_radius: float) -> RealField:
    """Radius of curvature of the cam's surface, Rb + s + s'' [m]; not above 0: undercut."""
    return base_radius + s + dds


@value_record
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
        """Bounds of the base radius [m], both excluded."""
        return 0.0, math.inf

    def trace_of(self, angle: FloatArray, motion: FollowerMotion) -> CamTrace:
        """The trace at cam angles [rad], for the follower's motion there; the pitch curve is the surface itself."""
        normal = np.asarray(unit(-angle))
        return CamTrace(
            angle=angle,
            motion=motion,
            pitch=(self.prime_radius + motion.s - 1j * motion.ds) * normal,
            normal=normal,
            pressure_angle=np.zeros_like(angle),
            flow=np.asarray(curvature_radius(motion.s, motion.dds, self.prime_radius)),
            turning=np.ones_like(angle),
            roller_radius=0.0,
        )

    def lever(self, angle: FloatArray) -> FloatArray:
        """Lever arm s' - e [m] of the contact force about the follower's stem, at cam angles [rad]."""
        return self.programme.at(angle).ds - self.offset


def face_span(cam: FlatCam) -> tuple[float, float]:
    """Least and largest lever arm s' - e [m] of the contact about the stem: the face must cover both."""
    knots = cam.programme.knots
    return infimum(cam.lever, knots).value, supremum(cam.lever, knots).value
