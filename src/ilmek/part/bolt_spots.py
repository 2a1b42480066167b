"""Where on the face that two parts have in common their screws stand: in its corners, and between them."""

import math

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray
from ilmek.part.part import HolePattern
from ilmek.part.placement import Placement
from ilmek.part.seat_faces import SeatFace
from ilmek.units import turn

EDGE, PLATE_EDGE = 1.5, 0.8
"""Distance of a screw's axis from an edge over its diameter, at least: of most screws, and of one in the end of an axle
from the edge of the plate before it: assumed by this project.
"""

_APART, _ROW, _SINGLE = 40.0, 6.0, 3.0
"""Distance of neighbours over the diameter, at most; width from which there are two rows, and length up to which there
is one screw; assumed by this project.
"""

_MOST = 15
"""Points that are tried along each side of a face."""

_ROUNDING = 1e-6


def free_points(face: SeatFace, other: SeatFace, across: Placement, diameter: float) -> ComplexArray:
    """Points of a face that are off the edges of both faces by enough for a screw, in the frame of the first [m].

    across  position of the first one's frame in that of the other
    """
    if other.turned or face.turned:
        middle = across.inverse.origin if other.turned else np.zeros(3)
        points = np.array([complex(*middle[:2])])
        own, its = ((0.5 if side.turned else PLATE_EDGE) * diameter + _ROUNDING for side in (face, other))
    else:
        apart = EDGE * diameter
        low, high = _shared(face, other, across)
        size = high - low - complex(2 * apart, 2 * apart)
        if min(size.real, size.imag) < -_ROUNDING:
            return np.empty(0, complex)
        x, y = (_between(begin + apart, max(long, 0.0), diameter) for begin, long in _parts(low, size))
        points, own, its = (x[:, None] + 1j * y).ravel(), apart, apart
    return np.asarray(points[clear(face, points, own) & clear(other, mapped(across, points), its)])


def _parts(low: complex, size: complex) -> tuple[tuple[float, float], tuple[float, float]]:
    return (low.real, size.real), (low.imag, size.imag)


def _between(begin: float, long: float, diameter: float) -> FloatArray:
    number = min(_MOST, 1 + math.ceil(long / diameter - _ROUNDING)) if long > _ROUNDING else 1
    return begin + (np.linspace(0.0, long, number) if number > 1 else np.array([long / 2]))


def _shared(face: SeatFace, other: SeatFace, across: Placement) -> tuple[complex, complex]:
    """The box that the faces have in common, in the frame of the first."""
    low, high = other.low, other.high
    there = mapped(across.inverse, np.array([low, complex(high.real, low.imag), high, complex(low.real, high.imag)]))
    low = complex(max(face.low.real, there.real.min()), max(face.low.imag, there.imag.min()))
    high = complex(min(face.high.real, there.real.max()), min(face.high.imag, there.imag.max()))
    return low, high


def mapped(across: Placement, points: ComplexArray) -> ComplexArray:
    """Points of a face in the frame of another in the same plane."""
    there = across.points(np.stack([points.real, points.imag, np.zeros(len(points))], axis=1))
    return np.asarray(there[:, 0] + 1j * there[:, 1])


def clear(face: SeatFace, points: ComplexArray, apart: float) -> BoolArray:
    """Which points are off the edges of a face by a distance [m]."""
    return np.asarray(face.room(points, 2 * apart) > apart - _ROUNDING)


RING_FROM = 1 / 24
"""Turns from the face's first axis to the first hole of a ring; assumed by this project."""


def pattern_points(pattern: HolePattern, face: SeatFace) -> ComplexArray:
    """The holes of a pattern on a face, in its frame [m]."""
    middle, size = (face.low + face.high) / 2, face.high - face.low
    if pattern.in_rows:
        long = max(size.real, size.imag)
        number = max(1, math.floor(long / pattern.along))
        row = (np.arange(number) - (number - 1) / 2) * pattern.along
        return np.asarray(middle + row * (1.0 if size.real >= size.imag else 1j))
    across, along = pattern.across, pattern.along
    if pattern.ring:
        angles = turn * (np.arange(pattern.ring) / pattern.ring + RING_FROM)
        return np.asarray(middle + abs(complex(across, along)) / 2 * np.exp(1j * angles))
    if (size.real - size.imag) * (across - along) < 0:
        across, along = along, across
    x, y = (np.array([-apart, apart]) / 2 if apart else np.zeros(1) for apart in (across, along))
    return np.asarray(middle + (x + 1j * y[:, None]).ravel())


def row_points(points: ComplexArray, diameter: float) -> ComplexArray:
    """Where screws should stand of the points that have room [m]: evenly over the box about them."""
    low, high = complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max())
    size = high - low
    long, short = max(size.real, size.imag), min(size.real, size.imag)
    if long < _SINGLE * diameter:
        return np.array([(low + high) / 2])
    number = max(2, 1 + math.ceil(long / (_APART * diameter) - _ROUNDING))
    rows = 2 if short > _ROW * diameter else 1
    along = np.linspace(0.0, 1.0, number)
    across = np.linspace(0.0, 1.0, rows) if rows > 1 else np.array([0.5])
    share = along[:, None] + 1j * across if size.real >= size.imag else across[:, None] + 1j * along
    return np.asarray(low + share.ravel().real * size.real + 1j * share.ravel().imag * size.imag)
