"""The contours of a plate for output: every curve as counter-clockwise arcs, with their largest deviation."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.plane.biarcs import as_contour, deviation
from ilmek.plane.contours import area, bounds
from ilmek.records import record
from ilmek.report import Contour, Plate
from ilmek.units import um

TOLERANCE = 1e-6
"""Allowed deviation of arcs from the points of a curve, as a share of the plate's size."""

MOST = 1 * um
"""Largest allowed deviation of arcs from the points of a curve [m]."""


@record
class PlateShape:
    """A plate's lines as contours of arcs [m].

    error  largest distance of a point of the outline from its contour [m]
    bored  area of holes and cutouts [m^2]
    """

    outline: Contour
    cutouts: tuple[Contour, ...]
    paths: Mapping[str, Contour]
    error: float
    bored: float

    @property
    def size(self) -> float:
        """The longer side of the box around the outline [m]."""
        low, high = bounds(self.outline)
        return max((high - low).real, (high - low).imag)

    @staticmethod
    def box(contour: Contour) -> tuple[complex, complex]:
        """Lower left and upper right corner of the box around a contour [m]."""
        return bounds(contour)


def plate_shape(plate: Plate) -> PlateShape:
    """The plate's lines as contours of arcs."""
    points = _points(plate.outline)
    tolerance = min(MOST, TOLERANCE * float(max(np.ptp(points.real), np.ptp(points.imag))))
    outline = as_contour(plate.outline, tolerance)
    cutouts = tuple(as_contour(cutout, tolerance) for cutout in plate.cutouts)
    paths = {name: as_contour(path, tolerance) for name, path in plate.paths.items()}
    bored = sum(area(cutout) for cutout in cutouts) + sum(np.pi * hole.radius**2 for hole in plate.holes)
    return PlateShape(outline, cutouts, paths, deviation(points, outline), float(bored))


def _points(outline: ComplexArray | Contour) -> ComplexArray:
    return outline.points if isinstance(outline, Contour) else outline
