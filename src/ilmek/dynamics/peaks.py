"""Greatest values over a turn: suprema, not the greatest of some samples."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ilmek.arrays import BoolArray, FloatArray
from ilmek.units import turn

Curves: TypeAlias = Callable[[FloatArray], Mapping[str, FloatArray]]
"""Angles [rad] -> named values, one an angle; of period 2 pi and smooth near their maxima."""

RIVAL = 0.01
"""Local maxima of the samples within this part of the greatest are all refined."""


@dataclass(frozen=True, slots=True)
class Peak:
    """A greatest value and the angle [rad] in [0, 2 pi) where it is reached."""

    value: float
    angle: float


def peaks(curves: Curves, *, samples: int = 720, rounds: int = 4) -> dict[str, Peak]:
    """The greatest value of each curve over a turn, to about 1e-12 of itself.

    Every local maximum of the samples that rivals the greatest is bracketed by its neighbours; each round divides all
    brackets by 8 in one evaluation. A maximum is flat, so that its value converges with the square of its place.
    """
    angles = np.arange(samples) * (turn / samples)
    values = curves(angles)
    found = [(name, angles[place]) for name in values for place in np.flatnonzero(_rivals(values[name]))]
    where = np.array([angle for _, angle in found])
    width = turn / samples
    grid = np.linspace(-1.0, 1.0, 17)
    for _ in range(rounds):
        tried = where[:, None] + width * grid
        finer = curves(np.ravel(tried))
        heights = [np.reshape(finer[name], tried.shape)[row] for row, (name, _) in enumerate(found)]
        places = [int(np.argmax(height)) for height in heights]
        where = tried[np.arange(len(found)), places]
        width /= 8
    tops = [
        (name, float(height[place]), float(angle))
        for (name, _), height, place, angle in zip(found, heights, places, where, strict=True)
    ]
    return {name: _highest(name, tops) for name in values}


def _rivals(values: FloatArray) -> BoolArray:
    """Samples not below their neighbours and near the greatest of all."""
    top, spread = np.max(values), np.max(values) - np.min(values)
    local = (values >= np.roll(values, 1)) & (values >= np.roll(values, -1)) & (values >= top - RIVAL * spread)
    # A constant curve is everywhere a maximum: one will do.
    rivals: BoolArray = local if spread > 1e-12 * abs(top) else np.arange(values.size) == 0
    return rivals


def _highest(name: str, tops: Sequence[tuple[str, float, float]]) -> Peak:
    value, angle = max((value, angle) for of, value, angle in tops if of == name)
    return Peak(value, angle % turn)
