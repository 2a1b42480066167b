"""Least distances of moving bodies over a turn of a cyclogram.

A body consists of convex parts: corners that move, and a radius about them. Between two samples each corner moves on a
straight line, forward only: a track's law is monotonic between its joints, and these are samples. Where two parts are d
and d' apart at two samples, and their corners move by m and m' between them, they are in between nowhere nearer than

    (d + d' - m - m') / 2

[a point that is moved from p to p' by way of q has |p - q| + |q - p'| = |p - p'|]. Intervals whose bound lies below
both the least distance found and the allowed one are halved until it does not: where a result is above the allowed
distance, no instant between the samples is below it; else it is exact within `TOLERANCE`. On curved paths, of a
linkage, the bound is short by their sagitta between two samples. Overlap counts as a negative distance, the depth.
"""

import math
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass
from itertools import combinations
from typing import TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray, IntArray
from ilmek.plane.outlines import between
from ilmek.records import record
from ilmek.units import deg, mm, turn

STEP = 0.5 * deg
"""Largest step of the samples of a turn [rad]."""

TOLERANCE = 0.02 * mm
"""How far the least distance found may be above the true one [m]."""

HALVINGS = 12

Corners: TypeAlias = Callable[[FloatArray], ComplexArray]
"""Angles of the turn [rad] -> corners [m], (angles, corners), counter-clockwise; one row for a part that stands."""


@record
class ConvexPart:
    """A convex part of a body: its corners over the turn, and the radius of its edge about them [m].

    displacement  that moves it without rotation, if any: parts of the same one do not move to each other
    """

    corners: Corners
    radius: float = 0.0
    displacement: Corners | None = None


@record
class MovingBody:
    """A body in a cyclogram.

    windows  angles of the turn between which it is where its parts say [rad]; elsewhere it is out of the loom
    """

    name: str
    parts: tuple[ConvexPart, ...]
    windows: tuple[tuple[float, float], ...] = ((0.0, turn),)


@record
class SweptPart:
    """A part at the angles of a turn: corners, boxes about them (left, low, right, high), the box of all, and how far a
    corner moves to the next angle at most [m]; one row or column for a part that stands.
    """

    part: ConvexPart
    corners: ComplexArray
    boxes: FloatArray
    whole: FloatArray
    moved: FloatArray


@record
class SweptBody:
    """A body at the angles of a turn, and at which of them it is present."""

    body: MovingBody
    present: BoolArray
    parts: tuple[SweptPart, ...]


@dataclass(frozen=True, slots=True)
class BodyDistance:
    """The least distance of two bodies [m], and the angle of the turn at which it occurs [rad]."""

    first: str
    second: str
    value: float
    angle: float


def standing(corners: ComplexArray, radius: float = 0.0) -> ConvexPart:
    """A part that does not move: its corners [m] and the radius of its edge [m]."""
    row = np.asarray(corners, complex)[None, :]
    return ConvexPart(lambda _angle: row, radius)


def moving(corners: ComplexArray, displacement: Corners, radius: float = 0.0) -> ConvexPart:
    """A part that is displaced without rotation: `displacement` of angles [rad] in m, (angles,)."""
    row = np.asarray(corners, complex)[None, :]
    return ConvexPart(lambda angle: row + displacement(angle)[:, None], radius, displacement)


def samples(joints: Iterable[float] = ()) -> FloatArray:
    """Angles of a turn [rad], at most `STEP` apart, the joints of the tracks among them."""
    even = np.linspace(0.0, turn, round(turn / STEP) + 1)
    return np.unique(np.concatenate([even, np.clip(np.fromiter(joints, float), 0.0, turn)]))


def swept(body: MovingBody, angles: FloatArray) -> SweptBody:
    """A body at the angles of its windows [rad], its corners computed once for all pairs."""
    return SweptBody(body, _within(body.windows, angles), tuple(_swept_part(part, angles) for part in body.parts))


def least_clearances(
    bodies: Iterable[MovingBody],
    angles: FloatArray,
    allowed: float,
    ignored: Collection[frozenset[str]] = (),
    horizon: float = math.inf,
) -> tuple[BodyDistance, ...]:
    """The least distance of every two bodies at and between angles of the turn [rad].

    allowed  distance [m], above which there is no need of the exact one
    ignored  pairs of names that may touch       horizon  pairs that are farther apart are left out [m]
    """
    every = [swept(body, angles) for body in bodies]
    pairs = (pair for pair in combinations(every, 2) if frozenset(one.body.name for one in pair) not in ignored)
    found = (_least_of_bodies(one, other, angles, (allowed, horizon)) for one, other in pairs)
    return tuple(one for one in found if one is not None)


def _least_of_bodies(
    one: SweptBody, other: SweptBody, angles: FloatArray, limits: tuple[float, float]
) -> BodyDistance | None:
    """The least distance of two bodies; None where they are never together, or beyond the horizon."""
    present = np.flatnonzero(one.present & other.present)
    near = [(a, b) for a in one.parts for b in other.parts if _gap_of_boxes(a.whole, b.whole) <= limits[1]]
    if not len(present) or not near:
        return None
    value, angle = min(_least(a, b, angles, present, limits) for a, b in near)
    return BodyDistance(one.body.name, other.body.name, value, angle) if value <= limits[1] else None


def _swept_part(part: ConvexPart, angles: FloatArray) -> SweptPart:
    corners, radius = part.corners(angles), part.radius
    boxes = np.stack(
        [
            corners.real.min(axis=1) - radius,
            corners.imag.min(axis=1) - radius,
            corners.real.max(axis=1) + radius,
            corners.imag.max(axis=1) + radius,
        ]
    )
    whole = np.concatenate([boxes[:2].min(axis=1), boxes[2:].max(axis=1)])
    moved = np.append(np.abs(np.diff(corners, axis=0)).max(axis=1), 0.0) if len(corners) > 1 else np.zeros(1)
    return SweptPart(part, corners, boxes, whole[:, None], moved)


def _within(windows: tuple[tuple[float, float], ...], angles: FloatArray) -> BoolArray:
    inside = np.zeros(len(angles), bool)
    for start, end in windows:
        inside |= (angles >= start - 1e-12) & (angles <= end + 1e-12)
        inside |= angles + turn <= end + 1e-12
    return inside


def _least(
    one: SweptPart, other: SweptPart, angles: FloatArray, present: IntArray, limits: tuple[float, float]
) -> tuple[float, float]:
    """The least distance of two parts, and its angle."""
    together = one.part.displacement is not None and one.part.displacement is other.part.displacement
    if together or len(one.corners) == len(other.corners) == 1:
        return float(_at(one, other, present[:1])[0]), float(angles[present[0]])
    gap = np.broadcast_to(_gap_of_boxes(one.boxes, other.boxes), angles.shape)[present]
    moved = np.broadcast_to(one.moved + other.moved, angles.shape)[present]
    first = int(np.argmin(gap))
    if gap[first] > limits[1]:
        return float(gap[first]), float(angles[present[first]])
    nearest = present[first]
    best = float(_at(one, other, np.array([nearest]))[0])
    near = np.flatnonzero(gap - np.maximum(moved, np.roll(moved, 1)) <= best + TOLERANCE)
    distance = gap.copy()
    distance[near] = _at(one, other, present[near])
    index = int(near[np.argmin(distance[near])])
    found = float(distance[index]), float(angles[present[index]])
    intervals = np.flatnonzero(np.diff(present) == 1)
    bound = (distance[intervals] + distance[intervals + 1] - moved[intervals]) / 2
    intervals = intervals[bound < min(found[0] - TOLERANCE, limits[0])]
    sampled = angles[present], distance, moved
    return _refined(one.part, other.part, sampled, intervals, found, limits[0]) if len(intervals) else found


def _at(one: SweptPart, other: SweptPart, index: IntArray) -> FloatArray:
    """Distances of two parts at indices of the angles."""
    a, b = (part.corners[index] if len(part.corners) > 1 else part.corners for part in (one, other))
    return _distance(one.part, other.part, a, b)


def _refined(  # noqa: PLR0917
    one: ConvexPart,
    other: ConvexPart,
    sampled: tuple[FloatArray, FloatArray, FloatArray],
    intervals: IntArray,
    best: tuple[float, float],
    allowed: float,
) -> tuple[float, float]:
    """The least distance where intervals that may hold a lesser one are halved: angles, distances, motions."""
    at, distance, moved = sampled
    low, high = at[intervals], at[intervals + 1]
    ends, travel = (distance[intervals], distance[intervals + 1]), moved[intervals]
    for _ in range(HALVINGS):
        open_ = np.flatnonzero((ends[0] + ends[1] - travel) / 2 < min(best[0] - TOLERANCE, allowed))
        if not len(open_):
            break
        low, high, left, right = low[open_], high[open_], ends[0][open_], ends[1][open_]
        middle = (low + high) / 2
        three = [_both(one, other, angle) for angle in (low, middle, high)]
        inner = _distance(one, other, *three[1])
        least = int(np.argmin(inner))
        best = min(best, (float(inner[least]), float(middle[least])))
        halves = [
            sum(np.abs(then - first).max(axis=1) for first, then in zip(three[k], three[k + 1], strict=True))
            for k in (0, 1)
        ]
        ends = np.concatenate([left, inner]), np.concatenate([inner, right])
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])
        travel = np.concatenate(halves)
    return best


def _both(one: ConvexPart, other: ConvexPart, angles: FloatArray) -> tuple[ComplexArray, ComplexArray]:
    a, b = one.corners(angles), other.corners(angles)
    return np.broadcast_to(a, (len(angles), a.shape[1])), np.broadcast_to(b, (len(angles), b.shape[1]))


def _distance(one: ConvexPart, other: ConvexPart, a: ComplexArray, b: ComplexArray) -> FloatArray:
    return np.asarray(between(a, b) - one.radius - other.radius)


def _gap_of_boxes(a: FloatArray, b: FloatArray) -> FloatArray:
    """Distance of boxes [m], a lower bound of that of what is in them; -inf where they overlap."""
    apart = np.maximum(b[:2] - a[2:], a[:2] - b[2:])
    gap = np.hypot(*np.maximum(apart, 0.0))
    return np.where((apart < 0).all(axis=0), -np.inf, gap)
