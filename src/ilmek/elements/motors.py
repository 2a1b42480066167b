"""Motors: torque at a speed, selection; reducers are in `reducers`, duty cycles in `duty`.

    stepper:  T(w) = Th / sqrt(1 + (w / wc)^2)

Th holding torque: the current of a winding of resistance and inductance at the step frequency, at a fixed voltage. The
corner wc is 268 rpm here, so that two thirds of Th remain at 300 rpm and a quarter at 1000 rpm: typical of drives of 48
to 70 V.
                                                             [Acarnley, Stepping Motors, chapter 5, without back e.m.f.]
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.elements.catalogue import pick
from ilmek.elements.reducers import Reducer
from ilmek.units import mm, rpm

__all__ = [
    "FULL_STEPS",
    "MOTORS",
    "NO_MOTOR",
    "Motor",
    "Reducer",
    "find_motor",
    "geared_motor",
    "most_torque",
    "smallest_motor",
    "strongest_motor",
]

STEPPER, SERVO = "stepper", "servo"

NO_MOTOR = "no motor of the table"
"""Why a machine has no motor: none is enough, or its torque is given."""

FULL_STEPS = 200
"""Full steps of a stepper's turn, 1.8 degrees each."""


@dataclass(frozen=True, slots=True)
class Motor:
    """A class of motors, not a product: continuous torque [N m] up to a speed [rad/s].

    peak     short-term torque [N m]; for a stepper the holding torque
    inertia  of the rotor [kg m²]      mass  [kg]
    face     side of its square flange [m]
    """

    name: str
    kind: str
    torque: float
    speed: float
    peak: float
    inertia: float
    mass: float
    face: float

    @property
    def power(self) -> float:
        """Torque times speed [W]."""
        return self.torque * self.speed

    def peak_at(self, speed: RealField) -> FloatArray:
        """Greatest torque [N m] at a speed [rad/s]: T(w) of a stepper; a servo: peak to its rated speed, then 0."""
        speed = np.abs(speed)
        if self.kind == STEPPER:
            return np.asarray(self.peak / np.sqrt(1 + (speed / _CORNER) ** 2))
        return np.where(speed <= self.speed * (1 + _ROUNDING), self.peak, 0.0)

    @property
    def shaft(self) -> float:
        """Diameter of its shaft [m]."""
        return next(shaft for face, shaft in _SHAFTS if self.face <= face + 0.1 * mm)

    @property
    def length(self) -> float:
        """Length of its body [m]: of its mass at `BULK` over its flange."""
        return self.mass / (BULK * self.face**2)


BULK = 4500.0
"""Mass of a motor over its flange times its length [kg/m³]: mean of makers' tables, within a fifth."""

_NEMA = {"NEMA 17": 42.3 * mm, "NEMA 23": 57.2 * mm, "NEMA 34": 86.4 * mm, "NEMA 42": 107.9 * mm}
"""Sides of steppers' flanges [NEMA ICS 16]."""

_FLANGES = (
    (30.0, 25 * mm),
    (100.0, 40 * mm),
    (400.0, 60 * mm),
    (750.0, 80 * mm),
    (2000.0, 130 * mm),
    (7500.0, 180 * mm),
)
"""Largest power [W] of servos with a flange of a side [m]; above: 220 mm. Usual sizes, makers differ."""

FLANGE_HOLES = {
    side * mm: (pitch * mm, thread, tapped)
    for side, pitch, thread, tapped in (
        (25, 28 / math.sqrt(2), "M2.5", False),
        (40, 46 / math.sqrt(2), "M4", False),
        (42.3, 31.0, "M3", True),
        (57.2, 47.14, "M4", False),
        (60, 70 / math.sqrt(2), "M5", False),
        (80, 90 / math.sqrt(2), "M6", False),
        (86.4, 69.6, "M6", False),
        (107.9, 88.9, "M8", False),
        (130, 145 / math.sqrt(2), "M8", False),
        (180, 200 / math.sqrt(2), "M12", False),
        (220, 235 / math.sqrt(2), "M12", False),
    )
}
"""By the side of a flange: distance of neighbouring holes of its four [m], their screws, and whether they are threads
[NEMA ICS 16; usual pitch circles of servos].
"""

_SHAFTS = tuple(
    (face * mm, shaft * mm)
    for face, shaft in (
        *((25, 5), (40, 8), (42.3, 5), (57.2, 6.35), (60, 14), (80, 19), (86.4, 14), (107.9, 19)),
        *((130, 24), (180, 35), (220, 42)),
    )
)
"""Flanges of motors with the usual diameters of their shafts [m]: NEMA ICS 16, and makers of servos."""

_ROUNDING = 1e-9
_STEPPER_SPEED = 300 * rpm
_LEFT = 2 / 3
_CORNER = _STEPPER_SPEED / math.sqrt(_LEFT**-2 - 1)


def _stepper(frame: str, torque: float, inertia: float, mass: float) -> Motor:
    return Motor(
        f"stepper {frame}, {torque:g} N m",
        STEPPER,
        torque,
        _STEPPER_SPEED,
        torque / _LEFT,
        inertia * 1e-4,
        mass,
        _NEMA[frame],
    )


def _servo(power: float, turns: float, peak: float, inertia: float, mass: float) -> Motor:
    torque = power / (turns * rpm)
    name = f"servo {power:g} W, {turns:g} rpm, {torque:.3g} N m"
    flange = next((side for most, side in _FLANGES if power <= most), 220 * mm)
    return Motor(name, SERVO, torque, turns * rpm, peak * torque, inertia * 1e-4, mass, flange)


MOTORS = (
    _stepper("NEMA 17", 0.4, 0.08, 0.40),
    _stepper("NEMA 23", 1.0, 0.30, 0.80),
    _stepper("NEMA 23", 2.0, 0.80, 1.60),
    _stepper("NEMA 34", 4.0, 2.0, 2.8),
    _stepper("NEMA 34", 7.0, 4.0, 5.0),
    _stepper("NEMA 42", 12.0, 11.0, 9.0),
    _servo(10.0, 3000.0, 3.0, 0.003, 0.12),
    _servo(20.0, 3000.0, 3.0, 0.006, 0.14),
    _servo(30.0, 3000.0, 3.0, 0.008, 0.16),
    _servo(100.0, 3000.0, 3.0, 0.05, 0.5),
    _servo(200.0, 3000.0, 3.0, 0.16, 0.9),
    _servo(400.0, 3000.0, 3.0, 0.28, 1.3),
    _servo(750.0, 3000.0, 3.0, 1.0, 2.5),
    _servo(1000.0, 3000.0, 3.0, 2.0, 4.0),
    _servo(1500.0, 3000.0, 3.0, 2.8, 5.0),
    _servo(2000.0, 3000.0, 3.0, 4.0, 6.5),
    _servo(3000.0, 3000.0, 3.0, 6.5, 9.0),
    _servo(2900.0, 1500.0, 2.5, 46.0, 15.0),
    _servo(4400.0, 1500.0, 2.5, 68.0, 20.0),
    _servo(5500.0, 1500.0, 2.5, 89.0, 25.0),
    _servo(7500.0, 1500.0, 2.5, 125.0, 35.0),
    _servo(11000.0, 1500.0, 2.5, 281.0, 58.0),
    _servo(15000.0, 1500.0, 2.5, 315.0, 70.0),
)
"""Available classes. Steppers: torque at 300 rpm, two thirds of the holding torque. Servos: rated power and speed,
torque = power / speed, peak 2.5 or 3 times the torque. Inertia (written in kg cm²) and mass are mean values of
catalogues; those of a maker may differ by a third."""


def find_motor(name: str) -> Motor:
    """The motor of a name. Raises ParameterError with the nearest name for an unknown one.

    >>> find_motor("servo 400 W, 3000 rpm, 1.27 N m").mass
    1.3
    """
    return pick({motor.name: motor for motor in MOTORS}, name, "motor")


def smallest_motor(torque: float, speed: float = 0.0, kind: str | None = None) -> Motor | None:
    """The motor of least power in `MOTORS` with a torque [N m] at a speed [rad/s]; None if none has it.

    kind  "stepper" or "servo"; default: either
    >>> smallest_motor(6.5).name
    'stepper NEMA 34, 7 N m'
    """
    least = torque * (1 - _ROUNDING), speed * (1 - _ROUNDING)
    enough = [m for m in MOTORS if m.torque >= least[0] and m.speed >= least[1] and kind in (None, m.kind)]
    return min(enough, key=lambda motor: motor.power, default=None)


def geared_motor(
    torque: float, speed: float, reducers: Sequence[Reducer], kind: str | None = None
) -> tuple[Motor, Reducer] | None:
    """The motor of least power with the first sufficient reducer; None if no motor is sufficient.

    torque, speed  at the output of the reducer [N m, rad/s]      kind  "stepper" or "servo"; default: either

    >>> motor, gear = geared_motor(20.0, 1.0, [Reducer(ratio, 0.9) for ratio in (10, 50, 100)], "servo")
    >>> motor.name, gear.ratio
    ('servo 100 W, 3000 rpm, 0.318 N m', 100)
    """
    found = [(smallest_motor(by.motor_torque(torque), by.ratio * speed, kind), by) for by in reducers]
    pairs = [(motor, by) for motor, by in found if motor is not None]
    return min(pairs, key=lambda pair: pair[0].power, default=None)


def strongest_motor(speed: float) -> Motor:
    """The motor of `MOTORS` with the greatest torque at a speed [rad/s]; above all their speeds the quickest.

    >>> strongest_motor(0.0).name
    'servo 15000 W, 1500 rpm, 95.5 N m'
    """
    enough = [motor for motor in MOTORS if motor.speed >= speed * (1 - _ROUNDING)]
    return max(enough, key=lambda motor: motor.torque) if enough else max(MOTORS, key=lambda motor: motor.speed)


def most_torque(speed: float) -> float:
    """Greatest continuous torque [N m] of the motors in `MOTORS` at a speed [rad/s]; 0 above all their speeds.

    >>> most_torque(1e6)
    0.0
    """
    return max((motor.torque for motor in MOTORS if motor.speed >= speed), default=0.0)
