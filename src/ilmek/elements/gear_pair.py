"""Two spur gears in mesh: distance, contact ratio, clearance; bending and Hertz pressure of their teeth.

    inv αw = inv α + 2 (x1 + x2) tan α / (z1 + z2),   a = m (z1 + z2) cos α / (2 cos αw)
    ε = (sqrt(ra1² - rb1²) + sqrt(ra2² - rb2²) - a sin αw) / (π m cos α)
    σF = F / (b m Y),   σH = sqrt(Fn / (π b) (1 / ρ1 + 1 / ρ2) / ((1 - ν1²) / E1 + (1 - ν2²) / E2))

Fn along the line of action, ρ radii of curvature at the pitch point, Y Lewis' form factor (`gears`). σH is ISO 6336-2's
nominal stress at the pitch point; its factors of application, speed, load distribution and overlap are 1.
                                                                [ISO 21771; Lewis; ISO 6336-2, eq. 4 with Zε = 1]
"""

import math
from dataclasses import dataclass

from ilmek.elements.gears import lewis
from ilmek.elements.involute import Gear, involute, involute_angle
from ilmek.elements.materials import Material
from ilmek.errors import ParameterError
from ilmek.plane.teeth import PRESSURE_ANGLE


@dataclass(frozen=True, slots=True)
class GearPair:
    """Two outer gears of one module and a common width [m], without backlash.

    >>> pair = GearPair(Gear(0.002, 20), Gear(0.002, 40), 0.02)
    >>> round(pair.distance, 6), round(pair.contact_ratio, 4), pair.ratio
    (0.06, 1.6352, 2.0)
    """

    first: Gear
    second: Gear
    width: float

    def __post_init__(self) -> None:
        if self.first.module != self.second.module:
            raise ParameterError(
                f"gears of modules {self.first.module:g} and {self.second.module:g} m", allowed="one module in a pair"
            )

    @property
    def ratio(self) -> float:
        """Turns of the first for one of the second."""
        return self.second.teeth / self.first.teeth

    @property
    def pressure_angle(self) -> float:
        """Working pressure angle αw [rad]."""
        both = self.first.teeth + self.second.teeth
        shift = self.first.shift + self.second.shift
        return involute_angle(involute(PRESSURE_ANGLE) + 2 * shift * math.tan(PRESSURE_ANGLE) / both)

    @property
    def distance(self) -> float:
        """Distance of the axes [m]."""
        standard = self.first.pitch_radius + self.second.pitch_radius
        return standard * math.cos(PRESSURE_ANGLE) / math.cos(self.pressure_angle)

    @property
    def tip_radii(self) -> tuple[float, float]:
        """Tip radii [m], shortened to keep a root clearance of a quarter of the module."""
        module = self.first.module
        full = self.first.pitch_radius + self.second.pitch_radius + module * (self.first.shift + self.second.shift)
        return self.first.tip_radius + self.distance - full, self.second.tip_radius + self.distance - full

    @property
    def contact_ratio(self) -> float:
        """Mean number of teeth in contact ε: 1.1 or more for smooth running."""
        return self._contact_length / (math.pi * self.first.module * math.cos(PRESSURE_ANGLE))

    @property
    def rolling_radii(self) -> tuple[float, float]:
        """Radii of the operating pitch circles [m]."""
        first = self.distance / (1 + self.ratio)
        return first, self.distance - first

    def force(self, torque: float) -> float:
        """Force along the operating pitch circles [N] of a torque on the first gear [N m]."""
        return abs(torque) / self.rolling_radii[0]

    def bending(self, torque: float) -> float:
        """Bending stress at the root [Pa] of the gear with fewer teeth, with the whole load at one tooth's tip.

        torque  on the first gear [N m]
        """
        form = lewis(min(self.first.teeth, self.second.teeth))
        return self.force(torque) / (self.width * self.first.module * form)

    def pressure(self, torque: float, first: Material, second: Material) -> float:
        """Hertz pressure σH at the pitch point [Pa] for a torque on the first gear [N m] and both materials."""
        angle = self.pressure_angle
        curved = sum(1 / (radius * math.sin(angle)) for radius in self.rolling_radii)
        yielding = sum((1 - each.poisson**2) / each.modulus for each in (first, second))
        return math.sqrt(self.force(torque) / math.cos(angle) * curved / (math.pi * self.width * yielding))

    @property
    def _reaches(self) -> tuple[float, float]:
        """Distances along the line of action from the base circles to the tips [m]."""
        first, second = self.tip_radii
        return _leg(first, self.first.base_radius), _leg(second, self.second.base_radius)

    @property
    def _contact_length(self) -> float:
        return sum(self._reaches) - self.distance * math.sin(self.pressure_angle)


def pair_at(distance: float, module: float, teeth: tuple[int, int], width: float, share: float = 0.5) -> GearPair:
    """The pair with profile shifts for a distance of axes [m].

    module, width  [m]      share  of the sum of shifts on the first gear
    Raises ParameterError for a distance below that of the base circles.
    >>> round(pair_at(0.061, 0.002, (20, 40), 0.02).distance, 9)
    0.061
    """
    both = sum(teeth)
    cosine = module * both * math.cos(PRESSURE_ANGLE) / (2 * distance)
    if cosine >= 1:
        raise ParameterError(
            f"axes {distance:g} m apart for {teeth[0]} and {teeth[1]} teeth of module {module:g} m",
            allowed=f"more than {cosine * distance:.6g} m",
            do="move the axes apart, or use fewer teeth or a finer module",
        )
    shift = both * (involute(math.acos(cosine)) - involute(PRESSURE_ANGLE)) / (2 * math.tan(PRESSURE_ANGLE))
    first, second = (Gear(module, number, part * shift) for number, part in zip(teeth, (share, 1 - share), strict=True))
    return GearPair(first, second, width)


def _leg(hypotenuse: float, other: float) -> float:
    return math.sqrt(hypotenuse**2 - other**2)
