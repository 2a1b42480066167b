"""The hub of a cam on its shaft: bore and keyway.

d^3 = 16 T / (pi tau)                     a solid shaft under a torque T at the shear stress tau  [Shigley, 3-12]
"""

import math
from dataclasses import dataclass

from ilmek.elements.keyways import KEYWAYS
from ilmek.plane import contours
from ilmek.report import Contour
from ilmek.units import MPa, mm

SHEAR = 30 * MPa
"""Shear stress for the first sizing of shafts with keyways: below a fifth of the yield strength of common steels."""

BORES = tuple(
    size * mm for size in (6, 8, 10, 12, 15, 17, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80, 85, 90, 95, 100)
)
"""Usual bores [m]; beyond the last, whole centimetres."""

LEAST_BORE = 6 * mm
"""Smallest bore with a keyway [m]."""

ROUNDING = 1e-9


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
    keyway = next((one for one in KEYWAYS if bore <= one.upto * (1 + ROUNDING)), None)
    if keyway is None or bore < LEAST_BORE:
        return Hub(bore, 0.0, 0.0)
    return Hub(bore, keyway.width, keyway.in_hub)


def bore_for(torque: float) -> float:
    """The smallest usual bore whose shaft transmits a torque [N m].

    >>> bore_for(0.0), bore_for(100.0)
    (0.006, 0.03)
    """
    least = (16 * abs(torque) / (math.pi * SHEAR)) ** (1 / 3)
    return next((size for size in BORES if size >= least), math.ceil(least * 100) / 100)
