"""Rows of `ilmek reproduce` that rest on a judgement, each against a computation that shares no code with them."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from ilmek.verification import Verdict, reproduce
from ilmek.verification.beat_up_equations import claims as equations_of_beat_up
from ilmek.verification.judgement import judge

SWING = math.radians(30)


@pytest.fixture(scope="module")
def rows() -> dict[str, Verdict]:
    return {verdict.claim.item: verdict for verdict in reproduce(["beat-up", "thesis", "tufting", "knotting"])}


def crank_rocker(phi: float, beta: float) -> tuple[float, float, float]:
    """Links by ground link, from the two dead centres [deg]; from one to the other the rocker turns by 30°.

    (b-a) e^{i(beta+phi-180)} - 1 = [(a+b) e^{i beta} - 1] e^{i psi}, linear in a and b.
    """
    turned, out, swung = (np.exp(1j * angle) for angle in (np.radians(beta + phi - 180), np.radians(beta), SWING))
    of_crank, of_coupler, right = -turned - out * swung, turned - out * swung, 1 - swung
    matrix = [[of_crank.real, of_coupler.real], [of_crank.imag, of_coupler.imag]]
    a, b = np.linalg.solve(matrix, [right.real, right.imag])
    return float(a), float(b), float(abs((a + b) * out - 1))


def turns(a: float, b: float, c: float) -> bool:
    """Whether a is the shortest of positive links and turns fully: on the ground line both triangles close."""
    return 0 < a < min(b, c, 1) and all(abs(b - c) < side < b + c for side in (1 - a, 1 + a))


def least_angle(a: float, b: float, c: float) -> float:
    """The least transmission angle [deg], from both triangles on the ground line."""
    cosines = [(b * b + c * c - side * side) / (2 * b * c) for side in (1 - a, 1 + a)]
    return math.degrees(math.acos(max(abs(cosine) for cosine in cosines)))


@pytest.mark.parametrize("phi", [182.0, 200.0, 208.0])
def test_eq_6_holds_up_to_180_plus_psi(phi: float) -> None:
    assert all(turns(*crank_rocker(phi, beta)) for beta in np.linspace(0.1, 74.9, 200))
    assert not any(turns(*crank_rocker(phi, beta)) for beta in np.linspace(75.1, 90, 50))
    a, b, c = crank_rocker(phi, 0.0)
    assert abs(1 - a - b) == pytest.approx(c)  # a change point: all links lie on the ground line


@pytest.mark.parametrize("phi", [212.0, 240.0, 270.0])
def test_eq_6_does_not_hold_beyond(phi: float) -> None:
    assert not any(turns(*crank_rocker(phi, beta)) for beta in np.linspace(0.1, 74.9, 200))
    assert all(turns(*crank_rocker(phi, beta)) for beta in np.linspace(75.1, 360 - phi - 0.1, 200))


def test_verdicts_on_eq_6() -> None:
    found = {claim.item: judge(claim).verdict for claim in equations_of_beat_up() if claim.item.startswith("Eq 6")}
    assert found == {"Eq 6": "reproduced", "Eq 6 beyond 180°+ψ": "unsound"}


@pytest.mark.parametrize(("phi", "low"), [(120, 60.0), (160, 20.0), (200, 0.0)])
def test_three_case_studies_have_a_best_beta_inside(phi: int, low: float) -> None:
    angles = [least_angle(*crank_rocker(phi, beta)) for beta in np.linspace(low, 75, 302)[1:-1]]
    assert 0 < int(np.argmax(angles)) < len(angles) - 1


def test_at_180_deg_the_transmission_angle_rises_to_75_deg_as_beta_falls() -> None:
    angles = [least_angle(*crank_rocker(180, beta)) for beta in (48, 30, 10, 1, 0.01)]
    assert angles == sorted(angles)
    assert angles[-1] == pytest.approx(75, abs=1e-3)
    assert crank_rocker(180, 0.01)[0] < 1e-4


def test_180_deg_has_the_greatest_transmission_angle_of_all_with_a_ratio_of_0_3(rows: dict[str, Verdict]) -> None:
    def angle(phi: float) -> float:
        def over(beta: float) -> float:
            a, b, _ = crank_rocker(phi, beta)
            return a / b - 0.3

        low, high = (180 - phi if phi < 180 else 0.0) + 1e-6, 75 - 1e-6
        if over(low) * over(high) > 0:
            return 0.0  # no crank-rocker of this ratio
        return least_angle(*crank_rocker(phi, float(brentq(over, low, high))))

    assert angle(180) == pytest.approx(67.136707, abs=1e-6)
    assert all(angle(phi) < angle(180) for phi in (*np.linspace(120, 179.9, 40), *np.linspace(180.1, 208, 40)))
    assert rows["φ of the greatest μ_min at r/l = 0.3, 'most proper'"].computed == pytest.approx(180, abs=1e-6)


def beater() -> tuple[np.ndarray, np.ndarray]:
    """Speed [m/s] and acceleration [m/s²] of E along its path over a turn, by Fourier series of the rocker's angle."""
    crank, coupler, rocker, ground = 0.0597, 0.2007, 0.2308, 0.3
    pin = crank * np.exp(1j * np.arange(4096) * 2 * np.pi / 4096)
    span = pin - ground
    lean = np.arccos((rocker**2 + np.abs(span) ** 2 - coupler**2) / (2 * rocker * np.abs(span)))
    angle = np.angle(span) % (2 * np.pi) - lean
    order = 1j * np.fft.fftfreq(4096, 1 / 4096) * 15.5
    speed, acceleration = (np.real(np.fft.ifft(order**power * np.fft.fft(angle))) for power in (1, 2))
    return 0.3001 * speed, 0.3001 * acceleration


def test_the_signed_acceleration_has_one_peak_a_turn(rows: dict[str, Verdict]) -> None:
    _, along = beater()
    peaks = (along > np.roll(along, 1)) & (along >= np.roll(along, -1))
    assert (
        np.count_nonzero(peaks)
        == np.count_nonzero((-along > np.roll(-along, 1)) & (-along >= np.roll(-along, -1)))
        == 1
    )
    assert float(np.max(np.abs(along))) == pytest.approx(25.431, abs=1e-3)
    assert rows["peaks of the acceleration along the path, in two turns"].verdict == "reproduced"


def test_the_peaks_of_the_curves_lie_before_the_beat(rows: dict[str, Verdict]) -> None:
    speed, along = beater()
    whole = np.hypot(along, speed**2 / 0.3001)
    at = 360 * int(np.argmax(whole)) / 4096
    found = rows["crank angle of the greatest acceleration, 'at the beating points'"]
    assert found.computed == pytest.approx(at, abs=0.1)
    assert found.verdict == "off"
    fastest = rows["crank angle of the greatest speed, 'at about beating point'"]
    assert fastest.computed == pytest.approx(360 * int(np.argmax(np.abs(speed))) / 4096, abs=0.1)
    assert fastest.verdict == "unsound"


def least_radius(inner: float, span: float, modulus: float) -> float:
    """Of a tube [mm] for a slope of 0.004 under 9 kN: W l²/(24 E I) with I = pi/4 (Ro⁴ - Ri⁴)."""
    inertia = 9000 * (1000 * span) ** 2 / (24 * 1000 * modulus * 0.004)
    return float((inner**4 + 4 * inertia / math.pi) ** 0.25)


@pytest.mark.parametrize(("inner", "narrow"), [(50, "51.562"), (75, "75.480"), (100, "100.204")])
def test_column_2_of_table_3_1_belongs_to_a_longer_beam(inner: int, narrow: str, rows: dict[str, Verdict]) -> None:
    found = rows[f"R_inner {inner} mm: least R_outer"]
    assert found.computed == pytest.approx(least_radius(inner, 1.25, 210), abs=1e-9)
    assert f"{least_radius(inner, 1.2, 210):.3f}" == narrow
    assert found.claim.fitted.endswith(f"on the beam of y_max, 1.2 m, it is {narrow} mm")
    assert found.verdict == "reproduced"


@pytest.mark.parametrize(("span", "modulus"), [(1.22, 200), (1.2, 193)])
def test_other_beams_fit_column_2_as_well(span: float, modulus: float) -> None:
    assert least_radius(100, span, modulus) == pytest.approx(100.22, abs=0.005)


def test_columns_2_and_4_have_different_lengths(rows: dict[str, Verdict]) -> None:
    inertia = {outer: math.pi / 4 * (outer**4 - 50**4) for outer in (51.69, 60)}
    of_slope = math.sqrt(0.004 * 24 * 210e3 * inertia[51.69] / 9000)
    of_sag = {factor: (0.037 * 384 * 210e3 * inertia[60] / (factor * 9000)) ** (1 / 3) for factor in (1, 5)}
    assert rows["one beam in columns 2 and 4"].computed == pytest.approx(1 - of_sag[1] / of_slope, rel=1e-9)
    assert 1 - of_sag[1] / of_slope == pytest.approx(0.04, abs=0.005)
    assert 1 - of_sag[5] / of_slope == pytest.approx(0.44, abs=0.005)


def test_the_slope_of_the_tube_is_that_of_the_beam_of_its_deflection(rows: dict[str, Verdict]) -> None:
    inertia = math.pi / 4 * (70**4 - 65**4)
    sag, slope = 5 * 9000 * 1200**3 / (384 * 210e3 * inertia), 9000 * 1200**2 / (24 * 210e3 * inertia)
    assert rows["tube 140 x 5 mm: y_max"].computed == pytest.approx(sag, rel=1e-9)
    assert rows["tube 140 x 5 mm: slope"].computed == pytest.approx(slope, rel=1e-9)
    assert rows["tube 140 x 5 mm: slope"].verdict == "misprint"


def test_the_load_of_the_shaft_and_the_motor(rows: dict[str, Verdict]) -> None:
    load = rows["resultant of weight and 600 warps of 10 N"]
    assert load.computed == pytest.approx(math.hypot(550 * 9.81, 6000), rel=1e-9)
    assert math.hypot(5489, 6000) == pytest.approx(8132, abs=0.5)
    assert math.hypot(5589, 6000) == pytest.approx(8200, abs=0.5)
    motor = next(verdict for item, verdict in rows.items() if item.startswith("cylinder's torque from 7 N m"))
    assert (motor.computed, motor.verdict) == (350, "unsound")
    assert 2 * 630 / 100 == 12.6


def test_16_919_follows_from_the_right_number_beside_the_slip(rows: dict[str, Verdict]) -> None:
    root = {p1: math.sqrt(p1 / 0.152 + 1 / 0.003481 + 1 / 6.666) for p1 in (-0.174, -0.274)}
    assert root[-0.174] == pytest.approx(16.919, abs=1e-3)
    assert abs(root[-0.274] - 16.919) > 0.015
    slip = rows["case 1: p1 in the root"]
    assert (slip.claim.printed, slip.verdict) == ("-0.274", "misprint")
    assert slip.computed == pytest.approx(2 * math.cos(math.radians(10 - 275)))


def test_the_discrete_criteria_see_the_points_only(rows: dict[str, Verdict]) -> None:
    assert rows["Eq 2.7"].verdict == "misprint"
    assert rows["Eq 2.10 f., text"].verdict == "misprint"
    # 1, x²: D(x, x) = 0 as of every system, and D(-x, x) = 0 too
    assert np.linalg.det([[1, 0.25], [1, 0.25]]) == 0


def test_every_equation_of_the_tufting_paper_has_a_row(rows: dict[str, Verdict]) -> None:
    named = [item for item, verdict in rows.items() if verdict.claim.paper == "tufting" and "Eq" in item]
    spans = [item.replace("Eq ", "").split(":")[0] for item in named]
    covered = set()
    for text in spans:
        numbers = [
            int("".join(filter(str.isdigit, word))) for word in text.replace(",", " ").split() if word[0].isdigit()
        ]
        covered |= set(range(numbers[0], numbers[-1] + 1)) if " to " in text else set(numbers)
    assert covered | {43} >= set(range(1, 44))


def test_no_row_is_an_input_once_more(rows: dict[str, Verdict]) -> None:
    gone = ("displacement of a warp at 90°", "opening of the shed at 90°", "time of 360°", "ρ1")
    assert not [item for item in gone if item in rows]
