"""Pile yarn: name, colour, count and price."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.carpet.picture_points import hex_colour
from ilmek.errors import YarnError

MOST_YARNS = 255

COUNTS, PLIES = (0.05, 500.0), (1, 64)
"""Bounds of the metric count of a strand, and of the number of strands."""


@dataclass(frozen=True, slots=True)
class Yarn:
    """A yarn of the list.

    srgb          codes 0 to 255, for display       lab    CIELAB, for matching
    metric_count  Nm of a single strand [m/g]; None: left open, to follow from the quality
    ply           number of strands
    price         per kg; None: unknown
    """

    name: str
    srgb: tuple[int, int, int]
    lab: tuple[float, float, float]
    metric_count: float | None = None
    ply: int = 1
    price: float | None = None

    @property
    def linear_density(self) -> float:
        """Mass per length [kg/m] = ply / (1000 Nm).

        A strand of Nm metres per gram weighs 1/Nm g/m = 1/(1000 Nm) kg/m; the shortening by twist is not included.
        Raises YarnError for a yarn whose count is left open.
        """
        if self.metric_count is None:
            raise YarnError(f"the yarn {self.name!r} has no count", do="give its nm, or a quality: `with_counts`")
        return self.ply / (1000.0 * self.metric_count)

    @property
    def hex(self) -> str:
        """The colour as `#rrggbb`."""
        return hex_colour(self.srgb)


def yarn_labs(yarns: Sequence[Yarn]) -> FloatArray:
    """CIELAB of the yarns, (yarns, 3)."""
    return np.array([yarn.lab for yarn in yarns], dtype=float).reshape(-1, 3)
