"""Pile yarn: name, colour, count and price."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray

MOST_YARNS = 255


@dataclass(frozen=True, slots=True)
class Yarn:
    """A yarn of the list.

    srgb          codes 0 to 255, for display       lab    CIELAB, for matching
    metric_count  Nm of a single strand [m/g]       ply    number of strands
    price         per kg; None: unknown
    """

    name: str
    srgb: tuple[int, int, int]
    lab: tuple[float, float, float]
    metric_count: float
    ply: int = 1
    price: float | None = None

    @property
    def linear_density(self) -> float:
        """Mass per length [kg/m] = ply / (1000 Nm).

        A strand of Nm metres per gram weighs 1/Nm g/m = 1/(1000 Nm) kg/m; the shortening by twist is not included.
        """
        return self.ply / (1000.0 * self.metric_count)

    @property
    def hex(self) -> str:
        """The colour as `#rrggbb`."""
        return "#{:02x}{:02x}{:02x}".format(*self.srgb)


def yarn_labs(yarns: Sequence[Yarn]) -> FloatArray:
    """CIELAB of the yarns, (yarns, 3)."""
    return np.array([yarn.lab for yarn in yarns], dtype=float).reshape(-1, 3)
