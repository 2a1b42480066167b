"""Inertia forces and the two systems of linear equations of the tufting paper.

The inertia forces are tested with the derivatives of momentum and angular momentum over a turn, taken from positions
alone; the systems with the forces of the engine.
"""

from collections.abc import Sequence
from functools import cache, partial

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.structure import plan
from ilmek.machines.tufting import TuftingParams
from ilmek.machines.tufting.model import inertias, mechanism, move
from ilmek.units import turn
from ilmek.verification.claim import COUNT, Claim, equation, residual
from ilmek.verification.tufting_equations import BODIES, sample

SAMPLES = 128
"""Over a turn; its harmonics vanish far below."""


def claims() -> tuple[Claim, ...]:
    """Eqs 21, 24, 27, 34, 37 of inertia, and the systems of Eqs 29 to 32 and 40 to 43."""
    return (*_inertia(), *_systems(), *_columns())


_equation = partial(equation, "tufting", "Eq {}")


def _inertia() -> tuple[Claim, ...]:
    rows = {"21": 1, "24": 2, "27": 3, "34": 4, "37": 5}
    return tuple(
        _equation(number, f"F_l{k} = -m{k} a_s{k},  M{k} = -J_s{k} α{k}", partial(_of_momentum, k))
        for number, k in rows.items()
    )


def _of_momentum(k: int) -> float:
    """Residual of the inertia force and moment of a link against the rates of its momentum and angular momentum.

    The moments are compared by the greatest of all links: the crank has none.
    """
    params = TuftingParams()
    angle = np.arange(SAMPLES) * turn / SAMPLES
    motion, inertia = move(params, plan(mechanism(params)), angle), inertias(params)[BODIES[k - 1]]
    centre = motion.carried(BODIES[k - 1], inertia.centre)
    turning = np.unwrap(np.asarray(motion.angle(BODIES[k - 1]))) - (angle if k == 1 else 0.0)
    force = -inertia.mass * _second_rate(centre.position, params.speed)
    moment = -inertia.moment * np.real(_second_rate(turning, params.speed))
    most = max(float(np.max(np.abs(sample().moment[link]))) for link in sample().moment)
    off = np.max(np.abs(moment + inertia.moment * np.asarray(motion.alpha(BODIES[k - 1])))) / most
    return max(residual(force, -inertia.mass * centre.acceleration), float(off))


def _second_rate(values: ComplexArray | FloatArray, speed: float) -> ComplexArray:
    """Second derivative with respect to time of a periodic curve, by its Fourier series."""
    order = np.fft.fftfreq(len(values), 1 / len(values)) * speed
    return np.asarray(np.fft.ifft(-(order**2) * np.fft.fft(values)))


def _systems() -> tuple[Claim, ...]:
    return (
        _equation("29 to 32", "A F_R1 = B, without the column of zeros", _first_system),
        _equation(
            "40 to 43",
            "C F_R2 = D, without the column of zeros, moving down",
            partial(_second_system, -1),
            mended=partial(_second_system, 1),
            slips=("sign of M4",),
        ),
    )


@cache
def _points() -> dict[str, ComplexArray]:
    """Joints and mass centres over a turn."""
    motion = sample().state.motion
    joints = {"O": "crank", "A": "crank", "B": "coupler", "C": "rocker", "D": "arm", "E": "rod"}
    points = {joint: np.asarray(motion.point(body, joint).position) for joint, body in joints.items()}
    return points | {f"s{k}": sample().centre[k] for k in sample().centre}


def _arm(to: str, start: str) -> tuple[FloatArray, FloatArray]:
    """Components of a vector between two points."""
    span = _points()[to] - _points()[start]
    return span.real, span.imag


def _given(k: int) -> tuple[FloatArray, FloatArray]:
    """Components of -F_lk with the weight: the sum of the joints' forces on the link."""
    mass = inertias(sample().params)[BODIES[k - 1]].mass
    force = mass * (sample().acceleration[k] + 1j * sample().params.gravity)
    return force.real, force.imag


def _force(joint: str, body: str) -> tuple[FloatArray, FloatArray]:
    force = np.asarray(sample().state.forces.pin(joint, on=body))
    return force.real, force.imag


def _row(terms: Sequence[tuple[FloatArray, FloatArray]], right: FloatArray, largest: FloatArray) -> FloatArray:
    """A row of coefficients and unknowns less its right side, by a magnitude that does not vanish."""
    left = sum((np.asarray(factor * unknown) for factor, unknown in terms), np.zeros_like(right))
    return np.asarray(np.abs(left - right) / np.max(np.abs(largest)))


def _first_system() -> float:
    """Rows of Eqs 30 to 32."""
    one, s = np.ones(len(sample().theta[1])), sample()
    f21x, f21y = _force("A", "crank")
    fox, foy = _force("O", "crank")
    f32x, f32y = _force("B", "coupler")
    fcx, fcy = (np.asarray(part) for part in _shaft_force("rocker"))
    torque, big = -s.state.driven_torque, s.state.joints["C"]
    xa1, ya1 = _arm("A", "s1")
    x1o, y1o = _arm("s1", "O")
    x2a, y2a = _arm("s2", "A")
    xb2, yb2 = _arm("B", "s2")
    x3b, y3b = _arm("s3", "B")
    xc3, yc3 = _arm("C", "s3")
    main = s.state.main_torque
    moments = (
        (((-ya1, f21x), (xa1, f21y), (y1o, fox), (-x1o, foy), (one, main)), -s.moment[1]),
        (((-y2a, f21x), (x2a, f21y), (-yb2, f32x), (xb2, f32y)), -s.moment[2]),
        (((-y3b, f32x), (x3b, f32y), (-yc3, fcx), (xc3, fcy)), -s.moment[3] - torque),
    )
    forces = (
        *(((one, a), (one, b), r) for a, b, r in zip((f21x, f21y), (fox, foy), _given(1), strict=True)),
        *(((-one, a), (one, b), r) for a, b, r in zip((f21x, f21y), (f32x, f32y), _given(2), strict=True)),
        *(((-one, a), (one, b), r) for a, b, r in zip((f32x, f32y), (fcx, fcy), _given(3), strict=True)),
    )
    rows = [_row(terms, right, s.state.driven_torque) for terms, right in moments]
    rows += [_row((one_term, other), right, big) for one_term, other, right in forces]
    return float(np.max(rows))


def _shaft_force(body: str) -> tuple[FloatArray, FloatArray]:
    """Force on rocker or arm in C: of the frame, and of the other one through the driven shaft."""
    s = sample()
    mine = np.asarray(s.state.forces.pin("shaft", on=body))
    force = mine + np.asarray(s.state.forces.pin("C", on="rocker")) if body == "rocker" else mine
    return force.real, force.imag


def _second_system(sign: int) -> float:
    """Rows of Eqs 41 to 43 while the needle moves down; sign of M4."""
    one, s = np.ones(len(sample().theta[1])), sample()
    down = s.state.velocity > 0
    f4x, f4y = _shaft_force("arm")
    f54x, f54y = _force("D", "arm")
    f65x, f65y = _force("E", "rod")
    x4c, y4c = _arm("s4", "C")
    xd4, yd4 = _arm("D", "s4")
    xd5, yd5 = _arm("D", "s5")
    x5e, y5e = _arm("s5", "E")
    torque, across, big = -s.state.driven_torque, s.state.joints["guide"].real, s.state.joints["C"]
    mass, gravity = s.params.needle_mass, s.params.gravity
    moments = (
        (((-y4c, f4x), (x4c, f4y), (yd4, f54x), (-xd4, f54y), (one, torque)), sign * s.moment[4]),
        (((yd5, f54x), (-xd5, f54y), (y5e, f65x), (-x5e, f65y)), -s.moment[5]),
    )
    forces = (
        *(((one, a), (one, b), r) for a, b, r in zip((f4x, f4y), (f54x, f54y), _given(4), strict=True)),
        *(((-one, a), (one, b), r) for a, b, r in zip((f54x, f54y), (f65x, f65y), _given(5), strict=True)),
        ((-one, f65x), (one, across), 0 * one),
        ((-one, f65y), (0 * one, f65y), -mass * s.state.acceleration - s.state.friction + mass * gravity),
    )
    rows = [_row(terms, right, s.state.driven_torque)[down] for terms, right in moments]
    rows += [_row((one_term, other), right, big)[down] for one_term, other, right in forces]
    return float(np.max(rows))


def _columns() -> tuple[Claim, ...]:
    """Unknowns of the two systems: two forces a pin, one across the guide, one torque."""

    def unknowns(pins: int, others: int) -> int:
        return 2 * pins + others

    note, zeros = "the vector of unknowns has {} entries", ("column of zeros",)
    return (
        Claim(
            "tufting",
            "columns of matrix A",
            "10",
            COUNT,
            partial(unknowns, 4, 1),
            "Eq 30, 31",
            note.format(9),
            slips=zeros,
        ),
        Claim(
            "tufting",
            "columns of matrix C",
            "9",
            COUNT,
            partial(unknowns, 3, 2),
            "Eq 41, 42",
            note.format(8),
            slips=zeros,
        ),
    )
