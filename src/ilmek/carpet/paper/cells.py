"""Cells: how many the grid has, and the colour in the middle of each.

A column of cells belongs to the grid where the lines across go on in it: the energy of the lines there, taken over all
rows, is in phase with the lattice. Numbers in the margin and the edge of the sheet are not. Rows likewise.

The colour of a cell is the mean of that half of its inner samples whose lightnesses are nearest together: lines,
letters and dots are in the other half.
"""

import numpy as np

from ilmek.arrays import BoolArray, Float, FloatArray, Rgb
from ilmek.carpet.paper.lattice import SAMPLES, Lattice, rectified, window
from ilmek.carpet.paper.lines import LineEnergy, levelled, no_grid
from ilmek.carpet.picture_points import Points
from ilmek.records import record

LEAST_CELLS = 4
"""Least number of rows and of columns of a grid."""

_LEAST_SHARE = 0.3
"""Least coherence of an outer row or column of cells, of the median one."""

_MOSTLY = 0.7
"""Quantile of the cells of a row or column that is its coherence: lines may be missing in many."""

_INNER, _ALONG, _LINE = 0.28, 7, 2.4
"""Half side of the inner part of a cell, at most; the samples along it; its least distance from a line [pixels]."""

_VISIBLE = 0.3
"""Half side of the part of each outer cell that has to be in the picture."""


@record
class Cells:
    """The cells of a grid.

    colours  mean of the steady half of the samples of each, sRGB codes (rows, columns, 3)
    spread   range of the lightness of that half [codes]
    x, y     their middles in the picture [pixels]
    corners   of the grid in the picture, clockwise from the upper left
    beyond    share of the cells next to the grid in which lines go on
    strength  coherence of the lines about each cell, over `usual`, that of the median cell
    """

    colours: Float[np.ndarray, "rows columns 3"]
    spread: Float[np.ndarray, "rows columns"]
    x: Float[np.ndarray, "rows columns"]
    y: Float[np.ndarray, "rows columns"]
    corners: Points
    strength: Float[np.ndarray, "rows columns"]
    usual: float
    beyond: float


def read_cells(rgb: Rgb, energy: LineEnergy, lattice: Lattice) -> Cells:
    """The cells of the grid in a picture. Raises PictureError where they are too few."""
    left, _, upper, _ = window(lattice)
    of_columns, of_rows = _coherence(lattice, energy)
    seen = _visible(lattice, int(rgb.shape[1]), int(rgb.shape[0]))
    rows, columns = _extent(of_columns, of_rows, seen, lattice)
    u = left + np.arange(columns.start, columns.stop) + 0.5
    v = upper + np.arange(rows.start, rows.stop) + 0.5
    strength = of_columns[rows, columns] + of_rows[rows, columns]
    usual = max(float(np.median(strength)), 1e-9)
    pitch = energy.factor * min(energy.pitch_x, energy.pitch_y)
    inner = np.linspace(-1, 1, _ALONG) * min(_INNER, max(0.15, 0.5 - _LINE / pitch))
    all_u, all_v = (u[:, None] + inner).ravel(), (v[:, None] + inner).ravel()
    x, y = lattice.mesh(all_u, all_v)
    samples = rgb[
        np.clip(np.floor(y), 0, rgb.shape[0] - 1).astype(np.intp),
        np.clip(np.floor(x), 0, rgb.shape[1] - 1).astype(np.intp),
    ]
    shape = (len(v), _ALONG, len(u), _ALONG)
    by_cell = samples.reshape(*shape, 3).swapaxes(1, 2).reshape(len(v), len(u), _ALONG**2, 3)
    colours, spread = _steady(by_cell)
    middle = _ALONG // 2
    x, y = (one.reshape(shape)[:, middle, :, middle] for one in (x, y))
    ends = np.array([[u[0], u[-1], u[-1], u[0]], [v[0], v[0], v[-1], v[-1]]])
    outwards = np.array([[-0.5, 0.5, 0.5, -0.5], [-0.5, -0.5, 0.5, 0.5]])
    corners = np.stack(lattice.points(*(ends + outwards)), axis=-1)
    return Cells(colours, spread, x, y, corners, strength / usual, usual, _beyond(of_columns, of_rows, rows, columns))


def _steady(samples: Rgb) -> tuple[FloatArray, FloatArray]:
    """Mean and range of lightness of the half of the samples that are nearest together, of each cell."""
    codes = samples.astype(np.float32)
    light = codes @ np.array([0.299, 0.587, 0.114], dtype=np.float32)
    order = light.argsort(axis=-1)
    ordered = np.take_along_axis(light, order, axis=-1)
    half = ordered.shape[-1] // 2
    ranges = ordered[..., half:] - ordered[..., : ordered.shape[-1] - half]
    first = ranges.argmin(axis=-1)[..., None]
    ranks = order.argsort(axis=-1)
    chosen = (ranks >= first) & (ranks <= first + half)
    mean = (codes * chosen[..., None]).sum(axis=-2) / chosen.sum(axis=-1)[..., None]
    return mean.astype(float), ranges.min(axis=-1).astype(float)


def _coherence(lattice: Lattice, energy: LineEnergy) -> tuple[FloatArray, FloatArray]:
    """How far the lines down are in phase in each cell of the window (as seen along rows), and the lines across."""
    left, right, upper, lower = window(lattice)
    down, across = (levelled(one, SAMPLES) for one in rectified(lattice, energy))
    by_cell = (lower - upper, SAMPLES, right - left, SAMPLES)
    wave = np.cos(2 * np.pi * (np.arange(SAMPLES) + 0.5) / SAMPLES)
    middle = slice(SAMPLES // 4, 3 * SAMPLES // 4)
    of_rows = down.reshape(by_cell)[:, middle].mean(axis=1) @ wave
    of_columns = np.einsum("rsc,s->rc", across.reshape(by_cell)[..., middle].mean(axis=-1), wave)
    return np.asarray(of_columns), np.asarray(of_rows)


def _visible(lattice: Lattice, width: int, height: int) -> BoolArray:
    """The cells of the window whose inner parts are in the picture."""
    left, right, upper, lower = window(lattice)
    u, v = np.meshgrid(np.arange(left, right) + 0.5, np.arange(upper, lower) + 0.5)
    inside = np.ones(u.shape, dtype=bool)
    for across in (-_VISIBLE, _VISIBLE):
        for along in (-_VISIBLE, _VISIBLE):
            x, y = lattice.points(u + across, v + along)
            inside &= (x >= 0) & (y >= 0) & (x <= width) & (y <= height)
    return inside


def _extent(of_columns: FloatArray, of_rows: FloatArray, seen: BoolArray, lattice: Lattice) -> tuple[slice, slice]:
    """The rows and columns of the window that the grid has."""
    left, _, upper, _ = window(lattice)
    low, high = np.rint(lattice.low).astype(int), np.rint(lattice.high).astype(int)
    rows = slice(int(low[1]) - upper + 2, int(high[1]) - upper - 2)
    columns = slice(int(low[0]) - left + 2, int(high[0]) - left - 2)
    if rows.stop <= rows.start or columns.stop <= columns.start:
        raise no_grid("its grid has too few cells")
    for _ in range(3):
        columns = _run(np.quantile(of_columns[rows], _MOSTLY, axis=0), columns, seen[rows].mean(axis=0) > 0.98)
        rows = _run(np.quantile(of_rows[:, columns], _MOSTLY, axis=1), rows, seen[:, columns].mean(axis=1) > 0.98)
    if min(rows.stop - rows.start, columns.stop - columns.start) < LEAST_CELLS:
        raise no_grid("its grid has too few cells")
    return rows, columns


def _run(coherence: FloatArray, core: slice, seen: BoolArray) -> slice:
    """The run about the core's middle in which the lines go on; one row or column without lines may lie within."""
    if not seen.any():
        raise no_grid("no whole cell is in the picture")
    usual = float(np.median(coherence[core]))
    on = (coherence >= _LEAST_SHARE * usual) & seen
    middle = int(core.start + core.stop) // 2

    def end(step: int) -> int:
        at = middle
        while 0 <= at + step < len(on):
            if on[at + step]:
                at += step
            elif 0 <= at + 3 * step < len(on) and on[at + 2 * step] and on[at + 3 * step]:
                at += 2 * step
            else:
                break
        return at

    return slice(end(-1), end(1) + 1)


def _beyond(of_columns: FloatArray, of_rows: FloatArray, rows: slice, columns: slice) -> float:
    """The largest share, of the four sides, of cells just outside in which the lines that cross the side go on."""
    shares: list[float] = []
    for coherence, beside, along in ((of_columns.T, columns, rows), (of_rows, rows, columns)):
        usual = float(np.median(coherence[beside, along]))
        outside = [one for one in (beside.start - 1, beside.stop) if 0 <= one < len(coherence)]
        shares += [float(np.mean(coherence[one, along] > 0.5 * usual)) for one in outside]
    return max(shares, default=0.0)
