"""What a torque over a turn asks of the motor, and the flywheel that evens its speed.

    W(theta) = ∫ (T - T_mean) dtheta,    excess = max W - min W,    J = excess / (delta omega²)

with delta = (omega_max - omega_min) / omega, omega the mean of both [Norton, Design of Machinery, section 11.11]. W is
greatest and least where the torque passes its mean or jumps across it: exact there, not at the nearest of some samples.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError
from ilmek.num.piecewise import Extremum, SidedCurve, around, crossings, integrals, suprema
from ilmek.units import turn

PARTS, MOST_PARTS = 32, 8192
ACCURACY = 1e-10


@dataclass(frozen=True, slots=True)
class CyclicTorque:
    """A torque over a turn.

    mean, rms  [N m]          peak  the greatest size [N m] and where
    excess     work above the mean between the angles [rad] at which a shaft under an even drive is `fastest` and
               `slowest` [J]: W is least and greatest there
    """

    mean: float
    rms: float
    peak: Extremum
    excess: float
    slowest: float
    fastest: float


def duty(torque: SidedCurve, breaks: Iterable[float] = ()) -> CyclicTorque:
    """Mean, rms, peak and excess work of the torque that a machine asks for at constant speed.

    torque  [N m] at crank angles [rad] and sides, smooth between the `breaks` [rad]

    Parts of the turn are halved until all of it stands to 1e-10: a torque as sharp as near a toggle needs that.
    """
    breaks = tuple(breaks)
    peak = suprema(lambda angle, side: {"size": np.abs(torque(angle, side))}, around(breaks))["size"]
    parts, found = PARTS, _means(torque, breaks, PARTS)
    while parts < MOST_PARTS:
        parts, before, found = 2 * parts, found, _means(torque, breaks, 2 * parts)
        if np.allclose(found, before, rtol=ACCURACY, atol=ACCURACY * peak.value):
            break
    mean, rms = found
    return CyclicTorque(mean, rms, peak, *_excess(torque, breaks, parts // 2, mean))


def _means(torque: SidedCurve, breaks: tuple[float, ...], parts: int) -> tuple[float, float]:
    """Mean and root mean square over a turn."""

    def powers(angle: FloatArray, side: FloatArray) -> dict[str, FloatArray]:
        value = torque(angle, side)
        return {"once": value, "squared": value**2}

    sums = integrals(powers, around(breaks, parts=parts))
    return math.fsum(sums["once"]) / turn, math.sqrt(math.fsum(sums["squared"]) / turn)


def _excess(torque: SidedCurve, breaks: tuple[float, ...], parts: int, mean: float) -> tuple[float, float, float]:
    """Excess of work above the mean, and the angles where it is greatest and least."""
    even = crossings(torque, around(breaks, parts=parts), mean).tolist()
    pieces = around((*breaks, *even), parts=parts)
    above = integrals(lambda angle, side: {"above": torque(angle, side) - mean}, pieces)["above"]
    work = np.concatenate(([0.0], np.cumsum(above)))
    at = np.append(pieces.starts, pieces.ends[-1])
    most, least = int(np.argmax(work)), int(np.argmin(work))
    return float(work[most] - work[least]), float(at[most] % turn), float(at[least] % turn)


def flywheel(excess: float, speed: float, fluctuation: float) -> float:
    """Moment of inertia [kg m²] that keeps the speed within `fluctuation` delta of its mean [rad/s].

    It is that of everything that turns with the shaft evenly, the rotor and the wheels among it. Raises MechanismError
    for a fluctuation that is not between 0 and 2, or a speed of 0.
    >>> flywheel(100.0, 10.0, 0.02)
    50.0
    """
    if not 0 < fluctuation < 2:
        raise MechanismError(f"fluctuation of the speed is {fluctuation:g}", allowed="above 0, below 2")
    if speed == 0:
        raise MechanismError("a flywheel that stands evens nothing", do="give a speed")
    return excess / (fluctuation * speed**2)
