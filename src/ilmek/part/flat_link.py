"""A flat link: a bar with round ends about two pins, with holes along the line through them; one, or many at once.

    A = L w + π r²,    J = L w (L² + w²) / 12 + π r² (r² / 2 + L² / 4 + 4 r L / (3 π)) + A L² / 4

A is the area of the bar without holes, J its polar moment about the first pin; L is the distance of the pins, w the
width, r = w / 2. A hole of diameter d at x takes away π d² / 4, and its polar moment π d² / 4 (d² / 8 + x²).
[rectangle, and half discs whose centres are 4 r / (3 π) from their straight sides: Meriam and Kraige, Dynamics, app. B]
"""

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from ilmek.arrays import RealField
from ilmek.part.profile import drilled
from ilmek.part.shapes import Prism
from ilmek.plane.contours import circle, rounded_hull
from ilmek.report import Contour, Hole


class LinkMoments(NamedTuple):
    """Moments about a link's first pin, x along the line of its pins; of a volume, or of a mass.

    zeroth  [m³], [kg]        first  integral of x [m⁴], [kg m]        second  of x² + y² [m⁵], [kg m²]
    """

    zeroth: RealField
    first: RealField
    second: RealField

    def with_mass(self, mass: RealField, at: RealField, moment: RealField = 0.0) -> "LinkMoments":
        """Moments of the link with a mass [kg] at x [m], and its moment of inertia about its own centre [kg m²]."""
        return LinkMoments(self.zeroth + mass, self.first + mass * at, self.second + mass * at**2 + moment)

    def of_density(self, density: RealField) -> "LinkMoments":
        """Moments of mass for those of a volume; density [kg/m³]."""
        return LinkMoments(*(density * moment for moment in self))

    @property
    def centre(self) -> RealField:
        """Centre from the first pin [m]; nan for nothing."""
        return self.first / self.zeroth

    @property
    def about_centre(self) -> RealField:
        """Moment of inertia about the centre [kg m²]; nan for nothing."""
        return self.second - self.first**2 / self.zeroth


class PinHole(NamedTuple):
    """A hole of a link: its distance from the first pin, and its diameter [m]; 0: it is not bored."""

    at: RealField
    diameter: RealField


def flat_link_moments(length: RealField, width: float, thickness: float, holes: Iterable[PinHole] = ()) -> LinkMoments:
    """Moments of a link's volume about its first pin [m³, m⁴, m⁵].

    length  from pin to pin [m], any shape      width, thickness  [m]      holes  of shapes that broadcast with it

    >>> disc = flat_link_moments(0.0, 0.2, 0.01, [PinHole(0.0, 0.1)])
    >>> round(disc.zeroth / (math.pi * 0.01 * (0.1**2 - 0.05**2)), 12)
    1.0
    """
    radius = width / 2
    straight, ends = length * width, math.pi * radius**2
    area = straight + ends
    first = area * length / 2
    second = straight * (length**2 + width**2) / 12 + area * length**2 / 4
    second = second + ends * (radius**2 / 2 + length**2 / 4 + 4 * radius * length / (3 * math.pi))
    for at, diameter in holes:
        cut = math.pi * diameter**2 / 4
        area, first, second = area - cut, first - cut * at, second - cut * (diameter**2 / 8 + at**2)
    return LinkMoments(thickness * area, thickness * first, thickness * second)


def stepped_link(start: complex, end: complex, width: float, steps: Iterable[tuple[float, float]] = ()) -> Contour:
    """Outline of a link that is round about its first pin and square at its end, with narrower or wider steps beyond.

    start, end  the pin, and the end on the line through it [m]      width  of the link [m]
    steps       length and width of each, from the end on [m]

    >>> from ilmek.plane.contours import area
    >>> outline = stepped_link(0j, 0.1 + 0j, 0.02, [(0.01, 0.03)])
    >>> round(area(outline) / (0.1 * 0.02 + math.pi * 0.01**2 / 2 + 0.01 * 0.03), 12)
    1.0
    """
    reach = abs(end - start)
    edge, x = [complex(0, width / 2), complex(reach, width / 2)], reach
    for length, wide in steps:
        edge += [complex(x, wide / 2), complex(x + length, wide / 2)]
        x += length
    upper = [point for point, before in zip(edge, [None, *edge[:-1]], strict=True) if point != before]
    along = (end - start) / reach
    points = start + along * np.array([point.conjugate() for point in upper] + upper[::-1])
    bulges = np.zeros(len(points))
    bulges[-1] = 1.0  # half a turn about the pin, from the last point to the first
    return Contour(points, bulges)


def eyed_link(length: float, first: float, other: float) -> Contour:
    """Outline of a link between two eyes: the hull of a circle about the origin and one about x = length [m].

    first, other  radii of the eyes. One that contains the other is the outline.

    >>> from ilmek.plane.contours import area
    >>> round(area(eyed_link(0.1, 0.02, 0.02)) / (0.1 * 0.04 + math.pi * 0.02**2), 12)
    1.0
    """
    share = (first - other) / length
    if abs(share) >= 1:
        return circle(0j, first) if first > other else circle(complex(length), other)
    tangent = math.acos(share)
    side = complex(share, math.sin(tangent))
    points = np.array(
        [first * side, first * side.conjugate(), length + other * side.conjugate(), length + other * side]
    )
    return Contour(points, np.array([math.tan((math.pi - tangent) / 2), 0.0, math.tan(tangent / 2), 0.0]))


def flat_link(length: float, width: float, thickness: float, holes: Iterable[PinHole] = ()) -> Prism:
    """The shape of a link: its first pin in the origin, the other at x = length, from z = 0 to its thickness [m].

    Raises ParameterError for holes that leave nothing of it.
    """
    outline = rounded_hull(np.array([0, length], dtype=complex), width / 2)
    cut = [Hole(complex(at), float(diameter) / 2) for at, diameter in holes if diameter > 0]
    return Prism(drilled(outline, cut), thickness)
