"""Solenoids: force over the gap, heat, time to switch; selection.

A plunger of the diameter c with a flat face closes the gap g. The iron's own resistance to the flux and its leakage
are neglected, a rest of the gap r stays in the closed one; the iron bears the flux density B at most:

    F = B² A / 2 mu0,    B = mu0 N I / (g + r) <= LARGEST,    A = pi c²/4     [Roters, Electromagnetic Devices, V, VIII]
    (N I)² = P K,        K = f S / (rho l)          P power, S section of the winding, f its filling, l of a mean turn
    L/R = mu0 A K / (g + r)                         time constant of the current
"""

import math
from dataclasses import dataclass

from ilmek.elements.magnets import PERMEABILITY
from ilmek.elements.materials import MATERIALS
from ilmek.units import g, mm

LARGEST = 1.5
"""Flux density in the iron, at most [T]: knee of free-cutting steel."""

REST = 0.15 * mm
"""Gap of a closed solenoid: its spacer and that about the plunger [m]."""

PEAK = 10.0
"""Power of a short pulse over that which it bears without end: makers' class of 10 % duty."""

HOLD_SAFETY = 1.5
"""Force of a closed solenoid over the one that it holds; assumed by this project."""

LEAST = 0.01
"""Share of a pulse's force that moves something, at least, for a time that is a number."""

FILLING, HOT_COPPER = 0.6, 2.2e-8
"""Copper in a winding's section, and its resistivity at 90 degrees C [ohm m]."""

_SHELL, _END, _BOBBIN = 0.7 * mm, 1.5 * mm, 0.4 * mm


@dataclass(frozen=True, slots=True)
class Solenoid:
    """A row of the catalogue: a tubular solenoid that pushes.

    diameter, length  of its shell [m]      plunger  its diameter [m]
    mass  [kg]        power  that it bears without end, on metal [W]
    """

    diameter: float
    length: float
    plunger: float
    mass: float
    power: float

    @property
    def designation(self) -> str:
        """As ordered."""
        return f"tubular solenoid {self.diameter / mm:g} x {self.length / mm:g} mm, 24 V, {self.power:g} W"

    @property
    def area(self) -> float:
        """Of the plunger's face [m²]."""
        return math.pi * self.plunger**2 / 4

    @property
    def moving(self) -> float:
        """Mass of its plunger, half as long as the shell [kg]."""
        return self.area * self.length / 2 * MATERIALS["heat-treatable steel"].density

    @property
    def winding(self) -> float:
        """K: squared ampere turns of a watt [A²/W]."""
        inner, outer = self.plunger / 2 + _BOBBIN, self.diameter / 2 - _SHELL
        section = FILLING * (outer - inner) * (self.length - 2 * _END)
        return section / (HOT_COPPER * math.pi * (inner + outer))

    def force(self, gap: float, power: float) -> float:
        """Force at a gap [m] and a power [W], in newtons.

        >>> row = ROWS[3]
        >>> round(row.force(0.5 * mm, 5.0), 1), row.force(0.0, 50.0) == row.force(0.0, 100.0)
        (4.0, True)
        """
        density = min(PERMEABILITY * math.sqrt(power * self.winding) / (gap + REST), LARGEST)
        return density**2 * self.area / (2 * PERMEABILITY)

    def constant(self, gap: float) -> float:
        """Time constant of the current at a gap [m], in seconds."""
        return PERMEABILITY * self.area * self.winding / (gap + REST)

    def closes_in(self, gap: float, force: float, over: float, mass: float) -> float:
        """Time in which a pulse closes a gap [m] with a mass [kg], in seconds.

        force  to overcome at the gap, over: by which it is exceeded on the way, at least [N]: the current rises until
        the force is overcome; then what is over it moves the mass, at least `LEAST` of the first force.
        """
        first, least = self.force(gap, PEAK * self.power), LEAST * self.force(gap, PEAK * self.power)
        rise = math.log1p(-math.sqrt(min(force / first, 1 - LEAST)))
        return math.sqrt(2 * mass * gap / max(over, least)) - self.constant(gap) * rise

    def holds_with(self, force: float) -> float:
        """Power that holds a force [N] in the closed solenoid, `HOLD_SAFETY` times as much, in watts."""
        turns = REST * math.sqrt(2 * HOLD_SAFETY * force / (PERMEABILITY * self.area))
        return turns**2 / self.winding

    def opens_in(self, gap: float, force: float, mass: float) -> float:
        """Time in which a spring's mean force [N] opens it by a gap [m] with a mass [kg], in seconds."""
        return self.constant(0.0) * math.log(HOLD_SAFETY) / 2 + math.sqrt(2 * mass * gap / force)


ROWS = (
    Solenoid(8 * mm, 16 * mm, 2.8 * mm, 5 * g, 1.0),
    Solenoid(10 * mm, 16 * mm, 3.5 * mm, 8 * g, 1.4),
    Solenoid(12 * mm, 12 * mm, 4 * mm, 9 * g, 1.5),
    Solenoid(12 * mm, 16 * mm, 4 * mm, 12 * g, 1.8),
    Solenoid(13 * mm, 20 * mm, 4.5 * mm, 17 * g, 2.4),
    Solenoid(16 * mm, 24 * mm, 6 * mm, 30 * g, 3.6),
    Solenoid(20 * mm, 30 * mm, 8 * mm, 60 * g, 6.0),
)
"""Sizes in which tubular solenoids are usual, by mass; makers differ by some millimetres and a third of the power."""


def shortest(gap: float, force: float, closed: float) -> Solenoid:
    """The shortest row whose pulse gives a force [N] at a gap [m] and another closed, of several the lightest.

    The last one where none does.
    >>> shortest(0.5 * mm, 7.0, 9.0).length / mm, shortest(1.0, 1.0, 1.0) == ROWS[-1]
    (12.0, True)
    """
    enough = (
        row for row in ROWS if row.force(gap, PEAK * row.power) >= force and row.force(0.0, PEAK * row.power) >= closed
    )
    return min(enough, key=lambda row: (row.length, row.mass), default=ROWS[-1])
