"""Yarn plan: what the user sets for the yarn of a carpet, and what follows from its quality."""

from dataclasses import dataclass

from ilmek.carpet.pile import PileParams
from ilmek.carpet.quality import Quality
from ilmek.params import Params, kind
from ilmek.units import mm


@dataclass(frozen=True, slots=True)
class YarnPlanParams(Params):
    """The yarn of a carpet: what is set, and what follows from the quality where it is left open."""

    pile_height: float = kind.length(8 * mm, at_least=0.0, at_most=100 * mm, doc="height of the cut pile")
    calibration: float = kind.ratio(
        1.0, above=0.0, at_most=10.0, doc="length of yarn per knot in your own carpets over the geometric length"
    )

    def pile(self, quality: Quality) -> PileParams:
        """The parameters of the pile at a quality."""
        del quality
        return PileParams(pile_height=self.pile_height, calibration=self.calibration)
