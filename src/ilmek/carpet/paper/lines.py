"""Line energy of squared paper, and the pitch of its lines.

    e_x(x, y) = Σ over the channels |I(x + 1, y) - I(x - 1, y)|

Both flanks of a thin line, light or dark, and the edge between two cells give one ridge of e_x on the line of the grid.
Letters and dots in the cells are shorter along the line than a cell: the least value over 0.7 of the pitch along the
line leaves them out. The pitch is the lag p at which the autocorrelation of short profiles is high at p, 2p, 3p and low
halfway between.
"""

import numpy as np
import scipy

from ilmek.arrays import Float, Float32, FloatArray, IntArray, Rgb
from ilmek.errors import PictureError
from ilmek.progress import SILENT, Progress
from ilmek.records import record

Energy = Float32[np.ndarray, "height width"]

LEAST_PITCH, MOST_PITCH = 4.0, 90.0
"""Pitches that are looked for [pixels]."""

_STRIPS, _BROAD, _LONG = 20, 8, 384
"""Number and width of the strips in which the pitch is looked for, and length of a piece of them [pixels]."""

_LEAST_SCORE = 0.12
"""Least difference of autocorrelation, at the pitch and halfway, of a piece that counts."""

_OBLONG = 0.2
"""Logarithm of the largest ratio of pitches that vote for one; twice that of the sides of a cell."""

_FLOOR = 3.0
"""Energy of noise and of the blocks of a JPEG [codes]."""

_NEARLY = 0.85
"""Score of a pitch, of the highest one, that counts before that of a multiple."""

_LAGS, _THIN = 500, 10.0
"""Number of the lags, in equal ratios; code that is added before the logarithm: thin lines count beside heavy ones."""

HEAVY = (3.5, 12.5)
"""Least and greatest ratio of the pitches of heavy lines and of all lines."""

_LEAST_VOTES = 0.1
"""Least score of a pitch, of the likeliest one."""

_COARSE = 7.0
"""Pitch in the reduced energy, at least [pixels]."""


@record
class Spread:
    """How far equal lines extend over a picture: the least share of its pieces that have them, and the logarithm of the
    ratio of pitches that are one.
    """

    share: float
    ratio: float


SOMEWHERE, NEARLY_EVERYWHERE = Spread(0.04, 0.4), Spread(0.4, 0.06)
"""The lines of a photographed sheet; those of the export of a program, or of a scan."""


@record
class LineEnergy:
    """The energies of a picture reduced by `factor`, and the pitches of its lines there.

    all_down, all_across  of the lines down and across, and of what stands in the cells
    down, across          of the lines alone
    """

    all_down: Energy
    all_across: Energy
    down: Energy
    across: Energy
    factor: int
    pitch_x: float
    pitch_y: float


def line_energy(rgb: Rgb, pitch: tuple[float, float], progress: Progress = SILENT) -> LineEnergy:
    """The line energy of a picture whose lines down and across have these pitches [pixels]."""
    pitch_x, pitch_y = pitch
    factor = max(1, int(min(pitch) / _COARSE))
    all_down = _reduced(_gradient(rgb), factor)
    progress(0.5)
    all_across = _reduced(_gradient(np.swapaxes(rgb, 0, 1)), factor)
    down, across = _filtered(all_down, pitch_y / factor), _filtered(all_across, pitch_x / factor)
    return LineEnergy(all_down, all_across.T, down, across.T, factor, pitch_x / factor, pitch_y / factor)


def no_grid(reason: str) -> PictureError:
    """The error of a picture in which no grid is found."""
    return PictureError(
        f"no squared paper is found in the picture ({reason})",
        allowed="a sheet with a grid of lines, the pitch 4 to 90 pixels, turned by at most 12 degrees",
        do="take a sharper or larger picture, crop it to the grid, or leave out --paper and give --size",
    )


def _gradient(rgb: Rgb) -> Energy:
    """e_x of a picture [codes]."""
    made = np.zeros(rgb.shape[:2], dtype=np.int16)
    for channel in range(3):
        codes = rgb[..., channel].astype(np.int16)
        made[:, 1:-1] += np.abs(codes[:, 2:] - codes[:, :-2])
    return made.astype(np.float32)


def _reduced(energy: Energy, factor: int) -> Float32[np.ndarray, "coarse_height coarse_width"]:
    """The means of blocks of factor × factor."""
    if factor == 1:
        return energy
    rows, columns = (side // factor * factor for side in energy.shape)
    blocks = energy[:rows, :columns].reshape(rows // factor, factor, columns // factor, factor)
    return np.asarray(blocks.mean(axis=(1, 3), dtype=np.float32))


def _filtered(energy: Energy, along: float) -> Energy:
    """The energy without what is short down the picture; along: pitch in this direction."""
    broad = scipy.ndimage.maximum_filter1d(energy, 3, axis=1)
    smooth = scipy.ndimage.uniform_filter1d(broad, max(1, round(0.15 * along)), axis=0)
    long = scipy.ndimage.minimum_filter1d(smooth, max(1, round(0.7 * along)), axis=0)
    return np.asarray(scipy.ndimage.uniform_filter1d(long, 3, axis=1))


def levelled(energy: FloatArray, pitch: float) -> Energy:
    """Twice the logarithm of the energy over its geometric mean nearby, at most 2.

    No shadow hides lines; no heavy line, no edge of the sheet outweighs the others.
    """
    light = np.log(energy + _THIN)
    mean = scipy.ndimage.uniform_filter(light, max(3, round(1.6 * pitch)))
    return np.asarray(np.minimum(2.0 * (light - mean), 2.0), dtype=np.float32)


def pitches(rgb: Rgb, spread: Spread = SOMEWHERE) -> tuple[tuple[float, float], ...]:
    """Pitches that the lines down and across a picture may have [pixels], of nearly square cells, most likely first.

    Where each fourth to twelfth line is heavy, most pieces repeat at their pitch: the finer pitch is put first.
    """
    down, across = _lags(rgb), _lags(np.swapaxes(rgb, 0, 1))
    lags, scores = np.concatenate([down, across]).T
    votes = (np.abs(np.log(lags[:, None] / lags)) < _OBLONG) @ scores
    modes: list[tuple[float, float]] = []
    rest = np.where(scores > 0, votes, 0.0)
    while rest.any() and rest.max() >= _LEAST_VOTES * votes.max():
        mode = int(rest.argmax())
        modes.append((float(lags[mode]), float(rest[mode])))
        rest[np.abs(np.log(lags / lags[mode])) < 2 * _OBLONG] = 0.0
    if modes:
        first, most = modes[0]
        modes.sort(key=lambda one: not (HEAVY[0] < first / one[0] < HEAVY[1] and one[1] >= 2 * _LEAST_VOTES * most))
    pairs = [(_pitch(down, mode, spread), _pitch(across, mode, spread)) for mode, _ in modes]
    return tuple((one, other) for one, other in pairs if one and other)


def _pitch(pieces: Float[np.ndarray, "pieces 2"], mode: float, spread: Spread) -> float | None:
    """The median of the pitches near the mode; None: too few."""
    pitches_near = pieces[(np.abs(np.log(pieces[:, 0] / mode)) < 2 * _OBLONG) & (pieces[:, 1] > 0), 0]
    if not len(pitches_near):
        return None
    pitch = float(np.median(pitches_near))
    equal = np.count_nonzero(np.abs(np.log(pitches_near / pitch)) < spread.ratio)
    return pitch if equal >= max(3, spread.share * len(pieces)) else None


def _lags(rgb: Rgb) -> Float[np.ndarray, "pieces 2"]:
    """The pitches of pieces of lines across the picture, and their scores, 0 for one that does not count."""
    height, width = rgb.shape[:2]
    long = min(_LONG, width)
    if long < 6 * LEAST_PITCH:
        return np.zeros((0, 2))
    starts = np.linspace(0.06 * height, max(0.06 * height, 0.94 * height - _BROAD), _STRIPS).astype(int)
    begins = np.linspace(0, width - long, -(-2 * (width - long) // _LONG) + 1).astype(int)
    strips = np.stack([_gradient(rgb[start : start + _BROAD]).mean(axis=0) for start in starts])
    pieces = np.lib.stride_tricks.sliding_window_view(strips, long, axis=1)[:, begins].reshape(-1, long)
    lags, scores = _best_lags(np.log(pieces + _THIN))
    return np.stack([lags, np.where((scores > _LEAST_SCORE) & (pieces.mean(axis=1) >= _FLOOR), scores, 0.0)], axis=-1)


def _best_lags(pieces: Float[np.ndarray, "pieces long"]) -> tuple[FloatArray, FloatArray]:
    """The pitch in each profile, and its score."""
    long = pieces.shape[1]
    pieces = pieces - scipy.ndimage.uniform_filter1d(pieces, min(long, 2 * round(MOST_PITCH) // 3), axis=1)
    spectra = np.abs(scipy.fft.rfft(pieces, 2 * long, axis=1)) ** 2
    correlations = scipy.fft.irfft(spectra, axis=1)[:, :long] / np.arange(long, 0, -1)
    correlations = correlations / np.maximum(correlations[:, :1], 1e-9)
    lags = np.geomspace(LEAST_PITCH, min(MOST_PITCH, long / 4), _LAGS)
    scores = correlations @ _combs(lags, long).T
    best = _first_peaks(scores)
    return lags[best], np.take_along_axis(scores, best[:, None], axis=1)[:, 0]


def _combs(lags: Float[np.ndarray, " lags"], long: int) -> Float[np.ndarray, "lags long"]:
    """Of each lag the weights, in a correlation, of its first three multiples less the points halfway."""
    combs = np.zeros((len(lags), long + 1))
    for times in range(1, 4):
        for place, weight in ((times, 1 / 3), (times - 0.5, -1 / 6), (times + 0.5, -1 / 6)):
            at = np.minimum(place * lags, long - 1)
            whole = at.astype(int)
            np.add.at(combs, (np.arange(len(lags)), whole), weight * (1 - at + whole))
            np.add.at(combs, (np.arange(len(lags)), whole + 1), weight * (at - whole))
    return combs[:, :long]


def _first_peaks(scores: Float[np.ndarray, "pieces lags"]) -> IntArray:
    """The first local maximum that is nearly the highest: heavy lines repeat at a multiple of the pitch."""
    inner = scores[:, 1:-1]
    high = inner >= _NEARLY * scores.max(axis=1, keepdims=True)
    peaks = (inner >= scores[:, :-2]) & (inner >= scores[:, 2:]) & high
    return np.asarray(np.where(peaks.any(axis=1), peaks.argmax(axis=1) + 1, scores.argmax(axis=1)))
