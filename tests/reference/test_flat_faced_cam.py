"""Translating flat-faced cam against exact cases: the circle, the envelope of its faces, its reach along the face."""

import math

import numpy as np
import pytest

from ilmek.cams.flat import FlatCam, face_span
from ilmek.cams.laws import LAWS
from ilmek.cams.limits import area, concave_radius_min, convex_radius_min, pressure_angle_max, undercut
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.errors import ParameterError
from ilmek.units import deg, mm

ANGLE = np.linspace(0.0, TURN, 361)


def there_and_back(lift, law, span=math.pi) -> CamProgramme:
    return CamProgramme((rise(span, lift, LAWS[law]), fall(TURN - span, lift, LAWS[law])))


def test_harmonic_there_and_back_is_a_circle() -> None:
    """Circle of radius Rb + h/2, its centre h/2 off the axis; the face reaches h/2 to both sides."""
    cam = FlatCam(there_and_back(20 * mm, "harmonic"), 30 * mm)
    np.testing.assert_allclose(np.abs(cam.surface(ANGLE) + 10 * mm), 40 * mm, rtol=1e-13)
    np.testing.assert_allclose(1 / cam.curvature(ANGLE), 40 * mm, rtol=1e-13)
    assert area(cam) == pytest.approx(math.pi * (40 * mm) ** 2, rel=1e-13)
    assert face_span(cam) == pytest.approx((-10 * mm, 10 * mm), rel=1e-13)
    assert convex_radius_min(cam).value == pytest.approx(40 * mm, rel=1e-12)
    assert concave_radius_min(cam) is None
    assert pressure_angle_max(cam).value == 0.0
    assert not undercut(cam)


def test_every_face_touches_the_cam_and_none_cuts_it() -> None:
    programme = CamProgramme((rise(100 * deg, 20 * mm, LAWS["cycloidal"]), dwell(100 * deg),
                           fall(160 * deg, 20 * mm, LAWS["3-4-5"])))  # fmt: skip
    cam = FlatCam(programme, 60 * mm)
    normal = np.exp(-1j * ANGLE)
    reach = np.max((np.conj(normal)[:, None] * cam.surface(np.linspace(0, TURN, 7201))).real, axis=1)
    np.testing.assert_allclose(reach, 60 * mm + programme.at(ANGLE).s, rtol=1e-7)


def test_undercut_begins_where_the_radius_of_curvature_vanishes() -> None:
    """Cycloidal: least of s + s'' over the rise, found on a fine grid of the law alone."""
    lift, span = 20 * mm, 80 * deg
    u = np.linspace(0.0, 1.0, 2_000_001)
    law = LAWS["cycloidal"]
    needed = -float(np.min(lift * (law.s(u) + law.a(u) / span**2)))
    programme = there_and_back(lift, "cycloidal", span)
    assert not undercut(FlatCam(programme, needed * (1 + 1e-9)))
    assert undercut(FlatCam(programme, needed * (1 - 1e-9)))
    assert convex_radius_min(FlatCam(programme, needed - 1 * mm)).value == pytest.approx(-1 * mm, rel=1e-9)


def test_an_offset_stem_shifts_the_reach_alone() -> None:
    programme = there_and_back(20 * mm, "harmonic")
    plain, shifted = FlatCam(programme, 30 * mm), FlatCam(programme, 30 * mm, offset=4 * mm)
    np.testing.assert_array_equal(plain.surface(ANGLE), shifted.surface(ANGLE))
    assert face_span(shifted) == pytest.approx((-14 * mm, 6 * mm), rel=1e-13)


def test_no_base_circle_is_refused() -> None:
    with pytest.raises(ParameterError, match="prime_radius=0 mm is too small; above 0 mm"):
        FlatCam(there_and_back(20 * mm, "harmonic"), 0.0)
