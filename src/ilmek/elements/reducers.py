"""Reducers: torque, efficiency, self-locking; stock ratios of planetary gears.

A reducer of ratio i and efficiency eta: M_motor = M_load / (i eta). With the same friction losses in back-driving,
eta_back = 2 - 1/eta, so a self-locking reducer (eta_back <= 0) has eta <= 1/2: a worm can be self-locking or efficient,
not both. Makers of worm gears rely on self-locking below 0.45 and call 0.45 to 0.55 uncertain, since friction changes
with speed, lubricant and temperature.                                           [inclined plane with friction; derived]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.elements.machine_screws import SOCKET_SCREWS
from ilmek.report import Check, at_most
from ilmek.units import format_quantity, mm


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

    def output_torque(self, motor_torque: float) -> float:
        """Torque at the output [N m] for one at the input [N m]: M i eta."""
        return motor_torque * self.ratio * self.efficiency

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
    """The side of a reducer's output up to a torque [N m]: face [m], circle of its screws [m], these by name, their
    number, mass of the reducer [kg].
    """

    torque: float
    face: float
    circle: float
    thread: str
    number: int
    mass: float

    @property
    def waist(self) -> float:
        """Diameter of the housing behind the flange, beside the heads of its screws [m]."""
        return self.circle - SOCKET_SCREWS[self.thread].sink - 2 * mm


REDUCER_FLANGES = tuple(
    ReducerFlange(torque, face * mm, circle * mm, thread, number, mass)
    for torque, face, circle, thread, number, mass in (
        (20.0, 40, 34, "M4", 4, 0.45),
        (50.0, 60, 52, "M5", 4, 1.1),
        (130.0, 80, 70, "M6", 4, 2.6),
        (290.0, 115, 100, "M10", 4, 8.0),
        (900.0, 160, 145, "M12", 4, 22.0),
        (2000.0, 200, 180, "M12", 4, 45.0),
        (5000.0, 280, 250, "M16", 6, 95.0),
        (9000.0, 340, 310, "M16", 6, 160.0),
        (14000.0, 450, 420, "M16", 6, 260.0),
    )
)
"""Classes of reducers of two and three stages, from the smallest; makers differ, in masses by a third. Those above
2,000 N m are industrial ones; their sizes and masses are assumed, and their screws hold the torque by friction."""


def flange_for(torque: float, face: float = 0.0, waist: float = 0.0) -> ReducerFlange:
    """The smallest class for a torque [N m] with a face and a waist of at least some sizes [m]; the largest where none
    is.

    >>> flange_for(100.0).face, flange_for(100.0, 0.1).thread
    (0.08, 'M10')
    """
    enough = (row for row in REDUCER_FLANGES if row.torque >= torque and row.face >= face - 1e-9)
    return next((row for row in enough if row.waist >= waist), REDUCER_FLANGES[-1])


def reducer_check(title: str, by: Reducer, motor_torque: float, load: float, part: str) -> Check:
    """The torque of a load on a reducer [N m] against that of its class, which bears its motor's too [N m]."""
    row = flange_for(max(by.output_torque(motor_torque), load))
    source = f"class with a flange of {format_quantity(row.face, 'mm')}; the largest is of 14 kNm"
    return at_most(f"torque of the {title}", load, row.torque, "Nm", source).with_cure(
        "set a lower tension, or a narrower loom", part
    )


RATIOS = (1.0, *(reducer.ratio for reducer in PLANETARY))
"""Gears to choose from: none, and the stock planetary ones of one and two stages."""
