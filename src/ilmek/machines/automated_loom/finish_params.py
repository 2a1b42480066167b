"""Washing of the carpet, and warping of the loom: rates that are assumed by this project, each with what is usual."""

from dataclasses import dataclass

from ilmek.params import Params, kind


@dataclass(frozen=True, slots=True)
class FinishParams(Params):
    """Washing of the carpet, and warping of the loom."""

    shrink_along: float = kind.ratio(
        0.01, unit="%", at_least=0.0, at_most=0.2, doc="shrinkage in washing along the warps; usual: 0 to 3 %"
    )
    shrink_across: float = kind.ratio(
        0.005, unit="%", at_least=0.0, at_most=0.2, doc="shrinkage in washing across; usual: 0 to 2 %"
    )
    wash_loss: float = kind.ratio(
        0.03, unit="%", at_least=0.0, at_most=0.3, doc="share of the mass that is washed out; usual: 1 to 6 %"
    )
    warp_set_up: float = kind.time(
        3600.0, unit="h", at_least=0.0, at_most=1e6, doc="preparing and tensioning of a warp; usual: 0.5 to 3 h"
    )
    warp_time: float = kind.time(12.0, at_least=0.0, at_most=3600.0, doc="drawing-in of a warp; usual: 5 to 20 s")
    warp_speed: float = kind.speed(1.0, at_least=1e-3, at_most=100.0, doc="winding of a warp; usual: 0.5 to 5 m/s")
