"""Knotting report, section 2: three poses of the gripper, step by step.

The steps are taken as the report takes them (superposition with one Lagrange factor), from exact numbers; the lengths
at their end are those of `ilmek.synthesis.dyad`, which knows nothing of the steps. Lengths in mm, as in the report.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import Float
from ilmek.synthesis.dyad import Lengths, TwoLinkArm, dyads_through_poses, four_bar
from ilmek.units import deg
from ilmek.verification.claim import UNSOUND, Claim, Computation, Step, equation, residual

Three: TypeAlias = Float[np.ndarray, "3"]

POINTS = np.array([0, 25 + 15j, 30 + 1j])
TH2 = np.array([10.0, 3.0, -25.0]) * deg
TH0 = 275 * deg
SIGN = ("sign of ρ²",)
TYPED_F3 = "f3 of pose 2, written again"
_claim = partial(Claim, "knotting")


def _side_of_l(of: Mapping[str, float]) -> Sequence[float]:
    return of["F of pose 1"], of["F of pose 2"], of["F of pose 3"]


def _side_of_m(of: Mapping[str, float]) -> Sequence[float]:
    return 0.0, -of["f4 of pose 2"], -of["f4 of pose 3"]


class SynthesisSteps(NamedTuple):
    """f2, f3, F of the poses; l (here L) and M of P1, P2, P3; the quadratic and its roots, the larger first."""

    f2: Three
    f3: Three
    F: Three
    L: Three
    M: Three
    quadratic: tuple[float, float, float]
    factors: tuple[float, float]


def claims() -> tuple[Claim, ...]:
    """The steps, in the report's order."""
    return (*_equations(), *_given(), *_systems(), *_quadratic(), *_cases(), *_results())


@cache
def steps() -> SynthesisSteps:
    """The report's steps with exact numbers and the right sign of rho²."""
    e0, e2, rho = np.exp(1j * TH0), np.exp(1j * TH2), np.abs(POINTS)
    f2, f3 = 2 * (POINTS * np.conj(e0)).real, 2 * (POINTS * np.conj(e2)).real
    F = 2 * np.cos(TH2 - TH0)
    matrix = np.array([np.ones(3), f2, f3]).T
    L, M = np.linalg.solve(matrix, F), np.linalg.solve(matrix, rho**2)
    p, q, r = M[1] * M[2], L[1] * M[2] + L[2] * M[1] - 1, L[1] * L[2]
    small, large = np.sort(np.roots([p, q, r]).real)
    return SynthesisSteps(f2, f3, F, L, M, (float(p), float(q), float(r)), (float(large), float(small)))


@cache
def dyads() -> tuple[TwoLinkArm, TwoLinkArm]:
    """The two arms of the example: that of the larger factor 1/(a0 a2), which is the report's case 1, first."""
    one, other = dyads_through_poses(POINTS, TH2, TH0)
    return (one, other) if one.ground * one.second < other.ground * other.second else (other, one)


def mechanism() -> Lengths:
    """The four-bar of both arms [mm]."""
    return four_bar(*dyads())


def _residual_of_poses(F: Three, square: int = -1) -> float:
    """Residual of P1 + P2 f2 + P3 f3 + square lam rho² = F for both arms."""
    found = steps()
    worst = []
    for arm in dyads():
        P1 = (arm.first**2 - arm.ground**2 - arm.second**2) / (arm.ground * arm.second)
        factor = 1 / (arm.ground * arm.second)
        left = P1 + found.f2 / arm.second + found.f3 / arm.ground + square * factor * np.abs(POINTS) ** 2
        worst.append(residual(left, F))
    return max(worst)


_equation = partial(equation, "knotting", "2, synthesis")


def _equations() -> tuple[Claim, ...]:
    def of_quadratic() -> float:
        p, q, r = steps().quadratic
        factor = np.array([1 / (arm.ground * arm.second) for arm in dyads()])
        return residual(p * factor**2 + r, -q * factor)

    def of_first(power: float) -> float:
        found = steps()
        P = [found.L + factor * found.M for factor in found.factors]
        return residual(
            np.array([(P1 / (P2 * P3) + P2**-2 + P3**-2) ** power for P1, P2, P3 in P]),
            np.array([arm.first for arm in dyads()]),
        )

    return (
        _equation(
            "objective function", "P1 f1 + P2 f2 + P3 f3 = F - λ f4,  f4 = -ρ²", lambda: _residual_of_poses(steps().F)
        ),
        _equation(
            "F",
            "F = 2 (cos θ2 - θ0)",
            lambda: _residual_of_poses(2 * (np.cos(TH2) - TH0)),
            "F = 2 cos(θ2 - θ0), as the numbers have it",
            lambda: _residual_of_poses(2 * np.cos(TH2 - TH0)),
        ),
        _equation(
            "numeric form",
            "... + [-ρ]²/(a0 a2) - 2 cos(θ2 - θ0) = 0",
            lambda: _residual_of_poses(steps().F, square=1),
            "it spoils all that follows",
            lambda: _residual_of_poses(steps().F, square=-1),
            slips=SIGN,
        ),
        _equation("quadratic", "M2 M3 λ² + (l2 M3 + l3 M2 - 1) λ + l2 l3 = 0", of_quadratic),
        _equation("first link", "a1 = (P1/(P2 P3) + P2⁻² + P3⁻²)^0.5", partial(of_first, 0.5)),
        _equation(
            "first link, written again in case 1",
            "a1 = P1/(P2 P3) + P2⁻² + P3⁻²",
            partial(of_first, 1.0),
            "the root is missing, as the numbers have it",
            partial(of_first, 0.5),
        ),
    )


def _given() -> tuple[Claim, ...]:
    """The table of poses and the functions of the given."""
    at = "2, calculation"
    typed = ("f3 of 51.502",)

    def of(name: str, pose: int) -> Computation:
        return lambda: float(getattr(steps(), name)[pose])

    return (
        *(
            _claim(f"ρ{k + 1}", text, "mm", partial(_rho, k), f"{at}, table")
            for k, text in enumerate(("29.154", "30.016"), start=1)
        ),
        _claim(
            "least θ2 of the poses, taken from 0° to 90°",
            "> 0",
            "deg",
            lambda: float(np.min(TH2)) / deg,
            f"{at}, intervals",
            "pose 3 has -25°; the other givens keep their intervals",
            missed=UNSOUND,
        ),
        _claim("f2 of pose 2", "-25.528", "mm", of("f2", 1), at),
        _claim("f2 of pose 3", "3.236", "mm", of("f2", 2), at),
        _claim("f3 of pose 2", "51.49", "mm", of("f3", 1), at, slips=typed),
        _claim("f3 of pose 2, written again", "51.499", "mm", of("f3", 1), at, slips=typed),
        _claim("f3 of pose 3", "53.534", "mm", of("f3", 2), at),
        _claim("x of pose 3 in f3", "10", "mm", _x_in_f3, at, "its own result, 53.534, has 30"),
        *(
            _claim(
                f"f4 of pose {k + 1}",
                text,
                "mm²",
                partial(_f4, k),
                at,
                follows=partial(_squared, f"ρ{k + 1}", 1),
                right=partial(_squared, f"ρ{k + 1}", -1),
                slips=SIGN,
            )
            for k, text in ((1, "849.955"), (2, "900.96"))
        ),
        _claim("F of pose 1, first written", "0.174", "", of("F", 0), at, "the sign; -0.174 in the next lines"),
        _claim("F of pose 1", "-0.174", "", of("F", 0), at),
        _claim("F of pose 2", "0.069", "", of("F", 1), at),
        _claim("F of pose 3", "1", "", of("F", 2), at),
    )


def _x_in_f3() -> float:
    """The x [mm] in 2 (x cos θ2 + y sin θ2) = 53.534 with y = 1 mm."""
    return float((53.534 / 2 - POINTS[2].imag * np.sin(TH2[2])) / np.cos(TH2[2]))


def _rho(pose: int) -> float:
    return float(np.abs(POINTS[pose]))


def _f4(pose: int) -> float:
    return -(_rho(pose) ** 2)


def _squared(rho: str, sign: int, of: Mapping[str, float]) -> float:
    return sign * of[rho] ** 2


def _systems() -> tuple[Claim, ...]:
    """The two linear systems."""
    at = "2, matrix equation"
    return (
        *(
            _claim(f"l{k + 1}", text, unit, partial(_of_system, "L", k), at, follows=partial(_solved, _side_of_l, k))
            for k, (text, unit) in enumerate((("-0.174", ""), ("0.0309", "1/mm"), ("0.02", "1/mm")))
        ),
        *(
            _claim(f"m{k + 1}", text, unit, partial(_of_system, "M", k), at, follows=partial(_solved, _side_of_m, k))
            for k, (text, unit) in enumerate((("0", "mm²"), ("-0.585", "mm"), ("-16.79", "mm")))
        ),
    )


def _of_system(name: str, index: int) -> float:
    value = float(getattr(steps(), name)[index])
    return 0.0 if abs(value) < 1e-12 else value


def _solved(side: Callable[[Mapping[str, float]], Sequence[float]], index: int, of: Mapping[str, float]) -> float:
    """An unknown of a system with the report's matrix."""
    rows = ((0.0, 0.0), *((of[f"f2 of pose {k}"], of[f3]) for k, f3 in ((2, TYPED_F3), (3, "f3 of pose 3"))))
    return float(np.linalg.solve([(1.0, f2, f3) for f2, f3 in rows], side(of))[index])


def _quadratic() -> tuple[Claim, ...]:
    def discriminant() -> float:
        p, q, r = steps().quadratic
        return q**2 - 4 * p * r

    def root(of: Mapping[str, float], sign: int) -> float:
        return (-of["q"] + sign * float(np.sqrt(complex(of["Δ"])).real)) / (2 * of["p"])

    step = partial(_claim, source="2, quadratic")
    return (
        step("p", "9.822", "mm²", lambda: steps().quadratic[0], follows=lambda of: of["m2"] * of["m3"]),
        step(
            "q",
            "-1.5305",
            "",
            lambda: steps().quadratic[1],
            follows=lambda of: of["l2"] * of["m3"] + of["l3"] * of["m2"] - 1,
        ),
        step("r", "6.18e-4", "1/mm²", lambda: steps().quadratic[2], follows=lambda of: of["l2"] * of["l3"]),
        step("Δ", "2.317", "", discriminant, follows=lambda of: of["q"] ** 2 - 4 * of["p"] * of["r"]),
        step("λ1", "0.155", "1/mm²", lambda: steps().factors[0], follows=partial(root, sign=1)),
        step(
            "λ2",
            "0.000432",
            "1/mm²",
            lambda: steps().factors[1],
            note="its own quadratic gives 0.000405",
            follows=partial(root, sign=-1),
        ),
    )


def _cases() -> tuple[Claim, ...]:
    """The two arms; the printed ones miss the poses 2 and 3 by 10 to 29 mm."""
    printed = {
        1: {
            "p1": "-0.174",
            "p2": "-0.059",
            "p3": "-2.582",
            "a0": "-0.387",
            "a2": "-16.949",
            "p1 in the root": "-0.274",
            "p2 p3 in the root": "0.152",
            "p2² in the root": "0.003481",
            "p3² in the root": "6.666",
            "a1": "16.919",
        },
        2: {"p1": "-0.174", "p2": "0.03064", "p3": "0.01274", "a0": "78.492", "a2": "32.637", "a1": "82.345"},
    }
    notes = {
        1: "the printed arm misses the poses 2 and 3 by 28 and 29 mm",
        2: "the printed arm misses the poses 2 and 3 by 10 and 11 mm",
    }
    slip = {"p1 in the root": "a slip of the pen: 16.919 follows from -0.174"}
    units = {"p1": "", "p2": "1/mm", "p3": "1/mm", "p2 p3": "1/mm²", "p2²": "1/mm²", "p3²": "1/mm²"}
    return tuple(
        _claim(
            f"case {case}: {name}",
            text,
            units.get(name.removesuffix(" in the root"), "mm"),
            partial(_of_arm, case, name.removesuffix(" in the root")),
            "2",
            slip.get(name, notes[case]),
            _steps_of_arm(case).get(name),
        )
        for case, texts in printed.items()
        for name, text in texts.items()
    )


def _steps_of_arm(case: int) -> dict[str, Step]:
    """The report's steps from λ to an arm."""

    def p(of: Mapping[str, float], k: int) -> float:
        return of[f"l{k}"] + of[f"λ{case}"] * of[f"m{k}"]

    def inverse(of: Mapping[str, float], k: int) -> float:
        return 1 / of[f"case {case}: p{k}"]

    def product(of: Mapping[str, float], k: int, j: int) -> float:
        return of[f"case {case}: p{k}"] * of[f"case {case}: p{j}"]

    def first(of: Mapping[str, float]) -> float:
        p1, p2, p3 = (of[f"case {case}: p{k}"] for k in (1, 2, 3))
        return float(np.sqrt(complex(p1 / (p2 * p3) + p2**-2 + p3**-2)).real)

    return {
        **{f"p{k}": partial(p, k=k) for k in (1, 2, 3)},
        "a0": partial(inverse, k=3),
        "a2": partial(inverse, k=2),
        "p2 p3 in the root": partial(product, k=2, j=3),
        "p2² in the root": partial(product, k=2, j=2),
        "p3² in the root": partial(product, k=3, j=3),
        "a1": first,
    }


def _of_arm(case: int, name: str) -> float:
    arm = dyads()[case - 1]
    squares = arm.first**2 - arm.ground**2 - arm.second**2
    lam, p2, p3 = 1 / (arm.ground * arm.second), 1 / arm.second, 1 / arm.ground
    values = {"a0": arm.ground, "a1": arm.first, "a2": arm.second, "p1": squares * lam}
    return {**values, "p2": p2, "p3": p3, "p2 p3": lam, "p2²": p2**2, "p3²": p3**2}[name]


def _results() -> tuple[Claim, ...]:
    """The superposition of both arms; as one four-bar they have two cranks, and their ends one coupler."""
    at, note = "2, results", "ground of the four-bar of both arms; with it the linkage closes in all poses"

    def apart(of: Mapping[str, float], link: str) -> float:
        return abs(of[f"case 1: {link}"] - of[f"case 2: {link}"])

    def apart_in_size(of: Mapping[str, float], link: str) -> float:
        return abs(abs(of[f"case 1: {link}"]) - abs(of[f"case 2: {link}"]))

    result = partial(_claim, unit="mm", slips=("arms subtracted",))
    ground, coupler = partial(apart, link="a0"), partial(apart, link="a2")
    return (
        _claim("a0'", "78.879", "mm", lambda: mechanism().ground, at, note, ground),
        result(
            "a0', as used from section 4 on",
            "78.105",
            compute=lambda: mechanism().ground,
            source="4",
            note=note,
            follows=partial(apart_in_size, link="a0"),
            right=ground,
        ),
        _claim(
            "a1'",
            "65.426",
            "mm",
            lambda: None,
            at,
            "no such link: the first links of the arms, 17.166 and 37.525 mm, are two links, crank and rocker",
            missed=UNSOUND,
        ),
        result(
            "a2'",
            "15.688",
            compute=lambda: mechanism().coupler,
            source=at,
            note="coupler of the four-bar of both arms",
            follows=partial(apart_in_size, link="a2"),
            right=coupler,
        ),
    )
