"""Stock round steel tubes, and the properties of their sections.

    I = π (D⁴ - d⁴) / 64,   J = 2 I,   W = 2 I / D,   A = π (D² - d²) / 4

D outer, d inner diameter. Hot finished hollow sections after EN 10210-2, and cold drawn precision tubes after EN
10305-1 in round diameters, among them the thesis' 140 x 5 mm: a choice of the standards' sizes.

>>> tube = find_tube("140x5")
>>> tube.outer_radius, tube.standard, round(tube.inertia * 1e8, 2)
(0.07, 'EN 10305-1', 483.76)
"""

import math
import re
from dataclasses import dataclass

from ilmek.errors import ParameterError
from ilmek.units import mm


@dataclass(frozen=True, slots=True)
class Tube:
    """A round tube: outer diameter and wall [m], the standard that lists it."""

    outer: float
    wall: float
    standard: str

    @property
    def name(self) -> str:
        """Outer diameter x wall in millimetres."""
        return f"{self.outer / mm:.5g}x{self.wall / mm:.5g}"

    @property
    def outer_radius(self) -> float:
        """Ro [m]."""
        return self.outer / 2

    @property
    def inner_radius(self) -> float:
        """Ri [m]."""
        return self.outer / 2 - self.wall

    @property
    def area(self) -> float:
        """Area of the section [m²]: π (Ro² - Ri²)."""
        return math.pi * self.wall * (self.outer - self.wall)

    @property
    def inertia(self) -> float:
        """Second moment of area [m⁴]: π/4 (Ro⁴ - Ri⁴)."""
        return math.pi / 4 * (self.outer_radius**4 - self.inner_radius**4)

    @property
    def modulus(self) -> float:
        """Section modulus [m³]: bending stress = M / W; twice the value for torsion."""
        return self.inertia / self.outer_radius

    def mass(self, density: float = 7850.0) -> float:
        """Mass per length [kg/m]."""
        return density * self.area


_HOT = {
    21.3: (2.6, 3.2), 26.9: (2.6, 3.2), 33.7: (2.6, 3.2, 4), 42.4: (2.6, 3.2, 4), 48.3: (2.6, 3.2, 4, 5),
    60.3: (2.6, 3.2, 4, 5), 76.1: (2.6, 3.2, 4, 5), 88.9: (3.2, 4, 5, 6, 6.3), 101.6: (3.2, 4, 5, 6, 6.3, 8, 10),
    114.3: (3.2, 4, 5, 6, 6.3, 8, 10), 139.7: (4, 5, 6, 6.3, 8, 10, 12, 12.5),
    168.3: (4, 5, 6, 6.3, 8, 10, 12, 12.5), 177.8: (5, 6, 6.3, 8, 10, 12, 12.5),
    193.7: (5, 6, 6.3, 8, 10, 12, 12.5, 16), 219.1: (5, 6, 6.3, 8, 10, 12, 12.5, 16, 20),
    244.5: (5, 6, 6.3, 8, 10, 12, 12.5, 16, 20), 273.0: (5, 6, 6.3, 8, 10, 12, 12.5, 16, 20),
    323.9: (5, 6, 6.3, 8, 10, 12, 12.5, 16, 20), 355.6: (6, 6.3, 8, 10, 12, 12.5, 16, 20),
    406.4: (6, 6.3, 8, 10, 12, 12.5, 16, 20), 457.0: (6, 6.3, 8, 10, 12, 12.5, 16, 20),
    508.0: (6, 6.3, 8, 10, 12, 12.5, 16, 20),
}  # fmt: skip
_PRECISION = {
    20: (2, 3), 25: (2, 2.5, 3), 30: (2, 3, 4), 35: (2, 3, 4), 40: (2, 3, 4, 5), 50: (2, 3, 4, 5), 60: (3, 4, 5),
    70: (3, 5, 8), 80: (3, 5, 8), 90: (5, 8), 100: (5, 8, 10), 110: (5, 8, 10), 120: (5, 8, 10), 130: (5, 8, 10),
    140: (5, 8, 10), 150: (5, 8, 10), 160: (5, 8, 10), 180: (8, 10), 200: (8, 10),
}  # fmt: skip

TUBES: dict[str, Tube] = {
    tube.name: tube
    for standard, sizes in (("EN 10210-2", _HOT), ("EN 10305-1", _PRECISION))
    for outer, walls in sizes.items()
    for tube in (Tube(outer * mm, wall * mm, standard) for wall in walls)
}
"""Stock sizes by name."""

CUT = 0.25 * mm
"""Least depth to which the end of a tube is bored for a spigot [m]; assumed by this project: EN 10305-1 allows the bore
of a tube some tenths of a millimetre, which such a cut evens out."""


def turned_bore(inner: float) -> float:
    """Radius to which the end of a tube of an inner radius [m] is bored: its diameter in whole millimetres.

    >>> turned_bore(0.065)
    0.0655
    """
    return math.ceil(2 * (inner + CUT) / mm - 1e-9) * mm / 2


_WRITTEN = re.compile(
    r"\s*+([0-9]+(?:\.[0-9]+)?)\s*+(?:mm\s*+)?[x×*]\s*+([0-9]+(?:\.[0-9]+)?)\s*+(?:mm\s*+)?$", re.IGNORECASE
)


def find_tube(name: str) -> Tube:
    """The tube of a name, outer diameter x wall in mm. Raises ParameterError with the nearest one for an unknown size.

    >>> find_tube("139.7 x 5 mm").name
    '139.7x5'
    """
    match = _WRITTEN.match(name)
    if match is None:
        raise ParameterError(
            f"{name!r} is no tube", allowed="outer diameter x wall in millimetres", do="write it like 140x5"
        )
    outer, wall = float(match[1]) * mm, float(match[2]) * mm
    nearest = min(TUBES.values(), key=lambda tube: _size_difference(tube, outer, wall))
    if _size_difference(nearest, outer, wall) > 1e-6:
        raise ParameterError(
            f"no tube {name.strip()!r} in the table",
            allowed=f"the nearest offered is {nearest.name!r}",
            do=f"use it, or one of the {len(TUBES)} others",
        )
    return nearest


def _size_difference(tube: Tube, outer: float, wall: float) -> float:
    """Relative difference of a size from a stock tube's; the diameter has weight 2, the wall 1."""
    return 2 * abs(outer / tube.outer - 1) + abs(wall / tube.wall - 1)
