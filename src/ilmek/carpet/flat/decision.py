"""The decision: whether a picture is a drawing.

The pixels of a drawing have few true colours, or mixtures of two of them on clear edges. What is left is grain and the
residue of JPEG. In a photo of low contrast all pixels are near to a few colours too, yet its areas have slopes. These
measures tell them apart; none depends on the contrast of the picture alone:

near       of the even areas whose colour is a true colour, up to the noise
explained  of the pixels unlike their neighbours that have a true colour, or a mixture of two on a clear edge
variance   of the colours that true colours and mixtures explain; luma counts twice, as a JPEG halves the chroma
slope      difference of quiet areas from the true colours: grain does not move the mean of 3 × 3 pixels, tones do
"""

import numpy as np

from ilmek.arrays import Float, FloatArray, IntArray, Rgb, UInt8
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.flat.nearest import UNKNOWN, count_near
from ilmek.carpet.flat.survey import Survey, survey
from ilmek.carpet.flat.true_colours import TrueColours, is_mixture, true_colours
from ilmek.num.stable_order import stable_order
from ilmek.records import record
from ilmek.units import counted

_LEAST_PIXELS = 4
"""Least number of pixels for each true colour."""

_LEAST_NEAR, _NEAR, _NEAR_NOISE = 0.85, 5.0, 0.25
"""Least share of the even areas that have a true colour; difference in CIELAB up to which they have one, and what each
code of noise adds to it."""

_LEAST_EXPLAINED, _EXPLAINED = 0.72, 11.0
"""Least share of the pixels unlike their neighbours that is explained; difference in CIELAB to a true colour."""

_LEAST_VARIANCE, _PLAIN_VARIANCE = 0.96, 0.985
"""Least explained share of the variance; share from which slopes do not count (abrash)."""

_FINE_VARIANCE, _FINE_EDGES, _FAR = 0.91, 0.985, 25.0
"""Least explained share of the variance of fine lines and dots on one ground, all of whose other colours lie on clear
edges: the least share that does; distance from the ground, in codes of luma and half of chroma, of another colour."""

_LEAST_SLOPE, _SLOPE, _SLOPE_NOISE = 0.65, 0.3, 0.25
"""Difference in CIELAB that is no slope; and with grain, what each code of noise adds to the second."""

_ALIKE, _CLEAR = 2, 40
"""Range of a channel over 3 × 3 pixels of neighbours that are alike; least contrast of a clear edge."""

_OFF = 28.0
"""Distance in sRGB codes from the segment between two colours up to which a colour is their mixture."""

_MOST_TRIALS, _MOST_PIXELS = 1_000_000, 10_000
"""The largest numbers of pairs of colours and pixels, and of pixels, that are tried."""

_CODES = 1 << 24

_LUMA_CHROMA = np.array([[0.299, 0.587, 0.114], [-0.0845, -0.1655, 0.25], [0.25, -0.2095, -0.0405]])
"""Luma and half of the chroma of sRGB codes (ITU-R BT.601)."""


@record
class Flatness:
    """Whether a picture is a drawing.

    is_flat   the decision          colours  number of true colours
    near      share of the even areas that have a true colour, up to the noise
    sentence  the reason, for the user
    true      the true colours
    """

    is_flat: bool
    colours: int
    near: float
    sentence: str
    true: TrueColours


def looks_flat(rgb: Rgb) -> Flatness:
    """Whether a picture is a drawing: few true colours, which nearly all of its pixels have."""
    seen = survey(np.ascontiguousarray(rgb))
    true = true_colours(seen)
    if not len(true.srgb):
        return Flatness(False, 0, 0.0, "no drawing: it has no true colour", true)
    if len(true.srgb) * _LEAST_PIXELS > len(seen.codes):
        sentence = f"no drawing: {len(true.srgb)} colours on {counted(len(seen.codes), 'pixel')}"
        return Flatness(False, len(true.srgb), 0.0, sentence, true)
    near, explained, variance = _near(seen, true), _explained(seen, true), _variance(seen, true)
    slope, most = _slope(seen, true), max(_LEAST_SLOPE, _SLOPE + _SLOPE_NOISE * true.noise)
    one = len(true.srgb) == 1
    colours = "1 true colour explains" if one else f"{len(true.srgb)} true colours explain"
    areas = f"{100 * near:.0f} % of its even areas have {'one colour' if one else f'one of {len(true.srgb)} colours'}"
    is_flat = False
    if explained < _LEAST_EXPLAINED:
        sentence = f"no drawing: {colours} {100 * explained:.0f} % of the pixels outside of areas"
    elif near < _LEAST_NEAR:
        sentence = f"no drawing: only {areas}"
    elif variance < _FINE_VARIANCE or (variance < _LEAST_VARIANCE and not _is_fine(seen, true)):
        sentence = f"no drawing: {colours} {100 * max(variance, 0.0):.0f} % of the differences of colour"
    elif slope > most and variance < _PLAIN_VARIANCE:
        sentence = f"no drawing: its even areas have slopes, {slope:.1f} in CIELAB beside {most:.1f} of grain"
    else:
        is_flat, sentence = True, f"a drawing: {areas}"
    return Flatness(is_flat, len(true.srgb), near, sentence, true)


def _near(seen: Survey, true: TrueColours) -> float:
    """Share of the even areas that have a true colour, up to the noise."""
    even = seen.means[seen.spread <= true.even]
    table = np.full(_CODES, UNKNOWN, dtype=np.uint8)
    most = _NEAR + _NEAR_NOISE * true.noise
    return int(count_near(even, table, true.labs, most)) / max(len(even), 1)


def _sampled(codes: UInt8[np.ndarray, "pixels 3"], colours: int) -> IntArray:
    """Indices of pixels spread over all codes, so that a mirrored picture has the same; fewer for many true colours."""
    red, green, blue = codes.astype(np.int64).T
    code = (red << 16) | (green << 8) | blue
    most = max(1, min(_MOST_PIXELS, _MOST_TRIALS // colours**2))
    order = stable_order(code)
    return np.asarray(order[:: -(-len(order) // most) or 1])


def _explained(seen: Survey, true: TrueColours) -> float:
    """Share, of the sampled pixels unlike their neighbours, that a drawing explains.

    They have a true colour, up to the noise, or a mixture of two on a clear edge. Even areas do not count: a photo may
    have an even frame.
    """
    unlike = np.flatnonzero(seen.spread > _ALIKE)
    pixels = unlike[_sampled(seen.codes[unlike], len(true.srgb))]
    if len(pixels) == 0:
        return 1.0
    colours = seen.codes[pixels]
    labs = srgb_to_lab(colours)
    apart = np.min([np.linalg.norm(labs - lab, axis=-1) for lab in true.labs], axis=0)
    edge = np.maximum(seen.ramp, seen.ridge)[pixels] >= _CLEAR
    known = apart <= _EXPLAINED
    rest = np.flatnonzero(edge & ~known)
    known[rest] = is_mixture(colours[rest].astype(float), true.srgb, _OFF)
    return float(np.mean(known))


def _variance(seen: Survey, true: TrueColours) -> float:
    """Share of the variance of the pixels' colours that true colours explain, and their mixtures on clear edges."""
    pixels = _sampled(seen.codes, len(true.srgb))
    colours, palette = seen.codes[pixels] @ _LUMA_CHROMA.T, true.srgb @ _LUMA_CHROMA.T
    off = np.min([np.sum((colours - one) ** 2, axis=-1) for one in palette], axis=0)
    edge = np.flatnonzero(np.maximum(seen.ramp, seen.ridge)[pixels] >= _CLEAR)
    off[edge] = np.minimum(off[edge], _off_mixtures(colours[edge], palette))
    total = float(np.mean(np.sum((colours - colours.mean(axis=0)) ** 2, axis=-1)))
    grain = (true.noise / 3) ** 2
    return 1.0 if total <= grain else 1.0 - float(np.mean(off)) / total


def _is_fine(seen: Survey, true: TrueColours) -> bool:
    """Whether all pixels unlike the ground, the median colour, lie on clear edges."""
    pixels = _sampled(seen.codes, len(true.srgb))
    colours = seen.codes[pixels] @ _LUMA_CHROMA.T
    far = np.linalg.norm(colours - np.median(colours, axis=0), axis=-1) > max(_FAR, 2.0 * true.noise)
    edge = np.maximum(seen.ramp, seen.ridge)[pixels] >= _CLEAR
    return bool(np.any(far)) and float(np.mean(edge[far])) >= _FINE_EDGES


def _off_mixtures(colours: Float[np.ndarray, "some 3"], palette: Float[np.ndarray, "colours 3"]) -> FloatArray:
    """Square of the distance of each colour from the nearest segment between two colours of a palette."""
    off = np.full(len(colours), np.inf)
    for number, begin in enumerate(palette[:-1]):
        along = palette[number + 1 :] - begin
        length = np.maximum(np.sum(along**2, axis=-1), 1e-9)
        share = np.clip(((colours - begin) @ along.T) / length, 0.0, 1.0)
        apart = colours[:, None] - begin - share[..., None] * along
        off = np.minimum(off, np.min(np.sum(apart**2, axis=-1), axis=-1))
    return off


def _slope(seen: Survey, true: TrueColours) -> float:
    """Median difference in CIELAB of the means of the quietest quarter of the pixels from their true colours."""
    quiet = seen.means[seen.spread <= true.noise]
    labs = srgb_to_lab(quiet[_sampled(quiet, len(true.srgb))])
    return float(np.median(np.min([np.linalg.norm(labs - lab, axis=-1) for lab in true.labs], axis=0)))
