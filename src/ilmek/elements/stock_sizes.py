"""Sizes in which bars, wire, plates and sheets are sold: a choice of those of the standards, as dealers have in stock.

Bright round bars: EN 10278; hot rolled ones: EN 10060; wire: EN 10270, EN 10218; sheets: EN 10131; plates: EN 10029.
Square bars: EN 10278, from 20 mm on EN 10059.
"""

import bisect

from ilmek.elements.shafts import STOCK_SIDES
from ilmek.units import mm

ROUNDS = tuple(
    size * mm
    for size in (
        *(0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.2, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16),
        *(17, 18, 20, 22, 24, 25, 26, 28, 30, 32, 35, 36, 38, 40, 42, 45, 48, 50, 52, 55, 60, 65, 70, 75, 80, 85, 90),
        *(95, 100, 110, 120, 125, 130, 140, 150, 160, 170, 180, 190, 200, 220, 240, 250, 260, 280, 300, 320, 350, 400),
    )
)
"""Diameters of round bars and wire [m]."""

PLATES = tuple(
    size * mm
    for size in (
        *(0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12, 15, 18, 20, 25, 30, 35, 40, 45, 50),
        *(60, 70, 80, 90, 100, 120, 140, 150, 160, 180, 200),
    )
)
"""Thicknesses of sheets, plates and flat bars [m]."""


SQUARES = (*(size * mm for size in (2, 3, 4, 5, 6, 8, 10, 12, 14, 15, 16, 18)), *STOCK_SIDES)
"""Sides of square bars [m]."""


def offered(size: float, series: tuple[float, ...]) -> float:
    """The least size of a series that is no less than a size [m]; beyond the series the size in whole millimetres.

    >>> round(offered(13e-3, ROUNDS), 9), offered(13e-3, PLATES)
    (0.013, 0.015)
    """
    number = bisect.bisect_left(series, size - _ROUNDING)
    return series[number] if number < len(series) else -(-(size - _ROUNDING) // mm) * mm


_ROUNDING = 1e-9
