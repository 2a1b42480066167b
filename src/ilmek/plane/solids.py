"""Closed surfaces of triangles: volume, bounds, closedness; closed lines with fewer points."""

import numpy as np

from ilmek.arrays import ComplexArray, Float
from ilmek.plane.vectors import cross
from ilmek.report.scene import Solid


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
    there, back = np.sort(edges[:, 0] * number + edges[:, 1]), np.sort(edges[:, 1] * number + edges[:, 0])
    return bool((there[1:] > there[:-1]).all()) and np.array_equal(there, back)
