"""Times of the loom's operations, as the compiler counts them."""

from dataclasses import dataclass

from ilmek.errors import LoomError

LONGEST_TIME = 1e9
"""Largest time of an operation of the loom [s], 32 years: sums over the largest carpet stay exact to 1 ms."""


@dataclass(frozen=True, slots=True)
class Times:
    """Times of the loom's operations [s].

    knot           one turn of a head's cam shaft, including the step to the next warp pair
    colour_change  standstill of the head while the tube of another colour is aligned
    travel         travel by one knot pitch beyond that step
    weft           the two wefts and beats after a row of knots

    Raises LoomError for a time that is negative or above LONGEST_TIME, and for a knot time of 0.
    """

    knot: float
    colour_change: float
    travel: float
    weft: float

    def __post_init__(self) -> None:
        for name, value in zip(self.__slots__, self.as_tuple(), strict=True):
            if not 0 <= value <= LONGEST_TIME or (name == "knot" and value == 0):
                raise LoomError(
                    f"time of {name.replace('_', ' ')} {value:g} s",
                    allowed=f"a finite time up to {LONGEST_TIME:g} s, above 0 s for a knot",
                )

    def as_tuple(self) -> tuple[float, float, float, float]:
        """(knot, colour change, travel, weft) [s]."""
        return float(self.knot), float(self.colour_change), float(self.travel), float(self.weft)
