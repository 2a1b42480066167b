"""Parts of turned shapes and keyed ends about one axis: drawn as one turned part, with the view on its end."""

import math
from collections import defaultdict
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, Turned
from ilmek.part.tolerances import FeatureKind
from ilmek.plane.contours import KeyedCircle, along, area, as_hole, as_keyed, bounds, circle, polygon
from ilmek.records import record
from ilmek.report import Contour
from ilmek.report.sheet import DimensionKind, LineKind
from ilmek.viz.drawings.features import SAME, distinct
from ilmek.viz.drawings.fits import Fits
from ilmek.viz.drawings.flat import keyed_contour
from ilmek.viz.drawings.joined import Member
from ilmek.viz.drawings.keyways import keyway
from ilmek.viz.drawings.picture import millimetres
from ilmek.viz.drawings.view import DrawnView

_CORNERS = 0.2
"""Greatest share of a square that its corners, when cut off, take from it."""


@record
class CoaxialPart:
    """The profile of all members in one half plane, their keyed ends and bores, and where the ends' grooves lie.

    grooves  begin and end along the axis, and distance of the floor from it [m]
    squares  outlines of square members, whole or with their corners off: the profile has their half width [m]
    """

    profile: Profile
    ends: tuple[KeyedCircle, ...]
    bores: tuple[KeyedCircle, ...]
    grooves: tuple[tuple[float, float, float], ...] = ()
    squares: tuple[Contour, ...] = ()

    @property
    def half_widths(self) -> tuple[float, ...]:
        """Half widths across flats of the square members: at these radii the profile is not round [m]."""
        return tuple(distinct([bounds(square)[1].real for square in self.squares]))


def coaxial(members: tuple[Member, ...]) -> CoaxialPart | None:
    """The members as one turned part; None where they have not one axis, or are not round."""
    profiles: list[ComplexArray] = []
    ends: list[KeyedCircle] = []
    bores: list[KeyedCircle] = []
    squares: list[Contour] = []
    grooves: list[tuple[float, float, float]] = []
    for shape, position in members:
        before = len(ends)
        upright = abs(abs(float(position.rotation[2, 2])) - 1) < 1e-12 and math.hypot(*position.origin[:2]) < SAME
        half = (_square(shape, squares) or _half(shape, ends, bores)) if upright else None
        if half is None:
            return None
        half = np.asarray(half)
        sign = float(np.sign(position.rotation[2, 2]))
        profiles.append(sign * half.real + float(position.origin[2]) + 1j * half.imag)
        z = profiles[-1].real
        grooves += [(float(z.min()), float(z.max()), end.floor) for end in ends[before:]]
    if len(profiles) < 2:
        return None
    outline, *holes = map(polygon, _union(profiles))
    if any(area(hole) > 0 for hole in holes):
        return None  # pieces apart
    return CoaxialPart(Profile(outline, tuple(holes)), tuple(ends), tuple(bores), tuple(grooves), tuple(squares))


def _square(shape: object, squares: list[Contour]) -> list[complex] | None:
    """Corners in the half plane of a square bar about the axis, its outline noted; None: it is none."""
    if not isinstance(shape, Prism) or shape.section.holes or len(shape.section.outline.points) not in {4, 8}:
        return None
    low, high = bounds(shape.section.outline)
    even = abs(low + high) < SAME and abs((high - low).real - (high - low).imag) < SAME
    points = shape.section.outline.points
    corners = len(points) // 4
    on_sides = np.isclose(np.maximum(np.abs(points.real), np.abs(points.imag)), high.real, atol=SAME).all()
    square = np.isclose(shape.section.area, (high - low).real ** 2, rtol=_CORNERS * (corners - 1) + 1e-9)
    if not (even and on_sides and square) or shape.section.outline.bulges.any():
        return None
    squares.append(shape.section.outline)
    return [0j, shape.length + 0j, shape.length + 1j * high.real, 1j * high.real]


def _half(shape: object, ends: list[KeyedCircle], bores: list[KeyedCircle]) -> ComplexArray | None:
    """Corners of a member in the half plane; None: it is not round. Keyed ends and bores are noted."""
    if isinstance(shape, Turned):
        return None if shape.profile.holes else along(shape.profile.outline, 1e-6)
    if not isinstance(shape, Prism) or len(shape.section.holes) > 1:
        return None
    outer = _radius(shape.section.outline, ends)
    inner = _radius(shape.section.holes[0], bores) if shape.section.holes else 0.0
    if outer is None or inner is None:
        return None
    return np.array([1j * inner, shape.length + 1j * inner, shape.length + 1j * outer, 1j * outer])


def _radius(contour: Contour, noted: list[KeyedCircle]) -> float | None:
    """Radius of a circle about the axis, or of one with keyways; None: of another contour."""
    ring, bore = as_hole(contour), as_keyed(contour)
    if ring is not None and abs(ring.at) < SAME:
        return ring.radius
    if bore is not None and abs(bore.centre) < SAME:
        noted.append(bore)
        return bore.radius
    return None


def _union(profiles: list[ComplexArray]) -> list[ComplexArray]:
    """The closed lines about all that the members fill, the outline first, holes clockwise.

    Slabs between the levels of all corners are filled by trapezoids; sides that two of them share are left out.
    """
    levels = distinct([float(z) for points in profiles for z in points.real])
    onward: dict[complex, list[complex]] = defaultdict(list)
    sides: dict[float, list[tuple[float, float, int]]] = defaultdict(list)
    for start, end in pairwise(levels):
        for (low, low_end), (high, high_end) in _trapezoids(profiles, start, end):
            onward[_node(start, low)].append(_node(end, low_end))
            onward[_node(end, high_end)].append(_node(start, high))
            sides[start].append((low, high, -1))
            sides[end].append((low_end, high_end, 1))
    for z, own in sides.items():
        for low, high in pairwise(distinct([r for side in own for r in side[:2]])):
            middle = (low + high) / 2
            net = sum(sign for first, last, sign in own if first < middle < last)
            if net:
                ends = (_node(z, low), _node(z, high))[::net]
                onward[ends[0]].append(ends[1])
    loops = list[ComplexArray]()
    while onward:
        loop = [next(iter(onward))]
        while loop[-1] in onward:
            after = onward[loop[-1]].pop()
            if not onward[loop[-1]]:
                del onward[loop[-1]]
            loop.append(after)
        loops.append(_cornered(np.array(loop[:-1])))
    return sorted((loop for loop in loops if len(loop) > 2), key=lambda loop: -abs(area(polygon(loop))))


def _node(z: float, r: float) -> complex:
    """A corner, equal ones alike."""
    return complex(round(z, 9), round(r, 9))


def _trapezoids(
    profiles: list[ComplexArray], start: float, end: float
) -> Iterator[tuple[tuple[float, float], tuple[float, float]]]:
    """What the members fill of a slab: radii of the lower and of the upper side, each at both ends, apart."""
    quarter, filled = (end - start) / 4, list[tuple[tuple[float, float], tuple[float, float]]]()
    for points in profiles:
        first, last = (sorted(_crossings(points, z)) for z in (start + quarter, end - quarter))
        reached = [(a - (b - a) / 2, b + (b - a) / 2) for a, b in zip(first, last, strict=True)]
        filled += zip(reached[::2], reached[1::2], strict=True)
    merged = list[tuple[tuple[float, float], tuple[float, float]]]()
    for low, high in sorted(filled, key=lambda own: sum(own[0])):
        if merged and sum(low) <= sum(merged[-1][1]) + SAME:
            merged[-1] = merged[-1][0], max(merged[-1][1], high, key=sum)
        else:
            merged.append((low, high))
    yield from merged


def _crossings(points: ComplexArray, z: float) -> list[float]:
    """Radii at which a closed polygon meets a plane across the axis."""
    after = np.roll(points, -1)
    crossed = (points.real > z) != (after.real > z)
    share = (z - points.real[crossed]) / (after.real[crossed] - points.real[crossed])
    radii: list[float] = (points.imag[crossed] + share * (after.imag[crossed] - points.imag[crossed])).tolist()
    return radii


def _cornered(points: ComplexArray) -> ComplexArray:
    """A polygon without repeated points and points on straight lines."""
    points = points[np.abs(points - np.roll(points, 1)) > SAME]
    turn = np.imag(np.conj(points - np.roll(points, 1)) * (np.roll(points, -1) - points))
    return np.asarray(points[np.abs(turn) > SAME**2 * 10])


def end_view(part: CoaxialPart, scale: float, fits: Fits) -> DrawnView:
    """The view on the end of the axis: circles of all steps, keyed ends and bores with their keyways."""
    view = DrawnView(scale)
    radii = distinct([float(radius) for radius in part.profile.outline.points.imag if radius > SAME])
    keyed_radii = [bore.radius for bore in (*part.ends, *part.bores)]
    for radius in radii:
        if any(abs(radius - side) < SAME for side in part.half_widths):
            continue
        if all(abs(radius - other) > SAME for other in keyed_radii):
            view.contour(LineKind.VISIBLE, circle(0j, radius))
    for square in part.squares:
        view.contour(LineKind.VISIBLE, square)
    for points in {own.points.tobytes(): own.points for own in part.squares if len(own.points) == 8}.values():
        side = np.abs(np.roll(points, -1) - points)
        start = int(np.argmin(side))
        foot = complex(points[start] + np.roll(points, -1)[start]) / 2 * view.scale
        leg = float(side[start]) / math.sqrt(2)
        ends = (complex(points[start]) * view.scale, complex(np.roll(points, -1)[start]) * view.scale)
        words = f"4× {millimetres(leg)} × 45°"
        view.leader(words, foot, 0.0, kind=DimensionKind.ALIGNED, value=leg, count=4, measured=ends)
    for bore in (*part.ends, *part.bores):
        view.contour(LineKind.VISIBLE, keyed_contour(bore))
    view.cross(0j, radii[-1])
    low = bounds(part.profile.outline)[0].real
    for end, (begin, last, _) in zip(part.ends, part.grooves, strict=True):
        keyway(view, end, fits, FeatureKind.JOURNAL, (begin - low, last - begin))
    for bore in part.bores:
        keyway(view, bore, fits, FeatureKind.BORE)
    return view
