"""What turns the head's cam shaft: torque of all cams over the turn, and the motor that bears it.

    M(q) = sum F s'         of every cam, springs and brake among it (`cams`)

At a constant speed of the shaft the mean of M over a turn is what the handler's brake takes. Friction comes on top.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.elements import duty as duties
from ilmek.elements.motors import Motor
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.machines.weaver.cams import HeadCam, torque_at
from ilmek.units import turn

SAMPLES = 2880


@dataclass(frozen=True, slots=True)
class CamShaftDrive:
    """The cam shaft's drive.

    torque_max, torque_rms  greatest torque either way and its root mean square [N m]
    power_max  greatest power to and fro [W]     power_mean  [W]      inertia  of the cams [kg m²]
    motor, reducer, duty    of least power that bears the turn; None where none does
    """

    torque_max: float
    torque_rms: float
    power_max: float
    power_mean: float
    inertia: float
    motor: Motor | None
    reducer: Reducer | None
    duty: duties.MotorDuty | None


def drive_for(cams: Sequence[HeadCam], speed: float) -> CamShaftDrive:
    """The drive of a cam shaft with these cams at a speed [rad/s]."""
    angle = np.arange(SAMPLES) * (turn / SAMPLES)
    torque = torque_at(cams, angle)
    most, inertia = float(np.max(np.abs(torque))), sum(cam.inertia for cam in cams)
    even = np.full(SAMPLES, speed)
    found = _smallest(duties.LoadCycle(even, np.zeros(SAMPLES), torque, inertia))
    return CamShaftDrive(
        most,
        math.sqrt(float(np.mean(torque**2))),
        most * speed,
        float(np.mean(torque)) * speed,
        inertia,
        found.motor if found else None,
        found.reducer if found else None,
        found.duty if found else None,
    )


def _smallest(cycle: duties.LoadCycle) -> duties.ServoDrive | None:
    """The motor of least power, with the least ratio at which it bears the cycle."""
    ratios = sorted((DIRECT, *PLANETARY), key=lambda reducer: reducer.ratio)
    found = [duties.size_motor(cycle, (reducer,)) for reducer in ratios]
    return min((one for one in found if one), key=lambda one: one.motor.power, default=None)
