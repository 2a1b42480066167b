"""What may be asked of a four-bar for a function."""

import dataclasses
from dataclasses import dataclass

import numpy as np

from ilmek.errors import ParameterError
from ilmek.machines.four_bars import filter_params
from ilmek.machines.function_four_bar.functions import named
from ilmek.machines.text_lists import read_pairs
from ilmek.params import Params, param
from ilmek.synthesis.freudenstein import POINTS
from ilmek.synthesis.function import Function, function_of_samples
from ilmek.units import deg, mm, turn

CRITERIA = {"interpolation": "interpolation", "least-squares": "least squares", "minimax": "minimax"}
"""Criteria by their names here, and in `function_approximations`."""

SEEN = 181
"""Places at which a function is looked at before it is taken."""

FROM, TO = 1.0, 2.0
"""The range of x of a function that is named, where none is said."""


@dataclass(frozen=True, slots=True)
class FunctionFourBarParams(Params):
    """What may be asked of a four-bar for a function."""

    function: str = param("log10", doc="log10, ln, log2, exp, sqrt, 1/x, sin, cos, tan, sinh, tanh or a power: x^1.5")
    samples: str | None = param(None, doc="pairs of x and y in place of a named function: (1,0) (2,0.301) …")
    start: float | None = param(None, doc="x where the range begins; unsaid: 1, or the first sample", symbol="x0")
    stop: float | None = param(None, doc="x where the range ends; unsaid: 2, or the last sample", symbol="x1")
    crank_swing: float = param(
        60 * deg, unit="deg", at_least=-turn, at_most=turn, doc="turn of the crank over the range; below 0: clockwise"
    )
    rocker_swing: float = param(
        -60 * deg, unit="deg", at_least=-turn, at_most=turn, doc="turn of the rocker over the range; below 0: clockwise"
    )
    criterion: str = param(
        "interpolation",
        choices=tuple(CRITERIA),
        doc="exact at Chebyshev's places, least mean square error, or least greatest error",
    )
    points: int | None = param(
        None, at_least=1, at_most=100, doc="places of interpolation: 5, 4 with one start angle, 3 with both"
    )
    crank_start: float | None = param(
        None,
        unit="deg",
        at_least=-turn,
        at_most=turn,
        doc="direction of the crank at the start, from the ground link, or its opposite",
    )
    rocker_start: float | None = param(
        None, unit="deg", at_least=-turn, at_most=turn, doc="direction of the rocker at the start, or its opposite"
    )
    ground: float = param(100 * mm, unit="mm", at_least=0.1 * mm, at_most=10.0, doc="distance of the pivots")
    error_max: float | None = param(None, unit="deg", above=0.0, at_most=turn, doc="greatest error of the rocker")
    one_circuit: bool = filter_params.one_circuit()
    one_branch: bool = filter_params.one_branch()
    in_order: bool = filter_params.in_order()
    full_turn: bool = filter_params.full_turn()
    transmission_min: float = filter_params.transmission_min()
    link_ratio_max: float | None = filter_params.link_ratio_max(10.0)
    size_max: float | None = filter_params.size_max()
    count: int = filter_params.count()
    chosen: int = filter_params.chosen()

    def check_together(self) -> None:
        """The function can be had, and as many places as start angles leave."""
        _check_course(self.wanted())
        if self.points is None:
            return
        if self.criterion != "interpolation":
            raise ParameterError(
                f"points={self.points} with criterion={self.criterion}",
                allowed="places are chosen for interpolation alone",
                do="leave points out",
            )
        if self.points not in POINTS:
            more = "criterion=least-squares or minimax fits all over the range" if self.points > max(POINTS) else ""
            allowed = ", ".join(f"{count} with {what}" for count, what in POINTS.items())
            raise ParameterError(f"points={self.points}", allowed=allowed, do=more)
        starts = sum(start is not None for start in (self.crank_start, self.rocker_start))
        if self.points != 5 - starts:
            given = f"points={self.points} and {starts} start angle{'' if starts == 1 else 's'}"
            do = (
                "set crank_start or rocker_start" if self.points + starts < 5 else f"leave points out: {5 - starts} fit"
            )
            raise ParameterError(given, allowed=f"{self.points} points go with {POINTS[self.points]}", do=do)

    def wanted(self) -> Function:
        """The function. Raises ParameterError where there is none."""
        swings = self.crank_swing, self.rocker_swing
        if self.samples is None:
            start = FROM if self.start is None else self.start
            return Function(named(self.function), start, TO if self.stop is None else self.stop, *swings)
        pairs = read_pairs("samples", self.samples)
        through = function_of_samples(pairs[:, 0].copy(), pairs[:, 1].copy(), *swings)
        return dataclasses.replace(through, start=self._within("start", through), stop=self._within("stop", through))

    def _within(self, name: str, through: Function) -> float:
        """An end of the range, within the samples."""
        asked = getattr(self, name)
        if asked is None:
            return float(getattr(through, name))
        if not through.start <= asked <= through.stop:
            raise ParameterError(
                f"{name}={asked:g} is outside of the samples",
                allowed=f"{through.start:g} to {through.stop:g}",
                do="give more samples: beyond them nothing is known",
            )
        return float(asked)


def _check_course(function: Function) -> None:
    """Raise ParameterError where the rocker would have to turn more than once between the ends of the range."""
    x = np.linspace(function.start, function.stop, SEEN)
    turned = function.rocker(x)
    if np.isfinite(turned).all() and np.ptp(turned) > turn:
        at = int(np.argmax(np.abs(turned)))
        raise ParameterError(
            f"between its ends the function goes to {float(function.f(x[at : at + 1])[0]):.4g}, at x = {x[at]:.4g}",
            allowed="the rocker turns by less than once",
            do="choose a range without this place, or less swing",
        )
