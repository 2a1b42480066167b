"""What may be asked of a knotting dyad."""

from dataclasses import dataclass
from typing import Any

from ilmek.carpet.knot_path import KnotDimensions, KnotPath, knot_path
from ilmek.carpet.knot_word import knot
from ilmek.errors import CarpetError, ParameterError
from ilmek.machines.places import read_angles, read_points
from ilmek.params import Params, param
from ilmek.synthesis.burmester_forms import require_task
from ilmek.units import mm


def _length(default: float, doc: str, symbol: str = "", at_most: float = 50 * mm) -> Any:
    return param(default, unit="mm", at_least=0.01 * mm, at_most=at_most, doc=doc, symbol=symbol)


@dataclass(frozen=True, slots=True)
class KnottingDyadParams(Params):
    """What may be asked of a knotting dyad: a knot, or four timed points of one's own."""

    knot: str = param("symmetric", choices=("symmetric", "asymmetric"), doc="knot to tie")
    opens: str = param("left", choices=("left", "right"), doc="side on which an asymmetric knot is open")
    warp_pitch: float = _length(2 * mm, "distance between two warps", "p")
    warp_diameter: float = _length(0.8 * mm, "diameter of a warp", "D")
    yarn_diameter: float = _length(0.8 * mm, "diameter of the pile yarn", "d")
    clearance: float = param(
        0.0, unit="mm", at_least=0.0, at_most=50 * mm, doc="kept from the warps besides half the yarn", symbol="e"
    )
    leg: float = _length(10 * mm, "height above the warps to which an end is led", "a", at_most=0.5)
    points: str | None = param(
        None, doc="four points to go through instead of the knot's, like (12mm,4mm) (18.5mm,9.5mm) …"
    )
    angles: str | None = param(None, doc="angles of the first link at these points, like 20deg 65deg …", symbol="θ1")
    link_limit: float = _length(150 * mm, "longest link that the machine has room for", at_most=5.0)

    def check_together(self) -> None:
        """Points and angles go together, four of each; a knot has room between its warps."""
        if (self.points is None) != (self.angles is None):
            said, unsaid = ("points", "angles") if self.angles is None else ("angles", "points")
            raise ParameterError(f"{said} are given without {unsaid}", allowed="both, or neither", do=f"set {unsaid}")
        if self.points is None or self.angles is None:
            try:
                self.way()
            except CarpetError as error:
                raise ParameterError(error.given, allowed=error.allowed, do=error.do) from None
            return
        points, angles = read_points("points", self.points), read_angles("angles", self.angles)
        require_task("timed point", points, angles, 4, "knotting-dyad")

    def way(self) -> KnotPath:
        """The knot's way. Raises CarpetError where the warps leave the yarn no room."""
        size = KnotDimensions(self.warp_pitch, self.warp_diameter, self.yarn_diameter, self.clearance, self.leg)
        return knot_path(knot(self.knot, opens=self.opens), size)
