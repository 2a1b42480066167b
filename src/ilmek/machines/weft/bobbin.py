"""Bobbins of weft: what is wound on them.

    L = phi l (D² - d²) / w²        volume of the winding pi (D² - d²) l / 4, the share phi of it yarn of pi w² / 4

D diameter, d core, l length of the winding, w diameter of the yarn.                          [derived from the volumes]
"""

import math
from dataclasses import dataclass

from ilmek.carpet.ground import WeftLengths
from ilmek.elements.carpet_yarns import YarnProperties
from ilmek.machines.weft.params import WeftParams
from ilmek.units import format_quantity, mm

DIAMETERS = tuple(size * mm for size in (8, 10, 12, 16, 20, 25, 32, 40, 50, 63))
"""Diameters of full bobbins [m]; preferred numbers R10."""

CORE = 0.4
"""Core of a bobbin over its diameter; assumed by this project, as usual of pirns."""

SLENDERNESS = (8.0, 12.0, 16.0)
"""Lengths of bobbins over their diameter; assumed by this project, as usual of pirns."""


@dataclass(frozen=True, slots=True)
class BobbinSize:
    """A full bobbin: diameter, core and length of the winding [m]."""

    diameter: float
    core: float
    length: float

    @property
    def name(self) -> str:
        """Diameter and length as a text."""
        return f"{format_quantity(self.diameter, 'mm')} x {format_quantity(self.length, 'mm')}"

    def capacity(self, yarn: YarnProperties, packing: float) -> float:
        """Length of a yarn on it [m].

        >>> from ilmek.elements.carpet_yarns import usual_warp
        >>> round(BobbinSize(25e-3, 10e-3, 125e-3).capacity(usual_warp(2e-3), 0.65), 1)
        47.7
        """
        return packing * self.length * (self.diameter**2 - self.core**2) / yarn.diameter**2


def bobbin_sizes(params: WeftParams) -> tuple[BobbinSize, ...]:
    """The bobbins that may be chosen, the smallest first: with given sizes, or those of the table."""
    given, long = params.bobbin_diameter, params.bobbin_length
    sizes = (
        BobbinSize(diameter, CORE * diameter, long or ratio * diameter)
        for diameter in ((given,) if given else DIAMETERS)
        for ratio in (SLENDERNESS[:1] if long or given else SLENDERNESS)
    )
    return tuple(sorted(sizes, key=lambda one: (one.diameter**2 * one.length, one.diameter)))


def stock_sizes() -> tuple[BobbinSize, ...]:
    """The shortest bobbin of each diameter of the table."""
    return tuple(BobbinSize(diameter, CORE * diameter, SLENDERNESS[0] * diameter) for diameter in DIAMETERS)


@dataclass(frozen=True, slots=True)
class Winding:
    """A weft on its bobbin: lengths of the full bobbin and for a row [m], rows that it lasts, mass [kg]."""

    name: str
    capacity: float
    a_row: float
    rows: int
    mass: float


def windings(params: WeftParams, size: BobbinSize, lengths: WeftLengths) -> tuple[Winding, Winding]:
    """The straight and the sinuous weft, each on a bobbin of its own."""
    yarns = params.cloth.carpet_yarns
    return (
        _winding("straight weft", yarns.straight_weft, params, size, lengths.straight),
        _winding("sinuous weft", yarns.sinuous_weft, params, size, lengths.sinuous),
    )


def _winding(name: str, yarn: YarnProperties, params: WeftParams, size: BobbinSize, a_row: float) -> Winding:
    length = size.capacity(yarn, params.packing)
    rows = max(0, math.floor((length - params.reserve) / a_row))
    return Winding(name, length, a_row, rows, length * yarn.linear_density)
