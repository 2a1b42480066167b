"""Several needle mechanisms on one main shaft, each running behind the one before by the same angle.

    M(theta) = sum_k M_b(theta - k phase),      R(theta) = sum_k R_O(theta - k phase),      k = 0 ... bars - 1

The sum R is what all bearings of the main shaft carry together; how they share it depends on where they stand.
"""

from collections.abc import Callable, Iterable
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray

Shaft: TypeAlias = Callable[[FloatArray, FloatArray], tuple[FloatArray, ComplexArray]]
"""Angles [rad] and sides -> torque on the crank [N m] and force of the bearings on it [N] of one mechanism."""


def together(
    one: Shaft, bars: int, phase: float, angle: FloatArray, side: FloatArray
) -> tuple[FloatArray, ComplexArray]:
    """Torque on the shaft [N m] and force of its bearings on it [N] of all bars, at the first one's crank angles."""
    behind = phase * np.arange(bars)[:, None]
    torque, force = one(np.ravel(angle - behind), np.tile(side, bars))
    return torque.reshape(bars, -1).sum(axis=0), force.reshape(bars, -1).sum(axis=0)


def all_breaks(breaks: Iterable[float], bars: int, phase: float) -> list[float]:
    """Where the sum may jump: wherever one of the bars does [rad]."""
    return [at + phase * bar for at in breaks for bar in range(bars)]
