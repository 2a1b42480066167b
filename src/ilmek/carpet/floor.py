"""Floor around a carpet in a photograph: what of the picture differs from it, in any light.

1. The light is evened: log(L* + 16) of the picture's margin follows a quadratic of the position, fitted by Tukey's
   biweight, and each colour (L* + 16, a*, b*) is divided by it. A factor on the light is a factor on these three
   [CIE 15, 8.2.1, where the cube roots hold].
2. The colours of the floor are those of the margin, in `_CLUSTERS` clusters.
3. The difference of a pixel is its distance to the nearest cluster, or to that cluster in shadow, down to the share
   `_DARKEST` of its L* + 16, in standard deviations of the cluster; 1 is above what is usual in the margin: 2.2 times
   the upper quartile there, 4.4 standard deviations of noise in three dimensions.
"""

import numpy as np
import scipy

from ilmek.arrays import BoolArray, Float, FloatArray

Lab = Float[np.ndarray, "height width 3"]

_MARGIN = 0.04
"""Width of the margin, of the picture's short side."""

_CLUSTERS, _LEAST_CLUSTER = 5, 0.04
"""Largest number of clusters, and least share of the margin of each: the end of a fringe in the margin is none."""

_SAMPLES = 20_000
"""Largest number of pixels of the margin that are used."""

_LEAST_SPREAD = 2.0
"""Least standard deviation of a colour of the floor, CIELAB: an even floor has noise too."""

_DARKEST = 0.75
"""L* + 16 of the darkest shadow, of the floor's in the light: four tenths of the light."""

BLACK = np.array([16.0, 0.0, 0.0], dtype=np.float32)
"""What is added to CIELAB so that a factor on the light is a factor on all three."""


def evened(lab: Lab) -> Lab:
    """A picture in CIELAB as it is where the light on its margin is even."""
    margin = _margin(lab.shape[0], lab.shape[1])
    y, x = np.nonzero(margin)
    chosen = slice(None, None, max(1, len(x) // _SAMPLES))
    terms = _quadratic(2 * x[chosen] / lab.shape[1] - 1, 2 * y[chosen] / lab.shape[0] - 1)
    values = np.log(np.maximum(lab[..., 0][margin][chosen], 0.0) + 16.0)
    weights, factors = np.ones(len(values)), np.zeros(terms.shape[1])
    for _ in range(12):
        weighted = terms * weights[:, None]
        factors = np.linalg.lstsq(weighted.T @ terms, weighted.T @ values, rcond=None)[0]
        residual = np.abs(values - terms @ factors)
        weights = np.maximum(1 - (residual / (6 * np.median(residual) + 1e-3)) ** 2, 0.0) ** 2
    factors[0] = 0.0
    column, row = np.linspace(-1, 1, lab.shape[1]), np.linspace(-1, 1, lab.shape[0])[:, None]
    light = sum(factor * term for factor, term in zip(factors, _terms(column, row), strict=True))
    even: FloatArray = (lab + BLACK) * np.exp(-np.asarray(light, dtype=np.float32))[..., None] - BLACK
    return even


def _terms(x: FloatArray, y: FloatArray) -> tuple[FloatArray, ...]:
    return (np.ones_like(x), x, y, x * x, x * y, y * y)


def _quadratic(x: FloatArray, y: FloatArray) -> FloatArray:
    return np.stack(_terms(x, y), axis=1)


def floor_difference(lab: Lab) -> tuple[Float[np.ndarray, "height width"], Float[np.ndarray, "3"]]:
    """Difference of each pixel of an evened picture to the floor, of the mean of 3 × 3 pixels; the floor's colour."""
    smooth: FloatArray = scipy.ndimage.uniform_filter(lab, (3, 3, 1))
    colours = smooth[_margin(lab.shape[0], lab.shape[1])]
    clusters = _clusters(colours[:: max(1, len(colours) // _SAMPLES)])
    unit = max(1.0, 2.2 * float(np.quantile(_distance(colours, clusters), 0.75)))
    return _distance(smooth, clusters) / unit, np.median(colours, axis=0)


def _margin(height: int, width: int) -> BoolArray:
    """The margin of a picture."""
    broad = max(2, round(_MARGIN * min(height, width)))
    margin = np.ones((height, width), dtype=bool)
    margin[broad:-broad, broad:-broad] = False
    return margin


def _clusters(colours: Float[np.ndarray, "colours 3"]) -> tuple[tuple[FloatArray, FloatArray], ...]:
    """Means and standard deviations of the clusters of colours: k-means from the farthest colours."""
    means = [np.median(colours, axis=0)]
    for _ in range(_CLUSTERS - 1):
        distance = np.min([((colours - mean) ** 2).sum(axis=1) for mean in means], axis=0)
        means.append(colours[distance.argmax()])
    for _ in range(8):
        nearest = np.argmin([((colours - mean) ** 2).sum(axis=1) for mean in means], axis=0)
        means = [colours[nearest == k].mean(axis=0) if (nearest == k).any() else mean for k, mean in enumerate(means)]
    large = [k for k in range(_CLUSTERS) if np.count_nonzero(nearest == k) >= _LEAST_CLUSTER * len(colours)]
    return tuple((means[k], np.maximum(colours[nearest == k].std(axis=0), _LEAST_SPREAD)) for k in large)


def _distance(lab: FloatArray, clusters: tuple[tuple[FloatArray, FloatArray], ...]) -> FloatArray:
    """Distance of colours to the nearest cluster, or to its shadow, in standard deviations."""
    least = np.full(lab.shape[:-1], np.inf, dtype=np.float32)
    for mean, spread in clusters:
        lit, colour = mean + BLACK, lab + BLACK
        dark = np.clip(colour @ lit / (lit @ lit), _DARKEST, 1.0)[..., None]
        np.minimum(least, (((colour - dark * lit) / spread) ** 2).sum(axis=-1), out=least)
    return np.sqrt(least)
