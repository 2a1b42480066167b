# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Coupler point of a four-bar and its derivatives, for path synthesis: compiled.

    P = z0 + e^{i th0} (r2 u + c e3),    u = e^{i th2},    q = r1 - r2 u = L e^{i alpha}    (A -> B0)
    e3 = e^{i (alpha + branch gamma)},   cos gamma = (r3^2 + L^2 - r4^2) / (2 r3 L)

Ten numbers define a four-bar and its start: see `NAMES`. The crank angle th2 is relative to the ground link.
[Norton, Design of Machinery, section 4.5; the notation of Acharyya and Mandal, Mech. Mach. Theory 44 (2009) 1784]
"""

import math

import numpy as np

from ilmek.arrays import Complex, Float, Int
from ilmek.num.compiled import compiled

NAMES = ("ground", "crank", "coupler", "rocker", "along", "across", "x", "y", "turn", "start")
"""r1, r2, r3, r4 [m]; tracer c in the coupler's frame, from A, x to B [m]; pivot z0 = A0 [m]; angle th0 of the ground
link and crank angle at the start of the timing [rad]."""

SIZE = len(NAMES)
TURN, START = 8, 9

IN_LINE = 1e-9
"""Excess of cos gamma squared over 1 that counts as rounding: coupler and rocker are in line."""

Design = Float[np.ndarray, "10"]
Angles = Float[np.ndarray, " points"]
Points = Complex[np.ndarray, " points"]


@compiled
def _sine(cosine: float) -> float:
    """Sine of gamma, 0 or more; NaN where the four-bar does not close."""
    square = 1.0 - cosine * cosine
    return 0.0 if -IN_LINE < square < 0.0 else math.sqrt(square)


@compiled
def coupler_direction(r1: float, r2: float, r3: float, r4: float, u: complex, branch: int) -> complex:
    """e3 relative to the ground link for a crank along u; link lengths [m]; NaN where the four-bar does not close."""
    qx, qy = r1 - r2 * u.real, -r2 * u.imag
    L = math.sqrt(qx * qx + qy * qy)
    cosine = (r3 * r3 + L * L - r4 * r4) / (2.0 * r3 * L)
    return complex(qx / L, qy / L) * complex(cosine, branch * _sine(cosine))


@compiled
def coupler_point(design: Design, angle: float, branch: int) -> complex:
    """P [m] at one crank angle [rad]; NaN where the four-bar does not close."""
    u = complex(math.cos(angle), math.sin(angle))
    e3 = coupler_direction(design[0], design[1], design[2], design[3], u, branch)
    w = complex(math.cos(design[TURN]), math.sin(design[TURN]))
    point: complex = complex(design[6], design[7]) + w * (design[1] * u + complex(design[4], design[5]) * e3)
    return point


@compiled
def with_slopes(design: Design, angle: float, branch: int, slopes: Complex[np.ndarray, "10"]) -> complex:
    """P [m] at one crank angle [rad]; its derivatives by the ten numbers are written to `slopes`, last by the angle.

    d alpha = Im(dq / q),   dL = Re(conj(q) dq) / L,   d gamma = -d cos gamma / sin gamma
    d cos gamma = (1/r3 - cos gamma / L) dL + (1/L - cos gamma / r3) dr3 - r4 / (r3 L) dr4
    """
    r1, r2, r3, r4 = design[0], design[1], design[2], design[3]
    u = complex(math.cos(angle), math.sin(angle))
    w = complex(math.cos(design[TURN]), math.sin(design[TURN]))
    qx, qy = r1 - r2 * u.real, -r2 * u.imag
    L = math.sqrt(qx * qx + qy * qy)
    unit = complex(qx / L, qy / L)
    cosine = (r3 * r3 + L * L - r4 * r4) / (2.0 * r3 * L)
    sine = branch * max(_sine(cosine), IN_LINE)
    e3 = unit * complex(cosine, sine)
    arm = complex(design[4], design[5]) * e3
    turning = complex(0.0, 1.0) * w * arm
    per_length = (1.0 / r3 - cosine / L) / sine
    # dq by r1, r2 and the angle is 1, -u and -i r2 u, resolved into components along q and to its left.
    ray = u * unit.conjugate()
    slopes[0] = turning * (-unit.imag / L - per_length * unit.real)
    slopes[1] = w * u - turning * (ray.imag / L - per_length * ray.real)
    slopes[2] = turning * (-(1.0 / L - cosine / r3) / sine)
    slopes[3] = turning * (r4 / (r3 * L * sine))
    slopes[4] = w * e3
    slopes[5] = complex(0.0, 1.0) * slopes[4]
    slopes[6], slopes[7] = complex(1.0, 0.0), complex(0.0, 1.0)
    reach = w * (r2 * u + arm)
    slopes[TURN] = complex(0.0, 1.0) * reach
    slopes[START] = complex(0.0, r2) * w * u - turning * (r2 * (ray.real / L + per_length * ray.imag))
    point: complex = complex(design[6], design[7]) + reach
    return point


@compiled
def squared_error(design: Design, angles: Angles, points: Points, branch: int) -> float:
    """Sum of the squared distances [m^2]; NaN where the four-bar does not close at an angle."""
    total = 0.0
    for k in range(points.size):
        gap = coupler_point(design, angles[k], branch) - points[k]
        total += gap.real * gap.real + gap.imag * gap.imag
    return total


@compiled
def normal_equations(
    design: Design,
    angles: Angles,
    points: Points,
    blocks: Int[np.ndarray, " points"],
    branch: int,
    H: Float[np.ndarray, "10 10"],
    g: Design,
    mixed_hessian: Float[np.ndarray, "blocks 10"],
    angle_hessian: Float[np.ndarray, " blocks"],
    angle_gradient: Float[np.ndarray, " blocks"],
) -> None:
    """J^T J and J^T e of half the squared error [m²], written to the last five arguments.

    H, g                           of the ten numbers
    angle_hessian, angle_gradient  of the free angles
    mixed_hessian                  between angles and numbers
    blocks                         index of each point's free angle; -1 for a timed point, whose angle is start + timing
    """
    slopes = np.empty(SIZE, np.complex128)
    H[:] = 0.0
    g[:] = 0.0
    mixed_hessian[:] = 0.0
    angle_hessian[:] = 0.0
    angle_gradient[:] = 0.0
    for k in range(points.size):
        gap = with_slopes(design, angles[k], branch, slopes) - points[k]
        block = blocks[k]
        if block >= 0:
            by_angle = slopes[START]
            angle_hessian[block] += by_angle.real * by_angle.real + by_angle.imag * by_angle.imag
            angle_gradient[block] += by_angle.real * gap.real + by_angle.imag * gap.imag
            slopes[START] = 0.0
            for i in range(SIZE):
                mixed_hessian[block, i] += slopes[i].real * by_angle.real + slopes[i].imag * by_angle.imag
        for i in range(SIZE):
            g[i] += slopes[i].real * gap.real + slopes[i].imag * gap.imag
            for j in range(i + 1):
                H[i, j] += slopes[i].real * slopes[j].real + slopes[i].imag * slopes[j].imag
    for i in range(SIZE):
        for j in range(i):
            H[j, i] = H[i, j]
