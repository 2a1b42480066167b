"""Parameters of a four-bar for a function."""

import dataclasses
import difflib
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.params import kind
from ilmek.params.text_lists import read_pairs
from ilmek.synthesis.freudenstein import POINTS
from ilmek.synthesis.function import Function, function_of_samples
from ilmek.synthesis.selection import FourBarTaskParams
from ilmek.units import deg, mm, turn

F: TypeAlias = Callable[[FloatArray], FloatArray]

NAMED: dict[str, F] = {
    "log10": np.log10,
    "ln": np.log,
    "log2": np.log2,
    "exp": np.exp,
    "sqrt": np.sqrt,
    "1/x": np.reciprocal,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "sinh": np.sinh,
    "tanh": np.tanh,
}
"""Functions of a plain number x; those of angles take it in radians."""

_POWER = re.compile(
    r"x\s*+(?:\^|\*\*)\s*+\(?\s*+([+-]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++))(?:\s*/\s*+([0-9]++\.?[0-9]*+))?\s*+\)?"
)
ALLOWED = f"{', '.join(NAMED)}, or a power like x^1.5"

CRITERIA = {"interpolation": "interpolation", "least-squares": "least squares", "minimax": "minimax"}
"""Criteria by their names here, and in `function_approximations`."""

SEEN = 181
"""Points at which a function is evaluated before it is accepted."""

FROM, TO = 1.0, 2.0
"""The default range of x of a named function."""


@dataclass(frozen=True, slots=True)
class FunctionFourBarParams(FourBarTaskParams):
    """Task of a four-bar for a function."""

    function: str = kind.text(
        "log10", doc="log10, ln, log2, exp, sqrt, 1/x, sin, cos, tan, sinh, tanh or a power: x^1.5"
    )
    samples: str | None = kind.text(None, doc="pairs of x and y instead of a named function: (1,0) (2,0.301) …")
    start: float | None = kind.ratio(
        None, doc="x at the start of the range; default: 1, or the first sample", symbol="x0"
    )
    stop: float | None = kind.ratio(None, doc="x at the end of the range; default: 2, or the last sample", symbol="x1")
    crank_swing: float = kind.angle(
        60 * deg, at_least=-turn, at_most=turn, doc="rotation of the crank over the range; below 0: clockwise"
    )
    rocker_swing: float = kind.angle(
        -60 * deg, at_least=-turn, at_most=turn, doc="rotation of the rocker over the range; below 0: clockwise"
    )
    criterion: str = kind.choice(
        "interpolation",
        tuple(CRITERIA),
        doc="exact at Chebyshev's points, least mean square error, or least greatest error",
    )
    points: int | None = kind.count(
        None, at_least=1, at_most=100, doc="points of interpolation: 5, 4 with one start angle, 3 with both"
    )
    crank_start: float | None = kind.angle(
        None,
        at_least=-turn,
        at_most=turn,
        doc="direction of the crank at the start, from the ground link, or its opposite; default: free",
    )
    rocker_start: float | None = kind.angle(
        None, at_least=-turn, at_most=turn, doc="direction of the rocker at the start, or its opposite; default: free"
    )
    ground: float = kind.length(100 * mm, at_least=0.1 * mm, at_most=10.0, doc="distance of the pivots")
    error_max: float | None = kind.angle(None, above=0.0, at_most=turn, doc="greatest error of the rocker")

    @property
    def free_points(self) -> int:
        """Points at which a four-bar can be exact: five, less one for each start angle that is given."""
        return 3 + sum(start is None for start in (self.crank_start, self.rocker_start))

    def check_together(self) -> None:
        """Raise ParameterError where the function cannot be generated, or its start angles leave other points."""
        _check_turn(self.required_function())
        if self.points is None:
            return
        if self.criterion != "interpolation":
            raise ParameterError(
                f"points={self.points} with criterion={self.criterion}",
                allowed="points are chosen for interpolation alone",
                do="leave points out",
            )
        if self.points not in POINTS:
            more = "criterion=least-squares or minimax fits all over the range" if self.points > max(POINTS) else ""
            allowed = ", ".join(f"{count} with {what}" for count, what in POINTS.items())
            raise ParameterError(f"points={self.points}", allowed=allowed, do=more)
        if self.points != self.free_points:
            starts = 5 - self.free_points
            given = f"points={self.points} and {starts} start angle{'' if starts == 1 else 's'}"
            fits = f"leave points out: {self.free_points} fit"
            do = "set crank_start or rocker_start" if self.points < self.free_points else fits
            raise ParameterError(given, allowed=f"{self.points} points go with {POINTS[self.points]}", do=do)

    def required_function(self) -> Function:
        """The function, named or through samples. Raises ParameterError where there is none."""
        swings = self.crank_swing, self.rocker_swing
        if self.samples is None:
            start = FROM if self.start is None else self.start
            return Function(named(self.function), start, TO if self.stop is None else self.stop, *swings)
        pairs = read_pairs("samples", self.samples)
        through = function_of_samples(pairs[:, 0].copy(), pairs[:, 1].copy(), *swings)
        return dataclasses.replace(through, start=self._within("start", through), stop=self._within("stop", through))

    def _within(self, name: str, through: Function) -> float:
        """An end of the range, within the samples."""
        end = getattr(self, name)
        if end is None:
            return float(getattr(through, name))
        if not through.start <= end <= through.stop:
            given = f"{name}={end:g} is outside of the samples"
            raise ParameterError(given, allowed=f"{through.start:g} to {through.stop:g}", do="give more samples")
        return float(end)


def _check_turn(function: Function) -> None:
    """Raise ParameterError where the rocker would have to turn more than once between the ends of the range."""
    x = np.linspace(function.start, function.stop, SEEN)
    turned = function.rocker(x)
    if np.isfinite(turned).all() and np.ptp(turned) > turn:
        at = int(np.argmax(np.abs(turned)))
        given = f"between its ends the function goes to {float(function.f(x[at : at + 1])[0]):.4g}, at x = {x[at]:.4g}"
        allowed = "the rocker turns by less than once"
        raise ParameterError(given, allowed=allowed, do="choose a range without this x, or less swing")


def named(text: str) -> F:
    """The function of a name. Raises ParameterError for one that is not known, naming the nearest.

    >>> named("x^1.5")(np.array([4.0])).tolist(), named("x^(1/2)")(np.array([9.0])).tolist()
    ([8.0], [3.0])
    """
    name = text.strip().lower().removesuffix("(x)").replace(" ", "")
    power = _POWER.fullmatch(name)
    if name in NAMED:
        return partial(_quietly, NAMED[name])
    if power and float(power[2] or 1):
        return partial(_quietly, partial(_power, float(power[1]) / float(power[2] or 1)))
    near = difflib.get_close_matches({"log": "log10", "lg": "log10", "x": "x^1.5"}.get(name, name), NAMED, n=1)
    hint = f"did you mean {near[0]}?" if near else "for any other give samples"
    raise ParameterError(f"function={text!r} is unknown", allowed=ALLOWED, do=hint)


def _power(exponent: float, x: FloatArray) -> FloatArray:
    return np.asarray(np.power(x, exponent))


def _quietly(f: F, x: FloatArray) -> FloatArray:
    """Values without warnings: outside of its range a function is NaN or infinite."""
    with np.errstate(all="ignore"):
        return np.asarray(f(x))
