"""Parameters of the beat by hand; the defaults are the thesis' warps."""

from dataclasses import dataclass

from ilmek.errors import ParameterError
from ilmek.machines.weaver_hands import WeaverHands
from ilmek.params import Params, kind, nested
from ilmek.units import format_quantity, mm
from ilmek.weaving.cloth import Cloth


@dataclass(frozen=True, slots=True)
class HandBeatParams(Params):
    """Warps, comb, and the weaver's hands; sizes of a comb are assumed by this project."""

    cloth: Cloth = nested(Cloth, doc="warps, their tension and yarn, distance of the rows")
    hands: WeaverHands = nested(WeaverHands, doc="speeds and times of the hands")
    weavers: int = kind.count(1, at_least=1, at_most=100, doc="weavers who sit beside each other")
    warp_length: float = kind.length(
        1.3, unit="m", at_least=50 * mm, at_most=100.0, doc="warp from the fell to the upper cylinder"
    )
    comb_width: float = kind.length(100 * mm, at_least=10 * mm, at_most=0.5, doc="width of the comb; assumed")
    leaf: float | None = kind.length(
        None, at_least=0.05 * mm, at_most=20 * mm, doc="thickness of a leaf; default: six tenths of a gap of the warps"
    )
    reach: float = kind.length(30 * mm, at_least=5 * mm, at_most=0.2, doc="leaves before the head; assumed")
    leaf_height: float = kind.length(25 * mm, at_least=2 * mm, at_most=0.2, doc="height of a leaf; assumed")
    head_height: float = kind.length(25 * mm, at_least=2 * mm, at_most=0.2, doc="height of the comb's head; assumed")
    head_depth: float = kind.length(30 * mm, at_least=2 * mm, at_most=0.2, doc="depth of the comb's head; assumed")
    mass_limit: float = kind.mass(1.5, at_least=0.1, at_most=10.0, doc="comb in a hand at most; assumed")
    passes: int = kind.count(2, at_least=1, at_most=10, doc="wefts of a row, each beaten; assumed")
    most_blows: int = kind.count(4, at_least=1, at_most=100, doc="blows of a beat on a warp at most; assumed")

    def check_together(self) -> None:
        """Raise ParameterError for a comb narrower than two warps."""
        if self.comb_width < 2 * self.cloth.warp_pitch:
            given = f"comb_width={format_quantity(self.comb_width, 'mm')}"
            raise ParameterError(given, allowed="at least two warp pitches", do="set a wider comb")
