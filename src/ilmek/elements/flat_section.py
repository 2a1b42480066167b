"""Flat bars as links: section, stress with and without a pin hole, notch of the hole, endurance, buckling.

    A = (w - d) b,   W = b (w³ - d³) / (6 w),   I = b w³ / 12 in the plane, w b³ / 12 out of it

w width in the plane of motion, b thickness, d diameter of a hole in the middle of the width [m].
                                                                  [Roloff/Matek, Machine Elements, chapter 3 and table]

>>> bar = FlatSection(0.04, 0.012, 0.012)
>>> round(bar.net_area * 1e6, 3), round(bar.net_modulus * 1e9, 3)
(336.0, 3113.6)
"""

import math
from dataclasses import dataclass

from ilmek.elements.fatigue import RELIABILITY, notch_factor, size_factor, surface_factor
from ilmek.elements.materials import Material
from ilmek.errors import ParameterError

CAST_IRON_NOTCH = 0.20
"""Notch sensitivity q of all grades of cast iron [Shigley, 6-10]."""

SURFACE = "machined"
TRUSTED = 0.99
"""Surface and reliability of the endurance limit; assumed by this project."""


@dataclass(frozen=True, slots=True)
class FlatSection:
    """A flat bar: width in the plane of motion, thickness across it, diameter of the pin holes [m].

    Raises ParameterError unless width and thickness are above 0 and the hole is narrower than the bar.
    """

    width: float
    thickness: float
    hole: float = 0.0

    def __post_init__(self) -> None:
        sound = self.width > 0 and self.thickness > 0 and 0 <= self.hole < self.width
        if not (sound and math.isfinite(self.width * self.thickness)):
            raise ParameterError(
                f"a flat bar of {self.width:g} m by {self.thickness:g} m with a hole of {self.hole:g} m",
                allowed="width and thickness above 0, the hole narrower than the width",
            )

    @property
    def area(self) -> float:
        """Area without a hole [m²]."""
        return self.width * self.thickness

    @property
    def net_area(self) -> float:
        """Area through the hole [m²]."""
        return (self.width - self.hole) * self.thickness

    @property
    def modulus(self) -> float:
        """Section modulus for bending in the plane, without a hole [m³]."""
        return self.thickness * self.width**2 / 6

    @property
    def net_modulus(self) -> float:
        """Section modulus through the hole [m³]."""
        return self.thickness * (self.width**3 - self.hole**3) / (6 * self.width)

    @property
    def inertia(self) -> float:
        """Second moment of area for bending in the plane [m⁴]."""
        return self.thickness * self.width**3 / 12

    @property
    def least_inertia(self) -> float:
        """The smaller second moment of area, in or out of the plane [m⁴]."""
        return min(self.thickness * self.width**3, self.width * self.thickness**3) / 12

    def line_mass(self, density: float) -> float:
        """Mass per length [kg/m] of a density [kg/m³]."""
        return self.area * density


def hole_concentration(section: FlatSection) -> float:
    """Stress concentration Kt [1] of a pin-loaded hole, a polynomial of r = d / w, for the stress in the net area.

    1 without a hole. The fit holds for r = 0.15 to 0.75; outside it the value of the nearer end.
                           [Roark's Formulas for Stress and Strain, 7th ed., table 17.1, hole with a close-fitting pin]

    >>> round(hole_concentration(FlatSection(0.04, 0.01, 0.016)), 2)
    2.85
    """
    if section.hole <= 0:
        return 1.0
    ratio = min(max(section.hole / section.width, 0.15), 0.75)
    return 12.882 - 52.714 * ratio + 89.762 * ratio**2 - 51.667 * ratio**3


def hole_notch(section: FlatSection, material: Material) -> float:
    """Fatigue notch factor Kf [1] of the pin hole; cast iron with its constant notch sensitivity [Shigley, 6-10]."""
    concentration = hole_concentration(section)
    if concentration == 1.0:
        return 1.0
    if "cast iron" in material.name:
        return 1 + CAST_IRON_NOTCH * (concentration - 1)
    return notch_factor(concentration, section.hole / 2, min(material.tensile, 1500e6))


def flat_endurance(section: FlatSection, material: Material) -> float:
    """Endurance limit [Pa] of a flat bar in reversed bending: ka kb ke times the material's fatigue limit.

    kb is that of the round bar with equal stressed volume, 0.808 sqrt(w b) [Shigley, 6-20, 6-25]; the cast surface of
    iron is in its fatigue limit (ka = 1). Raises ParameterError for a material without a known fatigue limit.
    """
    if material.fatigue is None:
        raise ParameterError(f"no fatigue limit is known for {material.name}", do="choose another material")
    surface = 1.0 if "cast iron" in material.name else surface_factor(material.tensile, SURFACE)
    return surface * size_factor(0.808 * math.sqrt(section.area)) * RELIABILITY[TRUSTED] * material.fatigue


def euler_load(length: float, second_moment: float, modulus: float) -> float:
    """Euler's buckling load [N] of a bar with hinged ends: π² E I / l²; l [m], I [m⁴], E [Pa].

    >>> round(euler_load(1.0, 1e-8, 210e9), 1)
    20726.2
    """
    return math.pi**2 * modulus * second_moment / length**2
