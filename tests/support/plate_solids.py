"""The solid of a plate's drawing, by its own lines: for comparison with the parts in space."""

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.part.mesh import extruded
from ilmek.plane.contours import along, circle, counter_clockwise
from ilmek.report import Contour, Plate
from ilmek.report.scene import Solid


def plate_solid(plate: Plate, deviation: float = 1e-5) -> Solid:
    """The plate from z = 0 to its thickness, its arcs as chords of a deviation [m]."""
    cuts = (*plate.cutouts, *(circle(hole.at, hole.radius) for hole in plate.holes))
    outline, *holes = (_points(line, deviation) for line in (plate.outline, *cuts))
    return extruded([outline, *(hole[::-1] for hole in holes)], plate.thickness)


def _points(line: ComplexArray | Contour, deviation: float) -> ComplexArray:
    """Points of a closed line, counter-clockwise."""
    if isinstance(line, Contour):
        return along(counter_clockwise(line), deviation)
    points = np.asarray(line)
    return points if np.sum((np.conj(points) * np.roll(points, -1)).imag) > 0 else points[::-1]
