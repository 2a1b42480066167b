"""Knotting report, sections 4 and 5: the terms of its accelerations, forces and torque.

Lengths in mm; forces and moments as the report has them, what w1² multiplies with mN for N.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.machines.knotting_four_bar.model import KnottingState
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.units import deg, mm
from ilmek.verification.claim import Claim, Computation, Step
from ilmek.verification.knotting_force_steps import (
    ARM_3,
    AT_REST,
    BY_SPEED,
    DENOMINATOR,
    INERTIA_3,
    NUMERATOR_AT_REST,
    NUMERATOR_BY_SPEED,
    REST_2,
    SPIN_2,
    SPIN_3,
    WEIGHT_2,
    WEIGHT_3,
    YARN,
    by_mass,
    denominator,
    moment_2,
    moment_3,
    moment_of_x,
    moment_of_y,
    numerator,
)
from ilmek.verification.knotting_forces import joint, rest, swing
from ilmek.verification.knotting_pose import TERMS, angle, motion, quoted, vector, xy

PARAMS = KnottingFourBarParams()
R1, R2, R3, HAND = (length / mm for length in (PARAMS.crank, PARAMS.coupler, PARAMS.rocker, PARAMS.hand))
TH1, TH2 = PARAMS.stated_crank_angle, PARAMS.stated_coupler_angle


class StepPose(NamedTuple):
    """Angle of link 3 [rad], and speeds of links 2 and 3 by w1."""

    th3: float
    w2: float
    w3: float


Part: TypeAlias = Callable[[Callable[[KnottingState], complex]], complex]
"""`rest` or `swing`."""

_claim = partial(Claim, "knotting")


def claims() -> tuple[Claim, ...]:
    """The terms, in the report's order."""
    return (*_alpha(), *_accelerations(), *_third(), *_second(), *_solution(), *_first())


def _speed(body: str) -> float:
    return float(motion().omega(body)[0])


def _alpha() -> Iterator[Claim]:
    """The terms of α2 and α3, each from θ3, ω2 and ω3."""
    terms: dict[str, tuple[str, Callable[[StepPose], float]]] = {
        "α2: r3 ω3²": ("35855.29", lambda of: R3 * of.w3**2),
        "α2: r1 cos(θ1-θ3)": ("44.215", lambda of: R1 * math.cos(TH1 - of.th3)),
        "α2: r2 ω2² cos(θ2-θ3)": ("-158456.55", lambda of: R2 * of.w2**2 * math.cos(TH2 - of.th3)),
        "α2, α3: r3 sin(θ3-θ2)": ("-2.88", lambda of: R3 * math.sin(of.th3 - TH2)),
        "α3: r1 cos(θ1-θ2)": ("-47.23", lambda _: R1 * math.cos(TH1 - TH2)),
        "α3: r2 ω2²": ("158610.43", lambda of: R2 * of.w2**2),
        "α3: -r3 ω3² cos(θ3-θ2)": ("35820.5", lambda of: -R3 * of.w3**2 * math.cos(of.th3 - TH2)),
    }

    def exact(term: Callable[[StepPose], float]) -> float:
        return term(StepPose(angle("rocker"), _speed("coupler"), _speed("rocker")))

    def by_report(term: Callable[[StepPose], float], of: Mapping[str, float]) -> float:
        return term(StepPose(of["θ3"] * deg, of["ω2/ω1"], of["ω3/ω1"]))

    for item, (printed, term) in terms.items():
        yield _claim(item, printed, "mm", partial(exact, term), "4", follows=partial(by_report, term))


def _arm(body: str) -> complex:
    """The mass centre from the link's first pin [mm]."""
    length = complex(quoted().inertias[body].centre).real
    return complex(length * np.exp(1j * angle(body))) / mm


def _along(body: str) -> complex:
    return 1j * float(motion().alpha(body)[0]) * _arm(body)


def _inward(body: str) -> complex:
    return -(_speed(body) ** 2) * _arm(body)


def _accelerations() -> Iterator[Claim]:
    at, unit = "4, accelerations", "mm/s²"

    def along(of: Mapping[str, float], rate: str, arm: str) -> complex:
        return 1j * of[rate] * xy(of, arm)

    def inward(of: Mapping[str, float], speed: str, arm: str) -> complex:
        return -(of[speed] ** 2) * xy(of, arm)

    rows = (
        ("G2", "coupler", "2", "G2 from O2", ("185235", "-1051846.4"), ("-162472.56", "-28612.16")),
        ("G3", "rocker", "3", "G3 from O1'", ("-478872.34", "2155431.75"), ("17501.28", "3888.26")),
    )
    for centre, body, k, arm, turned, drawn in rows:
        first, second = (f"a of {centre}: {term}" for term in TERMS[centre])
        step = partial(along, rate=f"α{k}/ω1²", arm=arm)
        yield from vector(first, turned, unit, partial(_along, body), at, follows=step)
        step = partial(inward, speed=f"ω{k}/ω1", arm=arm)
        yield from vector(second, drawn, unit, partial(_inward, body), at, follows=step)


def _inertia_force(body: str) -> complex:
    """Mass by acceleration of a link, by ω1² [mN s²]: its pin's share, and that of its own turning."""
    start = complex(np.ravel(motion().point(body, "O2" if body == "coupler" else "O1'").acceleration)[0]) / mm
    return quoted().inertias[body].mass * (start + _along(body) + _inward(body))


def _weight(body: str) -> float:
    return quoted().inertias[body].mass * PARAMS.gravity


def _spin(body: str) -> float:
    """-J α of a link, by ω1² [N m s²]."""
    return -quoted().inertias[body].moment * float(motion().alpha(body)[0])


def _third() -> Iterator[Claim]:
    """Link 3: its inertia force, and the moments about O1'."""
    at = "5, link 3"
    force = partial(_inertia_force, "rocker")
    yield from vector("m3 a of G3", ("-1282.6", "6002.9"), "mN", force, at, follows=partial(by_mass, link=3))
    yield from vector(
        ARM_3,
        ("-31.9", "-7.1"),
        "mm",
        partial(_arm, "rocker"),
        at,
        follows=lambda of: xy(of, "G3 from O1'"),
        repeated=True,
    )

    def weight() -> float:
        return -_arm("rocker").real * _weight("rocker")

    def by_y() -> float:
        return -_arm("rocker").real * force().imag

    def by_x() -> float:
        return _arm("rocker").imag * force().real

    whole = INERTIA_3
    terms: tuple[tuple[str, str, str, Computation, Step], ...] = (
        (WEIGHT_3, "0.869", "N mm", weight, lambda of: -of[f"{ARM_3}, x"] * of["weight of link 3"]),
        (f"{whole}, by its y", "191.5e3", "mN mm", by_y, lambda of: -of[f"{ARM_3}, x"] * of["m3 a of G3, y"]),
        (f"{whole}, by its x", "9106.46", "mN mm", by_x, lambda of: of[f"{ARM_3}, y"] * of["m3 a of G3, x"]),
        (
            whole,
            "2e5",
            "mN mm",
            lambda: by_y() + by_x(),
            lambda of: of[f"{whole}, by its y"] + of[f"{whole}, by its x"],
        ),
        (
            SPIN_3,
            "67494.34e-6",
            "N m",
            partial(_spin, "rocker"),
            lambda of: -of["moment of inertia of link 3"] * of["α3/ω1²"],
        ),
    )
    for item, printed, unit, compute, follows in terms:
        yield _claim(item, printed, unit, compute, at, follows=follows)
    yield _claim("weight of link 3 in F1'y", "27.26e-6", "N", partial(_weight, "rocker"), at, "27.26e-3, as before")


def _second() -> Iterator[Claim]:
    """Link 2: its inertia force, and the moments about O2."""
    at, unit = "5, link 2", "N mm"
    to_hand, to_pin = (length * complex(math.cos(TH2), math.sin(TH2)) for length in (HAND, R2))
    force = partial(_inertia_force, "coupler")
    yield from vector("m2 a of G2", ("37.43", "-1773.13"), "mN", force, at, follows=partial(by_mass, link=2))
    term = partial(_claim, source=at)

    def weight() -> float:
        return _arm("coupler").real * _weight("coupler")

    yield term(YARN, "482.1", unit, lambda: 15 * to_hand.real, follows=lambda of: 15 * of["O3 from O2, x"])
    yield term(
        WEIGHT_2,
        "0.268",
        unit,
        weight,
        follows=lambda of: 16.7 * of["weight of link 2, as used"],
        slips=("16.7 for 16.07",),
        right=lambda of: of["G2 from O2, x"] * of["weight of link 2, as used"],
    )
    yield term(REST_2, "481.83", unit, lambda: 15 * to_hand.real - weight(), follows=lambda of: of[YARN] - of[WEIGHT_2])
    yield from vector("O2' from O2", ("15.45", "2.72"), "mm", lambda: to_pin, at)
    yield term(
        SPIN_2,
        "0.014",
        "N m",
        partial(_spin, "coupler"),
        follows=lambda of: -of["moment of inertia of link 2"] * of["α2/ω1²"],
    )


def _solution() -> Iterator[Claim]:
    """F2' from the moments of links 2 and 3: F2'x = numerator / denominator, denominator = O1'O2' x O2O2'."""
    at = "5, solution"

    def below() -> float:
        return R3 * R2 * math.sin(TH2 - angle("rocker"))

    def above(of: Part) -> float:
        return of(joint("F2'")).real * below()

    sign = ("sign of F2'y",)
    at_rest = partial(numerator, third=lambda of: of[WEIGHT_3], second=lambda of: of[REST_2])
    mixed = partial(numerator, third=lambda of: of[INERTIA_3], second=lambda of: of[SPIN_2])
    right = partial(numerator, sign=-1, third=moment_3, second=moment_2)
    solved = partial(_claim, source=at)
    yield solved(
        DENOMINATOR,
        "392.96",
        "mm²",
        below,
        follows=partial(denominator, sign=1),
        slips=sign,
        right=partial(denominator, sign=-1),
    )
    yield solved(
        NUMERATOR_AT_REST,
        "30787.9",
        "N mm²",
        partial(above, rest),
        follows=partial(at_rest, sign=1),
        slips=sign,
        right=partial(at_rest, sign=-1),
    )
    yield solved(
        NUMERATOR_BY_SPEED,
        "3.1e6",
        "N mm² s²",
        partial(above, swing),
        follows=partial(mixed, sign=1),
        slips=(*sign, "mN as N", "m2 a of G2 left out"),
        right=right,
    )


def _first() -> Iterator[Claim]:
    """Link 1: its inertia force, and the moments about O1."""
    at = "5, link 1"
    mass = quoted().inertias["crank"].mass
    yield from vector("m1 a of G1", ("0.1", "-0.1"), "mN", lambda: mass * -_arm("crank"), at)
    yield _claim("link 1: moment of the weight", "1.0", "N mm", lambda: -_arm("crank").real * _weight("crank"), at)
    yield _claim(
        "link 1: moment of the inertia force, each part", "2.9", "mN mm", lambda: mass * _arm("crank").imag ** 2, at
    )
    pin = R1 * complex(math.cos(TH1), math.sin(TH1))
    for what, of, printed in ((AT_REST, rest, ("-1886.7", "-4561.7")), (BY_SPEED, swing, ("-22967.7", "-461747"))):
        unit = "N mm" if of is rest else "N mm s²"
        force = partial(of, joint("F2"))
        by_y, by_x = _moments(pin, force)
        across = partial(moment_of_x, what=what)
        yield _claim(
            f"link 1: moment of F2y {what}", printed[0], unit, by_y, at, follows=partial(moment_of_y, what=what)
        )
        yield _claim(
            f"link 1: moment of F2x {what}",
            printed[1],
            unit,
            by_x,
            at,
            follows=across
            if of is rest
            else lambda of: moment_of_x(of, BY_SPEED) + of["link 1: moment of F2x at rest"],
            slips=() if of is rest else ("F2x added twice",),
            right=across,
        )


def _moments(arm: complex, force: Callable[[], complex]) -> tuple[Computation, Computation]:
    return lambda: arm.real * force().imag, lambda: -arm.imag * force().real
