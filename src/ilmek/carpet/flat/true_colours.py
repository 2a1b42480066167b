"""True colours: the colours that a drawing was made with.

1. If nearly all areas have exactly one of few codes, the picture is *clean*: these codes are true colours. Else the
   modes of the areas' colours are (`modes`), which grain, abrash and the blocks of a JPEG leave in position.
2. Lines and dots have no areas. Colours of ridges that are far from all colours of areas, and are no mixture of two of
   them, are true colours also; where all edges are hard, so are those that are no mixture of what is beside them.
3. A colour that hardly has areas or ridges, beside the other colours, and is a blend of two of them or near to one of
   them, is the mixture on an edge or the halo that a JPEG leaves there, and no true colour.

They are ordered from dark to light: order, and with it each tie, depends on the colours alone.
"""

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, IntArray, UInt8
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.flat.modes import modes
from ilmek.carpet.flat.nearest import label_rows
from ilmek.carpet.flat.survey import Survey
from ilmek.num.compiled import uncounted
from ilmek.records import record

MOST_COLOURS = 200
"""Largest number of true colours."""

_CLEAN = 0.98
"""Share of the even areas that the colours of a clean picture cover."""

_QUIET = 12
"""Range of a channel over 3 × 3 pixels up to which they are no edge. A clean picture has few that differ by less."""

_JPEG = 14
"""Range of a channel over 3 × 3 pixels that a JPEG leaves in even areas near edges."""

_EXPLAINED, _MOST_CODES = 0.8, 2000
"""Least share of the pixels outside of even areas that mixtures explain in a clean picture; codes that are tried."""

_HARD = 32
"""Largest number of codes on the ridges of a picture with hard edges. Smoothed edges have a code for each share."""

_LEAST_AREA = 2e-5
"""Least share of the sample of a colour with areas."""

_TWINS = 3.0
"""Difference in CIELAB under which two modes are one colour, where the picture is not clean."""

_NEW = 14.0
"""Least difference in CIELAB of a colour of lines to those of areas."""

_WEAK, _LEAST_LINES = 0.25, 0.4
"""A colour is weak if less of its pixels, beside all pixels, lie in areas, and if less of them lie on ridges."""

_HALO = 22.0
"""Difference in CIELAB up to which a weak colour is the halo that a JPEG leaves around a stronger one. Up to the same
difference, two colours without areas are those of one line."""

_SLACK = 12.0
"""Codes by which a blend's luma and chroma may lie outside of those of its two colours."""

_OFF = 14.0
"""Distance from the segment between two colours, in sRGB codes, up to which a colour is their mixture."""


@record
class TrueColours:
    """The true colours of a picture.

    srgb   codes of each, from dark to light        labs   their CIELAB
    clean  whether the areas have these codes exactly
    mixed  whether there are edges with mixtures of colours
    noise  range of a channel over 3 × 3 pixels in areas      even   largest such range of an even area
    """

    srgb: UInt8[np.ndarray, "colours 3"]
    labs: FloatArray
    clean: bool
    mixed: bool
    noise: int
    even: int


def true_colours(survey: Survey) -> TrueColours:
    """The true colours of a picture, from its survey."""
    noise = int(np.percentile(survey.spread, 25, method="lower"))
    most = max(6, round(1.6 * noise) + 2)
    even = survey.spread <= most
    clean, srgb = _clean_colours(survey)
    if clean:
        srgb = _with_lines(survey, srgb, even, clean, noise)
        clean = _is_explained(survey, srgb)
    if not clean:
        most = max(_JPEG, most)
        even = survey.spread <= most
        srgb = _with_lines(survey, _area_colours(survey.means[even]), even, clean, noise)
        srgb = _without_blends(survey, srgb, even)
    lab = srgb_to_lab(srgb)
    srgb = srgb[np.lexsort((lab[:, 2], lab[:, 1], lab[:, 0]))]
    mixed = not clean or _mixtures(survey, srgb) > 0.002
    return TrueColours(srgb, srgb_to_lab(srgb), clean, mixed, noise, most)


def _codes(rgb: UInt8[np.ndarray, "pixels 3"]) -> IntArray:
    red, green, blue = rgb.astype(np.int32).T
    return np.asarray((red << 16) | (green << 8) | blue)


def _colours(codes: IntArray) -> UInt8[np.ndarray, "colours 3"]:
    return np.stack([codes >> 16, (codes >> 8) & 255, codes & 255], axis=-1).astype(np.uint8)


def _by_count(codes: IntArray) -> tuple[IntArray, IntArray]:
    """Distinct codes and how often each occurs, most frequent first."""
    distinct, counts = np.unique(codes, return_counts=True)
    order = np.lexsort((distinct, -counts))
    return distinct[order], counts[order]


def _clean_colours(survey: Survey) -> tuple[bool, UInt8[np.ndarray, "colours 3"]]:
    """Whether the picture is clean, and the colours of its areas."""
    flat = _codes(survey.codes[survey.spread == 0])
    if len(flat) < 0.02 * len(survey.spread):
        flat = _codes(survey.codes)
    distinct, counts = _by_count(flat)
    least = max(2, _LEAST_AREA * len(survey.spread)) if len(flat) > 1000 else 1
    kept = distinct[counts >= least]
    few = len(kept) <= MOST_COLOURS and counts[: len(kept)].sum() >= _CLEAN * counts.sum()
    quiet = np.count_nonzero((survey.spread > 0) & (survey.spread <= _QUIET))
    return bool(few and quiet <= 0.15 * np.count_nonzero(survey.spread == 0)), _colours(kept)


def _is_explained(survey: Survey, srgb: UInt8[np.ndarray, "colours 3"]) -> bool:
    """Whether the pixels outside of even areas have true colours or mixtures of them."""
    distinct, counts = _by_count(_codes(survey.codes[survey.spread > _QUIET]))
    distinct, counts = distinct[:_MOST_CODES], counts[:_MOST_CODES]
    known = np.isin(distinct, _codes(srgb)) | is_mixture(_colours(distinct).astype(float), srgb, 2 * _OFF)
    return bool(counts[known].sum() >= _EXPLAINED * counts.sum())


def _area_colours(means: UInt8[np.ndarray, "pixels 3"]) -> UInt8[np.ndarray, "colours 3"]:
    """The modes of the colours of areas, twins joined."""
    found, sizes = modes(means, max(3, int(_LEAST_AREA * len(means))))
    return _distinct(found[:MOST_COLOURS], sizes[:MOST_COLOURS], _TWINS)


def _distinct(found: FloatArray, sizes: IntArray, twins: float) -> UInt8[np.ndarray, "colours 3"]:
    """Colours of which no two are twins; the more frequent one stays."""
    srgb = np.rint(found).astype(np.uint8)
    labs = srgb_to_lab(srgb)
    kept: list[int] = []
    for number in range(len(sizes)):
        if not kept or np.linalg.norm(labs[kept] - labs[number], axis=-1).min() >= twins:
            kept.append(number)
    return np.asarray(srgb[kept])


def _with_lines(
    survey: Survey, srgb: UInt8[np.ndarray, "colours 3"], even: BoolArray, clean: bool, noise: int
) -> UInt8[np.ndarray, "colours 3"]:
    """The colours of areas and those that only lines and dots have."""
    ridge = ~even & (survey.ridge >= max(24, 3 * noise)) & (2 * survey.ridge.astype(int) > survey.ramp)
    if clean:
        codes, sizes = _by_count(_codes(survey.codes[ridge]))
        found, hard = _colours(codes).astype(float), len(codes) <= _HARD
    else:
        hard = False
        found, sizes = modes(survey.codes[ridge], 3)
    least = max(4, 0.002 * np.count_nonzero(ridge)) if np.count_nonzero(ridge) > 200 else 1
    for colour in found[sizes >= least][:MOST_COLOURS]:
        line = np.rint(colour).astype(np.uint8)
        apart = np.linalg.norm(srgb_to_lab(srgb) - srgb_to_lab(line[None]), axis=-1).min()
        if len(srgb) == MOST_COLOURS or apart < _NEW:
            continue
        mixed = is_mixture(colour[None], srgb, _OFF)[0]
        if not mixed or (hard and not _is_mixed_with_its_ground(survey, line, ridge, srgb)):
            srgb = np.concatenate([srgb, line[None]])
    return srgb


def _is_mixed_with_its_ground(
    survey: Survey, line: UInt8[np.ndarray, " 3"], ridge: BoolArray, srgb: UInt8[np.ndarray, "colours 3"]
) -> bool:
    """Whether a colour of lines is, on half of its ridges, a mixture of the colour beside it and another one.

    Two colours that never meet there have no mixture on this line, whatever lies between their codes.
    """
    grounds, counts = _by_count(_codes(survey.beside[ridge & (survey.codes == line).all(axis=-1)]))
    colour = line[None].astype(float)
    pairs = ((ground, other) for ground in _colours(grounds) for other in srgb)
    mixed = [is_mixture(colour, np.stack(pair), _OFF)[0] for pair in pairs]
    share = np.reshape(mixed, (len(grounds), len(srgb))).any(axis=-1)
    return bool(2 * counts[share].sum() >= counts.sum())


def is_mixture(colours: FloatArray, palette: UInt8[np.ndarray, "colours 3"], off: float) -> BoolArray:
    """Whether each colour lies within `off` codes of a segment between two colours of a palette."""
    mixture = np.zeros(len(colours), dtype=bool)
    _mark_mixtures(np.ascontiguousarray(colours), palette.astype(float), off, mixture)
    return mixture


@uncounted
def _mark_mixtures(colours: FloatArray, ends: FloatArray, off: float, mixture: BoolArray) -> None:
    for colour in range(len(colours)):
        for one in range(len(ends)):
            for two in range(one + 1, len(ends)):
                if not mixture[colour]:
                    mixture[colour] = _between(colours, colour, ends, one, two, off)


@uncounted
def _between(colours: FloatArray, colour: int, ends: FloatArray, one: int, two: int, off: float) -> bool:  # noqa: PLR0917
    """Whether a colour lies within `off` of the segment between two ends, and beside neither."""
    along, length = 0.0, 0.0
    for channel in range(3):
        step = ends[two, channel] - ends[one, channel]
        along += (colours[colour, channel] - ends[one, channel]) * step
        length += step * step
    share = along / max(length, 1.0)
    if not 0.0 < share < 1.0:
        return False
    apart = 0.0
    for channel in range(3):
        begin = ends[one, channel]
        apart += (colours[colour, channel] - begin - share * (ends[two, channel] - begin)) ** 2
    return apart <= off * off


def _without_blends(
    survey: Survey, srgb: UInt8[np.ndarray, "colours 3"], even: BoolArray
) -> UInt8[np.ndarray, "colours 3"]:
    """The colours without those that occur on edges and are blends of others."""
    if not len(srgb):
        return srgb
    ridge = ~even & (survey.ridge >= np.maximum(40, survey.ramp))
    labs = srgb_to_lab(srgb)
    label = np.empty((1, len(survey.codes)), dtype=np.uint8)
    label_rows(survey.codes[None], np.full(1 << 24, 255, dtype=np.uint8), labs, label)
    pixels, inner, lines = (
        np.bincount(label[0], weight, len(srgb)) for weight in (None, even.astype(float), ridge.astype(float))
    )
    least = float(np.mean(even)) * np.maximum(pixels, 1)
    weak = (inner < _WEAK * least) & (lines < _LEAST_LINES * pixels)
    bare = inner < 0.4 * _WEAK * least
    kept: list[int] = []
    for colour in np.lexsort((np.arange(len(srgb)), -pixels)):
        near = [one for one in kept if np.linalg.norm(labs[one] - labs[colour]) < _HALO]
        halo = any(bare[one] or (weak[colour] and pixels[one] >= 3 * pixels[colour]) for one in near)
        if not (bare[colour] and halo) and not (weak[colour] and _is_blend(srgb[[colour]], srgb[kept])[0]):
            kept.append(int(colour))
    return srgb[kept]


def _is_blend(colours: UInt8[np.ndarray, "some 3"], palette: UInt8[np.ndarray, "colours 3"]) -> BoolArray:
    """Whether the luma of a colour lies between those of two colours of a palette, and its chroma also."""
    (y, u, v), (ys, us, vs) = _luma_chroma(colours), _luma_chroma(palette)
    blend = np.zeros(len(colours), dtype=bool)
    for one in range(len(palette)):
        for two in range(one):
            du, dv = us[two] - us[one], vs[two] - vs[one]
            share = np.clip(((u - us[one]) * du + (v - vs[one]) * dv) / max(du * du + dv * dv, 1.0), 0.0, 1.0)
            off = np.hypot(u - us[one] - share * du, v - vs[one] - share * dv)
            low, high = min(ys[one], ys[two]) - _SLACK, max(ys[one], ys[two]) + _SLACK
            blend |= (off <= _SLACK) & (y >= low) & (y <= high)
    return blend


def _luma_chroma(srgb: UInt8[np.ndarray, "colours 3"]) -> tuple[FloatArray, FloatArray, FloatArray]:
    red, green, blue = srgb.astype(float).T
    luma = 0.299 * red + 0.587 * green + 0.114 * blue
    return luma, 0.564 * (blue - luma), 0.713 * (red - luma)


def _mixtures(survey: Survey, srgb: UInt8[np.ndarray, "colours 3"]) -> float:
    """Share of the pixels that have no true colour."""
    return float(np.mean(~np.isin(_codes(survey.codes), _codes(srgb))))
