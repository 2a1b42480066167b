"""Parameters of a hand loom: those of an automated loom, whose knots, shed and beat are the weavers'."""

from dataclasses import dataclass

from ilmek.machines.automated_loom.params import BEATS_BY_HAND, AutomatedLoomParams
from ilmek.machines.weaver_hands import HAND
from ilmek.params import param


@dataclass(frozen=True, slots=True)
class HandLoomParams(AutomatedLoomParams):
    """The carpet and the hands; what only a loom with drives has does not count."""

    knotting: str = param(HAND, choices=(HAND,), doc="what ties the knots: weavers by hand")
    shed: str = param(HAND, choices=(HAND,), doc="what opens the shed: rod and string heddles, by hand")
    beat: str = param(
        HAND, choices=BEATS_BY_HAND, doc="what beats the rows: a comb by hand, or a crank-rocker on its carriage"
    )
