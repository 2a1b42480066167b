"""Approximation of a smooth curve of points by few tangent arcs within a tolerance.

Two arcs from p with the tangent t to q with the tangent u, with tangent lengths d, meet at the midpoint of p + d t and
q - d u:

    d = v.v / (v.s + sqrt((v.s)^2 + |t - u|^2 v.v)),   v = q - p,   s = t + u        [Bolton, biarc curves, 1975]

A tool path of arcs needs no smoothing on the machine. Circles and straight edges among the points are exact.
"""

import math
from itertools import pairwise

import numpy as np

from ilmek.arrays import Complex, ComplexArray, FloatArray, Int
from ilmek.plane.contours import STRAIGHT, arc_centre, counter_clockwise, polygon
from ilmek.report import Contour

CORNER, SHARP = math.radians(10), math.radians(20)
"""Least angle between chords at a corner [rad]: if it is three times that of a neighbour, and in any case."""

_WIDEST = math.radians(120)
"""Greatest rotation of the tangent over one pair of arcs [rad]."""


def as_contour(outline: ComplexArray | Contour, tolerance: float) -> Contour:
    """A plate's outline as a counter-clockwise contour; points [m] are approximated by arcs within a tolerance [m]."""
    return counter_clockwise(outline if isinstance(outline, Contour) else fitted(outline, tolerance))


def fitted(points: Complex[np.ndarray, " points"], tolerance: float) -> Contour:
    """The closed curve through points [m] as arcs, with a deviation of at most `tolerance` [m] at each point.

    Corners of the curve are kept; elsewhere the tangent is continuous. Between the points the deviation is that of the
    circles through neighbouring points.

    >>> turn = np.exp(2j * np.pi * np.arange(720) / 720)
    >>> len(fitted(turn, 1e-6).points) <= 12
    True
    """
    points = _without_repeats(points)
    if len(points) < 3:
        return polygon(points)
    sharp = corners(points)
    first = int(sharp[0]) if len(sharp) else 0
    around = np.roll(points, -first)
    ends = [*(int(index) - first for index in sharp), len(points)] if len(sharp) else [0, len(points)]
    closed = np.append(around, around[0])
    knots: list[complex] = []
    bulges: list[float] = []
    for begin, end in pairwise(ends):
        run = closed[begin : end + 1]
        _lay(run, _open_tangents(run) if len(sharp) else _closed_tangents(run), tolerance, knots, bulges)
    return Contour(np.array(knots), np.array(bulges))


def corners(points: Complex[np.ndarray, " points"]) -> Int[np.ndarray, " corners"]:
    """Indices of the corners of a closed curve: the direction changes there, but little at the neighbouring points.

    points  of the closed curve [m], shape (points,), the first not repeated

    >>> corners(np.array([0, 1, 2, 2 + 1j, 2j, 1j], dtype=complex)).tolist()
    [0, 2, 3, 4]
    """
    chords = np.roll(points, -1) - points
    turns = np.abs(np.angle(chords / np.roll(chords, 1)))
    beside = np.minimum(np.roll(turns, 1), np.roll(turns, -1))
    alone = (turns > 3 * beside) | (turns > SHARP)
    return np.flatnonzero((turns > CORNER) & alone)


def deviation(points: Complex[np.ndarray, " points"], contour: Contour) -> float:
    """Greatest distance of the points from the contour [m]."""
    following = np.roll(contour.points, -1)
    nearest = np.full(len(points), np.inf)
    for start, end, bulge in zip(contour.points, following, contour.bulges, strict=True):
        np.minimum(nearest, distances(points, complex(start), complex(end), float(bulge)), out=nearest)
    return float(nearest.max(initial=0.0))


def distances(points: ComplexArray, start: complex, end: complex, bulge: float) -> FloatArray:
    """Distances of points from an arc or a straight piece [m], (points,)."""
    ends = np.minimum(np.abs(points - start), np.abs(points - end))
    chord = end - start
    if abs(bulge) < STRAIGHT:
        share = ((points - start) / chord).real
        across = np.abs(((points - start) / chord).imag * chord)
        return np.asarray(np.where((share >= 0) & (share <= 1), across, ends))
    centre = arc_centre(start, end, bulge)
    turned = np.angle((points - centre) / (start - centre)) * math.copysign(1.0, bulge) % (2 * math.pi)
    inside = turned <= 4 * math.atan(abs(bulge))
    return np.asarray(np.where(inside, np.abs(np.abs(points - centre) - abs(start - centre)), ends))


def _without_repeats(points: Complex[np.ndarray, " points"]) -> Complex[np.ndarray, " apart"]:
    """The points without those equal to their predecessor; the first follows the last."""
    size = float(np.abs(points - points.mean()).max(initial=0.0))
    kept = np.abs(points - np.roll(points, 1)) > 1e-12 * size
    return np.asarray(points[kept])


def _closed_tangents(run: Complex[np.ndarray, " run"]) -> Complex[np.ndarray, " run"]:
    """Unit tangents along a closed run, with equal first and last points, of the circles through neighbours."""
    chords = np.diff(run)
    tangents = _mid_tangent(np.roll(chords, 1), chords)
    return np.append(tangents, tangents[0])


def _mid_tangent(before: ComplexArray, after: ComplexArray) -> ComplexArray:
    """Tangent at the middle of three points, exact on a circle: weighted mean of the chords' directions."""
    arrow = before / np.abs(before) ** 2 + after / np.abs(after) ** 2
    direction: ComplexArray = arrow / np.abs(arrow)
    return direction


def _open_tangents(run: Complex[np.ndarray, " run"]) -> Complex[np.ndarray, " run"]:
    """Unit tangents along an open run; at its ends of the circle through three points, or of the chord."""
    chords = np.diff(run)
    directions = chords / np.abs(chords)
    if len(run) == 2:
        return np.array([directions[0], directions[0]])
    inner = _mid_tangent(chords[:-1], chords[1:])
    first, last = directions[0] ** 2 / inner[0], directions[-1] ** 2 / inner[-1]
    return np.concatenate([[first], inner, [last]])


def _lay(
    run: Complex[np.ndarray, " run"],
    tangents: Complex[np.ndarray, " run"],
    tolerance: float,
    knots: list[complex],
    bulges: list[float],
) -> None:
    """Append pairs of arcs along a run, each as long as the tolerance allows, without the run's last point."""
    start, last, reach = 0, len(run) - 1, 1
    while start < last:
        end = _farthest(run, tangents, start, min(last, start + 2 * reach), tolerance)
        reach = end - start
        for knot, bulge in _pair(run[start], tangents[start], run[end], tangents[end]):
            knots.append(knot)
            bulges.append(bulge)
        start = end


def _farthest(
    run: Complex[np.ndarray, " run"], tangents: Complex[np.ndarray, " run"], start: int, guess: int, tolerance: float
) -> int:
    """The last index that one pair of arcs from `start` reaches within the tolerance, by doubling and bisection."""
    low, high = start + 1, guess
    while high > low and _fits(run, tangents, start, high, tolerance):
        low, high = high, min(len(run) - 1, start + 2 * (high - start))
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if _fits(run, tangents, start, middle, tolerance) else (low, middle)
    return low


def _fits(
    run: Complex[np.ndarray, " run"], tangents: Complex[np.ndarray, " run"], start: int, end: int, tolerance: float
) -> bool:
    turned = np.abs(np.angle(tangents[start : end + 1] / tangents[start]))
    if turned.max() > _WIDEST:
        return False
    points = run[start + 1 : end]
    pieces = _pair(run[start], tangents[start], run[end], tangents[end])
    nearest = np.full(len(points), np.inf)
    for index, (knot, bulge) in enumerate(pieces):
        following = pieces[index + 1][0] if index + 1 < len(pieces) else complex(run[end])
        np.minimum(nearest, distances(points, knot, following, bulge), out=nearest)
    return bool(nearest.max(initial=0.0) <= tolerance)


def _pair(p: complex, t: complex, q: complex, u: complex) -> list[tuple[complex, float]]:
    """Start and bulge of each of the two arcs from p to q; a single one where both are on one circle or line."""
    v, s = q - p, t + u
    forth = (v.conjugate() * s).real
    d = abs(v) ** 2 / (forth + math.hypot(forth, abs(t - u) * abs(v)))
    joint = (p + d * t + q - d * u) / 2
    first, second = _bulge(p, t, joint), -_bulge(q, -u, joint)
    if abs(first - second) <= 1e-9 * (1 + abs(first)) and abs(abs(joint - p) - abs(q - joint)) <= 1e-9 * abs(v):
        return [(complex(p), 2 * first / (1 - first**2))]
    return [(complex(p), first), (complex(joint), second)]


def _bulge(start: complex, tangent: complex, end: complex) -> float:
    """The bulge of the arc from `start` along the tangent to `end`; 0 below rounding."""
    half = math.atan2(((end - start) / tangent).imag, ((end - start) / tangent).real)
    return math.tan(half / 2) if abs(half) > 2 * STRAIGHT else 0.0
