"""Smallest prime circle of a cam of any kind within limits, and best offset of a translating follower.

Every limit is written as an angle that must not exceed 0, so one search over the turn covers all of them:

    rise, fall        |mu| - limit                                where the follower moves out, moves in
    convex, concave   arctan(Rp kappa) - arctan(Rp / limit)       kappa of the pitch curve; -kappa for concave

Undercut is never allowed, even without a limit of curvature.
[pressure angle and curvature: Norton, Cam Design and Manufacturing, 7; the common search is derived here]
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
"""Number of sizes tried before one is refined."""

_NEAR = 1e-9
"""Relative distance of a size from its bounds, and excess [rad] up to which a limit counts as kept."""


@dataclass(frozen=True, slots=True)
class CamLimits:
    """Limits that a cam must keep; None: no limit.

    rise, fall        largest |pressure angle| [rad] where the follower moves out, and where it returns; a follower
                      with a return spring needs no limit on the return
    convex, concave   least radius of curvature [m] of the pitch curve where it is convex, and where it is concave (for
                      a groove: above the roller's radius); the pitch curve of a flat face is the surface itself

    Raises ParameterError for a pressure angle that is not between 0 and 90 degrees.
    """

    rise: float | None = None
    fall: float | None = None
    convex: float | None = None
    concave: float | None = None

    def __post_init__(self) -> None:
        for limit in (self.rise, self.fall):
            if limit is not None and not 0 < limit < math.pi / 2:
                shown = format_quantity(limit, "deg")
                raise ParameterError(f"a limit of the pressure angle of {shown}", allowed="above 0 deg, below 90 deg")


class PrimeRadius(NamedTuple):
    """A prime radius [m], the limit that determines it, and the cam angle [rad] where that limit is reached."""

    prime_radius: float
    binds: str
    at: float


class Offset(NamedTuple):
    """An offset [m] and the smallest prime radius [m] for it."""

    offset: float
    prime_radius: float


def smallest_prime(cam: CamRole, limits: CamLimits) -> PrimeRadius:
    """The smallest prime circle [m] at which a cam keeps the limits without undercut; all else stays as given.

    The cam's own prime radius does not matter. Sizes are tried from the smallest possible upwards, and the first that
    fits is refined to rounding.
    Raises ParameterError where no size fits.
    """
    sizes = _sizes(cam)
    angle = _grid(cam.knots)
    motion = cam.programme.at(angle)

    def fits(size: float) -> bool:
        trial = cam.resized(size)
        return bool(np.max(_excess(trial, trial.trace_of(angle, motion), limits)) <= 0)

    first = next((number for number, size in enumerate(sizes) if fits(float(size))), None)
    if first is None:
        low, high = (format_quantity(float(size), "mm") for size in sizes[[0, -1]])
        raise ParameterError(
            f"no prime radius from {low} to {high} keeps {_described(limits)}",
            allowed="limits that one size of the cam can keep",
            do="relax a limit, give the motion a larger cam angle, or change offset, arm or pivot",
        )
    if first == 0:
        return PrimeRadius(float(sizes[0]), "the follower's own size", float(cam.knots[0]))
    found = _refined(cam, limits, float(sizes[first - 1]), float(sizes[min(first + 1, sizes.size - 1)]))
    worst = _worst(cam.resized(found), limits)
    return PrimeRadius(found, _binding(cam.resized(found), limits, worst.at), worst.at)


def require(cam: CamRole, limits: CamLimits) -> None:
    """Raise ParameterError, naming the smallest prime radius that fits, where a cam breaks a limit or is undercut."""
    worst = _worst(cam, limits)
    if worst.value <= _NEAR:
        return
    shown, where = format_quantity(cam.prime_radius, "mm"), format_quantity(worst.at, "deg")
    found = smallest_prime(cam, limits)
    raise ParameterError(
        f"prime_radius={shown} is too small for {_binding(cam, limits, worst.at)}, at {where}",
        allowed=f"at least {_upwards(found.prime_radius)} (for {found.binds})",
        do="use that radius, or relax the limit",
    )


def pressure_prime(programme: CamProgramme, limits: CamLimits, offset: float = 0.0) -> Extremum:
    """Smallest prime radius [m] of a translating roller for the limits of the pressure angle, and the cam angle [rad].

        Rp = sqrt(d^2 + e^2),   d = sup(|s' - e| / tan(limit) - s), with the limit of the rise or of the return

    offset  e [m]

    For a harmonic rise of L over beta with e = 0: Rp = -L/2 + sqrt((pi L / (2 beta tan limit))^2 + (L/2)^2).
    """
    slope = {1: _slope(limits.rise), -1: _slope(limits.fall)}

    def demand(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        allowed = np.where(at.ds > 0, slope[1], np.where(at.ds < 0, slope[-1], np.inf))
        return np.asarray(np.abs(at.ds - offset) / allowed - at.s)

    worst = supremum(demand, programme.knots)
    return Extremum(worst.at, math.hypot(max(worst.value, 0.0), offset))


def best_offset(programme: CamProgramme, limits: CamLimits) -> Offset:
    """The offset [m] of a translating roller with the smallest prime circle for the limits of the pressure angle.

    d(e) is a supremum of straight lines, so it is convex and d^2 + e^2 has one minimum. It lies within |e| <= max |s'|.
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


def _limit_angles(cam: CamRole, limits: CamLimits) -> dict[str, tuple[float, Callable[[CamTrace], FloatArray]]]:
    """Each limit by name: the allowed angle [rad], and the function of a trace that it bounds."""
    size = cam.prime_radius
    convex = max(limits.convex or 0.0, cam.roller_radius)
    concave = math.inf if cam.flat else limits.concave
    named: dict[str, tuple[float | None, Callable[[CamTrace], FloatArray]]] = {
        "the pressure angle on the rise": (limits.rise, lambda trace: _leaning(trace, trace.motion.ds > 0)),
        "the pressure angle on the return": (limits.fall, lambda trace: _leaning(trace, trace.motion.ds < 0)),
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
    """Largest excess [rad] over the limits, at every point of a trace."""
    passed = [value(trace) - limit for limit, value in _limit_angles(cam, limits).values()]
    return np.asarray(np.max(passed, axis=0))


def _worst(cam: CamRole, limits: CamLimits) -> Extremum:
    return supremum(lambda angle: _excess(cam, cam.trace(angle), limits), cam.knots)


def _binding(cam: CamRole, limits: CamLimits, at: float) -> str:
    """Name of the limit with the largest excess just before or just after a cam angle."""
    trace = cam.trace(at + np.array([-1e-9, 1e-9]))
    angles = _limit_angles(cam, limits)
    return max(angles, key=lambda name: float(np.max(angles[name][1](trace)) - angles[name][0]))


def _refined(cam: CamRole, limits: CamLimits, low: float, high: float) -> float:
    """The size between one that does not fit and one that fits at which the worst limit is just kept."""

    def excess(size: FloatArray) -> FloatArray:
        return np.array([_worst(cam.resized(float(value)), limits).value for value in size])

    found = float(bracketed_roots(excess, np.array([low]), np.array([high]), steps=60)[0])
    return found if math.isfinite(found) else high


def _sizes(cam: CamRole) -> FloatArray:
    """Sizes to try, ascending, within the cam's bounds; without an upper bound up to 1000 times the motion."""
    low, high = cam.prime_bounds
    if math.isfinite(high):
        return low + (high - low) * np.linspace(_NEAR, 1 - _NEAR, _SIZES)
    at = cam.programme.at(_grid(cam.knots))
    scale = float(np.max(np.abs(at.s)) + np.max(np.abs(at.ds)) + np.max(np.abs(at.dds))) or 1.0
    return np.concatenate([[low + _NEAR * (low + scale)], low + scale * np.geomspace(1e-4, 1e3, _SIZES)])


def _grid(knots: FloatArray) -> FloatArray:
    """Cam angles within the pieces between knots, clear of their ends by rounding."""
    share = np.clip(np.linspace(0.0, 1.0, 65), 1e-12, 1 - 1e-12)
    return np.asarray((knots[:-1, None] + np.diff(knots)[:, None] * share).ravel())


def _upwards(radius: float) -> str:
    """A radius rounded up for display."""
    digits = 10.0 ** (4 - math.floor(math.log10(radius)))
    return format_quantity(math.ceil(radius * digits) / digits, "mm", 6)


def _described(limits: CamLimits) -> str:
    named = [
        f"{name} {format_quantity(limit, unit)}"
        for name, limit, unit in (
            ("a pressure angle on the rise of", limits.rise, "deg"),
            ("one on the return of", limits.fall, "deg"),
            ("a convex radius of", limits.convex, "mm"),
            ("a concave radius of", limits.concave, "mm"),
        )
        if limit is not None
    ]
    return ", ".join(named) or "a surface that guides the follower"
