"""Knotting report, sections 3 and 4: equations of the four-bar and the quoted pose, against the machine.

Lengths in mm, speeds by w1, accelerations by w1², as the report has them.
"""

from collections.abc import Callable
from functools import cache, partial

import numpy as np

from ilmek.arrays import ComplexField
from ilmek.dynamics.attached import attached
from ilmek.linkage.motion import Motion
from ilmek.machines.knotting_four_bar.design import KnottingFourBar, design
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.units import deg, mm
from ilmek.verification import knotting_equations
from ilmek.verification.claim import COUNT, UNSOUND, Claim, Computation

ROUNDED_TH3 = 192.524 * deg
"""theta3 in the report's further computation."""

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
    early = "θs was rounded to 125°"

    def from_rounded() -> float:
        reach = (74.464**2 + r3**2 - r0**2) / (2 * 74.464 * r3)
        return 125 + float(np.degrees(np.arccos(reach)))

    def mobility() -> int:
        made = quoted().plan.mechanism
        return 3 * len(made.moving) - 2 * len(made.joints)

    return (
        _claim("s", "74.464", "mm", lambda: abs(_far()), at),
        _claim("s, across", "60.95", "mm", lambda: _far().imag, at),
        _claim("s, along", "-42.777", "mm", lambda: _far().real, at),
        _claim("θs", "125", "deg", lambda: float(np.degrees(np.angle(_far()))), at),
        _claim("s² + r3² - r0²", "3725.058", "mm²", lambda: abs(_far()) ** 2 + r3**2 - r0**2, at),
        _claim(
            "2 s r3", "9743.763", "mm²", lambda: 2 * abs(_far()) * r3, at, "from the rounded s", lambda: 2 * 74.464 * r3
        ),
        _claim("θ3", "192.524", "deg", lambda: angle("rocker") % (2 * np.pi) / deg, at, early, from_rounded),
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
    at = "4"
    near = "θ3 was rounded, 0.01° from a dead point"

    def of(what: str, body: str) -> Computation:
        return lambda: float(getattr(motion(), what)(body)[0])

    def rounded(index: int) -> Computation:
        return lambda: knotting_equations.speeds_by_report(ROUNDED_TH3)[index]

    return (
        _claim("ω3/ω1", "-23.41", "", of("omega", "rocker"), at, near, rounded(1)),
        _claim("ω2/ω1", "100.55", "", of("omega", "coupler"), at, near, rounded(0)),
        _claim(
            "α2/ω1²",
            "-65454.04",
            "",
            of("alpha", "coupler"),
            at,
            "the denominator is r2 sin(θ2-θ3), not r3 sin(θ3-θ2); and 0.01° from a dead point θ3 decides",
        ),
        _claim(
            "α3/ω1²",
            "-67494.34",
            "",
            of("alpha", "rocker"),
            at,
            near,
            lambda: (-47.23 + 158610.43 + 35820.5) / -2.88,
        ),
    )


def _places() -> tuple[Claim, ...]:
    """Vectors to joints and mass centres."""
    at = "4, Fig 4"
    cut, middle = (
        "half of the rounded 58.23",
        "the mass centre is 19.31 mm from O2, as section 5 finds, not at mid-length",
    )
    rounded = "from the rounded θ3"
    params = KnottingFourBarParams()

    def arm(body: str, length: float) -> Callable[[], complex]:
        return lambda: length * _first(motion().direction(body)) / mm

    def third(part: float) -> complex:
        return complex(part * params.rocker / mm * np.exp(1j * ROUNDED_TH3))

    centre = quoted().inertias["coupler"].centre.real
    return (
        *vector("O2 from O1", ("-58.23", "58.23"), "mm", arm("crank", params.crank), at),
        *vector(
            "G1 from O1",
            ("-29.115", "29.115"),
            "mm",
            arm("crank", params.crank / 2),
            at,
            note=cut,
            follows=lambda: -29.115 + 29.115j,
        ),
        *vector("O3 from O2", ("32.14", "5.67"), "mm", arm("coupler", params.hand), at),
        *vector("G2 from O2", ("16.07", "2.83"), "mm", arm("coupler", centre), at, note=middle),
        *vector(
            "O2' from O1'",
            ("-63.87", "-14.19"),
            "mm",
            arm("rocker", params.rocker),
            at,
            note=rounded,
            follows=partial(third, 1.0),
        ),
        *vector(
            "G3 from O1'",
            ("-31.935", "-7.095"),
            "mm",
            arm("rocker", params.rocker / 2),
            at,
            note=rounded,
            follows=lambda: -31.935 - 7.095j,
        ),
    )


def vector(
    item: str,
    printed: tuple[str, str],
    unit: str,
    compute: Callable[[], complex],
    source: str,
    *,
    note: str = "",
    follows: Callable[[], complex] | None = None,
) -> tuple[Claim, Claim]:
    """A claim for each component."""

    def part(whole: Callable[[], complex], name: str) -> Computation:
        return lambda: float(getattr(whole(), name))

    one, other = (
        _claim(
            f"{item}, {axis}", text, unit, part(compute, name), source, note, part(follows, name) if follows else None
        )
        for axis, name, text in zip("xy", ("real", "imag"), printed, strict=True)
    )
    return one, other


def _accelerations() -> tuple[Claim, ...]:
    at, wrong = "4, accelerations", "with the wrong α2 and G2 at mid-length"

    def centre(body: str) -> Callable[[], complex]:
        return lambda: _first(attached(motion(), body, quoted().inertias[body].centre).acceleration) / mm

    def pin() -> complex:
        return _first(motion().point("crank", "O2").acceleration) / mm

    half, sharp = "half of the rounded 58.23", "α3 and ω3 from the rounded θ3, 0.01° from a dead point"
    return (
        *vector(
            "a of G1", ("29.115", "-29.115"), "mm/s²", centre("crank"), at, note=half, follows=lambda: 29.115 - 29.115j
        ),
        *vector("a of O2", ("58.23", "-58.23"), "mm/s²", pin, at),
        *vector("a of G2", ("22820.67", "-1080517"), "mm/s²", centre("coupler"), at, note=wrong),
        *vector(
            "a of G3",
            ("-461371.06", "2159320"),
            "mm/s²",
            centre("rocker"),
            at,
            note=sharp,
            follows=lambda: -478872.34 + 17501.28 + 1j * (2155431.75 + 3888.26),
        ),
    )
