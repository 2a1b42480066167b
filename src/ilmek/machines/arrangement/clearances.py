"""Least distances of moving bodies over a turn of a cyclogram.

A body consists of convex parts: corners that move, and a radius about them. Between two samples each corner moves on a
straight line, forward only: a track's law is monotonic between its joints, and these are samples. Where two parts are d
and d' apart at two samples, and their corners move by m and m' between them, they are in between nowhere nearer than

    (d + d' - m - m') / 2

[a point that is moved from p to p' by way of q has |p - q| + |q - p'| = |p - p'|]. Intervals whose bound lies below the
least distance found are halved until it does not, so that the result is exact within `TOLERANCE`. On curved paths, of a
linkage, the bound is short by their sagitta between two samples. Overlap counts as a negative distance, the depth.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray
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
    """A convex part of a body: its corners over the turn, and the radius of its edge about them [m]."""

    corners: Corners
    radius: float = 0.0


@record
class MovingBody:
    """A body in a cyclogram.

    windows  angles of the turn between which it is where its parts say [rad]; elsewhere it is out of the loom
    """

    name: str
    parts: tuple[ConvexPart, ...]
    windows: tuple[tuple[float, float], ...] = ((0.0, turn),)


@dataclass(frozen=True, slots=True)
class Clearance:
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
    return ConvexPart(lambda angle: row + displacement(angle)[:, None], radius)


def samples(joints: Iterable[float] = ()) -> FloatArray:
    """Angles of a turn [rad], at most `STEP` apart, the joints of the tracks among them."""
    even = np.linspace(0.0, turn, round(turn / STEP) + 1)
    return np.unique(np.concatenate([even, np.clip(np.fromiter(joints, float), 0.0, turn)]))


def least_clearance(first: MovingBody, second: MovingBody, angles: FloatArray) -> Clearance | None:
    """The least distance of two bodies at and between angles of the turn [rad]; None where they never meet in time."""
    present = np.flatnonzero(_within(first.windows, angles) & _within(second.windows, angles))
    if not len(present):
        return None
    found = [_least(one, other, angles, present) for one in first.parts for other in second.parts]
    value, angle = min(found)
    return Clearance(first.name, second.name, value, angle)


def _within(windows: tuple[tuple[float, float], ...], angles: FloatArray) -> "np.ndarray[tuple[int], np.dtype[np.bool]]":
    inside = np.zeros(len(angles), bool)
    for start, end in windows:
        inside |= (angles >= start - 1e-12) & (angles <= end + 1e-12)
        inside |= angles + turn <= end + 1e-12
    return inside


def _least(one: ConvexPart, other: ConvexPart, angles: FloatArray, present: IntArray) -> tuple[float, float]:
    """The least distance of two parts, and its angle."""
    at = angles[present]
    a, b = one.corners(at), other.corners(at)
    if len(a) == len(b) == 1:
        return float(_distance(one, other, a, b)[0]), float(at[0])
    a, b = (np.broadcast_to(corners, (len(at), corners.shape[1])) for corners in (a, b))
    gap = _box_gap(a, b) - one.radius - other.radius
    nearest = int(np.argmin(gap))
    best = float(_distance(one, other, a[nearest : nearest + 1], b[nearest : nearest + 1])[0])
    moved = np.append(_moved(a) + _moved(b), 0.0)
    near = np.flatnonzero(gap - np.maximum(moved, np.roll(moved, 1)) <= best)
    distance = gap.copy()
    distance[near] = _distance(one, other, a[near], b[near])
    index = int(near[np.argmin(distance[near])])
    neighbours = np.flatnonzero(np.diff(present) == 1)
    return _refined(one, other, (at, distance, moved), neighbours, (float(distance[index]), float(at[index])))


def _refined(
    one: ConvexPart,
    other: ConvexPart,
    sampled: tuple[FloatArray, FloatArray, FloatArray],
    intervals: IntArray,
    best: tuple[float, float],
) -> tuple[float, float]:
    """The least distance where intervals that may hold a lesser one are halved: angles, distances, motions."""
    at, distance, moved = sampled
    low, high = at[intervals], at[intervals + 1]
    ends, travel = (distance[intervals], distance[intervals + 1]), moved[intervals]
    for _ in range(HALVINGS):
        open_ = np.flatnonzero((ends[0] + ends[1] - travel) / 2 < best[0] - TOLERANCE)
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


def _moved(corners: ComplexArray) -> FloatArray:
    """The farthest that a corner moves from each sample to the next [m]."""
    return np.asarray(np.abs(np.diff(corners, axis=0)).max(axis=1))


def _box_gap(a: ComplexArray, b: ComplexArray) -> FloatArray:
    """Distance of the bounding boxes [m], a lower bound of that of the corners' hulls; 0 where they overlap."""
    across = np.maximum(b.real.min(axis=1) - a.real.max(axis=1), a.real.min(axis=1) - b.real.max(axis=1))
    along = np.maximum(b.imag.min(axis=1) - a.imag.max(axis=1), a.imag.min(axis=1) - b.imag.max(axis=1))
    return np.asarray(np.hypot(np.maximum(across, 0.0), np.maximum(along, 0.0)))
