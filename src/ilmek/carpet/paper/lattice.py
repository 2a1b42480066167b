"""Lattice: where each line of the grid lies in the picture, on a sheet that is bent and seen at an angle.

1. Each tile's centre gets a number of columns u and of rows v [`tiles`].
2. A plane seen in perspective is fitted to the tiles, without the outliers, and to what is left, the bend of the sheet,
   a polynomial: (x, y) = H(u, v) + P(u, v).
3. Once more with the waves near those that H has: no heavy line, no letter is taken for a line in a faint part.
4. The energy is read through H + P, cell by cell, and the phase that is left in blocks of cells, smoothed, corrects it.
   Blocks at the edge of the grid are measured, not extrapolated.

Source of H: R. Hartley, A. Zisserman, Multiple view geometry (2004), 4.1.
"""

from dataclasses import replace

import numpy as np
import scipy

from ilmek.arrays import ComplexArray, Float, FloatArray, Num
from ilmek.carpet.paper.lines import LineEnergy, levelled, no_grid
from ilmek.carpet.paper.tiles import SIDE, STEP, Spectra, continued, spectra, tiles
from ilmek.records import record

_DEGREE, _ROUNDS, _TILES_A_DEGREE = 5, 3, 20
"""Greatest degree of P, number of corrections, and least number of tiles for each degree."""

_RIGID = 1e-4
"""Weight of the coefficients of P, beside that of a tile."""

_BLOCK, SAMPLES = 4, 8
"""Cells of a block, and samples of a cell, along each side."""

_LEAST_COHERENCE = 0.06
"""Least share of a block's levelled energy that lies on the lines."""

BEYOND = 4
"""Cells around the tiles that are looked at."""


@record
class Lattice:
    """The lines of a grid: those of whole u go down, those of whole v across.

    plane       H, from (u, v) to the picture [pixels]
    bend        coefficients of P, x and y of the picture [pixels]
    centre, scale  of (u, v) in H and P
    first       (u, v) of the first block of the corrections, whose blocks have _BLOCK cells
    shift       corrections of (u, v), (blocks down, blocks across, 2)
    low, high   least and greatest (u, v) of the tiles
    """

    plane: Float[np.ndarray, "3 3"]
    bend: Float[np.ndarray, "terms 2"]
    centre: Float[np.ndarray, " 2"]
    scale: float
    first: Float[np.ndarray, " 2"]
    shift: Float[np.ndarray, "down across 2"]
    low: Float[np.ndarray, " 2"]
    high: Float[np.ndarray, " 2"]

    def points(self, u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The points (x, y) of the picture at u, v of any one shape."""
        moved = self.moved(u, v)
        s = (u + moved[0] - self.centre[0]) / self.scale
        t = (v + moved[1] - self.centre[1]) / self.scale
        x, y = _projected(self.plane, s, t)
        terms = _terms(s, t, len(self.bend))
        return x + terms @ self.bend[:, 0], y + terms @ self.bend[:, 1]

    def moved(self, u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The corrections of u and of v there."""
        at = [(v - self.first[1]) / _BLOCK - 0.5, (u - self.first[0]) / _BLOCK - 0.5]
        of_u, of_v = (
            scipy.ndimage.map_coordinates(self.shift[..., axis], at, order=1, mode="nearest", output=float)
            for axis in range(2)
        )
        return of_u, of_v

    def mesh(self, u: Float[np.ndarray, " columns"], v: Float[np.ndarray, " rows"]) -> tuple[FloatArray, FloatArray]:
        """The points (x, y) at all pairs of ascending u and v, (rows, columns), straight between the cells' corners."""
        lines_u, lines_v = (np.arange(np.floor(one[0]), np.ceil(one[-1]) + 1) for one in (u, v))
        corners = self.points(*np.meshgrid(lines_u, lines_v))
        across, along = _between(u - lines_u[0], len(lines_u)), _between(v - lines_v[0], len(lines_v))
        x, y = (along @ corner @ across.T for corner in corners)
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
    of_u = spectra(energy.all_down, energy.down, energy.pitch_x)
    of_v = spectra(energy.all_across.T, energy.across.T, energy.pitch_y)
    row, column = np.indices(of_u.shape)
    centres = (np.stack([column, row], axis=-1) * STEP + 0.5 * SIDE) * energy.factor
    fitted = _fitted(_numbers(of_u, energy.pitch_x), _numbers(of_v, energy.pitch_y).T, centres)
    waves = _waves(fitted, centres) * energy.factor
    u, v = continued(tiles(of_u, waves[..., 0, :])), continued(tiles(of_v, waves[..., 1, ::-1].swapaxes(0, 1))).T
    fitted = _fitted(u, v, centres)
    for _ in range(_ROUNDS):
        fitted = _corrected(fitted, energy)
    return fitted


def divided(lattice: Lattice, parts: int, energy: LineEnergy) -> Lattice:
    """The lattice whose cells are so many parts of a cell, along both sides; `energy`: of the finer lines."""
    low, high = lattice.low * parts, lattice.high * parts
    finer = replace(lattice, centre=lattice.centre * parts, scale=lattice.scale * parts, low=low, high=high)
    left, right, upper, lower = window(finer)
    u = np.arange(left, right, _BLOCK) + 0.5 * _BLOCK
    v = np.arange(upper, lower, _BLOCK) + 0.5 * _BLOCK
    shift = parts * np.stack(lattice.moved(*(one / parts for one in np.meshgrid(u, v))), axis=-1)
    finer = replace(finer, first=np.array([left, upper], dtype=float), shift=shift)
    for _ in range(_ROUNDS):
        finer = _corrected(finer, energy)
    return finer


def _numbers(of: Spectra, pitch: float) -> Float[np.ndarray, "rows columns"]:
    """The numbers of the lines by waves in a wide range, or near the pitch: those of which more is joined."""
    everywhere = np.broadcast_to([1 / pitch, 0.0], (*of.shape, 2))
    both = [continued(tiles(of, expected)) for expected in (None, everywhere)]
    return max(both, key=lambda number: float(of.energies[np.isfinite(number)].sum()))


def _terms(u: FloatArray, v: FloatArray, count: int) -> FloatArray:
    """The first products of powers of u and v, by their degree."""
    powers = [(i, degree - i) for degree in range(_DEGREE + 1) for i in range(degree + 1)]
    return np.stack([u**i * v**j for i, j in powers[:count]], axis=-1)


def _fitted(
    u: Float[np.ndarray, "rows columns"], v: Float[np.ndarray, "rows columns"], at: Float[np.ndarray, "rows columns 2"]
) -> Lattice:
    """H and P by least squares, points weighted down beyond a cell, and a quarter of one. NaN: no line is there."""
    seen = np.isfinite(u) & np.isfinite(v)
    if np.count_nonzero(seen) < 4:
        raise no_grid("its lines cannot be followed")
    u, v, points = u[seen], v[seen], at[seen]
    low, high = np.array([u.min(), v.min()]), np.array([u.max(), v.max()])
    centre, scale = 0.5 * (low + high), float(max(1.0, 0.5 * (high - low).max()))
    pitch = float(np.ptp(points[:, 0]) + np.ptp(points[:, 1])) / max(1.0, float((high - low).sum()))
    s, t = (u - centre[0]) / scale, (v - centre[1]) / scale
    plane = _plane(s, t, points, pitch)
    bent = points - np.stack(_projected(plane, s, t), axis=-1)
    degree = next((degree for degree in range(_DEGREE, 1, -1) if len(u) >= _TILES_A_DEGREE * degree), 1)
    terms = _terms(s, t, (degree + 1) * (degree + 2) // 2)
    weights: FloatArray = np.ones(len(u))
    for _ in range(12):
        weighted = terms * weights[:, None]
        bend = np.linalg.solve(weighted.T @ terms + _RIGID * np.eye(terms.shape[1]), weighted.T @ bent)
        off = np.hypot(*(terms @ bend - bent).T) / pitch
        weights = 1 / (1 + (off / 0.25) ** 2) ** 2
    on = off < 1.0
    if np.count_nonzero(on) < max(4, 0.5 * len(u)):
        raise no_grid("its lines do not form one grid")
    low, high = np.array([u[on].min(), v[on].min()]), np.array([u[on].max(), v[on].max()])
    return Lattice(plane, bend, centre, scale, np.zeros(2), np.zeros((1, 1, 2)), low, high)


def _plane(
    s: FloatArray, t: FloatArray, points: Float[np.ndarray, "tiles 2"], pitch: float
) -> Float[np.ndarray, "3 3"]:
    """H: x = (h₀ · p)/(h₂ · p), y = (h₁ · p)/(h₂ · p), p = (s, t, 1), h₂₂ = 1."""
    middle, size = points.mean(axis=0), float(max(1.0, np.ptp(points, axis=0).max()))
    x, y = ((points - middle) / size).T
    ones, none = np.ones_like(s), np.zeros_like(s)
    equations = np.concatenate(
        [
            np.stack([s, t, ones, none, none, none, -x * s, -x * t], axis=-1),
            np.stack([none, none, none, s, t, ones, -y * s, -y * t], axis=-1),
        ]
    )
    right = np.concatenate([x, y])
    weights: FloatArray = np.ones(len(s))
    for _ in range(8):
        weighted = equations * np.tile(weights, 2)[:, None]
        values = np.linalg.solve(weighted.T @ equations + 1e-6 * np.eye(8), weighted.T @ right)
        plane = np.append(values, 1.0).reshape(3, 3)
        off = np.hypot(*(np.stack(_projected(plane, s, t)) - (x, y))) * size / pitch
        weights = 1 / (1 + off**2) ** 2
    return np.asarray(np.array([[size, 0, middle[0]], [0, size, middle[1]], [0, 0, 1]]) @ plane)


def _projected(plane: Float[np.ndarray, "3 3"], s: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The points of the picture at s, t of the plane."""
    x, y, depth = (one[0] * s + one[1] * t + one[2] for one in plane)
    depth = np.maximum(depth, 0.05)
    return x / depth, y / depth


def _waves(lattice: Lattice, at: Float[np.ndarray, "rows columns 2"]) -> Float[np.ndarray, "rows columns 2 2"]:
    """The gradients of u and of v at points of the picture, by H [cycles/pixel]; NaN: beyond the horizon."""
    back = np.linalg.inv(lattice.plane)
    a, b, depth = np.moveaxis(at @ back[:, :2].T + back[:, 2], -1, 0)
    own = lattice.plane[2] @ np.stack([a / depth, b / depth, np.ones_like(a)]).reshape(3, -1)
    depth = np.where(own.reshape(depth.shape) > 0.05, depth, np.nan)
    gradients = [(back[i, :2] * depth[..., None] - one[..., None] * back[2, :2]) for i, one in enumerate((a, b))]
    return np.asarray(np.stack(gradients, axis=-2) / depth[..., None, None] ** 2 * lattice.scale)


def window(lattice: Lattice) -> tuple[int, int, int, int]:
    """The first and last lines that are looked at: left, right, upper, lower."""
    low, high = np.floor(lattice.low).astype(int), np.ceil(lattice.high).astype(int)
    reach = SIDE // 10 + BEYOND
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


def _smooth_phase(blocks: ComplexArray, samples: Num[np.ndarray, "..."]) -> FloatArray:
    """The phases [cycles] of blocks of so many samples, those without lines from the blocks nearest to them."""
    clear = np.abs(blocks) > _LEAST_COHERENCE * np.maximum(samples, 1)
    if not clear.any():
        return np.zeros(blocks.shape)
    kept = np.where(clear, blocks, 0)
    smooth = scipy.ndimage.gaussian_filter(kept.real, 0.7) + 1j * scipy.ndimage.gaussian_filter(kept.imag, 0.7)
    rows, columns = scipy.ndimage.distance_transform_edt(~clear, return_distances=False, return_indices=True)
    return np.asarray(-np.angle(smooth[rows, columns]) / (2 * np.pi))


def _blocks(amplitude: Num[np.ndarray, "rows columns"]) -> Num[np.ndarray, "..."]:
    """The sums over blocks of _BLOCK × _BLOCK cells, the last ones as far as they go."""
    rows, columns = amplitude.shape
    padded = np.pad(amplitude, ((0, -rows % _BLOCK), (0, -columns % _BLOCK)))
    return np.asarray(
        padded.reshape(padded.shape[0] // _BLOCK, _BLOCK, padded.shape[1] // _BLOCK, _BLOCK).sum(axis=(1, 3))
    )
