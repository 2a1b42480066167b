"""Geneva wheel: a crank pin that enters n radial slots one after the other, and a disc that locks the wheel between.

    lambda = r / a = sin(pi / n)                          r radius of the pin, a distance of the centres
    psi    = atan2(lambda sin phi, 1 - lambda cos phi)    |phi| < pi/2 - pi/n: the pin is in a slot
    psi    = +- pi / n                                    else: the wheel dwells

phi is the crank's angle from the line of centres, psi that of the slot in mesh, the other way round: the wheel is at
q = -psi - 2 pi k / n after k turns. The pin enters and leaves along the slot, so that psi' has no jump; psi'' has.
[Volmer, Getriebetechnik: Malteserkreuzgetriebe; Norton, Design of Machinery, chapter 2]

>>> wheel = Geneva(4)
>>> bool(np.isclose(wheel.motion(np.array(2 * np.pi))[0], -np.pi / 2)), round(float(wheel.motion(np.array(0.0))[1]), 4)
(True, -2.4142)
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, RealField
from ilmek.errors import MechanismError
from ilmek.units import turn

LEAST_SLOTS, MOST_SLOTS = 3, 100


@dataclass(frozen=True, slots=True)
class Geneva:
    """The law of an external Geneva wheel with n slots and one pin on the crank.

    Raises MechanismError for fewer than 3 slots: the pin of two does not leave them.
    """

    slots: int

    def __post_init__(self) -> None:
        if not LEAST_SLOTS <= self.slots <= MOST_SLOTS:
            raise MechanismError(f"a Geneva wheel has {self.slots} slots", allowed=f"{LEAST_SLOTS} to {MOST_SLOTS}")

    @property
    def slides(self) -> bool:
        """False: the wheel turns."""
        return False

    @property
    def one_sided(self) -> bool:
        """False: a slot has two sides."""
        return False

    @property
    def turns(self) -> int:
        """Turns of the crank after which the wheel is in the same position."""
        return self.slots

    @property
    def share(self) -> float:
        """lambda: radius of the pin over the distance of the centres [1]."""
        return math.sin(math.pi / self.slots)

    def engaged(self, angle: RealField) -> BoolArray:
        """Whether the pin is in a slot at crank angles from the line of centres [rad]."""
        near = np.asarray(angle) - turn * np.round(np.asarray(angle) / turn)
        return np.asarray(np.abs(near) < math.pi / 2 - math.pi / self.slots)

    def motion(self, angle: RealField) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Q [rad] of the wheel and its derivatives by the crank angle [rad], at angles of any turn."""
        count = np.round(np.asarray(angle) / turn)
        phi, by = np.asarray(angle) - turn * count, self.share
        c, s = np.cos(phi), np.sin(phi)
        d = 1 - 2 * by * c + by**2
        moving = self.engaged(angle)
        rest = np.sign(phi) * math.pi / self.slots
        rows = (
            np.where(moving, np.arctan2(by * s, 1 - by * c), rest) + turn / self.slots * count,
            np.where(moving, by * (c - by) / d, 0.0),
            np.where(moving, -by * (1 - by**2) * s / d**2, 0.0),
            np.where(moving, -by * (1 - by**2) * (c * d - 4 * by * s**2) / d**3, 0.0),
        )
        value, first, second, third = (-row for row in rows)
        return value, first, second, third
