"""Extremes of an output and of its rate: dead centres and toggle positions of any mechanism.

    y' = 0 (extremes of the value)        y'' = 0 (extremes of the rate)        rates by the input

Roots are bracketed by samples and refined to rounding. The roots of y'' are samples for y' too, so that two roots of y'
between neighbouring samples are found. [derived from the exact rates of `outputs` and `sensitivity`]
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Bool, Float
from ilmek.errors import MechanismError
from ilmek.linkage.dimensions import Dimension
from ilmek.linkage.one_input import OneInput
from ilmek.linkage.outputs import Output, OutputHistory, output_history
from ilmek.linkage.sensitivity import derivatives
from ilmek.num.brackets import bracketed_roots
from ilmek.num.piecewise import roots
from ilmek.records import record


@dataclass(frozen=True, slots=True)
class OutputExtreme:
    """A local extreme of an output.

    input     value of the input [rad, m]         value   of the output, or of its rate by the input
    greatest  True for a local maximum, False for a minimum
    """

    input: float
    value: float
    greatest: bool


@record
class ExtremeDerivatives:
    """Derivatives of an extreme's value, and of its input, by each dimension."""

    dimensions: tuple[Dimension, ...]
    value: Float[np.ndarray, " dimensions"]
    input: Float[np.ndarray, " dimensions"]


def extremes(
    moved: OneInput, output: Output, start: float, stop: float, *, samples: int = 720
) -> tuple[OutputExtreme, ...]:
    """Local extremes of an output for inputs between start and stop, in order: the output's dead centres.

    Open samples do not count; see `circuits` for the ends of the input's range.
    Raises MechanismError where start is not below stop.
    start, stop  values of the moving input [rad; m]      samples  number of intervals of the range
    Returns value [of the output] and input [rad; m] of each; empty where there is none.

    >>> from ilmek.linkage.fourbar import slider_crank
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.outputs import Travel
    >>> from ilmek.linkage.structure import plan
    >>> crank = one_input(plan(slider_crank(0.1, 0.3, branch=+1)))
    >>> [(round(one.input, 6), round(one.value, 6)) for one in extremes(crank, Travel("line"), -1, 5)]
    [(0.0, 0.4), (3.141593, 0.2)]
    """
    nodes = _nodes(start, stop, samples)
    nodes = np.unique(np.concatenate([nodes, _roots(moved, output, nodes, _second_rate)]))
    at = _roots(moved, output, nodes, _rate)
    if not len(at):
        return ()
    history = output_history(moved.motion(at), output)
    return tuple(
        OutputExtreme(float(q), float(y), bool(yy < 0))
        for q, y, yy in zip(at, history.value, history.second_rate, strict=True)
    )


@dataclass(frozen=True, slots=True)
class Dwell:
    """An interval of the input [rad, m] with the output within a tolerance of its value at an extreme."""

    start: float
    stop: float
    value: float


def dwells(
    moved: OneInput, output: Output, tolerance: float, start: float, stop: float, *, samples: int = 720
) -> tuple[Dwell, ...]:
    """Dwells of an output for inputs between start and stop, the longest first: about each extreme, with refined ends.

    tolerance  greatest deviation [m or rad] to either side
    Of overlapping dwells about neighbouring extremes the longest is reported. A dwell ends at start, stop or the end of
    the input's range at the latest.
    Raises MechanismError for a tolerance that is not above zero, or a start not below stop.

    >>> from ilmek.linkage.fourbar import slider_crank
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.outputs import Travel
    >>> from ilmek.linkage.structure import plan
    >>> crank = one_input(plan(slider_crank(0.1, 0.3, branch=+1)))
    >>> [round(one.stop - one.start, 4) for one in dwells(crank, Travel("line"), 0.001, -1, 5)]
    [0.3463, 0.2452]
    """
    if not tolerance > 0:
        raise MechanismError(f"dwell within {tolerance}", allowed="a tolerance above 0")
    peaks = extremes(moved, output, start, stop, samples=samples)
    nodes = np.unique(np.concatenate([_nodes(start, stop, samples), [peak.input for peak in peaks]]))
    value = output_history(moved.motion(nodes), output).value
    dwells: list[Dwell] = []
    for peak in peaks:
        at = int(np.searchsorted(nodes, peak.input))
        within = np.abs(value - value[at]) <= tolerance
        after, before = _run(within[at:]), _run(within[at::-1])
        ends = nodes[at - before], nodes[at + after]
        beyond = nodes[max(at - before - 1, 0)], nodes[min(at + after + 1, len(nodes) - 1)]
        low, high = (
            _leaving(moved, output, peak.value, tolerance, end, far) for end, far in zip(ends, beyond, strict=True)
        )
        dwells.append(Dwell(low, high, peak.value))
    dwells.sort(key=lambda one: one.start - one.stop)
    apart: list[Dwell] = []
    for one in dwells:
        if all(one.stop <= other.start or one.start >= other.stop for other in apart):
            apart.append(one)
    return tuple(apart)


def rate_extremes(
    moved: OneInput, output: Output, start: float, stop: float, *, samples: int = 720
) -> tuple[OutputExtreme, ...]:
    """Local extremes of an output's rate by the input, in order; arguments and errors as `extremes`."""
    nodes = _nodes(start, stop, samples)
    at = _roots(moved, output, nodes, _second_rate)
    if not len(at):
        return ()
    history = output_history(moved.motion(at), output)
    step = 0.25 * (stop - start) / samples
    before = output_history(moved.motion(at - step), output).second_rate
    return tuple(
        OutputExtreme(float(q), float(y), bool(yy > 0)) for q, y, yy in zip(at, history.rate, before, strict=True)
    )


def extreme_derivatives(
    moved: OneInput, output: Output, extreme: OutputExtreme, dimensions: Sequence[Dimension]
) -> ExtremeDerivatives:
    """Exact derivatives of a local extreme of an output, of its value and its input, by dimensions p.

    value: dy/dp at the fixed input of the extreme;   input: -(dy'/dp) / y''
    dimensions   shape (dimensions,), the shape of both results; [unit of the output or input by m or rad]
    """
    motion = moved.motion(np.array([extreme.input])).require()
    found = derivatives(motion, output, dimensions)
    curvature = output_history(motion, output).second_rate
    return ExtremeDerivatives(tuple(dimensions), found.value[:, 0], (-found.rate / curvature)[:, 0])


def rate_extreme_derivatives(
    moved: OneInput, output: Output, extreme: OutputExtreme, dimensions: Sequence[Dimension]
) -> Float[np.ndarray, " dimensions"]:
    """Exact derivatives of a local extreme of an output's rate (see `rate_extremes`) by dimensions.

    dimensions   shape (dimensions,), the shape of the result [unit of the rate by m or rad]
    [derived: envelope theorem, see `sensitivity`]
    """
    motion = moved.motion(np.array([extreme.input])).require()
    value: Float[np.ndarray, " dimensions"] = derivatives(motion, output, dimensions).rate[:, 0]
    return value


def _nodes(start: float, stop: float, samples: int) -> Float[np.ndarray, " nodes"]:
    if not (np.isfinite(start) and np.isfinite(stop) and start < stop):
        raise MechanismError(f"from {start} to {stop}", allowed="a start below the stop, both finite")
    return np.linspace(start, stop, samples + 1)


def _rate(history: OutputHistory) -> Float[np.ndarray, " samples"]:
    return history.rate


def _second_rate(history: OutputHistory) -> Float[np.ndarray, " samples"]:
    return history.second_rate


def _roots(
    moved: OneInput, output: Output, nodes: Float[np.ndarray, " nodes"], part: Callable[[OutputHistory], np.ndarray]
) -> Float[np.ndarray, " roots"]:
    """Inputs between neighbouring nodes at which a part of the output history changes its sign, refined."""

    def f(values: np.ndarray) -> np.ndarray:
        return part(output_history(moved.motion(values), output))

    return roots(f, nodes)


def _run(within: Bool[np.ndarray, " nodes"]) -> int:
    """Number of consecutive nodes within the tolerance after the first."""
    return int(np.argmin(within)) - 1 if not within.all() else len(within) - 1


def _leaving(  # noqa: PLR0917
    moved: OneInput, output: Output, value: float, tolerance: float, inside: float, outside: float
) -> float:
    """Input at which an output leaves the tolerance about a value, between two inputs; the first if it does not."""

    def f(inputs: np.ndarray) -> np.ndarray:
        apart = output_history(moved.motion(inputs), output).value - value
        return np.asarray(np.abs(apart) - tolerance)

    found = float(bracketed_roots(f, np.array([inside]), np.array([outside]))[0])
    return found if np.isfinite(found) else float(inside)
