"""Equations of the tufting paper, tested with the motion and forces of the engine, with friction and weight.

Signs as in the paper: theta3 of C-B, theta4 of C-D; F_ij the force that link i gives to link j; inertia force
-m a, inertia moment M = -J alpha; M_b on the crank and M_r on rod l3, counter-clockwise.
"""

from collections.abc import Mapping
from functools import cache, partial

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.structure import plan
from ilmek.machines.tufting import TuftingParams
from ilmek.machines.tufting.model import TuftingState, evaluate, inertias, mechanism
from ilmek.plane.vectors import cross
from ilmek.records import record
from ilmek.units import deg
from ilmek.verification.claim import Claim, equation, residual

ANGLES = np.linspace(0.0, 2 * np.pi, 41)[:-1] + 3 * deg
BODIES = ("crank", "coupler", "rocker", "arm", "rod")


@record
class Sample:
    """The mechanism at many crank angles: angle, speed and acceleration of links 1 to 5; forces; centres."""

    params: TuftingParams
    state: TuftingState
    theta: Mapping[int, FloatArray]
    omega: Mapping[int, FloatArray]
    alpha: Mapping[int, FloatArray]
    centre: Mapping[int, ComplexArray]
    acceleration: Mapping[int, ComplexArray]
    moment: Mapping[int, FloatArray]


def claims() -> tuple[Claim, ...]:
    """The equations in the paper's order."""
    return (*_kinematics(), *_centres(), *_forces(), *_balances())


_equation = partial(equation, "tufting", "Eq {}")


@cache
def sample() -> Sample:
    """The paper's mechanism, over a turn."""
    params = TuftingParams()
    state = evaluate(params, plan(mechanism(params)), ANGLES)
    motion, inertia = state.motion, inertias(params)
    numbered = dict(enumerate(BODIES, start=1))
    centres = {k: motion.carried(body, inertia[body].centre) for k, body in numbered.items()}
    return Sample(
        params=params,
        state=state,
        theta={k: np.asarray(motion.angle(body)) for k, body in numbered.items()},
        omega={k: np.asarray(motion.omega(body)) for k, body in numbered.items()},
        alpha={k: np.asarray(motion.alpha(body)) for k, body in numbered.items()},
        centre={k: centres[k].position for k in numbered},
        acceleration={k: centres[k].acceleration for k in numbered},
        moment={k: np.asarray(-inertia[body].moment * motion.alpha(body)) for k, body in numbered.items()},
    )


def _unit(k: int) -> ComplexArray:
    return np.asarray(np.exp(1j * sample().theta[k]))


def _kinematics() -> tuple[Claim, ...]:
    return (
        _equation("1", "l1 e^{jθ1} + l2 e^{jθ2} + l3 e^{j(θ3-π)} = x1 + j H1", _eq_1),
        _equation("2 to 8", "θ3 = 3π/2 - φ1 - φ3", _eq_8),
        _equation("9", "sin θ2 = (l3 sin θ3 - l1 sin θ1 + H1)/l2", _eq_9),
        _equation("10, 11", "ω2 = -l1 ω1 sin(θ1-θ3)/(l2 sin(θ2-θ3)),  ω3 = l1 ω1 sin(θ1-θ2)/(l3 sin(θ3-θ2))", _eq_10),
        _equation("12, 13", "α2, α3 from l3 ω3², l1 ω1², l2 ω2²", _eq_12),
        _equation("14", "cos θ5 = (x2 - l4 cos θ4)/l5", _eq_14),
        _equation("14, second line", "l_CF' = l6 - l4 sin θ4 - l5 sin θ5", _eq_14_height),
        _equation("15", "θ4 = θ3 + β1 - 2π", _eq_15),
        _equation(
            "15, text",
            "β1 = angle of rods l4 and l5",
            lambda: residual(_unit(5) / _unit(4), np.full_like(_unit(4), np.exp(1j * sample().params.arm_angle))),
            "of l3 and l4, which are fixed to each other",
            lambda: residual(_unit(4) / _unit(3), np.full_like(_unit(4), np.exp(1j * sample().params.arm_angle))),
        ),
        _equation("16, 17", "ω5 = -l4 ω4 sin θ4/(l5 sin θ5),  v = -l4 ω4 cos θ4 - l5 ω5 cos θ5", _eq_16),
        _equation("18", "α5 = -(l4 α4 sin θ4 + l4 ω4² cos θ4 + l5 ω5² cos θ5)/(l5 sin θ5)", _eq_18),
    )


def _eq_1() -> float:
    p = sample().params
    left = p.crank * _unit(1) + p.coupler * _unit(2) - p.rocker * _unit(3)
    return residual(left, np.full_like(left, complex(p.shaft_distance, p.shaft_height)))


def _eq_8() -> float:
    s, p = sample(), sample().params
    phi1, l_oc = np.arctan(p.shaft_distance / p.shaft_height), np.hypot(p.shaft_distance, p.shaft_height)
    phi4 = np.pi / 2 - phi1 - s.theta[1]
    l_ac = np.sqrt(p.crank**2 + l_oc**2 - 2 * p.crank * l_oc * np.cos(phi4))
    phi2 = np.arcsin(p.crank / l_ac * np.sin(phi4))
    phi3 = np.arccos((l_ac**2 + p.rocker**2 - p.coupler**2) / (2 * l_ac * p.rocker)) - phi2
    return residual(_unit(3), np.exp(1j * (1.5 * np.pi - phi1 - phi3)))


def _eq_9() -> float:
    p = sample().params
    height = p.rocker * _unit(3).imag - p.crank * _unit(1).imag + p.shaft_height
    return residual(_unit(2).imag, height / p.coupler)


def _eq_10() -> float:
    t, w, p = sample().theta, sample().omega, sample().params
    second = -p.crank * w[1] * np.sin(t[1] - t[3]) / (p.coupler * np.sin(t[2] - t[3]))
    third = p.crank * w[1] * np.sin(t[1] - t[2]) / (p.rocker * np.sin(t[3] - t[2]))
    return max(residual(second, w[2]), residual(third, w[3]))


def _eq_12() -> float:
    t, w, p = sample().theta, sample().omega, sample().params
    l1, l2, l3 = p.crank * w[1] ** 2, p.coupler * w[2] ** 2, p.rocker * w[3] ** 2
    second = (l3 - l1 * np.cos(t[1] - t[3]) - l2 * np.cos(t[2] - t[3])) / (p.coupler * np.sin(t[2] - t[3]))
    third = (l2 + l1 * np.cos(t[1] - t[2]) - l3 * np.cos(t[3] - t[2])) / (p.rocker * np.sin(t[3] - t[2]))
    return max(residual(second, sample().alpha[2]), residual(third, sample().alpha[3]))


def _eq_14() -> float:
    p = sample().params
    return residual(_unit(5).real, (p.needle_distance - p.arm * _unit(4).real) / p.rod)


def _eq_14_height() -> float:
    p = sample().params
    return residual(-sample().state.height, p.needle - p.arm * _unit(4).imag - p.rod * _unit(5).imag)


def _eq_15() -> float:
    s = sample()
    turned = residual(_unit(4), np.exp(1j * (s.theta[3] + s.params.arm_angle - 2 * np.pi)))
    return max(turned, residual(s.omega[4], s.omega[3]), residual(s.alpha[4], s.alpha[3]))


def _eq_16() -> float:
    w, p = sample().omega, sample().params
    fifth = -p.arm * w[4] * _unit(4).imag / (p.rod * _unit(5).imag)
    down = -p.arm * w[4] * _unit(4).real - p.rod * w[5] * _unit(5).real
    return max(residual(fifth, w[5]), residual(down, sample().state.velocity))


def _eq_18() -> float:
    w, alpha, p = sample().omega, sample().alpha, sample().params
    top = p.arm * (alpha[4] * _unit(4).imag + w[4] ** 2 * _unit(4).real) + p.rod * w[5] ** 2 * _unit(5).real
    return residual(-top / (p.rod * _unit(5).imag), alpha[5])


def _turned(k: int, power: int = 2) -> ComplexArray:
    """Acceleration of a link's end against its start, by its length: (j alpha - omega²) e^{j theta}."""
    return np.asarray((1j * sample().alpha[k] - sample().omega[k] ** power) * _unit(k))


def _centres() -> tuple[Claim, ...]:
    """Accelerations of the links' mid-points."""
    p = sample().params

    def second(length: float) -> float:
        whole = length * _turned(1) + p.coupler / 2 * _turned(2)
        return residual(whole, sample().acceleration[2])

    def fourth(power: int) -> float:
        return residual(p.arm / 2 * _turned(4, power), sample().acceleration[4])

    return (
        _equation(
            "20", "a_s1 = -l1/2 ω1² e^{jθ1}", lambda: residual(p.crank / 2 * _turned(1), sample().acceleration[1])
        ),
        _equation(
            "23",
            "a_s2 = -l2 ω1² e^{jθ1} - l2/2 ω2² e^{jθ2} + ...",
            partial(second, p.coupler),
            "the first length is the crank's: -l1 ω1² e^{jθ1}",
            partial(second, p.crank),
        ),
        _equation(
            "26",
            "a_s3 = l3/2 (jα3 - ω3²) e^{jθ3}",
            lambda: residual(p.rocker / 2 * _turned(3), sample().acceleration[3]),
        ),
        _equation(
            "33",
            "a_s4 = -l4/2 ω4 e^{jθ4} + j l4/2 α4 e^{jθ4}",
            partial(fourth, 1),
            "ω4², as of every other link; it changes the force in C by 0.8 N, and no torque",
            partial(fourth, 2),
        ),
        _equation(
            "36",
            "a_s5 = l4 (jα4 - ω4²) e^{jθ4} + l5/2 (jα5 - ω5²) e^{jθ5}",
            lambda: residual(p.arm * _turned(4) + p.rod / 2 * _turned(5), sample().acceleration[5]),
        ),
    )


def _forces() -> tuple[Claim, ...]:
    """Rows of forces: what the joints give a link, less its weight, is its mass by its acceleration."""
    rows = {
        "22": (1, "F_21 + F_O - m1 g = -F_1", ("A", "O")),
        "25": (2, "F_32 - F_21 - m2 g = -F_2", ("A", "B")),
        "28": (3, "F_C - F_32 - m3 g = -F_3", ("B", "C", "shaft")),
        "35": (4, "F_54 + F_C - m4 g = -F_4", ("D", "shaft")),
        "38": (5, "F_65 - F_54 - m5 g = -F_5", ("D", "E")),
    }

    def row(k: int, joints: tuple[str, ...]) -> float:
        body, p = BODIES[k - 1], sample().params
        mass = inertias(p)[body].mass
        given = sum(sample().state.forces.pin(joint, on=body) for joint in joints) - 1j * mass * p.gravity
        # By the force in C, the greatest: the link's own sum nearly vanishes.
        return float(
            np.max(np.abs(given - mass * sample().acceleration[k])) / np.max(np.abs(sample().state.joints["C"]))
        )

    def across() -> float:
        return residual(sample().state.forces.pin("E", on="rod").real, sample().state.joints["guide"].real)

    return (
        *(
            _equation(f"{number}, forces", printed, partial(row, k, joints))
            for number, (k, printed, joints) in rows.items()
        ),
        _equation("39, across", "F_65,x - F_F,x = -F_6,x = 0", across),
    )


def _balances() -> tuple[Claim, ...]:
    """Rows of moments about the links' middles, with the engine's forces; and the needle's row."""

    def fourth(sign: int) -> float:
        # Counter-clockwise -(F x arm) makes the row clockwise, so that M_r of l3 stands in it with the same sign.
        row = -_turning(4, "D", "arm") - _turning(4, "shaft", "arm") - sample().state.driven_torque
        return _row(row, sign * sample().moment[4])

    torque = sample().state.driven_torque
    return (
        _equation(
            "22",
            "M_b + moments of F_21, F_O about s1 = -M1",
            lambda: _row(_both(1, "A", "O", "crank") + sample().state.main_torque, -sample().moment[1]),
        ),
        _equation(
            "25",
            "moments of F_32, -F_21 about s2 = -M2",
            lambda: _row(_both(2, "A", "B", "coupler"), -sample().moment[2]),
        ),
        _equation(
            "28",
            "M_r + moments of F_C, -F_32 about s3 = -M3",
            lambda: _row(_both(3, "B", "C", "rocker") + _turning(3, "shaft", "rocker") - torque, -sample().moment[3]),
        ),
        _equation(
            "35 (and 43)",
            "M_r - moments of F_54, F_C about s4 = -M4",
            partial(fourth, -1),
            mended=partial(fourth, 1),
            slips=("sign of M4",),
        ),
        _equation(
            "38", "moments of F_65, -F_54 about s5 = -M5", lambda: _row(_both(5, "D", "E", "rod"), -sample().moment[5])
        ),
        _equation("39", "m6 g - F_r + F_65,y = F_6,y, moving down", _eq_39),
    )


def _turning(k: int, joint: str, body: str) -> FloatArray:
    """Moment of a joint's force on link k about its middle [N m], counter-clockwise."""
    position = sample().state.motion.point(body, joint).position
    return np.asarray(cross(position - sample().centre[k], sample().state.forces.pin(joint, on=body)))


def _both(k: int, one: str, other: str, body: str) -> FloatArray:
    return np.asarray(_turning(k, one, body) + _turning(k, other, body))


def _row(left: FloatArray, right: FloatArray) -> float:
    """Residual of a row of moments, by the greatest moment of its forces: the sum itself nearly vanishes."""
    return float(np.max(np.abs(left - right)) / np.max(np.abs(sample().state.driven_torque)))


def _eq_39() -> float:
    s = sample()
    down = s.state.velocity > 0
    on_rod = s.state.forces.pin("E", on="rod").imag
    left = s.params.needle_mass * s.params.gravity - s.state.friction + on_rod
    inertia_force = s.params.needle_mass * s.state.acceleration
    return float(np.max(np.abs(left - inertia_force)[down]) / np.max(np.abs(on_rod)))
