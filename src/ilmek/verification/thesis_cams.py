"""Thesis 2.2.2 and 3.2: the cams' motion laws, against the laws of `ilmek.cams`.

A rise of L over the cam angle beta at the speed w; s, v, a the law's displacement and derivatives over u = theta/beta.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import LAWS, Law
from ilmek.units import deg, mm, rpm
from ilmek.verification.claim import RESIDUAL, UNSOUND, Claim, residual

LIFT, BETA, SPEED = 60 * mm, 90 * deg, 5 * rpm
THETA = np.linspace(0.05, 0.95, 19) * BETA
PHI = math.pi * THETA / BETA
HARMONIC, CYCLOIDAL, PARABOLIC = LAWS["harmonic"], LAWS["cycloidal"], LAWS["parabolic"]


def claims() -> tuple[Claim, ...]:
    """The equations of the laws, and the statements of the text on them."""
    return (*_harmonic(), *_cycloidal(), *_statements(), *_shed())


def _equation(number: str, printed: str, law: Law, order: int, right: Callable[[], FloatArray]) -> Claim:
    """An equation for S, V or A (order 0, 1, 2) of a law."""
    return Claim("thesis", f"Eq {number}", printed, RESIDUAL, lambda: _off(law, order, right()), f"2.2.2, Eq {number}")


def _misprinted(claim: Claim, note: str, mended: Callable[[], float], *slips: str) -> Claim:
    return replace(claim, note=note, mended=mended, slips=slips)


def _motion(law: Law, order: int) -> FloatArray:
    """S [m], V [m/s] or A [m/s²] of a rise by the law."""
    curve = (law.s, law.v, law.a)[order]
    return np.asarray(LIFT * (SPEED / BETA) ** order * curve(THETA / BETA))


def _off(law: Law, order: int, other: FloatArray) -> float:
    return residual(_motion(law, order), other)


def _harmonic() -> tuple[Claim, ...]:
    half = LIFT / 2
    return (
        _misprinted(
            _equation("2.47", "S = L/2 - L/2 cos θ", HARMONIC, 0, lambda: half - half * np.cos(THETA)),
            "cos φ, the angle of the generating radius: S = L/2 - L/2 cos φ, φ = π θ/β",
            lambda: _off(HARMONIC, 0, half - half * np.cos(PHI)),
        ),
        _equation(
            "2.48",
            "φ = θ π/β in S = L/2 - L/2 cos φ",
            HARMONIC,
            0,
            lambda: half - half * np.cos(THETA * math.pi / BETA),
        ),
        _misprinted(
            _equation("2.49", "S = L/[2 (1 - cos(π θ/β))]", HARMONIC, 0, lambda: LIFT / (2 * (1 - np.cos(PHI)))),
            "S = (L/2)(1 - cos(π θ/β))",
            lambda: _off(HARMONIC, 0, half * (1 - np.cos(PHI))),
            "fraction bar",
        ),
        _equation(
            "2.50", "V = π L/(2 β) sin(π θ/β) ω", HARMONIC, 1, lambda: math.pi * LIFT / (2 * BETA) * np.sin(PHI) * SPEED
        ),
        _equation(
            "2.51",
            "A = π² L/(2 β²) cos(π θ/β) ω²",
            HARMONIC,
            2,
            lambda: math.pi**2 * LIFT / (2 * BETA**2) * np.cos(PHI) * SPEED**2,
        ),
    )


def _cycloidal() -> tuple[Claim, ...]:
    circle, turned = LIFT / (2 * math.pi), 2 * PHI
    velocity, acceleration = LIFT / BETA * SPEED, 2 * math.pi * LIFT / BETA**2 * SPEED**2
    return (
        _equation(
            "2.52, 2.53",
            "S = R (Φ - sin Φ),  R = L/2π,  Φ = 2π θ/β",
            CYCLOIDAL,
            0,
            lambda: circle * (turned - np.sin(turned)),
        ),
        _equation(
            "2.54", "S = L θ/β - L/2π sin(2π θ/β)", CYCLOIDAL, 0, lambda: LIFT * THETA / BETA - circle * np.sin(turned)
        ),
        _misprinted(
            _equation("2.55", "v = L ω/[β (1 - cos(2π θ/β))]", CYCLOIDAL, 1, lambda: velocity / (1 - np.cos(turned))),
            "v = (L ω/β)(1 - cos(2π θ/β))",
            lambda: _off(CYCLOIDAL, 1, velocity * (1 - np.cos(turned))),
            "fraction bar",
        ),
        _misprinted(
            _equation(
                "2.56", "a = 2π L ω²/[β² sin(2π θ/β)]", CYCLOIDAL, 2, lambda: acceleration / np.sin(turned + 1e-6)
            ),
            "a = (2π L ω²/β²) sin(2π θ/β)",
            lambda: _off(CYCLOIDAL, 2, acceleration * np.sin(turned)),
            "fraction bar",
        ),
    )


def _statements() -> tuple[Claim, ...]:
    peaks = {name: law.acceleration_peak for name, law in LAWS.items()}
    return (
        Claim(
            "thesis",
            "parabolic motion has 'the minimum acceleration possible'",
            "peak of a = least peak of all laws",
            RESIDUAL,
            lambda: residual(peaks["parabolic"], min(peaks.values())),
            "2.2.2, text",
        ),
        Claim(
            "thesis",
            "simple harmonic motion is 'uniformly changing velocity'",
            "|a| is constant",
            RESIDUAL,
            partial(_spread, HARMONIC),
            "2.2.2, text",
            "that is the parabolic law; the harmonic acceleration goes as cos(π θ/β)",
            missed=UNSOUND,
        ),
        Claim(
            "thesis",
            "greatest jerk of the cycloidal law, 'a jerk-free motion', by L (ω/β)³",
            "0",
            "",
            lambda: CYCLOIDAL.jerk_peak,
            "2.2.2, text",
            "the jerk is finite, 4π², not zero",
            missed=UNSOUND,
        ),
        Claim("thesis", "phase angles of the weaver's cams", "figure", "deg", lambda: None, "Fig 2.11", "drawn only"),
    )


def _spread(law: Law) -> float:
    """Deviation of the magnitude of the acceleration from a constant over a rise."""
    sizes = np.abs(_motion(law, 2))
    return residual(sizes, np.full_like(sizes, np.max(sizes)))


def _shed() -> tuple[Claim, ...]:
    """What the thesis leaves open of the shedding cams."""
    return (
        Claim(
            "thesis",
            "prime circle and torque of the cams",
            "figure",
            "mm",
            lambda: None,
            "Fig 3.17",
            "drawn only; a pressure angle of 30° needs a prime radius of 30 (√13 - 1) = 78.17 mm",
        ),
        Claim(
            "thesis",
            "speed of the cam shaft",
            "0.5",
            "rpm",
            lambda: None,
            "3.2",
            "0.5 rpm here and 5 rpm earlier in the same section; nothing decides",
        ),
    )
