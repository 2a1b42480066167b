"""Parts of a cam that enter the follower from elsewhere."""

import pytest

from ilmek.cams.flat import FlatCam
from ilmek.cams.interference import interference
from ilmek.cams.laws import LAWS
from ilmek.cams.limits import undercut
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme, dwell, fall, rise
from ilmek.units import deg, mm


def motion(lift, law="cycloidal") -> CamProgramme:
    return CamProgramme((rise(90 * deg, lift, LAWS[law]), dwell(40 * deg), fall(110 * deg, lift, LAWS[law]),
                      dwell(120 * deg)))  # fmt: skip


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
