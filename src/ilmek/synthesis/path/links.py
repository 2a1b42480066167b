"""Link lengths to start the search of a path from: at random, within the crank's limits and the bounds.

    coupler and rocker at will,   D < r1 < E,   r2 < min(r1 - D, E - r1)      (double-cranks: r1 and r2 exchanged)

with D and E of `path.limits`. Ratios so drawn serve where some size brings them within the bounds; where bounds are
narrow, lengths drawn within the bounds and sifted by the crank's limits fill up.
"""

import numpy as np

from ilmek.arrays import Float
from ilmek.synthesis.path.limits import spans

Four = Float[np.ndarray, "4"]
Links = Float[np.ndarray, "some 4"]

DRAWS = 20_000
"""Lengths drawn within narrow bounds; where none of them keeps the crank's limits, there are none to be had."""

SMALL, LARGE = 1e-2, 1e2
"""Lengths drawn within bounds lie between, in sizes of the path, where the bounds leave that."""


def random_links(rng: np.random.Generator, count: int, bounds: tuple[Four, Four], *, kind: int, kappa: float) -> Links:
    """`count` sets of ground, crank, coupler, rocker; no set at all where bounds and limits cannot be met together."""
    low, high = bounds
    ratios = _by_ratio(rng.random((4 * count, 3)), kind, kappa)
    found = ratios[np.max(low / ratios, axis=1) <= np.min(high / ratios, axis=1)]
    if len(found) < count:
        found = np.concatenate([found, _within_bounds(rng, low, high, kind, kappa)])
    return found[np.arange(count) % len(found)] if len(found) else np.zeros((0, 4))


def _by_ratio(dice: Float[np.ndarray, "some 3"], kind: int, kappa: float) -> Links:
    """Links with rocker 1 within the crank's limits, one for each row of dice."""
    coupler = np.exp(3 * dice[:, 0] - 1.5)
    near, far = spans(coupler, np.ones_like(coupler), kappa)
    longer = near + (far - near) * (0.02 + 0.96 * dice[:, 1])
    shorter = (0.02 + 0.97 * dice[:, 2]) * np.minimum(longer - near, far - longer)
    ground, crank = (longer, shorter) if kind > 0 else (shorter, longer)
    return np.stack([ground, crank, coupler, np.ones_like(coupler)], axis=1)


def _within_bounds(rng: np.random.Generator, low: Four, high: Four, kind: int, kappa: float) -> Links:
    """Lengths drawn within the bounds, those that keep the crank's limits."""
    top = np.minimum(high, np.maximum(low, LARGE))
    bottom = np.minimum(np.maximum(low, SMALL), top)
    drawn = np.clip(np.exp(rng.uniform(np.log(bottom), np.log(top), (DRAWS, 4))), low, high)
    near, far = spans(drawn[:, 2], drawn[:, 3], kappa)
    apart, together = kind * (drawn[:, 0] - drawn[:, 1]), drawn[:, 0] + drawn[:, 1]
    kept: Links = drawn[(near <= apart) & (together <= far)]
    return kept
