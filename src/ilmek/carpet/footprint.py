"""Greenhouse gases of a carpet from cradle to the end of its weaving, approximate: of its yarns, and of energy.

    mass = Σ yarn · factor + energy · factor        [kg CO2e]

The factors are those of studies whose limits differ; of wool they reach from 2 to 30 kg/kg by the share that is given
to the sheep's meat; that of silk is an assumption, and its source says so. A producer who knows the figures of his own
yarns sets them.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

KWH = 3.6e6


class EmissionFactor(NamedTuple):
    """kg CO2e a unit, where it is from, and whether that is an assumption."""

    factor: float
    unit: str
    source: str
    assumed: bool = False


FACTORS: Mapping[str, EmissionFactor] = MappingProxyType(
    {
        "wool": EmissionFactor(5.48, "kg", "wool in carpets made in Europe, as cited by Wikipedia, Carbon footprint"),
        "cotton": EmissionFactor(5.9, "kg", "spun cotton, USA: Cherrett et al., Stockholm Environment Institute, 2005"),
        "silk": EmissionFactor(
            25.4,
            "kg",
            "assumption, confirmed by no open source; for raw silk compare Astudillo et al., Life cycle assessment "
            "of Indian silk, J. Cleaner Production, 2014",
            assumed=True,
        ),
        "electricity": EmissionFactor(
            0.481, "kWh", "mean of the world in 2023: Ember, Global Electricity Review, 2024"
        ),
    }
)


def emissions(masses: Mapping[str, float], energy: float) -> dict[str, float]:
    """Kg CO2e of the mass of each material [kg] and of an energy [J]; a material without a factor is left out.

    >>> found = emissions({"wool": 10.0, "jute": 1.0}, 3.6e6)
    >>> {name: round(mass, 3) for name, mass in found.items()}
    {'wool': 54.8, 'electricity': 0.481}
    """
    found = {name: mass * FACTORS[name].factor for name, mass in masses.items() if name in FACTORS}
    return {**found, "electricity": energy / KWH * FACTORS["electricity"].factor}
