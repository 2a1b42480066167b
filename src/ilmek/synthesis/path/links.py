"""Random link lengths for the starts of the path search, within the crank's limits and the bounds.

    any coupler and rocker,   D < r1 < E,   r2 < min(r1 - D, E - r1)      (double-cranks: r1 and r2 exchanged)

with D and E of `path.limits`. Random ratios are used if some size brings them within the bounds. For narrow bounds they
are completed by random lengths within the bounds that meet the crank's limits. [derived from the limits of Grashof]
"""

import math

import numpy as np

from ilmek.arrays import Float
from ilmek.synthesis.path.limits import MARGIN, spans

Four = Float[np.ndarray, "4"]
Links = Float[np.ndarray, "some 4"]

DRAWS = 20_000
"""Number of random lengths within narrow bounds; if none meets the crank's limits, none is assumed to exist."""

SMALL, LARGE = 1e-2, 1e2
"""Range of random lengths within bounds, in sizes of the path, where the bounds allow it."""


def random_links(
    rng: np.random.Generator, count: int, bounds: tuple[Four, Four], *, kind: int, kappa: float, ratio: float = math.inf
) -> Links:
    """`count` sets of ground, crank, coupler, rocker, shape (count, 4); none where there is no such set.

    bounds  lower and upper bounds of the four links [m]      kind, kappa, ratio  see `path.limits`
    """
    low, high = bounds
    ratios = _even(_by_ratio(rng.random((4 * count, 3)), kind, kappa), ratio)
    found = ratios[np.max(low / ratios, axis=1) <= np.min(high / ratios, axis=1)]
    if len(found) < count:
        found = np.concatenate([found, _even(_within_bounds(rng, low, high, kind, kappa), ratio)])
    return found[np.arange(count) % len(found)] if len(found) else np.zeros((0, 4))


def _even(links: Links, ratio: float) -> Float[np.ndarray, "kept 4"]:
    """Those whose longest link is at most `ratio` times the shortest, with the margin of a step."""
    return np.asarray(links[links.max(axis=1) <= ratio * (1 - MARGIN) * links.min(axis=1)])


def _by_ratio(random: Float[np.ndarray, "some 3"], kind: int, kappa: float) -> Links:
    """Links with rocker 1 within the crank's limits, one set per row of random numbers."""
    coupler = np.exp(3 * random[:, 0] - 1.5)
    near, far = spans(coupler, np.ones_like(coupler), kappa)
    longer = near + (far - near) * (0.02 + 0.96 * random[:, 1])
    shorter = (0.02 + 0.97 * random[:, 2]) * np.minimum(longer - near, far - longer)
    ground, crank = (longer, shorter) if kind > 0 else (shorter, longer)
    return np.stack([ground, crank, coupler, np.ones_like(coupler)], axis=1)


def _within_bounds(rng: np.random.Generator, low: Four, high: Four, kind: int, kappa: float) -> Links:
    """Random lengths within the bounds that meet the crank's limits."""
    top = np.minimum(high, np.maximum(low, LARGE))
    bottom = np.minimum(np.maximum(low, SMALL), top)
    drawn = np.clip(np.exp(rng.uniform(np.log(bottom), np.log(top), (DRAWS, 4))), low, high)
    near, far = spans(drawn[:, 2], drawn[:, 3], kappa)
    apart, together = kind * (drawn[:, 0] - drawn[:, 1]), drawn[:, 0] + drawn[:, 1]
    kept: Links = drawn[(near <= apart) & (together <= far)]
    return kept
