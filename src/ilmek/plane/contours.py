"""Closed contours of straight pieces and arcs: area, length, points, and common contours of plates.

The piece from p to q with the bulge b = tan(sweep/4) is the arc of radius |q - p| (1 + b^2)/(4 |b|), left of the chord
where b < 0 and right of it where b > 0; b = 1 is a half turn to the left. Points, radii and lengths are in m.
[bulge: the convention of DXF polylines; the formulas are derived from the circle's chord and sweep]
"""

import cmath
import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.plane.curves import hull
from ilmek.plane.vectors import cross, dot, following
from ilmek.report import Contour, Hole
from ilmek.units import format_quantity

STRAIGHT = 1e-8
"""Bulge below which a piece counts as straight: the centre is too far away for double precision."""

_NEARLY_STRAIGHT = 1e-2
"""Bulge below which the area of a circular segment is computed by its series."""


@lru_cache(maxsize=1024)
def circle(at: complex, radius: float) -> Contour:
    """A circle about `at` [m], of two half turns.

    >>> round(area(circle(1j, 0.5)) / math.pi, 12)
    0.25
    """
    return Contour(np.array([at + radius, at - radius]), np.ones(2))


def as_hole(contour: Contour) -> Hole | None:
    """The round hole that a contour of two half turns is; None: it is no circle.

    >>> as_hole(circle(1j, 0.5)), as_hole(keyed_bore(0.010, 0.006, 0.0028))
    (Hole(at=1j, radius=0.5, label=''), None)
    """
    if len(contour.points) != 2 or np.any(np.abs(np.abs(contour.bulges) - 1) > STRAIGHT):
        return None
    first, second = contour.points.tolist()
    return Hole((first + second) / 2, abs(second - first) / 2)


def polygon(corners: Complex[np.ndarray, " corners"]) -> Contour:
    """Straight pieces from corner to corner [m]."""
    return Contour(np.asarray(corners, dtype=complex), np.zeros(len(corners)))


def rounded_hull(corners: Complex[np.ndarray, " corners"], radius: float) -> Contour:
    """All points within `radius` [m] of the convex hull of the corners [m]: two corners give a bar with round ends.

    Raises ParameterError for a radius that is not above 0.
    >>> bar = rounded_hull(np.array([0, 0.2 + 0j]), 0.02)
    >>> round(area(bar), 12) == round(0.2 * 0.04 + math.pi * 0.02**2, 12)
    True
    """
    if not radius > 0:
        raise ParameterError(f"an edge of radius {format_quantity(radius, 'mm')}", allowed="above 0 mm")
    around = hull(corners)
    if len(around) == 1:
        return circle(complex(around[0]), radius)
    edges = np.roll(around, -1) - around
    outward = -1j * edges / np.abs(edges)
    before = np.roll(outward, 1)
    points = np.stack([around + radius * before, around + radius * outward], axis=1).ravel()
    turns = np.angle(outward / before)
    if (straight := np.abs(turns) < _STRAIGHT).any():
        return rounded_hull(around[~straight], radius)
    turns %= 2 * math.pi
    bulges = np.stack([np.tan(turns / 4), np.zeros(len(around))], axis=1).ravel()
    return Contour(points, bulges)


_STRAIGHT = 1e-9
"""Turn of an outline [rad] below which it has no corner: of collinear corners, by rounding."""


def slotted(outline: Contour, end: complex, outwards: complex, half: float) -> Contour:
    """A convex counter-clockwise contour with a slot from a point in it to its edge, round at its end [m].

    end  centre of the slot's round end      outwards  direction to the edge, of any length      half  of its width

    Raises ParameterError where the slot does not leave the contour by two points of its edge.
    >>> plate = slotted(polygon(np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])), 0j, 1 + 0j, 0.5)
    >>> round(area(plate), 12) == round(4 - 1 - math.pi * 0.25 / 2, 12)
    True
    """
    turned = outwards / abs(outwards)
    points = (outline.points - end) / turned
    sides = [crossing for side in (-half, half) if (crossing := _crossing(points, outline.bulges, side)) is not None]
    if len(sides) < 2:
        raise ParameterError(f"a slot {format_quantity(2 * half, 'mm')} wide beside its plate", do="set a wider plate")
    (last, low, before), (first, high, after) = (own[:3] for own in sides)
    kept = (first + 1 + np.arange((last - first - 1) % len(points) + 1)) % len(points)
    corners = np.concatenate([[high], points[kept], [low, -1j * half, 1j * half]])
    bulges = np.concatenate([[after[1]], outline.bulges[kept[:-1]], [before[0], 0.0, -1.0, 0.0]])
    return Contour(end + turned * corners, bulges)


def _crossing(points: ComplexArray, bulges: FloatArray, side: float) -> tuple[int, complex, tuple[float, float]] | None:
    """Where a convex contour crosses y = side at x > 0: number of its piece, point, bulges of the piece's two parts."""
    for piece, (start, stop, bulge) in enumerate(
        zip(points.tolist(), following(points).tolist(), bulges.tolist(), strict=True)
    ):
        if abs(bulge) < STRAIGHT:
            share = (side - start.imag) / (stop.imag - start.imag) if stop.imag > start.imag else math.inf
            crossed = start + share * (stop - start) if 0 <= share < 1 else complex(math.nan)
            parts = (0.0, 0.0)
        else:
            centre = arc_centre(start, stop, bulge)
            radius, up = abs(start - centre), side - centre.imag
            crossed = centre + complex(math.sqrt(radius**2 - up**2), up) if abs(up) < radius else complex(math.nan)
            sweep = 4 * math.atan(bulge)
            passed = cmath.phase((crossed - centre) / (start - centre)) % (2 * math.pi)
            if not 0 <= passed < sweep:
                continue
            parts = (math.tan(passed / 4), math.tan((sweep - passed) / 4))
        if crossed.real > 0:
            return piece, crossed, parts
    return None


def keyed_bore(radius: float, width: float, depth: float, number: int = 1) -> Contour:
    """A bore about the origin with a keyway that opens towards +x [m], `depth` beyond the bore's circle.

    A negative depth gives a shaft with its groove. Several keyways are evenly spread.

    Raises ParameterError for a keyway as wide as the bore.
    >>> bore = keyed_bore(0.010, 0.006, 0.0028)
    >>> float(bore.points.real.max().round(6)), len(bore.points)
    (0.0128, 4)
    """
    if not 0 < width < 2 * radius:
        given, allowed = (format_quantity(value, "mm") for value in (width, 2 * radius))
        raise ParameterError(f"a keyway {given} wide", allowed=f"above 0 mm, less than the bore of {allowed}")
    half = width / 2
    at = math.sqrt(radius**2 - half**2)
    step, far = np.exp(2j * math.pi / number), radius + depth
    one = np.array([at + 1j * half, step * (at - 1j * half), step * (far - 1j * half), step * (far + 1j * half)])
    sweep = 2 * (math.pi / number - math.asin(half / radius))
    points = np.concatenate([step**k * one for k in range(number)])
    return Contour(points, np.tile([math.tan(sweep / 4), 0.0, 0.0, 0.0], number))


class KeyedCircle(NamedTuple):
    """A circle with keyways: centre, radius, width of each, distance of its floor from the centre [m], directions."""

    centre: complex
    radius: float
    width: float
    floor: float
    directions: tuple[complex, ...]


def as_keyed(contour: Contour) -> KeyedCircle | None:
    """The bore or shaft with keyways that a contour is; None: it is none, as an eye whose groove is as wide as it.

    >>> as_keyed(keyed_bore(0.010, 0.006, 0.0028)).width, as_keyed(circle(0j, 0.01))
    (0.006, None)
    >>> as_keyed(Contour(np.array([-1j, 2 - 1j, 2 + 1j, 1j]), np.array([0.0, 0.0, 0.0, 1.0])))
    """
    points, after, bulges = contour.points, following(contour.points), contour.bulges
    arcs = np.flatnonzero(np.abs(bulges) >= STRAIGHT)
    if not len(arcs) or len(points) != 4 * len(arcs):
        return None
    centres = [arc_centre(complex(points[k]), complex(after[k]), float(bulges[k])) for k in arcs]
    floors = (arcs + 2) % len(points)  # after an arc and the side of a groove
    out, across = (points[floors] + after[floors]) / 2 - centres[0], after[floors] - points[floors]
    radii = np.abs(points - centres[0])
    circles = np.ptp(np.delete(radii, np.concatenate([floors, (floors + 1) % len(points)]))) + np.ptp(centres)
    spread = np.ptp(np.abs(out)) + np.ptp(np.abs(across)) + float(np.max(np.abs(dot(out, across))))
    wide = float(np.abs(across[0])) > 2 * radii[arcs[0]] * (1 - _SAME)
    if wide or circles + spread > _SAME * radii[arcs[0]]:
        return None
    width, floor = float(np.abs(across[0])), float(np.abs(out[0]))
    return KeyedCircle(centres[0], float(radii[arcs[0]]), width, floor, tuple((out / floor).tolist()))


_SAME = 1e-6
"""Deviation over the radius that counts as rounding."""


def counter_clockwise(contour: Contour) -> Contour:
    """The same contour with counter-clockwise direction.

    >>> counter_clockwise(polygon(np.array([0, 1j, 1 + 1j]))).points.tolist()
    [(1+1j), 1j, 0j]
    """
    if area(contour) >= 0:
        return contour
    return Contour(contour.points[::-1], -np.roll(contour.bulges[::-1], -1))


@lru_cache(maxsize=1024)
def area(contour: Contour) -> float:
    """Enclosed area [m^2], negative for a clockwise contour.

    The polygon of the corners, and for each arc the circular segment R^2 (sweep - sin sweep)/2.
    """
    points = contour.points
    corners = points - points[0]
    flat = 0.5 * float(np.sum(cross(corners, following(corners))))
    if not contour.bulges.any():
        return flat
    return flat + float(np.sum(_slivers(np.abs(following(points) - points), contour.bulges)))


def polygon_moments(corners: Complex[np.ndarray, " corners"]) -> tuple[float, float]:
    """Area [m^2] and polar moment about the origin [m^4] of a polygon, of the triangles that its edges make with it.

    Both are negative where the corners run clockwise.
    >>> area, polar = polygon_moments(np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j]))
    >>> area, round(polar, 12)
    (4.0, 2.666666666667)
    """
    after = following(corners)
    twice = cross(corners, after)
    polar = twice * (dot(corners, corners) + dot(corners, after) + dot(after, after)) / 12
    return float(np.sum(twice) / 2), float(np.sum(polar))


def _slivers(chord: Float[np.ndarray, " pieces"], bulge: Float[np.ndarray, " pieces"]) -> Float[np.ndarray, " pieces"]:
    """Areas between arcs and chords [m^2]; c^2 (b/3 + b^3/15 - b^5/105) for small b, without cancellation."""
    small = np.abs(bulge) < _NEARLY_STRAIGHT
    b = np.where(small, 1.0, bulge)
    radius, sweep = chord * (1 + b**2) / (4 * b), 4 * np.arctan(b)
    series = chord**2 * (bulge / 3 + bulge**3 / 15 - bulge**5 / 105)
    return np.asarray(np.where(small, series, 0.5 * radius**2 * (sweep - np.sin(sweep))))


def length(contour: Contour) -> float:
    """Length of the contour [m]: chord (1 + b^2) atan(b)/b for each piece."""
    chord = np.abs(following(contour.points) - contour.points)
    b = np.where(contour.bulges == 0, 1.0, contour.bulges)
    longer = np.where(contour.bulges == 0, 1.0, (1 + b**2) * np.arctan(b) / b)
    return float(np.sum(chord * longer))


def along(contour: Contour, chord_error: float) -> Complex[np.ndarray, " points"]:
    """Points on the contour [m], including its own, with a deviation of their polyline of at most `chord_error` [m].

    The deviation of n chords over the sweep is R (1 - cos(sweep/2n)).
    """
    if not contour.bulges.any():
        return contour.points.astype(complex)
    parts, ends = [], following(contour.points)
    for start, end, bulge in zip(contour.points.tolist(), ends.tolist(), contour.bulges.tolist(), strict=True):
        pieces = _chords(abs(end - start), abs(bulge), chord_error)
        parts.append([start] if pieces == 1 else on_piece(start, end, bulge, np.arange(pieces) / pieces))
    return np.concatenate(parts)


def _chords(chord: float, bulge: float, chord_error: float) -> int:
    """Number of chords of an arc; one where its sagitta b c/2 is within the error, of half a turn and more two."""
    if bulge * chord / 2 <= chord_error:
        return 2 if bulge >= 1 - STRAIGHT else 1
    radius = chord * (1 + bulge**2) / (4 * bulge)
    return math.ceil(2 * math.atan(bulge) / math.acos(max(0.0, 1 - chord_error / radius)))


def on_piece(start: complex, end: complex, bulge: float, share: FloatArray) -> Complex[np.ndarray, " points"]:
    """Points [m] at fractions u from 0 to 1 of the length of an arc or a straight piece.

        p + (q - p) e^{-i (1 - u) a} sin(u a)/sin(a),   a = sweep/2 = 2 atan b

    >>> on_piece(0j, 2 + 0j, 1.0, np.array([0.5])).round(12).tolist()
    [(1-1j)]
    """
    half = 2 * math.atan(bulge)
    if abs(bulge) < STRAIGHT:
        return np.asarray(start + share * (end - start))
    return np.asarray(start + (end - start) * np.exp(-1j * half * (1 - share)) * np.sin(half * share) / math.sin(half))


def arc_centre(start: complex, end: complex, bulge: float) -> complex:
    """Centre [m] of an arc: on the perpendicular of its chord, (1 - b^2)/(4 b) chords to the left.

    >>> arc_centre(0j, 2 + 0j, 1.0)
    (1+0j)
    """
    return (start + end) / 2 + 1j * (end - start) * (1 - bulge**2) / (4 * bulge)


@lru_cache(maxsize=1024)
def bounds(contour: Contour) -> tuple[complex, complex]:
    """Lower left and upper right corner [m] of the bounding box, with the extremes of arcs.

    >>> bounds(circle(1 + 0j, 1.0))
    (-1j, (2+1j))
    """
    reached, ends = [contour.points], following(contour.points)
    for piece in np.flatnonzero(np.abs(contour.bulges) >= STRAIGHT):
        start, end, bulge = contour.points[piece], ends[piece], contour.bulges[piece]
        if start != end:
            centre = arc_centre(complex(start), complex(end), float(bulge))
            summits = centre + abs(start - centre) * np.array([1, 1j, -1, -1j])
            sweep = 4 * math.atan(bulge)
            turned = np.angle((summits - centre) / (start - centre)) * math.copysign(1.0, bulge) % (2 * math.pi)
            reached.append(summits[turned <= abs(sweep)])
    points = np.concatenate(reached)
    return complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max())


def strip(nodes: Complex[np.ndarray, " nodes"], radius: float) -> Contour:
    """All points within `radius` [m] of a line of straight pieces from node to node, its inner corners sharp.

    Raises ParameterError for fewer than two nodes, a radius that is not above 0, and pieces too short for the radius at
    their corners.
    >>> bar = strip(np.array([0, 0.2 + 0j]), 0.02)
    >>> round(area(bar), 12) == round(0.2 * 0.04 + math.pi * 0.02**2, 12)
    True
    """
    if len(nodes) < 2 or not radius > 0:
        raise ParameterError(f"a strip of {len(nodes)} nodes and radius {radius:g} m", allowed="two or more; above 0 m")
    pieces = np.diff(nodes)
    direction = pieces / np.abs(pieces)
    half = np.angle(direction[1:] / direction[:-1]) / 2
    if np.any(radius * np.tan(np.abs(half)) > np.minimum(np.abs(pieces[1:]), np.abs(pieces[:-1]))):
        raise ParameterError("a strip with pieces shorter than its corners", do="set longer pieces or a smaller radius")
    right = _strip_side(nodes, direction, radius)
    left = _strip_side(nodes[::-1], -direction[::-1], radius)
    points, bulges = zip(*right, *left, strict=True)
    return Contour(np.array(points), np.array(bulges))


def _strip_side(nodes: ComplexArray, direction: ComplexArray, radius: float) -> list[tuple[complex, float]]:
    """Points of the right side of a strip from its first node to its last, and the bulge of the piece after each."""
    side = [(nodes[0] - 1j * radius * direction[0], 0.0)]
    for node, before, after in zip(nodes[1:-1], direction[:-1], direction[1:], strict=True):
        turned = float(np.angle(after / before))
        if turned > 0:
            side += [(node - 1j * radius * before, math.tan(turned / 4)), (node - 1j * radius * after, 0.0)]
        else:
            inner = (before + after) / abs(before + after) / math.cos(turned / 2)
            side.append((node - 1j * radius * inner, 0.0))
    return [*side, (nodes[-1] - 1j * radius * direction[-1], 1.0)]
