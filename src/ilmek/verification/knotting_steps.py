"""Knotting report, sections 4 and 5: the terms of its accelerations, forces and torque.

Lengths in mm; forces and moments as the report has them, what w1² multiplies with mN for N.
"""

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.machines.knotting_four_bar.model import KnottingState
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.units import mm
from ilmek.verification.claim import Claim, Computation
from ilmek.verification.knotting_forces import joint, rest, swing
from ilmek.verification.knotting_pose import ROUNDED_TH3, angle, motion, quoted, vector

PARAMS = KnottingFourBarParams()
R1, R2, R3, HAND = (length / mm for length in (PARAMS.crank, PARAMS.coupler, PARAMS.rocker, PARAMS.hand))
TH1, TH2 = PARAMS.stated_crank_angle, PARAMS.stated_coupler_angle


class StepPose(NamedTuple):
    """Angle of link 3 [rad], and speeds of links 2 and 3 by w1."""

    th3: float
    w2: float
    w3: float


ROUNDED = StepPose(ROUNDED_TH3, 100.55, -23.41)
"""In the report's further computation."""

NEAR = "θ3 was rounded, 0.01° from a dead point"
WRONG = "with the wrong α2 and G2 at mid-length"
Part: TypeAlias = Callable[[Callable[[KnottingState], complex]], complex]
"""`rest` or `swing`."""

_claim = partial(Claim, "knotting")


def claims() -> tuple[Claim, ...]:
    """The terms, in the report's order."""
    return (*_alpha(), *_accelerations(), *_third(), *_second(), *_solution(), *_first())


def _speed(body: str) -> float:
    return float(motion().omega(body)[0])


def _alpha() -> Iterator[Claim]:
    """The terms of α2 and α3, each from θ3, ω2 and ω3 as computed and as the report rounds them."""
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

    for item, (printed, term) in terms.items():
        yield _claim(item, printed, "mm", partial(exact, term), "4", NEAR, partial(term, ROUNDED))


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
    third = -31.935 - 7.095j
    yield from vector("a of G2: α2 x R", ("185235", "-1051846.4"), unit, partial(_along, "coupler"), at, note=WRONG)
    yield from vector(
        "a of G2: ω2 x (ω2 x R)", ("-162472.56", "-28612.16"), unit, partial(_inward, "coupler"), at, note=WRONG
    )
    yield from vector(
        "a of G3: α3 x R",
        ("-478872.34", "2155431.75"),
        unit,
        partial(_along, "rocker"),
        at,
        note=NEAR,
        follows=lambda: -67494.34j * third,
    )
    yield from vector(
        "a of G3: ω3 x (ω3 x R)",
        ("17501.28", "3888.26"),
        unit,
        partial(_inward, "rocker"),
        at,
        note=NEAR,
        follows=lambda: -(ROUNDED.w3**2) * third,
    )


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
    yield from vector(
        "m3 a of G3",
        ("-1282.6", "6002.9"),
        "mN",
        force,
        at,
        note=NEAR,
        follows=lambda: 2.78e-3 * (-461371.06 + 2159320j),
    )

    def weight() -> float:
        return -_arm("rocker").real * _weight("rocker")

    def by_y() -> float:
        return -_arm("rocker").real * force().imag

    def by_x() -> float:
        return _arm("rocker").imag * force().real

    rounded, mixed = "from 31.9 mm for 31.935 mm", f"{NEAR}; N m, added to N mm"
    terms: tuple[tuple[str, str, str, Computation, str, Computation], ...] = (
        ("moment of the weight", "0.869", "N mm", weight, rounded, lambda: 31.9 * 27.26e-3),
        ("moment of the inertia force, by its y", "191.5e3", "mN mm", by_y, NEAR, lambda: 31.9 * 6002.9),
        ("moment of the inertia force, by its x", "9106.46", "mN mm", by_x, NEAR, lambda: 7.1 * 1282.6),
        ("moment of the inertia force", "2e5", "mN mm", lambda: by_y() + by_x(), NEAR, lambda: 191.5e3 + 9106.46),
        ("-J3 α3", "67494.34e-6", "N m", partial(_spin, "rocker"), mixed, lambda: 1000e-9 * 67494.34),
    )
    for item, printed, unit, compute, note, follows in terms:
        yield _claim(f"link 3: {item}", printed, unit, compute, at, note, follows)
    yield _claim("weight of link 3 in F1'y", "27.26e-6", "N", partial(_weight, "rocker"), at, "27.26e-3, as before")


def _second() -> Iterator[Claim]:
    """Link 2: its inertia force, and the moments about O2."""
    at, unit = "5, link 2", "N mm"
    to_hand, to_pin = (length * complex(math.cos(TH2), math.sin(TH2)) for length in (HAND, R2))
    yield from vector("m2 a of G2", ("37.43", "-1773.13"), "mN", partial(_inertia_force, "coupler"), at, note=WRONG)

    def term(item: str, printed: str, unit: str, compute: Computation, note: str = "") -> Claim:
        return _claim(f"link 2: {item}", printed, unit, compute, at, note)

    def weight() -> float:
        return _arm("coupler").real * _weight("coupler")

    typed = "16.7 mm typed for 16.07 mm, and the mass centre is not at mid-length"
    yield term("moment of the yarn's 15 N", "482.1", unit, lambda: 15 * to_hand.real)
    yield term("moment of the weight", "0.268", unit, weight, typed)
    yield term("moment at rest", "481.83", unit, lambda: 15 * to_hand.real - weight(), "from 0.268 N mm of the weight")
    yield from vector("O2' from O2", ("15.45", "2.72"), "mm", lambda: to_pin, at)
    yield term("-J2 α2", "0.014", "N m", partial(_spin, "coupler"), "with the wrong α2; N m, added to N mm")


def _solution() -> Iterator[Claim]:
    """F2' from the moments of links 2 and 3: F2'x = numerator / denominator, denominator = O1'O2' x O2O2'."""
    at = "5, solution"
    note = "in the moment of link 2 F2'y has the wrong sign: the products are added, not subtracted"

    def below() -> float:
        return R3 * R2 * math.sin(TH2 - angle("rocker"))

    def above(of: Part) -> float:
        return of(joint("F2'")).real * below()

    yield _claim("F2'x: denominator", "392.96", "mm²", below, at, note)
    yield _claim("F2'x: numerator at rest", "30787.9", "N mm²", partial(above, rest), at, note)
    yield _claim("F2'x: numerator by ω1²", "3.1e6", "N mm² s²", partial(above, swing), at, f"{note}; mN added to N")


def _first() -> Iterator[Claim]:
    """Link 1: its inertia force, and the moments about O1."""
    at, wrong = "5, link 1", "with the wrong F2"
    mass = quoted().inertias["crank"].mass
    yield from vector("m1 a of G1", ("0.1", "-0.1"), "mN", lambda: mass * -_arm("crank"), at)
    yield _claim("link 1: moment of the weight", "1.0", "N mm", lambda: -_arm("crank").real * _weight("crank"), at)
    yield _claim(
        "link 1: moment of the inertia force, each part",
        "2.9",
        "mN mm",
        lambda: mass * _arm("crank").imag ** 2,
        at,
    )
    slip = f"{wrong}; and 58.23 · 7851.37 is 457185, to which 4561.7 was added a second time"
    pin = R1 * complex(math.cos(TH1), math.sin(TH1))
    for what, of, printed in (("at rest", rest, ("-1886.7", "-4561.7")), ("by ω1²", swing, ("-22967.7", "-461747"))):
        unit = "N mm" if of is rest else "N mm s²"
        force = partial(of, joint("F2"))
        by_y, by_x = _moments(pin, force)
        yield _claim(f"link 1: moment of F2y {what}", printed[0], unit, by_y, at, wrong)
        yield _claim(f"link 1: moment of F2x {what}", printed[1], unit, by_x, at, slip if of is swing else wrong)


def _moments(arm: complex, force: Callable[[], complex]) -> tuple[Computation, Computation]:
    return lambda: arm.real * force().imag, lambda: -arm.imag * force().real
