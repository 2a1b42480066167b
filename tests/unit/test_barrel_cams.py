"""Barrel, end and wedge cams: flanks in space against the roller itself, the development against closed forms."""

import math

import numpy as np
import pytest

from ilmek.cams.barrel import BarrelArmCam, BarrelCam, cutter_error, undercut_in_space
from ilmek.cams.groove import Groove
from ilmek.cams.laws import LAWS
from ilmek.cams.limits import concave_radius_min, convex_radius_min, pressure_angle_max, undercut
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.cams.sizing import CamLimits, smallest_prime
from ilmek.cams.strip import WedgeCam
from ilmek.errors import ParameterError
from ilmek.units import deg, mm

ANGLE = np.linspace(0.0, TURN, 61)
FINE = np.linspace(-0.5, TURN + 0.5, 4001)


def motion(lift, law="cycloidal", span=100 * deg) -> CamProgramme:
    return CamProgramme((rise(span, lift, LAWS[law]), dwell(60 * deg), fall(span, lift, LAWS[law]),
                      dwell(300 * deg - 2 * span)))  # fmt: skip


BARREL = BarrelCam(motion(40 * mm), 50 * mm, 9 * mm, 12 * mm)
ARM = BarrelArmCam(motion(24 * deg), 50 * mm, 110 * mm, 110 * mm * math.cos(12 * deg), -12 * deg, 1, 9 * mm, 12 * mm)
CAMS = pytest.mark.parametrize("cam", [BARREL, ARM, BarrelArmCam(*[getattr(ARM, name) for name in
    ("programme", "prime_radius", "arm", "pivot", "start")], -1, 9 * mm, 12 * mm)])  # fmt: skip


def seen_from_the_roller(points, angle: float, cam):
    """Distances of points of the cam from the roller's axis when the cam stands at an angle."""
    turned = (points[..., 0] + 1j * points[..., 1]) * np.exp(1j * angle)
    centre = complex(np.asarray(cam.roller_motion(cam.programme.at(np.array(angle)))[0]))
    return np.hypot(points[..., 2] - centre.real, turned.imag - centre.imag), turned.real


@CAMS
@pytest.mark.parametrize("side", [-1, 1])
def test_flanks_in_space_touch_the_roller_and_never_enter_it(cam, side) -> None:
    for angle in (0.3, 1.1, 2.5, 4.0):
        for depth in cam.depths:
            here, along = seen_from_the_roller(cam.flank(np.array([angle]), depth, side), angle, cam)
            assert float(here[0]) == pytest.approx(9 * mm, rel=1e-12)
            assert float(along[0]) == pytest.approx(depth, rel=1e-12)
            nearby = np.linspace(angle - 0.2, angle + 0.2, 401)
            apart, _ = seen_from_the_roller(cam.flank(nearby, depth, side), angle, cam)
            assert np.min(apart) >= 9 * mm * (1 - 1e-9)


@CAMS
def test_guiding_is_the_flow_of_the_flank_in_space(cam) -> None:
    """|dp/dtheta x dp/drho| of the flank, by differences: the contact runs by `guiding` for a unit of depth."""
    angle, depth, h = np.linspace(0.1, 5.9, 40), 50 * mm, 1e-5
    for side in (-1, 1):
        by_angle = (cam.flank(angle + h, depth, side) - cam.flank(angle - h, depth, side)) / (2 * h)
        by_depth = (cam.flank(angle, depth + h, side) - cam.flank(angle, depth - h, side)) / (2 * h)
        found = np.linalg.norm(np.cross(by_angle, by_depth), axis=-1)
        np.testing.assert_allclose(np.abs(cam.guiding(angle, depth, side)), found, rtol=1e-5)


def test_development_has_the_closed_forms() -> None:
    """tan mu = s'/R, largest at mid-rise of the cycloid: 2h/(beta R); kappa = -R s'' / (R^2 + s'^2)^(3/2)."""
    steep = 2 * 40 * mm / (100 * deg)
    assert pressure_angle_max(BARREL).value == pytest.approx(math.atan(steep / (50 * mm)), rel=1e-12)
    inner = BARREL.resized(BARREL.depths[0])
    assert pressure_angle_max(inner).value == pytest.approx(math.atan(steep / (44 * mm)), rel=1e-12)
    at = BARREL.programme.at(ANGLE)
    kappa = -0.05 * at.dds / (0.05**2 + at.ds**2) ** 1.5
    np.testing.assert_allclose(BARREL.curvature(ANGLE), kappa, rtol=1e-12)
    hollow = concave_radius_min(BARREL)
    assert hollow is not None
    assert hollow.value == pytest.approx(convex_radius_min(BARREL).value, rel=1e-8)


def test_smallest_barrel_for_a_pressure_angle() -> None:
    """R = s'max / tan(limit)."""
    found = smallest_prime(BARREL, CamLimits(rise=30 * deg, fall=30 * deg))
    assert found.prime_radius == pytest.approx(2 * 40 * mm / (100 * deg) / math.tan(30 * deg), rel=1e-10)


def test_undercut_in_space_begins_earlier_on_one_flank_than_laid_flat() -> None:
    """A steep barrel: the development just lets the roller pass, the round cam does not."""
    steep = BarrelCam(motion(40 * mm, span=50 * deg), 30 * mm, 1 * mm, 10 * mm)
    assert undercut_in_space(steep) is None
    least = convex_radius_min(steep.resized(steep.depths[0])).value
    tight = BarrelCam(steep.programme, 30 * mm, least * (1 - 1e-3), 10 * mm)
    assert not undercut(tight.resized(tight.depths[0]), both_flanks=True)
    worst = undercut_in_space(tight)
    assert worst is not None
    assert worst.value < 0
    assert undercut_in_space(BarrelCam(steep.programme, 30 * mm, 2 * least, 10 * mm), both_flanks=False) is not None


def test_a_smaller_cutter_errs_at_the_rollers_ends_by_the_turn_of_the_normals() -> None:
    """A screw: the normals at mean radius and end differ by da = atan(p/R) - atan(p/rho); the error is of da^2."""
    least, most = cutter_error(BARREL, 9 * mm)
    assert max(abs(least), abs(most)) < 1e-8
    pitch = 2 * 40 * mm / (100 * deg)
    turned = math.atan(pitch / (50 * mm)) - math.atan(pitch / (44 * mm))
    for radius in (8 * mm, 4 * mm):
        least, most = cutter_error(BARREL, radius)
        assert most < 1e-8
        assert least == pytest.approx(-(9 * mm - radius) * (1 - math.cos(turned)), rel=0.1)


def test_a_barrels_groove_laid_flat_is_as_wide_as_the_roller() -> None:
    inner, outer = Groove(BARREL).flanks(ANGLE)
    np.testing.assert_allclose(np.abs(outer - inner), 18 * mm, rtol=1e-12)


def test_a_roller_that_reaches_the_axis_is_refused() -> None:
    with pytest.raises(ParameterError, match="prime_radius=5 mm is too small; above half the roller's width, 6 mm"):
        BARREL.resized(5 * mm)
    with pytest.raises(ParameterError, match="an arm that swings from 80 deg to 104 deg"):
        BarrelArmCam(motion(24 * deg), 50 * mm, 110 * mm, 0.1, 80 * deg)


def test_a_wedge_of_a_straight_slope_is_a_straight_line() -> None:
    programme = CamProgramme((rise(math.pi, 30 * mm, LAWS["uniform"]), fall(math.pi, 30 * mm, LAWS["uniform"])))
    wedge = WedgeCam(programme, 200 * mm, 8 * mm, used=math.pi)
    angle = np.linspace(0.01, math.pi - 0.01, 20)
    slope = math.atan2(30, 100)
    np.testing.assert_allclose(wedge.pressure_angle(angle), slope, rtol=1e-12)
    np.testing.assert_allclose(wedge.curvature(angle), 0.0, atol=1e-12)
    along = np.diff(wedge.surface(angle))
    np.testing.assert_allclose(np.angle(along), slope - math.pi / 2, rtol=1e-12)
    assert pressure_angle_max(wedge).value == pytest.approx(slope, rel=1e-12)
    assert math.isinf(convex_radius_min(wedge).value)
    assert concave_radius_min(wedge) is None
    assert not undercut(wedge, both_flanks=True)


def test_a_leaning_follower_is_pushed_by_so_much_less_askew() -> None:
    programme = motion(30 * mm)
    upright, leaning = WedgeCam(programme, 400 * mm), WedgeCam(programme, 400 * mm, lean=10 * deg)
    at, rho = programme.at(ANGLE), 400 * mm / TURN
    np.testing.assert_allclose(np.tan(upright.pressure_angle(ANGLE)), at.ds / rho, atol=1e-12)
    c, s = math.cos(10 * deg), math.sin(10 * deg)
    expected = np.arctan2(at.ds - rho * s, rho * c)
    np.testing.assert_allclose(leaning.pressure_angle(ANGLE), expected, atol=1e-12)


def test_a_wedge_for_a_pressure_angle_is_the_shortest() -> None:
    programme = CamProgramme((rise(math.pi, 30 * mm, LAWS["harmonic"]), fall(math.pi, 30 * mm, LAWS["harmonic"])))
    wedge = WedgeCam(programme, 1.0, 8 * mm, used=math.pi)
    found = wedge.resized(smallest_prime(wedge, CamLimits(rise=25 * deg)).prime_radius)
    assert found.length / 2 == pytest.approx(math.pi / 2 * 30 * mm / math.tan(25 * deg), rel=1e-9)
    with pytest.raises(ParameterError, match="length=0 mm; above 0 mm"):
        WedgeCam(programme, 0.0)
