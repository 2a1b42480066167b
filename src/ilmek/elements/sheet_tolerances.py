"""Thickness tolerances of cold rolled steel sheet, and the sum of a pile of sheets.

    worst case    S = sum n_i T_i                                   all sheets at the same limit
    statistical   S = sum n_i m T_i + 3 sqrt(sum n_i s_i^2),   s = (1 - m) T / 3

T is the tolerance of a sheet. The sheets of one thickness come from one coil: their mean is off by m T, the same for
all, and each scatters about it so that three standard deviations reach the limit.                      [derived]

Source: EN 10131:2006, table 1: uncoated, yield strength below 260 MPa, widths to 1,200 mm; 0.35 mm to 3 mm.
"""

import bisect
import math
from collections.abc import Sequence

from ilmek.units import mm

NORMAL, SPECIAL = "normal", "special"

CLASSES = (NORMAL, SPECIAL)
"""Classes of EN 10131: normal tolerances, and special ones (S) by agreement."""

_UPTO = (0.40, 0.60, 0.80, 1.00, 1.20, 1.60, 2.00, 2.50, 3.00)
_TOLERANCES = {
    NORMAL: (0.03, 0.03, 0.04, 0.05, 0.06, 0.08, 0.10, 0.12, 0.15),
    SPECIAL: (0.020, 0.025, 0.030, 0.035, 0.040, 0.050, 0.060, 0.080, 0.100),
}

MEAN_SHARE = 0.5
"""Mean deviation of a coil over the tolerance, m; assumed by this project."""

_ROUNDING = 1e-9


def sheet_tolerance(thickness: float, quality: str = SPECIAL) -> float:
    """Tolerance T [m] of a nominal thickness [m], to both sides, in a class of `CLASSES`.

    Thinner sheets than those of the table have its least tolerance, thicker ones the last in proportion to their
    thickness; both are assumed by this project.

    >>> sheet_tolerance(1e-3), sheet_tolerance(1.001e-3), sheet_tolerance(1e-3, "normal")
    (3.5e-05, 4e-05, 5e-05)
    """
    row = bisect.bisect_left(_UPTO, thickness / mm - _ROUNDING)
    if row == len(_UPTO):
        return _TOLERANCES[quality][-1] * thickness / _UPTO[-1]
    return round(_TOLERANCES[quality][row] * mm, 9)


def worst_sum(sheets: Sequence[tuple[int, float]]) -> float:
    """Largest deviation [m] of a pile: numbers of sheets and their tolerances [m].

    >>> worst_sum([(4, 0.25), (2, 0.5)])
    2.0
    """
    return sum(number * tolerance for number, tolerance in sheets)


def statistical_sum(sheets: Sequence[tuple[int, float]], mean_share: float = MEAN_SHARE) -> float:
    """Deviation [m] of a pile that 99.7 % of piles keep: numbers of sheets and their tolerances [m].

    mean_share  of a coil's mean deviation in the tolerance, 0 to 1; at 1 it is the worst case

    >>> statistical_sum([(4, 3.0)], 0.0), statistical_sum([(4, 3.0)], 1.0)
    (6.0, 12.0)
    """
    variance = sum(number * ((1 - mean_share) * tolerance / 3) ** 2 for number, tolerance in sheets)
    return mean_share * worst_sum(sheets) + 3 * math.sqrt(variance)
