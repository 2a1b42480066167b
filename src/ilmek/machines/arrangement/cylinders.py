"""Cylinders under the fell: the spacer, and the lower one with the carpet that is wound on it."""

import math

from ilmek.records import record
from ilmek.units import mm

SPACER_BELOW = 50 * mm
"""From the fell to the top of the spacer [m]."""

BETWEEN_CYLINDERS = 50 * mm
"""Between spacer and full lower cylinder [m]."""

GROUND_THICKNESS = 3.0
"""Thickness of a carpet's ground over the diameter of its warps: wefts, assumed as thick, before and behind them
[plain weave: Peirce, J. Text. Inst. 28 (1937) T45]."""


@record
class RoundPart:
    """A roller or cylinder: its axis and its radius [m]."""

    at: complex
    radius: float


def rolled(radius: float, length: float, pile_height: float, warp: float) -> float:
    """Radius of a cylinder with a carpet wound on it [m]; warp: its diameter [m].

    A carpet of length L and thickness t fills the ring pi (R² - r²) = L t.

    >>> round(rolled(0.0, math.pi, 0.7, 0.1), 9)
    1.0
    """
    return math.sqrt(radius**2 + length * (pile_height + GROUND_THICKNESS * warp) / math.pi)


def under_the_fell(radius: float, wide: float, roll: float) -> tuple[RoundPart, RoundPart]:
    """Spacer of a radius `wide`, and lower cylinder of another, with the carpet of a radius `roll` on it [m]."""
    under = SPACER_BELOW + 2 * wide + BETWEEN_CYLINDERS + roll
    return RoundPart(complex(-wide, -SPACER_BELOW - wide), wide), RoundPart(complex(-radius, -under), radius)
