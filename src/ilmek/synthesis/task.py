"""What a four-bar is to do: precision positions, said by what is asked of each."""

import math

import numpy as np

from ilmek.arrays import FloatArray, NumberArray
from ilmek.errors import ParameterError
from ilmek.records import record
from ilmek.units import deg

MET = 1e-6
"""Error of a point, of the extent of all points, and of an angle [rad], up to which a position counts as met."""

TURN = 2 * math.pi + 1e-9


@record
class PrecisionTask:
    """Precision positions in the order in which they are to be met; the first is the one in which a four-bar is drawn.

    points   places of the tracer [m], complex
    coupler  angles of the coupler [rad]      rocker  of the rocker [rad]
    crank    of the crank [rad], where the timing is given
    point_tolerance [m], angle_tolerance [rad]  errors up to which a position counts as met; the points' is 1e-6 of
             their extent, if it is not said

    Of angles only the differences from the first count. What is not asked is None; all that is asked has one length.
    Raises ParameterError for a task that asks nothing, fields of different lengths, values that are not finite, and
    angles more than a turn apart (told apart from degrees).

    >>> PrecisionTask(crank=np.radians([0, 30, 60]), rocker=np.radians([0, 20, 30])).count
    3
    """

    points: NumberArray | None = None
    coupler: NumberArray | None = None
    rocker: NumberArray | None = None
    crank: NumberArray | None = None
    point_tolerance: float | None = None
    angle_tolerance: float = MET

    def __post_init__(self) -> None:
        if self.points is None and self.coupler is None and self.rocker is None:
            raise ParameterError("the task asks nothing", do="give points, angles of the coupler or of the rocker")
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
    def near(self) -> float:
        """Error of a point up to which it counts as met [m]; infinite where no points are asked."""
        if self.points is None:
            return math.inf
        if self.point_tolerance is not None:
            return self.point_tolerance
        return MET * (float(np.max(np.abs(self.points - self.points[0]))) or 1.0)

    @property
    def crank_turns(self) -> FloatArray | None:
        """Crank angles since the first position [rad]."""
        return since_first(self.crank)

    @property
    def coupler_turns(self) -> FloatArray | None:
        """Coupler angles since the first position [rad]."""
        return since_first(self.coupler)

    @property
    def rocker_turns(self) -> FloatArray | None:
        """Rocker angles since the first position [rad]."""
        return since_first(self.rocker)

    def _check(self) -> None:
        asked = {name: getattr(self, name) for name in ("points", "coupler", "rocker", "crank")}
        sizes = {name: np.shape(one) for name, one in asked.items() if one is not None}
        if len(set(sizes.values())) > 1 or any(len(shape) != 1 or shape[0] < 1 for shape in sizes.values()):
            said = ", ".join(f"{name} {shape}" for name, shape in sizes.items())
            raise ParameterError(
                f"the task's positions are of shapes {said}", allowed="one list for each, of one length"
            )
        if self.points is not None and not np.isfinite(self.points).all():
            raise ParameterError("a point of the task is not finite", do="give finite places [m]")
        for name in ("point_tolerance", "angle_tolerance"):
            value = getattr(self, name)
            if value is not None and not value > 0:
                raise ParameterError(f"{name} of the task is {value:g}", allowed="above 0")


def since_first(angles: NumberArray | None) -> FloatArray | None:
    """Each angle less the first [rad]; None stays None."""
    return None if angles is None else np.asarray(angles - angles[0])


def require_angles(name: str, angles: NumberArray) -> None:
    """Raise ParameterError unless all angles are finite and within a turn of one another: else they are degrees."""
    angles = np.asarray(angles, dtype=float)
    if not np.isfinite(angles).all():
        raise ParameterError(f"a {name} of the task is not finite", do="give finite angles [rad]")
    if angles.size and np.ptp(angles) > TURN:
        most = float(angles.ravel()[np.argmax(np.abs(angles))])
        raise ParameterError(
            f"{name}s of the task lie {np.ptp(angles):g} rad apart",
            allowed="at most a turn, 6.283 rad",
            do=f"angles are in radians: {most:g} deg would be {most * deg:.6g}",
        )
