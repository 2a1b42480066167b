"""The hub of a cam on its shaft: bore and keyway.

    d^3 = 16 T / (pi tau)                     a solid shaft under a torque T at the shear stress tau

Width and depth of the keyway in the hub by the bore.                                                  [DIN 6885-1]
"""

import bisect
import math
from dataclasses import dataclass

from ilmek.plane import contours
from ilmek.report import Contour
from ilmek.units import MPa, mm

SHEAR = 30 * MPa
"""Shear stress for the first sizing of shafts with keyways: below a fifth of the yield strength of common steels."""

BORES = tuple(
    size * mm for size in (6, 8, 10, 12, 15, 17, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80, 85, 90, 95, 100)
)
"""Usual bores [m]; beyond the last, whole centimetres."""

_UP_TO = (8, 10, 12, 17, 22, 30, 38, 44, 50, 58, 65, 75, 85, 95, 110, 130)
_WIDTH = (2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20, 22, 25, 28, 32)
_DEPTH = (1.0, 1.4, 1.8, 2.3, 2.8, 3.3, 3.3, 3.3, 3.8, 4.3, 4.4, 4.9, 5.4, 5.4, 6.4, 7.4)
_LEAST = 6 * mm


@dataclass(frozen=True, slots=True)
class Hub:
    """Diameter of the bore, width of the keyway and its depth beyond the bore [m]; both 0 without a key."""

    bore: float
    key_width: float
    key_depth: float

    @property
    def reach(self) -> float:
        """Largest distance [m] of the hole's edge from the axis."""
        return math.hypot(self.bore / 2 + self.key_depth, self.key_width / 2) if self.key_width else self.bore / 2

    @property
    def contour(self) -> Contour:
        """Edge of the hole, its keyway towards the zero of the cam angle [m]."""
        if not self.key_width:
            return contours.circle(0j, self.bore / 2)
        return contours.keyed_bore(self.bore / 2, self.key_width, self.key_depth)

    @property
    def area(self) -> float:
        """Area of the hole [m^2]."""
        return contours.area(self.contour)


def hub_for(bore: float) -> Hub:
    """The hub of a bore [m]: with the keyway of its size, from 6 mm to 130 mm.

    >>> hub_for(0.020)
    Hub(bore=0.02, key_width=0.006, key_depth=0.0028)
    """
    index = bisect.bisect_left(_UP_TO, round(bore / mm, 9))
    if bore < _LEAST or index == len(_UP_TO):
        return Hub(bore, 0.0, 0.0)
    return Hub(bore, _WIDTH[index] * mm, _DEPTH[index] * mm)


def bore_for(torque: float) -> float:
    """The smallest usual bore whose shaft transmits a torque [N m].

    >>> bore_for(0.0), bore_for(100.0)
    (0.006, 0.03)
    """
    least = (16 * abs(torque) / (math.pi * SHEAR)) ** (1 / 3)
    return next((size for size in BORES if size >= least), math.ceil(least * 100) / 100)
