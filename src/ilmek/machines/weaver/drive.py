"""What turns the head's cam shaft: the torque that its tools' inertia asks of one motor.

    M(q) = w^2 sum m (r x')(r x''),   x' and x'' by the cam angle q, r = 1 but for the handler, whose tip it is

At a constant speed of the shaft the mean of M over a turn is 0; friction, springs and the pull of the yarn come on top.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import LAWS
from ilmek.cams.pieces import infimum, integral, supremum
from ilmek.elements.motors import Motor, smallest_motor
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import sample
from ilmek.units import turn


@dataclass(frozen=True, slots=True)
class Drive:
    """Greatest torque of the tools' inertia either way and its root mean square [N m], greatest power [W], and the
    motor on the shaft itself: a stepper, which stands still between knots; None where none is strong or quick enough.
    """

    torque_max: float
    torque_rms: float
    power_max: float
    motor: Motor | None


def inertia_torque(cyclogram: Cyclogram, arms: Mapping[str, float], mass: float, angle: FloatArray) -> FloatArray:
    """Torque on the cam shaft [N m] at cam angles [rad], of tools of one mass [kg]; arms [m] of those that turn."""
    total = np.zeros(angle.shape)
    for track in cyclogram.tracks:
        motion = sample(track, angle)
        total += mass * arms.get(track.name, 1.0) ** 2 * motion.slope * motion.bend
    return total * cyclogram.speed**2


def drive_for(cyclogram: Cyclogram, arms: Mapping[str, float], mass: float) -> Drive:
    """The drive of a head whose every cam moves a tool of the same mass [kg]."""

    def torque(angle: FloatArray) -> FloatArray:
        flat = inertia_torque(cyclogram, arms, mass, np.ravel(angle))
        return np.asarray(np.reshape(flat, angle.shape))

    knots = _knots(cyclogram)
    most = max(supremum(torque, knots).value, -infimum(torque, knots).value)
    rms = math.sqrt(integral(lambda angle: torque(angle) ** 2, knots) / turn)
    return Drive(most, rms, most * cyclogram.speed, smallest_motor(most, cyclogram.speed, kind="stepper"))


def _knots(cyclogram: Cyclogram) -> FloatArray:
    """Cam angles between which every track moves smoothly."""
    parts = [part for track in cyclogram.tracks for part in track.segments]
    inner = [
        part.start + at * (part.end - part.start) for part in parts for at in (0.0, *LAWS[part.law.name].breaks, 1.0)
    ]
    return np.unique(np.clip(np.array([0.0, *inner, turn]), 0.0, turn))
