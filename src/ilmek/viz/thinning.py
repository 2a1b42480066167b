"""Reduction of curves to the points that a figure can show."""

import numpy as np

from ilmek.arrays import Bool, ComplexArray, FloatArray

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
    if len(points) > 4 * limit:
        points = points[np.linspace(0, len(points) - 1, 4 * limit).round().astype(np.intp)]
    keep = ~np.isfinite(points)
    edges = np.flatnonzero(np.diff(np.concatenate([[True], keep, [True]]).astype(np.int8)))
    for start, stop in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        keep[start:stop] = _kept(points[start:stop], tolerance)
    return np.asarray(points[keep])


def _kept(points: ComplexArray, tolerance: float) -> Bool[np.ndarray, " n"]:
    """Which points of a line without gaps are kept; all intervals are divided at once until none needs division.

    The distance from a chord is that from the segment, because a line may turn back beyond its ends.
    """
    keep = np.zeros(len(points), dtype=bool)
    keep[[0, -1]] = True
    while len(points) > 2:
        ends = np.flatnonzero(keep)
        interval = np.minimum(np.cumsum(keep) - 1, len(ends) - 2)
        starts = points[ends[interval]]
        chord, off = points[ends[interval + 1]] - starts, points - starts
        squared = np.maximum(chord.real**2 + chord.imag**2, np.finfo(float).tiny)
        share = np.clip((off.real * chord.real + off.imag * chord.imag) / squared, 0.0, 1.0)
        away = np.abs(off - share * chord)
        farthest = np.maximum.reduceat(away, ends[:-1])[interval]
        cuts = np.flatnonzero((away == farthest) & (farthest > tolerance))
        if not len(cuts):
            break
        keep[cuts[np.unique(interval[cuts], return_index=True)[1]]] = True
    return keep
