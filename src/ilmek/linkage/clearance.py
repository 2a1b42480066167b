"""Clearance: the least distance of two bodies over a mechanism's path, and their interference.

Bodies are given by convex outlines with round edges; concave bodies by several. Local minima are bracketed by samples
and refined. Where the clearance is below zero, the ends of the interference are roots, refined to rounding.

    clearance = (distance of the polygons' nearest corners and edges) - r_1 - r_2       [derived: distance of segments]
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
"""Samples between neighbouring breaks of the path."""


@dataclass(frozen=True, slots=True)
class Clearance:
    """The least clearance of two bodies over a path.

    least             distance [m]; below 0 the penetration depth of overlapping bodies
    parameter, input  of the minimum: parameter of the path, and value of the input [rad, m]
    points            the nearest points in the world [m], on the first body and on the second; NaN for overlap
    interference      values of the input [rad, m] at the ends of each interval of overlap, in the order of the path
    """

    least: float
    parameter: float
    input: float
    points: tuple[complex, complex]
    interference: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class OutlinedBody:
    """A body with its outlines [m] in the body's frame."""

    body: str
    outlines: tuple[Outline, ...]


def outlined(mechanism: Mechanism, body: str, radius: float) -> OutlinedBody:
    """A body as the hull of its points with round edges of a radius [m]: for a link its pins and half its width.

    Raises MechanismError for an unknown body, or one without points.
    """
    points = tuple(mechanism.body(body).points.values())
    if not points:
        raise MechanismError(f"body {body!r} of {mechanism.name} has no points", do="give its outline")
    return OutlinedBody(body, (Outline(points, radius),))


def distances(
    path: ConfigurationPath, first: OutlinedBody, second: OutlinedBody, parameters: FloatArray
) -> Float[np.ndarray, " parameters"]:
    """Distance of two bodies [m] at parameters of a path, (parameters,); below 0 for overlap."""
    bodies = path.bodies(parameters)
    pairs = []
    for one in first.outlines:
        for other in second.outlines:
            corners = [
                _corners(bodies, placed.body, outline, len(parameters))
                for placed, outline in ((first, one), (second, other))
            ]
            pairs.append(between(corners[0], corners[1]) - one.radius - other.radius)
    least: Float[np.ndarray, " parameters"] = np.min(np.stack(pairs), axis=0)
    return least


def clearance(path: ConfigurationPath, first: OutlinedBody, second: OutlinedBody) -> Clearance:
    """The least clearance of two bodies over a path, and the intervals of overlap.

    Raises MechanismError for an unknown body, or the same body twice.
    path  with its input in [rad; m]      first, second  outlines in the bodies' frames [m]
    Returns the least distance [m], below 0 for overlap, its input and nearest points; NaN points where they overlap.

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
        path.mechanism.body(placed.body)

    def apart(parameters: FloatArray) -> FloatArray:
        return distances(path, first, second, parameters)

    parameters = spaced(path.breaks, BETWEEN)
    low = _minima(apart, parameters, closed=path.closed)
    every = np.unique(np.concatenate([parameters, low]))
    values = apart(every)
    least = int(np.argmin(values))
    parameter = every[least : least + 1]
    points = _nearest(path, first, second, parameter) if values[least] > 0 else (complex("nan"), complex("nan"))
    ends = _interference(apart, every, values, closed=path.closed)
    stretches = tuple((float(a), float(b)) for a, b in path.inputs(ends.ravel()).reshape(-1, 2)) if len(ends) else ()
    return Clearance(float(values[least]), float(parameter[0]), float(path.inputs(parameter)[0]), points, stretches)


def _corners(
    bodies: Mapping[str, BodyMotion], body: str, outline: Outline, count: int
) -> Complex[np.ndarray, "count corners"]:
    """An outline's corners in the world [m]."""
    motion = bodies[body]
    origin, direction = motion.carry(0j).position, motion.direction
    placed = (
        np.broadcast_to(origin, (count,))[:, None] + np.broadcast_to(direction, (count,))[:, None] * outline.corners
    )
    return np.asarray(placed, dtype=complex)


def _minima(
    apart: Callable[[FloatArray], FloatArray], parameters: FloatArray, *, closed: bool
) -> Float[np.ndarray, " minima"]:
    """Local minima between samples, by simultaneous golden sections; the ends of an open path are samples."""
    value = apart(parameters)
    inner = np.flatnonzero((value[1:-1] <= value[:-2]) & (value[1:-1] <= value[2:])) + 1
    low, high = parameters[inner - 1], parameters[inner + 1]
    if closed and value[0] <= value[1] and value[0] <= value[-2]:
        low, high = np.append(low, parameters[0]), np.append(high, parameters[1])
        low, high = np.append(low, parameters[-2]), np.append(high, parameters[-1])
    if not len(low):
        return np.empty(0)
    return bracketed_minima(apart, low, high)[0]


def _interference(
    apart: Callable[[FloatArray], FloatArray], parameters: FloatArray, values: FloatArray, *, closed: bool
) -> Float[np.ndarray, "stretches 2"]:
    """Parameters at the ends of each interval of overlap; on a closed path one may extend past the end."""
    inside = values < 0
    if inside.all() or not inside.any():
        return np.array([[parameters[0], parameters[-1]]]) if inside.any() else np.empty((0, 2))
    entering, leaving = np.flatnonzero(~inside[:-1] & inside[1:]), np.flatnonzero(inside[:-1] & ~inside[1:])
    starts, stops = (
        bracketed_roots(apart, parameters[k], parameters[k + 1]) if len(k) else np.empty(0) for k in (entering, leaving)
    )
    if inside[0] and not (closed and inside[-1]):
        starts = np.append(parameters[0], starts)
    if inside[-1] and not (closed and inside[0]):
        stops = np.append(stops, parameters[-1])
    if closed and inside[0] and inside[-1]:
        starts = np.roll(starts, 1)
    return np.stack([starts, stops], axis=1)


def _nearest(
    path: ConfigurationPath, first: OutlinedBody, second: OutlinedBody, parameter: FloatArray
) -> tuple[complex, complex]:
    """The nearest points on both bodies."""
    bodies = path.bodies(parameter)
    found = []
    for outline in first.outlines:
        for other in second.outlines:
            p, q = nearest(*(_corners(bodies, *pair, 1)[0] for pair in ((first.body, outline), (second.body, other))))
            towards = (q - p) / abs(q - p) if p != q else 0j
            found.append((p + outline.radius * towards, q - other.radius * towards))
    return min(found, key=lambda pair: abs(pair[1] - pair[0]))
