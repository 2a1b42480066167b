"""The cloth on a loom: its warps in a row, its yarns, the tension of the warps. Every machine that touches it holds it.

    w = n p        kp = 2 p        T = T0 m / m0     where none is given
w width, n warps, p warp pitch, kp knot pitch, T tension, m mass per length of a warp; T0 and m0 of `tension`.
"""

from dataclasses import dataclass
from typing import Any

from ilmek.elements.carpet_yarns import CarpetYarnParams, CarpetYarns, carpet_yarns
from ilmek.params import Params, kind, nested
from ilmek.units import mm
from ilmek.weaving.tension import usual_tension


def warp_pitch_of(default: float | None, doc: str = "distance of two warps") -> Any:
    """Declare the warp pitch of a cloth, or of a loom that derives it where it is left open."""
    return kind.length(default, at_least=0.01 * mm, at_most=50 * mm, doc=doc, symbol="p")


def warp_tension_of(default: float | None) -> Any:
    """Declare the tension of a warp of a cloth, or of a loom."""
    doc = "tension of a warp at rest; default: 15 N at a pitch of 2 mm, proportional to the warp's mass"
    return kind.force(default, at_least=1e-3, at_most=1e4, doc=doc, symbol="T")


@dataclass(frozen=True, slots=True)
class Cloth(Params):
    """The warps of a cloth, its rows, and its yarns; the defaults are the thesis' loom."""

    warp_pitch: float = warp_pitch_of(2 * mm)
    warps: int = kind.count(600, at_least=2, at_most=100_000, doc="all warps, selvedges included", symbol="n")
    row_pitch: float | None = kind.length(
        None, at_least=0.001 * mm, at_most=0.2, doc="distance of two rows of knots; default: that of two knots"
    )
    tension: float | None = warp_tension_of(None)
    yarns: CarpetYarnParams = nested(CarpetYarnParams, doc="materials and counts of warp, wefts and pile")

    @property
    def width(self) -> float:
        """Width of all warps [m]: w = n p."""
        return self.warps * self.warp_pitch

    @property
    def knot_pitch(self) -> float:
        """Distance of two neighbouring knots [m], each tied on two warps: kp = 2 p."""
        return 2 * self.warp_pitch

    @property
    def row_distance(self) -> float:
        """Distance of two rows of knots [m]: as given, or that of two knots."""
        return self.row_pitch or self.knot_pitch

    @property
    def carpet_yarns(self) -> CarpetYarns:
        """The yarns; what is left open is usual for the warp pitch."""
        return carpet_yarns(self.yarns, self.warp_pitch)

    @property
    def warp_tension(self) -> float:
        """Tension of a warp at rest [N]: as given, or usual for the warp's mass."""
        if self.tension is not None:
            return self.tension
        return usual_tension(self.warp_pitch, self.carpet_yarns.warp.linear_density)

    @property
    def warp_strain(self) -> float:
        """Elastic strain of the warps at rest [1]: T / EA."""
        return self.warp_tension / self.carpet_yarns.warp.stiffness

    @property
    def pull(self) -> float:
        """Pull of all warps at rest [N]: n T."""
        return self.warps * self.warp_tension
