"""Ground: the warp and the two wefts of a row.

Every row of knots is held by a straight, thick weft (Turkish alt atkı), which goes nearly as the crow flies between the
two planes of warps, and a sinuous, thin one (üst atkı), which goes round every warp.

Default counts follow the density: the warp is the usual one of its pitch [`ilmek.elements.yarns`]. The straight weft is
taken as heavy as a warp and the sinuous one half as heavy; both are parameters.

Sources: warp counts and the rule `warps = 2 × knots across, length = carpet + up to 60 cm`, iran-carpet.com 1726, 1804;
the two wefts, haliciomer.com.tr.
"""

import math
from dataclasses import dataclass

import scipy

from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.elements.yarns import WOOL, warp_density
from ilmek.params import Params, param
from ilmek.units import mm


@dataclass(frozen=True, slots=True)
class GroundParams(Params):
    """Warp and wefts. A density left out follows the quality (see the module)."""

    fringe: float = param(0.10, unit="mm", at_least=0.0, at_most=1.0, doc="warp left at each end as fringe")
    loom_waste: float = param(0.40, unit="mm", at_least=0.0, at_most=10.0, doc="warp lost in the loom, both ends")
    selvedge_warps: int = param(8, at_least=0, at_most=200, doc="warps without knots, both edges together")
    warp_density: float | None = param(None, unit="g/m", above=0.0, at_most=0.05, doc="mass per length of a warp")
    straight_weft_density: float | None = param(
        None, unit="g/m", above=0.0, at_most=0.05, doc="mass per length of the straight weft"
    )
    sinuous_weft_density: float | None = param(
        None, unit="g/m", above=0.0, at_most=0.05, doc="mass per length of the sinuous weft"
    )
    weft_turn: float = param(20 * mm, unit="mm", at_least=0.0, at_most=0.5, doc="weft for the turn at the edge, a pick")
    weft_share: float = param(
        0.5, at_least=0.0, at_most=1.0, doc="share of the crossing that the sinuous weft bends, the warps bend the rest"
    )


@dataclass(frozen=True, slots=True)
class GroundYarn:
    """A ground yarn's need: name, length [m], mass [kg]."""

    name: str
    length: float
    mass: float


def sinuous_length(width: float, pitch: float, amplitude: float) -> float:
    """Length of a sinuous weft across `width` [m].

    Its axis is y = A sin(pi x / p), from one side of the warps (pitch p) to the other, so over one pitch

        s = (2/pi) sqrt(p² + pi² A²) E(m),   m = pi² A² / (p² + pi² A²),   E the complete elliptic integral.

    >>> sinuous_length(1.2, 2e-3, 0.0) == 1.2
    True
    """
    bend = (math.pi * amplitude) ** 2
    over_pitch = 2 / math.pi * math.sqrt(pitch**2 + bend) * float(scipy.special.ellipe(bend / (pitch**2 + bend)))
    return width * over_pitch / pitch


def warp_need(columns: int, length: float, density: float, params: GroundParams) -> GroundYarn:
    """Warp for `columns` knots across on a carpet `length` [m] long: two a knot and the selvedges, each as long as
    the carpet, both fringes and the loom's waste.
    """
    total = (2 * columns + params.selvedge_warps) * (length + 2 * params.fringe + params.loom_waste)
    return GroundYarn("warp", total, total * density)


def ground_yarns(
    size: CarpetSize, quality: Quality, rows: int, columns: int, params: GroundParams | None = None
) -> tuple[GroundYarn, GroundYarn, GroundYarn]:
    """Warp, straight weft and sinuous weft of a carpet of rows × columns knots.

    The sinuous weft's axis stands weft_share · (D + w)/2 from the plane of the warps where it passes one (D the warp's
    diameter, w its own); the rest of the way round is made by the warps, which it bends.
    """
    params = params or GroundParams()
    warp = params.warp_density or warp_density(quality.warp_pitch)
    straight = params.straight_weft_density or warp
    sinuous = params.sinuous_weft_density or warp / 2
    amplitude = params.weft_share * (WOOL.diameter(warp) + WOOL.diameter(sinuous)) / 2
    straight_length = rows * (size.width + params.weft_turn)
    winding = rows * (sinuous_length(size.width, quality.warp_pitch, amplitude) + params.weft_turn)
    return (
        warp_need(columns, size.length, warp, params),
        GroundYarn("straight weft", straight_length, straight_length * straight),
        GroundYarn("sinuous weft", winding, winding * sinuous),
    )
