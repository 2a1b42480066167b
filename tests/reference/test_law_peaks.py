"""Motion laws against the exact factors of the literature: VDI 2143, Norton's Cam Design and Manufacturing Handbook.

Peaks of a rise of 1 in a time of 1: Cv, Ca, Cj, the torque factor Cm = max |v a|, and the rms acceleration.
"""

import math

import numpy as np
import pytest

from ilmek.cams.laws import LAWS, SMOOTH_LAWS, law_of
from ilmek.num.piecewise import integral, supremum

PI = math.pi
ROOT = math.sqrt
FACTORS = {
    #                  Cv                  Ca                     Cj (inside)                Cm        rms a
    "parabolic": (2.0, 4.0, 0.0, 8.0, 4.0),
    "cubic": (1.5, 6.0, 12.0, 2 * ROOT(3), 2 * ROOT(3)),
    "harmonic": (PI / 2, PI**2 / 2, PI**3 / 2, PI**3 / 8, 3.489432),
    "cycloidal": (2.0, 2 * PI, 4 * PI**2, 8.162097, 4.442883),
    "3-4-5": (15 / 8, 10 / ROOT(3), 60.0, 6.694269, 4.140393),
    "4-5-6-7": (35 / 16, 84 * ROOT(5) / 25, 52.5, 10.750226, 5.045250),
    "modified-sine": (4 * PI / (PI + 4), 4 * PI**2 / (PI + 4), 16 * PI**3 / (PI + 4), 5.457753, 3.908856),
    "modified-trapezoid": (2.0, 8 * PI / (PI + 2), 32 * PI**2 / (PI + 2), 8.089981, 4.233239),
}
"""The printed factors; where two are closed forms and the rest are printed to seven figures, so are they here."""

EVEN = {
    #    Cv       Ca        Cj      of the modified sine with a share of constant velocity
    0.20: (1.52754, 5.99863, 94.226),
    1 / 3: (1.40409, 6.61660, 124.720),
    0.50: (1.27526, 8.01268, 201.381),
    2 / 3: (1.16808, 11.00893, 415.027),
}
SPECIAL = {
    "parabolic": (0.0, 1.0, 0.0),
    "harmonic": (0.0, 0.0, 1.0),
    "modified-trapezoid": (0.25, 0.5, 0.25),
    "modified-sine": (0.25, 0.0, 0.75),
    "cycloidal": (0.5, 0.0, 0.5),
}
"""(b, c, d) of the SCCA family."""


@pytest.mark.parametrize("name", FACTORS)
def test_closed_forms_are_the_printed_factors(name: str) -> None:
    law, (cv, ca, cj, cm, rms) = LAWS[name], FACTORS[name]
    assert (law.velocity_peak, law.acceleration_peak) == pytest.approx((cv, ca), rel=1e-12)
    assert law.torque_peak == pytest.approx(cm, rel=1e-7)
    assert law.acceleration_rms == pytest.approx(rms, rel=2e-7)
    jumps_against_a_dwell = abs(float(law.a(0.0))) > 1e-12
    assert math.isinf(law.jerk_peak) == jumps_against_a_dwell
    if not jumps_against_a_dwell:
        assert law.jerk_peak == pytest.approx(cj, rel=1e-12)


@pytest.mark.parametrize("name", SMOOTH_LAWS)
def test_declared_peaks_are_those_of_the_curves(name: str) -> None:
    law = LAWS[name]
    knots = np.array([0.0, *law.breaks, 1.0])
    velocity, acceleration, jerk, torque = (
        supremum(lambda u, f=f: np.abs(f(u)), knots).value
        for f in (law.v, law.a, law.j, lambda u: np.asarray(law.v(u)) * law.a(u))
    )
    assert (velocity, acceleration, torque) == pytest.approx(
        (law.velocity_peak, law.acceleration_peak, law.torque_peak), rel=1e-11
    )
    if math.isfinite(law.jerk_peak):
        assert jerk == pytest.approx(law.jerk_peak, rel=1e-10)
    elif name in FACTORS:
        assert jerk == pytest.approx(FACTORS[name][2], rel=1e-10)
    rms = math.sqrt(integral(lambda u: np.asarray(law.a(u)) ** 2, knots))
    assert rms == pytest.approx(law.acceleration_rms, rel=1e-12)


@pytest.mark.parametrize("share", EVEN)
def test_modified_sine_with_constant_velocity(share: float) -> None:
    law = law_of("modified-sine", {"constant_velocity": share})
    assert (law.velocity_peak, law.acceleration_peak, law.jerk_peak) == pytest.approx(EVEN[share], rel=5e-6)
    middle = np.linspace(0.5 - 0.499 * share, 0.5 + 0.499 * share, 9)
    np.testing.assert_allclose(law.v(middle), law.velocity_peak, rtol=1e-14)
    assert not np.any(law.a(middle))
    assert not np.any(law.j(middle))


@pytest.mark.parametrize("name", SPECIAL)
def test_five_laws_are_one_formula(name: str) -> None:
    """SCCA at their b, c, d: the same curves, and the peak of Norton's closed form."""
    b, c, d = SPECIAL[name]
    law, member = LAWS[name], law_of("scca", {"b": b, "c": c, "d": d})
    u = np.linspace(0, 1, 400)
    for own, common in ((law.s, member.s), (law.v, member.v), (law.a, member.a), (law.j, member.j)):
        np.testing.assert_allclose(common(u), own(u), rtol=1e-13, atol=2e-13)
    peak = 4 * PI**2 / ((PI**2 - 8) * (b**2 - d**2) - 2 * PI * (PI - 2) * b + PI**2)
    assert member.acceleration_peak == pytest.approx(peak, rel=1e-14)
    assert member.velocity_peak == pytest.approx(law.velocity_peak, rel=1e-14)
    assert member.torque_peak == pytest.approx(law.torque_peak, rel=1e-13)
    assert member.acceleration_rms == pytest.approx(law.acceleration_rms, rel=1e-13)


def test_modified_trapezoid_is_continuous_at_all_its_borders() -> None:
    law = LAWS["modified-trapezoid"]
    borders = np.array([1, 3, 5, 7]) / 8
    assert law.breaks == tuple(borders)
    np.testing.assert_allclose(law.s(0.125), 0.125 * law.acceleration_peak / (4 * PI) * (1 - 2 / PI), rtol=1e-13)
    for curve in (law.s, law.v, law.a):
        np.testing.assert_allclose(curve(borders - 1e-13), curve(borders + 1e-13), atol=2e-11)


def test_polynomials_of_the_tables_come_out_of_the_free_one() -> None:
    u = np.linspace(0, 1, 101)
    for name, start, end in (
        ("cubic", (0, 0), (1, 0)),
        ("3-4-5", (0, 0, 0), (1, 0, 0)),
        ("4-5-6-7", (0, 0, 0, 0), (1, 0, 0, 0)),
        ("uniform", (0,), (1,)),
    ):
        law, free = LAWS[name], law_of("polynomial", {"start": start, "end": end})
        for own, made in ((law.s, free.s), (law.v, free.v), (law.a, free.a), (law.j, free.j)):
            np.testing.assert_allclose(made(u), own(u), rtol=1e-11, atol=1e-11)
        assert free.velocity_peak == pytest.approx(law.velocity_peak, rel=1e-12)


def test_cubic_has_the_least_rms_and_parabolic_the_least_acceleration() -> None:
    assert min(SMOOTH_LAWS, key=lambda name: LAWS[name].acceleration_rms) == "cubic"
    assert min(SMOOTH_LAWS, key=lambda name: LAWS[name].acceleration_peak) == "parabolic"
    assert LAWS["modified-sine"].acceleration_peak / LAWS["cycloidal"].acceleration_peak == pytest.approx(
        0.88, abs=0.01
    )
    assert LAWS["modified-sine"].torque_peak / LAWS["cycloidal"].torque_peak == pytest.approx(0.67, abs=0.01)


def test_names_are_those_of_the_documentation() -> None:
    names = "uniform modified-uniform parabolic cubic harmonic cycloidal 3-4-5 4-5-6-7 modified-sine modified-trapezoid"
    assert list(LAWS) == [*names.split(), "scca", "spline", "polynomial", "s-curve"]
    assert set(LAWS) - set(SMOOTH_LAWS) == {"uniform"}
    assert all(LAWS[name].name == name for name in LAWS)


def test_thesis_equations_2_50_to_2_56_corrected() -> None:
    """Eq. 2.49-2.51 and 2.54-2.56 in the corrected form, at lift 60 mm, rise 90 deg, 5 rpm."""
    lift, span, speed = 0.06, PI / 2, 5 * 2 * PI / 60
    theta = np.linspace(0.0, span, 19)
    u, rate = theta / span, speed / span
    harmonic, cycloidal = LAWS["harmonic"], LAWS["cycloidal"]
    np.testing.assert_allclose(lift * harmonic.s(u), lift / 2 * (1 - np.cos(PI * theta / span)), atol=1e-17)
    np.testing.assert_allclose(
        lift * rate * harmonic.v(u), PI * lift / (2 * span) * np.sin(PI * theta / span) * speed, atol=1e-17
    )
    np.testing.assert_allclose(
        lift * rate**2 * harmonic.a(u), PI**2 * lift / (2 * span**2) * np.cos(PI * theta / span) * speed**2, atol=1e-16
    )
    np.testing.assert_allclose(
        lift * rate * cycloidal.v(u), lift * speed / span * (1 - np.cos(2 * PI * theta / span)), atol=1e-16
    )
    np.testing.assert_allclose(
        lift * rate**2 * cycloidal.a(u),
        2 * PI * lift * speed**2 / span**2 * np.sin(2 * PI * theta / span),
        atol=1e-16,
    )
