# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Starts of the path search: random four-bars whose other numbers are fitted by linear least squares, compiled.

With random link ratios and crank angles, P is linear in the other numbers:

    P = z0 + a (r2/r1) u + b e3,    a = r1 e^{i th0},   b = c e^{i th0}

so that one linear least squares fit gives size, position, orientation and tracer. [derived from `path.model`]
"""

import math

import numpy as np

from ilmek.arrays import Complex, Float, Int
from ilmek.num.compiled import compiled
from ilmek.num.quadratic import back_solve, cholesky
from ilmek.synthesis.path.limits import TOLERANCE, excess
from ilmek.synthesis.path.model import START, TURN, Angles, Design, Points, coupler_direction, squared_error

RANDOM_NUMBERS = 8
"""Random numbers in [0, 1) per start: branch, first angle, span, sense, two amplitudes and their phases."""

RIDGE = 1e-4
"""Regularisation of size and tracer of a start where the points do not determine them."""

WARP = 0.95
"""Greatest non-uniformity of the crank angle along the path; with 1 the crank would come to rest."""


@compiled
def start_all(
    random: Float[np.ndarray, "starts 8"],
    links: Float[np.ndarray, "starts 4"],
    along: Angles,
    timed: bool,
    closed: bool,
    points: Complex[np.ndarray, " points"],
    low: Design,
    high: Design,
    kind: int,
    kappa: float,
    designs: Float[np.ndarray, "starts 10"],
    angles: Float[np.ndarray, "starts points"],
    branches: Int[np.ndarray, " starts"],
    errors: Float[np.ndarray, " starts"],
) -> None:
    """One start for each row of random numbers, written to the last four arguments.

    links   lengths [m] of ground, crank, coupler, rocker, within the crank's limits; only their ratios count
    along   the timing [rad] where `timed`, otherwise the position of each point along the path, 0 to 1
    errors  squared errors [m²]; inf where the start cannot be brought within the limits
    """
    for k in range(branches.size):
        branches[k] = 1 if random[k, 0] < 0.5 else -1
        for i in range(4):
            designs[k, i] = links[k, i] / links[k, 0]
        _guess_angles(random[k], along, timed, closed, low, high, designs[k], angles[k])
        errors[k] = _fit_rest(designs[k], angles[k], points, branches[k], low, high, kind, kappa)


@compiled
def refit_all(
    angles: Float[np.ndarray, "starts points"],
    branches: Int[np.ndarray, " starts"],
    points: Complex[np.ndarray, " points"],
    low: Design,
    high: Design,
    kind: int,
    kappa: float,
    designs: Float[np.ndarray, "starts 10"],
    errors: Float[np.ndarray, " starts"],
) -> None:
    """Size, position, orientation and tracer fitted to given link ratios and crank angles, written to `designs`.

    designs  their link lengths [m] and `start` are used; errors  as in `start_all`
    """
    for k in range(branches.size):
        ground = designs[k, 0]
        for i in range(4):
            designs[k, i] /= ground
        errors[k] = math.inf
        if excess(designs[k], kind, kappa) <= TOLERANCE:
            errors[k] = _fit_rest(designs[k], angles[k], points, branches[k], low, high, kind, kappa)


@compiled
def _guess_angles(
    random: Float[np.ndarray, "8"],
    along: Angles,
    timed: bool,
    closed: bool,
    low: Design,
    high: Design,
    design: Design,
    angles: Angles,
) -> None:
    """Crank angle at each point: the timing from a random start, or non-uniform along the path in either direction."""
    turn = 2.0 * math.pi
    design[START] = 0.0
    if timed:
        free = low[START] < high[START]
        design[START] = turn * random[1] if free else low[START]
        design[START] = min(max(design[START], low[START]), high[START])
        for k in range(along.size):
            angles[k] = design[START] + along[k]
        return
    span = turn if closed else turn * (0.08 + 0.87 * random[2])
    sense = 1.0 if random[3] < 0.5 else -1.0
    once, twice = WARP * random[4], (WARP - WARP * random[4]) * random[6]
    for k in range(along.size):
        uneven = _wave(along[k], once, turn * random[5]) + 0.5 * _wave(2.0 * along[k], twice, turn * random[7])
        angles[k] = turn * random[1] + sense * span * (along[k] + uneven)


@compiled
def _wave(along: float, warp: float, phase: float) -> float:
    """Lead of the crank as a share of a turn; its slope is between -warp and warp."""
    turn = 2.0 * math.pi
    return warp * (math.sin(turn * along + phase) - math.sin(phase)) / turn


@compiled
def _fit_rest(
    design: Design, angles: Angles, points: Points, branch: int, low: Design, high: Design, kind: int, kappa: float
) -> float:
    """Fit size, position, orientation and tracer by linear least squares, within the bounds; the squared error."""
    upright = low[TURN] == high[TURN]
    ray = complex(math.cos(low[TURN]), math.sin(low[TURN])) if upright else complex(1.0, 0.0)
    columns, left, use = _columns(design, angles, branch, ray), points.copy(), np.ones(6, np.bool_)
    use[1] = not upright
    for i in range(2):
        if low[6 + i] == high[6 + i]:
            use[4 + i] = False
            for k in range(points.size):
                left[k] -= low[6 + i] * columns[4 + i, k]
    found = _least_squares(columns, left, use)
    a = found[0] * ray + complex(0.0, found[1])
    size = math.hypot(a.real, a.imag)
    if size == 0.0 or (upright and found[0] < 0.0):
        return math.inf
    b = complex(found[2], found[3]) * complex(a.real / size, -a.imag / size)
    design[TURN] = low[TURN] if upright else math.atan2(a.imag, a.real)
    design[4], design[5], design[6], design[7] = b.real, b.imag, found[4], found[5]
    if not _sized(design, size, low, high) or not excess(design, kind, kappa) <= TOLERANCE:
        return math.inf
    error = squared_error(design, angles, points, branch)
    return error if error >= 0.0 else math.inf


@compiled
def _columns(design: Design, angles: Angles, branch: int, ray: complex) -> Complex[np.ndarray, "6 points"]:
    """Derivatives of P by Re a, Im a, Re b, Im b, x and y at each angle; Re a along `ray`."""
    columns = np.empty((6, angles.size), np.complex128)
    for k in range(angles.size):
        u = complex(math.cos(angles[k]), math.sin(angles[k]))
        e3 = coupler_direction(1.0, design[1], design[2], design[3], u, branch)
        columns[0, k], columns[1, k] = ray * design[1] * u, complex(0.0, design[1]) * u
        columns[2, k], columns[3, k] = e3, complex(0.0, 1.0) * e3
        columns[4, k], columns[5, k] = complex(1.0, 0.0), complex(0.0, 1.0)
    return columns


@compiled
def _sized(design: Design, size: float, low: Design, high: Design) -> bool:
    """Scale the links to about this size and clip tracer and pivot to their bounds; False where no size fits."""
    smallest, largest = 0.0, math.inf
    for i in range(4):
        smallest, largest = max(smallest, low[i] / design[i]), min(largest, high[i] / design[i])
    size = min(max(size, smallest), largest)
    for i in range(8):
        scaled = design[i] * size if i < 4 else design[i]
        design[i] = min(max(scaled, low[i]), high[i])
    return smallest <= largest * (1.0 + 1e-9)


@compiled
def _least_squares(columns: Complex[np.ndarray, "6 points"], left: Points, use: np.ndarray) -> Float[np.ndarray, "6"]:
    """Real factors of the used columns by regularised least squares against `left`; 0 for the others."""
    normal, found, factor = np.zeros((6, 6)), np.zeros(6), np.empty((6, 6))
    for i in range(6):
        for j in range(6):
            if use[i] and use[j]:
                normal[i, j] = _product(columns[i], columns[j])
        normal[i, i] += RIDGE * left.size if use[i] else 1.0
        if use[i]:
            found[i] = _product(columns[i], left)
    if not cholesky(normal, 6, 1e-14, factor):
        return np.zeros(6)
    back_solve(factor, 6, found)
    return found


@compiled
def _product(one: Points, other: Points) -> float:
    """Sum of the scalar products of planar vectors."""
    total = 0.0
    for k in range(one.size):
        total += one[k].real * other[k].real + one[k].imag * other[k].imag
    return total
