"""Motors and reducers: what torque arrives, what stays locked, which motor is enough.

A reducer of ratio i and efficiency eta: M_motor = M_load / (i eta). With the same friction losses driven backwards,
eta_back = 2 - 1/eta, so a reducer that locks itself (eta_back <= 0) has eta <= 1/2: a worm can be self-locking or
efficient, not both. Makers of worm gears count on it below 0.45 and call 0.45 to 0.55 unsure, for friction changes with
speed, lubricant and warmth.                                           [inclined plane with friction; derived]
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ilmek.units import rpm


@dataclass(frozen=True, slots=True)
class Reducer:
    """A speed reducer: ratio (input turns per output turn) and efficiency, above 0 and at most 1."""

    ratio: float
    efficiency: float

    def motor_torque(self, load_torque: float) -> float:
        """Torque at the input [N m] that moves a load torque at the output [N m]."""
        return load_torque / (self.ratio * self.efficiency)

    @property
    def back_driving_efficiency(self) -> float:
        """Efficiency when the load drives, 2 - 1/eta: nothing comes back where it is not above 0."""
        return 2 - 1 / self.efficiency

    @property
    def self_locking(self) -> bool:
        """Whether the load cannot drive it backwards: efficiency at most 1/2."""
        return self.back_driving_efficiency <= 0


def worm_efficiency(lead_angle: float, friction_angle: float) -> float:
    """Efficiency of a worm: tan g / tan(g + r) of its lead angle g and the angle of friction r [rad].

    It locks itself for g <= r, and then the efficiency is (1 - tan^2 r)/2 at most.
    """
    return math.tan(lead_angle) / math.tan(lead_angle + friction_angle)


@dataclass(frozen=True, slots=True)
class Motor:
    """A class of motors, no maker's product: lasting torque [N m] up to a speed [rad/s]."""

    name: str
    kind: str
    torque: float
    speed: float

    @property
    def power(self) -> float:
        """Torque times speed [W]."""
        return self.torque * self.speed


def _stepper(frame: str, torque: float) -> Motor:
    return Motor(f"stepper {frame}, {torque:g} N m", "stepper", torque, 300 * rpm)


def _servo(power: float, turns: float) -> Motor:
    torque = power / (turns * rpm)
    return Motor(f"servo {power:g} W, {turns:g} rpm, {torque:.3g} N m", "servo", torque, turns * rpm)


MOTORS = (
    *(_stepper("NEMA 17", torque) for torque in (0.4,)),
    *(_stepper("NEMA 23", torque) for torque in (1.0, 2.0)),
    *(_stepper("NEMA 34", torque) for torque in (4.0, 7.0, 12.0)),
    *(_servo(power, 3000.0) for power in (100.0, 200.0, 400.0, 750.0, 1000.0, 1500.0, 2000.0, 3000.0)),
    *(_servo(power, 1500.0) for power in (2900.0, 4400.0, 5500.0, 7500.0, 11000.0, 15000.0)),
)
"""Classes to choose from. Steppers: the torque left at 300 rpm, about two thirds of holding. Servos: rated power and
speed, torque = power / speed."""


_ROUNDING = 1e-9


def smallest_motor(torque: float, speed: float = 0.0, kind: str | None = None) -> Motor | None:
    """The motor of least power in `MOTORS` that gives `torque` [N m] at `speed` [rad/s]; None where none does.

    kind  "stepper" or "servo"; None takes either
    >>> smallest_motor(6.5).name
    'stepper NEMA 34, 7 N m'
    """
    least = torque * (1 - _ROUNDING), speed * (1 - _ROUNDING)
    enough = [m for m in MOTORS if m.torque >= least[0] and m.speed >= least[1] and kind in (None, m.kind)]
    return min(enough, key=lambda motor: motor.power, default=None)


def geared_motor(
    torque: float, speed: float, reducers: Sequence[Reducer], kind: str | None = None
) -> tuple[Motor, Reducer] | None:
    """The motor of least power that gives `torque` [N m] at `speed` [rad/s] behind one of the reducers, and the first
    of them with which it does; None where no motor does.

    >>> motor, gear = geared_motor(20.0, 1.0, [Reducer(ratio, 0.9) for ratio in (10, 50, 100)], "servo")
    >>> motor.name, gear.ratio
    ('servo 100 W, 3000 rpm, 0.318 N m', 100)
    """
    found = [(smallest_motor(by.motor_torque(torque), by.ratio * speed, kind), by) for by in reducers]
    pairs = [(motor, by) for motor, by in found if motor is not None]
    return min(pairs, key=lambda pair: pair[0].power, default=None)


def most_torque(speed: float) -> float:
    """The most torque that any motor in `MOTORS` gives at a speed [rad/s]; 0 where none is that quick [N m].

    >>> most_torque(1e6)
    0.0
    """
    return max((motor.torque for motor in MOTORS if motor.speed >= speed), default=0.0)
