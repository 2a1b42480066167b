"""Reducers: torque, efficiency, self-locking; stock ratios of planetary and worm gears.

A reducer of ratio i and efficiency eta: M_motor = M_load / (i eta). With the same friction losses in back-driving,
eta_back = 2 - 1/eta, so a self-locking reducer (eta_back <= 0) has eta <= 1/2: a worm can be self-locking or efficient,
not both. Makers of worm gears rely on self-locking below 0.45 and call 0.45 to 0.55 uncertain, since friction changes
with speed, lubricant and temperature.                                           [inclined plane with friction; derived]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField


@dataclass(frozen=True, slots=True)
class Reducer:
    """A speed reducer: ratio (input turns per output turn) and efficiency, above 0 and at most 1."""

    ratio: float
    efficiency: float

    def motor_torque(self, load_torque: float) -> float:
        """Torque at the input [N m] for a load torque at the output [N m]: M / (i eta)."""
        return load_torque / (self.ratio * self.efficiency)

    def input_torque(self, load_torque: RealField, speed: RealField) -> FloatArray:
        """Torque at the input [N m] for a torque [N m] and a speed [rad/s] at the output, broadcast.

        M / (i eta) where the motor drives, M eta_back / i where the load drives (negative for a self-locking reducer),
        and at rest M max(eta_back, 0) / i.
        """
        backwards = self.back_driving_efficiency
        power = np.multiply(load_torque, speed)
        factor = np.where(power > 0, 1 / self.efficiency, np.where(power < 0, backwards, max(backwards, 0.0)))
        return np.asarray(factor * load_torque / self.ratio)

    @property
    def back_driving_efficiency(self) -> float:
        """Efficiency with the load driving, 2 - 1/eta; 0 or less for a self-locking reducer."""
        return 2 - 1 / self.efficiency

    @property
    def kind(self) -> str:
        """What has such an efficiency: a worm locks itself."""
        return "worm reducer" if self.self_locking else "planetary reducer"

    @property
    def self_locking(self) -> bool:
        """Whether the load cannot drive it backwards: efficiency at most 1/2."""
        return self.back_driving_efficiency <= 0


DIRECT = Reducer(1.0, 1.0)

PLANETARY = tuple(
    Reducer(float(ratio), efficiency)
    for ratios, efficiency in (((3, 4, 5, 7, 10), 0.97), ((16, 20, 25, 35, 50, 70, 100), 0.94))
    for ratio in ratios
)
"""Stock planetary reducers of one and of two stages, with usual efficiencies."""


RATIOS = (1.0, *(reducer.ratio for reducer in PLANETARY))
"""Gears to choose from: none, and the stock planetary ones of one and two stages."""


def worm_efficiency(lead_angle: float, friction_angle: float) -> float:
    """Efficiency of a worm [1]: tan g / tan(g + r) of its lead angle g and the angle of friction r [rad].

    Self-locking for g <= r, with an efficiency of at most (1 - tan^2 r)/2.
    [Shigley, 8-2, for a square thread]
    """
    return math.tan(lead_angle) / math.tan(lead_angle + friction_angle)


@dataclass(frozen=True, slots=True)
class Worm:
    """A worm gear: teeth of the wheel, starts of the worm, quotient q of the worm's pitch diameter and the module.

    tan g = starts / q [DIN 3975]
    >>> worm = Worm(60, 1, 10.0)
    >>> worm.reducer(0.05).self_locking, worm.reducer(0.12).self_locking, round(worm.locking_friction, 3)
    (False, True, 0.1)
    """

    teeth: int
    starts: int
    quotient: float

    @property
    def ratio(self) -> float:
        """Turns of the worm per turn of the wheel."""
        return self.teeth / self.starts

    @property
    def lead_angle(self) -> float:
        """Lead angle g [rad]."""
        return math.atan(self.starts / self.quotient)

    @property
    def locking_friction(self) -> float:
        """Least coefficient of friction for self-locking: tan g.

        Hardened steel on bronze in oil has 0.02 to 0.06 at speed and 0.1 or more at the start, so that a worm may hold
        at rest and slip under vibration.
        """
        return self.starts / self.quotient

    def reducer(self, friction: float) -> Reducer:
        """The reducer for a coefficient of friction, without losses of bearings and oil."""
        return Reducer(self.ratio, worm_efficiency(self.lead_angle, math.atan(friction)))


WORMS = (
    *(Worm(30, starts, 10.0) for starts in (4, 3, 2)),
    *(Worm(teeth, 2, 10.0) for teeth in (40, 50)),
    *(Worm(teeth, 1, 10.0) for teeth in (30, 40, 50)),
    *(Worm(teeth, 1, 12.5) for teeth in (60, 80)),
    Worm(100, 1, 16.0),
)
"""Stock ratios 7.5 to 100 with their usual starts and quotients (DIN 3976: q of 8 to 16)."""
