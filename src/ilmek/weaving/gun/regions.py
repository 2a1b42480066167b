"""Regions of a colour with smooth borders, and what lies deeper in them than a given depth.

The border is where the indicator of the colour, smoothed by a Gauss curve, is one half. Two neighbours have one border,
because their indicators add up to one; a straight border stays, steps of cells become a line. Beyond the edge of the
carpet there is no colour, so that the edge is a border.
"""

from collections.abc import Iterable

import numpy as np
from manifold3d import CrossSection, FillRule, JoinType
from scipy.ndimage import gaussian_filter

from ilmek.arrays import Complex, UInt8
from ilmek.plane.level_sets import level_polygons

SMOOTHING = 0.75
"""Standard deviation of the Gauss curve [cells]."""

_MARGIN = 4
"""Cells beyond the edge, at least as far as the Gauss curve reaches."""

_COARSE = 0.03
"""Deviation of a border from the steps of its cells [rows]."""

_FINE = 0.002
"""Deviation of an offset border, of its distance."""

_ARC = 32
"""Corners of a whole circle, where a border is offset about a corner."""


def region_of(labels: UInt8[np.ndarray, "rows columns"], label: int, cell: float) -> CrossSection:
    """The regions of a label [m]: x to the right, y upwards from the lowest row; cell  side of a cell [m]."""
    own = np.flatnonzero((labels == label).any(axis=1))
    if not len(own):
        return CrossSection()
    top, bottom = int(own[0]), int(own[-1]) + 1
    field = np.pad((labels[top:bottom] == label).astype(np.float32), _MARGIN)
    smooth = gaussian_filter(field, SMOOTHING, truncate=_MARGIN - 0.5)
    smooth[[0, -1]] = smooth[:, [0, -1]] = 0.0
    corner = complex(0.5 - _MARGIN, labels.shape[0] - bottom + 0.5 - _MARGIN)
    polygons = [cell * (around + corner) for around in level_polygons(smooth[::-1], 0.5)]
    return section(polygons)


def section(polygons: Iterable[Complex[np.ndarray, " corners"]]) -> CrossSection:
    """Polygons with their inside on the left as a section."""
    contours = [np.stack([polygon.real, polygon.imag], axis=1) for polygon in polygons]
    return CrossSection(contours, FillRule.Positive) if contours else CrossSection()


def polygons_of(shape: CrossSection) -> list[Complex[np.ndarray, " corners"]]:
    """The polygons of a section, their inside on the left."""
    return [np.asarray(around[:, 0] + 1j * around[:, 1]) for around in shape.to_polygons()]


def deeper(shape: CrossSection, depth: float) -> CrossSection:
    """What lies deeper than `depth` [m] within a section."""
    return shape.offset(-depth, JoinType.Round, circular_segments=_ARC).simplify(_FINE * abs(depth))


def tuftable(labels: UInt8[np.ndarray, "rows columns"], label: int, cell: float, spacing: float) -> CrossSection:
    """What a disk as wide as a row reaches in the regions of a label: without their narrow parts and sharp corners [m].

    spacing  distance of the rows [m]
    """
    shape = region_of(labels, label, cell).simplify(_COARSE * spacing)
    return deeper(deeper(shape, spacing / 2), -spacing / 2).simplify(_COARSE / 4 * spacing)
