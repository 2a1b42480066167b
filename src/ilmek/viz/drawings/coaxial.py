"""Parts of turned shapes and keyed ends about one axis: drawn as one turned part, with the view on its end."""

import math
from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, Turned, rectangle
from ilmek.part.tolerances import FeatureKind
from ilmek.plane.contours import KeyedCircle, along, as_hole, as_keyed, bounds, circle, polygon
from ilmek.records import record
from ilmek.report import Contour
from ilmek.report.sheet import LineKind
from ilmek.viz.drawings.features import SAME, distinct
from ilmek.viz.drawings.fits import Fits
from ilmek.viz.drawings.flat import keyed_contour, keyway
from ilmek.viz.drawings.joined import Member
from ilmek.viz.drawings.view import DrawnView


@record
class CoaxialPart:
    """The profile of all members in one half plane, their keyed ends and bores, and where the ends' grooves lie.

    grooves  begin and end along the axis, and distance of the floor from it [m]
    squares  half widths across flats of square members: at these radii the profile is not round [m]
    """

    profile: Profile
    ends: tuple[KeyedCircle, ...]
    bores: tuple[KeyedCircle, ...]
    grooves: tuple[tuple[float, float, float], ...] = ()
    squares: tuple[float, ...] = ()


def coaxial(members: tuple[Member, ...]) -> CoaxialPart | None:
    """The members as one turned part; None where they have not one axis, or are not round."""
    profiles: list[ComplexArray] = []
    ends: list[KeyedCircle] = []
    bores: list[KeyedCircle] = []
    squares: list[float] = []
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
    whole = Profile(polygon(_union(profiles)))
    return CoaxialPart(whole, tuple(ends), tuple(bores), tuple(grooves), tuple(squares))


def _square(shape: object, squares: list[float]) -> list[complex] | None:
    """Corners in the half plane of a square bar about the axis, its half width noted; None: it is none."""
    if not isinstance(shape, Prism) or shape.section.holes or len(shape.section.outline.points) != 4:
        return None
    low, high = bounds(shape.section.outline)
    even = abs(low + high) < SAME and abs((high - low).real - (high - low).imag) < SAME
    if not even or abs(shape.section.area - (high - low).real ** 2) > SAME**2:
        return None
    squares.append(high.real)
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


def _union(profiles: list[ComplexArray]) -> ComplexArray:
    """The corners of all that lies between the least and greatest radius of the members, slab by slab."""
    levels = distinct([float(z) for points in profiles for z in points.real])
    inner: list[complex] = []
    outer: list[complex] = []
    for start, end in pairwise(levels):
        quarter = (end - start) / 4
        radii = [[r for points in profiles for r in _crossings(points, z)] for z in (start + quarter, end - quarter)]
        for chain, pick in ((inner, min), (outer, max)):
            first, last = (pick(each) for each in radii)
            slope = (last - first) / (2 * quarter)
            chain += [complex(start, first - slope * quarter), complex(end, last + slope * quarter)]
    return _cornered(np.array(inner + outer[::-1]))


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
        if any(abs(radius - side) < SAME for side in part.squares):
            view.contour(LineKind.VISIBLE, rectangle(2 * radius, 2 * radius))
        elif all(abs(radius - other) > SAME for other in keyed_radii):
            view.contour(LineKind.VISIBLE, circle(0j, radius))
    for bore in (*part.ends, *part.bores):
        view.contour(LineKind.VISIBLE, keyed_contour(bore))
    view.cross(0j, radii[-1])
    low = bounds(part.profile.outline)[0].real
    for end, (begin, last, _) in zip(part.ends, part.grooves, strict=True):
        keyway(view, end, fits, FeatureKind.JOURNAL, (begin - low, last - begin))
    for bore in part.bores:
        keyway(view, bore, fits, FeatureKind.BORE)
    return view
