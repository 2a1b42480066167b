"""What a report asks of a design beyond the design itself, reckoned once."""

from dataclasses import dataclass

from ilmek.machines.shedding.design import SheddingDesign
from ilmek.machines.shedding.draped import bridged, draped
from ilmek.machines.shedding.phases import Shed, flattest, shed_of
from ilmek.weaving.draping import Bridges, DrapedWarp


@dataclass(frozen=True, slots=True)
class SheddingAlternatives:
    """A design, its cams all at once and as flat as may be, its warps as yarns on the cams."""

    design: SheddingDesign
    together: Shed
    flattest: Shed
    yarn: DrapedWarp | None
    bridged: Bridges | None


def study(design: SheddingDesign) -> SheddingAlternatives:
    """The study of a design."""
    params, even = design.params, design.even
    flat = design.shed if params.phase == "flattest" else flattest(params, even)
    return SheddingAlternatives(design, shed_of(params, even), flat, draped(params, design.cam), bridged(design.cam))
