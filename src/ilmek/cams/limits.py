"""Limits of a cam of any kind: pressure angle, curvature, undercut, area.

All of them are searched or integrated piece by piece between the programme's knots, so that jumps of the acceleration
are taken at both their sides.
"""

import math
from collections.abc import Callable
from typing import Literal, TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, FloatArray
from ilmek.cams.plate import PlateCam
from ilmek.cams.trace import CamRole
from ilmek.num.piecewise import Extremum, infimum, integral, supremum
from ilmek.plane.vectors import dot

__all__ = [
    "Part",
    "PlateCam",
    "area",
    "concave_radius_min",
    "convex_radius_min",
    "largest_cutter",
    "pressure_angle_max",
    "undercut",
]

Part: TypeAlias = Literal["turn", "rise", "return"]
"""The whole turn, or only where the follower goes out, or only where it comes back."""


def pressure_angle_max(cam: CamRole, part: Part = "turn") -> Extremum:
    """Largest |pressure angle| [rad] over a part of the turn; 0 where the follower never moves so.

    A cam that is closed by a spring pushes on the rise alone; a groove or a second plate pushes on the return too.
    """

    def leaning(angle: FloatArray) -> FloatArray:
        trace = cam.trace(angle)
        return np.where(_within(part, trace.course.ds), np.abs(trace.pressure_angle), 0.0)

    return supremum(leaning, cam.knots)


def convex_radius_min(cam: CamRole) -> Extremum:
    """Least radius of curvature [m] of the pitch curve where it is convex; a roller must be smaller.

    A flat face's pitch curve is the surface; its radius is not above 0 where no surface can guide the face.
    Infinite where the curve is nowhere convex.
    """
    sharpest = supremum(_bend(cam), cam.knots)
    return Extremum(sharpest.at, cam.prime_radius / math.tan(sharpest.value) if sharpest.value > 0 else math.inf)


def concave_radius_min(cam: CamRole) -> Extremum | None:
    """Least radius of curvature [m] of the pitch curve where it is concave; None where it is convex all round.

    The outer flank of a groove needs it above the roller's radius.
    """
    hollow = infimum(_bend(cam), cam.knots)
    return Extremum(hollow.at, -cam.prime_radius / math.tan(hollow.value)) if hollow.value < 0 else None


def undercut(cam: CamRole, *, both_flanks: bool = False) -> bool:
    """Whether no surface can guide the follower somewhere: convex rho <= roller radius, or a flat face on a hollow.

    both_flanks  a groove's outer flank too: concave rho <= roller radius
    """
    hollow = concave_radius_min(cam) if both_flanks or cam.flat else None
    hollowed = hollow is not None and (cam.flat or hollow.value <= cam.roller_radius)
    return bool(hollowed or convex_radius_min(cam).value <= cam.roller_radius)


def largest_cutter(cam: CamRole) -> float:
    """The largest radius [m] of a cutter that gets into every hollow of the cam's surface; infinite where none is.

    Where the pitch curve's centre of curvature lies outside, the surface's is the same: rho_surface = rho + Rr.
    """
    hollow = None if cam.flat else concave_radius_min(cam)
    return math.inf if hollow is None else hollow.value + cam.roller_radius


def area(cam: CamRole) -> float:
    """Area [m^2] inside a plate cam's surface, without undercut: A = 1/2 integral of (K . n) flow_K  (Green)."""

    def sector(angle: FloatArray) -> FloatArray:
        trace = cam.trace(angle)
        return np.asarray(0.5 * dot(trace.surface, trace.normal) * (trace.flow - trace.roller_radius * trace.turning))

    return integral(sector, cam.knots)


def _within(part: Part, ds: FloatArray) -> BoolArray:
    """Where the follower moves as the part of the turn says."""
    if part == "turn":
        return np.full(ds.shape, fill_value=True)
    return np.asarray(ds > 0 if part == "rise" else ds < 0)


def _bend(cam: CamRole) -> Callable[[FloatArray], FloatArray]:
    """The curvature as an angle, arctan(Rp kappa), which passes pi/2 where a flat face would cut the cam in a cusp."""

    def bend(angle: FloatArray) -> FloatArray:
        trace = cam.trace(angle)
        return np.asarray(np.arctan2(cam.prime_radius * trace.turning, trace.flow))

    return bend
