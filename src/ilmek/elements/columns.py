"""Square hollow sections, and columns of them under eccentric compression.

A column of height h, pinned at both ends, under P at the lever e off its axis, with q = h/2 sqrt(P/(E I)):

    stress = P/A + P e c / (I cos q),   bow = e (1/cos q - 1),   buckling at P = pi^2 E I / h^2

[Timoshenko and Gere, Theory of Elastic Stability, 1.13, the secant formula]
"""

import math
from dataclasses import dataclass
from functools import cache

from ilmek.elements.beam import uniform
from ilmek.elements.materials import GRAVITY, MATERIALS
from ilmek.units import format_quantity, mm

STEEL = MATERIALS["structural steel"]

SECTIONS = tuple(
    (side * mm, wall * mm)
    for side, wall in (
        (40, 3),
        (50, 3),
        (60, 4),
        (80, 4),
        (80, 6),
        (100, 5),
        (100, 8),
        (120, 6),
        (120, 10),
        (150, 8),
        (180, 8),
        (200, 10),
        (220, 10),
        (250, 12),
        (300, 12),
        (350, 16),
        (400, 16),
    )
)
"""Sides and walls of square hollow sections [m]: a choice from EN 10219-2 and EN 10210-2."""


@dataclass(frozen=True, slots=True)
class HollowSquare:
    """A square hollow section with sharp corners: side and wall [m]."""

    side: float
    wall: float

    @property
    def area(self) -> float:
        """Area [m^2]."""
        return self.side**2 - (self.side - 2 * self.wall) ** 2

    @property
    def inertia(self) -> float:
        """Second moment of area [m^4]."""
        hollow = uniform.square_inertia(self.side) - uniform.square_inertia(self.side - 2 * self.wall)
        return float(hollow)

    @property
    def torsion(self) -> float:
        """J of the thin-walled tube, (a - t)^3 t, with the mean side a - t and the wall t [m^4]: Bredt's formula."""
        return (self.side - self.wall) ** 3 * self.wall

    def twist(self, torque: float, length: float) -> float:
        """Twist T l / (G J) [rad] of a length [m] under a torque [N m], G = E / 2.6: Poisson's ratio 0.3."""
        return torque * length / (STEEL.modulus / 2.6 * self.torsion)

    @property
    def line_mass(self) -> float:
        """Mass per length [kg/m]."""
        return self.area * STEEL.density

    @property
    def name(self) -> str:
        """Like `100 x 5 mm`."""
        return f"{format_quantity(self.side / mm, '')} x {format_quantity(self.wall, 'mm')}"


def eccentric(force: float, lever: float, height: float, section: HollowSquare) -> tuple[float, float]:
    """Greatest stress [Pa] and bow [m] of a column under an eccentric force; inf at or above Euler's load.

    force  [N]      lever  of the force [m]      height  [m]
    """
    q = height / 2 * math.sqrt(force / (STEEL.modulus * section.inertia))
    if q >= math.pi / 2:
        return math.inf, math.inf
    bending = force * lever * section.side / 2 / (section.inertia * math.cos(q))
    return force / section.area + bending, lever * (1 / math.cos(q) - 1)


def euler(height: float, section: HollowSquare) -> float:
    """Load at which a column pinned at both ends buckles [N]: pi^2 E I / h^2."""
    return math.pi**2 * STEEL.modulus * section.inertia / height**2


def mid_loaded(section: HollowSquare, span: float, force: float) -> tuple[float, float]:
    """Deflection [m] and stress [Pa] of a simply supported beam under its own weight and a force in its middle [N].

    F l^3 / (48 E I) + 5 q l^4 / (384 E I),   (F l / 4 + q l^2 / 8) c / I          [elements.beam; theory of beams]
    """
    own, stiff = section.line_mass * GRAVITY, STEEL.modulus * section.inertia
    sag = force * span**3 / (48 * stiff) + uniform.deflection_max(own, span, STEEL.modulus, section.inertia)
    moment = force * span / 4 + uniform.moment_max(own, span)
    return float(sag), float(uniform.bending_stress(moment, section.side / 2, section.inertia))


@cache
def ascending() -> tuple[HollowSquare, ...]:
    """All sections in ascending order of their mass."""
    return tuple(sorted((HollowSquare(*size) for size in SECTIONS), key=lambda section: section.area))
