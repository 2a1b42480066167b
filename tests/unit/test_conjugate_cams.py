"""Conjugate plates hold their double follower from both sides, and grooves their roller."""

import math

import numpy as np
import pytest

from ilmek.cams.conjugate import (
    conjugate,
    conjugate_arms,
    conjugate_faces,
    conjugate_swinging_faces,
    remaining_rise,
)
from ilmek.cams.flat import FlatCam
from ilmek.cams.groove import Groove
from ilmek.cams.laws import LAWS
from ilmek.cams.limits import concave_radius_min, convex_radius_min, largest_cutter, undercut
from ilmek.cams.oscillating import OscillatingCam
from ilmek.cams.oscillating_flat import OscillatingFlatCam
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.errors import ParameterError
from ilmek.units import deg, mm

ANGLE = np.linspace(0.0, TURN, 121)
FINE = np.linspace(0.0, TURN, 7201)


def motion(lift, law="cycloidal") -> CamProgramme:
    return CamProgramme((rise(90 * deg, lift, LAWS[law]), dwell(40 * deg), fall(110 * deg, lift, LAWS[law]),
                      dwell(120 * deg)), start=0.3)  # fmt: skip


def gaps(centres, surface) -> np.ndarray:
    """Least distance of each centre from a closed curve."""
    return np.min(np.abs(centres[:, None] - surface[None, :]), axis=1)


def test_the_rest_of_the_way_adds_up_to_the_lift() -> None:
    programme = motion(25 * mm)
    rest = remaining_rise(programme)
    at, left = programme.at(ANGLE), rest.at(ANGLE)
    np.testing.assert_allclose(at.s + left.s, 25 * mm, rtol=1e-12)
    np.testing.assert_allclose(at.dds, -left.dds, atol=1e-12)
    assert rest.bounds == pytest.approx((0.0, 25 * mm), abs=1e-12)


@pytest.mark.parametrize("offset", [0.0, 6 * mm])
def test_both_rollers_of_a_slide_touch_their_plates_all_round(offset) -> None:
    pair = conjugate(PlateCam(motion(25 * mm), 50 * mm, offset, 10 * mm), 130 * mm, 8 * mm)
    np.testing.assert_allclose(np.abs(pair.between(ANGLE)), 130 * mm, rtol=1e-12)
    first, second = pair.traces(ANGLE)
    np.testing.assert_allclose(gaps(first.pitch, pair.first.surface(FINE)), 10 * mm, rtol=1e-5)
    np.testing.assert_allclose(gaps(second.pitch, pair.second.surface(FINE)), 8 * mm, rtol=1e-5)
    line = pair.between(ANGLE) * np.exp(1j * ANGLE)
    np.testing.assert_allclose(line, -130 * mm, atol=1e-12)


@pytest.mark.parametrize("side", [1, -1])
def test_both_rollers_of_a_rocker_touch_their_plates_all_round(side) -> None:
    first = OscillatingCam(motion(18 * deg), 60 * mm, 110 * mm, 100 * mm, side, 10 * mm)
    pair = conjugate_arms(first, 95 * deg, 90 * mm)
    fixed = math.sqrt(0.1**2 + 0.09**2 - 2 * 0.1 * 0.09 * math.cos(95 * deg))
    np.testing.assert_allclose(np.abs(pair.between(ANGLE)), fixed, rtol=1e-12)
    one, other = pair.traces(ANGLE)
    pivot = 110 * mm * np.exp(-1j * ANGLE)
    np.testing.assert_allclose(np.abs(one.pitch - pivot), 100 * mm, rtol=1e-12)
    np.testing.assert_allclose(np.abs(other.pitch - pivot), 90 * mm, rtol=1e-12)
    np.testing.assert_allclose(gaps(other.pitch, pair.second.surface(FINE)), 10 * mm, rtol=1e-5)


def test_two_faces_hold_two_plates_and_a_symmetric_one_alone() -> None:
    pair = conjugate_faces(FlatCam(motion(10 * mm), 60 * mm), 140 * mm)
    out = np.exp(-1j * ANGLE)
    faces = [np.max((np.conj(way)[:, None] * cam.surface(FINE)).real, axis=1) for way, cam in
             ((out, pair.first), (-out, pair.second))]  # fmt: skip
    np.testing.assert_allclose(faces[0] + faces[1], 140 * mm, rtol=1e-6)
    breadth = CamProgramme((rise(math.pi, 10 * mm, LAWS["3-4-5"]), fall(math.pi, 10 * mm, LAWS["3-4-5"])))
    alone = conjugate_faces(FlatCam(breadth, 40 * mm), 90 * mm)
    np.testing.assert_allclose(alone.first.surface(ANGLE), alone.second.surface(ANGLE), atol=1e-14)


@pytest.mark.parametrize("side", [1, -1])
def test_two_faces_of_a_rocker_touch_their_plates_all_round(side) -> None:
    first = OscillatingFlatCam(motion(10 * deg), 50 * mm, 110 * mm, 3 * mm, side)
    pair = conjugate_swinging_faces(first, 66 * deg, 4 * mm)
    for angle in ANGLE[::10]:
        headings = []
        for cam, trace in zip((pair.first, pair.second), pair.traces(np.array([angle])), strict=True):
            normal = complex(trace.normal[0])
            face = (normal.conjugate() * 110 * mm * np.exp(-1j * angle)).real + cam.face_offset
            touched = np.max((normal.conjugate() * cam.surface(FINE)).real)
            assert touched == pytest.approx(face, rel=1e-6)
            headings.append(normal)
        assert math.acos(-(headings[0] * headings[1].conjugate()).real) == pytest.approx(66 * deg, rel=1e-9)
    with pytest.raises(ParameterError, match="30 deg between the faces; above"):
        conjugate_swinging_faces(first, 30 * deg)


def test_a_distance_without_room_names_the_least() -> None:
    cam = PlateCam(motion(25 * mm), 50 * mm, roller_radius=10 * mm)
    with pytest.raises(ParameterError, match="distance=80 mm between the followers; above 85 mm"):
        conjugate(cam, 80 * mm)
    with pytest.raises(ParameterError, match="distance=60 mm between the followers; above 75 mm"):
        conjugate_faces(FlatCam(motion(25 * mm), 50 * mm), 60 * mm)
    with pytest.raises(ParameterError, match="10 deg between the arms; above"):
        conjugate_arms(OscillatingCam(motion(18 * deg), 60 * mm, 110 * mm, 100 * mm), 10 * deg)


def test_a_groove_holds_the_roller_between_its_flanks() -> None:
    groove = Groove(PlateCam(motion(25 * mm), 60 * mm, 4 * mm, 10 * mm), 0.05 * mm)
    centres = groove.cam.pitch(ANGLE)
    inner, outer = groove.flanks(FINE)
    np.testing.assert_allclose(gaps(centres, inner), 10 * mm, rtol=1e-5)
    np.testing.assert_allclose(gaps(centres, outer), 10.05 * mm, rtol=1e-5)
    at_inner, at_outer = groove.flank_curvatures(ANGLE)
    np.testing.assert_allclose(1 / at_outer - 1 / at_inner, 20.05 * mm, rtol=1e-9)


def test_a_smaller_cutter_cuts_both_flanks_and_one_of_its_width_runs_once() -> None:
    groove = Groove(PlateCam(motion(25 * mm), 60 * mm, 0.0, 10 * mm))
    along_inner, along_outer = groove.cutter_paths(ANGLE, 6 * mm)
    inner, outer = groove.flanks(FINE)
    np.testing.assert_allclose(gaps(along_inner, inner), 6 * mm, rtol=1e-4)
    np.testing.assert_allclose(gaps(along_outer, outer), 6 * mm, rtol=1e-4)
    once, again = groove.cutter_paths(ANGLE, 10 * mm)
    np.testing.assert_allclose(once, again, atol=1e-16)
    with pytest.raises(ParameterError, match="a cutter of 22 mm in a groove of 20 mm"):
        groove.cutter_paths(ANGLE, 11 * mm)


def test_a_groove_is_undercut_on_a_flank_that_a_plate_does_not_have() -> None:
    steep = CamProgramme((rise(60 * deg, 150 * mm, LAWS["cycloidal"]), fall(60 * deg, 150 * mm, LAWS["cycloidal"]),
                       dwell(240 * deg)))  # fmt: skip
    bare = PlateCam(steep, 100 * mm)
    hollow = concave_radius_min(bare)
    assert hollow is not None
    roller = 0.5 * (hollow.value + convex_radius_min(bare).value)
    assert hollow.value < roller
    cam = PlateCam(steep, 100 * mm, roller_radius=roller)
    assert not undercut(cam)
    assert undercut(cam, both_flanks=True)
    assert largest_cutter(cam) == pytest.approx(hollow.value + roller)


def test_a_groove_wants_a_roller() -> None:
    with pytest.raises(ParameterError, match="a groove without a roller"):
        Groove(PlateCam(motion(25 * mm), 60 * mm))
