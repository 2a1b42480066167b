"""Parameters of the strength of a needle mechanism: links, pins, both shafts, their bearings."""

from dataclasses import dataclass

from ilmek.machines.strength_params import StrengthParams
from ilmek.params import kind
from ilmek.units import hour, mm


@dataclass(frozen=True, slots=True)
class NeedleStrengthParams(StrengthParams):
    """What links, pins and shafts bear: links of structural steel, shafts of C45 +QT on deep-groove ball bearings."""

    shaft_diameter: float | None = kind.length(
        None, at_least=5 * mm, at_most=0.5, doc="diameter of both shafts; default: the least of stock that is enough"
    )
    shaft_lever: float = kind.length(
        40 * mm, at_least=0.0, at_most=1.0, doc="distance of the links on a shaft from the middle of its next bearing"
    )
    bearing_life: float = kind.time(
        20_000 * hour, unit="h", above=0.0, at_most=1e6 * hour, doc="required life of the shafts' bearings"
    )
