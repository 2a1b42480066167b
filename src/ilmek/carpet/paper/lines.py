"""Line energy of squared paper, and the pitch of its lines.

    e_x(x, y) = Σ over the channels |I(x + 1, y) - I(x - 1, y)|

Both flanks of a thin line, light or dark, and the edge between two cells give one ridge of e_x on the line of the grid.
Letters and dots in the cells are shorter along the line than a cell: the least value over 0.7 of the pitch along the
line leaves them out. The pitch is the lag p at which the autocorrelation of short profiles is high at p, 2p, 3p and low
halfway between.
"""

import numpy as np
import scipy

from ilmek.arrays import Float, Float32, FloatArray, Rgb
from ilmek.errors import PictureError
from ilmek.progress import SILENT, Progress
from ilmek.records import record

Energy = Float32[np.ndarray, "height width"]

LEAST_PITCH, MOST_PITCH = 4.0, 90.0
"""Pitches that are looked for [pixels]."""

_STRIPS, _BROAD, _LONG = 40, 8, 384
"""Number and width of the strips in which the pitch is looked for, and length of a piece of them [pixels]."""

_LEAST_SCORE = 0.12
"""Least difference of autocorrelation, at the pitch and halfway, of a piece that counts."""

_OBLONG = 0.2
"""Logarithm of the largest ratio of pitches that are one; twice that of the sides of a cell."""

SOMEWHERE, NEARLY_EVERYWHERE = 0.04, 0.4
"""Least share of the pieces of a picture in which lines repeat: of a photographed sheet; of the export of a program."""

_FLOOR = 3.0
"""Energy of noise and of the blocks of a JPEG [codes]."""

_NEARLY = 0.85
"""Score of a pitch, of the highest one, that counts before that of a multiple."""

_COARSE = 7.0
"""Pitch in the reduced energy, at least [pixels]."""


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


def line_energy(rgb: Rgb, progress: Progress = SILENT, least: float = SOMEWHERE) -> LineEnergy:
    """The line energy of a picture; `least`: share of it in which lines repeat.

    Raises PictureError where no line repeats.
    """
    found = pitches(rgb, least)
    progress(0.2)
    if found is None:
        raise no_grid("no lines at equal distances")
    pitch_x, pitch_y = found
    factor = max(1, int(min(pitch_x, pitch_y) / _COARSE))
    all_down = _reduced(_gradient(rgb), factor)
    progress(0.6)
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


def _reduced(energy: Energy, factor: int) -> Energy:
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
    """The energy over its mean nearby, less 1, at most 2: no shadow hides lines, no sheet's edge outweighs them."""
    mean = scipy.ndimage.uniform_filter(energy, max(3, round(1.6 * pitch)))
    return np.asarray(np.minimum(energy / (mean + 1.0) - 1.0, 2.0), dtype=np.float32)


def pitches(rgb: Rgb, least: float = SOMEWHERE) -> tuple[float, float] | None:
    """The pitches of the lines down and across a picture [pixels], of nearly square cells; None: no lines repeat."""
    down, across = _lags(rgb), _lags(np.swapaxes(rgb, 0, 1))
    if min(np.count_nonzero(one[:, 1] > 0) for one in (down, across)) < 3:
        return None
    lags, scores = np.concatenate([down, across]).T
    near = np.abs(np.log(lags[:, None] / lags[None])) < _OBLONG
    mode = lags[int((near * scores).sum(axis=1).argmax())]
    found = []
    for one in (down, across):
        on = (np.abs(np.log(one[:, 0] / mode)) < 2 * _OBLONG) & (one[:, 1] > 0)
        if np.count_nonzero(on) < max(3, least * len(one)):
            return None
        found.append(float(np.median(one[on, 0])))
    return found[0], found[1]


def _lags(rgb: Rgb) -> Float[np.ndarray, "pieces 2"]:
    """The pitches of pieces of lines across the picture, and their scores, 0 for one that does not count."""
    height, width = rgb.shape[:2]
    starts = np.linspace(0.06 * height, max(0.06 * height, 0.94 * height - _BROAD), _STRIPS).astype(int)
    found: list[tuple[float, float]] = []
    for start in starts:
        strip = _gradient(rgb[start : start + _BROAD]).mean(axis=0)
        for begin in range(0, max(1, width - _LONG // 2), _LONG // 2):
            piece = strip[begin : begin + _LONG]
            if len(piece) < 6 * LEAST_PITCH:
                continue
            if piece.mean() < _FLOOR:
                found.append((LEAST_PITCH, 0.0))
            else:
                lag, score = _best_lag(piece)
                found.append((lag, score if score > _LEAST_SCORE else 0.0))
    return np.array(found).reshape(-1, 2)


def _best_lag(piece: FloatArray) -> tuple[float, float]:
    """The pitch in a profile, and its score."""
    piece = np.minimum(piece, np.quantile(piece, 0.97))
    piece = piece - scipy.ndimage.uniform_filter1d(piece, min(len(piece), 2 * round(MOST_PITCH) // 3))
    spectrum = np.abs(np.fft.rfft(piece, 2 * len(piece))) ** 2
    correlation = np.fft.irfft(spectrum)[: len(piece)] / np.arange(len(piece), 0, -1)
    if correlation[0] <= 0:
        return LEAST_PITCH, 0.0
    correlation = correlation / correlation[0]
    most = min(MOST_PITCH, len(piece) / 4)
    lags = np.arange(LEAST_PITCH, most, 0.1)
    where = np.arange(len(correlation))
    total = np.zeros_like(lags)
    for times in (1, 2, 3):
        high = np.interp(times * lags, where, correlation)
        low = [np.interp((times + half) * lags, where, correlation) for half in (-0.5, 0.5)]
        total += (high - 0.5 * (low[0] + low[1])) / 3
    best = _first_peak(total)
    return float(lags[best]), float(total[best])


def _first_peak(scores: FloatArray) -> int:
    """The first local maximum that is nearly the highest: heavy lines repeat at a multiple of the pitch."""
    inner = scores[1:-1]
    peaks = np.flatnonzero((inner >= scores[:-2]) & (inner >= scores[2:]) & (inner >= _NEARLY * scores.max())) + 1
    return int(peaks[0]) if len(peaks) else int(scores.argmax())
