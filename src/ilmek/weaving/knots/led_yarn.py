"""The yarn guided by grippers at its two ends: sampled paths of the ends, and the proof of the knot.

The yarn starts as a straight line between its ends. Each end then follows the gripper that holds it; at a transfer it
moves straight from one gripper to the next. So the yarn follows the first end's path backwards, the straight line, and
the second end's path. The proof [`proof`] requires samples of that path and upper bounds of its length between them.
Samples that are too coarse to decide the side of a warp are refined.             [sources: `word` and `crossings`]
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.errors import CarpetError
from ilmek.weaving.knots.proof import TiedKnot, no_knot, tied_knot

SAMPLES = (201, 1601, 12801)
"""Numbers of samples of each motion, from coarse to fine."""

_ROUNDING = 1e-9
"""Relative addition to a bound, for rounding."""


@dataclass(frozen=True, slots=True, eq=False)
class SampledPath:
    """A sampled path: points [m], and upper bounds of its length between neighbouring points [m]."""

    points: Complex[np.ndarray, " points"]
    lengths: Float[np.ndarray, " chords"]


def end_path(motions: Sequence[tuple[ComplexArray, FloatArray]]) -> SampledPath:
    """The path of an end that follows several motions in sequence, with straight transfers.

    motions  of each gripper that guides the end: samples [m], and upper bounds of the length between them [m]

    >>> path = end_path([(np.array([0j, 1 + 0j]), np.ones(1)), (np.array([1 + 2j, 1 + 3j]), np.ones(1))])
    >>> path.points.tolist(), path.lengths.round(6).tolist()
    ([0j, (1+0j), (1+2j), (1+3j)], [1.0, 2.0, 1.0])
    """
    points, lengths = np.empty(0, complex), np.empty(0)
    for motion, bounds in motions:
        over = np.abs(motion[:1] - points[-1:])
        points = np.concatenate([points, motion])
        lengths = np.concatenate([lengths, over, bounds * (1 + _ROUNDING)])
    return SampledPath(points, lengths)


def yarn_between(first: SampledPath, second: SampledPath) -> SampledPath:
    """The yarn between two guided ends: the first path backwards, straight to the start of the second, the second path.

    Samples [m] and upper bounds of the length between them [m], in the order of the yarn.

    >>> one, other = (end_path([(np.array([x + 0j, x + 1j]), np.ones(1))]) for x in (-1, 1))
    >>> yarn_between(one, other).points.tolist()
    [(-1+1j), (-1+0j), (1+0j), (1+1j)]
    """
    points = np.concatenate([first.points[::-1], second.points])
    between = np.abs(second.points[:1] - first.points[:1])
    lengths = np.concatenate([first.lengths[::-1], between, second.lengths])
    return SampledPath(points, np.maximum(lengths, np.abs(np.diff(points))))


def evenly(path: Complex[np.ndarray, " points"], samples: int) -> Complex[np.ndarray, " samples"]:
    """Points [m] along a polyline, even by arc length, both ends included.

    >>> evenly(np.array([0j, 1 + 0j, 1 + 3j]), 5).tolist()
    [0j, (1+0j), (1+1j), (1+2j), (1+3j)]
    """
    length = np.append(0.0, np.cumsum(np.abs(np.diff(path))))
    even = np.linspace(0.0, length[-1], samples)
    return np.asarray(np.interp(even, length, path.real) + 1j * np.interp(even, length, path.imag))


def yarn_over_time(
    ends: Sequence[tuple[FloatArray, ComplexArray]], times: FloatArray, samples: int
) -> Complex[np.ndarray, "times samples"]:
    """The yarn at some times, not yet tightened: the first end's path until then backwards, then the second's [m].

    ends  of each the times at which it is led, in order, and its positions then [m]; it begins at the first
    """

    def until(end: tuple[FloatArray, ComplexArray], time: float) -> ComplexArray:
        return end[1][: max(int(np.searchsorted(end[0], time, side="right")), 1)]

    first, second = ends
    return np.stack(
        [evenly(np.concatenate([until(first, one)[::-1], until(second, one)]), samples) for one in times.tolist()]
    )


def knot_of_ends(
    ends: Callable[[int], tuple[SampledPath, SampledPath]],
    warps: Complex[np.ndarray, " warps"],
    *,
    keep_out: float = 0.0,
) -> TiedKnot:
    """The knot tied by two guided ends, sampled as finely as the proof requires.

    ends      gives the paths of both ends for a number of samples of each motion
    warps     positions of the warps from left to right [m], the pile upwards; they are numbered from 1
    keep_out  radius about each warp's axis that the yarn may not enter [m]
    Where the finest sampling gives no proof, for example where the yarn touches a warp, the result is no knot with the
    reason.
    """
    reason = ""
    for samples in SAMPLES:
        try:
            yarn = yarn_between(*ends(samples))
            return tied_knot(yarn.points, warps, keep_out=keep_out, lengths=yarn.lengths)
        except CarpetError as error:
            reason = error.given
    return no_knot(reason)
