"""Motion laws against the exact factors of the literature: VDI 2143, Norton's Cam Design and Manufacturing Handbook.

Peaks of a rise of 1 in a time of 1: Cv, Ca, Cj, the torque factor Cm = max |v a|, and the rms acceleration.
"""

import math

import numpy as np
import pytest

from ilmek.cams.laws import LAWS
from ilmek.cams.pieces import integral, supremum

PI = math.pi
FACTORS = {
    #                  Cv                  Ca                     Cj (inside)                Cm        rms a
    "parabolic": (2.0, 4.0, 0.0, 8.0, 4.0),
    "harmonic": (PI / 2, PI**2 / 2, PI**3 / 2, PI**3 / 8, 3.489432),
    "cycloidal": (2.0, 2 * PI, 4 * PI**2, 8.162097, 4.442883),
    "3-4-5": (15 / 8, 10 / math.sqrt(3), 60.0, 6.694269, 4.140393),
    "modified-sine": (4 * PI / (PI + 4), 4 * PI**2 / (PI + 4), 16 * PI**3 / (PI + 4), 5.457753, 3.908856),
}
PRINTED = {
    "parabolic": (2.0, 4.0),
    "harmonic": (1.570796, 4.934802),
    "cycloidal": (2.0, 6.283185),
    "3-4-5": (1.875, 5.773503),
    "modified-sine": (1.759603, 5.527957),
}


@pytest.mark.parametrize("name", LAWS)
def test_peak_factors(name: str) -> None:
    law, (cv, ca, cj, cm, rms) = LAWS[name], FACTORS[name]
    knots = np.array([0.0, *law.breaks, 1.0])
    velocity, acceleration, jerk, torque = (
        supremum(lambda u, f=f: np.abs(f(u)), knots).value
        for f in (law.v, law.a, law.j, lambda u: np.asarray(law.v(u)) * law.a(u))
    )
    assert velocity == pytest.approx(cv, rel=1e-12)
    assert acceleration == pytest.approx(ca, rel=1e-11)
    assert jerk == pytest.approx(cj, rel=1e-10)
    assert torque == pytest.approx(cm, rel=2e-7)
    assert math.sqrt(integral(lambda u: np.asarray(law.a(u)) ** 2, knots)) == pytest.approx(rms, rel=2e-7)


@pytest.mark.parametrize("name", LAWS)
def test_declared_peaks_are_the_printed_ones(name: str) -> None:
    law = LAWS[name]
    assert (law.velocity_peak, law.acceleration_peak) == pytest.approx(PRINTED[name], rel=1e-6)
    jumps_against_a_dwell = abs(float(law.a(0.0))) > 1e-12
    assert math.isinf(law.jerk_peak) == jumps_against_a_dwell
    if not jumps_against_a_dwell:
        assert law.jerk_peak == pytest.approx(FACTORS[name][2], rel=1e-14)


def test_names_are_those_of_the_documentation() -> None:
    assert list(LAWS) == ["harmonic", "parabolic", "cycloidal", "3-4-5", "modified-sine"]


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
