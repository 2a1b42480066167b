"""Reduction of curves to the points that a figure can show."""

from collections.abc import Callable, Sequence

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray, IntArray

LIMIT = 720
TOLERANCE = 0.04
"""Largest deviation of a thinned line from the given line [pt]; a tenth of a thin stroke."""


def thinned_curve(x: FloatArray, y: FloatArray, limit: int = LIMIT) -> tuple[FloatArray, FloatArray]:
    """The curve y(x) with at most `limit` samples, which keeps every peak.

    The samples are divided into limit/4 groups; of each, the first, the lowest, the highest and a gap (NaN) are kept.

    >>> x, y = thinned_curve(np.arange(10_000.0), np.sin(np.arange(10_000.0) / 500))
    >>> len(x) <= 720, round(float(y.max()), 6)
    (True, 1.0)
    """
    count = len(x)
    if count <= limit:
        return x, y
    starts = np.linspace(0, count, limit // 4, dtype=np.intp)[:-1]
    group = np.repeat(np.arange(len(starts)), np.diff(np.append(starts, count)))
    # Sorted by group, the first of each group is its lowest, its highest, or its first gap (any point without a gap).
    firsts = [np.lexsort((key, group))[starts] for key in (y, -y, np.isfinite(y))]
    order = np.unique(np.concatenate([[count - 1], starts, *firsts]))
    return x[order], y[order]


def thinned_line(points: ComplexArray, tolerance: float = TOLERANCE, limit: int = LIMIT) -> ComplexArray:
    """The polyline without the points that lie within `tolerance` [pt] of the line drawn without them.

    The point farthest from the chord of an interval is kept if it is farther than the tolerance, and divides the
    interval in two. Gaps (NaN) are kept.    [D. H. Douglas and T. K. Peucker, Cartographica 10 (1973) 112]

    >>> thinned_line(np.array([0, 1, 2, 2 + 1j], dtype=complex)).tolist()
    [0j, (2+0j), (2+1j)]
    """
    return thinned_lines([points], tolerance, limit)[0]


def thinned_lines(
    lines: Sequence[ComplexArray], tolerance: float = TOLERANCE, limit: int = LIMIT
) -> tuple[ComplexArray, ...]:
    """Several polylines, each as by `thinned_line`: quicker than one by one."""
    few = [
        line[np.linspace(0, len(line) - 1, 4 * limit).round().astype(np.intp)] if len(line) > 4 * limit else line
        for line in lines
    ]
    points = np.concatenate([np.append(line, np.nan) for line in few])
    keep = _kept(points, tolerance)
    stops = np.cumsum([len(line) + 1 for line in few])
    return tuple(line[keep[stop - 1 - len(line) : stop - 1]] for line, stop in zip(few, stops.tolist(), strict=True))


def _kept(points: ComplexArray, tolerance: float) -> BoolArray:
    """Which points of lines between gaps are kept.

    The distance from a chord is that from the segment, because a line may turn back beyond its ends.
    """

    def away(number: IntArray, begin: IntArray, end: IntArray) -> FloatArray:
        chord, off = points[end] - points[begin], points[number] - points[begin]
        squared = np.maximum(chord.real**2 + chord.imag**2, np.finfo(float).tiny)
        share = np.clip((off.real * chord.real + off.imag * chord.imag) / squared, 0.0, 1.0)
        return np.asarray(np.abs(off - share * chord))

    gap = ~np.isfinite(points)
    return divided(gap | np.append(True, gap[:-1]) | np.append(gap[1:], True), away, tolerance)


def divided(kept: BoolArray, away: Callable[[IntArray, IntArray, IntArray], FloatArray], tolerance: float) -> BoolArray:
    """The samples of a curve that are kept, and of each interval between two the farthest one from what joins its ends.

    All intervals are divided at once, until in none a sample is farther than the tolerance.

    kept  at first, both ends among them
    away  numbers of samples, and of the begin and the end of the interval of each -> their distances
    """
    kept, left = kept.copy(), np.arange(len(kept))  # of the intervals that may need division, each with both ends
    while len(left) > 2:
        ends = np.flatnonzero(kept[left])
        interval = np.minimum(np.cumsum(kept[left]) - 1, len(ends) - 2)
        distance = away(left, left[ends[interval]], left[ends[interval + 1]])
        farthest = np.maximum.reduceat(distance, ends[:-1])[interval]
        cuts = np.flatnonzero((distance == farthest) & (farthest > tolerance))
        cut, first = np.unique(interval[cuts], return_index=True)
        kept[left[cuts[first]]] = True
        sizes = ends[cut + 1] - ends[cut] + 1
        left = left[np.repeat(ends[cut] - np.cumsum(sizes) + sizes, sizes) + np.arange(sizes.sum())]
    return kept
