"""Brakes behind motors that hold what would sink: spring-applied, released by 24 V.

    M brake >= 1.5 M held                                                             [assumed by this project]

Sizes and masses are those that makers have in common; a part of another make differs by some millimetres.
"""

import math
from dataclasses import dataclass

from ilmek.elements.catalogue import pick
from ilmek.units import mm

MARGIN = 1.5
"""Torque of a brake over that which it holds."""


@dataclass(frozen=True, slots=True)
class HoldingBrake:
    """A row: torque [N m], power of its coil [W], diameter and length [m], mass [kg]."""

    torque: float
    power: float
    diameter: float
    length: float
    mass: float

    @property
    def name(self) -> str:
        """As ordered."""
        return f"spring-applied brake {self.torque:g} N m, 24 V"


BRAKES = tuple(
    HoldingBrake(torque, power, diameter * mm, length * mm, mass)
    for torque, power, diameter, length, mass in (
        (0.5, 9.0, 42.0, 32.0, 0.22),
        (2.0, 19.0, 76.0, 39.0, 0.76),
        (4.0, 25.0, 87.0, 43.0, 1.1),
        (8.0, 29.0, 103.0, 49.0, 1.8),
        (16.0, 38.0, 128.0, 54.0, 3.4),
        (32.0, 46.0, 148.0, 60.0, 4.5),
        (60.0, 69.0, 168.0, 72.0, 7.4),
        (100.0, 88.0, 200.0, 80.0, 13.6),
        (200.0, 98.0, 221.0, 90.0, 19.2),
        (500.0, 120.0, 280.0, 110.0, 33.0),
    )
)


def brake_for(torque: float) -> HoldingBrake:
    """The least brake that holds a torque [N m], the largest where none does.

    >>> brake_for(1.2).name
    'spring-applied brake 2 N m, 24 V'
    """
    return next((row for row in BRAKES if row.torque >= MARGIN * torque or math.isnan(torque)), BRAKES[-1])


def find_brake(name: str) -> HoldingBrake:
    """The brake of a designation. Raises ParameterError with the nearest for an unknown one."""
    return pick({row.name: row for row in BRAKES}, name, "brake")
