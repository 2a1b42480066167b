"""Materials of carriers of the weft, which no machine element is made of."""

from ilmek.elements.materials import Material
from ilmek.units import GPa, MPa

BEECH = Material(
    "beech",
    modulus=14 * GPa,
    density=720.0,
    strength=60 * MPa,
    source="DIN 68364, along the grain; strength in compression, tensile along the grain",
    tensile=135 * MPa,
    poisson=0.35,
    hardness=3.4,
    fatigue=None,
    hertz=None,
)

CARBON = Material(
    "carbon fibre",
    modulus=120 * GPa,
    density=1600.0,
    strength=1000 * MPa,
    source="pultruded tube, along its fibres: makers' data",
    tensile=1200 * MPa,
    poisson=0.3,
    hardness=50.0,
    fatigue=None,
    hertz=None,
)

NEODYMIUM = Material(
    "neodymium magnet",
    modulus=160 * GPa,
    density=7500.0,
    strength=80 * MPa,
    source="sintered Nd-Fe-B of grade N42: makers' data; it is brittle",
    tensile=80 * MPa,
    poisson=0.24,
    hardness=570.0,
    fatigue=None,
    hertz=None,
)
