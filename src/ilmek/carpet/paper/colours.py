"""Colours of the cells: the light on the sheet is taken out, and the cells fall into the colours of the drawing.

    ln I(cell) = ln palette(colour of the cell) + S(u, v)

S is smooth, and one for the three channels: light and shadow. Most neighbours have one colour, so that the differences
of neighbours are those of S but for outliers: a polynomial is fitted to them, weighted down beyond a few percent [E.
H. Land, J. J. McCann, Lightness and retinex theory, J. Opt. Soc. Am. 61 (1971) 1-11]. Then, in turn, cells are grouped
in CIELAB about the densest colours, and S is smoothed from what each cell is off its colour: the edge of a shadow is
sharper than the polynomial.

I are the codes of sRGB: a power of the light, so that a product of light is a product of codes.
"""

import numpy as np
import scipy

from ilmek.arrays import BoolArray, Float, FloatArray, Indices, IntArray, UInt8
from ilmek.carpet.colour import RGB_TO_XYZ, decode, xyz_to_lab
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.records import record

DARK = 4.0
"""Codes that are added before the logarithm: black has noise, too."""

_DEGREE = 5
_MOST_STEPS = 10_000
"""Number of differences of neighbours that are used, at most."""

_ONE_COLOUR = 0.03
"""Difference of the logarithms of neighbours beyond which they hardly have one colour."""

_BIN, APART = 3.0, 9.0
"""Side of the bins in which colours are counted, and least distance of two colours of a drawing [CIELAB]."""

LUMA = np.array([0.299, 0.587, 0.114])
"""Lightness of sRGB codes (ITU-R BT.601)."""

_LEAST = 2
"""Least number of cells of a colour."""

_SHADOW = 3.0
"""Standard deviation of the smoothing of S [cells]."""

_ROUNDS = 4

_DOUBTFUL_RATIO, _DOUBTFUL_OFF, _DOUBTFUL_SPREAD, _DOUBTFUL_STRENGTH = 0.4, 3.0, 30.0, -1.5
"""A cell is doubtful where its distance to its colour is above this share of that to the second, above so many times
the usual distance, where its middle is as uneven as this [codes], or where the lattice is as weak as this."""

_FEW, _RARE = 4, 0.004
"""A colour of fewer cells than these, or than this share, is doubtful: a smudge, the table, the edge of a shadow."""

_USUAL_OFF = 2.0
"""Least usual distance of the cells to their colour [CIELAB]."""


@record
class CellColours:
    """The colours of the cells.

    palette     sRGB of each colour, most cells first
    numbers     of each cell's colour (rows, columns)
    confidence  1 less the distance to the own colour over that to the next nearest, 0 to 1 (rows, columns)
    doubtful    the cells to be looked at
    """

    palette: UInt8[np.ndarray, "colours 3"]
    numbers: Indices
    confidence: Float[np.ndarray, "rows columns"]
    doubtful: BoolArray


def cell_colours(
    colours: Float[np.ndarray, "rows columns 3"], spread: Float[np.ndarray, "rows columns"]
) -> CellColours:
    """The colours that cells have; `spread`: range of the lightness within each [codes]."""
    brightness = np.log(colours @ LUMA + DARK)
    light = _slow_light(brightness)
    for _ in range(_ROUNDS):
        lab = _lab(colours, light)
        centres, numbers = _grouped(lab.reshape(-1, 3))
        numbers = numbers.reshape(spread.shape)
        even = brightness - light
        of_colour = np.array([np.median(even[numbers == one]) for one in range(len(centres))])
        sure = np.sqrt(((lab - centres[numbers]) ** 2).sum(axis=-1)) < 2 * APART / 3
        light = _smoothed(brightness - of_colour[numbers], sure, light)
    lab = _lab(colours, light)
    centres, numbers = _grouped(lab.reshape(-1, 3))
    distance = np.sqrt(((lab[..., None, :] - centres) ** 2).sum(axis=-1))
    numbers = numbers.reshape(spread.shape)
    own = np.take_along_axis(distance, numbers[..., None], axis=-1)[..., 0]
    np.put_along_axis(distance, numbers[..., None], np.inf, axis=-1)
    ratio = own / np.maximum(distance.min(axis=-1), 1e-9)
    usual = max(_USUAL_OFF, float(np.quantile(own, 0.9)))
    rare = np.bincount(numbers.ravel(), minlength=len(centres)) < max(_FEW, _RARE * numbers.size)
    doubtful = (ratio > _DOUBTFUL_RATIO) | (own > _DOUBTFUL_OFF * usual) | (spread > _DOUBTFUL_SPREAD) | rare[numbers]
    evenly = _evenly_lit(colours, light)
    palette = np.stack([np.median(evenly[numbers == one], axis=0) for one in range(len(centres))])
    return CellColours(
        np.rint(palette).astype(np.uint8), numbers.astype(np.uint8), np.clip(1 - ratio, 0.0, 1.0), doubtful
    )


def _evenly_lit(colours: FloatArray, light: FloatArray) -> FloatArray:
    """The codes of the cells without S."""
    return np.asarray(np.clip((colours + DARK) * np.exp(-light)[..., None] - DARK, 0.0, 255.0))


def _lab(colours: FloatArray, light: FloatArray) -> FloatArray:
    return cell_lab(_evenly_lit(colours, light))


def cell_lab(codes: FloatArray) -> FloatArray:
    """CIELAB of sRGB codes that need not be whole."""
    return np.asarray(xyz_to_lab(decode(codes / 255) @ RGB_TO_XYZ.T))


def _slow_light(logs: Float[np.ndarray, "rows columns"]) -> FloatArray:
    """S as a polynomial, by the differences of neighbours; its mean is 0."""
    rows, columns = logs.shape
    v, u = np.meshgrid(np.linspace(-1, 1, rows), np.linspace(-1, 1, columns), indexing="ij")
    powers = [(i, j) for i in range(_DEGREE + 1) for j in range(_DEGREE + 1 - i) if i + j]
    terms = np.stack([u**i * v**j for i, j in powers], axis=-1)
    steps = np.concatenate([np.diff(terms, axis=axis).reshape(-1, len(powers)) for axis in (0, 1)])
    part = slice(None, None, -(-len(steps) // _MOST_STEPS))
    steps = steps[part]
    seen = np.concatenate([np.diff(logs, axis=axis).ravel() for axis in (0, 1)])[part]
    weights = 1 / (1 + (seen / _ONE_COLOUR) ** 2) ** 2
    for _ in range(8):
        weighted = steps * weights[:, None]
        found = np.linalg.solve(weighted.T @ steps + 1e-6 * np.eye(len(powers)), weighted.T @ seen)
        weights = 1 / (1 + ((seen - steps @ found) / _ONE_COLOUR) ** 2) ** 2
    light = terms @ found
    return np.asarray(light - light.mean())


def _smoothed(off: FloatArray, sure: BoolArray, before: FloatArray) -> FloatArray:
    """S from what the sure cells are off their colours; far from these as before."""
    weight = scipy.ndimage.gaussian_filter(sure.astype(float), _SHADOW, mode="nearest")
    moved = scipy.ndimage.gaussian_filter(np.where(sure, off - before, 0.0), _SHADOW, mode="nearest")
    return np.asarray(before + moved / (weight + 0.05))


def _grouped(lab: Float[np.ndarray, "cells 3"]) -> tuple[Float[np.ndarray, "colours 3"], IntArray]:
    """The densest colours, most cells first, and the number of the nearest for each cell."""
    keys = np.floor(lab / _BIN).astype(np.int64)
    bins, of_bin, counts = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    tree = scipy.spatial.cKDTree(bins * _BIN)
    near = tree.query_ball_point(bins * _BIN, 1.8 * _BIN)
    density = np.array([counts[one].sum() for one in near])
    sums = np.stack([np.bincount(of_bin.ravel(), weights=axis) for axis in lab.T], axis=-1)
    centres: list[FloatArray] = []
    for one in np.argsort(-density, kind="stable").tolist():
        middle = sums[near[one]].sum(axis=0) / density[one]
        if density[one] >= _LEAST and all(np.linalg.norm(middle - other) >= APART for other in centres):
            centres.append(middle)
        if len(centres) == MOST_YARNS:
            break
    found = np.stack(centres) if centres else lab.mean(axis=0, keepdims=True)
    for _ in range(3):
        _, numbers = scipy.spatial.cKDTree(found).query(lab)
        found = np.stack([np.median(lab[numbers == k], axis=0) for k in range(len(found)) if (numbers == k).any()])
        found = _merged(found, np.bincount(numbers, minlength=len(found)))
    _, numbers = scipy.spatial.cKDTree(found).query(lab)
    order = np.argsort(-np.bincount(numbers, minlength=len(found)), kind="stable")
    place = np.argsort(order, kind="stable")
    return found[order], place[numbers]


def _merged(centres: FloatArray, counts: FloatArray) -> FloatArray:
    """The colours without those nearer than APART to one that has more cells."""
    kept: list[FloatArray] = []
    for one in np.argsort(-counts[: len(centres)], kind="stable").tolist():
        if all(np.linalg.norm(centres[one] - other) >= APART for other in kept):
            kept.append(centres[one])
    return np.stack(kept)
