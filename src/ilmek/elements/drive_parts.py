"""Drives of a loom's machines: their lines in the parts list, and the work of a turn."""

from collections.abc import Callable

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.motors import MOTORS, Motor, smallest_motor
from ilmek.report import BillLine
from ilmek.units import format_quantity, mm, turn

PULLEY = 20 * mm
"""Pitch radius of the pulleys of belt axes [m]: assumed by this project."""

_MIDPOINTS = 1440
"""Midpoints of a turn, a quarter degree apart."""


def motor_part(name: str, motor: Motor | None, torque: float, speed: float, number: int = 1) -> BillLine:
    """The line of a motor, which drives an axis of the control.

    motor          of the catalogue; None: a special servo, priced by its power
    torque, speed  required [N m, rad/s]
    """
    if motor is not None:
        return BillLine(name, number, motor.name, "", motor.kind, motor.mass, power=motor.power, drives=1)
    required = f"to measure: {format_quantity(torque, 'Nm', 3)} at {format_quantity(speed, 'rpm', 3)}"
    return BillLine(name, number, required, "", "servo", power=torque * speed, drives=1)


def belt_motor_part(name: str, thrust: float, speed: float, number: int = 1) -> BillLine:
    """The line of the motor of a belt axis, without a reducer, for a thrust [N] at a speed [m/s]."""
    torque, turning = thrust * PULLEY, speed / PULLEY
    return motor_part(name, smallest_motor(torque, turning), torque, turning, number)


def reducer_part(name: str, ratio: float, motor: Motor | None, number: int = 1) -> BillLine:
    """The line of a reducer, priced by the power of its motor."""
    return BillLine(name, number, f"{ratio:g}:1", "", "reducer", power=motor.power if motor else 0.0)


def no_motor(torque: float, speed: float) -> str:
    """Warning that no motor of the catalogue gives a torque [N m] at a speed [rad/s]."""
    largest = max(MOTORS, key=lambda motor: motor.torque).name
    needed, at = format_quantity(torque, "Nm"), format_quantity(speed, "rpm")
    return f"no motor gives {needed} at {at}; the largest is {largest}: set another ratio"


def positive_work(torque: Callable[[FloatArray], FloatArray]) -> float:
    """Work of a turn without recovery [J]: the integral of max(M, 0) over the angle, by midpoints.

    torque  M(q) [N m] at angles q [rad], one value for each
    Negative torques count as 0.     [derived from the definition of work]
    """
    angle = (np.arange(_MIDPOINTS) + 0.5) * turn / _MIDPOINTS
    return float(np.sum(np.maximum(torque(angle), 0.0)) * turn / _MIDPOINTS)
