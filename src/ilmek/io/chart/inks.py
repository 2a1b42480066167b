"""Print of the yarns of a chart: fill colours, symbols, and their contrast."""

from collections.abc import Sequence
from dataclasses import dataclass

from ilmek.carpet.cells import GROUND_COLOUR
from ilmek.carpet.codes import CODES
from ilmek.carpet.colour import takes_white
from ilmek.carpet.yarn import Yarn
from ilmek.io.chart.symbols import NO_SIGN


@dataclass(frozen=True, slots=True)
class Inks:
    """Print of each code of a chart's knots: fill colour 0 to 1, symbol, and whether the symbol is white."""

    fills: tuple[tuple[float, float, float], ...]
    symbols: str
    white: tuple[bool, ...]

    @staticmethod
    def of(yarns: Sequence[Yarn], symbols: str) -> "Inks":
        """The inks of a yarn list: the symbol is black or white, whichever has the higher contrast with the yarn."""
        colours = [*(yarn.srgb for yarn in yarns), *([GROUND_COLOUR] * (CODES - len(yarns)))]
        fills = tuple((red / 255, green / 255, blue / 255) for red, green, blue in colours)
        white = [takes_white(yarn.srgb) for yarn in yarns] + [False] * (CODES - len(yarns))
        return Inks(fills, symbols.ljust(CODES, NO_SIGN), tuple(white))
