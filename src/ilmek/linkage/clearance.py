"""Clearance: the least distance of two bodies over a mechanism's way, and where they run into each other.

Bodies are given by convex outlines with round edges; a hollow one by several. Local minima are found between samples
and polished; where the clearance is below zero, the ends of the interference are roots, polished to rounding.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.configuration_path import ConfigurationPath, spaced
from ilmek.linkage.model import Mechanism
from ilmek.num.brackets import bracketed_minima, bracketed_roots
from ilmek.plane.outlines import Outline, between, nearest

BETWEEN = 8
"""Samples between neighbouring breaks of the way."""


@dataclass(frozen=True, slots=True)
class Clearance:
    """The least clearance of two bodies over a way.

    least          distance [m]; below 0 the bodies overlap, and have to be moved by so much to part
    place, input   where: on the way, and the input's value there [rad, m]
    points         the nearest points in the world [m], on the first body and on the second; NaN where they overlap
    interference   input's values at the ends of each stretch in which they overlap, in the order of the way
    """

    least: float
    place: float
    input: float
    points: tuple[complex, complex]
    interference: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class OutlinedBody:
    """A body with its outlines, in its frame."""

    body: str
    outlines: tuple[Outline, ...]


def outlined(mechanism: Mechanism, body: str, radius: float) -> OutlinedBody:
    """A body as the hull of its points with a round edge of the radius [m]: a link by its pins and half its width.

    Raises MechanismError for an unknown body, or one without points.
    """
    points = tuple(mechanism.body(body).points.values())
    if not points:
        raise MechanismError(f"body {body!r} of {mechanism.name} has no points", do="give its outline")
    return OutlinedBody(body, (Outline(points, radius),))


def distances(
    way: ConfigurationPath, first: OutlinedBody, second: OutlinedBody, places: FloatArray
) -> Float[np.ndarray, " places"]:
    """Distance of two bodies at places of a way [m], below 0 where they overlap."""
    bodies = way.bodies(places)
    pairs = []
    for one in first.outlines:
        for other in second.outlines:
            corners = [
                _corners(bodies, placed.body, outline, len(places))
                for placed, outline in ((first, one), (second, other))
            ]
            pairs.append(between(corners[0], corners[1]) - one.radius - other.radius)
    least: Float[np.ndarray, " places"] = np.min(np.stack(pairs), axis=0)
    return least


def clearance(way: ConfigurationPath, first: OutlinedBody, second: OutlinedBody) -> Clearance:
    """The least clearance of two bodies over a way, and the stretches in which they overlap.

    Raises MechanismError for an unknown body, or one and the same.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.structure import plan
    >>> from ilmek.linkage.configuration_path import InputPath
    >>> mechanism = four_bar(0.300, 0.060, 0.200, 0.230, branch=+1)
    >>> post = OutlinedBody("ground", (Outline((0.1,), 0.005),))
    >>> found = clearance(InputPath(one_input(plan(mechanism))), outlined(mechanism, "crank", 0.010), post)
    >>> round(found.least, 9), round(found.input, 6) + 0.0
    (0.025, 0.0)
    """
    if first.body == second.body:
        raise MechanismError(f"clearance of {first.body!r} from itself", do="name two bodies")
    for placed in (first, second):
        way.mechanism.body(placed.body)

    def apart(places: FloatArray) -> FloatArray:
        return distances(way, first, second, places)

    places = spaced(way.breaks, BETWEEN)
    low = _minima(apart, places, closed=way.closed)
    every = np.unique(np.concatenate([places, low]))
    values = apart(every)
    least = int(np.argmin(values))
    place = every[least : least + 1]
    points = _nearest(way, first, second, place) if values[least] > 0 else (complex("nan"), complex("nan"))
    ends = _interference(apart, every, values, closed=way.closed)
    stretches = tuple((float(a), float(b)) for a, b in way.inputs(ends.ravel()).reshape(-1, 2)) if len(ends) else ()
    return Clearance(float(values[least]), float(place[0]), float(way.inputs(place)[0]), points, stretches)


def _corners(
    bodies: Mapping[str, BodyMotion], body: str, outline: Outline, count: int
) -> Complex[np.ndarray, "count corners"]:
    """An outline's corners in the world."""
    motion = bodies[body]
    origin, direction = motion.carry(0j).position, motion.direction
    placed = (
        np.broadcast_to(origin, (count,))[:, None] + np.broadcast_to(direction, (count,))[:, None] * outline.corners
    )
    return np.asarray(placed, dtype=complex)


def _minima(
    apart: Callable[[FloatArray], FloatArray], places: FloatArray, *, closed: bool
) -> Float[np.ndarray, " minima"]:
    """Local minima between samples, by golden sections all at once; at an open way's ends there are samples."""
    value = apart(places)
    inner = np.flatnonzero((value[1:-1] <= value[:-2]) & (value[1:-1] <= value[2:])) + 1
    low, high = places[inner - 1], places[inner + 1]
    if closed and value[0] <= value[1] and value[0] <= value[-2]:
        low, high = np.append(low, places[0]), np.append(high, places[1])
        low, high = np.append(low, places[-2]), np.append(high, places[-1])
    if not len(low):
        return np.empty(0)
    return bracketed_minima(apart, low, high)[0]


def _interference(
    apart: Callable[[FloatArray], FloatArray], places: FloatArray, values: FloatArray, *, closed: bool
) -> Float[np.ndarray, "stretches 2"]:
    """Places at which each stretch of overlap begins and ends; on a closed way one may run past its end."""
    inside = values < 0
    if inside.all() or not inside.any():
        return np.array([[places[0], places[-1]]]) if inside.any() else np.empty((0, 2))
    entering, leaving = np.flatnonzero(~inside[:-1] & inside[1:]), np.flatnonzero(inside[:-1] & ~inside[1:])
    starts, stops = (
        bracketed_roots(apart, places[k], places[k + 1]) if len(k) else np.empty(0) for k in (entering, leaving)
    )
    if inside[0] and not (closed and inside[-1]):
        starts = np.append(places[0], starts)
    if inside[-1] and not (closed and inside[0]):
        stops = np.append(stops, places[-1])
    if closed and inside[0] and inside[-1]:
        starts = np.roll(starts, 1)
    return np.stack([starts, stops], axis=1)


def _nearest(
    way: ConfigurationPath, first: OutlinedBody, second: OutlinedBody, place: FloatArray
) -> tuple[complex, complex]:
    """The nearest points on both bodies."""
    bodies = way.bodies(place)
    found = []
    for one in first.outlines:
        for other in second.outlines:
            p, q = nearest(*(_corners(bodies, *pair, 1)[0] for pair in ((first.body, one), (second.body, other))))
            towards = (q - p) / abs(q - p) if p != q else 0j
            found.append((p + one.radius * towards, q - other.radius * towards))
    return min(found, key=lambda pair: abs(pair[1] - pair[0]))
