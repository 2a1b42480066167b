"""Convex outlines with round edges: distances of points and outlines, below 0 for penetration.

Corners are counter-clockwise; two corners are a bar with round ends, one is a disc. Functions take any batch shape.
[distances derived from the feet of perpendiculars; penetration by the theorem of separating axes]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, Float
from ilmek.errors import IlmekError
from ilmek.plane.curves import hull
from ilmek.plane.vectors import cross, dot


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """All points within `radius` [m] of the convex hull of the corners [m]. Concave outlines are given as several.

    Raises IlmekError for no corner, a corner that is not finite, or a negative radius.
    >>> Outline((0, 2, 2 + 1j, 1 + 0.2j, 1j)).corners.tolist()
    [0j, (2+0j), (2+1j), 1j]
    """

    corners: Complex[np.ndarray, " corners"]
    radius: float

    def __init__(self, corners: "tuple[complex, ...] | Complex[np.ndarray, ' corners']", radius: float = 0.0) -> None:
        given = np.asarray(corners, dtype=complex)
        if not len(given) or not np.isfinite(given).all():
            raise IlmekError(f"an outline of the corners {list(corners)}", allowed="one or more, all finite")
        if not (np.isfinite(radius) and radius >= 0):
            raise IlmekError(f"an outline of radius {radius} m", allowed="0 or above")
        object.__setattr__(self, "corners", hull(given))
        object.__setattr__(self, "radius", float(radius))

    @property
    def area(self) -> float:
        """Area [m^2]: the polygon of the corners, strips along its edges, and a disc."""
        edges = np.roll(self.corners, -1) - self.corners
        polygon = 0.5 * float(np.sum(cross(self.corners, np.roll(self.corners, -1))))
        return polygon + float(np.sum(np.abs(edges))) * self.radius + np.pi * self.radius**2


def to_segments(
    points: Complex[np.ndarray, "*#batch"], starts: Complex[np.ndarray, "*#batch"], ends: Complex[np.ndarray, "*#batch"]
) -> Float[np.ndarray, "*batch"]:
    """Distance of points from segments [m]; a segment without length is a point.

    >>> to_segments(np.array([3 + 4j]), np.array([0j]), np.array([0j])).tolist()
    [5.0]
    """
    edge, arm = ends - starts, points - starts
    squared = dot(edge, edge)
    share = np.clip(dot(arm, edge) / np.where(squared > 0, squared, 1.0), 0.0, 1.0)
    distance: Float[np.ndarray, "*batch"] = np.abs(arm - share * edge)
    return distance


def to_outline(points: Complex[np.ndarray, "*batch"], outline: Outline) -> Float[np.ndarray, "*batch"]:
    """Distance of points from an outline's edge [m], below 0 inside.

    >>> to_outline(np.array([0.5 + 0.5j, 3 + 0.5j]), Outline((0, 1, 1 + 1j, 1j), 0.1)).round(12).tolist()
    [-0.6, 1.9]
    """
    corners, following = outline.corners, np.roll(outline.corners, -1)
    columns = points[..., None]
    distance = np.min(to_segments(columns, corners, following), axis=-1)
    if len(corners) > 2:
        edges = following - corners
        within = np.all(cross(edges, columns - corners) > 0, axis=-1)
        distance = np.where(within, -distance, distance)
    distance_outside: Float[np.ndarray, "*batch"] = distance - outline.radius
    return distance_outside


def between(
    first: Complex[np.ndarray, "*#batch a"], second: Complex[np.ndarray, "*#batch b"]
) -> Float[np.ndarray, "*batch"]:
    """Distance of two convex polygons by their corners [m]; for overlap minus the penetration depth.

    first, second  corners [m], counter-clockwise; two are a segment, one is a point
    >>> square = np.array([0, 1, 1 + 1j, 1j])
    >>> between(square, square + 3).tolist(), between(square, square + 0.75 + 0.5j).tolist()
    (2.0, -0.25)
    """
    distance_outside = np.minimum(_corners_to_edges(first, second), _corners_to_edges(second, first))
    separation = np.maximum(_separation(first, second), _separation(second, first))
    overlapping = (separation < 0) & np.isfinite(separation)
    distance: Float[np.ndarray, "*batch"] = np.where(overlapping, separation, distance_outside)
    return distance


def between_segments(
    a: Complex[np.ndarray, "*#batch"],
    b: Complex[np.ndarray, "*#batch"],
    c: Complex[np.ndarray, "*#batch"],
    d: Complex[np.ndarray, "*#batch"],
) -> Float[np.ndarray, "*batch"]:
    """Distance of the segments a-b and c-d [m]; where they cross, minus the penetration depth: `between` of segments.

    >>> one, other = np.array([0j, 0j]), np.array([1j, 0.5 - 1j])
    >>> [between_segments(one, one + 2, other, other + end).tolist() for end in (1j, 2j)]
    [[1.0, 0.0], [1.0, -0.5]]
    """
    ends = to_segments(a, c, d), to_segments(b, c, d), to_segments(c, a, b), to_segments(d, a, b)
    outside = np.minimum(np.minimum(ends[0], ends[1]), np.minimum(ends[2], ends[3]))
    separation = np.maximum(_beside(a, b, c, d), _beside(c, d, a, b))
    distance: Float[np.ndarray, "*batch"] = np.where(separation < 0, separation, outside)
    return distance


def _beside(
    a: Complex[np.ndarray, "*#batch"],
    b: Complex[np.ndarray, "*#batch"],
    c: Complex[np.ndarray, "*#batch"],
    d: Complex[np.ndarray, "*#batch"],
) -> Float[np.ndarray, "*batch"]:
    """Separation [m] of the points c and d from the line a-b: below 0 where they are on both sides; 0 for a point."""
    edge = b - a
    length = np.abs(edge)
    first, second = cross(edge, c - a), cross(edge, d - a)
    apart = np.maximum(np.minimum(first, second), -np.maximum(first, second))
    separation: Float[np.ndarray, "*batch"] = apart / np.where(length > 0, length, 1.0)
    return separation


def nearest(first: Complex[np.ndarray, " a"], second: Complex[np.ndarray, " b"]) -> tuple[complex, complex]:
    """The nearest points [m] of two separate convex polygons: one on each.

    >>> nearest(np.array([0, 1, 1 + 1j, 1j]), np.array([3 + 0.5j]))
    ((1+0.5j), (3+0.5j))
    """
    on_second, from_first = _foot(first, second)
    on_first, from_second = _foot(second, first)
    pairs = ((from_first, on_second), (on_first, from_second))
    return min(pairs, key=lambda pair: abs(pair[0] - pair[1]))


def _foot(corners: Complex[np.ndarray, " a"], polygon: Complex[np.ndarray, " b"]) -> tuple[complex, complex]:
    """The point of a polygon's edges nearest to any of the corners, and that corner."""
    starts, edge = polygon[None, :], (np.roll(polygon, -1) - polygon)[None, :]
    arm, squared = corners[:, None] - starts, dot(edge, edge)
    feet = starts + np.clip(dot(arm, edge) / np.where(squared > 0, squared, 1.0), 0.0, 1.0) * edge
    at = np.unravel_index(np.argmin(np.abs(corners[:, None] - feet)), feet.shape)
    return complex(feet[at]), complex(corners[at[0]])


def _corners_to_edges(
    first: Complex[np.ndarray, "*#batch a"], second: Complex[np.ndarray, "*#batch b"]
) -> Float[np.ndarray, "*batch"]:
    starts, ends = second[..., None, :], np.roll(second, -1, axis=-1)[..., None, :]
    return np.asarray(np.min(to_segments(first[..., :, None], starts, ends), axis=(-2, -1)))


def _separation(
    first: Complex[np.ndarray, "*#batch a"], second: Complex[np.ndarray, "*#batch b"]
) -> Float[np.ndarray, "*batch"]:
    """Greatest separation [m] along the normals of the first's edges, below 0 for none; -inf for a point."""
    edges = np.roll(first, -1, axis=-1) - first
    lengths = np.abs(edges)
    arms = second[..., None, :] - first[..., :, None]
    with np.errstate(invalid="ignore", divide="ignore"):
        outward = -cross(edges[..., None], arms) / lengths[..., None]
    least = np.where(lengths > 0, np.min(outward, axis=-1), -np.inf)
    return np.asarray(np.max(least, axis=-1))
