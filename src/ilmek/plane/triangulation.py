"""Triangles of a polygon with holes: ears are clipped, after each hole is joined to the outline by a double edge.

An ear is a corner that turns left and whose triangle contains no corner that turns right.
[Meisters 1975: every polygon has two ears; Eberly, Triangulation by Ear Clipping: the joining of holes]
"""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import BoolArray, Complex, ComplexArray, Int, IntArray
from ilmek.errors import IlmekError
from ilmek.plane.vectors import cross

_LEVEL = 1e-9
"""Slope below which a line counts as level."""

_SAME = 1e-6
"""Difference of areas that counts as rounding, over the area."""

_CROSSES, _CURE = "an outline crosses itself", "check the plate's outline and its holes"


def triangles(
    outline: Complex[np.ndarray, " corners"], holes: Sequence[ComplexArray] = ()
) -> Int[np.ndarray, "triangles 3"]:
    """Triangles, counter-clockwise, of the corners of the outline and then of the holes, numbered in this order.

    outline  counter-clockwise [m]      holes  inside it, clockwise, apart from each other [m]
    Raises IlmekError where the outline crosses itself or a hole.

    >>> square = np.array([0, 2, 2 + 2j, 2j])
    >>> len(triangles(square)), len(triangles(square, [np.array([0.5 + 0.5j, 0.5 + 1j, 1 + 1j])]))
    (2, 7)
    """
    points = np.concatenate([outline, *holes])
    ring = np.arange(len(outline))
    first = np.cumsum([len(outline), *map(len, holes)])
    loops = [np.arange(begin, begin + len(hole)) for begin, hole in zip(first, holes, strict=False)]
    for loop in sorted(loops, key=lambda one: -float(points[one].real.max())):
        ring = _joined(points, ring, loop)
    found = _clipped(points, ring)
    one, two, three = points[found].T
    covered, within = cross(two - one, three - one), cross(points[ring], np.roll(points[ring], -1))
    if abs(float(np.sum(np.abs(covered)) - np.sum(within))) > _SAME * float(np.sum(np.abs(within))):
        raise IlmekError(_CROSSES, do=_CURE)
    return found


def _joined(points: ComplexArray, ring: IntArray, loop: IntArray) -> IntArray:
    """The ring with a hole, both joined at the hole's rightmost corner and a corner of the ring that it sees."""
    start = int(np.argmax(points[loop].real))
    corner = points[loop[start]]
    number = _seen(points[ring], complex(corner))
    turned = np.roll(loop, -start)
    return np.concatenate([ring[: number + 1], turned, turned[:1], ring[number:]])


def _seen(ring: ComplexArray, corner: complex) -> int:
    """The number of a point of the ring that is seen from a corner inside it, to the right."""
    following = np.roll(ring, -1)
    low, high = ring.imag, following.imag
    crossed = (low <= corner.imag) & (high > corner.imag)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = ring.real + (corner.imag - low) / (high - low) * (following.real - ring.real)
    right = np.flatnonzero(crossed & (at >= corner.real))
    if not len(right):
        raise IlmekError("a hole lies outside of its outline", do=_CURE)
    edge = int(right[np.argmin(at[right])])
    hit = complex(float(at[edge]), corner.imag)
    best = edge if ring[edge].real > following[edge].real else (edge + 1) % len(ring)
    if abs(ring[best].imag - corner.imag) <= _LEVEL * abs(hit - corner):
        return best
    corners = np.array([corner, hit, ring[best]])
    if cross(corners[1] - corners[0], corners[2] - corners[0]) < 0:
        corners = corners[::-1]
    inside = _within(ring, corners) & (ring != ring[best])
    between = np.flatnonzero(inside)
    if len(between):
        from_corner = ring[between] - corner
        steep = np.abs(from_corner.imag) / np.maximum(from_corner.real, 1e-300)
        best = int(between[np.lexsort((np.abs(from_corner), steep))[0]])
    return best


def _within(points: ComplexArray, corners: ComplexArray) -> BoolArray:
    """Whether points lie in a counter-clockwise triangle or on its edges."""
    inside = np.ones(points.shape, bool)
    for one, other in zip(corners, np.roll(corners, -1), strict=True):
        inside &= cross(other - one, points - one) >= 0
    return inside


def _clipped(points: ComplexArray, ring: IntArray) -> IntArray:
    """The triangles of a ring of points that may touch itself along double edges."""
    at = points[ring]
    before, after = np.roll(np.arange(len(ring)), 1), np.roll(np.arange(len(ring)), -1)
    reflex = np.asarray(cross(at - at[before], at[after] - at) <= 0)
    found, now, tried, count = [], 0, 0, len(ring)
    while count > 3:
        one, other = int(before[now]), int(after[now])
        if not reflex[now] and _is_ear(at, reflex, (one, now, other)):
            found.append((ring[one], ring[now], ring[other]))
            after[one], before[other] = other, one
            reflex[now] = False
            for near in (one, other):
                turned = cross(at[near] - at[before[near]], at[after[near]] - at[near])
                reflex[near] = turned <= 0
            count, tried, now = count - 1, 0, int(after[other])
        else:
            tried, now = tried + 1, other
            if tried > count:
                raise IlmekError(_CROSSES, do=_CURE)
    found.append((ring[before[now]], ring[now], ring[after[now]]))
    return np.array(found)


def _is_ear(at: ComplexArray, reflex: BoolArray, corners: tuple[int, int, int]) -> bool:
    """Whether no corner that turns right lies in the triangle of three corners, but where they are these points."""
    triangle = at[list(corners)]
    others = at[np.flatnonzero(reflex)]
    near = others[_within(others, triangle)]
    return bool(np.isin(near, triangle).all())
