"""Barrel (cylindrical) and end cams: a roller whose axis is radial, moved along the cam's axis or on an arm.

The cam turns counter-clockwise about z. At the depth rho from the axis the roller's centre is (rho, y, z) with
B = z + i y (`strip`). A point of the roller's mantle at that depth, B + d n, |n| = 1, d = -Rr (lower flank) or +Rr,
moves over the cam along it where n is square to the relative motion: n = i (B' - i rho)/|B' - i rho|. So the flanks in
space are, without any approximation,

    (x + i y, z) = ((rho + i Im w) exp(-i theta), Re w),   w = B + d n(rho)

and the development at the radius rho has the pressure angle that the roller has there: largest at its inner end. A
flank is a surface that guides where

    |B' - i rho| + d turning - Im(w) d Re(B') / |B' - i rho|^2  > 0

The last term is what the development leaves out: the contact wanders along the roller's axis as the cam is round.
An end cam is the lower flank alone, with a spring; a barrel's groove has both.
"""

import math
from abc import abstractmethod
from dataclasses import dataclass, replace
from functools import partial
from typing import ClassVar, Literal

import numpy as np

from ilmek.arrays import ComplexField, Float, FloatArray
from ilmek.cams.programme import CamProgramme, FollowerMotion
from ilmek.cams.strip import trace_of_strip
from ilmek.cams.trace import CamCurves, CamTrace
from ilmek.errors import ParameterError
from ilmek.num.piecewise import Extremum, infimum
from ilmek.plane.vectors import unit
from ilmek.units import format_quantity

Space = Float[np.ndarray, "*batch 3"]
"""Points in space: x, y, z [m]."""


class Barrel(CamCurves):
    """What all barrel and end cams share; a follower gives its motion and its way in the development."""

    __slots__ = ()

    prime_radius: float
    roller_radius: float
    roller_width: float

    @abstractmethod
    def motion(self, course: FollowerMotion) -> tuple[ComplexField, ComplexField, ComplexField]:
        """Roller's centre B = z + i y and its derivatives by the cam angle [m]."""

    @abstractmethod
    def way(self, course: FollowerMotion) -> ComplexField:
        """Unit direction in which the roller goes as the displacement grows."""

    def trace_of(self, angle: FloatArray, course: FollowerMotion) -> CamTrace:
        """Everything at cam angles [rad], of the course there, in the development at the mean radius."""
        size = {"radius": self.prime_radius, "roller_radius": self.roller_radius}
        return trace_of_strip(angle, course, self.motion(course), self.way(course), **size)

    @property
    def depths(self) -> tuple[float, float]:
        """Distances of the roller's inner and outer end from the cam's axis [m]."""
        return self.prime_radius - self.roller_width / 2, self.prime_radius + self.roller_width / 2

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Between which mean radii [m] the cam can be built: the roller must end before the axis."""
        return self.roller_width / 2, math.inf

    def flank(self, angle: FloatArray, depth: float, side: Literal[1, -1] = -1) -> Space:
        """Points of a flank in space, in the cam's frame [m], where it is touched at a depth [m] along the roller.

        side  -1: under the roller, which it pushes out on a rise; +1: over it      The point touched lies at the
        distance |rho + i Im w| from the axis, a little more than the depth.
        """
        trace, w = self._section(angle, depth, side)
        round_ = (depth + 1j * w.imag) * unit(-trace.angle)
        return np.stack([round_.real, round_.imag, w.real], axis=-1)

    def guiding(self, angle: FloatArray, depth: float, side: Literal[1, -1] = -1) -> FloatArray:
        """How fast the contact runs over a flank at a depth [m] [m/rad]; not above 0 where the flank is undercut."""
        trace, w = self._section(angle, depth, side)
        distance = side * self.roller_radius
        first = np.asarray(self.motion(trace.course)[1])
        wander = w.imag * distance * first.real / trace.flow**2
        return np.asarray(trace.flow + distance * trace.turning - wander)

    def _section(self, angle: FloatArray, depth: float, side: int) -> tuple[CamTrace, np.ndarray]:
        """Development at a depth, and the flank's points there as B + d n."""
        course = self.programme.at(angle)
        motion = self.motion(course)
        trace = trace_of_strip(angle, course, motion, self.way(course), radius=depth, roller_radius=self.roller_radius)
        return trace, np.asarray(motion[0] + side * self.roller_radius * trace.normal)


@dataclass(frozen=True, slots=True)
class BarrelCam(Barrel):
    """A barrel or end cam with a roller that slides along its axis; lengths in m.

    prime_radius  distance of the middle of the roller from the cam's axis     roller_width  its length

    Raises ParameterError where the roller reaches the axis.
    """

    programme: CamProgramme
    prime_radius: float
    roller_radius: float = 0.0
    roller_width: float = 0.0
    flat: ClassVar[bool] = False

    def __post_init__(self) -> None:
        _check_roller(self.prime_radius, self.roller_width)

    def motion(self, course: FollowerMotion) -> tuple[ComplexField, ComplexField, ComplexField]:
        """B = s, along the axis."""
        return course.s, course.ds, course.dds

    def way(self, course: FollowerMotion) -> ComplexField:  # noqa: ARG002
        """Along the axis."""
        return 1.0

    def resized(self, prime_radius: float) -> "BarrelCam":
        """The same cam with another mean radius [m]."""
        return replace(self, prime_radius=prime_radius)


@dataclass(frozen=True, slots=True)
class BarrelArmCam(Barrel):
    """A barrel or end cam with a roller on an arm that swings about a radial line; the programme is in rad.

        B = l sin phi + i side (l cos phi - t),   phi = start + s

    start  angle of the arm from the plane across the cam's axis where the displacement is 0 [rad]; with -swing/2 the
           arm swings evenly about that plane
    arm    its length to the roller l [m]      pivot  distance of its pivot from the plane through cam and roller t [m];
           with l cos(swing/2) the roller strays as far to one side as to the other
    side   +1: the cam's surface moves from the pivot to the roller (trailing arm), -1: towards the pivot

    Raises ParameterError where the roller reaches the axis or the arm swings along it.
    """

    programme: CamProgramme
    prime_radius: float
    arm: float
    pivot: float
    start: float
    side: Literal[1, -1] = 1
    roller_radius: float = 0.0
    roller_width: float = 0.0
    flat: ClassVar[bool] = False

    def __post_init__(self) -> None:
        _check_roller(self.prime_radius, self.roller_width)
        low, high = (self.start + end for end in self.programme.bounds)
        if not -math.pi / 2 < low <= high < math.pi / 2:
            shown = f"{format_quantity(low, 'deg')} to {format_quantity(high, 'deg')}"
            raise ParameterError(f"an arm that swings from {shown}", allowed="between -90 and 90 deg")

    def motion(self, course: FollowerMotion) -> tuple[ComplexField, ComplexField, ComplexField]:
        """B, B' = l psi' e and B'' = (psi'' - i side psi'^2) l e, with e the way."""
        out = self.arm * self.way(course)
        point = 1j * self.side * (out - self.pivot)
        return point, course.ds * out, (course.dds - 1j * self.side * course.ds**2) * out

    def way(self, course: FollowerMotion) -> ComplexField:
        """Square to the arm: exp(-i side phi)."""
        return unit(-self.side * (self.start + course.s))

    def resized(self, prime_radius: float) -> "BarrelArmCam":
        """The same cam with another mean radius [m]."""
        return replace(self, prime_radius=prime_radius)


def undercut_in_space(cam: Barrel, *, both_flanks: bool = True) -> Extremum | None:
    """The cam angle [rad] and the speed [m/rad], not above 0, where a flank is cut away worst; None where none is.

    Both ends of the roller and its middle are looked at; both_flanks: a groove's, else the lower one, of an end cam.
    """
    sides: tuple[Literal[1, -1], ...] = (-1, 1) if both_flanks else (-1,)
    found = [
        infimum(partial(cam.guiding, depth=depth, side=side), cam.knots)
        for depth in (cam.depths[0], cam.prime_radius, cam.depths[1])
        for side in sides
    ]
    worst = min(found, key=lambda extremum: extremum.value)
    return worst if worst.value <= 0 else None


def cutter_error(cam: Barrel, radius: float, side: Literal[1, -1] = -1, count: int = 181) -> tuple[float, float]:
    """How far a flank cut by a cutter of another radius [m] stands off the roller, at least and at most [m].

    The cutter's axis is radial as the roller's is, its centre runs beside the roller's so that the flank is exact at
    the mean radius; towards the roller's ends the normals turn, and the cutter leaves (below 0) or takes too much. Of
    poses evenly over the turn, at both ends of the roller. 0 for a cutter as large as the roller.
    """
    angle = np.linspace(float(cam.knots[0]), float(cam.knots[-1]), count)
    middle = cam.trace(angle)
    first = np.asarray(cam.motion(middle.course)[1])
    beside = side * (cam.roller_radius - radius)
    centre = np.asarray(cam.motion(middle.course)[0]) + beside * middle.normal
    speed = first - 1j * beside * middle.turning * middle.normal
    gaps = []
    for depth in cam.depths:
        along = speed - 1j * depth
        cut = centre + side * radius * 1j * along / np.abs(along)
        gaps.append(_gaps(cam, angle, depth + 1j * cut.imag, cut.real))
    return float(np.min(gaps)), float(np.max(gaps))


def _gaps(cam: Barrel, angle: FloatArray, level: np.ndarray, up: FloatArray) -> FloatArray:
    """Distance of points, seen at cam angles as (x + i y, z), from the roller's mantle in the pose that is nearest."""
    later = np.linspace(-_LATER, _LATER, 61)
    poses = angle[:, None] + later
    centre = np.asarray(cam.motion(cam.programme.at(poses))[0])
    turned = level[:, None] * unit(later)
    apart = np.hypot(turned.imag - centre.imag, up[:, None] - centre.real)
    row, best = np.arange(angle.size), np.clip(np.argmin(apart, axis=1), 1, later.size - 2)
    before, here, after = (apart[row, best + step] for step in (-1, 0, 1))
    # The least of the parabola through the nearest pose and its neighbours.
    return np.asarray(here - (after - before) ** 2 / (8 * (after - 2 * here + before)) - cam.roller_radius)


_LATER = 0.1
"""How much earlier or later [rad] the roller may come nearest to a point that was cut at a cam angle."""


def _check_roller(prime_radius: float, roller_width: float) -> None:
    if not prime_radius > roller_width / 2:
        shown, least = format_quantity(prime_radius, "mm"), format_quantity(roller_width / 2, "mm")
        raise ParameterError(f"prime_radius={shown} is too small", allowed=f"above half the roller's width, {least}")
