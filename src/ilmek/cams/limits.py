"""A plate cam as a whole, and its limits: pressure angle, curvature, undercut, area, smallest prime circle."""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams import profile
from ilmek.cams.pieces import Extremum, infimum, integral, supremum
from ilmek.cams.programme import Programme
from ilmek.errors import ParameterError
from ilmek.units import format_quantity


@dataclass(frozen=True, slots=True)
class PlateCam:
    """A plate cam with a translating roller or knife-edge follower; lengths in m, frame and signs as in `profile`.

    Raises ParameterError where the follower's line misses the prime circle or the roller fills it.
    """

    programme: Programme
    prime_radius: float
    offset: float = 0.0
    roller_radius: float = 0.0

    def __post_init__(self) -> None:
        least = max(abs(self.offset), self.roller_radius)
        if self.prime_radius <= least:
            shown = format_quantity(self.prime_radius, "mm")
            raise ParameterError(f"prime_radius={shown} is too small", allowed=f"above {format_quantity(least, 'mm')}")

    def pitch(self, angle: FloatArray) -> ComplexArray:
        """Pitch curve at cam angles [rad], in the cam's frame [m]."""
        points = profile.pitch_point(angle, self.programme.at(angle).s, self.prime_radius, self.offset)
        return np.asarray(points)

    def surface(self, angle: FloatArray) -> ComplexArray:
        """Cam surface at cam angles [rad], in the cam's frame [m]."""
        at = self.programme.at(angle)
        return np.asarray(
            profile.profile_point(angle, at.s, at.ds, self.prime_radius, self.offset, roller_radius=self.roller_radius)
        )

    def pressure_angle(self, angle: FloatArray) -> FloatArray:
        """Pressure angle [rad] at cam angles [rad]."""
        at = self.programme.at(angle)
        return np.asarray(profile.pressure_angle(at.s, at.ds, self.prime_radius, self.offset))

    def curvature(self, angle: FloatArray) -> FloatArray:
        """Curvature of the pitch curve [1/m] at cam angles [rad], positive where convex."""
        at = self.programme.at(angle)
        return np.asarray(profile.curvature(at.s, at.ds, at.dds, self.prime_radius, self.offset))


def pressure_angle_max(cam: PlateCam) -> Extremum:
    """Largest |pressure angle| [rad] over the turn."""
    return supremum(lambda angle: np.abs(cam.pressure_angle(angle)), cam.programme.knots)


def convex_radius_min(cam: PlateCam) -> Extremum:
    """Least radius of curvature [m] of the pitch curve where it is convex; a roller must be smaller."""
    sharpest = supremum(cam.curvature, cam.programme.knots)
    return Extremum(sharpest.at, 1 / sharpest.value)


def concave_radius_min(cam: PlateCam) -> Extremum | None:
    """Least radius of curvature [m] of the pitch curve where it is concave; None where it is convex all round."""
    hollow = infimum(cam.curvature, cam.programme.knots)
    return Extremum(hollow.at, -1 / hollow.value) if hollow.value < 0 else None


def undercut(cam: PlateCam) -> bool:
    """Whether the roller is too large for the pitch curve, so that no surface can guide it: rho <= roller radius."""
    return convex_radius_min(cam).value <= cam.roller_radius


def area(cam: PlateCam) -> float:
    """Area [m^2] inside the cam's surface, without undercut.

    The surface is parallel to the pitch curve: A = A_pitch - R (length of the pitch curve) + pi R^2 (Steiner).
    """

    def pitch_area_and_strip(angle: FloatArray) -> FloatArray:
        at = cam.programme.at(angle)
        r = profile.reach(at.s, cam.prime_radius, cam.offset)
        strip = cam.roller_radius * np.hypot(r, at.ds - cam.offset)
        return np.asarray(0.5 * (r**2 + cam.offset**2) - strip)

    return integral(pitch_area_and_strip, cam.programme.knots) + math.pi * cam.roller_radius**2


def smallest_prime_radius(programme: Programme, pressure_angle_limit: float, offset: float = 0.0) -> Extremum:
    """Smallest prime radius [m] that keeps |mu| within the limit [rad] all round, and the cam angle that asks for it.

        Rp = sqrt(d^2 + e^2),   d = sup(|s' - e| / tan(limit) - s)

    For a harmonic rise of L over beta with e = 0: Rp = -L/2 + sqrt((pi L / (2 beta tan limit))^2 + (L/2)^2).
    Raises ParameterError for a limit that is not between 0 and 90 degrees.
    """
    if not 0 < pressure_angle_limit < math.pi / 2:
        shown = format_quantity(pressure_angle_limit, "deg")
        raise ParameterError(f"pressure_angle_limit={shown}", allowed="allowed: above 0 deg, below 90 deg")
    slope = math.tan(pressure_angle_limit)

    def demand(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        return np.asarray(np.abs(at.ds - offset) / slope - at.s)

    worst = supremum(demand, programme.knots)
    return Extremum(worst.at, math.hypot(max(worst.value, 0.0), offset))
