"""Knotting report, section 3: the equations of the four-bar, tested on the machine's motion away from its dead points.

The ground lies at 180° - theta0; the crank turns at a constant speed.
"""

from functools import cache, partial
from typing import NamedTuple

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.knotting_four_bar.model import closing_ground, mechanism
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.units import deg, mm
from ilmek.verification.claim import Claim, equation, residual


class ReportPoses(NamedTuple):
    """Lengths, angles, speeds and accelerations by the report's symbols; th0 = 180° - direction of the ground."""

    r: tuple[float, float, float, float]
    th0: float
    t: tuple[FloatArray, FloatArray, FloatArray]
    w: tuple[FloatArray, FloatArray, FloatArray]
    al: tuple[FloatArray, FloatArray, FloatArray]
    s: FloatArray
    ths: FloatArray


@cache
def poses() -> ReportPoses:
    """The machine's four-bar from 5 to 20 deg short of the quoted crank angle."""
    params = KnottingFourBarParams()
    ground = closing_ground(params)
    angle = params.stated_crank_angle - np.linspace(5.0, 20.0, 16) * deg
    motion = solve(plan(mechanism(params, ground)), angle, 2.0).require()
    bodies = "crank", "coupler", "rocker"
    t1, t2, t3 = (np.asarray(motion.angle(body)) for body in bodies)
    w1, w2, w3 = (np.asarray(motion.omega(body)) for body in bodies)
    a1, a2, a3 = (np.asarray(motion.alpha(body)) for body in bodies)
    far = motion.point("coupler", "O2'").position
    lengths = params.ground, params.crank, params.coupler, params.rocker
    return ReportPoses(
        lengths,
        np.pi - ground,
        (t1, t2, t3),
        (w1, w2, w3),
        (a1, a2, a3),
        np.asarray(np.abs(far)),
        np.asarray(np.angle(far)),
    )


def speeds_by_report(th3: float) -> tuple[float, float]:
    """omega2, omega3 by omega1 [report 3] in the quoted pose, with a theta3 of its choice [rad]."""
    params = KnottingFourBarParams()
    t1, t2 = params.stated_crank_angle, params.stated_coupler_angle
    w2 = -params.crank / params.coupler * np.sin(t1 - th3) / np.sin(t2 - th3)
    return float(w2), float(params.crank / params.rocker * np.sin(t1 - t2) / np.sin(th3 - t2))


def claims() -> tuple[Claim, ...]:
    """The equations, in the report's order."""
    return (*_diagonal(), *_closure(), *_speed())


_equation = partial(equation, "knotting", "3, kinematic analysis")


def _diagonal() -> tuple[Claim, ...]:
    (_, r1, r2, _), _, (t1, t2, _), _, _, s, ths = poses()
    squares = r1**2 + r2**2

    def with_stray(stray: FloatArray | float) -> float:
        parts = np.cos(t1) * np.cos(t2) + stray * np.sin(t1) * np.sin(t2)
        return residual(s**2, squares + 2 * r1 * r2 * parts)

    return (
        _equation(
            "square of s",
            "s² = r1² + r2² + 2 r1 r2 cos θ1 cos θ2 + 2 r1 r2 s sin θ1 sin θ2",
            lambda: with_stray(s / mm),
            "a stray s in the last term",
            lambda: with_stray(1.0),
        ),
        _equation(
            "size of s",
            "s = √(r1² + r2² + 2 r1 r2 cos(θ1-θ2))",
            lambda: residual(s, np.sqrt(squares + 2 * r1 * r2 * np.cos(t1 - t2))),
        ),
        _equation(
            "direction of s",
            "tan θs = (r1 sin θ1 + r2 sin θ2)/(r1 cos θ1 + r2 cos θ2)",
            lambda: residual(np.tan(ths) * (r1 * np.cos(t1) + r2 * np.cos(t2)), r1 * np.sin(t1) + r2 * np.sin(t2)),
        ),
    )


def _closure() -> tuple[Claim, ...]:
    (r0, _, _, r3), th0, (_, _, t3), _, _, s, ths = poses()
    turn, between = ths + th0, t3 - ths
    return (
        _equation(
            "closure along s",
            "r3 cos(θ3-θs) = s + r0 cos(θ0+θs)",
            lambda: residual(r3 * np.cos(between), s + r0 * np.cos(turn)),
        ),
        _equation(
            "closure across s",
            "r3 sin(θ3-θs) = -r0 sin(θ0+θs)",
            lambda: residual(r3 * np.sin(between), -r0 * np.sin(turn)),
        ),
        _equation(
            "closure across s, written again",
            "r3 cos(θ3-θs) = -r0 sin(θ0+θs)",
            lambda: residual(r3 * np.cos(between), -r0 * np.sin(turn)),
            "r3 sin(θ3-θs) on the left, as before",
            lambda: residual(r3 * np.sin(between), -r0 * np.sin(turn)),
        ),
        _equation(
            "angle at O1",
            "cos(θ0+θs) = (r3² - s² - r0²)/(2 s r0)",
            lambda: residual(np.cos(turn), (r3**2 - s**2 - r0**2) / (2 * s * r0)),
        ),
        _equation(
            "angle at O2'",
            "cos(θ3-θs) = (s² + r3² - r0²)/(2 s r3)",
            lambda: residual(np.cos(between), (s**2 + r3**2 - r0**2) / (2 * s * r3)),
        ),
    )


def _speed() -> tuple[Claim, ...]:
    (_, r1, r2, r3), _, (t1, t2, t3), (w1, w2, w3), (_, a2, a3), _, _ = poses()
    top2 = r3 * w3**2 - r1 * w1**2 * np.cos(t1 - t3) - r2 * w2**2 * np.cos(t2 - t3)
    top3 = r1 * w1**2 * np.cos(t1 - t2) + r2 * w2**2 - r3 * w3**2 * np.cos(t3 - t2)
    return (
        _equation(
            "speed of r3",
            "ω3 = (r1 ω1/r3) sin(θ1-θ2)/sin(θ3-θ2)",
            lambda: residual(w3, r1 * w1 / r3 * np.sin(t1 - t2) / np.sin(t3 - t2)),
        ),
        _equation(
            "speed of r2",
            "ω2 = -(r1 ω1/r2) sin(θ1-θ3)/sin(θ2-θ3)",
            lambda: residual(w2, -r1 * w1 / r2 * np.sin(t1 - t3) / np.sin(t2 - t3)),
        ),
        _equation(
            "acceleration of r2",
            "α2 = (r3 ω3² - r1 ω1² cos(θ1-θ3) - r2 ω2² cos(θ2-θ3))/(r2 sin(θ2-θ3))",
            lambda: residual(a2, top2 / (r2 * np.sin(t2 - t3))),
        ),
        _equation(
            "acceleration of r2, in numbers",
            "α2 = (...)/(r3 sin(θ3-θ2))",
            lambda: residual(a2, top2 / (r3 * np.sin(t3 - t2))),
            mended=lambda: residual(a2, top2 / (r2 * np.sin(t2 - t3))),
            slips=("denominator of α2",),
        ),
        _equation(
            "acceleration of r3",
            "α3 = (r1 ω1² cos(θ1-θ2) + r2 ω2² - r3 ω3² cos(θ3-θ2))/(r3 sin(θ3-θ2))",
            lambda: residual(a3, top3 / (r3 * np.sin(t3 - t2))),
        ),
    )
