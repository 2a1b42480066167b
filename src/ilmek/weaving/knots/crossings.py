"""The crossing word of a path among warps: exact, or an error.

A segment crosses the cut of a warp if its ends lie on either side of the line through warp and cut, and the warp lies
on the pile side of it: the sign of one determinant, from floats where their error bound allows it and from exact
fractions elsewhere (Shewchuk, Adaptive precision floating-point arithmetic, 1997, bound A). A corner on the
line itself counts as left of it, so each crossing counts once.

A sampled curve differs from its polyline. Between two samples at the distance c, a path of length l at most stays in
the ellipse with its foci at the samples, and its distance from the chord is at most

    b = sqrt(l² - c²) / 2

The ellipse is convex. If the warp with its keep-out radius is farther from the chord than b, path and chord pass it on
the same side, and the word of the chords is the word of the path. Else the samples are too coarse.  [derived here]
"""

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np

from ilmek.arrays import BoolArray, Complex, ComplexArray, Float, FloatArray, Int
from ilmek.errors import CarpetError
from ilmek.records import record
from ilmek.units import counted, format_quantity
from ilmek.weaving.knots.word import Word

_ERROR = (3 + 16 * 2.0**-53) * 2.0**-53
"""Relative error bound of the determinant in floats."""

_SLACK = 1e-9
"""Relative tolerance: a path at the keep-out radius of a warp does not touch it."""


@record
class WarpRow:
    """Warps in section: positions [m] from left to right, with the pile upwards.

    keep_out  radius about each axis that the path may not enter [m]: the warp's, plus half the moving part
    Raises CarpetError for no warps, positions that are not finite or not in order, and a negative keep-out radius.
    """

    positions: Complex[np.ndarray, " warps"]
    keep_out: float = 0.0

    def __post_init__(self) -> None:
        if not len(self.positions) or not np.isfinite(self.positions).all():
            raise CarpetError(
                f"{len(self.positions)} warps, or positions that are not numbers", allowed="one or more positions"
            )
        if not 0 <= self.keep_out < math.inf:
            raise CarpetError(f"room of {self.keep_out} m about a warp", allowed="0 or more")
        steps = np.diff(self.positions.real)
        if (steps <= 0).any():
            late = int(np.argmin(steps)) + 2
            raise CarpetError(
                f"warp {late} does not lie to the right of warp {late - 1}",
                allowed="warps from left to right, seen with the pile upwards",
                do="sort them, or turn the section so that the pile points up",
            )


def row_of_warps(count: int, pitch: float) -> ComplexArray:
    """Positions [m] of a row of `count` warps of a pitch [m], the first at 0, the pile upwards.

    >>> row_of_warps(3, 2.0).tolist()
    [0j, (2+0j), (4+0j)]
    """
    return np.arange(count) * pitch + 0j


def arc_lengths(points: Complex[np.ndarray, " points"]) -> Float[np.ndarray, " chords"]:
    """Estimated lengths [m] of a smooth curve between its samples, from the angles between chords: exact on circles.

    points  samples [m]
    A chord c at the angle t to its neighbour spans the arc c (t/2) / sin(t/2); the larger of two angles counts.
    An upper bound is the largest speed of the motion times the time step.
    """
    chords = np.diff(points)
    moved = np.abs(chords) > 0
    steps = chords[moved]
    turns = np.abs(np.angle(steps[1:] * np.conj(steps[:-1])))
    half = np.maximum(np.append(turns, 0.0), np.append(0.0, turns))[: len(steps)] / 2
    lengths = np.zeros(len(chords))
    lengths[moved] = np.abs(steps) / np.sinc(half / np.pi)
    return lengths


def crossings(row: WarpRow, points: Complex[np.ndarray, " points"], lengths: FloatArray | None = None) -> Word:
    """The word of a path in the order of its crossings, not reduced.

    points   corners of the path, or samples [m], the pile upwards
    lengths  upper bounds of the path's length between neighbouring samples [m]; default: the path is the polyline
    Raises CarpetError where the path touches a warp, and where the samples are too coarse to decide the side.
    """
    check_points(points)
    sag = _sag(np.abs(np.diff(points)), lengths)
    found: list[tuple[int, int, int]] = []
    for number, axis in enumerate(row.positions.tolist(), start=1):
        _clear_of(number, axis, row.keep_out, points, sag)
        segments, signs = _across(number, axis, points)
        found += [(segment, sign * number, sign * number) for segment, sign in zip(segments, signs, strict=True)]
    return tuple(letter for *_, letter in sorted(found))


def check_points(points: ComplexArray) -> None:
    """Raise CarpetError for a path of fewer than two points, or with a point that is not finite."""
    if len(points) < 2:
        raise CarpetError(f"a path of {counted(len(points), 'point')}", allowed="two or more")
    if not np.isfinite(points).all():
        raise CarpetError(f"point {int(np.argmin(np.isfinite(points)))} of the path is no number", allowed="numbers")


def _sag(chords: FloatArray, lengths: FloatArray | None) -> FloatArray:
    """Largest distance of the path from its chords [m]: b = sqrt(l² - c²) / 2."""
    if lengths is None:
        return np.zeros_like(chords)
    lengths = np.broadcast_to(np.asarray(lengths, float), chords.shape)
    short = chords > lengths * (1 + _SLACK)
    if short.any() or not np.isfinite(lengths).all():
        at = int(np.argmax(short | ~np.isfinite(lengths)))
        raise CarpetError(
            f"samples {at} and {at + 1} lie {format_quantity(float(chords[at]), 'mm')} apart, "
            f"the path between them is stated to be {lengths[at] * 1e3:.4g} mm long",
            allowed="at least as long as the samples lie apart",
        )
    return np.asarray(np.sqrt(np.maximum(lengths**2 - chords**2, 0.0)) / 2)


def distances(axis: complex, points: ComplexArray) -> FloatArray:
    """Least distance of a position from each segment of a polyline [m]."""
    start, step = points[:-1] - axis, np.diff(points)
    square = step.real**2 + step.imag**2
    share = -(start.real * step.real + start.imag * step.imag) / np.where(square > 0, square, 1.0)
    return np.asarray(np.abs(start + np.clip(share, 0.0, 1.0) * step))


def _clear_of(number: int, axis: complex, keep_out: float, points: ComplexArray, sag: FloatArray) -> None:
    """Raise CarpetError where the path touches the warp, or the side of the warp is not decided."""
    room = keep_out * (1 - _SLACK)
    gap = distances(axis, points)
    _untouched(number, axis, keep_out, points)
    chord = ((gap < room) | (gap == 0)) & (sag == 0)
    if chord.any():
        raise _touching(number, int(np.argmax(chord)), float(gap[chord].min()), keep_out)
    unsure = (gap - sag <= room) & (sag > 0)
    if unsure.any():
        at = int(np.argmax(unsure))
        raise CarpetError(
            f"the samples are too coarse near warp {number}: between points {at} and {at + 1} the path may pass it "
            f"on either side",
            allowed=f"a path within {format_quantity(max(float(gap[at]) - room, 0.0), 'mm')} of its chord there",
            do="sample it more finely",
        )


def _untouched(number: int, axis: complex, keep_out: float, points: ComplexArray) -> None:
    """Raise CarpetError where a point of the path is within the keep-out radius of the warp."""
    near = np.abs(points - axis)
    inside = (near < keep_out * (1 - _SLACK)) | (near == 0)
    if inside.any():
        raise _touching(number, int(np.argmax(inside)), float(near.min()), keep_out)


def _touching(number: int, at: int, least: float, keep_out: float) -> CarpetError:
    return CarpetError(
        f"the path touches warp {number}: at point {at} it comes within {format_quantity(least, 'mm')} of its axis",
        allowed=f"{format_quantity(keep_out, 'mm')} or more" if keep_out else "a path past the warp, not through it",
        do=f"lead it round warp {number}",
    )


def _across(number: int, axis: complex, points: ComplexArray) -> tuple[list[int], list[int]]:
    """Segments that cross the warp's cut, and +1 (from left to right) or -1 for each."""
    left = points.real <= axis.real
    segments = np.flatnonzero(left[1:] != left[:-1])
    side = orientation(points[segments], points[segments + 1], axis)
    if (side == 0).any():
        raise CarpetError(
            f"the path goes through the axis of warp {number} after point {int(segments[side == 0][0])}",
            allowed="a path past the warp",
            do=f"lead it round warp {number}",
        )
    heading = np.where(left[segments], 1, -1)
    behind = side == heading
    return segments[behind].tolist(), heading[behind].tolist()


def orientation(start: ComplexArray, end: ComplexArray, axis: complex) -> Int[np.ndarray, " segments"]:
    """+1 where the position `axis` is left of the segment, -1 right, 0 on its line; exact for the given floats.

    start, end  of each segment [m], shape (segments,)      axis  [m]
    [Shewchuk 1997, bound A, else exact fractions]

    >>> orientation(np.array([0j]), np.array([3 + 3j]), 0.1 + 0.1j), orientation(np.array([0j]), np.array([1 + 0j]), 1j)
    (array([0]), array([1]))
    """
    plus = (end.real - start.real) * (axis.imag - start.imag)
    minus = (end.imag - start.imag) * (axis.real - start.real)
    value = plus - minus
    sign: Int[np.ndarray, " segments"] = np.sign(value).astype(np.int64)
    unsure = np.abs(value) <= _ERROR * (np.abs(plus) + np.abs(minus)) + 1e-300
    for at in np.flatnonzero(unsure):
        sign[at] = _exact(complex(start[at]), complex(end[at]), axis)
    return sign


def _exact(start: complex, end: complex, axis: complex) -> int:
    sx, sy = Fraction(start.real), Fraction(start.imag)
    value = (Fraction(end.real) - sx) * (Fraction(axis.imag) - sy)
    value -= (Fraction(end.imag) - sy) * (Fraction(axis.real) - sx)
    return (value > 0) - (value < 0)


def sampled_curve(
    row: WarpRow, curve: Callable[[FloatArray], ComplexArray], speed: float, *, most: int = 200_000
) -> tuple[ComplexArray, FloatArray]:
    """Samples [m] of a curve, fine enough to decide the side of every warp, and bounds of the lengths between them [m].

    curve  positions [m] for an array of parameters u in [0, 1]      speed  upper bound of |dz/du| [m]
    Only undecided intervals are halved. Raises CarpetError where `most` samples do not decide a side.
    """
    at = np.linspace(0.0, 1.0, 65)
    points = np.asarray(curve(at), complex)
    check_points(points)
    while True:
        for number, axis in enumerate(row.positions.tolist(), start=1):
            _untouched(number, axis, row.keep_out, points)
        lengths = speed * np.diff(at)
        unsure, warp = _undecided(row, points, _sag(np.abs(np.diff(points)), lengths))
        if not unsure.any():
            return points, lengths
        middle = (at[:-1] + at[1:])[unsure] / 2
        if len(at) + len(middle) > most or (np.diff(at)[unsure] < 1e-12).any():
            raise CarpetError(
                f"the path touches warp {warp}, or nearly: {len(at)} samples do not decide the side",
                allowed=f"more than {format_quantity(row.keep_out, 'mm')} from its axis",
                do=f"lead it round warp {warp}",
            )
        index = np.searchsorted(at, middle)
        at, points = np.insert(at, index, middle), np.insert(points, index, curve(middle))


def _undecided(row: WarpRow, points: ComplexArray, sag: FloatArray) -> tuple[BoolArray, int]:
    """Chords with an undecided side of some warp, and the last such warp."""
    unsure, warp = np.zeros(len(sag), bool), 0
    for number, axis in enumerate(row.positions.tolist(), start=1):
        here = distances(axis, points) - sag <= row.keep_out
        unsure |= here
        warp = number if here.any() else warp
    return unsure, warp
