"""Reducers: torque, efficiency, self-locking; stock ratios of planetary gears.

A reducer of ratio i and efficiency eta: M_motor = M_load / (i eta). With the same friction losses in back-driving,
eta_back = 2 - 1/eta, so a self-locking reducer (eta_back <= 0) has eta <= 1/2: a worm can be self-locking or efficient,
not both. Makers of worm gears rely on self-locking below 0.45 and call 0.45 to 0.55 uncertain, since friction changes
with speed, lubricant and temperature.                                           [inclined plane with friction; derived]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.units import mm


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


@dataclass(frozen=True, slots=True)
class ReducerFlange:
    """The side of a reducer's output up to a torque [N m]: face [m], circle of its four screws [m], these by name,
    mass of the reducer [kg].
    """

    torque: float
    face: float
    circle: float
    thread: str
    mass: float


REDUCER_FLANGES = tuple(
    ReducerFlange(torque, face * mm, circle * mm, thread, mass)
    for torque, face, circle, thread, mass in (
        (20.0, 40, 34, "M4", 0.45),
        (50.0, 60, 52, "M5", 1.1),
        (130.0, 80, 70, "M6", 2.6),
        (290.0, 115, 100, "M10", 8.0),
        (900.0, 160, 145, "M12", 22.0),
        (2000.0, 200, 180, "M12", 45.0),
    )
)
"""Classes of coaxial reducers of two and three stages, from the smallest; makers differ, in masses by a third."""


def flange_for(torque: float, face: float = 0.0) -> ReducerFlange:
    """The smallest class for a torque [N m] with a face of at least a size [m]; the largest where none is.

    >>> flange_for(100.0).face, flange_for(100.0, 0.1).thread
    (0.08, 'M10')
    """
    enough = (row for row in REDUCER_FLANGES if row.torque >= torque and row.face >= face - 1e-9)
    return next(enough, REDUCER_FLANGES[-1])


RATIOS = (1.0, *(reducer.ratio for reducer in PLANETARY))
"""Gears to choose from: none, and the stock planetary ones of one and two stages."""
