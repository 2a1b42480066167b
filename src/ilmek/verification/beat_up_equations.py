"""Equations 1 to 18 of the beat-up paper, each tested on crank-rockers found without it.

A crank-rocker of the right family is known by its links in the two dead centres; the equations are tried on members
of many turns and betas, or at the ends that they give.
"""

from functools import partial

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.synthesis.crank_rocker.dead_centres import (
    DeadCentres,
    LinkRatios,
    dead_centres,
    grashof_margin,
    links_of_beta,
    links_of_coupler,
    links_of_ratio,
    ratio_limits,
    rotation_limits,
    transmission_angle_min,
    transmission_angles,
)
from ilmek.units import deg
from ilmek.verification.beat_up_table import SWING
from ilmek.verification.claim import RESIDUAL, UNSOUND, Claim, equation, residual

SMALL, LARGE = (105.5, 179.0), (181.0, 284.5)
"""Crank rotations below and above 180 deg that are tested [deg]."""


def claims() -> tuple[Claim, ...]:
    """The equations, in the paper's order."""
    return (
        _equation("1", "a = -sin(α1) cos(β1)/sin(α2),  b = sin(α1) sin(β1)/cos(α2)", _eq_1),
        _equation("3", "c² = (a+b)² + 1 - 2 (a+b) cos β", _eq_3),
        _equation("4, 5", "c² = K1 + K2 cos(α3+2β) + K2²/2 cos(2α3+2β)", _eq_4),
        _equation("6", "180° < φ < 180°+ψ: 90°-ψ/2 ≥ β ≥ 0", _eq_6),
        Claim(
            "beat-up",
            "Eq 6 beyond 180°+ψ",
            "φ > 180°: 90°-ψ/2 ≥ β ≥ 0",
            RESIDUAL,
            _eq_6_beyond,
            "Eq 6",
            "stated for every φ > 180°; beyond 180°+ψ the range is 90°-ψ/2 ≤ β ≤ 360°-φ. The paper's own φ = 200° "
            "lies below",
            missed=UNSOUND,
        ),
        _equation("7", "φ > 180°: cos μ_min = (b²+c²-(1-a)²)/(2bc)", partial(_transmission, -1, 1, LARGE)),
        _equation("8", "φ < 180°: 90°-ψ/2 ≥ β ≥ 180°-φ", _eq_8),
        _equation(
            "9",
            "φ < 180°: cos μ_min = (b²+c²-(1+a)²)/(2bc)",
            partial(_transmission, 1, 1, SMALL),
            "sign: cos μ_min = ((1+a)²-b²-c²)/(2bc), as Table 1 uses; as printed it is the obtuse greatest angle",
            partial(_transmission, 1, -1, SMALL),
        ),
        _equation("10, 11", "φ = 180°+ψ: a = cos β = -cos(φ/2)", _eq_11),
        _equation("12, 13", "φ = 180°+ψ: b = √(a(1+a)),  c = √(1+a)", _eq_12),
        _equation("14", "φ = 180°+ψ: cos μ_min = 2√a/(1+a)", _eq_14),
        _equation("15 to 17", "φ = 180°: a = tan(ψ/2) sin β, b = cos β, c = sin β/cos(ψ/2), c² = 1+a²-b²", _eq_16),
        _equation("18", "φ = 180°: cos μ_min = a/(bc) = sin(ψ/2)/cos β", _eq_18),
    )


_equation = partial(equation, "beat-up", "Eq {}")


def _members(turns: tuple[float, float]) -> tuple[LinkRatios, DeadCentres]:
    """Crank-rockers with crank rotations in an interval [deg], and their properties, measured at their dead centres."""
    rotation, share = (np.ravel(grid) for grid in np.meshgrid(np.linspace(*turns, 23) * deg, [0.2, 0.5, 0.8]))
    low, high = ratio_limits(SWING, rotation)
    links = links_of_ratio(SWING, rotation, low + share * (high - low))
    return links, dead_centres(links)


def _all_members() -> tuple[LinkRatios, DeadCentres]:
    return _members((float(rotation_limits(SWING).low / deg) + 0.5, float(rotation_limits(SWING).high / deg) - 0.5))


def _eq_1() -> float:
    links, done = _all_members()
    a1, a2, b1 = done.swing / 2, (done.rotation - done.swing) / 2, done.rotation / 2 + done.beta
    crank = residual(-np.sin(a1) * np.cos(b1), links.crank * np.sin(a2))
    return max(crank, residual(np.sin(a1) * np.sin(b1), links.coupler * np.cos(a2)))


def _eq_3() -> float:
    links, done = _all_members()
    reach = links.crank + links.coupler
    return residual(links.rocker**2, reach**2 + 1 - 2 * reach * np.cos(done.beta))


def _eq_4() -> float:
    links, done = _members(LARGE)
    a1, a2, a3 = done.swing / 2, (done.rotation - done.swing) / 2, done.rotation - done.swing / 2
    k2 = 2 * np.sin(a1) / np.sin(2 * a2)
    k1 = 1 + k2 * np.cos(a3) + k2**2 / 2
    right = k1 + k2 * np.cos(a3 + 2 * done.beta) + k2**2 / 2 * np.cos(2 * a3 + 2 * done.beta)
    return residual(links.rocker**2, right)


def _change_point(rotation: FloatArray, beta: FloatArray) -> float:
    """Distance of the linkages of these betas from a change point or a crank of zero length."""
    links = links_of_beta(SWING, rotation, beta)
    return float(np.max(np.minimum(np.abs(grashof_margin(links)), np.abs(links.crank))))


def _eq_6() -> float:
    return _ends_of_eq_6(np.linspace(181, 209, 29) * deg)


def _eq_6_beyond() -> float:
    return _ends_of_eq_6(np.linspace(211, 280, 70) * deg)


def _ends_of_eq_6(rotation: FloatArray) -> float:
    return max(_change_point(rotation, 0 * rotation), _change_point(rotation, 0 * rotation + np.pi / 2 - SWING / 2))


def _eq_8() -> float:
    rotation = np.linspace(*SMALL, 23) * deg
    upper = _change_point(rotation, 0 * rotation + np.pi / 2 - SWING / 2)
    return max(upper, _change_point(rotation, np.pi - rotation))


def _transmission(side: int, sign: int, turns: tuple[float, float]) -> float:
    """Residual of cos mu = sign (b² + c² - (1 + side a)²) / (2bc)."""
    (a, b, c), _ = _members(turns)
    at_zero, at_half_turn = transmission_angles(LinkRatios(a, b, c))
    least = np.minimum(at_zero, np.pi - at_half_turn)
    return residual(np.cos(least), sign * (b**2 + c**2 - (1 + side * a) ** 2) / (2 * b * c))


def _free_couplers() -> LinkRatios:
    return links_of_coupler(SWING, np.pi + SWING, np.linspace(0.3, 2.0, 40))


def _eq_11() -> float:
    links = _free_couplers()
    beta = dead_centres(links).beta
    return max(residual(links.crank, np.cos(beta)), residual(links.crank, -np.cos((np.pi + SWING) / 2)))


def _eq_12() -> float:
    # The coupler is free here; Eqs 12 and 13 pick the member whose triangle in Fig 4 has a right angle.
    a = float(np.sin(SWING / 2))
    b, c = np.sqrt(a * (1 + a)), np.sqrt(1 + a)
    links = links_of_coupler(SWING, np.pi + SWING, b)
    return max(residual(links.crank, a), residual(links.rocker, c), residual((1 + a) ** 2, b**2 + c**2))


def _eq_14() -> float:
    a = float(np.sin(SWING / 2))
    links = links_of_coupler(SWING, np.pi + SWING, np.sqrt(a * (1 + a)))
    return residual(np.cos(transmission_angle_min(links)), 2 * np.sqrt(a) / (1 + a))


def _centric() -> tuple[LinkRatios, FloatArray]:
    beta = np.linspace(1, 74, 74) * deg
    return links_of_beta(SWING, np.pi, beta), beta


def _eq_16() -> float:
    (a, b, c), beta = _centric()
    of_crank, of_coupler = residual(a, np.tan(SWING / 2) * np.sin(beta)), residual(b, np.cos(beta))
    return max(of_crank, of_coupler, residual(c, np.sin(beta) / np.cos(SWING / 2)), residual(c**2, 1 + a**2 - b**2))


def _eq_18() -> float:
    links, beta = _centric()
    cosine = np.cos(transmission_angle_min(links))
    in_links = residual(cosine, links.crank / (links.coupler * links.rocker))
    return max(in_links, residual(cosine, np.sin(SWING / 2) / np.cos(beta)))
