"""Parameters of the strength of links and pins, for every machine with links."""

from dataclasses import dataclass, replace

from ilmek.elements.materials import MATERIALS, Material
from ilmek.params import Params, kind
from ilmek.units import MPa, mm

STRESS_SAFETY = 1.5
"""Fatigue limit of the material over the allowed nominal stress of the links; assumed by this project."""

LINK_MATERIALS = tuple(name for name, one in MATERIALS.items() if one.fatigue is not None)


@dataclass(frozen=True, slots=True)
class StrengthParams(Params):
    """What links and pins bear; the defaults are for structural steel, in bushes of sintered bronze."""

    material: str = kind.choice("structural steel", LINK_MATERIALS, doc="material of the links")
    stress: float | None = kind.pressure(
        None,
        at_least=0.1 * MPa,
        at_most=1e10,
        doc="allowed nominal stress of the links; default: the material's fatigue limit over 1.5",
    )
    modulus: float | None = kind.pressure(
        None, unit="GPa", at_least=1 * MPa, at_most=2e12, doc="Young's modulus of the links; default: the material's"
    )
    fatigue: float = kind.ratio(
        1.5,
        at_least=1.0,
        at_most=100.0,
        doc="required safety of the links against fatigue, with the notch of the holes",
    )
    buckling: float = kind.ratio(3.0, at_least=1.0, at_most=100.0, doc="required safety of the links in buckling")
    resonance: float = kind.ratio(
        10.0,
        at_least=1.0,
        at_most=1000.0,
        doc="required ratio of the links' lowest natural frequency to the frequency of the crank",
    )
    pin_diameter: float | None = kind.length(
        None, at_least=0.5 * mm, at_most=1.0, doc="diameter of the pins; default: the least of stock that is enough"
    )
    pin_shear: float = kind.pressure(60 * MPa, at_least=0.1 * MPa, at_most=1e10, doc="allowed shear stress of the pins")
    pin_bending: float = kind.pressure(
        105 * MPa,
        at_least=0.1 * MPa,
        at_most=1e10,
        doc="allowed bending stress of the pins in their forks; 0.15 of the strength of C45 +QT",
    )
    pin_pressure: float = kind.pressure(
        15 * MPa, at_least=0.01 * MPa, at_most=1e10, doc="allowed pressure of a pin on its bush"
    )
    pin_wear: float = kind.ratio(
        1.0, at_least=1e-3, at_most=1e3, doc="allowed mean of pressure times sliding speed of a pin [MPa m/s]"
    )

    @property
    def of_links(self) -> Material:
        """The material of the links, with the given modulus."""
        material = MATERIALS[self.material]
        return material if self.modulus is None else replace(material, modulus=self.modulus)

    @property
    def allowed_stress(self) -> float:
        """Allowed nominal stress of the links [Pa]."""
        return self.stress or (MATERIALS[self.material].fatigue or 0.0) / STRESS_SAFETY
