"""Print of the yarns of a chart: fill colours, symbols, and their contrast."""

from collections.abc import Sequence
from dataclasses import dataclass

from ilmek.carpet.colour import takes_white
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
        return Inks(fills, symbols, tuple(takes_white(yarn.srgb) for yarn in yarns))
