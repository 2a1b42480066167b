"""Pitch curve, normals and pressure angle of a cam: one record for every kind of cam and follower.

In the cam's frame the pitch curve P (the path of the roller's centre or the knife edge; for a flat face the surface
itself) is traversed against the cam's rotation, with the cam on its right:

    dP/dtheta = -i n flow,    dn/dtheta = -i n turning,    kappa = turning / flow

n is the unit normal that points out of the cam, to the follower. A parallel curve at the signed distance d along the
normals has the same normals and flow_d = flow + d turning; where that is not above 0 the curve has a cusp and cannot
guide. Surface, cutter path and both flanks of a groove are parallel curves:

    surface  d = -Rr      other flank of a groove  d = +Rr      centre of a cutter  d = Rc - Rr

Positive curvature is convex.  [do Carmo, Differential Geometry of Curves and Surfaces, 1-5, parallel curves]
"""

from abc import ABC, abstractmethod
from dataclasses import replace
from typing import Protocol, Self, runtime_checkable

import numpy as np

from ilmek.arguments import Quantities
from ilmek.arrays import ComplexArray, ComplexField, FloatArray
from ilmek.cams.programme import CamProgramme, FollowerMotion, cam_angles
from ilmek.plane.vectors import cross, dot, unit
from ilmek.records import record


@record
class CamTrace:
    """Pitch curve and derived quantities at cam angles [rad], arrays of one shape, in the cam's frame.

    motion          displacement of the follower and its derivatives by the cam angle
    pitch           points of the pitch curve [m]
    normal          its outward unit normals
    pressure_angle  from the follower's direction to the contact normal [rad]; positive on a steep rise
    flow, turning   speed of the pitch point along its curve [m/rad] and of the normal's direction [1]
    roller_radius   distance of the surface inside the pitch curve [m]
    """

    angle: FloatArray
    motion: FollowerMotion
    pitch: ComplexArray
    normal: ComplexArray
    pressure_angle: FloatArray
    flow: FloatArray
    turning: FloatArray
    roller_radius: float

    @property
    def curvature(self) -> FloatArray:
        """Curvature of the pitch curve [1/m]."""
        return np.asarray(self.turning / self.flow)

    @property
    def surface(self) -> ComplexArray:
        """Points of the cam's surface [m], under the roller."""
        return self.parallel(-self.roller_radius)

    @property
    def surface_curvature(self) -> FloatArray:
        """Curvature of the cam's surface [1/m], infinite in a cusp."""
        return self.curvature_at(-self.roller_radius)

    @property
    def sector(self) -> FloatArray:
        """(K . n) flow_K [m^2/rad] of the surface K: twice the rate of the area swept from the axis."""
        return np.asarray(dot(self.surface, self.normal) * (self.flow - self.roller_radius * self.turning))

    def parallel(self, distance: float) -> ComplexArray:
        """The curve at a signed distance [m] outside the pitch curve."""
        return np.asarray(self.pitch + distance * self.normal)

    def curvature_at(self, distance: float) -> FloatArray:
        """Curvature [1/m] of the curve at a signed distance [m] outside the pitch curve: kappa / (1 + d kappa)."""
        with np.errstate(divide="ignore"):
            return np.asarray(self.turning / (self.flow + distance * self.turning))


@runtime_checkable
class CamRole(Protocol):
    """Interface of a cam for limits and sizing; `prime_radius` sets its size."""

    @property
    def programme(self) -> CamProgramme:
        """Motion of the follower over the turn."""

    @property
    def prime_radius(self) -> float:
        """Least distance of the pitch curve from the axis [m]; of the face, where the follower is flat."""

    @property
    def knots(self) -> FloatArray:
        """Cam angles [rad], ascending over the cam, between which it is smooth."""

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Bounds of the prime radius [m], both excluded."""

    @property
    def roller_radius(self) -> float:
        """Radius of the roller or sphere [m]; 0 for a knife edge and for a flat face."""

    @property
    def flat(self) -> bool:
        """Whether the follower's face is flat: the cam must then be convex."""

    def trace_of(self, angle: FloatArray, motion: FollowerMotion) -> CamTrace:
        """Everything at cam angles [rad] where the follower's motion is known there."""

    def trace(self, angle: FloatArray) -> CamTrace:
        """The trace at cam angles [rad]."""

    def resized(self, prime_radius: float) -> "CamRole":
        """The same cam with another prime radius [m]."""


class CamCurves(ABC):
    """Single curves of a cam; each call computes the whole trace."""

    __slots__ = ()

    programme: CamProgramme

    @property
    def knots(self) -> FloatArray:
        """Cam angles [rad], ascending over the turn, between which the cam is smooth."""
        return self.programme.knots

    @abstractmethod
    def trace_of(self, angle: FloatArray, motion: FollowerMotion) -> CamTrace:
        """Everything at cam angles [rad] where the follower's motion is known there."""

    def trace(self, angle: Quantities) -> CamTrace:
        """The trace at cam angles [rad]."""
        angles = cam_angles(angle)
        return self.trace_of(angles, self.programme.motion(angles))

    def pitch(self, angle: Quantities) -> ComplexArray:
        """Pitch curve at cam angles [rad], in the cam's frame [m]."""
        return self.trace(angle).pitch

    def surface(self, angle: Quantities) -> ComplexArray:
        """Cam surface at cam angles [rad], in the cam's frame [m]."""
        return self.trace(angle).surface

    def pressure_angle(self, angle: Quantities) -> FloatArray:
        """Pressure angle [rad] at cam angles [rad]."""
        return self.trace(angle).pressure_angle

    def resized(self, prime_radius: float) -> Self:
        """The same cam with another prime radius [m]."""
        return replace(self, prime_radius=prime_radius)  # type: ignore[type-var]  # every cam is a record

    def curvature(self, angle: Quantities) -> FloatArray:
        """Curvature of the pitch curve [1/m] at cam angles [rad], positive where convex."""
        return self.trace(angle).curvature


def trace_of_point(
    angle: FloatArray,
    motion: FollowerMotion,
    point: tuple[ComplexField, ComplexField, ComplexField],
    direction: ComplexField,
    roller_radius: float,
) -> CamTrace:
    """Trace of a follower that is a point (a roller's centre, a knife's edge) on a cam that turns counter-clockwise.

    angle      cam angles [rad], any shape             motion         the follower's motion there
    point      the point B in the world and its derivatives B', B'' by the cam angle [m]
    direction  unit direction in the world in which the point moves as the follower rises
    roller_radius  [m]

    Seen from the cam, P = B exp(-i theta), dP = (B' - i B) exp(-i theta), d2P = (B'' - 2i B' - B) exp(-i theta).
    """
    centre, first, second = point
    along = first - 1j * centre
    bend = second - 2j * first - centre
    square = along.real**2 + along.imag**2
    flow = np.sqrt(square)
    with np.errstate(divide="ignore", invalid="ignore"):  # NaN where the point is at rest relative to the cam
        push = 1j * along / flow
        turning = np.asarray(-cross(along, bend) / square)
    leaning = push * np.conj(direction)
    frame = unit(-angle)
    return CamTrace(
        angle=angle,
        motion=motion,
        pitch=np.asarray(centre * frame),
        normal=np.asarray(push * frame),
        pressure_angle=np.arctan2(leaning.imag, leaning.real),
        flow=flow,
        turning=turning,
        roller_radius=roller_radius,
    )
