"""What a torque over a turn asks of the motor, and the flywheel that evens its speed.

    W(theta) = ∫ (T - T_mean) dtheta,    excess = max W - min W,    J = excess / (delta omega²)

with delta = (omega_max - omega_min) / omega, omega the mean of both [Norton, Design of Machinery, section 11.11]. W is
greatest and least where the torque passes its mean or jumps across it: exact there, not at the nearest of some samples.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.peaks import Peak, Piece, pieces, suprema
from ilmek.dynamics.turning import piecewise
from ilmek.errors import MechanismError
from ilmek.units import turn

Torque: TypeAlias = Callable[[FloatArray, FloatArray], FloatArray]
"""Crank angles [rad] and sides (which limit at a jump) -> torque [N m]."""

PARTS, MOST_PARTS = 32, 8192
ACCURACY = 1e-10
ROUNDS = 6
"""Each narrows down a crossing of the mean 16 times; the work stands still there, so that its error is the square."""


@dataclass(frozen=True, slots=True)
class Duty:
    """A torque over a turn.

    mean, rms  [N m]          peak  the greatest size [N m] and where
    excess     work above the mean between the angles [rad] at which a shaft under an even drive is `fastest` and
               `slowest` [J]: W is least and greatest there
    """

    mean: float
    rms: float
    peak: Peak
    excess: float
    slowest: float
    fastest: float


def duty(torque: Torque, breaks: Iterable[float] = ()) -> Duty:
    """Mean, rms, peak and excess work of the torque that a machine asks for at constant speed; `breaks`: see `peaks`.

    Parts of the turn are halved until all of it stands to 1e-10: a torque as sharp as near a toggle needs that.
    """
    breaks = tuple(breaks)
    peak = suprema(lambda angle, side: {"size": np.abs(torque(angle, side))}, breaks)["size"]
    parts, found = PARTS, _means(torque, breaks, PARTS)
    while parts < MOST_PARTS:
        parts, before, found = 2 * parts, found, _means(torque, breaks, 2 * parts)
        if np.allclose(found, before, rtol=ACCURACY, atol=ACCURACY * peak.value):
            break
    mean, rms = found
    return Duty(mean, rms, peak, *_excess(torque, breaks, parts // 2, mean))


def _means(torque: Torque, breaks: tuple[float, ...], parts: int) -> tuple[float, float]:
    """Mean and root mean square over a turn."""

    def powers(angle: FloatArray, side: FloatArray) -> dict[str, FloatArray]:
        value = torque(angle, side)
        return {"once": value, "squared": value**2}

    _, sums = piecewise(powers, breaks, parts)
    return math.fsum(sums["once"]) / turn, math.sqrt(math.fsum(sums["squared"]) / turn)


def _excess(torque: Torque, breaks: tuple[float, ...], parts: int, mean: float) -> tuple[float, float, float]:
    """Excess of work above the mean, and the angles where it is greatest and least."""
    crossings = _crossings(torque, pieces((*breaks, *(turn / parts * np.arange(parts)))), mean)
    cut, above = piecewise(lambda angle, side: {"above": torque(angle, side) - mean}, (*breaks, *crossings), parts)
    work = np.concatenate(([0.0], np.cumsum(above["above"])))
    at = np.array([cut[0].start, *(piece.end for piece in cut)])
    most, least = int(np.argmax(work)), int(np.argmin(work))
    return float(work[most] - work[least]), float(at[most] % turn), float(at[least] % turn)


def _crossings(torque: Torque, cut: tuple[Piece, ...], mean: float) -> list[float]:
    """Angles within the pieces where the torque passes its mean."""
    start = np.array([piece.start for piece in cut])
    end = np.array([piece.end for piece in cut])
    for _ in range(ROUNDS):
        grid = start[:, None] + (end - start)[:, None] * np.linspace(0, 1, 17)
        side = np.where(np.arange(17) < 8, 1.0, -1.0) * np.ones_like(grid)
        high = np.reshape(torque(np.ravel(grid), np.ravel(side)), grid.shape) > mean
        row, column = np.nonzero(high[:, 1:] != high[:, :-1])
        if row.size == 0:
            return []
        start, end = grid[row, column], grid[row, column + 1]
    return [float(middle) for middle in (start + end) / 2]


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
