"""Plates of a linkage's links: outlines about their eyes, from one pin to the next, and the room they take.

A link of two points is a bar with eyes; of three and more the hull of its eyes; of one a disc. A body that is given by
shapes has these, each on top of those that it covers.
"""

import math
from collections.abc import Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.dynamics.own_machine import FlatShape
from ilmek.part.flat_link import eyed_link
from ilmek.plane.contours import polygon, rounded_hull
from ilmek.plane.outlines import Outline, between, to_outline
from ilmek.records import record
from ilmek.report import Contour


@record
class Layer:
    """One plate of a body: its contour and the room of it, from a height above the body's lowest face [m].

    bore  radius of a hole in the middle of its outline; 0: none
    """

    contour: Contour
    outlines: tuple[Outline, ...]
    low: float
    thickness: float
    bore: float = 0.0

    def has(self, point: complex) -> bool:
        """Whether a point [m] lies in its room, beside its bore."""
        inside = any(float(to_outline(np.array([point]), outline)[0]) < 0 for outline in self.outlines)
        return inside and abs(point - self.outlines[0].corners[0]) >= self.bore

    @property
    def high(self) -> float:
        """Height of its upper face [m]."""
        return self.low + self.thickness


@record
class Eye:
    """A point of a link with the radius of the eye about it, and what its bore needs at least [m]."""

    at: complex
    radius: float
    least: float = 0.0


def link_layer(eyes: Sequence[Eye], width: float, thickness: float) -> Layer:
    """The plate of a link between eyes; width  of the bar between two of them [m].

    >>> link_layer([Eye(0j, 0.01), Eye(0.1 + 0j, 0.01)], 0.02, 0.005).outlines[0].radius
    0.01
    """
    apart: list[Eye] = []
    for eye in sorted(eyes, key=lambda one: -one.radius):
        if all(abs(eye.at - other.at) > _SAME for other in apart):
            apart.append(eye)
    largest = apart[0].radius
    if len(apart) == 2:
        return _bar(apart[0], apart[1], width, thickness)
    corners = tuple(eye.at for eye in apart)
    radius = max(largest, width / 2) if len(apart) > 1 else largest
    return Layer(rounded_hull(np.array(corners), radius), (Outline(corners, radius),), 0.0, thickness)


_SAME = 1e-9


def _bar(first: Eye, other: Eye, width: float, thickness: float) -> Layer:
    half, length = width / 2, abs(other.at - first.at)
    along = (other.at - first.at) / length
    radii = max(first.radius, half), max(other.radius, half)
    cuts = [math.sqrt(radius**2 - half**2) for radius in radii]
    if sum(cuts) >= length:
        contour = eyed_link(length, *radii)
        radius = max(radii)
        outlines: tuple[Outline, ...] = (Outline((first.at, other.at), radius),)
    else:
        contour = _dumbbell(length, half, radii, cuts)
        discs = (Outline((eye.at,), radius) for eye, radius in zip((first, other), radii, strict=True) if radius > half)
        outlines = (Outline((first.at, other.at), half), *discs)
    return Layer(Contour(first.at + along * contour.points, contour.bulges), outlines, 0.0, thickness)


def _dumbbell(length: float, half: float, radii: tuple[float, float], cuts: Sequence[float]) -> Contour:
    """A bar along x between two eyes that are wider than it, counter-clockwise."""
    points: ComplexArray = np.array([cuts[0] - 1j * half, length - cuts[1] - 1j * half, 0j, 0j])
    points[2:] = points[1::-1].conj()
    first, other = (math.tan((math.pi - math.asin(half / radius)) / 2) for radius in radii)
    return Contour(points, np.array([0.0, other, 0.0, first]))


def shape_layers(shapes: Sequence[FlatShape], eyes: Sequence[Eye] = ()) -> tuple[Layer, ...]:
    """The plates of a body that is given by shapes, each on top of those that it covers.

    A shape whose edge cuts the bore of an eye in it is wider all round, by what the eye needs.

    >>> disc = FlatShape((0j,), 0.06, 0.02, "steel")
    >>> [round(one.low, 3) for one in shape_layers([disc, FlatShape((0.03 + 0j,), 0.02, 0.03, "steel")])]
    [0.0, 0.02]
    """
    layers: list[Layer] = []
    for shape in shapes:
        given = Outline(shape.points, shape.radius)
        edges = [float(to_outline(np.array([eye.at]), given)[0]) for eye in eyes]
        wider = (eye.radius + edge for eye, edge in zip(eyes, edges, strict=True) if -eye.least < edge < _SAME)
        outline = Outline(shape.points, max(wider, default=0.0) + shape.radius)
        low = max((layer.high for layer in layers if _covers(outline, layer)), default=0.0)
        corners = np.array(shape.points)
        contour = rounded_hull(corners, outline.radius) if outline.radius > 0 else polygon(corners)
        layers.append(Layer(contour, (outline,), low, shape.thickness, shape.bore))
    return tuple(layers)


def _covers(outline: Outline, layer: Layer) -> bool:
    return any(
        float(between(outline.corners, own.corners)) < outline.radius + own.radius - _SAME for own in layer.outlines
    )
