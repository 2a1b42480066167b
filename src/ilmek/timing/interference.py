"""Interference from geometry: windows of the master angle in which a tool is in a region, exact to rounding.

A *margin* is a function of the master angle that is negative where the tool is in the region, for example the distance
of a point from a polygon, or the height of the shed minus the height of the tool. Its sign is sampled on a grid that
contains every joint of the motion. Minima between grid points that may be negative are searched, then every change of
sign is refined.
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray
from ilmek.errors import ParameterError
from ilmek.num.brackets import bracketed_minima, bracketed_roots
from ilmek.timing.windows import WHOLE, Windows, windows_of
from ilmek.units import counted, deg, turn

Margin: TypeAlias = Callable[[FloatArray], FloatArray]
"""Master angles [rad], (angles) -> margins, (angles)."""

STEP = 0.5 * deg
"""Grid step [rad]; a stay between two grid points is found if the margin has one minimum there."""


def windows_where(margin: Margin, joints: FloatArray | None = None, step: float = STEP) -> Windows:
    """Windows of the master angle [rad] in which a margin is negative.

    margin  function of master angles in [0, 2 pi] [rad], periodic
    joints  angles [rad] at which the margin is not smooth
    step    of the grid [rad]
    Raises ParameterError where the margin is not finite.
    """
    inner = np.empty(0) if joints is None else np.clip(joints, 0.0, turn)
    grid = np.unique(np.concatenate([np.linspace(0.0, turn, round(turn / step) + 1), inner]))
    value = np.asarray(margin(grid), dtype=float)
    if not np.isfinite(value).all():
        at = grid[~np.isfinite(value)][0] / deg
        raise ParameterError(f"the margin is no number at {at:g} deg", allowed="a finite number over the whole turn")
    grid, value = _with_minima(margin, grid, value)
    inside = value < 0
    if inside.all():
        return WHOLE
    change = np.flatnonzero(inside[:-1] != inside[1:])
    roots = bracketed_roots(_signed(margin, 1.0), grid[change], grid[change + 1])
    edges = np.concatenate([[0.0] if inside[0] else [], roots, [turn] if inside[-1] else []])
    return windows_of((start, end) for start, end in edges.reshape(-1, 2).tolist() if end > start)


def _with_minima(margin: Margin, grid: FloatArray, value: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The grid with the minima and maxima between its points at which the sign differs."""
    for sign in (1.0, -1.0):
        v = sign * value
        low = np.flatnonzero((v[1:-1] >= 0) & (v[1:-1] <= v[:-2]) & (v[1:-1] <= v[2:])) + 1
        step = np.abs(np.diff(v))
        low = low[v[low] <= 2 * np.maximum(step[low - 1], step[low])]  # bound of a smooth minimum
        at, least = bracketed_minima(_signed(margin, sign), grid[low - 1], grid[low + 1])
        at, least = at[least < 0], least[least < 0]
        grid, order = np.unique(np.concatenate([grid, at]), return_index=True)
        value = np.concatenate([value, sign * least])[order]
    return grid, value


def _signed(margin: Margin, sign: float) -> Margin:
    return lambda angle: sign * np.asarray(margin(angle), dtype=float)


def distance_from(points: ComplexArray, corners: ComplexArray) -> FloatArray:
    """Signed distance of points from a polygon [m]: negative inside, 0 on its sides.

    points   complex [m], any shape
    corners  complex [m], (corners,), in either sense; the first is not repeated
    Raises ParameterError for fewer than three corners.
    """
    if len(corners) < 3:
        raise ParameterError(f"a region of {counted(len(corners), 'corner')}", allowed="three or more")
    at = np.asarray(points)[..., np.newaxis]
    side = np.roll(corners, -1) - corners
    along = np.clip(np.real((at - corners) * np.conj(side)) / np.abs(side) ** 2, 0.0, 1.0)
    distance = np.abs(at - corners - along * side).min(axis=-1)
    return np.asarray(np.where(_odd(at, corners, side), -distance, distance))


def _odd(at: ComplexArray, corners: ComplexArray, side: ComplexArray) -> BoolArray:
    """Whether a ray to the right of each point meets the polygon's sides an odd number of times."""
    above, next_above = corners.imag > at.imag, np.roll(corners, -1).imag > at.imag
    with np.errstate(divide="ignore", invalid="ignore"):
        meets = corners.real + (at.imag - corners.imag) / side.imag * side.real
    crossed = (above != next_above) & (at.real < meets)
    return np.asarray(crossed.sum(axis=-1) % 2 == 1)


def in_region(path: Callable[[FloatArray], ComplexArray], corners: ComplexArray, radius: float = 0.0) -> Margin:
    """The margin of a round tool to a polygon.

    path     centre of the tool [m], complex, as a function of the master angle [rad]
    corners  of the polygon [m], complex, (corners,)      radius  of the tool [m]
    """

    def margin(angle: FloatArray) -> FloatArray:
        return distance_from(path(angle), corners) - radius

    return margin
