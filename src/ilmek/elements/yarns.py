"""Yarns: properties of their materials, and the usual warps of a carpet.

A yarn of linear density mu [kg/m] has

    diameter         d  = sqrt(4 mu / (pi rho phi))      rho density of the fibre, phi packing: share of the section
                                                         that is fibre
    stiffness        EA = e mu                           force over strain; e specific stiffness
    breaking force   F  = f mu                           f specific strength

Specific quantities are in N m/kg: 1 N/tex = 1e6 N m/kg.    [derived from mu = phi rho pi d²/4 and Hooke's law by mass]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.units import g, mm


@dataclass(frozen=True, slots=True)
class YarnMaterial:
    """A material of yarns.

    density             of the fibre [kg/m³]
    packing             share of the yarn's section that is fibre
    specific_strength   breaking force over linear density [N m/kg]
    specific_stiffness  force over strain and linear density [N m/kg]
    """

    name: str
    density: float
    packing: float
    specific_strength: float
    specific_stiffness: float
    source: str

    def diameter(self, linear_density: float) -> float:
        """Diameter [m] of a yarn of a linear density [kg/m].

        >>> round(WOOL.diameter(0.8e-3) * 1e3, 3)
        1.314
        """
        return yarn_diameter(linear_density, self.density, self.packing)

    def stiffness(self, linear_density: float) -> float:
        """Force over strain EA [N] of a yarn of a linear density [kg/m].

        >>> round(COTTON.stiffness(857e-6), 1)
        1799.7
        """
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
    specific_stiffness=1.0e6,
    source="strength of the fibres: Morton and Hearle, Physical Properties of Textile Fibres; packing of a soft "
    "woollen yarn; stiffness, less than half of its fibres', assumed by this project",
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

SILK = YarnMaterial(
    name="silk",
    density=1340.0,
    packing=0.65,
    specific_strength=0.38e6,
    specific_stiffness=7.3e6,
    source="Morton and Hearle, Physical Properties of Textile Fibres: tenacity and initial modulus of the fibre; "
    "reeled silk runs on through the whole yarn; packing assumed by this project",
)
"""Reeled silk: warp and pile of the finest carpets."""

MATERIALS = {material.name: material for material in (COTTON, WOOL, SILK)}
"""The materials of yarns by name."""

WOOL_WARP_PER_PITCH = 3 / 7 * g / mm
"""Linear density of the usual woollen warp over the pitch of the warps [kg/m²]."""

_TEX = 590.5e-6
"""Linear density of a cotton strand of English count 1 [kg/m]."""

_COTTON_WARPS = (
    (15, 20, 24),
    (20, 20, 20),
    (25, 20, 18),
    (30, 20, 16),
    (40, 20, 12),
    (50, 20, 6),
    (60, 40, 6),
    (70, 40, 4),
)
"""Usual cotton warps: raj (knots in 7 cm), English count of a strand, strands [iran-carpet.com 1726, 1804]."""

_COTTON_PITCH, _COTTON_DENSITY = np.array(
    [(0.07 / (2 * raj), _TEX * ply / count) for raj, count, ply in reversed(_COTTON_WARPS)]
).T


def yarn_diameter(linear_density: float, density: float, packing: float) -> float:
    """Diameter of a round yarn [m]:  d = sqrt(4 mu / (pi rho phi)).

    linear_density  mu [kg/m]      density  rho of the fibre [kg/m³]      packing  phi, above 0 and at most 1
    """
    return math.sqrt(4 * linear_density / (math.pi * density * packing))


PRESSED_PACKING, FLATTENING = 0.65, 2.0
"""Packing of a yarn pressed between warps or jaws, where it is not denser by itself, and its width over its thickness
there: a flat section as of Kemp's race-track model; both values are assumed by this project."""


def pressed_thickness(
    linear_density: float, material: YarnMaterial, packing: float = PRESSED_PACKING, flattening: float = FLATTENING
) -> float:
    """Thickness of a yarn pressed flat [m]: the short axis of an ellipse, d / sqrt(flattening) at the pressed packing.

    linear_density  [kg/m]      packing  pressed; the material's own where that is denser
    flattening      width over thickness, at least 1

    >>> round(pressed_thickness(0.8e-3, WOOL) * 1e3, 3)
    0.773
    """
    return yarn_diameter(linear_density, material.density, max(packing, material.packing)) / math.sqrt(flattening)


def usual_warp_density(pitch: float, material: str = COTTON.name) -> float:
    """Linear density of the usual warp [kg/m] at a pitch of the warps [m], of a material of `MATERIALS`.

    Cotton: interpolated between the usual counts of 15 to 70 raj, and proportional to the pitch beyond them. Wool: 3/7
    g/m for each millimetre; the counts given for hand-knotted wool (Nm/ply 3/3, 4/3, 5/3, 6/3, 8/3 for 15, 20, 25, 30,
    40 raj) follow this law exactly. Silk: as thick as the usual cotton, by the sections of their fibres; assumed by
    this project.                                                                   [iran-carpet.com 1726, 1804]

    >>> round(usual_warp_density(0.07 / 80, "wool") * 1e3, 6)  # 40 raj: 40 knots in 7 cm, two warps a knot; 8/3
    0.375
    >>> round(usual_warp_density(0.07 / 80) * 1e3, 4)  # 20/12
    0.3543
    """
    if material == WOOL.name:
        return WOOL_WARP_PER_PITCH * pitch
    nearest = min(max(pitch, float(_COTTON_PITCH[0])), float(_COTTON_PITCH[-1]))
    cotton = float(np.interp(nearest, _COTTON_PITCH, _COTTON_DENSITY)) * pitch / nearest
    if material == SILK.name:
        return cotton * SILK.density * SILK.packing / (COTTON.density * COTTON.packing)
    return cotton
