"""Print of the yarns of a chart: fill colours, symbols, and their contrast."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.carpet.colour import LINEAR
from ilmek.carpet.yarn import Yarn


@dataclass(frozen=True, slots=True)
class Inks:
    """Print of each yarn: fill colour 0 to 1, symbol, and whether the symbol is white."""

    fills: tuple[tuple[float, float, float], ...]
    symbols: str
    white: tuple[bool, ...]

    @staticmethod
    def of(yarns: Sequence[Yarn], symbols: str) -> "Inks":
        """The inks of a yarn list: the symbol is black or white, whichever has the higher contrast with the yarn."""
        fills = tuple((yarn.srgb[0] / 255, yarn.srgb[1] / 255, yarn.srgb[2] / 255) for yarn in yarns)
        return Inks(fills, symbols, tuple(_luminance(yarn.srgb) < 0.179 for yarn in yarns))


def _luminance(srgb: tuple[int, int, int]) -> float:
    """Relative luminance, black 0, white 1; black and white contrast equally at 0.179   [WCAG 2.2, 1.4.3]."""
    return float(LINEAR[list(srgb)] @ np.array([0.2126, 0.7152, 0.0722]))
