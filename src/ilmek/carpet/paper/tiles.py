"""Tiles of a sheet: the wave of its lines in each, and the number of the line at each tile's centre.

In tiles of some cells the spectrum of the line energy has a peak at the wave vector of the lines; the phase at the
tile's centre says where the nearest line is, as a part of the pitch. The phases are continued from tile to tile, the
clearest first: the number grows by one from line to line.

Source: M. Takeda, H. Ina, S. Kobayashi, Fourier-transform method of fringe-pattern analysis, J. Opt. Soc. Am. 72 (1982)
156-160; quality-guided: D. C. Ghiglia, M. D. Pritt, Two-dimensional phase unwrapping (1998), 4.3.
"""

import heapq

import numpy as np
import scipy

from ilmek.arrays import BoolArray, Float, FloatArray
from ilmek.carpet.paper.lines import Energy, levelled
from ilmek.records import record

SIDE, STEP = 64, 32
"""Side and distance of the tiles [pixels of the reduced energy]."""

_SLOPE = 0.35
"""Largest tangent of the angle between lines and the picture's sides."""

_RANGE, _NEAR = (0.55, 1.75), 0.2
"""Wave numbers that are looked for, of that of the pitch; distance from the expected wave vector, of its length."""

_LEAST_QUALITY = 1.2
"""Least logarithm of the highest power of a tile over the mean."""

_JUMP, _BEND = 0.3, 0.25
"""Largest difference of a tile's phase from the expected one [cycles]; of the waves of neighbours, of their length."""


@record
class Spectra:
    """The lines down, or across, in tiles, under a Hann window.

    lines     their levelled energy
    energies  their mean energies [codes]
    power     squares of the spectra of all energy, at the waves (kx, ky) [cycles/pixel]
    """

    lines: Float[np.ndarray, "rows columns side side"]
    energies: Float[np.ndarray, "rows columns"]
    power: Float[np.ndarray, "rows columns waves"]
    waves: Float[np.ndarray, "waves 2"]

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of tiles."""
        return int(self.energies.shape[0]), int(self.energies.shape[1])


@record
class Tiles:
    """The lines down, or across, in tiles: wave vectors [cycles/pixel], phases at the centres [cycles], qualities,
    and mean energies [codes].
    """

    waves: Float[np.ndarray, "rows columns 2"]
    phases: Float[np.ndarray, "rows columns"]
    qualities: Float[np.ndarray, "rows columns"]
    energies: Float[np.ndarray, "rows columns"]


def spectra(everything: Energy, lines: Energy, pitch: float) -> Spectra:
    """The spectra of the lines down, of everything around them, in tiles."""
    energies = _tiled(lines).mean(axis=(2, 3))
    everything, lines = _windows(levelled(everything, pitch)), _windows(levelled(lines, pitch))
    size = 2 * SIDE
    ky, kx = np.meshgrid(np.fft.fftfreq(size), np.fft.rfftfreq(size), indexing="ij")
    length = np.hypot(kx, ky) * pitch
    allowed = (length > _RANGE[0]) & (length < _RANGE[1]) & (np.abs(ky) <= _SLOPE * kx)
    power = np.stack(
        [_power(one, allowed) + _power(other, allowed) for one, other in zip(everything, lines, strict=True)]
    )
    power = scipy.ndimage.uniform_filter(power, (3, 3, 1), mode="nearest")
    return Spectra(lines, energies, power, np.stack([kx[allowed], ky[allowed]], axis=-1))


def tiles(of: Spectra, expected: Float[np.ndarray, "rows columns 2"] | None = None) -> Tiles:
    """The waves by the spectrum of everything around, near the expected ones (NaN: none); the phases by the lines."""
    power, kx, ky = of.power, of.waves[:, 0], of.waves[:, 1]
    mean = power.mean(axis=-1).clip(1e-12)
    if expected is not None:
        off = np.hypot(expected[..., :1] - kx, expected[..., 1:] - ky)
        power = np.where(off < _NEAR * np.hypot(*np.moveaxis(expected, -1, 0))[..., None], power, 0.0)
    peak = power.argmax(axis=-1)
    near = np.hypot(kx[:, None] - kx, ky[:, None] - ky) < 1.25 / SIDE
    weights = np.where(near[peak], power - 0.4 * power.max(axis=-1, keepdims=True), 0.0).clip(0)
    waves = np.stack([weights @ kx, weights @ ky], axis=-1) / weights.sum(axis=-1)[..., None].clip(1e-12)
    middle = np.arange(SIDE) + 0.5 - SIDE / 2
    along = np.exp(-2j * np.pi * waves[..., 0, None] * middle)[..., None]
    down = np.exp(-2j * np.pi * waves[..., 1, None] * middle)
    sums = of.lines @ along.real.astype(np.float32) + 1j * (of.lines @ along.imag.astype(np.float32))
    turned = (down * sums[..., 0]).sum(axis=-1)
    share = power.max(axis=-1) / mean
    return Tiles(waves, np.angle(turned) / (2 * np.pi), np.log(share.clip(1e-9)), of.energies)


def _tiled(energy: Energy) -> Float[np.ndarray, "rows columns side side"]:
    """The tiles of an energy."""
    energy = np.pad(energy, [(0, max(0, SIDE - side)) for side in energy.shape], mode="edge")
    return np.lib.stride_tricks.sliding_window_view(energy, (SIDE, SIDE))[::STEP, ::STEP]


def _windows(energy: Energy) -> Float[np.ndarray, "rows columns side side"]:
    """The tiles of an energy, each without its mean, under a Hann window."""
    views = _tiled(energy)
    hann = np.hanning(SIDE + 2)[1:-1].astype(np.float32)
    window = hann[:, None] * hann
    mean = (views * window).sum(axis=(2, 3), keepdims=True) / window.sum()
    return np.asarray((views - mean) * window)


def _power(tiles: Float[np.ndarray, "columns side side"], allowed: BoolArray) -> FloatArray:
    """The square of the spectra of tiles at the allowed waves."""
    return np.asarray(np.abs(scipy.fft.rfft2(tiles, (2 * SIDE, 2 * SIDE))[:, allowed]) ** 2)


def continued(tiles: Tiles) -> Float[np.ndarray, "rows columns"]:
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
            expected = number[row, column] + STEP * (right * wave[0] + down * wave[1])
            continued = tiles.phases[r, c] + round(expected - tiles.phases[r, c])
            bend = np.hypot(*(tiles.waves[row, column] - tiles.waves[r, c])) / np.hypot(*wave)
            cost = abs(continued - expected) + bend
            if abs(continued - expected) < _JUMP and bend < _BEND:
                heapq.heappush(waiting, (cost - quality[r, c], r, c, continued))

    spread(int(start[0]), int(start[1]))
    while waiting:
        _, row, column, continued = heapq.heappop(waiting)
        if np.isnan(number[row, column]):
            number[row, column] = continued
            spread(row, column)
    return number
