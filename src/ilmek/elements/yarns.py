"""Yarns: properties of their materials, and the usual warp of a carpet.

A yarn of linear density mu [kg/m] has

    diameter         d  = sqrt(4 mu / (pi rho phi))      rho density of the fibre, phi packing: share of the section
                                                         that is fibre
    stiffness        EA = e mu                           force over strain; e specific stiffness
    breaking force   F  = f mu                           f specific strength

Specific quantities are in N m/kg: 1 N/tex = 1e6 N m/kg.    [derived from mu = phi rho pi d²/4 and Hooke's law by mass]
"""

import math
from dataclasses import dataclass

from ilmek.errors import ParameterError
from ilmek.units import g, mm


@dataclass(frozen=True, slots=True)
class YarnMaterial:
    """A material of yarns.

    density             of the fibre [kg/m³]
    packing             share of the yarn's section that is fibre
    specific_strength   breaking force over linear density [N m/kg]
    specific_stiffness  force over strain and linear density [N m/kg]; None: not known
    """

    name: str
    density: float
    packing: float
    specific_strength: float
    specific_stiffness: float | None
    source: str

    def diameter(self, linear_density: float) -> float:
        """Diameter [m] of a yarn of a linear density [kg/m].

        >>> round(WOOL.diameter(0.8e-3) * 1e3, 3)
        1.314
        """
        return yarn_diameter(linear_density, self.density, self.packing)

    def stiffness(self, linear_density: float) -> float:
        """Force over strain EA [N] of a yarn of a linear density [kg/m].

        Raises ParameterError for a material of unknown stiffness.

        >>> round(COTTON.stiffness(857e-6), 1)
        1799.7
        """
        if self.specific_stiffness is None:
            raise ParameterError(f"the stiffness of {self.name} yarn is not known", do="give the stiffness of the yarn")
        return self.specific_stiffness * linear_density

    def breaking_force(self, linear_density: float) -> float:
        """Breaking force [N] of a yarn of a linear density [kg/m].

        >>> round(COTTON.breaking_force(857e-6), 1)
        145.7
        """
        return self.specific_strength * linear_density


WOOL = YarnMaterial(
    name="wool",
    density=1310.0,
    packing=0.45,
    specific_strength=0.12e6,
    specific_stiffness=None,
    source="strength of the fibres: Morton and Hearle, Physical Properties of Textile Fibres; packing of a soft "
    "woollen yarn",
)
"""Soft woollen yarn: pile, warp and weft of a woollen ground. Strength of all its fibres together: 12 cN/tex."""

COTTON = YarnMaterial(
    name="cotton",
    density=1520.0,
    packing=0.6,
    specific_strength=0.17e6,
    specific_stiffness=2.1e6,
    source="Elmogahzy and Chewning 2001, in Handbook of Properties of Textile and Technical Fibres, table 7.3, "
    "ring-spun, carded, Ne 6 to 20; packing: Peirce, The geometry of cloth structure, 1937, 1.1 cm³/g",
)
"""Carded ring-spun cotton yarn: breaks at 17 cN/tex and 8 % strain, so that its specific stiffness is 2.1 N/tex."""

WARP_DENSITY_PER_PITCH = 3 / 7 * g / mm
"""Linear density of the usual warp over the pitch of the warps [kg/m²]."""


def yarn_diameter(linear_density: float, density: float, packing: float) -> float:
    """Diameter of a round yarn [m]:  d = sqrt(4 mu / (pi rho phi)).

    linear_density  mu [kg/m]      density  rho of the fibre [kg/m³]      packing  phi, above 0 and at most 1
    """
    return math.sqrt(4 * linear_density / (math.pi * density * packing))


def warp_density(pitch: float) -> float:
    """Linear density of the usual warp [kg/m] at a pitch of the warps [m]: 3/7 g/m for each millimetre.

    The counts given for hand-knotted wool (Nm/ply 3/3, 4/3, 5/3, 6/3, 8/3 for 15, 20, 25, 30, 40 raj) follow this law
    exactly.                                                                            [iran-carpet.com 1726, 1804]

    >>> round(warp_density(0.07 / 80) * 1e3, 6)  # 40 raj: 40 knots in 7 cm, two warps a knot; 8/3 = 0.375 g/m
    0.375
    """
    return WARP_DENSITY_PER_PITCH * pitch


def warp_diameter(pitch: float) -> float:
    """Diameter of the usual woollen warp [m] at a pitch of the warps [m].

    >>> round(warp_diameter(2e-3) * 1e3, 3)
    1.361
    """
    return WOOL.diameter(warp_density(pitch))


def warp_stiffness(pitch: float) -> float:
    """Force over strain EA [N] of a cotton warp of the usual linear density, at a pitch of the warps [m].

    >>> round(warp_stiffness(2e-3))
    1800
    """
    return COTTON.stiffness(warp_density(pitch))
