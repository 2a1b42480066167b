"""The smallest prime circle: it uses the limit up, no smaller one does, and closed forms agree."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.cams.flat import FlatCam
from ilmek.cams.laws import LAWS
from ilmek.cams.limits import (
    concave_radius_min,
    convex_radius_min,
    pressure_angle_max,
    undercut,
)
from ilmek.cams.oscillating import OscillatingCam
from ilmek.cams.oscillating_flat import OscillatingFlatCam
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.cams.sizing import CamLimits, best_offset, pressure_prime, require, smallest_prime
from ilmek.errors import ParameterError
from ilmek.num.piecewise import infimum
from ilmek.units import deg, mm


def motion(lift, out=90 * deg, back=120 * deg, law="cycloidal") -> CamProgramme:
    rest = TURN - out - back
    return CamProgramme(
        (rise(out, lift, LAWS[law]), dwell(rest / 2), fall(back, lift, LAWS[law]), dwell(rest / 2)),
    )


@pytest.mark.parametrize("law", ["harmonic", "3-4-5"])
def test_the_pressure_angle_alone_agrees_with_the_closed_form(law) -> None:
    programme = motion(30 * mm, law=law)
    found = smallest_prime(PlateCam(programme, 1.0, 2 * mm), CamLimits(rise=30 * deg, fall=30 * deg))
    closed = pressure_prime(programme, CamLimits(30 * deg, 30 * deg), 2 * mm)
    assert found.prime_radius == pytest.approx(closed.value, rel=1e-12)
    assert found.at == pytest.approx(closed.at, abs=1e-6)
    assert found.binds == "the pressure angle on the rise"


def test_rise_and_way_back_keep_their_own_limits() -> None:
    programme = motion(30 * mm)
    closed = pressure_prime(programme, CamLimits(rise=35 * deg, fall=20 * deg), 3 * mm)
    cam = PlateCam(programme, closed.value, 3 * mm)
    found = smallest_prime(cam, CamLimits(rise=35 * deg, fall=20 * deg))
    assert found.prime_radius == pytest.approx(closed.value, rel=1e-12)
    assert found.binds == "the pressure angle on the return"
    assert pressure_angle_max(cam, "return").value == pytest.approx(20 * deg, rel=1e-12)
    assert pressure_angle_max(cam, "rise").value < 35 * deg
    rising = smallest_prime(cam, CamLimits(rise=35 * deg)).prime_radius
    assert rising < found.prime_radius
    assert pressure_angle_max(cam.resized(rising), "rise").value == pytest.approx(35 * deg, rel=1e-12)


@given(lift=st.floats(10e-3, 40e-3), roller=st.floats(5e-3, 25e-3), share=st.floats(1.0, 1.6))
@settings(max_examples=4)
def test_a_roller_has_room_and_no_smaller_circle_gives_it(lift, roller, share) -> None:
    cam = PlateCam(motion(lift), 1.0, roller_radius=roller)
    limits = CamLimits(convex=share * roller)
    found = smallest_prime(cam, limits)
    if found.binds == "the follower's own size":
        return
    assert convex_radius_min(cam.resized(found.prime_radius)).value == pytest.approx(share * roller, rel=1e-9)
    smaller = max(0.98 * found.prime_radius, roller * (1 + 1e-9))
    assert convex_radius_min(cam.resized(smaller)).value < share * roller


def test_a_groove_keeps_its_outer_flank() -> None:
    cam = PlateCam(motion(30 * mm), 1.0, roller_radius=12 * mm)
    found = smallest_prime(cam, CamLimits(concave=40 * mm, rise=60 * deg))
    hollow = concave_radius_min(cam.resized(found.prime_radius))
    assert hollow is not None
    assert hollow.value == pytest.approx(40 * mm, rel=1e-9)
    assert found.binds == "the concave radius of curvature"
    assert not undercut(cam.resized(found.prime_radius), both_flanks=True)


def test_a_flat_faces_circle_is_the_closed_form() -> None:
    """Rb = rho - inf(s + s'')."""
    programme = motion(20 * mm)
    least = infimum(lambda angle: programme.at(angle).s + programme.at(angle).dds, programme.knots).value
    found = smallest_prime(FlatCam(programme, 1.0), CamLimits(convex=5 * mm))
    assert found.prime_radius == pytest.approx(5 * mm - least, rel=1e-9)


@pytest.mark.parametrize("side", [1, -1])
def test_an_arms_circle_keeps_limits_that_a_smaller_one_breaks(side) -> None:
    limits = CamLimits(rise=42 * deg, fall=40 * deg, convex=14 * mm)
    cam = OscillatingCam(motion(20 * deg), 70 * mm, 110 * mm, 100 * mm, side, 10 * mm)
    found = cam.resized(smallest_prime(cam, limits).prime_radius)
    require(found, limits)
    with pytest.raises(ParameterError, match=r"is too small for .*; at least"):
        require(cam.resized(0.99 * found.prime_radius), limits)


def test_a_swinging_faces_circle_is_just_convex() -> None:
    cam = OscillatingFlatCam(motion(12 * deg), 70 * mm, 120 * mm)
    found = smallest_prime(cam, CamLimits(convex=8 * mm)).prime_radius
    assert convex_radius_min(cam.resized(found)).value == pytest.approx(8 * mm, rel=1e-8)
    bare = smallest_prime(cam, CamLimits()).prime_radius
    assert not undercut(cam.resized(bare * 1.001))
    assert undercut(cam.resized(bare * 0.999))


def test_the_best_offset_is_better_than_all_others() -> None:
    programme, limits = motion(30 * mm), CamLimits(rise=30 * deg, fall=45 * deg)
    best = best_offset(programme, limits)
    assert best.offset > 0
    tried = [pressure_prime(programme, limits, float(e)).value for e in best.offset + np.linspace(-0.02, 0.02, 21)]
    assert min(tried) == pytest.approx(best.prime_radius, rel=1e-9)
    assert pressure_angle_max(PlateCam(programme, best.prime_radius, best.offset), "rise").value <= 30 * deg + 1e-9
    assert best.prime_radius < pressure_prime(programme, limits).value


def test_equal_ways_out_and_back_want_no_offset() -> None:
    programme = motion(30 * mm, 120 * deg, 120 * deg)
    assert best_offset(programme, CamLimits(rise=30 * deg, fall=30 * deg)).offset == pytest.approx(0.0, abs=1e-7)


def test_a_circle_too_small_is_refused_with_the_smallest_that_works() -> None:
    cam = PlateCam(motion(30 * mm, law="harmonic"), 20 * mm, roller_radius=8 * mm)
    with pytest.raises(ParameterError) as caught:
        require(cam, CamLimits(rise=30 * deg))
    assert caught.value.given.startswith("prime_radius=20 mm is too small for ")
    assert caught.value.allowed.endswith("(for the pressure angle on the rise)")
    said = float(caught.value.allowed.split()[2]) * mm
    require(cam.resized(said), CamLimits(rise=30 * deg))


def test_limits_that_no_circle_keeps_are_said() -> None:
    cam = OscillatingCam(motion(40 * deg, 30 * deg), 70 * mm, 110 * mm, 100 * mm)
    with pytest.raises(ParameterError, match="no prime radius from .* keeps a pressure angle on the rise of 5 deg"):
        smallest_prime(cam, CamLimits(rise=5 * deg))
    with pytest.raises(ParameterError, match="pressure angle of 90 deg; above 0 deg, below 90 deg"):
        CamLimits(fall=math.pi / 2)
