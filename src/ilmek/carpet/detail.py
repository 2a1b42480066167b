"""Detail: what a picture shows within a knot and beside it, and how much of it a chart keeps.

Small print, dust and hair may be finer than the knots: their mean light over the knots is grey, and the chart that
keeps all edges of that grey shows nothing. So windows of SIDE × SIDE knots are compared at FINE × FINE points a knot,
on a lattice. With p the CIELAB of a window's points about their mean and c that of the yarns of their knots, it is kept
by the correlation

    r = max(0, ⟨p, c⟩ / (|p| |c|)),   0 where the yarns are one

and in a photo, whose knots have mean light, times min(1, |c| / |p|): print that became a grey has little contrast. It
is the largest with the picture moved by up to one point, since a line is tied in whole knots. The detail kept is the
mean of r over the windows, each with the weight |p|. Only windows whose |p|, the root of the mean square, is DETAILED
or more have detail.

Small print is a little part of most drawings, and edges beside it keep the mean up. So what is lost of it is measured
by itself: with m the means of p over the knots, a window is finer than the knots if |m| < FINER |p| wherever it is
moved, and |p| keeps half of its greatest: else it lies at a side. It is lost if r < READABLE. The fine detail lost is
the share of the weights of the windows that are both.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float, FloatArray, Indices, IntArray, Rgb, UInt8
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.design import resampled_band
from ilmek.num.threads import in_threads
from ilmek.records import record

SIDE, FINE = 3, 3
"""Knots along a side of a window, and points along a side of a knot."""

DETAILED = 12.0
"""Root mean square in CIELAB from which a window has detail: letters, lines and outlines, but no grain."""

COARSE = 1.5
"""Pixels of the picture along a side of a knot below which nothing is finer than the knots."""

MOST_WINDOWS, LEAST_WINDOWS = 500, 10
"""Number of windows of the lattice, about; fewest with detail that tell something."""

FINER = 0.73
"""Largest part of the spread of a window finer than the knots that their means have; an edge at its side has more."""

READABLE = 0.6
"""Least correlation of a window that shows what it means; chosen by this project by looking at print in charts."""

_RANGE = 24
"""Difference of the codes of a channel below which a window has no detail."""

_MOVES = sorted(np.ndindex(3, 3), key=(1, 1).__ne__)
"""First points of a window as it is, and as it is moved by up to one point."""


@record
class Detail:
    """The detail of a picture on a grid of knots.

    corners  row and column of the first knot of each window
    spread   |p| of each, as it is moved; the first is that of the window as it is
    means    of p over each knot of a window, row by row
    """

    corners: IntArray
    spread: Float[np.ndarray, "moves windows"]
    means: Float[np.ndarray, "moves windows knots 3"]


class KeptDetail(NamedTuple):
    """Shares of a picture's detail that a chart keeps, and that is finer than its knots and lost [-]."""

    share: float
    fine_lost: float


def detail_of(picture: Rgb, grid: tuple[int, int]) -> Detail | None:
    """The detail of a picture on a grid of rows and columns; None: too little, or no more pixels than knots."""
    (height, width), (rows, columns) = picture.shape[:2], grid
    if min(height / rows, width / columns) < COARSE or min(grid) < SIDE + 2:
        return None
    step = max(SIDE + 1, round((rows * columns / MOST_WINDOWS) ** 0.5))
    tops, lefts = np.arange(1, rows - SIDE, step), np.arange(1, columns - SIDE, step)
    points, fine = lefts[:, None] * FINE + np.arange(-1, SIDE * FINE + 1), (FINE * rows, FINE * columns)

    def windows(top: int) -> UInt8[np.ndarray, "windows height width 3"]:
        band = slice(FINE * top - 1, FINE * (top + SIDE) + 1)
        return resampled_band(picture, fine, band)[:, points].swapaxes(0, 1)

    rgb = np.concatenate([found for _, found in in_threads(windows, tops.tolist())])
    corners = np.stack([axis.ravel() for axis in np.meshgrid(tops, lefts, indexing="ij")], axis=-1)
    uneven = np.flatnonzero(np.max(np.ptp(rgb, axis=(1, 2)), axis=-1) >= _RANGE)
    labs = srgb_to_lab(rgb[uneven])
    detailed = _centred(labs[:, 1:-1, 1:-1])[1] >= DETAILED
    if np.count_nonzero(detailed) < LEAST_WINDOWS:
        return None
    labs, side = labs[detailed], SIDE * FINE
    moved = [_centred(labs[:, y : y + side, x : x + side]) for y, x in _MOVES]
    means = [window.reshape(-1, SIDE, FINE, SIDE, FINE, 3).mean(axis=(2, 4)) for window, _ in moved]
    spread = np.stack([spread for _, spread in moved])
    return Detail(corners[uneven[detailed]], spread, np.stack(means).reshape(len(moved), -1, SIDE * SIDE, 3))


def _centred(labs: Float[np.ndarray, "windows y x 3"]) -> tuple[Float[np.ndarray, "windows y x 3"], FloatArray]:
    """Windows about their means, and the root of their mean square."""
    centred = labs - labs.mean(axis=(1, 2), keepdims=True)
    return centred, np.sqrt(np.mean(np.sum(centred**2, axis=-1), axis=(1, 2)))


def detail_kept(detail: Detail | None, knots: Indices, yarn_labs: FloatArray, *, photo: bool) -> KeptDetail | None:
    """What a chart keeps of a picture's detail; None without detail."""
    if detail is None:
        return None
    y, x = (axis[None] for axis in np.mgrid[:SIDE, :SIDE])
    top, left = detail.corners.T[:, :, None, None]
    tied, contrast = _centred(yarn_labs[knots[top + y, left + x]])
    common = np.mean(np.sum(detail.means * tied.reshape(-1, SIDE * SIDE, 3), axis=-1), axis=-1)
    weight = detail.spread[0]
    share = np.maximum(np.max(common / np.maximum(detail.spread * contrast, 1e-9), axis=0), 0.0)
    share *= np.minimum(1.0, contrast / weight) if photo else 1.0
    coarse = np.sqrt(np.mean(np.sum(detail.means**2, axis=-1), axis=-1)) / np.maximum(detail.spread, 1e-9)
    within = 2 * detail.spread.min(axis=0) >= detail.spread.max(axis=0)
    lost = within & (coarse.max(axis=0) < FINER) & (share < READABLE)
    return KeptDetail(*(float((part * weight).cumsum()[-1] / weight.cumsum()[-1]) for part in (share, lost)))
