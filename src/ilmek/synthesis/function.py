"""Function generation: y = f(x), with x as rotation of the crank and y as rotation of the rocker.

    crank = crank_swing (x - x0) / (x1 - x0)        rocker = rocker_swing (f(x) - y0) / (y1 - y0)

x0 and x1 are the ends of the range of x, y0 and y1 the values of f there; both rotations start at 0.
[Hartenberg and Denavit, Kinematic Synthesis of Linkages; four-bars by Freudenstein's equation: `freudenstein`]
"""

import math
from collections.abc import Callable

import numpy as np
import scipy

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.records import record, shown_value
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.task import PrecisionTask
from ilmek.units import deg


@record
class Function:
    """A function over a range, and the rotations of crank and rocker that represent it.

    f             y = f(x), takes and returns arrays; y0 = f(start), y1 = f(stop)
    start, stop   range of x
    crank_swing   rotation of the crank over the range of x [rad], with sign
    rocker_swing  rotation of the rocker from y0 to y1 [rad], with sign

    Raises ParameterError for an empty range of x or y, values that are not finite, and swings of 0 or of more than a
    turn.

    >>> root = Function(np.sqrt, 1.0, 9.0, 80 * deg, 60 * deg)
    >>> np.degrees(root.rocker(np.array([1.0, 4.0, 9.0]))).round(6)
    array([ 0., 30., 60.])
    """

    f: Callable[[FloatArray], FloatArray]
    start: float
    stop: float
    crank_swing: float
    rocker_swing: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.start) and math.isfinite(self.stop) and self.start != self.stop):
            raise ParameterError(f"x from {self.start:g} to {self.stop:g}", allowed="two finite ends that differ")
        for name in ("crank_swing", "rocker_swing"):
            swing = getattr(self, name)
            if not 0 < abs(swing) <= 2 * math.pi:
                guess = f"{swing:g} deg is {swing * deg:.6g} rad" if 2 * math.pi < abs(swing) <= 360 else ""
                raise ParameterError(f"{name} {swing:g} rad", allowed="not 0, at most a turn, 6.283 rad", do=guess)
        first, last = self.range
        if not (math.isfinite(first) and math.isfinite(last) and first != last):
            given = f"y is {first:g} at x = {self.start:g} and {last:g} at x = {self.stop:g}"
            raise ParameterError(given, allowed="two finite values that differ", do="choose another range of x")

    @property
    def range(self) -> tuple[float, float]:
        """The values y0, y1 at both ends of x."""
        ends = np.array([self.start, self.stop])
        values = np.asarray(self.f(ends))
        if values.shape != ends.shape or values.dtype.kind not in "iuf":
            given = f"the function of an array of 2 numbers is {shown_value(values)}"
            raise ParameterError(given, allowed="an array of as many real numbers", do="write it with numpy")
        return float(values[0]), float(values[1])

    def crank(self, x: FloatArray) -> FloatArray:
        """Rotation of the crank from `start` to x [rad]."""
        return np.asarray(self.crank_swing * (x - self.start) / (self.stop - self.start))

    def rocker(self, x: FloatArray) -> FloatArray:
        """Rotation of the rocker from `start` to x [rad]."""
        first, last = self.range
        return np.asarray(self.rocker_swing * (self.f(x) - first) / (last - first))

    def task(self, x: FloatArray) -> PrecisionTask:
        """The precision positions at values x; raises ParameterError where f is not finite."""
        if not np.isfinite(self.f(x)).all():
            bad = float(np.asarray(x)[~np.isfinite(self.f(x))][0])
            raise ParameterError(f"the function is not finite at x = {bad:g}", do="choose another range of x")
        return PrecisionTask(crank=self.crank(x), rocker=self.rocker(x))

    def nodes(self, count: int) -> Float[np.ndarray, " count"]:
        """Chebyshev spacing of `count` precision points in x [Hartenberg and Denavit, Kinematic Synthesis of Linkages].

            x_i = (x0 + x1) / 2 - (x1 - x0) / 2 cos((2 i - 1) pi / (2 n))

        >>> Function(lambda x: x, 0.0, 2.0, 1.0, 1.0).nodes(3).round(6)
        array([0.133975, 1.      , 1.866025])
        """
        middle, half = 0.5 * (self.start + self.stop), 0.5 * (self.stop - self.start)
        return np.asarray(middle - half * np.cos((2 * np.arange(count) + 1) * np.pi / (2 * count)))


def function_of_samples(x: FloatArray, y: FloatArray, crank_swing: float, rocker_swing: float) -> Function:
    """The function through samples, by monotone cubic interpolation, without overshoot between them.

    x, y                       samples, x ascending, shape (samples,)
    crank_swing, rocker_swing  rotations over the ranges of x and y [rad]

    Raises ParameterError for fewer than two samples, x that is not ascending, and values that are not finite.
    [Fritsch and Butland, A method for constructing local monotone piecewise cubic interpolants, 1984.]
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if x.shape != y.shape or x.ndim != 1 or len(x) < 2:
        raise ParameterError(f"samples of shapes {x.shape} and {y.shape}", allowed="two or more pairs of x and y")
    if not (np.isfinite(x).all() and np.isfinite(y).all()) or not (np.diff(x) > 0).all():
        raise ParameterError("samples are not in order", allowed="finite values, x rising from sample to sample")
    return Function(scipy.interpolate.PchipInterpolator(x, y), float(x[0]), float(x[-1]), crank_swing, rocker_swing)


@record
class ErrorCurve:
    """Structural error of a four-bar over the range of a function.

    x                    samples of x
    required, generated  rotations of the rocker from the start of the range [rad]; NaN where it does not close
    error, y_error       generated minus required [rad], and in units of y
    """

    x: Float[np.ndarray, " samples"]
    required: Float[np.ndarray, " samples"]
    generated: Float[np.ndarray, " samples"]
    error: Float[np.ndarray, " samples"]
    y_error: Float[np.ndarray, " samples"]

    @property
    def greatest(self) -> float:
        """Greatest error over the range [rad]; NaN where the four-bar does not close over the whole range."""
        return float(np.max(np.abs(self.error)))


def error_curve(four_bar: FourBar, function: Function, drawn_at: float, samples: int = 361) -> ErrorCurve:
    """Structural error [rad] over the range, by forward simulation on the drawn branch; NaN where it does not close.

    drawn_at  value of x at the drawn position, that of the first precision point
    samples   number of samples of x, evenly spaced
    """
    x = np.linspace(function.start, function.stop, samples)
    required, at = function.rocker(x), np.array([drawn_at])
    crank = four_bar.crank_angle + function.crank(x) - function.crank(at)
    shown = four_bar.rocker_angle + required - function.rocker(at)
    motion = solve(plan(four_bar.mechanism()), crank)
    error = np.angle(motion.direction("rocker") * np.exp(-1j * shown))
    first, last = function.range
    return ErrorCurve(x, required, required + error, error, error * (last - first) / function.rocker_swing)
