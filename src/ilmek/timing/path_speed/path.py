"""A path of several axes over one parameter, the axes' limits, and the rates of a motion along it.

With s' = sqrt(b(s)) the rates of an axis q(s) are

    q' s'      q'' b + q' b_s / 2      sqrt(b) (q''' b + 3/2 q'' b_s + 1/2 q' b_ss)              [chain rule]

At rest b is 0 and b_ss infinite. So another parameter u on [0, 1] is used,

    s = s0 + L (10 u³ - 15 u⁴ + 6 u⁵),     w = u'²

whose first two derivatives vanish at both ends. The same formulas hold in u, and any finite w gives rest at the ends.
"""

from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
import scipy

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError

Three: TypeAlias = tuple[FloatArray, FloatArray, FloatArray]


@dataclass(frozen=True, slots=True, eq=False)
class AxesLimits:
    """Largest speed, acceleration and jerk of every axis [SI/s, SI/s^2, SI/s^3]; inf for no limit, but of the jerk.

    Raises ParameterError for a limit that is not above 0, an infinite jerk, and arrays of different lengths.
    """

    speed: Float[np.ndarray, " axes"]
    acceleration: Float[np.ndarray, " axes"]
    jerk: Float[np.ndarray, " axes"]

    def __post_init__(self) -> None:
        if not len(self.speed) == len(self.acceleration) == len(self.jerk) > 0:
            raise ParameterError("limits of different numbers of axes", allowed="speed, acceleration, jerk of each")
        for name in ("speed", "acceleration", "jerk"):
            values = getattr(self, name)
            if not (values > 0).all() or (name == "jerk" and not np.isfinite(values).all()):
                raise ParameterError(f"{name} limits {values.tolist()}", allowed="above 0, the jerk's finite")


@dataclass(frozen=True, slots=True, eq=False)
class JointPath:
    """A path of the axes over a parameter s: quintic between two nodes, with two continuous derivatives.

    s          parameter at the nodes, ascending        positions  of the axes there [m or rad]
    slopes     first derivatives by s                   bends      second derivatives by s
    For a smooth path the error of the third derivative is of the third order of the nodes' distance.

    Raises ParameterError for fewer than two nodes, s not ascending, numbers that are not finite, and axes at rest.
    """

    s: Float[np.ndarray, " nodes"]
    positions: Float[np.ndarray, "nodes axes"]
    slopes: Float[np.ndarray, "nodes axes"]
    bends: Float[np.ndarray, "nodes axes"]
    _curve: "scipy.interpolate.PPoly" = field(init=False, repr=False)

    def __post_init__(self) -> None:
        nodes = np.column_stack([self.s, self.positions, self.slopes, self.bends])
        if len(self.s) < 2 or not (np.diff(self.s) > 0).all() or not np.isfinite(nodes).all():
            raise ParameterError("nodes of a path", allowed="two or more, s ascending, all numbers finite")
        if not (np.ptp(self.positions, axis=0).any() or self.slopes.any()):
            raise ParameterError("a path on which no axis moves", allowed="one that moves", do="omit the path")
        object.__setattr__(self, "_curve", scipy.interpolate.PPoly(self._coefficients(), self.s))

    def _coefficients(self) -> FloatArray:
        """Coefficients of the quintics between the nodes, the highest power first: (6, intervals, axes)."""
        h = np.diff(self.s)[:, None]
        p, v, b = self.positions[:-1], self.slopes[:-1], self.bends[:-1]
        rest = self.positions[1:] - p - v * h - b * h**2 / 2  # beyond the parabola of the left node
        slope = (self.slopes[1:] - v - b * h) * h
        bend = (self.bends[1:] - b) * h**2 / 2
        third, fourth, fifth = (
            10 * rest - 4 * slope + bend,
            -15 * rest + 7 * slope - 2 * bend,
            6 * rest - 3 * slope + bend,
        )
        return np.stack([fifth / h**5, fourth / h**4, third / h**3, b / 2, v, p])

    @property
    def length(self) -> float:
        """Range of the parameter s."""
        return float(self.s[-1] - self.s[0])

    def at(self, s: FloatArray, order: int = 0) -> FloatArray:
        """Positions [m or rad] at s, or their derivatives of an order by s, (*s, axes)."""
        return np.asarray(self._curve(s, nu=order))

    def derivatives(self, u: FloatArray) -> Three:
        """The first three derivatives of the axes by u in [0, 1], (*u, axes) each."""
        g, *slopes = (self.length * one[..., None] for one in rise(u))
        g1, g2, g3 = slopes
        q1, q2, q3 = (self.at(self.s[0] + g[..., 0], order) for order in (1, 2, 3))
        return q1 * g1, q2 * g1**2 + q1 * g2, q3 * g1**3 + 3 * q2 * g1 * g2 + q1 * g3


def rise(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """10 u³ - 15 u⁴ + 6 u⁵ on u in [0, 1], and its first three derivatives."""
    return (
        u**3 * (10 + u * (6 * u - 15)),
        30 * (u * (1 - u)) ** 2,
        60 * u * (1 - u) * (1 - 2 * u),
        60 * (1 + 6 * u * (u - 1)),
    )


def rates(slopes: Three, square: Three) -> Three:
    """Speed, acceleration and jerk by time of a function of a parameter.

    slopes  first three derivatives of the function by the parameter
    square  w, the square of the parameter's speed [1/s²], and its first two derivatives by the parameter
    """
    q1, q2, q3 = slopes
    w, w1, w2 = square
    speed = np.sqrt(w)
    return q1 * speed, q2 * w + q1 * w1 / 2, speed * (q3 * w + 1.5 * q2 * w1 + q1 * w2 / 2)
