"""Cells: how many the grid has, and the colour in the middle of each.

A column of cells belongs to the grid where the lines across go on in it: the energy of the lines there, taken over all
rows, is in phase with the lattice. Numbers in the margin and the edge of the sheet are not. Rows likewise.

The colour of a cell is the mean of that half of its inner samples whose lightnesses are nearest together: lines,
letters and dots are in the other half.
"""

from dataclasses import replace

import numpy as np
import scipy

from ilmek.arrays import BoolArray, Complex, Float, FloatArray, Rgb, UInt8
from ilmek.carpet.paper.lattice import SAMPLES, Lattice, divided, rectified, window
from ilmek.carpet.paper.lines import LineEnergy, levelled, no_grid
from ilmek.carpet.paper.placing import RINGS
from ilmek.carpet.picture_points import Points
from ilmek.records import record

LEAST_CELLS = 4
"""Least number of rows and of columns of a grid."""

_LEAST_SHARE, _SURE = 0.3, 0.5
"""Least coherence of an outer row or column of cells, of the median one; coherence that is enough."""

_MOSTLY = 0.7
"""Quantile of the cells of a row or column that is its coherence: lines may be missing in many."""

_INNER, _ALONG, _LINE = 0.28, 7, 2.4
"""Half side of the inner part of a cell, at most; the samples along it; its least distance from a line [pixels]."""

_ALL_ALONG, _ALONG_IT = 0.8, 0.7
"""Share of the rows in which the last line of a grid is clear, and below which a line is no last one."""

_DIM, _CONTRAST, _WEAK, _MOST_STRAY = 3, 4.0, 0.35, 6
"""Columns whose own lines may hardly show; their least coherence over that beyond; least one of a column, of the
median, behind a line that could be the last, and the number of columns behind it that may be none."""

_NONE, _WHOLE = 0.04, 0.95
"""Coherence, of the median, of a column that hardly is one, and the share of a line that ends it all the same."""

_BLANK, _LEAST_CLEARNESS = 0.05, 0.5
"""Coherence of blank paper, at least, of the median; least difference of the levels of a clear line and of the middles
of cells."""

MOST_ALTERNATING = 0.3
"""Largest such difference of the lines of a sheet; 0.4 and more where the pitch is half or half of five."""

_BANDS, _SMOOTH, _PLACES = 6, 5, 12
"""Bands of rows in which the course of the columns is judged, the greatest degree of a smooth one, and the columns for
each degree."""

_FURTHER, _MOST_WINDOWS = 10, 4
"""Cells by which the window is made larger where the grid goes on at its edge, and how often."""

_VISIBLE = 0.3
"""Half side of the part of each outer cell that has to be in the picture."""


@record
class Cells:
    """The cells of a grid.

    colours  mean of the steady half of the samples of each, sRGB codes (rows, columns, 3)
    spread   range of the lightness of that half [codes]
    around   colours, with RINGS rows and columns more on each side (rows, columns, 3)
    x, y     their middles in the picture [pixels]
    corners   of the grid in the picture, clockwise from the upper left
    beyond    share of the cells next to the grid in which lines go on, on the worst side
    end       share of the last line that is clear, on the worst side
    uneven    greatest distance of a line from where a smooth sheet has it, of the pitch
    alternating  difference of the clear shares of even and odd lines, of their sum, down or across: 0 to 1
    strength  coherence of the lines about each cell, over `usual`, that of the median cell
    """

    colours: Float[np.ndarray, "rows columns 3"]
    spread: Float[np.ndarray, "rows columns"]
    around: Float[np.ndarray, "wider_rows wider_columns 3"]
    x: Float[np.ndarray, "rows columns"]
    y: Float[np.ndarray, "rows columns"]
    corners: Points
    strength: Float[np.ndarray, "rows columns"]
    usual: float
    beyond: float
    end: float
    uneven: float
    alternating: float


@record
class _Lines:
    """The lines in the cells of the window.

    of_columns       how far the lines across are in phase in each cell
    down             how clear each piece of the lines down is, over the middles beside it
    of_rows, across  likewise of the lines down, and of each piece of the lines across
    """

    of_columns: Float[np.ndarray, "rows columns"]
    of_rows: Float[np.ndarray, "rows columns"]
    down: Float[np.ndarray, "rows columns+1"]
    across: Float[np.ndarray, "rows+1 columns"]

    @property
    def turned(self) -> "_Lines":
        """Rows as columns."""
        return _Lines(self.of_rows.T, self.of_columns.T, self.across.T, self.down.T)


def read_cells(rgb: Rgb, energy: LineEnergy, lattice: Lattice) -> Cells:
    """The cells of the grid in a picture. Raises PictureError where they are too few."""
    lattice, lines, seen, rows, columns = _whole_grid(rgb, energy, lattice)
    left, _, upper, _ = window(lattice)
    strength = lines.of_columns[rows, columns] + lines.of_rows[rows, columns]
    usual = max(float(np.median(strength)), 1e-9)
    u = left + np.arange(columns.start - RINGS, columns.stop + RINGS) + 0.5
    v = upper + np.arange(rows.start - RINGS, rows.stop + RINGS) + 0.5
    around, all_spread, all_x, all_y = _sampled(rgb, lattice, u, v, energy.factor * min(energy.pitch_x, energy.pitch_y))
    inside = slice(RINGS, -RINGS)
    colours, spread, x, y = (one[inside, inside] for one in (around, all_spread, all_x, all_y))
    u, v = u[inside], v[inside]
    ends = np.array([[u[0], u[-1], u[-1], u[0]], [v[0], v[0], v[-1], v[-1]]])
    outwards = np.array([[-0.5, 0.5, 0.5, -0.5], [-0.5, -0.5, 0.5, 0.5]])
    corners = np.stack(lattice.points(*(ends + outwards)), axis=-1)
    beyond = max(_beyond(lines, rows, columns), _beyond(lines.turned, columns, rows))
    end = min(_end(lines, rows, columns, seen), _end(lines.turned, columns, rows, seen.T))
    alternating = min(_alternating(lines, rows, columns), _alternating(lines.turned, columns, rows))
    points = x + 1j * y
    uneven = max(_uneven(points), _uneven(points.T))
    return Cells(colours, spread, around, x, y, corners, strength / usual, usual, beyond, end, uneven, alternating)


def _sampled(
    rgb: Rgb, lattice: Lattice, u: FloatArray, v: FloatArray, pitch: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """The colours of the cells with their middles at u, v, the range of lightness in each, and x and y of the middles.

    Cells outside the picture are like those at its edge.
    """
    inner = np.linspace(-1, 1, _ALONG) * min(_INNER, max(0.15, 0.5 - _LINE / pitch))
    x, y = lattice.mesh((u[:, None] + inner).ravel(), (v[:, None] + inner).ravel())
    samples = rgb[
        np.clip(np.floor(y), 0, rgb.shape[0] - 1).astype(np.intp),
        np.clip(np.floor(x), 0, rgb.shape[1] - 1).astype(np.intp),
    ]
    shape = (len(v), _ALONG, len(u), _ALONG)
    by_cell = samples.reshape(*shape, 3).swapaxes(1, 2).reshape(len(v), len(u), _ALONG**2, 3)
    middle = _ALONG // 2
    x, y = (one.reshape(shape)[:, middle, :, middle] for one in (x, y))
    return *_steady(by_cell), x, y


def _whole_grid(rgb: Rgb, energy: LineEnergy, lattice: Lattice) -> tuple[Lattice, _Lines, BoolArray, slice, slice]:
    """The lattice with a window that holds the whole grid, its lines, visible cells, rows and columns."""
    for further in range(_MOST_WINDOWS, -1, -1):
        lines = _lines(lattice, energy)
        seen = _visible(lattice, int(rgb.shape[1]), int(rgb.shape[0]))
        rows, columns = _extent(lines, seen, lattice)
        before = np.array([columns.start == 0, rows.start == 0])
        after = np.array([columns.stop, rows.stop]) == seen.shape[::-1]
        if not further or not (before.any() or after.any()):
            break
        low, high = lattice.low - _FURTHER * before, lattice.high + _FURTHER * after
        lattice = divided(replace(lattice, low=low, high=high), 1, energy)
    return lattice, lines, seen, rows, columns


def _steady(samples: UInt8[np.ndarray, "rows columns samples 3"]) -> tuple[FloatArray, FloatArray]:
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


def _lines(lattice: Lattice, energy: LineEnergy) -> _Lines:
    left, right, upper, lower = window(lattice)
    down, across = (levelled(one, SAMPLES) for one in rectified(lattice, energy))
    by_cell = (lower - upper, SAMPLES, right - left, SAMPLES)
    wave = np.cos(2 * np.pi * (np.arange(SAMPLES) + 0.5) / SAMPLES)
    middle = slice(SAMPLES // 4, 3 * SAMPLES // 4)
    over_columns = down.reshape(by_cell)[:, middle].mean(axis=1)
    over_rows = across.reshape(by_cell)[..., middle].mean(axis=-1).swapaxes(1, 2)
    clear_across = _clearness(over_rows.swapaxes(0, 1)).T
    return _Lines(over_rows @ wave, over_columns @ wave, _clearness(over_columns), clear_across)


def _clearness(profiles: Float[np.ndarray, "rows columns samples"]) -> Float[np.ndarray, "rows columns+1"]:
    """The levels at the ends of the cells less those in their middles; 0 at the ends of the window."""
    middles = profiles[..., SAMPLES // 2 - 1 : SAMPLES // 2 + 1].mean(axis=-1)
    ends = 0.5 * (profiles[:, 1:, 0] + profiles[:, :-1, -1])
    return np.pad(ends - 0.5 * (middles[:, 1:] + middles[:, :-1]), ((0, 0), (1, 1)))


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


def _extent(lines: _Lines, seen: BoolArray, lattice: Lattice) -> tuple[slice, slice]:
    """The rows and columns of the window that the grid has."""
    left, _, upper, _ = window(lattice)
    low, high = np.rint(lattice.low).astype(int), np.rint(lattice.high).astype(int)
    rows = slice(int(low[1]) - upper + 2, int(high[1]) - upper - 2)
    columns = slice(int(low[0]) - left + 2, int(high[0]) - left - 2)
    if rows.stop <= rows.start or columns.stop <= columns.start:
        raise no_grid("its grid has too few cells")
    for _ in range(3):
        columns = _run(np.quantile(lines.of_columns[rows], _MOSTLY, axis=0), columns, seen[rows].mean(axis=0) > 0.98)
        columns = _to_the_edge(lines, columns, rows, seen)
        rows = _run(np.quantile(lines.of_rows[:, columns], _MOSTLY, axis=1), rows, seen[:, columns].mean(axis=1) > 0.98)
        rows = _to_the_edge(lines.turned, rows, columns, seen.T)
    if min(rows.stop - rows.start, columns.stop - columns.start) < LEAST_CELLS:
        raise no_grid("its grid has too few cells")
    return rows, columns


def _to_the_edge(lines: _Lines, columns: slice, rows: slice, seen: BoolArray) -> slice:
    """The columns, with those beside them whose own lines hardly show, but which end at a line that does.

    The last line of a grid is there all along it. A margin of paper ends at such a line, too, the edge of the sheet: in
    more than one column the lines across have to show more than beyond. A column without lines behind one is none.
    """
    share = _clear_lines(lines.down[rows], columns).mean(axis=0)
    coherence = np.quantile(lines.of_columns[rows], _MOSTLY, axis=0)
    usual = float(np.median(coherence[columns]))
    visible = seen[rows].mean(axis=0) > 0.98

    def beside(last: int, first: int, count: int, outwards: int) -> FloatArray:
        """The coherence of so many columns outside of the line last, the first ones left out."""
        step = first if outwards > 0 else -first - count
        part = slice(max(0, last + step), max(0, last + step + count))
        return np.asarray(coherence[part][visible[part]])

    def end(last: int, outwards: int) -> int:
        for count in range(_DIM, 0, -1):
            line, between = last + count * outwards, beside(last, 0, count, outwards)
            if not 0 < line < len(share) or len(between) < count or share[line] < _ALL_ALONG:
                continue
            noise = np.median(np.append(beside(last, count, 3, outwards), 0.0))
            clear = between.min() > _CONTRAST * max(float(noise), _BLANK * usual)
            if clear or (count == 1 and (between.min() >= _NONE * usual or share[last] < share[line])):
                return line
        for count in range(1, _MOST_STRAY + 1):
            line, outer = last - count * outwards, coherence[last - count if outwards > 0 else last + count - 1]
            blank = outer < _NONE * usual and share[last] < min(share[line], _WHOLE)
            stray = outer < _WEAK * usual and (blank or share[last] < _ALONG_IT)
            if not stray or line in (columns.start, columns.stop):
                break
            if share[line] >= _ALL_ALONG:
                return line
        return last

    return slice(end(columns.start, -1), end(columns.stop, 1))


def _clear_lines(clearness: Float[np.ndarray, "rows lines"], columns: slice) -> BoolArray:
    """Where each line down is clear, over three rows."""
    usual = float(np.median(clearness[:, columns.start + 1 : columns.stop]))
    mean = scipy.ndimage.uniform_filter1d(clearness, 3, axis=0, mode="nearest")
    return np.asarray(mean > max(0.5 * usual, _LEAST_CLEARNESS))


def _run(coherence: FloatArray, core: slice, seen: BoolArray) -> slice:
    """The run about the core's middle in which the lines go on; one row or column without lines may lie within."""
    if not seen.any():
        raise no_grid("no whole cell is in the picture")
    usual = float(np.median(coherence[core]))
    on = (coherence >= min(_LEAST_SHARE * usual, _SURE)) & seen
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


def _end(lines: _Lines, rows: slice, columns: slice, seen: BoolArray) -> float:
    """The share of the last line that is clear, on the side where it is least; 1 where the picture ends at it.

    Counted where the next cell is in the picture, too.
    """
    clear = _clear_lines(lines.down[rows], columns)
    shares = []
    for line, beyond in ((columns.start, columns.start - 1), (columns.stop, columns.stop)):
        if 0 <= beyond < seen.shape[1] and np.count_nonzero(seen[rows, beyond]) >= LEAST_CELLS:
            shares.append(float(clear[seen[rows, beyond], line].mean()))
    return min(shares, default=1.0)


def _alternating(lines: _Lines, rows: slice, columns: slice) -> float:
    """How unequal the shares of clear pieces of even and of odd lines down are, without the outer ones.

    Lines of half the pitch, or of half the distance of heavy lines, are there at every second place only.
    """
    share = _clear_lines(lines.down[rows], columns).mean(axis=0)[columns.start + _DIM : columns.stop - _DIM + 1]
    if len(share) < 2:
        return 0.0
    even, odd = float(share[::2].mean()), float(share[1::2].mean())
    return abs(even - odd) / max(even + odd, 1e-9)


def _uneven(points: Complex[np.ndarray, "rows columns"]) -> float:
    """The greatest distance of columns of cells from a smooth course, of their mean distance, in bands of rows.

    A camera, a bend and a turn give a smooth course. A column that was counted twice, or left out, gives a step, which
    the corrections of the lattice spread over some columns.
    """
    bands = np.array_split(points, min(_BANDS, len(points)))
    places = np.stack([band.mean(axis=0) for band in bands], axis=-1)
    count = len(places)
    smooth = np.polynomial.legendre.legvander(np.linspace(-1, 1, count), int(np.clip(count // _PLACES, 2, _SMOOTH)))
    off = places - smooth @ (np.linalg.pinv(smooth) @ places)
    pitch = np.abs(places[-1] - places[0]) / (count - 1)
    return float((np.abs(off).max(axis=0) / np.maximum(pitch, 1e-9)).max())


def _beyond(lines: _Lines, rows: slice, columns: slice) -> float:
    """The share of cells left or right of the grid in which the lines across go on."""
    usual = float(np.median(lines.of_columns[rows, columns]))
    outside = [one for one in (columns.start - 1, columns.stop) if 0 <= one < lines.of_columns.shape[1]]
    return max((float(np.mean(lines.of_columns[rows, one] > 0.5 * usual)) for one in outside), default=0.0)
