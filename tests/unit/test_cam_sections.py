"""Area, centre and moment of a cam's face on circles; parts of a cam that enter the follower from elsewhere."""

import math

import numpy as np
import pytest

from ilmek.cams.flat import FlatCam
from ilmek.cams.interference import interference
from ilmek.cams.laws import LAWS
from ilmek.cams.limits import area, undercut
from ilmek.cams.oscillating import OscillatingCam
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.cams.section import section
from ilmek.units import deg, mm


def motion(lift, law="cycloidal") -> CamProgramme:
    return CamProgramme((rise(90 * deg, lift, LAWS[law]), dwell(40 * deg), fall(110 * deg, lift, LAWS[law]),
                      dwell(120 * deg)))  # fmt: skip


def test_the_flat_faced_circle_weighs_as_a_circle_off_centre() -> None:
    """Harmonic over 180/180: circle of Rb + h/2 about -h/2; polar moment pi R^4/2 + A (h/2)^2 (Steiner)."""
    programme = CamProgramme((rise(math.pi, 20 * mm, LAWS["harmonic"]), fall(math.pi, 20 * mm, LAWS["harmonic"])))
    found, radius = section(FlatCam(programme, 30 * mm)), 40 * mm
    assert found.area == pytest.approx(math.pi * radius**2, rel=1e-13)
    assert found.centre == pytest.approx(-10 * mm, abs=1e-15)
    assert found.polar_moment == pytest.approx(math.pi * radius**4 / 2 + found.area * (10 * mm) ** 2, rel=1e-12)


def test_any_face_weighs_as_its_polygon() -> None:
    cam = OscillatingCam(motion(18 * deg), 60 * mm, 110 * mm, 95 * mm, -1, 9 * mm)
    points = cam.surface(np.linspace(0.0, TURN, 20_000, endpoint=False))
    after = np.roll(points, -1)
    triangles = -0.5 * (np.conj(points) * after).imag
    found = section(cam)
    assert found.area == pytest.approx(area(cam), rel=1e-14)
    assert found.centre == pytest.approx(complex(np.sum(triangles * (points + after) / 3) / found.area), rel=1e-6)
    squares = (np.abs(points) ** 2 + np.abs(after) ** 2 + (points * np.conj(after)).real) / 6
    assert found.polar_moment == pytest.approx(float(np.sum(triangles * squares)), rel=1e-6)


def test_a_sound_cam_never_enters_its_follower() -> None:
    assert interference(PlateCam(motion(25 * mm), 60 * mm, 5 * mm, 10 * mm), both_flanks=True) is None
    assert interference(FlatCam(motion(10 * mm), 60 * mm)) is None


def test_undercut_is_seen_as_interference_too() -> None:
    tight = PlateCam(motion(40 * mm), 42 * mm, roller_radius=40 * mm)
    assert undercut(tight)
    found = interference(tight)
    assert found is not None
    assert found.value > 0.1 * mm
    both = interference(tight, both_flanks=True)
    assert both is not None
    assert both.value >= found.value
    hollow = interference(FlatCam(motion(25 * mm), 20 * mm))
    assert hollow is not None


def test_a_finger_that_the_roller_cuts_at_its_root_is_seen_where_the_curvature_is_sound() -> None:
    """A long narrow finger on a small circle: rho > roller all round, but from both sides the roller meets itself."""
    law = LAWS["3-4-5"]
    finger = CamProgramme(
        (rise(40 * deg, 80 * mm, law), dwell(20 * deg), fall(40 * deg, 80 * mm, law), dwell(260 * deg))
    )
    cam = PlateCam(finger, 10 * mm, roller_radius=9 * mm)
    assert not undercut(cam)
    found = interference(cam)
    assert found is not None
    assert found.value == pytest.approx(2.9 * mm, abs=0.1 * mm)
    assert interference(PlateCam(finger, 30 * mm, roller_radius=9 * mm)) is None
