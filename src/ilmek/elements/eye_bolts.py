"""Eye bolts by which a machine is lifted: DIN 580, C15E, screwed in to the collar.

m bolt >= m lifted / 2         two of four slings bear it all: the others may hang slack        [EN 818-4; DIN 580]
"""

import math
from dataclasses import dataclass

from ilmek.elements.catalogue import pick
from ilmek.errors import ParameterError
from ilmek.units import deg, mm

BEARING = 2
"""Slings of four that bear all."""


@dataclass(frozen=True, slots=True)
class EyeBolt:
    """A row of DIN 580.

    thread    its diameter [m]       upright, slanting  mass that it bears along its axis, and up to 45 degrees [kg]
    collar, ring  diameters [m]      height  over the collar [m]      length  of the thread [m]      mass  [kg]
    """

    thread: float
    upright: float
    slanting: float
    collar: float
    ring: float
    height: float
    length: float
    mass: float

    @property
    def name(self) -> str:
        """As ordered."""
        return f"DIN 580 - M{self.thread / mm:.0f} - C15E"

    def bears(self, angle: float) -> float:
        """Mass that it bears under a sling at an angle to its axis [kg]; nan above 45 degrees."""
        return self.upright if angle == 0 else self.slanting if angle <= _SLANT else math.nan


_SLANT = 45 * deg + 1e-9

ROWS = tuple(
    EyeBolt(thread * mm, upright, slanting, collar * mm, ring * mm, height * mm, length * mm, mass)
    for thread, upright, slanting, (collar, ring, height, length), mass in (
        (8, 140.0, 95.0, (20, 36, 36, 13), 0.06),
        (10, 230.0, 170.0, (25, 45, 45, 17), 0.11),
        (12, 340.0, 240.0, (30, 54, 53, 20.5), 0.18),
        (16, 700.0, 500.0, (35, 63, 62, 27), 0.28),
        (20, 1200.0, 860.0, (40, 72, 71, 30), 0.45),
        (24, 1800.0, 1290.0, (50, 90, 90, 36), 0.74),
        (30, 3200.0, 2300.0, (65, 108, 109, 45), 1.66),
        (36, 4600.0, 3300.0, (75, 126, 128, 54), 2.65),
        (42, 6300.0, 4500.0, (85, 144, 147, 63), 4.03),
        (48, 8600.0, 6100.0, (100, 166, 168, 68), 6.38),
    )
)


def eye_bolt_for(mass: float, angle: float = 0.0) -> EyeBolt:
    """The least eye bolt of four that lift a mass [kg] with slings at an angle to their axes [rad].

    Raises ParameterError for an angle above 45 degrees. The largest where none is enough.

    >>> [eye_bolt_for(2000.0, angle).name for angle in (0.0, 45 * deg)]
    ['DIN 580 - M20 - C15E', 'DIN 580 - M24 - C15E']
    """
    if not angle <= _SLANT:
        raise ParameterError("slings at more than 45 degrees to an eye bolt", do="lift on a lifting frame")
    return next((row for row in ROWS if row.bears(angle) >= mass / BEARING), ROWS[-1])


def find_eye_bolt(name: str) -> EyeBolt:
    """The eye bolt of a designation. Raises ParameterError with the nearest for an unknown one."""
    return pick({row.name: row for row in ROWS}, name, "eye bolt")
