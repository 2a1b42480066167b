"""The edge along which a shaped carpet is cut out of its ground: area and outline, from the cells of its chart."""

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from ilmek.carpet.cells import OUTSIDE
from ilmek.plane.level_sets import level_polygons

if TYPE_CHECKING:
    from ilmek.carpet.chart import Chart


def cut_share(chart: "Chart") -> float:
    """Share of the woven carpet that is cut away [-]."""
    return 0.0 if chart.cells is None else chart.cells.number(OUTSIDE) / chart.knots.size


def finished_area(chart: "Chart") -> float:
    """Area of the finished carpet [m²]: all cells but those that are cut away."""
    return chart.size.area * (1 - cut_share(chart))


def edge_length(chart: "Chart") -> float:
    """Length of the carpet's outline [m], to be bound: around all that is not cut away, 0 for a rectangle.

    The outline of the cells is stepped. Its length is that of the level 1/2 of their smoothed map, a Gaussian of two
    knots, on which the steps vanish: within 0.5 % of a smooth outline of 100 knots across. A right corner is rounded by
    some two knots.
    """
    if chart.cells is None or not chart.cells.number(OUTSIDE):
        return 0.0
    inside = np.pad(~chart.cells.are(OUTSIDE), 8).astype(float)
    smooth = ndimage.gaussian_filter(inside, 2.0)
    across, along = chart.size.width / chart.columns, chart.size.length / chart.rows
    sides = (polygon - np.roll(polygon, 1) for polygon in level_polygons(smooth, 0.5))
    return float(sum(np.hypot(side.real * across, side.imag * along).sum() for side in sides))
