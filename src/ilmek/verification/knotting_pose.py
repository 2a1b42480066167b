"""Knotting report, sections 3 and 4: equations of the four-bar and the quoted pose, against the machine.

Lengths in mm, speeds by w1, accelerations by w1², as the report has them.
"""

from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexField
from ilmek.linkage.motion import Motion
from ilmek.machines.knotting_four_bar.design import KnottingFourBar, design
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.units import deg, mm
from ilmek.verification import knotting_equations
from ilmek.verification.claim import COUNT, UNSOUND, Claim, Computation

BELOW = "α2, α3: r3 sin(θ3-θ2)"
TERMS = {"G2": ("α2 x R", "ω2 x (ω2 x R)"), "G3": ("α3 x R", "ω3 x (ω3 x R)")}
"""The parts of the accelerations of mass centres."""

VectorStep: TypeAlias = Callable[[Mapping[str, float]], complex]
_claim = partial(Claim, "knotting")


def claims() -> tuple[Claim, ...]:
    """Equations, pose, speeds and accelerations, positions."""
    return (*knotting_equations.claims(), *_pose(), *_speeds(), *_places(), *_accelerations())


@cache
def quoted() -> KnottingFourBar:
    """The machine in the quoted pose, its ground turned so that the loop closes."""
    return design(KnottingFourBarParams())


def motion() -> Motion:
    """The quoted pose at 1 rad/s."""
    return quoted().unit.motion


def _first(values: ComplexField) -> complex:
    """The one sample."""
    return complex(np.ravel(values)[0])


def angle(body: str) -> float:
    """Angle of a body in the quoted pose [rad]."""
    return float(motion().angle(body)[0])


def _far() -> complex:
    """O2' from O1 [mm]."""
    return _first(motion().point("coupler", "O2'").position) / mm


def _pose() -> tuple[Claim, ...]:
    at, params = "4", KnottingFourBarParams()
    r0, r3 = params.ground / mm, params.rocker / mm

    def third_angle(of: Mapping[str, float]) -> float:
        reach = (of["s"] ** 2 + r3**2 - r0**2) / (2 * of["s"] * r3)
        return of["θs"] + float(np.degrees(np.arccos(reach)))

    def mobility() -> int:
        made = quoted().plan.mechanism
        return 3 * len(made.moving) - 2 * len(made.joints)

    return (
        _claim("s", "74.464", "mm", lambda: abs(_far()), at),
        _claim("s, across", "60.95", "mm", lambda: _far().imag, at),
        _claim("s, along", "-42.777", "mm", lambda: _far().real, at),
        _claim("θs", "125", "deg", lambda: float(np.degrees(np.angle(_far()))), at),
        _claim("s² + r3² - r0²", "3725.058", "mm²", lambda: abs(_far()) ** 2 + r3**2 - r0**2, at),
        _claim("2 s r3", "9743.763", "mm²", lambda: 2 * abs(_far()) * r3, at, follows=lambda of: 2 * of["s"] * r3),
        _claim("θ3", "192.524", "deg", lambda: angle("rocker") % (2 * np.pi) / deg, at, follows=third_angle),
        _claim(
            "direction of the ground, 180° - θ0",
            "-95",
            "deg",
            lambda: quoted().ground_angle / deg,
            "3, parameters; 4",
            "with -95° the loop is open by 156 mm; both θ1 and θ2 were chosen, which turns the ground",
            missed=UNSOUND,
        ),
        _claim(
            "angles that are chosen, θ1 and θ2",
            "2",
            COUNT,
            mobility,
            "4",
            "a four-bar has one degree of freedom: θ2 follows",
            missed=UNSOUND,
        ),
    )


def _speeds() -> tuple[Claim, ...]:
    at, near = "4", "the pose is 0.01° from a dead point"
    params = KnottingFourBarParams()

    def rate(what: str, body: str) -> Computation:
        return lambda: float(getattr(motion(), what)(body)[0])

    def speed(of: Mapping[str, float], index: int) -> float:
        return knotting_equations.speeds_by_report(of["θ3"] * deg)[index]

    def above(of: Mapping[str, float]) -> float:
        return of["α2: r3 ω3²"] - of["α2: r1 cos(θ1-θ3)"] - of["α2: r2 ω2² cos(θ2-θ3)"]

    def second(of: Mapping[str, float]) -> float:
        digit = 2000  # 65454.04 is written for 67454.04
        return above(of) / of[BELOW] + digit

    def second_right(of: Mapping[str, float]) -> float:
        return above(of) / (params.coupler / mm * float(np.sin(params.stated_coupler_angle - of["θ3"] * deg)))

    def third(of: Mapping[str, float]) -> float:
        return (of["α3: r1 cos(θ1-θ2)"] + of["α3: r2 ω2²"] + of["α3: -r3 ω3² cos(θ3-θ2)"]) / of[BELOW]

    return (
        _claim("ω3/ω1", "-23.41", "", rate("omega", "rocker"), at, near, partial(speed, index=1)),
        _claim("ω2/ω1", "100.55", "", rate("omega", "coupler"), at, near, partial(speed, index=0)),
        _claim(
            "α2/ω1²",
            "-65454.04",
            "",
            rate("alpha", "coupler"),
            at,
            near,
            second,
            slips=("denominator of α2",),
            right=second_right,
        ),
        _claim("α3/ω1²", "-67494.34", "", rate("alpha", "rocker"), at, near, third),
    )


def _half(of: Mapping[str, float], item: str) -> complex:
    return xy(of, item) / 2


def _third_arm(of: Mapping[str, float]) -> complex:
    return complex(KnottingFourBarParams().rocker / mm * np.exp(1j * of["θ3"] * deg))


def _second_centre(of: Mapping[str, float]) -> complex:
    angle_2 = KnottingFourBarParams().stated_coupler_angle
    return complex(of["mass centre of link 2 from O2"] * np.exp(1j * angle_2))


def _places() -> tuple[Claim, ...]:
    """Vectors to joints and mass centres."""
    at = "4, Fig 4"
    params = KnottingFourBarParams()

    def arm(body: str, length: float) -> Callable[[], complex]:
        return lambda: length * _first(motion().direction(body)) / mm

    centre = quoted().inertias["coupler"].centre.real
    return (
        *vector("O2 from O1", ("-58.23", "58.23"), "mm", arm("crank", params.crank), at),
        *vector(
            "G1 from O1",
            ("-29.115", "29.115"),
            "mm",
            arm("crank", params.crank / 2),
            at,
            follows=partial(_half, item="O2 from O1"),
        ),
        *vector("O3 from O2", ("32.14", "5.67"), "mm", arm("coupler", params.hand), at),
        *vector(
            "G2 from O2",
            ("16.07", "2.83"),
            "mm",
            arm("coupler", centre),
            at,
            follows=partial(_half, item="O3 from O2"),
            slips=("G2 at mid-length",),
            right=_second_centre,
        ),
        *vector("O2' from O1'", ("-63.87", "-14.19"), "mm", arm("rocker", params.rocker), at, follows=_third_arm),
        *vector(
            "G3 from O1'",
            ("-31.935", "-7.095"),
            "mm",
            arm("rocker", params.rocker / 2),
            at,
            follows=partial(_half, item="O2' from O1'"),
        ),
    )


def vector(
    item: str,
    printed: tuple[str, str],
    unit: str,
    compute: Callable[[], complex],
    source: str,
    *,
    follows: VectorStep | None = None,
    slips: tuple[str, ...] = (),
    right: VectorStep | None = None,
    repeated: bool = False,
) -> tuple[Claim, Claim]:
    """A claim for each component."""

    def part(whole: Callable[..., complex], name: str) -> Callable[..., float]:
        return lambda *of: float(getattr(whole(*of), name))

    x, y = (
        _claim(
            f"{item}, {axis}",
            text,
            unit,
            part(compute, name),
            source,
            follows=part(follows, name) if follows else None,
            slips=slips,
            right=part(right, name) if right else None,
            repeated=repeated,
        )
        for axis, name, text in zip("xy", ("real", "imag"), printed, strict=True)
    )
    return x, y


def xy(of: Mapping[str, float], item: str) -> complex:
    """A printed vector."""
    return complex(of[f"{item}, x"], of[f"{item}, y"])


def _accelerations() -> tuple[Claim, ...]:
    at = "4, accelerations"

    def added(of: Mapping[str, float], items: tuple[str, ...]) -> complex:
        return sum((xy(of, item) for item in items), 0j)

    def of_centre(body: str) -> Callable[[], complex]:
        return lambda: _first(motion().carried(body, quoted().inertias[body].centre).acceleration) / mm

    def pin() -> complex:
        return _first(motion().point("crank", "O2").acceleration) / mm

    parts = {centre: tuple(f"a of {centre}: {term}" for term in terms) for centre, terms in TERMS.items()}
    return (
        *vector(
            "a of G1", ("29.115", "-29.115"), "mm/s²", of_centre("crank"), at, follows=lambda of: -xy(of, "G1 from O1")
        ),
        *vector("a of O2", ("58.23", "-58.23"), "mm/s²", pin, at, follows=lambda of: -xy(of, "O2 from O1")),
        *vector(
            "a of G2",
            ("22820.67", "-1080517"),
            "mm/s²",
            of_centre("coupler"),
            at,
            follows=partial(added, items=("a of O2", *parts["G2"])),
        ),
        *vector(
            "a of G3",
            ("-461371.06", "2159320"),
            "mm/s²",
            of_centre("rocker"),
            at,
            follows=partial(added, items=parts["G3"]),
        ),
    )
