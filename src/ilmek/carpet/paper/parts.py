"""Parts: whether the lines that were found are the heavy ones, and into how many parts finer lines divide a cell.

Along a cell the logarithm of |dI/du|, averaged over the sheet, has a peak at each line. Lines that divide the cell into
k parts give the k-th harmonic, over its neighbours: those of the heavy line alone fall evenly.
"""

import numpy as np

from ilmek.arrays import BoolArray, Float, IntArray, Rgb
from ilmek.carpet.paper.lattice import Lattice
from ilmek.carpet.paper.lines import HEAVY, LEAST_PITCH

_SAMPLES, _ACROSS, _MOST = 64, (0.3, 0.5, 0.7), 200_000
"""Samples along a cell, places across it, and number of samples, at most."""

_FLOOR = 10.0
"""Code that is added before the logarithm: noise counts little."""

_LEAST, _OVER = 0.035, (1.15, 1.7)
"""Least amplitude of the harmonic of the parts, and its least ratios to the harmonics before and after it."""


def parts(rgb: Rgb, lattice: Lattice, pitch: float) -> int:
    """The number of parts of a cell, along both its sides; 1: no finer lines."""
    numbers = np.arange(int(np.ceil(HEAVY[0])), int(min(HEAVY[1], pitch / LEAST_PITCH)) + 1)
    if not len(numbers):
        return 1
    both = np.logical_and(*(_outstanding(_profile(rgb, lattice, turned), numbers) for turned in (False, True)))
    return int(numbers[both.argmax()]) if both.any() else 1


def _outstanding(profile: Float[np.ndarray, " samples"], numbers: IntArray) -> BoolArray:
    """Whether the harmonic of each number stands out."""
    amplitudes = np.abs(np.fft.rfft(profile)) / len(profile)
    own, before, after = amplitudes[numbers], amplitudes[numbers - 1], amplitudes[numbers + 1]
    return np.asarray((own > _LEAST) & (own > _OVER[0] * before) & (own > _OVER[1] * after))


def _profile(rgb: Rgb, lattice: Lattice, turned: bool) -> Float[np.ndarray, " samples"]:
    """The mean of the logarithm of the change along u, or turned along v, over a cell."""
    low, high = np.ceil(lattice.low).astype(int), np.floor(lattice.high).astype(int)
    if turned:
        low, high = low[::-1], high[::-1]
    count = max(1, int(high[0] - low[0]))
    step = -(-count * _SAMPLES * max(1, int(high[1] - low[1])) * len(_ACROSS) // _MOST)
    along = low[0] + (np.arange(count * _SAMPLES) + 0.5) / _SAMPLES
    across = (np.arange(low[1], max(high[1], low[1] + 1), step)[:, None] + _ACROSS).ravel()
    x, y = (one.T for one in lattice.mesh(across, along)) if turned else lattice.mesh(along, across)
    codes = rgb[
        np.clip(np.floor(y), 0, rgb.shape[0] - 1).astype(np.intp),
        np.clip(np.floor(x), 0, rgb.shape[1] - 1).astype(np.intp),
    ].astype(np.int16)
    change = np.zeros(x.shape)
    change[:, 1:-1] = np.abs(codes[:, 2:] - codes[:, :-2]).sum(axis=-1)
    return np.asarray(np.log(change + _FLOOR).reshape(-1, _SAMPLES).mean(axis=0))
