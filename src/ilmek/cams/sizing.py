"""The smallest prime circle of a cam of any kind within limits, and the best offset of a translating follower.

Every limit is an angle that must not pass 0, so that one search over the turn weighs all of them:

    rise, back        |mu| - limit                                where the follower goes out, comes back
    convex, concave   arctan(Rp kappa) - arctan(Rp / limit)       kappa the pitch curve's, its negative where hollow

The surface must always be able to guide the follower (no undercut), whether a limit says so or not.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, FloatArray
from ilmek.cams.programme import CamProgramme
from ilmek.cams.trace import CamRole, CamTrace
from ilmek.errors import ParameterError
from ilmek.num.brackets import bracketed_minima, bracketed_roots
from ilmek.num.piecewise import Extremum, supremum
from ilmek.units import format_quantity

_SIZES = 64
"""Sizes looked at before one is refined."""

_NEAR = 1e-9
"""Share by which a size stays clear of one that cannot be built, and an angle of a limit counts as kept."""


@dataclass(frozen=True, slots=True)
class CamLimits:
    """What a cam must keep; None: not asked.

    rise, back        largest |pressure angle| [rad] where the follower goes out, and where it comes back; a follower
                      that a spring brings back needs none on the way back
    convex, concave   least radius of curvature [m] of the pitch curve where it is convex, and where it is concave (a
                      groove's outer flank: above the roller's radius); a flat face's pitch curve is the surface

    Raises ParameterError for a pressure angle that is not between 0 and 90 degrees.
    """

    rise: float | None = None
    back: float | None = None
    convex: float | None = None
    concave: float | None = None

    def __post_init__(self) -> None:
        for limit in (self.rise, self.back):
            if limit is not None and not 0 < limit < math.pi / 2:
                shown = format_quantity(limit, "deg")
                raise ParameterError(f"a limit of the pressure angle of {shown}", allowed="above 0 deg, below 90 deg")


class PrimeRadius(NamedTuple):
    """A prime radius [m], the limit that asks for it, and the cam angle [rad] where it does."""

    prime_radius: float
    binds: str
    at: float


class Offset(NamedTuple):
    """An offset [m] and the smallest prime radius [m] that it allows."""

    offset: float
    prime_radius: float


def smallest_prime(cam: CamRole, limits: CamLimits) -> PrimeRadius:
    """The smallest prime circle at which a cam keeps the limits and can guide its follower; the rest stays as it is.

    The cam's own prime radius does not matter. Sizes from the least that can be built are looked at until one will do,
    which is then refined to rounding. Raises ParameterError where none will.
    """
    sizes = _sizes(cam)
    angle = _grid(cam.knots)
    course = cam.programme.at(angle)

    def fits(size: float) -> bool:
        trial = cam.resized(size)
        return bool(np.max(_excess(trial, trial.trace_of(angle, course), limits)) <= 0)

    first = next((place for place, size in enumerate(sizes) if fits(float(size))), None)
    if first is None:
        low, high = (format_quantity(float(size), "mm") for size in sizes[[0, -1]])
        raise ParameterError(
            f"no prime radius from {low} to {high} keeps {_said(limits)}",
            allowed="limits that one size of the cam keeps together",
            do="allow more, give the motion a larger angle, or change offset, arm or pivot",
        )
    if first == 0:
        return PrimeRadius(float(sizes[0]), "the follower's own size", float(cam.knots[0]))
    found = _refined(cam, limits, float(sizes[first - 1]), float(sizes[min(first + 1, sizes.size - 1)]))
    worst = _worst(cam.resized(found), limits)
    return PrimeRadius(found, _binding(cam.resized(found), limits, worst.at), worst.at)


def require(cam: CamRole, limits: CamLimits) -> None:
    """Raise ParameterError, naming the smallest that does, unless a cam keeps the limits and can guide its follower."""
    worst = _worst(cam, limits)
    if worst.value <= _NEAR:
        return
    shown, place = format_quantity(cam.prime_radius, "mm"), format_quantity(worst.at, "deg")
    found = smallest_prime(cam, limits)
    raise ParameterError(
        f"prime_radius={shown} is too small for {_binding(cam, limits, worst.at)}, at {place}",
        allowed=f"at least {_upwards(found.prime_radius)} (for {found.binds})",
        do="take that, or allow more",
    )


def pressure_prime(programme: CamProgramme, limits: CamLimits, offset: float = 0.0) -> Extremum:
    """Smallest prime radius [m] of a translating roller for the limits of the pressure angle alone, and where.

        Rp = sqrt(d^2 + e^2),   d = sup(|s' - e| / tan(limit) - s), with the limit of the rise or of the return

    For a harmonic rise of L over beta with e = 0: Rp = -L/2 + sqrt((pi L / (2 beta tan limit))^2 + (L/2)^2).
    """
    slope = {1: _slope(limits.rise), -1: _slope(limits.back)}

    def demand(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        asked = np.where(at.ds > 0, slope[1], np.where(at.ds < 0, slope[-1], np.inf))
        return np.asarray(np.abs(at.ds - offset) / asked - at.s)

    worst = supremum(demand, programme.knots)
    return Extremum(worst.at, math.hypot(max(worst.value, 0.0), offset))


def best_offset(programme: CamProgramme, limits: CamLimits) -> Offset:
    """The offset of a translating roller at which the pressure angle allows the smallest prime circle, and that one.

    d(e) is a bound of straight lines and so convex, d^2 + e^2 has one least value. No better offset is larger than the
    largest speed s'.
    """
    most = supremum(lambda angle: np.abs(programme.at(angle).ds), programme.knots).value
    at, least = bracketed_minima(
        lambda offset: np.array([pressure_prime(programme, limits, float(e)).value for e in offset]),
        np.array([-most]),
        np.array([most]),
        steps=45,
    )
    return Offset(float(at[0]), float(least[0]))


def _slope(limit: float | None) -> float:
    return math.inf if limit is None else math.tan(limit)


def _asked(cam: CamRole, limits: CamLimits) -> dict[str, tuple[float, Callable[[CamTrace], FloatArray]]]:
    """Each limit by name: the angle [rad] allowed, and the one there is at every place of a trace."""
    size = cam.prime_radius
    convex = max(limits.convex or 0.0, cam.roller_radius)
    concave = math.inf if cam.flat else limits.concave
    named: dict[str, tuple[float | None, Callable[[CamTrace], FloatArray]]] = {
        "the pressure angle on the rise": (limits.rise, lambda trace: _leaning(trace, trace.course.ds > 0)),
        "the pressure angle on the way back": (limits.back, lambda trace: _leaning(trace, trace.course.ds < 0)),
        "the convex radius of curvature": (math.atan2(size, convex), lambda trace: _bend(trace, size)),
        "the concave radius of curvature": (
            None if concave is None else math.atan2(size, concave),
            lambda trace: -_bend(trace, size),
        ),
    }
    return {name: (limit, value) for name, (limit, value) in named.items() if limit is not None}


def _leaning(trace: CamTrace, moving: BoolArray) -> FloatArray:
    return np.where(moving, np.abs(trace.pressure_angle), 0.0)


def _bend(trace: CamTrace, size: float) -> FloatArray:
    return np.asarray(np.arctan2(size * trace.turning, trace.flow))


def _excess(cam: CamRole, trace: CamTrace, limits: CamLimits) -> FloatArray:
    """By how much [rad] the worst of the limits is passed, at every place of a trace."""
    passed = [value(trace) - limit for limit, value in _asked(cam, limits).values()]
    return np.asarray(np.max(passed, axis=0))


def _worst(cam: CamRole, limits: CamLimits) -> Extremum:
    return supremum(lambda angle: _excess(cam, cam.trace(angle), limits), cam.knots)


def _binding(cam: CamRole, limits: CamLimits, at: float) -> str:
    """Name of the limit that is passed most at a cam angle, just before it or just after it."""
    trace = cam.trace(at + np.array([-1e-9, 1e-9]))
    asked = _asked(cam, limits)
    return max(asked, key=lambda name: float(np.max(asked[name][1](trace)) - asked[name][0]))


def _refined(cam: CamRole, limits: CamLimits, low: float, high: float) -> float:
    """Where between a size that will not do and one that does the worst limit is just kept."""

    def excess(size: FloatArray) -> FloatArray:
        return np.array([_worst(cam.resized(float(value)), limits).value for value in size])

    found = float(bracketed_roots(excess, np.array([low]), np.array([high]), steps=60)[0])
    return found if math.isfinite(found) else high


def _sizes(cam: CamRole) -> FloatArray:
    """Sizes to look at, ascending, within what can be built; of a cam without an upper bound up to 1000 lifts."""
    low, high = cam.prime_bounds
    if math.isfinite(high):
        return low + (high - low) * np.linspace(_NEAR, 1 - _NEAR, _SIZES)
    at = cam.programme.at(_grid(cam.knots))
    scale = float(np.max(np.abs(at.s)) + np.max(np.abs(at.ds)) + np.max(np.abs(at.dds))) or 1.0
    return np.concatenate([[low + _NEAR * (low + scale)], low + scale * np.geomspace(1e-4, 1e3, _SIZES)])


def _grid(knots: FloatArray) -> FloatArray:
    """Cam angles that fill the pieces between knots, a rounding away from their ends."""
    share = np.clip(np.linspace(0.0, 1.0, 65), 1e-12, 1 - 1e-12)
    return np.asarray((knots[:-1, None] + np.diff(knots)[:, None] * share).ravel())


def _upwards(radius: float) -> str:
    """A radius written so that what is read is not smaller."""
    digits = 10.0 ** (4 - math.floor(math.log10(radius)))
    return format_quantity(math.ceil(radius * digits) / digits, "mm", 6)


def _said(limits: CamLimits) -> str:
    said = [
        f"{name} {format_quantity(limit, unit)}"
        for name, limit, unit in (
            ("a pressure angle on the rise of", limits.rise, "deg"),
            ("one on the way back of", limits.back, "deg"),
            ("a convex radius of", limits.convex, "mm"),
            ("a concave radius of", limits.concave, "mm"),
        )
        if limit is not None
    ]
    return ", ".join(said) or "a surface that guides the follower"
