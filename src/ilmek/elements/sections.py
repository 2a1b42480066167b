"""Sections of shafts: round, tube and square; stress of bending and torsion together, twist.

    σ = M / W,   τ = T / Wt,   σv = sqrt(σ² + 3 τ²),   φ = T l / (G J)                [von Mises; Shigley, 5-5, 3-12]

>>> section = round_section(0.04)
>>> round(float(section.equivalent_stress(100.0, 0.0)) / 1e6, 3)
15.915
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.elements.shafts import SQUARE_SHEAR, SQUARE_TORSION
from ilmek.errors import ParameterError


@dataclass(frozen=True, slots=True)
class Section:
    """A section.

    area  [m²]      inertia  second moment of area [m⁴]      torsion  J of Saint-Venant [m⁴]
    bending_modulus W and torsion_modulus Wt [m³]
    corner  stress over the diagonal in W: sqrt 2 of a square, 1 of a round one
    size    diameter of the round bar with equal fatigue in reversed bending [m] [Shigley, 6-23 to 6-25]
    """

    area: float
    inertia: float
    torsion: float
    bending_modulus: float
    torsion_modulus: float
    corner: float
    size: float

    def equivalent_stress(self, moment: RealField, torque: RealField, *, turning: bool = False) -> FloatArray:
        """Stress [Pa] of a moment and a torque [N m] together.

        turning  the section rotates under the moment: then the corner of a square, without torsion, has sqrt 2 σ too
        """
        bending = np.abs(moment) / self.bending_modulus
        shear = np.abs(torque) / self.torsion_modulus
        both = np.sqrt(bending**2 + 3 * shear**2)
        return np.asarray(np.maximum(both, self.corner * bending) if turning else both)

    def twist(self, torque: RealField, length: RealField, shear_modulus: float) -> FloatArray:
        """Twist T l / (G J) [rad] of a length [m] under a constant torque [N m]; half of it if evenly distributed."""
        return np.asarray(np.multiply(torque, length) / (shear_modulus * self.torsion))


def round_section(diameter: float, bore: float = 0.0) -> Section:
    """A round bar [m], or a tube with a bore; W = π (D⁴ - d⁴) / 32 D.

    Raises ParameterError for a bore that is not less than the diameter.
    """
    if not 0 <= bore < diameter:
        raise ParameterError(f"a bore of {bore:g} m in a bar of {diameter:g} m", allowed="less than the diameter")
    polar = math.pi * (diameter**4 - bore**4) / 32
    area = math.pi * (diameter**2 - bore**2) / 4
    return Section(area, polar / 2, polar, polar / diameter, 2 * polar / diameter, 1.0, diameter)


def square_section(side: float) -> Section:
    """A square bar [m]; W = B³ / 6, J and Wt by Saint-Venant's series (`shafts`)."""
    torsion, shear = SQUARE_TORSION * side**4, SQUARE_SHEAR * side**3
    return Section(side**2, side**4 / 12, torsion, side**3 / 6, shear, math.sqrt(2), 0.808 * side)
