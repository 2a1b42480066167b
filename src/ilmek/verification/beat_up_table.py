"""Table 1 of the beat-up paper: 33 crank-rockers for a swing of 30 deg, 165 numbers."""

from collections.abc import Mapping
from functools import cache, partial
from typing import NamedTuple

import numpy as np

from ilmek.synthesis.crank_rocker.dead_centres import (
    LinkRatios,
    best_ratio,
    links_of_beta,
    links_of_ratio,
    transmission_angle_min,
)
from ilmek.units import deg
from ilmek.verification.claim import Claim

SWING = 30 * deg

PRINTED = {
    120: """75 0.2588 0.2588 1 1.00 0
            72 0.2449 0.2720 0.9735 0.90 4.33
            70 0.2353 0.2804 0.9556 0.84 4.66
            67 0.2203 0.2923 0.9285 0.75 4.13
            64 0.2047 0.3034 0.9015 0.67 2.78
            60 0.1830 0.3170 0.8660 0.58 0""",
    160: """70 0.2473 0.3062 0.9632 0.81 25.08
            65 0.2340 0.3513 0.9208 0.67 31.53
            57 0.2089 0.4177 0.8427 0.5 34.97
            55 0.2019 0.4331 0.8225 0.47 35.06
            53 0.1948 0.4479 0.7997 0.43 34.92
            43 0.1555 0.5136 0.6848 0.30 31.08
            35 0.1207 0.5550 0.5912 0.22 24.27
            30 0.0977 0.5755 0.5359 0.17 18.04""",
    180: """70 0.2518 0.3420 0.9728 0.74 40.82
            67 0.2467 0.3907 0.9530 0.63 48.52
            55 0.2195 0.5736 0.8481 0.38 63.18
            50 0.2053 0.6428 0.7931 0.32 66.26
            48 0.1991 0.6691 0.7694 0.30 67.24
            47 0.1960 0.6820 0.7572 0.29 67.70
            40 0.1722 0.7660 0.6655 0.22 70.25
            35 0.1537 0.8192 0.5940 0.19 71.58
            10 0.0465 0.9848 0.1798 0.05 74.76""",
    200: """70 0.2559 0.5157 1.0332 0.50 42.97
            67 0.2532 0.6680 1.0624 0.38 44.23
            66 0.2521 0.7184 1.0735 0.35 44.02
            60 0.2441 1.0157 1.1521 0.24 40.20
            50 0.2250 1.4848 1.3135 0.15 31.40
            40 0.1990 1.9088 1.4878 0.10 23.33
            30 0.1670 2.2749 1.6533 0.07 16.44
            25 0.1490 2.4326 1.7278 0.06 13.36
            10 0.0889 2.7905 1.9025 0.03 05.07""",
    210: "75 0.2589 0.5708 1.122 0.45 36.06",
}
"""Under phi [deg], a row each: beta [deg], a, b, c, r/l, mu_min [deg]."""

CASES = dict(zip(PRINTED, ("I", "II", "III", "IV", "V"), strict=True))

NOTES = {(160, 55, "c"): "Eq 3 gives 0.8215: one digit is wrong", (180, 35, "c"): "Eq 17, sin β/cos(ψ/2), gives 0.5938"}


class TableRow(NamedTuple):
    """One crank-rocker of the table: links by ground link, crank / coupler, least transmission angle [deg]."""

    a: float
    b: float
    c: float
    ratio: float
    mu_min: float


@cache
def computed(phi: int, beta: int) -> TableRow:
    """The row for a turn of the crank and a beta [deg], by Eqs 1 to 3; of Case V by Eqs 11 to 13."""
    free = abs(phi * deg - np.pi - SWING) < 1e-9
    found = (
        links_of_ratio(SWING, phi * deg, best_ratio(SWING, phi * deg))
        if free
        else links_of_beta(SWING, phi * deg, beta * deg)
    )
    a, b, c = (float(link) for link in found)
    return TableRow(a, b, c, a / b, _mu_min(a, b, c))


def _mu_min(a: float, b: float, c: float) -> float:
    """Least transmission angle [deg]."""
    # Rounded, because at the change points the last bit decides between a toggle and no linkage.
    return float(transmission_angle_min(LinkRatios(round(a, 12), round(b, 12), round(c, 12)))) / deg


def _mu_min_of_case_5(of: Mapping[str, float]) -> float:
    """The same of the links as printed."""
    return _mu_min(*(of[f"φ=210° β=75°: {link}"] for link in "abc"))


def rows() -> list[tuple[int, int, tuple[str, ...]]]:
    """phi, beta and the five numbers as printed, row by row."""
    split = [(phi, line.split()) for phi, text in PRINTED.items() for line in text.splitlines()]
    return [(phi, int(beta), tuple(numbers)) for phi, (beta, *numbers) in split]


def claims() -> tuple[Claim, ...]:
    """A claim for each of the 165 numbers."""
    columns = ("a", "b", "c", "r/l", "μ_min")
    return tuple(
        Claim(
            paper="beat-up",
            item=f"φ={phi}° β={beta}°: {column}",
            printed=text,
            unit="deg" if column == "μ_min" else "",
            compute=partial(_cell, phi, beta, index),
            source=f"Table 1, Case {CASES[phi]}",
            note=NOTES.get((phi, beta, column), ""),
            follows=_mu_min_of_case_5 if (phi, column) == (210, "μ_min") else None,
        )
        for phi, beta, numbers in rows()
        for index, (column, text) in enumerate(zip(columns, numbers, strict=True))
    )


def _cell(phi: int, beta: int, index: int) -> float:
    return computed(phi, beta)[index]
