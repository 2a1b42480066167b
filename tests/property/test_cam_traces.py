"""Every kind of cam: its trace is one curve with its normals, speeds and pressure angle."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.cams import profile
from ilmek.cams.barrel import BarrelArmCam, BarrelCam
from ilmek.cams.flat import FlatCam
from ilmek.cams.laws import LAWS
from ilmek.cams.limits import area
from ilmek.cams.oscillating import OscillatingCam, roller_motion
from ilmek.cams.oscillating_flat import OscillatingFlatCam
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, FollowerMotion, dwell, fall, rise
from ilmek.cams.strip import WedgeCam
from ilmek.cams.trace import CamRole, trace_of_point
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.units import deg, mm

SMOOTH = ["3-4-5", "cycloidal", "4-5-6-7", "modified-sine"]
PLATES = ["roller", "flat", "arm", "face"]


def motion(law: str, lift: float, span: float, start: float) -> CamProgramme:
    rest = TURN - 2 * span
    parts = (rise(span, lift, LAWS[law]), dwell(0.3 * rest), fall(span, lift, LAWS[law]), dwell(0.7 * rest))
    return CamProgramme(parts, start)


def cam_of(kind: str, law: str, span: float, start: float, side: int) -> CamRole:
    straight, swung = motion(law, 25 * mm, span, start), motion(law, 14 * deg, span, start)
    return {
        "roller": lambda: PlateCam(straight, 70 * mm, side * 12 * mm, 9 * mm),
        "flat": lambda: FlatCam(straight, 150 * mm, 5 * mm),
        "arm": lambda: OscillatingCam(swung, 70 * mm, 110 * mm, 95 * mm, side, 9 * mm),
        "face": lambda: OscillatingFlatCam(swung, 80 * mm, 160 * mm, side * 5 * mm, side),
        "barrel": lambda: BarrelCam(straight, 60 * mm, 9 * mm, 12 * mm),
        "barrel arm": lambda: BarrelArmCam(swung, 60 * mm, 110 * mm, 109 * mm, -7 * deg, side, 9 * mm, 12 * mm),
        "wedge": lambda: WedgeCam(straight, 400 * mm, 9 * mm, lean=side * 6 * deg),
    }[kind]()


@given(
    law=st.sampled_from(SMOOTH),
    span=st.floats(80 * deg, 150 * deg),
    start=st.floats(-1.0, 1.0),
    side=st.sampled_from([1, -1]),
)
@settings(max_examples=4)
@pytest.mark.parametrize("kind", [*PLATES, "barrel", "barrel arm", "wedge"])
def test_the_pitch_point_flows_and_its_normal_turns_as_the_trace_says(kind, law, span, start, side) -> None:
    """dP = -i n flow, dn = -i n turning by central differences, and the surface and a cutter's path beside it."""
    cam, h = cam_of(kind, law, span, start, side), 1e-5
    angle = np.linspace(0.05, 6.2, 50)
    before, here, after = (cam.trace(angle + step) for step in (-h, 0.0, h))
    np.testing.assert_allclose((after.pitch - before.pitch) / (2 * h), -1j * here.normal * here.flow, atol=2e-8)
    np.testing.assert_allclose((after.normal - before.normal) / (2 * h), -1j * here.normal * here.turning, atol=1e-6)
    np.testing.assert_allclose(np.abs(here.normal), 1.0, rtol=1e-13)
    np.testing.assert_allclose(here.surface, here.pitch - cam.roller_radius * here.normal, rtol=1e-13)
    along = (after.surface - before.surface) / (2 * h)
    bare = here.flow - cam.roller_radius * here.turning
    np.testing.assert_allclose(along, -1j * here.normal * bare, atol=1e-7)


@given(
    law=st.sampled_from(SMOOTH),
    span=st.floats(80 * deg, 150 * deg),
    start=st.floats(-1.0, 1.0),
    side=st.sampled_from([1, -1]),
)
@settings(max_examples=3)
@pytest.mark.parametrize("kind", PLATES)
def test_area_is_the_polygons(kind, law, span, start, side) -> None:
    cam = cam_of(kind, law, span, start, side)
    surface = cam.trace(np.linspace(0.0, TURN, 4000, endpoint=False)).surface
    polygon = -0.5 * float(np.sum((np.conj(surface) * np.roll(surface, -1)).imag))
    assert area(cam) == pytest.approx(polygon, rel=1e-5)


@given(law=st.sampled_from(SMOOTH), side=st.sampled_from([1, -1]))
@settings(max_examples=2)
@pytest.mark.parametrize("kind", PLATES)
def test_push_without_friction_gives_all_work_to_the_follower(kind, law, side) -> None:
    """Virtual power: the torque K x n of a push of 1 along n is the way of the touched point, times cos(mu)."""
    cam = cam_of(kind, law, 100 * deg, 0.2, side)
    angle = np.linspace(0.1, 6.1, 40)
    trace = cam.trace(angle)
    lever = (np.conj(trace.surface) * trace.normal).imag
    if kind in {"roller", "flat"}:
        moved = trace.motion.ds
    elif kind == "arm":
        moved = 95 * mm * trace.motion.ds
    else:
        pivot = 160 * mm * np.exp(-1j * angle)
        moved = np.abs(trace.surface - pivot) * trace.motion.ds
    np.testing.assert_allclose(lever, moved * np.cos(trace.pressure_angle), atol=1e-12)


@given(law=st.sampled_from(SMOOTH), offset=st.floats(-20e-3, 20e-3), prime=st.floats(30e-3, 90e-3))
@settings(max_examples=10)
def test_the_closed_forms_of_a_roller_in_a_slide_are_the_traces(law, offset, prime) -> None:
    cam = PlateCam(motion(law, 25 * mm, 100 * deg, 0.3), prime, offset, 9 * mm)
    angle = np.linspace(0.0, TURN, 100)
    trace = cam.trace(angle)
    at = trace.motion
    np.testing.assert_allclose(cam.curvature(angle), trace.curvature, rtol=1e-11, atol=1e-10)
    np.testing.assert_allclose(cam.pressure_angle(angle), trace.pressure_angle, atol=1e-13)
    np.testing.assert_allclose(profile.normal(angle, at.s, at.ds, prime, offset), trace.normal, atol=1e-13)


@given(
    shift=st.floats(5e-3, 15e-3),
    coupler=st.floats(40e-3, 80e-3),
    arm=st.floats(60e-3, 120e-3),
    share=st.floats(0.0, 1.0),
    side=st.sampled_from([1, -1]),
)
@settings(max_examples=15)
def test_any_arm_on_any_eccentric_circle_is_a_four_bar(shift, coupler, arm, share, side) -> None:
    """Pressure angle = what the transmission angle lacks to 90 deg; curvature = that of the coupler's circle."""
    near, far = abs(coupler - arm) + shift + 2e-3, coupler + arm - shift - 2e-3
    pivot = near + share * (far - near)
    angle = np.linspace(0.0, TURN, 37)
    moved = solve(plan(four_bar(pivot, shift, coupler, arm, branch=side)), angle, 1.0).require()
    psi, dpsi, ddpsi = (-side * moved.angle("rocker"), -side * moved.omega("rocker"), -side * moved.alpha("rocker"))
    centre = roller_motion(psi + np.pi, dpsi, ddpsi, pivot=pivot, arm=arm, side=side)
    way = (pivot - centre[0]) * (1j * side / arm)
    trace = trace_of_point(angle, FollowerMotion(psi, dpsi, ddpsi, psi), centre, way, 0.0)
    np.testing.assert_allclose(np.abs(trace.pitch - shift), coupler, rtol=1e-11)
    np.testing.assert_allclose(trace.curvature, 1 / coupler, rtol=1e-7)
    leaning = np.abs(np.pi / 2 - transmission_angle(moved, "B"))
    np.testing.assert_allclose(np.abs(trace.pressure_angle), leaning, atol=1e-10)
