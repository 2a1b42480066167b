"""Materials: properties for calculations, and their sources.

    σH = A HV + B                                                           [ISO 6336-5:2003, table 1, quality MQ]

σH is the allowed Hertz pressure for infinite life of gears, cams and rollers. The fatigue limit is that of a polished
bar in reversed bending, a share of the tensile strength: 0.45 for steel (0.40 case-hardened or stainless), 0.34 for
nodular and 0.30 for grey cast iron and aluminium [FKM guideline, table 4.2.1]; of POM 0.40, about 25 MPa for 10^7
cycles by makers' design guides.

>>> MATERIALS["structural steel"].modulus
210000000000.0
"""

from dataclasses import dataclass

from ilmek.elements.catalogue import pick
from ilmek.units import GPa, MPa

GRAVITY = 9.81
"""Acceleration of gravity [m/s^2], as used in machine design (standard gravity is 9.80665)."""


@dataclass(frozen=True, slots=True)
class Hardening:
    """How a surface is hardened: ISO 15787.

    kind  SHD: by induction; CHD: case-hardened; empty: all through
    hardness, more  least hardness of Rockwell C, and by how much it may be exceeded
    """

    kind: str
    hardness: int
    more: int


@dataclass(frozen=True, slots=True)
class Material:
    """A material, in SI.

    designation  as ordered, with its standard
    modulus   Young's [Pa]      density  [kg/m^3]      strength  yield, of cast iron tensile [Pa]
    tensile   strength [Pa]     poisson  ratio         hardness  of its surface, Brinell below 400, else Vickers
    fatigue   limit in reversed bending [Pa]; hertz    allowed pressure for infinite life [Pa]; None: not known
    treatment  of a hardened surface; None: it is as delivered
    carbon     equivalent CEV of a steel that may be welded, most of its standard [EN 1011-2, C.1]; 0: not known
    """

    name: str
    modulus: float
    density: float
    strength: float
    source: str
    tensile: float
    poisson: float
    hardness: float
    fatigue: float | None
    hertz: float | None
    designation: str
    treatment: Hardening | None = None
    carbon: float = 0.0

    def __repr__(self) -> str:
        return f"<Material {self.name}>"

    @property
    def shear_modulus(self) -> float:
        """G = E / (2 + 2 ν) [Pa]."""
        return self.modulus / (2 + 2 * self.poisson)


def _material(
    name: str,
    designation: str,
    source: str,
    *,
    modulus: float,
    density: float,
    strength: float,
    tensile: float,
    hardness: float,
    fatigue: float | None = None,
    hertz: float | None = None,
    poisson: float = 0.3,
    treatment: Hardening | None = None,
    carbon: float = 0.0,
) -> Material:
    """From GPa, MPa; `fatigue` is a share of the tensile strength."""
    return Material(
        name,
        modulus * GPa,
        density,
        strength * MPa,
        source,
        tensile * MPa,
        poisson,
        hardness,
        None if fatigue is None else fatigue * tensile * MPa,
        None if hertz is None else hertz * MPa,
        designation,
        treatment,
        carbon,
    )


MATERIALS: dict[str, Material] = {
    material.name: material
    for material in (
        _material(
            "structural steel",
            "S235JR EN 10025-2",
            "EN 1993-1-1; up to 16 mm thick",
            modulus=210, density=7850, strength=235, tensile=360, hardness=110, fatigue=0.45, hertz=110 + 190,
            carbon=0.35,
        ),
        _material(
            "heat-treatable steel",
            "C45+QT EN 10083-2",
            "its standard, up to 16 mm (430 to 40 mm)",
            modulus=210, density=7850, strength=490, tensile=700, hardness=210, fatigue=0.45, hertz=0.925 * 210 + 360,
            carbon=0.63,
        ),
        _material(
            "alloy heat-treatable steel",
            "42CrMo4+QT EN 10083-3",
            "its standard, 16 to 40 mm",
            modulus=210, density=7850, strength=750, tensile=1000, hardness=310, fatigue=0.45, hertz=1.313 * 310 + 373,
            carbon=0.83,
        ),
        _material(
            "induction-hardened steel",
            "C45+QT EN 10083-2",
            "its standard; surface of 55 HRC",
            modulus=210, density=7850, strength=430, tensile=650, hardness=600, fatigue=0.45, hertz=0.541 * 600 + 882,
            treatment=Hardening("SHD", 55, 4), carbon=0.63,
        ),
        _material(
            "case-hardened steel",
            "16MnCr5 EN ISO 683-3",
            "its standard, core of a bar of 30 mm; surface of 60 HRC",
            modulus=210, density=7850, strength=590, tensile=780, hardness=700, fatigue=0.40, hertz=1500,
            treatment=Hardening("CHD", 60, 4), carbon=0.6,
        ),
        _material(
            "bearing steel",
            "100Cr6 EN ISO 683-17",
            "its standard, of 62 HRC: rollers and needles; pressure of ISO 281, 9.3.3",
            modulus=210, density=7830, strength=1700, tensile=2000, hardness=740, hertz=1500,
            treatment=Hardening("", 62, 4),
        ),
        _material(
            "stainless steel",
            "X5CrNi18-10 EN 10088-2",
            "EN 10088-1 and -2",
            modulus=200, density=7900, strength=210, tensile=520, hardness=170, fatigue=0.40,
        ),
        _material(
            "hard-drawn stainless steel",
            "X5CrNi18-10 EN 10217-7",
            "EN 10088-1; strengths of capillary tube are typical, assumed by this project",
            modulus=200, density=7900, strength=600, tensile=900, hardness=280, fatigue=0.40,
        ),
        _material(
            "grey cast iron",
            "EN-GJL-250 EN 1561",
            "its standard; modulus 103 to 118 GPa",
            modulus=110, density=7200, strength=250, tensile=250, hardness=200, fatigue=0.30, hertz=1.033 * 200 + 132,
            poisson=0.26,
        ),
        _material(
            "nodular cast iron",
            "EN-GJS-500-7 EN 1563",
            "its standard",
            modulus=169, density=7100, strength=320, tensile=500, hardness=190, fatigue=0.34, hertz=1.434 * 190 + 211,
            poisson=0.275,
        ),
        _material(
            "aluminium alloy",
            "EN AW-6082 T6 EN 755-2",
            "its standard, profiles up to 5 mm thick",
            modulus=70, density=2700, strength=250, tensile=290, hardness=95, fatigue=0.30, poisson=0.33,
        ),
        _material(
            "tin bronze",
            "CuSn12-C-GZ EN 1982",
            "its standard, centrifugally cast; pressure of DIN 3996",
            modulus=95, density=8700, strength=150, tensile=280, hardness=95, hertz=425, poisson=0.34,
        ),
        _material(
            "POM",
            "POM-C EN ISO 29988-1",
            "its standard, 23 C; pressure an estimate after VDI 2545, against steel, 60 C, 10^7 turns",
            modulus=2.7, density=1410, strength=63, tensile=63, hardness=15, fatigue=0.40, hertz=40, poisson=0.38,
        ),
    )
}  # fmt: skip
"""By name. Strengths are the least values of the standards for the given size; hardnesses are typical."""

BEECH, CARBON, NEODYMIUM = (
    _material(
        "beech",
        "beech EN 975-1",
        "DIN 68364, along the grain; strength in compression, tensile along the grain",
        modulus=14, density=720, strength=60, tensile=135, hardness=3.4, poisson=0.35,
    ),
    _material(
        "carbon fibre",
        "carbon fibre tube, pultruded",
        "pultruded tube, along its fibres: makers' data",
        modulus=120, density=1600, strength=1000, tensile=1200, hardness=50,
    ),
    _material(
        "neodymium magnet",
        "Nd-Fe-B N42, sintered",
        "sintered Nd-Fe-B of grade N42: makers' data; it is brittle",
        modulus=160, density=7500, strength=80, tensile=80, hardness=570, poisson=0.24,
    ),
)  # fmt: skip
"""Of shuttles, rapiers and their magnets; no choice for other parts."""


def find_material(name: str) -> Material:
    """The material of a name. Raises ParameterError with the nearest name for an unknown one.

    >>> find_material("Tin-bronze").hertz
    425000000.0
    """
    return pick(MATERIALS, name, "material")


def hertz_limit(first: Material, second: Material, safety: float = 1.0) -> float | None:
    """Allowed Hertz pressure [Pa] of the weaker of two surfaces for infinite life, over a safety; None: not known."""
    known = [material.hertz for material in (first, second) if material.hertz is not None]
    return min(known) / safety if len(known) == 2 else None
