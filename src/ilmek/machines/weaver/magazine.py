"""The magazine of a head: the tubes of its yarns, on a drum in tiers or on slides, and the time to bring one in line.

A drum has n tubes in a tier at the pitch t on its circumference, so it is t (n/pi + 1) wide. It turns to and fro,
since the yarns would wind up on a drum that turned on, so that a tier is a line of n positions, as a slide. A slide
moves by its whole length to each side of the handler: 2 n - 1 pitches wide. Other tiers are t above each other; drum or
slides move to them at the same time as along the tier, so that a change takes the longer of both moves.
                                                                        [thesis 2.2.3: tubes on a stepper; derived]
"""

import math
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.elements.materials import MATERIALS
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, disc, rectangle
from ilmek.plane.contours import circle
from ilmek.records import computed, record, result
from ilmek.timing.s_curve import AxisLimits, move_time
from ilmek.units import mm, turn

DRUM, SLIDE = "drum", "slide"

CARRIER = 3 * mm
"""Thickness of the plate that carries the tubes [m]; assumed by this project."""

TUBE_OUTER, TUBE_BORE = 0.8, 0.6
"""Outer and inner diameter of a tube, over the pitch; assumed by this project."""

ALUMINIUM = MATERIALS["aluminium alloy"]


@record
class Magazine:
    """The tubes of a head: their number, their pitch [m], and limits of both axes."""

    kind: str
    tubes: int
    pitch: float
    axis: AxisLimits
    tiers: int = result("1", "tiers of tubes, one above the other", name="tube_tiers")

    @computed("1", "tubes of a tier", name="tubes_per_tier")
    def per_tier(self) -> int:
        return math.ceil(self.tubes / self.tiers)

    @computed("mm", "width that the tubes take, with their motion", name="magazine_width")
    def width(self) -> float:
        return tier_width(self.kind, self.per_tier, self.pitch)

    @computed("mm", "height of all tiers", name="magazine_height")
    def height(self) -> float:
        return self.tiers * self.pitch

    @property
    def tubes_at(self) -> ComplexArray:
        """Axes of a tier's tubes in plan, about the drum's axis or the slide's middle [m]."""
        number = np.arange(self.per_tier)
        if radius := tubes_radius(self):
            return np.asarray(radius * np.exp(1j * turn * number / self.per_tier))
        return np.asarray((number - (self.per_tier - 1) / 2) * self.pitch + 0j)

    @property
    def carrier(self) -> Prism:
        """The plate under the lowest tier, open below each tube: of a drum round, of a slide straight."""
        holes = tuple(circle(complex(at), TUBE_BORE * self.pitch / 2) for at in self.tubes_at)
        if radius := tubes_radius(self):
            return Prism(disc(radius + self.pitch / 2, *holes), CARRIER)
        return Prism(Profile(rectangle(self.per_tier * self.pitch, self.pitch), holes), CARRIER)

    def moved(self, tube: float) -> float:
        """Mass that the selector moves [kg]: the tubes, each of a mass, and their carrier."""
        return self.tubes * tube + self.carrier.volume * ALUMINIUM.density

    @property
    def mean_time(self) -> float:
        """Mean time from one tube to another [s]; 0 for a single one."""
        return _times(self)[0]

    @property
    def longest_time(self) -> float:
        """Longest time from one tube to another [s]."""
        return _times(self)[1]


def tubes_radius(magazine: Magazine) -> float:
    """Radius of the tubes' axes on a drum [m]; 0 on a slide."""
    return magazine.pitch * magazine.per_tier / turn if magazine.kind == DRUM else 0.0


def tier_width(kind: str, tubes: int, pitch: float) -> float:
    """Width that a tier with a number of tubes at a pitch [m] takes, with its motion [m].

    >>> round(tier_width("drum", 16, 12e-3) * 1e3, 1), round(tier_width("slide", 16, 12e-3) * 1e3, 1)
    (73.1, 372.0)
    """
    return pitch * (tubes / math.pi + 1) if kind == DRUM else pitch * (2 * tubes - 1)


def fewest_tiers(kind: str, tubes: int, pitch: float, width: float, most: int) -> int:
    """The fewest tiers that keep a width [m]; the most that are allowed where none does."""
    fits = (tiers for tiers in range(1, most + 1) if tier_width(kind, math.ceil(tubes / tiers), pitch) <= width + 1e-9)
    return next(fits, most)


@lru_cache(maxsize=64)
def _times(magazine: Magazine) -> tuple[float, float]:
    """Mean and longest time between two tubes [s]."""
    along, up = (_of_steps(magazine, count) for count in (magazine.per_tier, magazine.tiers))
    tier, place = np.divmod(np.arange(magazine.tubes), magazine.per_tier)
    first, then = np.triu_indices(magazine.tubes, 1)
    if not len(first):
        return 0.0, 0.0
    times = np.maximum(along[np.abs(place[then] - place[first])], up[tier[then] - tier[first]])
    return float(np.mean(times)), float(np.max(times))


def _of_steps(magazine: Magazine, count: int) -> FloatArray:
    """Time of a move over 0, 1, ... pitches [s]."""
    return np.array([0.0, *(move_time(steps * magazine.pitch, magazine.axis) for steps in range(1, count))])
