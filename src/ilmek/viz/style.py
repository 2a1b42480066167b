"""One look for every figure: colours, line widths, fonts and the words of an axis.

The curve colours are those of M. Okabe and K. Ito, "Color Universal Design" (2008), with the yellow left out and the
orange darkened for white paper: they stay apart under every common colour blindness.
"""

from functools import lru_cache
from typing import Any

import numpy as np
from matplotlib.colors import to_hex, to_rgb
from matplotlib.font_manager import FontProperties, findfont, get_font

from ilmek.arrays import FloatArray
from ilmek.units import parse_unit, printed_unit

INK = "#1f2933"
MUTED = "#55626e"
AXIS = "#9aa5b1"
GRID = "#e4e8ec"
STEEL = "#7b8794"
YARN = "#9b2d30"
PAPER = "#ffffff"
PALETTE = ("#0072b2", "#d55e00", "#009e73", "#b4558f", "#c98a00", "#3f9fd8", "#5b4b8a", "#4a4a4a")
DASHES: tuple[tuple[float, tuple[float, ...]], ...] = ((0, (4.5, 2.0)), (0, (1.2, 1.6)), (0, (6, 1.8, 1.2, 1.8)))

SMALL, TEXT, STRONG = 7.8, 8.7, 9.2
"""Sizes of letters [pt]: ticks and marks, labels, names."""

RC: dict[Any, Any] = {
    "svg.fonttype": "none",
    "text.parse_math": False,
    "svg.hashsalt": "ilmek",
    "font.family": "DejaVu Sans",
    "font.size": TEXT,
    "text.color": INK,
    "axes.edgecolor": AXIS,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "xtick.color": AXIS,
    "ytick.color": AXIS,
    "lines.solid_capstyle": "round",
    "lines.solid_joinstyle": "round",
    "path.simplify_threshold": 0.08,
}
"""Settings of matplotlib for every figure; names of fonts are put in afterwards, see `ink.FONTS`."""


def shown_unit(unit: str) -> str:
    """A unit as it is printed.

    >>> shown_unit("kg/m^3"), shown_unit("N*m"), shown_unit("deg"), shown_unit("m/s^2"), shown_unit("1")
    ('kg/m³', 'N·m', '°', 'm/s²', '')
    """
    plain = {"deg": "°", "um": "µm", "rpm": "rev/min", "inch": "in", "Nm": "N·m"}.get(unit, unit)
    return printed_unit(plain)


def with_unit(label: str, unit: str) -> str:
    """An axis label with its unit in brackets.

    >>> with_unit("drive torque", "N*m"), with_unit("ratio", "")
    ('drive torque [N·m]', 'ratio')
    """
    printed = shown_unit(unit)
    return f"{label} [{printed}]" if printed else label


def in_unit(values: FloatArray, unit: str) -> FloatArray:
    """SI values in the unit of the axis, as floats; what is not finite is a gap (NaN)."""
    shown = np.array(values, dtype=float) / parse_unit(unit).factor
    shown[~np.isfinite(shown)] = np.nan
    return shown


def colour(number: int) -> str:
    """The colour of the curve with this number, from 0."""
    return PALETTE[number % len(PALETTE)]


def tint(colour_text: str, share: float) -> str:
    """The colour mixed with white: share 1 leaves it, 0 is white.

    >>> tint("#000000", 0.2)
    '#cccccc'
    """
    red, green, blue = (1 - share * (1 - channel) for channel in to_rgb(colour_text))
    return to_hex((red, green, blue))


@lru_cache(maxsize=4096)
def text_width(text: str, size: float, bold: bool = False) -> float:
    """Width of a line of text [pt] in the widest font it may be shown in, at `size` [pt]."""
    font = get_font(_font_file(bold))
    font.set_size(size, 72.0)
    font.set_text(text, 0.0)
    return float(font.get_width_height()[0]) / 64.0


@lru_cache(maxsize=2)
def _font_file(bold: bool) -> str:
    return findfont(FontProperties(family="DejaVu Sans", weight="bold" if bold else "normal"))
