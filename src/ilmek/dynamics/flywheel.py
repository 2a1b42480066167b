"""Torque demand of a machine over one turn, and the flywheel that limits its speed fluctuation.

    W(theta) = ∫ (T - T_mean) dtheta,    excess = max W - min W,    J = excess / (delta omega²)

with delta = (omega_max - omega_min) / omega, omega the mean of both [Norton, Design of Machinery, section 11.11]. W has
its extrema where the torque crosses its mean or jumps across it. These angles are computed exactly, not by sampling.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError
from ilmek.num.piecewise import Extremum, SidedCurve, around, crossings, integrals, suprema
from ilmek.units import turn

PARTS, MAX_PARTS = 32, 8192
ACCURACY = 1e-10


@dataclass(frozen=True, slots=True)
class CyclicTorque:
    """Characteristic values of a torque over one turn.

    mean, rms          [N m]
    peak               greatest magnitude [N m] and its angle [rad]
    excess             max W - min W [J]
    slowest, fastest   angles [rad] at which a shaft under a constant driving torque is slowest (W greatest) and
                       fastest (W least)
    """

    mean: float
    rms: float
    peak: Extremum
    excess: float
    slowest: float
    fastest: float


def cyclic_torque(torque: SidedCurve, breaks: Iterable[float] = ()) -> CyclicTorque:
    """Mean, rms, peak and excess work of the torque that a machine requires at constant speed.

    torque  torque [N m] as a function of crank angle [rad] and side (+1, -1), smooth between the breaks
    breaks  crank angles [rad] where the torque or one of its derivatives jumps; default: none

    The parts of the turn are halved until mean and rms change by less than 1e-10 relative, at most to 8,192 parts: a
    torque peak near a toggle position requires this.
    """
    breaks = tuple(breaks)
    peak = suprema(lambda angle, side: {"size": np.abs(torque(angle, side))}, around(breaks))["size"]
    parts, found = PARTS, _means(torque, breaks, PARTS)
    while parts < MAX_PARTS:
        parts, before, found = 2 * parts, found, _means(torque, breaks, 2 * parts)
        if np.allclose(found, before, rtol=ACCURACY, atol=ACCURACY * peak.value):
            break
    mean, rms = found
    return CyclicTorque(mean, rms, peak, *_excess(torque, breaks, parts // 2, mean))


def _means(torque: SidedCurve, breaks: tuple[float, ...], parts: int) -> tuple[float, float]:
    """Mean and root mean square over one turn [N m]."""

    def powers(angle: FloatArray, side: FloatArray) -> dict[str, FloatArray]:
        value = torque(angle, side)
        return {"once": value, "squared": value**2}

    sums = integrals(powers, around(breaks, parts=parts))
    return math.fsum(sums["once"]) / turn, math.sqrt(math.fsum(sums["squared"]) / turn)


def _excess(torque: SidedCurve, breaks: tuple[float, ...], parts: int, mean: float) -> tuple[float, float, float]:
    """Excess work [J], and the angles [rad] where W is greatest and least."""
    even = crossings(torque, around(breaks, parts=parts), mean).tolist()
    pieces = around((*breaks, *even), parts=parts)
    above = integrals(lambda angle, side: {"above": torque(angle, side) - mean}, pieces)["above"]
    work = np.concatenate(([0.0], np.cumsum(above)))
    at = np.append(pieces.starts, pieces.ends[-1])
    most, least = int(np.argmax(work)), int(np.argmin(work))
    return float(work[most] - work[least]), float(at[most] % turn), float(at[least] % turn)


def flywheel(excess: float, speed: float, fluctuation: float) -> float:
    """Moment of inertia that limits the speed fluctuation of a shaft: J = excess / (delta omega²) [kg m²].

    excess       excess work of the torque over one turn [J]; see `cyclic_torque`
    speed        mean speed omega [rad/s]
    fluctuation  delta = (omega_max - omega_min) / omega [1], above 0 and below 2

    J includes all parts that rotate with the shaft: motor rotor, gears and flywheel. Raises MechanismError for a
    fluctuation outside its range or a speed of 0.
    >>> flywheel(100.0, 10.0, 0.02)
    50.0
    """
    if not 0 < fluctuation < 2:
        raise MechanismError(f"speed fluctuation is {fluctuation:g}", allowed="above 0, below 2")
    if speed == 0:
        raise MechanismError("speed of the flywheel is 0", do="give a speed")
    return excess / (fluctuation * speed**2)
