"""Plate cams against exact cases: the shedding cam's closed forms, the eccentric circle, the parallel curve."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.cams import profile
from ilmek.cams.laws import LAWS, SMOOTH_LAWS
from ilmek.cams.limits import (
    area,
    concave_radius_min,
    convex_radius_min,
    pressure_angle_max,
    undercut,
)
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme, dwell, fall, rise
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.errors import ParameterError
from ilmek.units import deg, mm

HARMONIC = LAWS["harmonic"]


def opposed(lift, span, law=HARMONIC) -> CamProgramme:
    return CamProgramme((rise(span, lift, law), fall(span, lift, law), dwell(2 * math.pi - 2 * span)))


def harmonic_prime_radius(lift, span, limit) -> float:
    """Rp = -L/2 + sqrt((pi L / (2 beta tan mu))^2 + (L/2)^2)."""
    return -lift / 2 + math.hypot(math.pi * lift / (2 * span * math.tan(limit)), lift / 2)


@pytest.mark.parametrize(
    ("limit", "printed"),
    [(20, 137.5561870), (25, 102.1214432), (30, 78.16653826), (35, 60.78867895), (45, 37.08203932)],
)
def test_prime_circle_of_the_shedding_cam(limit, printed) -> None:
    found = pressure_prime(opposed(60 * mm, 90 * deg), CamLimits(limit * deg, limit * deg))
    assert found.value == pytest.approx(printed * mm, rel=1e-9)
    assert found.value == pytest.approx(harmonic_prime_radius(60 * mm, 90 * deg, limit * deg), rel=1e-14)


def test_place_of_the_largest_pressure_angle() -> None:
    assert pressure_prime(opposed(60 * mm, 90 * deg), CamLimits(30 * deg, 30 * deg)).at == pytest.approx(
        36.948943 * deg, abs=1e-8
    )


def test_curvature_of_the_shedding_cam() -> None:
    cam = PlateCam(opposed(60 * mm, 90 * deg), 30 * (math.sqrt(13) - 1) * mm)
    assert convex_radius_min(cam).value == pytest.approx(73.94448725 * mm, rel=1e-9)
    assert concave_radius_min(cam).value == pytest.approx(cam.prime_radius**2 / (0.12 - cam.prime_radius), rel=1e-10)
    assert undercut(PlateCam(cam.programme, cam.prime_radius, roller_radius=73.95 * mm))
    assert not undercut(PlateCam(cam.programme, cam.prime_radius, roller_radius=73.94 * mm))


@given(lift=st.floats(5e-3, 0.2), span=st.floats(30 * deg, 175 * deg), limit=st.floats(10 * deg, 60 * deg))
@settings(max_examples=20)
def test_harmonic_closed_form_everywhere(lift, span, limit) -> None:
    found = pressure_prime(opposed(lift, span), CamLimits(limit, limit))
    assert found.value == pytest.approx(harmonic_prime_radius(lift, span, limit), rel=1e-12)


@given(
    law=st.sampled_from([LAWS[name] for name in SMOOTH_LAWS]),
    span=st.floats(40 * deg, 170 * deg),
    limit=st.floats(15 * deg, 50 * deg),
    offset=st.floats(-0.02, 0.02),
)
@settings(max_examples=15)
def test_the_smallest_prime_circle_uses_the_limit_up_and_no_more(law, span, limit, offset) -> None:
    programme = opposed(60 * mm, span, law)
    smallest = pressure_prime(programme, CamLimits(limit, limit), offset).value
    assert pressure_angle_max(PlateCam(programme, smallest, offset)).value == pytest.approx(limit, rel=1e-10)
    smaller = PlateCam(programme, max(0.99 * smallest, abs(offset) * 1.0001), offset)
    assert pressure_angle_max(smaller).value > limit


@pytest.mark.parametrize("offset", [0.0, 0.008, -0.008])
def test_profile_is_the_roller_away_from_the_pitch_curve_and_touches_no_more(offset) -> None:
    cam = PlateCam(opposed(60 * mm, 80 * deg, LAWS["cycloidal"]), 90 * mm, offset, 15 * mm)
    angle = np.linspace(0, 2 * math.pi, 2001)
    pitch, surface = cam.pitch(angle), cam.surface(angle)
    np.testing.assert_allclose(np.abs(pitch - surface), 15 * mm, rtol=1e-12)
    gaps = np.abs(pitch[::20, None] - surface[None, :])
    assert np.min(gaps) > 15 * mm * (1 - 1e-9)
    turning = np.gradient(surface, angle)
    normals = profile.normal(angle, cam.programme.at(angle).s, cam.programme.at(angle).ds, 90 * mm, offset)
    leaning = (np.conj(turning) * normals).real / np.abs(turning)
    assert np.max(np.abs(leaning[1:-1])) < 2e-2


def eccentric_circle(angle, radius, shift):
    """Reach and its derivatives of a knife edge on a circle whose centre is `shift` beside the axis."""
    root = np.sqrt(radius**2 - (shift * np.sin(angle)) ** 2)
    reach = shift * np.cos(angle) + root
    ds = -shift * np.sin(angle) - shift**2 * np.sin(2 * angle) / (2 * root)
    dds = (
        -shift * np.cos(angle) - shift**2 * np.cos(2 * angle) / root - shift**4 * np.sin(2 * angle) ** 2 / (4 * root**3)
    )
    return reach, ds, dds


def test_offset_circle_has_one_curvature_and_a_known_pressure_angle() -> None:
    """R = 50 mm, 15 mm off centre: rho = 50 mm everywhere, largest pressure angle asin(15/50) = 17.457603 deg."""
    angle = np.linspace(0, 2 * math.pi, 721)
    reach, ds, dds = eccentric_circle(angle, 50 * mm, 15 * mm)
    s = reach - 35 * mm
    np.testing.assert_allclose(1 / profile.curvature(s, ds, dds, 35 * mm), 50 * mm, rtol=1e-12)
    fine = np.linspace(0, math.pi, 200_001)
    reach, ds, _ = eccentric_circle(fine, 50 * mm, 15 * mm)
    assert np.max(np.abs(profile.pressure_angle(reach - 35 * mm, ds, 35 * mm))) / deg == pytest.approx(
        17.457603, abs=1e-6
    )
    points = profile.pitch_point(fine, reach - 35 * mm, 35 * mm)
    np.testing.assert_allclose(np.abs(points - 15 * mm), 50 * mm, rtol=1e-12)


@pytest.mark.parametrize("offset", [0.0, 0.012])
def test_curvature_is_that_of_the_drawn_curve(offset) -> None:
    cam = PlateCam(opposed(60 * mm, 100 * deg, LAWS["3-4-5"]), 80 * mm, offset)
    angle = np.linspace(0.2, 1.5, 60)
    h = 1e-4
    before, here, after = (cam.pitch(angle + step) for step in (-h, 0.0, h))
    first, second = (after - before) / (2 * h), (after - 2 * here + before) / h**2
    drawn = -(np.conj(first) * second).imag / np.abs(first) ** 3
    np.testing.assert_allclose(cam.curvature(angle), drawn, rtol=1e-5)
    pressed = profile.pressure_angle(cam.programme.at(angle).s, cam.programme.at(angle).ds, 80 * mm, offset)
    np.testing.assert_allclose(np.angle(1j * first * np.exp(1j * angle)), pressed, atol=1e-7)


@pytest.mark.parametrize(("roller", "offset"), [(0.0, 0.0), (12 * mm, 0.0), (12 * mm, 10 * mm)])
def test_area_is_that_of_the_drawn_polygon(roller, offset) -> None:
    cam = PlateCam(opposed(60 * mm, 90 * deg), 80 * mm, offset, roller)
    surface = cam.surface(np.linspace(0, 2 * math.pi, 40_001)[:-1])
    polygon = -0.5 * np.sum((np.conj(surface) * np.roll(surface, -1)).imag)
    # A jump of the acceleration makes the surface jump in direction nowhere; both agree but for the chords.
    assert area(cam) == pytest.approx(polygon, rel=1e-7)


def test_a_dwell_all_round_is_a_circle() -> None:
    cam = PlateCam(CamProgramme((dwell(2 * math.pi),)), 50 * mm, roller_radius=10 * mm)
    assert area(cam) == pytest.approx(math.pi * (40 * mm) ** 2, rel=1e-12)
    assert convex_radius_min(cam).value == pytest.approx(50 * mm)
    assert concave_radius_min(cam) is None
    assert pressure_angle_max(cam).value == 0.0


@pytest.mark.parametrize("limit", [0.0, -0.1, math.pi / 2, 30.0])
def test_a_pressure_angle_limit_beyond_a_right_angle_is_refused(limit) -> None:
    with pytest.raises(ParameterError, match="above 0 deg, below 90 deg"):
        pressure_prime(opposed(60 * mm, 90 * deg), CamLimits(limit, limit))


def test_a_prime_circle_inside_the_roller_is_refused() -> None:
    with pytest.raises(ParameterError, match="prime_radius=10 mm is too small; above 12 mm"):
        PlateCam(opposed(60 * mm, 90 * deg), 10 * mm, roller_radius=12 * mm)
