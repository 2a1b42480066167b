# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Overall size of a four-bar over the turn of its crank, and the penalty that keeps it within a limit: compiled.

    S = max |p - q|,    p, q of A0, B0 and of A, B, P at 36 crank angles
    penalty = 10 n max(0, S - 0.99 S_max)^2          n points

The derivative of S is that of the distance of the two points that are farthest apart. The samples miss less than 0.5 %
of S, and the penalty is exceeded by less: so that the limit itself is kept.                           [this project]
"""

import math

import numpy as np

from ilmek.arrays import Complex, Float
from ilmek.num.compiled import compiled
from ilmek.synthesis.path.model import SIZE, START, TURN, Angles, Design, Points, squared_error, with_slopes

SAMPLES = 36
"""Crank angles of a turn."""

WEIGHT, RESERVE = 10.0, 0.99
"""Weight of the penalty for each point, and share of the limit from which it counts."""

PINS = 3 * SAMPLES
"""Number of positions of A, B and P; those of A0 and B0 follow."""


@compiled
def extent(design: Design, branch: int, slopes: Design) -> float:
    """S [m]; its derivatives by the ten numbers are written to `slopes`."""
    at, own = np.empty(PINS + 2, np.complex128), np.empty(SIZE, np.complex128)
    for k in range(PINS):
        at[k] = _pin(design, k, branch, own)
    at[PINS] = complex(design[6], design[7])
    at[PINS + 1] = at[PINS] + design[0] * complex(math.cos(design[TURN]), math.sin(design[TURN]))
    one, other, square = 0, 0, 0.0
    for i in range(PINS + 2):
        for j in range(i):
            gap = at[i] - at[j]
            apart = gap.real * gap.real + gap.imag * gap.imag
            if apart > square:
                one, other, square = i, j, apart
    size = math.sqrt(square)
    slopes[:] = 0.0
    _add_slopes(design, one, branch, (at[one] - at[other]) / size, slopes)
    _add_slopes(design, other, branch, (at[other] - at[one]) / size, slopes)
    return size


@compiled
def _add_slopes(design: Design, pin: int, branch: int, ray: complex, slopes: Design) -> None:
    """Add the derivatives of a pin's component along `ray`."""
    own = np.zeros(SIZE, np.complex128)
    if pin < PINS:
        _pin(design, pin, branch, own)
    else:
        own[6], own[7] = complex(1.0, 0.0), complex(0.0, 1.0)
        if pin > PINS:
            own[0] = complex(math.cos(design[TURN]), math.sin(design[TURN]))
            own[TURN] = complex(0.0, design[0]) * own[0]
    for i in range(SIZE):
        slopes[i] += own[i].real * ray.real + own[i].imag * ray.imag


@compiled
def _pin(design: Design, pin: int, branch: int, slopes: Complex[np.ndarray, "10"]) -> complex:
    """Position of A, B or P by its number [m], and its derivatives by the ten numbers."""
    of = design.copy()
    if pin < 2 * SAMPLES:
        of[4], of[5] = design[2] if pin >= SAMPLES else 0.0, 0.0
    point: complex = with_slopes(of, 2.0 * math.pi * (pin % SAMPLES) / SAMPLES, branch, slopes)
    if SAMPLES <= pin < 2 * SAMPLES:
        slopes[2] += slopes[4]
    if pin < 2 * SAMPLES:
        slopes[4] = slopes[5] = complex(0.0, 0.0)
    slopes[START] = complex(0.0, 0.0)
    return point


@compiled
def penalised(design: Design, angles: Angles, points: Points, branch: int, size_max: float) -> float:
    """Squared error with the penalty [m²]; NaN where the four-bar does not close at an angle."""
    error = squared_error(design, angles, points, branch)
    if not math.isfinite(size_max):
        return error
    over = extent(design, branch, np.empty(SIZE)) - RESERVE * size_max
    return error + WEIGHT * points.size * over * over if over > 0.0 else error


@compiled
def add_penalty(
    design: Design, branch: int, size_max: float, points: int, H: Float[np.ndarray, "10 10"], g: Design
) -> None:
    """Add the penalty to the normal equations of half the squared error."""
    slopes = np.empty(SIZE)
    over = extent(design, branch, slopes) - RESERVE * size_max
    if over > 0.0:
        weight = WEIGHT * points
        for i in range(SIZE):
            g[i] += weight * over * slopes[i]
            for j in range(SIZE):
                H[i, j] += weight * slopes[i] * slopes[j]
