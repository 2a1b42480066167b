"""Parameters of the shed that is opened by hand; the defaults are the thesis' warps."""

from dataclasses import dataclass
from itertools import pairwise

from ilmek.errors import ParameterError
from ilmek.machines.weaver_hands import WeaverHands
from ilmek.params import Params, kind, nested
from ilmek.units import deg, format_quantity, mm
from ilmek.weaving.cloth import Cloth


@dataclass(frozen=True, slots=True)
class HandShedParams(Params):
    """Warps, opening, heights of rod and heddles, and limits; sizes of the thesis' Figure 3.13 are not printed."""

    cloth: Cloth = nested(Cloth, doc="warps, their tension and yarn")
    hands: WeaverHands = nested(WeaverHands, doc="forces and speeds of the hands")
    weavers: int = kind.count(1, at_least=1, at_most=100, doc="weavers who sit beside each other")
    opening: float = kind.length(
        20 * mm, at_least=1 * mm, at_most=0.2, doc="opening of the shed for the weft's bobbin; assumed", symbol="s"
    )
    weft_height: float = kind.length(
        320 * mm, at_least=10 * mm, at_most=2.0, doc="weft above the fell as it is passed; assumed", symbol="hw"
    )
    heddle_height: float = kind.length(
        360 * mm, at_least=10 * mm, at_most=2.0, doc="strings of the heddles above the fell; assumed", symbol="hg"
    )
    rod_low: float = kind.length(
        410 * mm, at_least=10 * mm, at_most=3.0, doc="shed rod above the fell, pulled down; assumed", symbol="yl"
    )
    rod_high: float = kind.length(
        950 * mm, at_least=20 * mm, at_most=5.0, doc="shed rod above the fell, pushed up; assumed", symbol="yh"
    )
    free_length: float = kind.length(
        1.3, unit="m", at_least=50 * mm, at_most=10.0, doc="warp from the fell to the upper cylinder", symbol="H"
    )
    arm: float | None = kind.length(
        None,
        at_least=20 * mm,
        at_most=0.5,
        doc="from the pivot of the heddle bar to its axis; default: 80 mm, or less where the longest lever needs it",
        symbol="r",
    )
    lever_limit: float = kind.length(0.6, unit="m", at_least=0.1, at_most=2.0, doc="longest lever; assumed")
    lever_tilt: float = kind.angle(
        35 * deg,
        at_least=0.0,
        at_most=120 * deg,
        doc="from the bar's arm to its lever, to the front: hands pull a steep one, lift a level one; assumed",
    )
    rod_sag: float = kind.length(25 * mm, at_least=1e-6, at_most=0.1, doc="allowed sag of the shed rod; assumed")
    bar_sag: float = kind.ratio(
        0.0015, at_least=1e-6, at_most=0.1, doc="allowed sag of the heddle bar over its length; assumed"
    )
    safety: float = kind.ratio(2.0, at_least=1.0, at_most=20.0, doc="yield over a stress at least; assumed")
    string_strength: float = kind.force(
        60.0, at_least=0.1, at_most=1e4, doc="breaking force of a string heddle, cotton twine of 1 mm; assumed"
    )
    clearance: float = kind.length(2 * mm, at_least=0.0, at_most=0.1, doc="least distance of what moves from the warps")

    @property
    def hand_limit(self) -> float:
        """Force of a hand along the way of a lever [N]: it pulls a lever that hangs, lifts one that lies."""
        return self.hands.pull if self.lever_tilt <= 45 * deg else self.hands.lift

    def check_together(self) -> None:
        """Raise ParameterError where the heights are not in their order from the fell up."""
        given = (self.weft_height, self.heddle_height, self.rod_low, self.rod_high, self.free_length)
        if any(low >= high for low, high in pairwise(given)):
            shown = ", ".join(format_quantity(height, "mm") for height in given)
            order = "weft_height below heddle_height, rod_low, rod_high and free_length"
            raise ParameterError(f"heights {shown}", allowed=order, do="set them in this order")
