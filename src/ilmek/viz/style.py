"""Style of all figures: colours, line widths, fonts, axis labels.

The curve colours are those of M. Okabe and K. Ito, "Color Universal Design" (2008), with the yellow left out and the
orange darkened for white paper: they are distinguishable under every common colour blindness.
"""

import numpy as np

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
DASHED = ((4.5, 2.0), (2.4, 1.4), (7.5, 2.2))
"""Dash and gap in line widths of a dashed curve; beyond the palette the next."""
DOTTED = ((1.2, 1.6), (6.0, 1.8, 1.2, 1.8))
"""Dash, gap, dash ... in line widths of curves beyond the palette."""

_READ = 4.5
"""Least contrast of letters with the paper."""

SMALL, TEXT, STRONG = 7.8, 8.7, 9.2
"""Sizes of letters [pt]: ticks and marks, labels, names."""

FONTS = "'Helvetica Neue', Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"
"""Fonts of every figure; the first installed one is used."""


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
    """SI values in the unit of the axis, as floats; values that are not finite become NaN, a gap."""
    shown = np.array(values, dtype=float) / parse_unit(unit).factor
    shown[~np.isfinite(shown)] = np.nan
    return shown


def colour(number: int) -> str:
    """The colour of the curve with this number, from 0."""
    return PALETTE[number % len(PALETTE)]


def letters(colour_text: str) -> str:
    """The colour for letters on white: darkened until their contrast is 4.5 to 1 [WCAG 2.2, 1.4.3].

    >>> letters("#0072b2"), letters("#c98a00")
    ('#0072b2', '#9d6c00')
    """
    share = next(share for share in np.arange(1.0, 0.0, -0.02) if contrast(darker(colour_text, float(share))) >= _READ)
    return darker(colour_text, float(share))


def contrast(colour_text: str) -> float:
    """Contrast of a colour with white [WCAG 2.2, relative luminance].

    >>> contrast("#ffffff"), round(contrast("#000000"), 9)
    (1.0, 21.0)
    """
    channels = np.array([int(colour_text[at : at + 2], 16) / 255 for at in (1, 3, 5)])
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return float(1.05 / (linear @ np.array([0.2126, 0.7152, 0.0722]) + 0.05))


def darker(colour_text: str, share: float) -> str:
    """The colour mixed with black: share 1 leaves it, 0 is black."""
    return "#" + "".join(f"{round(share * int(colour_text[at : at + 2], 16)):02x}" for at in (1, 3, 5))


def tint(colour_text: str, share: float) -> str:
    """The colour mixed with white: share 1 leaves it, 0 is white.

    >>> tint("#000000", 0.2)
    '#cccccc'
    """
    channels = (int(colour_text[at : at + 2], 16) for at in (1, 3, 5))
    return "#" + "".join(f"{round(255 - share * (255 - channel)):02x}" for channel in channels)
