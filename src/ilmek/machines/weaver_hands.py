"""What a weaver's hands do on a loom: forces, speeds and times that every machine moved by hand is measured by.

Forces of one arm of a seated person, occasional, for professional use after EN 1005-3, table 1: 75 N inwards and
downwards, 50 N upwards; as they are commonly quoted, not compared with the standard, which has values of its own for
pulling towards the trunk. Times and speeds are assumed by this project.
"""

from dataclasses import dataclass

from ilmek.params import Params, kind
from ilmek.units import mm, rpm

HAND = "hand"
"""The weaver's hands in the place of a drive."""


@dataclass(frozen=True, slots=True)
class WeaverHands(Params):
    """Forces, speeds and reach of the hands."""

    pull: float = kind.force(
        75.0, at_least=1.0, at_most=1000.0, doc="force of a hand inwards or downwards; EN 1005-3, table 1, seated"
    )
    lift: float = kind.force(50.0, at_least=1.0, at_most=1000.0, doc="force of a hand upwards; EN 1005-3, table 1")
    crank_speed: float = kind.angular_speed(
        40 * rpm, at_least=1 * rpm, at_most=200 * rpm, doc="speed of a crank that is turned by hand; assumed"
    )
    blow_speed: float = kind.speed(
        3.0, at_least=0.1, at_most=15.0, doc="speed of a tool of some 1 kg as it strikes, from the elbow; assumed"
    )
    blow_time: float = kind.time(0.5, at_least=0.05, at_most=60.0, doc="time from blow to blow; assumed")
    weft_speed: float = kind.speed(
        0.15, at_least=1e-3, at_most=5.0, doc="speed of the weft's bobbin, passed from hand to hand; assumed"
    )
    weft_laid: float = kind.length(
        150 * mm,
        at_least=1 * mm,
        at_most=1.0,
        doc="weft over the fell that hands have laid, before a drive beats it: the paper's first position of the hand",
    )
    act_time: float = kind.time(
        4.0, at_least=0.1, at_most=600.0, doc="time to take a tool or a lever, move it and let it go; assumed"
    )
    advance: float = kind.length(
        150 * mm, at_least=5 * mm, at_most=1.0, doc="carpet woven before it is wound on; assumed"
    )

    def weft_time(self, width: float) -> float:
        """Time of a weft by hand [s] over a width [m]: passed from hand to hand, taken and put down."""
        return width / self.weft_speed + self.act_time


CRANK = 250 * mm
"""Radius of a crank [m]; assumed by this project."""
