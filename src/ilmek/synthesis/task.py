"""Task of a four-bar: precision positions, given by points and angles."""

import math

import numpy as np

from ilmek.arrays import FloatArray, NumberArray
from ilmek.errors import ParameterError
from ilmek.records import record
from ilmek.units import deg

TOLERANCE = 1e-6
"""Default tolerance of a point, relative to the extent of all points, and of an angle [rad]."""

MAX_DIFFERENCE = 2 * math.pi + 1e-9


@record
class PrecisionTask:
    """Precision positions in their required order; a four-bar is drawn at the first one.

    points           positions of the tracer [m], complex, shape (positions,); None where none are required
    coupler, rocker  angles of coupler and rocker [rad], shape (positions,); None where none are required
    crank            angles of the crank [rad], shape (positions,); None where the timing is free
    point_tolerance  error [m] up to which a position counts as met; default: 1e-6 of the extent of the points
    angle_tolerance  error [rad] up to which a position counts as met

    Of angles only the differences from the first one count. Raises ParameterError for a task without points and angles,
    fields of different lengths, values that are not finite, and angles more than a turn apart (probably degrees).

    >>> PrecisionTask(crank=np.radians([0, 30, 60]), rocker=np.radians([0, 20, 30])).count
    3
    """

    points: NumberArray | None = None
    coupler: NumberArray | None = None
    rocker: NumberArray | None = None
    crank: NumberArray | None = None
    point_tolerance: float | None = None
    angle_tolerance: float = TOLERANCE

    def __post_init__(self) -> None:
        if self.points is None and self.coupler is None and self.rocker is None:
            raise ParameterError("the task is empty", do="give points, angles of the coupler or of the rocker")
        if self.points is not None:
            object.__setattr__(self, "points", np.asarray(self.points, dtype=complex))
        for name in ("coupler", "rocker", "crank"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, np.asarray(getattr(self, name), dtype=float))
                require_angles(f"{name} angle", getattr(self, name))
        self._check()

    @property
    def count(self) -> int:
        """Number of precision positions."""
        return next(len(one) for one in (self.points, self.coupler, self.rocker) if one is not None)

    @property
    def point_limit(self) -> float:
        """Error of a point up to which it counts as met [m]; infinite where the task has no points."""
        if self.points is None:
            return math.inf
        if self.point_tolerance is not None:
            return self.point_tolerance
        return TOLERANCE * (float(np.max(np.abs(self.points - self.points[0]))) or 1.0)

    @property
    def crank_turns(self) -> FloatArray | None:
        """Crank angles relative to the first position [rad]; None where the timing is free."""
        return relative_to_first(self.crank)

    @property
    def coupler_turns(self) -> FloatArray | None:
        """Coupler angles relative to the first position [rad]; None where none are required."""
        return relative_to_first(self.coupler)

    @property
    def rocker_turns(self) -> FloatArray | None:
        """Rocker angles relative to the first position [rad]; None where none are required."""
        return relative_to_first(self.rocker)

    def _check(self) -> None:
        given = {name: getattr(self, name) for name in ("points", "coupler", "rocker", "crank")}
        sizes = {name: np.shape(one) for name, one in given.items() if one is not None}
        if len(set(sizes.values())) > 1 or any(len(shape) != 1 or shape[0] < 1 for shape in sizes.values()):
            shapes = ", ".join(f"{name} {shape}" for name, shape in sizes.items())
            raise ParameterError(
                f"the task's positions are of shapes {shapes}", allowed="one list for each, of one length"
            )
        if self.points is not None and not np.isfinite(self.points).all():
            raise ParameterError("a point of the task is not finite", do="give finite positions [m]")
        for name in ("point_tolerance", "angle_tolerance"):
            value = getattr(self, name)
            if value is not None and not value > 0:
                raise ParameterError(f"{name} of the task is {value:g}", allowed="above 0")


def relative_to_first(angles: NumberArray | None) -> FloatArray | None:
    """Angles minus the first one [rad]; None for None."""
    return None if angles is None else np.asarray(angles - angles[0])


def require_angles(name: str, angles: NumberArray) -> None:
    """Raise ParameterError unless all angles [rad] are finite and their range is at most one turn.

    name  of the angles, for the message      angles  any shape; a greater range suggests degrees
    """
    angles = np.asarray(angles, dtype=float)
    if not np.isfinite(angles).all():
        raise ParameterError(f"a {name} of the task is not finite", do="give finite angles [rad]")
    if angles.size and np.ptp(angles) > MAX_DIFFERENCE:
        most = float(angles.ravel()[np.argmax(np.abs(angles))])
        raise ParameterError(
            f"{name}s of the task lie {np.ptp(angles):g} rad apart",
            allowed="at most a turn, 6.283 rad",
            do=f"angles are in radians: {most:g} deg would be {most * deg:.6g}",
        )
