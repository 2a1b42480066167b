"""Drives of a loom's machines: their lines in the parts list, and the work of a turn."""

from collections.abc import Callable

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.motors import MOTORS
from ilmek.units import format_quantity, mm, turn

PULLEY = 20 * mm
"""Pitch radius of the pulleys of belt axes [m]: assumed by this project."""

_MIDPOINTS = 1440
"""Midpoints of a turn, a quarter degree apart."""


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
