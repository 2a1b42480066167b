"""Subject of a picture: the part that a crop keeps.

A crop to other proportions has the whole height or the whole width, so it moves along one side. It keeps most of the
picture's contrast: at each point the difference of the blurred colour from the mean colour of the picture
[Achanta, Hemami, Estrada, Süsstrunk, Frequency-tuned salient region detection, CVPR 2009, eq. 4], and the difference of
neighbours, the edges, with equal weight.
"""

import numpy as np

from ilmek.arrays import Float, FloatArray, Rgb
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.design import resampled

_SIDE = 192
"""Longer side on which the contrast is measured [pixels]."""

_MARGINS = (0.0, 0.05, 0.1, 0.15)
"""Shares of the part at either end without which it is measured too: what lies at an end counts less."""

_BINOMIAL = (1, 4, 6, 4, 1)

_NEARLY = 0.92
"""Share of the greatest contrast that is as good: the crop nearest to the centre is taken among those."""


def subject_start(rgb: Rgb, length: int, *, across: bool) -> int:
    """Where a part of that length begins along a side, so that it keeps most of the picture's contrast.

    across  the part moves along the width, else along the height
    Of parts that keep nearly the same, the one nearest to the centre; where there are such on both sides, the centre,
    so that a symmetric picture stays so.
    """
    whole = int(rgb.shape[1 if across else 0])
    centre = (whole - length) / 2
    kept = np.concatenate([[0.0], np.cumsum(_along(rgb, across=across))])
    starts = np.arange(whole - length + 1)
    places = np.linspace(0, whole, len(kept))
    shown = np.zeros(len(starts))
    for margin in length * np.array(_MARGINS):
        shown += np.interp(starts + length - margin, places, kept) - np.interp(starts + margin, places, kept)
    good = starts[shown >= _NEARLY * shown.max()] - centre
    if good.min() <= 0.0 <= good.max():
        return int(centre)
    nearest = float(good.max() if good.max() < 0 else good.min())
    return round(nearest + centre)


def _along(rgb: Rgb, *, across: bool) -> FloatArray:
    """The contrast along a side of the picture, summed over the other one."""
    contrast = _contrast(rgb)
    return np.asarray(contrast.sum(axis=0 if across else 1))


def _contrast(rgb: Rgb) -> Float[np.ndarray, "rows columns"]:
    height, width = int(rgb.shape[0]), int(rgb.shape[1])
    scale = min(1.0, _SIDE / max(height, width))
    small = resampled(rgb, max(1, round(scale * height)), max(1, round(scale * width)))
    lab = srgb_to_lab(small)
    salient = np.linalg.norm(_blurred(lab) - lab.mean(axis=(0, 1)), axis=-1)
    edges = np.zeros_like(salient)
    edges[1:-1] += np.linalg.norm(lab[2:] - lab[:-2], axis=-1)
    edges[:, 1:-1] += np.linalg.norm(lab[:, 2:] - lab[:, :-2], axis=-1)
    return np.asarray(salient / max(float(salient.mean()), 1e-9) + edges / max(float(edges.mean()), 1e-9))


def _blurred(lab: Float[np.ndarray, "rows columns 3"]) -> Float[np.ndarray, "rows columns 3"]:
    """Means by the binomial filter 1 4 6 4 1 along both sides, edges repeated."""
    padded = np.pad(lab, ((2, 2), (2, 2), (0, 0)), mode="edge")
    high, wide = lab.shape[:2]
    rows = np.average([padded[first : first + high] for first in range(5)], axis=0, weights=_BINOMIAL)
    return np.asarray(np.average([rows[:, first : first + wide] for first in range(5)], axis=0, weights=_BINOMIAL))
