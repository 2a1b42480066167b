"""Micro servos and small steppers of 2 to 60 g, for hands and grippers.

    T(w) = T0 (1 - w / w0)

T0 stall torque of a servo, holding torque of a stepper; w0 speed without load. A servo's travel is limited, a stepper's
is not. The rows are typical of makers' data sheets at 4.8 to 6 V for their mass; makers differ by a quarter, so that
they are assumed by this project, as is the line between both ends of a motor's curve.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.elements.motors import SERVO, STEPPER
from ilmek.units import deg, mm

MARGIN = 2.0
"""Torque of a servo at a speed over the load; assumed by this project."""


@dataclass(frozen=True, slots=True)
class MicroServo:
    """A class of small servos or steppers, not a product.

    torque  T0 [N m]      speed  w0 [rad/s]      mass  [kg]      travel  between its stops [rad]; inf: none
    size    length, width and height of its body [m], its shaft along the height, a quarter of the length from an end
    """

    name: str
    kind: str
    torque: float
    speed: float
    mass: float
    travel: float
    size: tuple[float, float, float]

    def torque_at(self, speed: RealField) -> FloatArray:
        """Torque [N m] at a speed [rad/s], 0 beyond its own.

        >>> round(float(MICRO_SERVOS[4].torque_at(MICRO_SERVOS[4].speed / 2)), 4)
        0.088
        """
        return np.asarray(self.torque * np.maximum(1 - np.abs(speed) / self.speed, 0.0))

    def bears(self, torque: FloatArray, speed: FloatArray) -> bool:
        """Whether it has a torque [N m] at a speed [rad/s] at each sample, with `MARGIN`."""
        return bool(np.all(MARGIN * np.abs(torque) <= self.torque_at(speed)))

    @property
    def power(self) -> float:
        """Greatest mechanical power [W]: T0 w0 / 4."""
        return self.torque * self.speed / 4


def _servo(mass: float, torque: float, sixty: float, *size: float) -> MicroServo:
    """A servo of a mass [g], torque [N m], time of 60 degrees [s], and size [mm]."""
    length, width, height = size
    name = f"servo {mass:g} g, {torque:g} N m, {sixty:g} s/60°"
    return MicroServo(
        name, SERVO, torque, 60 * deg / sixty, mass * 1e-3, 180 * deg, (length * mm, width * mm, height * mm)
    )


def _stepper(mass: float, torque: float, speed: float, *size: float) -> MicroServo:
    """A stepper of a mass [g], holding torque [N m], greatest speed [rad/s], diameter or side and length [mm]."""
    side, height = size
    name = f"small stepper {mass:g} g, {torque:g} N m"
    return MicroServo(name, STEPPER, torque, speed, mass * 1e-3, math.inf, (side * mm, side * mm, height * mm))


MICRO_SERVOS = (
    _servo(2.0, 0.007, 0.06, 15, 6, 16),
    _servo(3.7, 0.05, 0.10, 20, 8, 18),
    _servo(4.5, 0.07, 0.10, 20, 8, 20),
    _stepper(5.0, 0.001, 60.0, 10, 12),
    _servo(9.0, 0.176, 0.10, 23, 12, 26),
    _stepper(12.0, 0.004, 50.0, 15, 14),
    _servo(13.0, 0.216, 0.10, 23, 12, 28),
    _servo(22.0, 0.30, 0.14, 29, 13, 30),
    _stepper(25.0, 0.012, 45.0, 20, 18),
    _servo(28.0, 0.44, 0.12, 29, 13, 30),
    _stepper(37.0, 0.034, 1.6, 28, 19),
    _servo(43.0, 0.32, 0.19, 40, 20, 38),
    _servo(55.0, 0.92, 0.17, 40, 20, 40),
    _servo(60.0, 1.9, 0.16, 40, 20, 41),
    _stepper(60.0, 0.018, 60.0, 20, 30),
)
"""The rows in the order of their masses."""


def lightest_servo(
    torque: FloatArray, speed: FloatArray, swing: float, heaviest: float = math.inf, rows: Sequence[MicroServo] = ()
) -> MicroServo | None:
    """The lightest row for a load: torque [N m] and speed [rad/s] at its samples, over a swing [rad]; None: none does.

    heaviest  mass [kg]      rows  default: all

    >>> lightest_servo(np.array([0.05]), np.array([2.0]), 1.0).name
    'servo 9 g, 0.176 N m, 0.1 s/60°'
    """
    return next(
        (
            row
            for row in rows or MICRO_SERVOS
            if row.mass <= heaviest * (1 + 1e-9) and row.travel >= swing and row.bears(torque, speed)
        ),
        None,
    )
