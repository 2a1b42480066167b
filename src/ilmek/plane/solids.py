"""Solids of plates and bars: prisms with holes, tubes and boxes as closed surfaces of triangles; volume and bounds.

The frame is that of a scene: x across, y up, z to the front. A section in the side view is a complex number, its real
part to the front and its imaginary part up, and is extruded along x.
"""

import math
from collections.abc import Sequence

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.plane.contours import along, circle, counter_clockwise
from ilmek.plane.triangulation import triangles
from ilmek.plane.vectors import cross
from ilmek.report import Contour, Plate
from ilmek.report.scene import Solid
from ilmek.units import turn


def prism(
    outline: Complex[np.ndarray, " corners"], low: float, high: float, holes: Sequence[ComplexArray] = ()
) -> Solid:
    """The section between two positions across, `low` < `high` [m]; the direction of the corners does not matter.

    Its volume is the area of the polygons times the thickness.

    >>> round(volume(prism(np.array([0, 2, 2 + 1j, 1j]), -1.0, 2.0)), 12)
    6.0
    """
    outer, inner = _turning(outline, 1.0), [_turning(hole, -1.0) for hole in holes]
    flat = triangles(outer, inner)
    section = np.concatenate([outer, *inner])
    number = len(section)
    sides, begin = [], 0
    for loop in (outer, *inner):
        one = np.arange(begin, begin + len(loop))
        other = np.roll(one, -1)
        sides += [np.stack([one, one + number, other], 1), np.stack([other, one + number, other + number], 1)]
        begin += len(loop)
    points = np.concatenate([_at(section, low), _at(section, high)])
    # seen against x, z to the front is on the left: a counter-clockwise section looks along -x
    return Solid(points, np.concatenate([flat, flat[:, ::-1] + number, *sides]))


def _at(section: ComplexArray, across: float) -> FloatArray:
    return np.stack([np.full(len(section), across), section.imag, section.real], axis=1)


def _turning(corners: ComplexArray, sense: float) -> ComplexArray:
    area = float(np.sum(cross(corners, np.roll(corners, -1))))
    return corners if area * sense > 0 else corners[::-1]


def tube(at: complex, outer: float, inner: float, low: float, high: float, *, chord_error: float) -> Solid:
    """A tube or, with the inner radius 0, a bar across [m]; its facets cut off `chord_error` [m] at most."""
    holes = (_ring(at, inner, chord_error),) if inner > 0 else ()
    return prism(_ring(at, outer, chord_error), low, high, holes)


def _ring(at: complex, radius: float, chord_error: float) -> ComplexArray:
    share = min(chord_error / radius, 0.5)
    number = max(8, math.ceil(math.pi / math.acos(1 - share)))
    return np.asarray(at + radius * np.exp(1j * turn * np.arange(number) / number))


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Solid:
    """A box between two corners (x, y, z) [m]."""
    section = np.array([complex(low[2], low[1]), complex(high[2], low[1])])
    section = np.concatenate([section, [complex(high[2], high[1]), complex(low[2], high[1])]])
    return prism(section, low[0], high[0])


def plate_solid(plate: Plate, low: float, deviation: float = 0.0) -> Solid:
    """A plate in the side view, its own frame's x to the front and y up, from `low` across by its thickness [m].

    deviation  of its corners from the plate's outline, at most [m]; 0: all points of the outline, arcs to 0.01 mm
    """
    error = deviation or ARC_ERROR
    outline = thinned(_points(plate.outline, error), deviation)
    holes = [thinned(_points(cut, error), deviation) for cut in plate.cutouts]
    holes += [_points(circle(hole.at, hole.radius), error) for hole in plate.holes]
    return prism(outline, low, low + plate.thickness, holes)


ARC_ERROR = 1e-5
"""Deviation of the chords of a contour's arcs where all points of an outline are taken [m]."""


def _points(line: ComplexArray | Contour, chord_error: float) -> ComplexArray:
    return along(counter_clockwise(line), chord_error) if isinstance(line, Contour) else np.asarray(line)


def thinned(line: ComplexArray, deviation: float) -> ComplexArray:
    """Fewer points of a closed line, none of the others farther from their polygon than `deviation` [m].

    [Douglas and Peucker 1973, from the two points farthest from each other along x]
    """
    if deviation <= 0 or len(line) < 4:
        return line
    number = len(line)
    first, other = int(np.argmin(line.real)), int(np.argmax(line.real))
    kept = {first, other}
    spans = [(first, other), (other, first)]
    while spans:
        begin, end = spans.pop()
        between = (begin + 1 + np.arange((end - begin - 1) % number)) % number
        if not len(between):
            continue
        chord, arm = line[end] - line[begin], line[between] - line[begin]
        apart = np.abs(cross(chord, arm)) / abs(chord) if abs(chord) > 0 else np.abs(arm)
        worst = int(np.argmax(apart))
        if apart[worst] > deviation:
            middle = int(between[worst])
            kept.add(middle)
            spans += [(begin, middle), (middle, end)]
    return np.asarray(line[sorted(kept)])


def volume(solid: Solid) -> float:
    """Enclosed volume [m^3]: of the tetrahedra of its triangles and a point; below 0 where it is inside out."""
    one, two, three = (solid.points[solid.triangles[:, k]] - solid.points[0] for k in range(3))
    return float(np.sum(one * np.cross(two, three))) / 6


def bounds(solid: Solid) -> tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 3"]]:
    """Lower and upper corner of the bounding box [m]."""
    return solid.points.min(axis=0), solid.points.max(axis=0)


def is_closed(solid: Solid) -> bool:
    """Whether each edge of a triangle is that of exactly one other, which runs along it the other sense."""
    edges = np.concatenate([solid.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    number = len(solid.points)
    there, back = edges[:, 0] * number + edges[:, 1], edges[:, 1] * number + edges[:, 0]
    return len(np.unique(there)) == len(there) and np.array_equal(np.sort(there), np.sort(back))
