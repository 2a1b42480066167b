"""Curves with no more points than a figure can show."""

import itertools

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray

LIMIT = 720
TOLERANCE = 0.04
"""How far a thinned line may stray from the line given [pt]; a tenth of a thin stroke."""


def thinned_curve(x: FloatArray, y: FloatArray, limit: int = LIMIT) -> tuple[FloatArray, FloatArray]:
    """The curve y(x) with at most `limit` samples, in which every peak survives.

    The samples are cut into limit/4 groups of which the first, the lowest, the highest and a gap (NaN) stay.

    >>> x, y = thinned_curve(np.arange(10_000.0), np.sin(np.arange(10_000.0) / 500))
    >>> len(x) <= 720, round(float(y.max()), 6)
    (True, 1.0)
    """
    count = len(x)
    if count <= limit:
        return x, y
    edges = np.linspace(0, count, limit // 4, dtype=np.intp)
    kept = {0, count - 1}
    for start, stop in itertools.pairwise(edges):
        group = y[start:stop]
        gaps = np.flatnonzero(~np.isfinite(group))
        kept.add(int(start))
        kept.update(int(start + gap) for gap in gaps[:1])
        if len(gaps) < len(group):
            kept.update((int(start + np.nanargmin(group)), int(start + np.nanargmax(group))))
    order = np.array(sorted(kept))
    return x[order], y[order]


def thinned_line(points: ComplexArray, tolerance: float = TOLERANCE, limit: int = LIMIT) -> ComplexArray:
    """The polyline without the points that lie within `tolerance` of the line drawn without them.

    A point stays where it is the one farthest from the chord of its stretch, and farther than the tolerance; the
    stretch is then cut there in two. Gaps (NaN) stay.    [D. H. Douglas and T. K. Peucker, Cartographica 10 (1973) 112]

    >>> thinned_line(np.array([0, 1, 2, 2 + 1j], dtype=complex)).tolist()
    [0j, (2+0j), (2+1j)]
    """
    if len(points) > 4 * limit:
        points = points[np.linspace(0, len(points) - 1, 4 * limit).round().astype(np.intp)]
    keep = ~np.isfinite(points)
    edges = np.flatnonzero(np.diff(np.concatenate([[True], keep, [True]]).astype(np.int8)))
    stretches = [(int(start), int(stop) - 1) for start, stop in zip(edges[::2], edges[1::2], strict=True)]
    while stretches:
        first, last = stretches.pop()
        keep[first] = keep[last] = True
        if last - first < 2:
            continue
        away = _distances(points[first + 1 : last], points[first], points[last])
        farthest = int(np.argmax(away))
        if away[farthest] > tolerance:
            middle = first + 1 + farthest
            stretches += [(first, middle), (middle, last)]
    return np.asarray(points[keep])


def _distances(points: ComplexArray, start: complex, end: complex) -> FloatArray:
    """How far each point lies from the chord, its ends included: a line may turn back beyond them."""
    chord = end - start
    length = abs(chord) ** 2 or 1.0
    share = np.clip(((points - start) * np.conj(chord)).real / length, 0.0, 1.0)
    return np.asarray(np.abs(points - start - share * chord))
