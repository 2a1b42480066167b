"""Pressure angle, curvature, undercut and area of a cam of any kind.

Each is searched or integrated piece by piece between the programme's knots, so both sides of a jump of the acceleration
are covered. Formulas of each kind of cam are in its module.  [Norton, Cam Design and Manufacturing, 7]
"""

import math
from collections.abc import Callable
from typing import Literal, TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, FloatArray
from ilmek.cams.trace import CamRole
from ilmek.num.piecewise import Extremum, infimum, integral, supremum

Part: TypeAlias = Literal["turn", "rise", "return"]
"""The whole turn, only the rises, or only the returns."""


def pressure_angle_max(cam: CamRole, part: Part = "turn") -> Extremum:
    """Largest |pressure angle| [rad] over a part of the turn, and its cam angle [rad]; 0 where that part is empty.

    A cam with a return spring drives on the rise only; a groove or a conjugate plate drives on the return too.
    """

    def leaning(angle: FloatArray) -> FloatArray:
        trace = cam.trace(angle)
        return np.where(_within(part, trace.motion.ds), np.abs(trace.pressure_angle), 0.0)

    return supremum(leaning, cam.knots)


def convex_radius_min(cam: CamRole) -> Extremum:
    """Least radius of curvature [m] of the pitch curve where it is convex, and its cam angle [rad].

    A roller must be smaller. The pitch curve of a flat face is the surface itself; a radius not above 0 is undercut.
    Infinite where the curve is nowhere convex.
    """
    sharpest = supremum(_bend(cam), cam.knots)
    return Extremum(sharpest.at, cam.prime_radius / math.tan(sharpest.value) if sharpest.value > 0 else math.inf)


def concave_radius_min(cam: CamRole) -> Extremum | None:
    """Least radius of curvature [m] of the pitch curve where it is concave, and its cam angle [rad]; None: convex.

    For the outer flank of a groove it must be larger than the roller's radius.
    """
    hollow = infimum(_bend(cam), cam.knots)
    return Extremum(hollow.at, -cam.prime_radius / math.tan(hollow.value)) if hollow.value < 0 else None


def undercut(cam: CamRole, *, both_flanks: bool = False) -> bool:
    """Whether the surface is undercut: convex rho <= roller radius, or a concave surface under a flat face.

    both_flanks  check the outer flank of the groove too: concave rho <= roller radius
    """
    hollow = concave_radius_min(cam) if both_flanks or cam.flat else None
    hollowed = hollow is not None and (cam.flat or hollow.value <= cam.roller_radius)
    return bool(hollowed or convex_radius_min(cam).value <= cam.roller_radius)


def largest_cutter(cam: CamRole) -> float:
    """Largest radius [m] of a cutter that fits every concave part of the cam's surface; infinite where there is none.

    There rho_surface = rho + Rr.
    """
    hollow = None if cam.flat else concave_radius_min(cam)
    return math.inf if hollow is None else hollow.value + cam.roller_radius


def area(cam: CamRole) -> float:
    """Area [m^2] inside a plate cam's surface, without undercut: A = 1/2 integral of (K . n) flow_K  (Green)."""
    return integral(lambda angle: 0.5 * cam.trace(angle).sector, cam.knots)


def _within(part: Part, ds: FloatArray) -> BoolArray:
    """Whether each speed s' belongs to the part of the turn."""
    if part == "turn":
        return np.full(ds.shape, fill_value=True)
    return np.asarray(ds > 0 if part == "rise" else ds < 0)


def _bend(cam: CamRole) -> Callable[[FloatArray], FloatArray]:
    """The curvature as an angle, arctan(Rp kappa); it exceeds pi/2 where a flat face undercuts the cam."""

    def bend(angle: FloatArray) -> FloatArray:
        trace = cam.trace(angle)
        return np.asarray(np.arctan2(cam.prime_radius * trace.turning, trace.flow))

    return bend
