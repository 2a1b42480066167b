"""Lattice: where each line of the grid lies in the picture, on a sheet that is bent and seen at an angle.

1. In tiles of some cells the spectrum of the line energy has a peak at the wave vector of the lines; the phase at the
   tile's centre says where the nearest line is, as a part of the pitch.
2. The phases are continued from tile to tile, the clearest first: each tile's centre gets a number of columns u and of
   rows v that grows by one from line to line.
3. A polynomial (x, y) = P(u, v) is fitted to the tiles without the outliers.
4. The energy is read through P, cell by cell, and the phase that is left in blocks of cells, smoothed, corrects P.
   Blocks at the edge of the grid are measured, not extrapolated.

Source of 1 and 2: M. Takeda, H. Ina, S. Kobayashi, Fourier-transform method of fringe-pattern analysis, J. Opt. Soc.
Am. 72 (1982) 156-160; quality-guided: D. C. Ghiglia, M. D. Pritt, Two-dimensional phase unwrapping (1998), 4.3.
"""

import heapq
from dataclasses import replace

import numpy as np
import scipy

from ilmek.arrays import BoolArray, Float, FloatArray
from ilmek.carpet.paper.lines import Energy, LineEnergy, levelled, no_grid
from ilmek.records import record

_TILE, _STEP = 64, 32
"""Side and distance of the tiles [pixels of the reduced energy]."""

_SLOPE = 0.35
"""Largest tangent of the angle between lines and the picture's sides."""

_LEAST_QUALITY = 1.2
"""Least logarithm of the highest power of a tile over the mean."""

_DEGREE, _ROUNDS, _TILES_A_DEGREE = 5, 3, 20
"""Greatest degree of P, number of corrections, and least number of tiles for each degree."""

_BLOCK, SAMPLES = 4, 8
"""Cells of a block, and samples of a cell, along each side."""

_LEAST_COHERENCE = 0.06
"""Least share of a block's levelled energy that lies on the lines."""

BEYOND = 4
"""Cells around the tiles that are looked at."""


@record
class Tiles:
    """The lines down, or across, in tiles: wave vectors [cycles/pixel], phases at the centres [cycles], qualities,
    and mean energies [codes]."""

    waves: Float[np.ndarray, "rows columns 2"]
    phases: Float[np.ndarray, "rows columns"]
    qualities: Float[np.ndarray, "rows columns"]
    energies: Float[np.ndarray, "rows columns"]


@record
class Lattice:
    """The lines of a grid: those of whole u go down, those of whole v across.

    terms       coefficients of P, x and y of the picture [pixels]
    centre, scale  of (u, v) in the terms of P
    first       (u, v) of the first block of the corrections, whose blocks have _BLOCK cells
    shift       corrections of (u, v), (blocks down, blocks across, 2)
    low, high   least and greatest (u, v) of the tiles
    """

    terms: Float[np.ndarray, "terms 2"]
    centre: Float[np.ndarray, " 2"]
    scale: float
    first: Float[np.ndarray, " 2"]
    shift: Float[np.ndarray, "down across 2"]
    low: Float[np.ndarray, " 2"]
    high: Float[np.ndarray, " 2"]

    def points(self, u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The points (x, y) of the picture at u, v of any one shape."""
        at = [(v - self.first[1]) / _BLOCK - 0.5, (u - self.first[0]) / _BLOCK - 0.5]
        moved = [
            scipy.ndimage.map_coordinates(self.shift[..., axis], at, order=1, mode="nearest", output=float)
            for axis in range(2)
        ]
        terms = _terms(
            (u + moved[0] - self.centre[0]) / self.scale, (v + moved[1] - self.centre[1]) / self.scale, len(self.terms)
        )
        return terms @ self.terms[:, 0], terms @ self.terms[:, 1]

    def mesh(self, u: Float[np.ndarray, " columns"], v: Float[np.ndarray, " rows"]) -> tuple[FloatArray, FloatArray]:
        """The points (x, y) at all pairs of ascending u and v, (rows, columns), straight between the cells' corners."""
        lines_u, lines_v = (np.arange(np.floor(one[0]), np.ceil(one[-1]) + 1) for one in (u, v))
        corners = self.points(*np.meshgrid(lines_u, lines_v))
        across, along = _between(u - lines_u[0], len(lines_u)), _between(v - lines_v[0], len(lines_v))
        x, y = (along @ one @ across.T for one in corners)
        return x, y


def _between(at: Float[np.ndarray, " places"], count: int) -> Float[np.ndarray, "places count"]:
    """The matrix of the linear interpolation at places between 0 and count - 1."""
    first = np.clip(np.floor(at).astype(int), 0, count - 2)
    matrix = np.zeros((len(at), count))
    rows = np.arange(len(at))
    matrix[rows, first], matrix[rows, first + 1] = 1 - (at - first), at - first
    return matrix


def find_lattice(energy: LineEnergy) -> Lattice:
    """The lattice of the lines of a sheet. Raises PictureError where it is not found."""
    down = _tiles(energy.all_down, energy.down, energy.pitch_x)
    across = _tiles(energy.all_across.T, energy.across.T, energy.pitch_y)
    across = Tiles(across.waves.transpose(1, 0, 2)[..., ::-1], across.phases.T, across.qualities.T, across.energies.T)
    u, v = _continued(down), _continued(across)
    seen = np.isfinite(u) & np.isfinite(v)
    if np.count_nonzero(seen) < 4:
        raise no_grid("its lines cannot be followed")
    row, column = np.nonzero(seen)
    centres = np.stack([column * _STEP + _TILE / 2, row * _STEP + _TILE / 2], axis=-1) * energy.factor
    fitted = _fitted(u[seen], v[seen], centres)
    for _ in range(_ROUNDS):
        fitted = _corrected(fitted, energy)
    return fitted


def _tiles(everything: Energy, lines: Energy, pitch: float) -> Tiles:
    """The tiles of the lines down: waves by the spectrum of everything around, phases by the lines alone."""
    energies = _tiled(lines).mean(axis=(2, 3))
    everything, lines = _windows(levelled(everything, pitch)), _windows(levelled(lines, pitch))
    size = 2 * _TILE
    ky, kx = np.meshgrid(np.fft.fftfreq(size), np.fft.rfftfreq(size), indexing="ij")
    length = np.hypot(kx, ky) * pitch
    allowed = (length > 0.55) & (length < 1.75) & (np.abs(ky) <= _SLOPE * kx)
    ky, kx = ky[allowed], kx[allowed]
    power = np.stack(
        [_power(one, allowed) + _power(other, allowed) for one, other in zip(everything, lines, strict=True)]
    )
    power = scipy.ndimage.uniform_filter(power, (3, 3, 1), mode="nearest")
    peak = power.argmax(axis=-1)
    near = np.hypot(kx[:, None] - kx, ky[:, None] - ky) < 2.5 / size
    weights = np.where(near[peak], power - 0.4 * power.max(axis=-1, keepdims=True), 0.0).clip(0)
    waves = np.stack([weights @ kx, weights @ ky], axis=-1) / weights.sum(axis=-1)[..., None].clip(1e-12)
    middle = np.arange(_TILE) + 0.5 - _TILE / 2
    along = np.exp(-2j * np.pi * waves[..., 0, None] * middle)[..., None]
    down = np.exp(-2j * np.pi * waves[..., 1, None] * middle)
    sums = lines @ along.real.astype(np.float32) + 1j * (lines @ along.imag.astype(np.float32))
    turned = (down * sums[..., 0]).sum(axis=-1)
    share = power.max(axis=-1) / power.mean(axis=-1).clip(1e-12)
    return Tiles(waves, np.angle(turned) / (2 * np.pi), np.log(share.clip(1e-9)), energies)


def _tiled(energy: Energy) -> Float[np.ndarray, "rows columns side side"]:
    """The tiles of an energy."""
    energy = np.pad(energy, [(0, max(0, _TILE - side)) for side in energy.shape], mode="edge")
    return np.lib.stride_tricks.sliding_window_view(energy, (_TILE, _TILE))[::_STEP, ::_STEP]


def _windows(energy: Energy) -> Float[np.ndarray, "rows columns side side"]:
    """The tiles of an energy, each without its mean, under a Hann window."""
    views = _tiled(energy)
    hann = np.hanning(_TILE + 2)[1:-1].astype(np.float32)
    window = hann[:, None] * hann
    mean = (views * window).sum(axis=(2, 3), keepdims=True) / window.sum()
    return np.asarray((views - mean) * window)


def _power(tiles: Float[np.ndarray, "columns side side"], allowed: BoolArray) -> FloatArray:
    """The square of the spectra of tiles at the allowed waves."""
    return np.asarray(np.abs(scipy.fft.rfft2(tiles, (2 * _TILE, 2 * _TILE))[:, allowed]) ** 2)


def _continued(tiles: Tiles) -> Float[np.ndarray, "rows columns"]:
    """The number of the line at each tile's centre, of those joined tiles that have the most energy; NaN: others.

    The noise of a table and the blocks of a JPEG repeat, too, but have little energy.
    """
    quality = np.where(tiles.qualities >= _LEAST_QUALITY, tiles.qualities, 0.0)
    most, kept = 0.0, np.full(quality.shape, np.nan)
    while quality.any():
        number = _joined(tiles, quality)
        joined = np.isfinite(number)
        quality[joined] = 0.0
        energy = float(tiles.energies[joined].sum())
        if energy > most:
            most, kept = energy, number
    return kept


def _joined(tiles: Tiles, quality: FloatArray) -> Float[np.ndarray, "rows columns"]:
    """The number of the line at each tile's centre, continued from the clearest tile; NaN: not joined to it."""
    number = np.full(quality.shape, np.nan)
    rows, columns = quality.shape
    start = np.unravel_index(int(quality.argmax()), quality.shape)
    number[start] = tiles.phases[start]
    waiting: list[tuple[float, int, int, float]] = []

    def spread(row: int, column: int) -> None:
        for down, right in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            r, c = row + down, column + right
            if not (0 <= r < rows and 0 <= c < columns) or quality[r, c] == 0 or np.isfinite(number[r, c]):
                continue
            wave = 0.5 * (tiles.waves[row, column] + tiles.waves[r, c])
            expected = number[row, column] + _STEP * (right * wave[0] + down * wave[1])
            continued = tiles.phases[r, c] + round(expected - tiles.phases[r, c])
            bend = np.hypot(*(tiles.waves[row, column] - tiles.waves[r, c])) / np.hypot(*wave)
            cost = abs(continued - expected) + bend
            if abs(continued - expected) < 0.3 and bend < 0.25:
                heapq.heappush(waiting, (cost - quality[r, c], r, c, continued))

    spread(int(start[0]), int(start[1]))
    while waiting:
        _, row, column, continued = heapq.heappop(waiting)
        if np.isnan(number[row, column]):
            number[row, column] = continued
            spread(row, column)
    return number


def _terms(u: FloatArray, v: FloatArray, count: int) -> FloatArray:
    """The first products of powers of u and v, by their degree."""
    powers = [(i, degree - i) for degree in range(_DEGREE + 1) for i in range(degree + 1)]
    return np.stack([u**i * v**j for i, j in powers[:count]], axis=-1)


def _fitted(u: FloatArray, v: FloatArray, points: Float[np.ndarray, "tiles 2"]) -> Lattice:
    """P by least squares, points weighted down beyond a quarter of a cell."""
    low, high = np.array([u.min(), v.min()]), np.array([u.max(), v.max()])
    centre, scale = 0.5 * (low + high), float(max(1.0, 0.5 * (high - low).max()))
    degree = next((degree for degree in range(_DEGREE, 1, -1) if len(u) >= _TILES_A_DEGREE * degree), 1)
    terms = _terms((u - centre[0]) / scale, (v - centre[1]) / scale, (degree + 1) * (degree + 2) // 2)
    pitch = float(np.ptp(points[:, 0]) + np.ptp(points[:, 1])) / max(1.0, float((high - low).sum()))
    weights: FloatArray = np.ones(len(u))
    ridge = 1e-4 * np.eye(terms.shape[1])
    ridge[0, 0] = 0
    for _ in range(12):
        weighted = terms * weights[:, None]
        found = np.linalg.solve(weighted.T @ terms + ridge, weighted.T @ points)
        off = np.hypot(*(terms @ found - points).T) / pitch
        weights = 1 / (1 + (off / 0.25) ** 2) ** 2
    on = off < 1.0
    if np.count_nonzero(on) < max(4, 0.5 * len(u)):
        raise no_grid("its lines do not form one grid")
    low, high = np.array([u[on].min(), v[on].min()]), np.array([u[on].max(), v[on].max()])
    return Lattice(found, centre, scale, np.zeros(2), np.zeros((1, 1, 2)), low, high)


def window(lattice: Lattice) -> tuple[int, int, int, int]:
    """The first and last lines that are looked at: left, right, upper, lower."""
    low, high = np.floor(lattice.low).astype(int), np.ceil(lattice.high).astype(int)
    reach = _TILE // 10 + BEYOND
    return int(low[0]) - reach, int(high[0]) + reach, int(low[1]) - reach, int(high[1]) + reach


def rectified(lattice: Lattice, energy: LineEnergy) -> tuple[FloatArray, FloatArray]:
    """The energies down and across in the cells of the window, SAMPLES × SAMPLES a cell; 0 outside the picture."""
    left, right, upper, lower = window(lattice)
    u = left + (np.arange((right - left) * SAMPLES) + 0.5) / SAMPLES
    v = upper + (np.arange((lower - upper) * SAMPLES) + 0.5) / SAMPLES
    x, y = lattice.mesh(u, v)
    at = [y / energy.factor - 0.5, x / energy.factor - 0.5]
    down, across = (scipy.ndimage.map_coordinates(one, at, order=1, cval=0.0) for one in (energy.down, energy.across))
    return down, across


def _corrected(lattice: Lattice, energy: LineEnergy) -> Lattice:
    """The lattice with its corrections: the phase that is left in blocks of cells."""
    left, right, upper, lower = window(lattice)
    down, across = rectified(lattice, energy)
    phase = np.exp(-2j * np.pi * (np.arange(SAMPLES) + 0.5) / SAMPLES)
    by_cell = (lower - upper, SAMPLES, right - left, SAMPLES)
    of_columns = levelled(down, SAMPLES).reshape(by_cell).sum(axis=1) @ phase
    of_rows = np.einsum("rsct,s->rc", levelled(across, SAMPLES).reshape(by_cell), phase)
    shift = []
    for energy_of, amplitude in ((down, of_columns), (across, of_rows)):
        blocks, all_of = _blocks(amplitude), _blocks((energy_of > 0).reshape(by_cell).sum(axis=(1, 3)))
        shift.append(_smooth_phase(blocks, all_of))
    added = np.stack(shift, axis=-1)
    first = np.array([left, upper], dtype=float)
    before = lattice.shift if lattice.shift.shape == added.shape else np.zeros_like(added)
    return replace(lattice, first=first, shift=before + np.clip(added, -0.3, 0.3))


def _smooth_phase(blocks: FloatArray, samples: FloatArray) -> FloatArray:
    """The phases [cycles] of blocks of so many samples, those without lines from the blocks nearest to them."""
    clear = np.abs(blocks) > _LEAST_COHERENCE * np.maximum(samples, 1)
    if not clear.any():
        return np.zeros(blocks.shape)
    kept = np.where(clear, blocks, 0)
    smooth = scipy.ndimage.gaussian_filter(kept.real, 0.7) + 1j * scipy.ndimage.gaussian_filter(kept.imag, 0.7)
    rows, columns = scipy.ndimage.distance_transform_edt(~clear, return_distances=False, return_indices=True)
    return np.asarray(-np.angle(smooth[rows, columns]) / (2 * np.pi))


def _blocks(amplitude: FloatArray) -> FloatArray:
    """The sums over blocks of _BLOCK × _BLOCK cells, the last ones as far as they go."""
    rows, columns = amplitude.shape
    padded = np.pad(amplitude, ((0, -rows % _BLOCK), (0, -columns % _BLOCK)))
    return np.asarray(
        padded.reshape(padded.shape[0] // _BLOCK, _BLOCK, padded.shape[1] // _BLOCK, _BLOCK).sum(axis=(1, 3))
    )
