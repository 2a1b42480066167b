"""The beat-up paper beside its table: bounds, the choice, lengths, masses, and motion and force of the beater."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial

import numpy as np
from scipy.optimize import minimize_scalar

from ilmek.dynamics.inertia import bar_moment
from ilmek.machines.beat_up import BeatUp, BeatUpParams, design
from ilmek.machines.beat_up.params import BEATER_RATIO
from ilmek.synthesis.crank_rocker.dead_centres import (
    LinkRatios,
    beta_limits,
    dead_centres,
    links_of_beta,
    links_of_ratio,
    ratio_limits,
    rotation_limits,
    transmission_angle_min,
)
from ilmek.units import deg
from ilmek.verification import beat_up_equations, beat_up_table
from ilmek.verification.beat_up_table import SWING
from ilmek.verification.claim import COUNT, OFF, UNSOUND, Claim

PAPER = "beat-up"


def claims() -> tuple[Claim, ...]:
    """All computable claims of the paper, in its order."""
    return (*beat_up_equations.claims(), *_bounds(), *beat_up_table.claims(), *_choice(), *_sizes(), *_beat())


_claim = partial(Claim, PAPER)


def _bounds() -> tuple[Claim, ...]:
    """The range of beta of each case study."""

    def end(phi: int, index: int) -> float:
        return float(beta_limits(SWING, phi * deg)[index]) / deg

    printed = {120: ("60", "75"), 160: ("20", "75"), 180: ("0", "75"), 200: ("0", "75")}
    return tuple(
        _claim(f"φ={phi}°: {side} β", text, "deg", partial(end, phi, index), f"Case study {beat_up_table.CASES[phi]}")
        for phi, texts in printed.items()
        for index, (side, text) in enumerate(zip(("least", "greatest"), texts, strict=True))
    )


def _choice() -> tuple[Claim, ...]:
    """The number of solutions, and the choice among them."""
    at = "3 Results and discussion"
    return (
        _claim(
            "solutions in all", "32", COUNT, lambda: len(beat_up_table.rows()), "4 Conclusions", "Table 1 has 33 rows"
        ),
        _claim(
            "crank rotation angles tried",
            "4",
            COUNT,
            lambda: len(beat_up_table.PRINTED),
            "Abstract",
            "five: 120°, 160°, 180°, 200°, 210°, as sections 2.1.3 and 3 say",
        ),
        _claim("φ of the least deviation of μ_min from 90°", "180", "deg", lambda: _best_row()[0], at),
        _claim(
            "case studies I to IV with a best β inside their range, 'in each case study'",
            "4",
            COUNT,
            _inner_optima,
            at,
            "at φ=180° μ_min only rises, to 75° as β falls to 0 and the crank vanishes: r/l decides there, not μ_min",
            missed=UNSOUND,
        ),
        _claim("β chosen at φ=180° (r/l = 0.30, 90°-μ_min < 40°)", "48", "deg", lambda: _chosen_row()[1], at),
        _claim("φ of the greatest μ_min at r/l = 0.3, 'most proper'", "180", "deg", _best_rotation, "Abstract, 3"),
        _claim(
            "90°-μ_min of the chosen linkage", "< 40", "deg", lambda: 90 - beat_up_table.computed(180, 48).mu_min, at
        ),
        _claim("swing of the chosen linkage", "30", "deg", _swing_of_chosen, "2.1.2, Table 1"),
    )


def _sizes() -> tuple[Claim, ...]:
    """Lengths of the chosen linkage, and masses and moments of the lengths as printed."""
    at = "2.1.4"
    lengths = {"crank": ("DC", "0.0597"), "coupler": ("CB", "0.2007"), "beater": ("AE", "0.3001")}
    masses = {"crank": ("DC", "0.129"), "coupler": ("CB", "0.434"), "rocker": ("AE", "0.649")}
    moments = {"crank": ("DC", "4.073e-5"), "coupler": ("CB", "0.0015"), "rocker": ("AE", "0.0049")}
    fitted = {"beater": f"AE = {BEATER_RATIO:g} AB"}
    notes = {"crank": "m (L² + w²)/12; the printed one is m (L² + (w/2)²)/12"}
    return (
        *(
            _claim(f"length {sign}", text, "m", partial(_length, bar), at, fitted=fitted.get(bar, ""))
            for bar, (sign, text) in lengths.items()
        ),
        *(_claim(f"mass {sign}", text, "kg", partial(_mass, bar), at) for bar, (sign, text) in masses.items()),
        *(
            _claim(f"moment of inertia {sign}", text, "kg m²", partial(_moment, bar), at, notes.get(bar, ""))
            for bar, (sign, text) in moments.items()
        ),
    )


def _beat() -> tuple[Claim, ...]:
    """Motion and forces of the beater."""
    turned = "with gravity the peak is 51 N to 88 N, by the direction of the loom"
    return (
        _claim("greatest acceleration of the beater", "25", "m/s²", _peak("beater_acceleration"), "Fig 6 (c), 3"),
        _claim(
            "force on the beater",
            "> 60",
            "N",
            _peak("beater_force"),
            "Abstract, Fig 6 (d)",
            fitted=f"no gravity; {turned}",
        ),
        _claim("peaks of the acceleration along the path, in two turns", "2", COUNT, _peaks_in_two_turns, "Fig 6 (c)"),
        _claim(
            "speed of the beater at the dead centres, by its greatest", "0", "", _speed_at_dead_centres, "3, Fig 6 (b)"
        ),
        _claim("acceleration of the beater at the beat", "25", "m/s²", _at_the_beat, "3, Fig 6 (c)"),
        *_angles_of_peaks(),
        _claim("greatest forces in joints B and C", "curve", "N", lambda: None, "Fig 7", "a curve without numbers"),
    )


def _angles_of_peaks() -> tuple[Claim, ...]:
    """Crank angles of greatest values, which the paper sees at the beat."""
    early = "a reading of a curve: the computed peak is {} of the crank before the beat, where the beater stops"
    joint = "greatest force in joint {}, 'at the beat-up position'"
    peaks = (
        ("beater_acceleration", "greatest acceleration, 'at the beating points'", "3, Fig 6 (c)", "7°"),
        ("B", joint.format("B"), "3, Fig 7", "10°"),
        ("C", joint.format("C"), "3, Fig 7", "9°"),
    )
    return (
        _claim(
            "crank angle of the greatest speed, 'at about beating point'",
            "48",
            "deg",
            _angle_of("beater_velocity"),
            "3, Fig 6 (b)",
            "the beat is the extended dead centre, where the beater stands still, as the paper says itself; it is "
            "fastest 69° before",
            missed=UNSOUND,
        ),
        *(
            _claim(f"crank angle of the {item}", "48", "deg", _angle_of(name), at, early.format(before), missed=OFF)
            for name, item, at, before in peaks
        ),
    )


@cache
def _as_printed() -> BeatUp:
    """The mechanism with the lengths of section 2.1.4."""
    lengths = {"crank": "59.7mm", "coupler": "200.7mm", "rocker": "230.8mm", "beater": "300.1mm"}
    return design(BeatUpParams.read({**lengths, "link_mass": "bars", "density": "7210kg/m^3"}))


@cache
def _exact() -> BeatUp:
    """The mechanism of phi = 180°, beta = 48°, not rounded."""
    return design(BeatUpParams.read({"beta": "48deg"}))


def _length(link: str) -> float:
    return _exact().lengths[link]


def _mass(link: str) -> float:
    return _as_printed().masses[link]


def _moment(link: str) -> float:
    params = _as_printed().params
    span = _as_printed().lengths["beater" if link == "rocker" else link]
    return float(bar_moment(_mass(link), span, params.width))


def _peak(name: str) -> Callable[[], float]:
    return lambda: _as_printed().peaks[name].value


def _at_the_beat() -> float:
    found = _as_printed()
    at = design(replace(found.params, crank_angle=found.beta)).at
    return float(np.abs(at.beater.acceleration)[0]) if at else math.nan


def _speed_at_dead_centres() -> float:
    found = _as_printed()
    speeds = [design(replace(found.params, crank_angle=at)).at for at in (found.beta, found.back_angle)]
    most = found.peaks["beater_velocity"].value
    return max(float(np.abs(at.beater.velocity)[0]) for at in speeds if at) / most


def _angle_of(name: str) -> Callable[[], float]:
    """Crank angle of a greatest value [deg]."""
    return lambda: _as_printed().peaks[name].at / deg


def _peaks_in_two_turns() -> int:
    """Maxima of the signed acceleration along the path: toward the beat in one direction, back in the other."""
    state = _as_printed().state
    along = np.real(np.conj(1j * state.motion.direction("rocker")) * state.beater.acceleration)[:-1]
    return 2 * int(np.count_nonzero((along > np.roll(along, 1)) & (along >= np.roll(along, -1))))


def _row_values() -> list[tuple[int, int, beat_up_table.TableRow]]:
    return [(phi, beta, beat_up_table.computed(phi, beta)) for phi, beta, _ in beat_up_table.rows()]


def _best_row() -> tuple[int, int]:
    phi, beta, _ = max(_row_values(), key=lambda row: row[2].mu_min)
    return phi, beta


def _chosen_row() -> tuple[int, int]:
    """The row with the greatest r/l that is not above 0.3 as printed and a sufficient transmission angle."""
    good = [row for row in _row_values() if round(row[2].ratio, 2) <= 0.3 and row[2].mu_min > 50]
    phi, beta, _ = max(good, key=lambda row: row[2].ratio)
    return phi, beta


def _inner_optima() -> int:
    """Cases I to IV whose greatest transmission angle lies inside the range of beta, not at one of its ends."""
    found = 0
    for phi in (120, 160, 180, 200):
        low, high = beta_limits(SWING, phi * deg)
        beta = np.linspace(float(low), float(high), 2001)[1:-1]
        best = int(np.argmax(transmission_angle_min(links_of_beta(SWING, phi * deg, beta))))
        found += 0 < best < len(beta) - 1
    return found


def _best_rotation() -> float:
    """Crank rotation of the greatest transmission angle among all crank-rockers of the ratio 0.3 [deg]."""
    low, high = (float(end) for end in rotation_limits(SWING))

    def lack(rotation: float) -> float:
        least, greatest = ratio_limits(SWING, rotation)
        if not least < 0.3 < greatest:
            return np.pi / 2
        return np.pi / 2 - float(transmission_angle_min(links_of_ratio(SWING, rotation, 0.3)))

    near = min(np.linspace(low, high, 182)[1:-1], key=lack)
    found = minimize_scalar(lack, bounds=(near - 1 * deg, near + 1 * deg), method="bounded", options={"xatol": 1e-9})
    return float(found.x) / deg


def _swing_of_chosen() -> float:
    """From the links as Table 1 prints them: 0.1991, 0.6691, 0.7694."""
    texts = next(numbers for phi, beta, numbers in beat_up_table.rows() if (phi, beta) == (180, 48))
    return float(dead_centres(LinkRatios(*(float(text) for text in texts[:3]))).swing) / deg
