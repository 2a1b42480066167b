"""Barrel (cylindrical) and end cams: a roller whose axis is radial, moved along the cam's axis or on an arm.

The cam turns counter-clockwise about z. At the distance rho from the axis the roller's axis is at (rho, y, z)
with B = z + i y (`strip`). The roller touches the cam at B + d n, |n| = 1, d = -Rr (lower flank) or +Rr (upper flank),
where n is perpendicular to the relative velocity: n = i (B' - i rho)/|B' - i rho|. So the exact flanks in space are

    (x + i y, z) = ((rho + i Im w) exp(-i theta), Re w),   w = B + d n(rho)

The development at the radius rho has the pressure angle of the roller there; it is largest at the roller's inner end. A
flank guides the roller where

    |B' - i rho| + d turning - Im(w) d Re(B') / |B' - i rho|^2  > 0

The development neglects the last term: the contact moves along the roller's axis because the cam is round.
An end cam has only the lower flank, and a spring; the groove of a barrel has both flanks. [derived from the condition
of contact, n perpendicular to the relative velocity; development: `strip` and its source, Norton]
"""

import math
from abc import abstractmethod
from functools import partial
from typing import ClassVar, Literal

import numpy as np

from ilmek.arrays import ComplexField, Float, FloatArray, RealField
from ilmek.cams.programme import CamProgramme, FollowerMotion
from ilmek.cams.strip import trace_of_strip
from ilmek.cams.trace import CamCurves, CamTrace
from ilmek.errors import ParameterError
from ilmek.num.piecewise import Extremum, infimum
from ilmek.plane.vectors import unit
from ilmek.records import value_record
from ilmek.units import format_quantity

Space = Float[np.ndarray, "*batch 3"]
"""Points in space: x, y, z [m]."""


class Barrel(CamCurves):
    """Barrel or end cam; a subclass gives the roller's motion and its direction in the development."""

    __slots__ = ()

    prime_radius: float
    roller_radius: float
    roller_width: float

    @abstractmethod
    def roller_motion(self, motion: FollowerMotion) -> tuple[ComplexField, ComplexField, ComplexField]:
        """Roller's centre B = z + i y and its derivatives by the cam angle [m]."""

    @abstractmethod
    def direction(self, motion: FollowerMotion) -> ComplexField:
        """Unit direction in which the roller moves as the displacement grows."""

    def trace_of(self, angle: FloatArray, motion: FollowerMotion) -> CamTrace:
        """The trace at cam angles [rad], for the follower's motion there, in the development at the mean radius."""
        size = {"radius": self.prime_radius, "roller_radius": self.roller_radius}
        return trace_of_strip(angle, motion, self.roller_motion(motion), self.direction(motion), **size)

    @property
    def depths(self) -> tuple[float, float]:
        """Distances of the roller's inner and outer end from the cam's axis [m]."""
        return self.prime_radius - self.roller_width / 2, self.prime_radius + self.roller_width / 2

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Bounds of the mean radius [m], both excluded: the roller must not reach the cam's axis."""
        return self.roller_width / 2, math.inf

    def flank(self, angle: FloatArray, depth: RealField, side: Literal[1, -1] = -1) -> Space:
        """Contact points on a flank in space, (*angle, 3), in the cam's frame [m].

        angle  cam angles [rad]      depth  distance rho from the axis along the roller [m],
        one or one per angle
        side   -1: the flank below the roller, which pushes it out on a rise; +1: the flank above it

        A contact point lies at |rho + i Im w| from the axis, slightly more than the depth.
        """
        trace, w = self._section(angle, depth, side)
        round_ = (depth + 1j * w.imag) * unit(-trace.angle)
        return np.stack([round_.real, round_.imag, w.real], axis=-1)

    def guiding(self, angle: FloatArray, depth: float, side: Literal[1, -1] = -1) -> FloatArray:
        """Speed of the contact along a flank [m/rad] at cam angles [rad] and a depth [m]; not above 0: undercut.

        side  as in `flank`
        """
        trace, w = self._section(angle, depth, side)
        distance = side * self.roller_radius
        first = np.asarray(self.roller_motion(trace.motion)[1])
        wander = w.imag * distance * first.real / trace.flow**2
        return np.asarray(trace.flow + distance * trace.turning - wander)

    def _section(self, angle: FloatArray, depth: RealField, side: int) -> tuple[CamTrace, np.ndarray]:
        """Development at a depth [m], and the flank's points there, B + d n."""
        motion = self.programme.at(angle)
        point = self.roller_motion(motion)
        trace = trace_of_strip(
            angle, motion, point, self.direction(motion), radius=depth, roller_radius=self.roller_radius
        )
        return trace, np.asarray(point[0] + side * self.roller_radius * trace.normal)


@value_record
class BarrelCam(Barrel):
    """A barrel or end cam with a roller that slides along its axis; lengths in m.

    prime_radius  distance of the middle of the roller from the cam's axis     roller_width  length of the roller

    Raises ParameterError where the roller reaches the axis.
    """

    programme: CamProgramme
    prime_radius: float
    roller_radius: float = 0.0
    roller_width: float = 0.0
    flat: ClassVar[bool] = False

    def __post_init__(self) -> None:
        _check_roller(self.prime_radius, self.roller_width)

    def roller_motion(self, motion: FollowerMotion) -> tuple[ComplexField, ComplexField, ComplexField]:
        """B = s, along the axis, with B' and B''."""
        return motion.s, motion.ds, motion.dds

    def direction(self, motion: FollowerMotion) -> ComplexField:  # noqa: ARG002
        """Along the axis."""
        return 1.0


@value_record
class BarrelArmCam(Barrel):
    """A barrel or end cam with a roller on an arm that swings about a radial line; the programme is in rad.

        B = l sin phi + i side (l cos phi - t),   phi = start + s

    start  angle of the arm from the plane perpendicular to the cam's axis, at displacement 0 [rad]; with -swing/2 the
           arm swings symmetrically about that plane
    arm    length l from the pivot to the roller [m]
    pivot  distance t of the pivot from the plane through the cam's axis and the roller's mean position [m]; with
           t = l cos(swing/2) the roller deviates equally to both sides
    side   +1: the cam's surface moves from the pivot to the roller (trailing arm), -1: towards the pivot

    Raises ParameterError where the roller reaches the axis, or the arm swings to 90 deg or beyond.
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

    def roller_motion(self, motion: FollowerMotion) -> tuple[ComplexField, ComplexField, ComplexField]:
        """B, B' = l psi' e and B'' = (psi'' - i side psi'^2) l e, with e the direction."""
        out = self.arm * self.direction(motion)
        centre = 1j * self.side * (out - self.pivot)
        return centre, motion.ds * out, (motion.dds - 1j * self.side * motion.ds**2) * out

    def direction(self, motion: FollowerMotion) -> ComplexField:
        """Perpendicular to the arm: exp(-i side phi)."""
        return unit(-self.side * (self.start + motion.s))


def undercut_in_space(cam: Barrel, *, both_flanks: bool = True) -> Extremum | None:
    """The worst undercut: cam angle [rad] and speed of the contact [m/rad], not above 0; None without undercut.

    both_flanks  both flanks of a groove, else the lower flank of an end cam

    The search covers both ends of the roller and its middle.
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
    """Least and greatest gap [m] between the roller and a flank cut by a cutter of another radius.

    radius  of the cutter [m], at most the roller's      side  flank, as in `Barrel.flank`
    count   of poses, evenly over the turn; the gap is computed at both ends of the roller

    The cutter's axis is radial, as the roller's is. The flank is exact at the mean radius. Towards the roller's ends
    the normals turn, and the cutter leaves material (gap below 0) or removes too much. A cutter of the roller's radius
    gives 0.
    """
    angle = np.linspace(float(cam.knots[0]), float(cam.knots[-1]), count)
    middle = cam.trace(angle)
    first = np.asarray(cam.roller_motion(middle.motion)[1])
    beside = side * (cam.roller_radius - radius)
    centre = np.asarray(cam.roller_motion(middle.motion)[0]) + beside * middle.normal
    speed = first - 1j * beside * middle.turning * middle.normal
    gaps = []
    for depth in cam.depths:
        along = speed - 1j * depth
        cut = centre + side * radius * 1j * along / np.abs(along)
        gaps.append(_gaps(cam, angle, depth + 1j * cut.imag, cut.real))
    return float(np.min(gaps)), float(np.max(gaps))


def _gaps(cam: Barrel, angle: FloatArray, level: np.ndarray, up: FloatArray) -> FloatArray:
    """Gap [m] of points (x + i y, z), given at cam angles [rad], from the roller in the nearest pose."""
    later = np.linspace(-_LATER, _LATER, 61)
    poses = angle[:, None] + later
    centre = np.asarray(cam.roller_motion(cam.programme.at(poses))[0])
    turned = level[:, None] * unit(later)
    apart = np.hypot(turned.imag - centre.imag, up[:, None] - centre.real)
    row, best = np.arange(angle.size), np.clip(np.argmin(apart, axis=1), 1, later.size - 2)
    before, here, after = (apart[row, best + step] for step in (-1, 0, 1))
    # The minimum of the parabola through the nearest pose and its neighbours.
    return np.asarray(here - (after - before) ** 2 / (8 * (after - 2 * here + before)) - cam.roller_radius)


_LATER = 0.1
"""Cam angle [rad] before and after the cut of a point within which the roller may come nearest to it."""


def _check_roller(prime_radius: float, roller_width: float) -> None:
    if not prime_radius > roller_width / 2:
        shown, least = format_quantity(prime_radius, "mm"), format_quantity(roller_width / 2, "mm")
        raise ParameterError(f"prime_radius={shown} is too small", allowed=f"above half the roller's width, {least}")
