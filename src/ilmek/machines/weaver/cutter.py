"""The cutter of the pile yarn: an eccentric on its motor's shaft moves a blade across the yarn in its eye, and back.

    s = e (1 - cos q),   q = a t² / 2 to the middle of half a turn, then slower alike;   2 e = LAP d

d is the yarn's diameter. The blade crosses it about the middle of half a turn that takes the time T, in the time

    T (1 - sqrt(2 q1 / pi)),   cos q1 = 1 / LAP

The motor turns its rotor and the eccentric, and bears F e sin q while the blade crosses, where F cuts all fibres of the
yarn at once. The blade's inertia, some thousandths of the rotor's, is neglected.          [virtual work; derived]
"""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.duty import LoadCycle

LAP = 1.2
"""Stroke of the blade over the yarn's diameter; assumed by this project."""

_MET = math.acos(1 / LAP)
"""Angle from a dead centre at which the blade meets or leaves the yarn [rad]."""

CROSSED = 1 - math.sqrt(2 * _MET / math.pi)
"""Time in which the blade crosses the yarn, over that of half a turn."""

_SAMPLES = 400


def eccentricity(yarn: float) -> float:
    """Eccentricity [m] for a yarn of a diameter [m]."""
    return LAP * yarn / 2


def half_turn(share: FloatArray) -> FloatArray:
    """Angle of the eccentric [rad] at shares of the time of half a turn, 0 to 1: evenly quicker, then slower.

    >>> (half_turn(np.array([0.0, 0.25, 0.5, 1.0])) / np.pi).tolist()
    [0.0, 0.125, 0.5, 1.0]
    """
    return np.asarray(math.pi * np.where(share < 0.5, 2 * share**2, 1 - 2 * (1 - share) ** 2))


def cut(yarn: float, force: float, time: float, inertia: float) -> LoadCycle:
    """Half a turn that cuts, and half a turn back, as the load of the motor.

    yarn  diameter [m]     force  of the cut [N]     time  of half a turn [s]     inertia  of the eccentric [kg m²]
    """
    share = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    angle, rate = half_turn(share), 4 * math.pi / time**2
    before = share < 0.5
    speed = rate * time * np.where(before, share, 1 - share)
    crossing = np.abs(angle - math.pi / 2) < math.pi / 2 - _MET
    torque = force * eccentricity(yarn) * np.sin(angle) * crossing
    return LoadCycle(
        speed=np.tile(speed, 2),
        acceleration=np.tile(np.where(before, rate, -rate), 2),
        torque=np.concatenate([torque, np.zeros(_SAMPLES)]),
        inertia=inertia,
    )
