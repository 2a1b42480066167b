"""What turns the head's cam shaft: torque of all cams over the turn, and the motor that bears it.

    M(q) = sum F s'                                                 of every cam, springs and brake among it (`cams`)
    M(q) = w^2 sum m (r x')(r x''),                                 of the tools' inertia alone, no cams

x' and x'' by the cam angle q, r = 1 but for the handler, whose tip it is. At a constant speed of the shaft the mean of
the second over a turn is 0, and of the first it is what the handler's brake takes. Friction comes on top.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements import duty as duties
from ilmek.elements.motors import Motor
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.machines.weaver.cams import HeadCam, torque_at
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import sample
from ilmek.units import turn

SAMPLES = 2880


@dataclass(frozen=True, slots=True)
class Drive:
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
    duty: duties.Duty | None


def inertia_torque(cyclogram: Cyclogram, arms: Mapping[str, float], mass: float, angle: FloatArray) -> FloatArray:
    """Torque on the cam shaft [N m] at cam angles [rad], of tools of one mass [kg]; arms [m] of those that turn."""
    total = np.zeros(angle.shape)
    for track in cyclogram.tracks:
        motion = sample(track, angle)
        total += mass * arms.get(track.name, 1.0) ** 2 * motion.slope * motion.bend
    return total * cyclogram.speed**2


def drive_for(cams: Sequence[HeadCam], speed: float) -> Drive:
    """The drive of a cam shaft with these cams at a speed [rad/s]."""
    angle = np.arange(SAMPLES) * (turn / SAMPLES)
    torque = torque_at(cams, angle)
    most, inertia = float(np.max(np.abs(torque))), sum(cam.inertia for cam in cams)
    even = np.full(SAMPLES, speed)
    found = _smallest(duties.Cycle(even, np.zeros(SAMPLES), torque, inertia))
    return Drive(
        most,
        math.sqrt(float(np.mean(torque**2))),
        most * speed,
        float(np.mean(torque)) * speed,
        inertia,
        found.motor if found else None,
        found.reducer if found else None,
        found.duty if found else None,
    )


def _smallest(cycle: duties.Cycle) -> duties.Drive | None:
    """The motor of least power, with the least ratio at which it bears the cycle."""
    ratios = sorted((DIRECT, *PLANETARY), key=lambda reducer: reducer.ratio)
    found = [duties.size_motor(cycle, (reducer,)) for reducer in ratios]
    return min((one for one in found if one), key=lambda one: one.motor.power, default=None)
