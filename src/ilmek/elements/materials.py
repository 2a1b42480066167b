"""Materials: what a calculation needs of them, and where it is written.

>>> MATERIALS["structural steel"].modulus
210000000000.0
"""

from dataclasses import dataclass

from ilmek.units import GPa, MPa

GRAVITY = 9.81
"""Acceleration of gravity [m/s^2], as machine design takes it (standard gravity is 9.80665)."""


@dataclass(frozen=True, slots=True)
class Material:
    """A material: Young's modulus [Pa], density [kg/m^3], strength [Pa] (yield; tensile for cast iron) and source."""

    name: str
    modulus: float
    density: float
    strength: float
    source: str


MATERIALS: dict[str, Material] = {
    material.name: material
    for material in (
        Material("structural steel", 210 * GPa, 7850.0, 235 * MPa, "EN 1993-1-1; EN 10025-2, S235 up to 16 mm thick"),
        Material(
            "heat-treatable steel", 210 * GPa, 7850.0, 490 * MPa, "EN 10083-2, C45 +QT up to 16 mm (430 to 40 mm)"
        ),
        Material("stainless steel", 200 * GPa, 7900.0, 210 * MPa, "EN 10088-1 and -2, 1.4301"),
        Material("grey cast iron", 110 * GPa, 7200.0, 250 * MPa, "EN 1561, EN-GJL-250; modulus 103 to 118 GPa"),
        Material("aluminium alloy", 70 * GPa, 2700.0, 250 * MPa, "EN 755-2, EN AW-6082 T6, profiles up to 5 mm thick"),
    )
}
