"""The warps on their cams: tension from the geometry, the yarn draped over the cam, bearings, plates, motions."""

import functools
import math

import numpy as np
import pytest
from cloths import cloth

from ilmek.errors import ParameterError
from ilmek.machines.shedding import MACHINE, SheddingDesign, SheddingParams
from ilmek.machines.shedding.warp import bridged, draped, lifting_work, nose_radius, shed_warp, warp_force
from ilmek.plane.curves import hull_indices
from ilmek.report import Report
from ilmek.units import deg, mm
from ilmek.weaving.tension import capstan

COTTON = cloth(tension=15.0, warp_stiffness=1800.0)
ELASTIC = dict(cloth=COTTON, front_span=0.25, back_span=0.4, warp_length=1.5)


def made(**settings_given) -> SheddingDesign:
    return MACHINE.design(SheddingParams(**settings_given))


@functools.cache
def answer(**settings_given) -> Report:
    return MACHINE.report(made(**settings_given))


def result(report: Report, name: str):
    return next(result.value for result in report.results if result.name == name)


@pytest.mark.parametrize(
    ("front", "back", "stiffness", "give", "lift"),
    [(0.05, 2.0, 1e5, 0.0, 0.2), (0.3, 0.1, 1800.0, 0.5, 0.06), (0.2, 0.2, 1.0, 0.0, 0.01), (1.0, 0.4, 1e4, 1.0, 0.1)],
)
def test_force_is_the_rate_of_the_work(front, back, stiffness, give, lift) -> None:
    """Virtual work: F = dW/ds of the stretched warp, whatever its spans."""
    asked = dict(
        cloth=cloth(tension=15.0, warp_stiffness=stiffness),
        front_span=front,
        back_span=back,
        warp_length=front + back,
        compensation=give,
    )
    step = 1e-4 * lift
    low, high = (lifting_work(SheddingParams(lift=lift + side, **asked)) for side in (-step, step))
    force = float(warp_force(SheddingParams(lift=lift, **asked), np.array(lift)))
    assert (high - low) / (2 * step) == pytest.approx(force, rel=1e-6)


def test_equal_spans_of_a_warp_that_is_not_stretched_are_the_half_span() -> None:
    one, other = made(half_span=0.17), made(front_span=0.17, back_span=0.17)
    assert one.drive.torque_max.value == pytest.approx(other.drive.torque_max.value, rel=1e-14)


def test_a_warp_of_cotton_gains_tension_in_the_shed() -> None:
    """dL = 7.10 + 4.47 mm; 1800 N over 1.5 m gives 1.2 N for each millimetre."""
    longer = math.hypot(0.25, 0.06) - 0.25 + math.hypot(0.4, 0.06) - 0.4
    report = answer(**ELASTIC)
    assert result(report, "warp_lengthening") == pytest.approx(longer)
    assert result(report, "warp_tension_max") == pytest.approx(15 + 1200 * longer)
    assert result(report, "warp_strain") == pytest.approx(longer / 1.5)
    assert answer(compensation=1.0, **ELASTIC).checks[-1].value == 0.0


def test_the_cylinder_takes_up_its_share_of_the_elongation() -> None:
    stiff, eased = answer(**ELASTIC), answer(compensation=0.25, **ELASTIC)
    assert result(eased, "warp_lengthening") == result(stiff, "warp_lengthening")
    assert result(eased, "warp_tension_max") - 15 == pytest.approx(0.75 * (result(stiff, "warp_tension_max") - 15))
    assert result(eased, "warp_strain") == pytest.approx(0.75 * result(stiff, "warp_strain"))


def test_a_short_warp_that_nothing_gives_way_for_is_strained_too_far() -> None:
    report = answer(cloth=COTTON, front_span=0.17, back_span=0.17, warp_length=0.34)
    assert [check.name for check in report.failed] == ["tension of a lifted warp", "strain of a lifted warp"]


def test_hull_of_a_star() -> None:
    angle = np.arange(10) * (2 * math.pi / 10)
    star = np.where(np.arange(10) % 2 == 0, 1.0, 0.4) * np.exp(1j * angle)
    assert sorted(hull_indices(star).tolist()) == [0, 2, 4, 6, 8]


def test_a_yarn_bridges_the_foot_of_rise_and_fall() -> None:
    """The concave arcs of the thesis' cam near 0 and 180 deg; the bridge stands over the law, symmetric to 90 deg."""
    found = bridged(made().cam)
    assert found is not None
    assert len(found.arcs) == 2
    end, foot = sorted(found.arcs)
    assert 300 * deg < foot[0]
    assert foot[1] < 45 * deg
    assert foot[1] + end[0] == pytest.approx(math.pi)
    assert foot[0] - 2 * math.pi + end[1] == pytest.approx(math.pi)
    assert 0.1 * mm < found.excess < 1 * mm


def test_a_convex_cam_has_no_bridge() -> None:
    assert bridged(made(prime_radius=0.5).cam) is None


def test_a_draped_yarn_does_the_work_that_lengthens_it() -> None:
    """Integral of the torque up to the top = T0 dL + k dL^2 / 2; over the turn nothing is left."""
    design = made(**ELASTIC)
    yarn, warp = draped(design.params, design.cam), shed_warp(design.params)
    assert yarn is not None
    top = int(np.argmax(yarn.lengthening))
    longer = yarn.lengthening[top]
    energy = warp.tension * longer + warp.rate * longer**2 / 2
    assert np.trapezoid(yarn.torque[: top + 1], yarn.angle[: top + 1]) == pytest.approx(energy, rel=2e-3)
    assert abs(np.trapezoid(yarn.torque, yarn.angle)) < 2e-3 * energy
    assert np.all(yarn.lengthening >= shed_warp(design.params).lengthening(design.even.at(yarn.angle).s) - 1e-6)
    assert yarn.lifted > math.pi


def test_holds_within_reach_of_the_guides_fail() -> None:
    """Guides of R + L + 10 mm reach sqrt((R + 70 mm)^2 - R^2) along the warps' line, and the gap."""
    report = answer(half_span=0.1)
    assert result(report, "draped") is None
    names = ["guides and cams clear of the front hold", "guides and cams clear of the back hold"]
    assert [check.name for check in report.failed] == names
    prime = made().cam.prime_radius
    reach = math.sqrt((prime + 0.07) ** 2 - prime**2) + 0.01
    assert [check.value for check in report.failed] == pytest.approx([reach, reach])
    assert answer(half_span=1.001 * reach).failed == ()
    near = answer(front_span=1.001 * reach, back_span=0.08)
    assert [check.name for check in near.failed] == names[1:]


def test_nose_of_the_harmonic_cam() -> None:
    """At the top s' = 0 and s'' = -2 L: radius r^2 / (r + 2 L) with r = Rp + L."""
    cam = made().cam
    r = cam.prime_radius + 0.06
    assert nose_radius(cam) == pytest.approx(r**2 / (r + 0.12), rel=1e-6)
    assert capstan(0.25, math.pi) == pytest.approx(math.exp(0.25 * math.pi))


def test_area_of_the_harmonic_cam() -> None:
    """A = 1/2 int (Rp + s)^2: pi Rp^2 + pi Rp L / 2 + 3 pi L^2 / 16, the lift being over half a turn."""
    cam, report = made().cam, answer()
    exact = math.pi * (cam.prime_radius**2 + cam.prime_radius * 0.06 / 2 + 3 * 0.06**2 / 16)
    assert result(report, "cam_area") == pytest.approx(exact, rel=1e-12)
    plate = report.plates[0]
    corners = plate.outline
    polygon = 0.5 * float(np.sum((np.conj(corners) * np.roll(corners, -1)).imag))
    assert plate.area == pytest.approx(exact, rel=1e-5)
    assert polygon == pytest.approx(plate.area, rel=1e-4)
    assert result(report, "cam_mass") == pytest.approx((plate.area - made().shaft.bar ** 2) * plate.thickness * 7850)


def test_weight_and_pull_add_as_vectors() -> None:
    square, along = made(), made(pull_angle=0.0)
    parts = square.shaft.directions
    assert square.shaft.load == pytest.approx(math.hypot(parts.weight, parts.pull))
    assert along.shaft.load == pytest.approx(along.shaft.directions.weight + along.shaft.directions.pull)
    told = result(answer(), "shaft_directions")
    for name in ("slope", "deflection"):
        whole = math.hypot(told["weight"][name], told["pull"][name])
        assert whole == pytest.approx(getattr(square.shaft, name))
    assert result(answer(shaft_load=14e3), "shaft_directions") is None


def test_bearings_live_or_are_said_not_to() -> None:
    seat = made().shaft.seat
    assert seat.bearing is not None
    assert seat.journal <= seat.bearing.bore <= made().shaft.bar
    assert seat.reaction == pytest.approx(made().shaft.load / 2 * 1.2 / 2)
    revolutions = seat.life * 5 / 60
    assert revolutions == pytest.approx((seat.bearing.dynamic / seat.reaction) ** 3 * 1e6)
    assert made(bearing="ucf 207").shaft.seat.bearing.name == "UCF 207"
    with pytest.raises(ParameterError, match="nearest offered"):
        made(bearing="UCF 2070")


def test_motions_for_the_controller_are_those_of_the_warps() -> None:
    even, odd = answer().cam_tables
    assert (even.name, odd.name) == ("even-warps", "odd-warps")
    assert even.period == pytest.approx(12.0)
    angle = np.linspace(0, 2 * math.pi, 50)
    np.testing.assert_allclose(odd.motion(angle), even.motion(angle + math.pi), atol=1e-12)
    assert even.motion(np.array([math.pi / 2]))[0, 0] == pytest.approx(60 * mm)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (dict(front_span=0.2), "back_span is missing"),
        (dict(front_span=0.2, back_span=0.2, half_span=0.1), "half_span beside front_span"),
        (dict(cloth=cloth(tension=15.0)), "cloth.tension without half_span; give half_span too"),
        (dict(warp_length=0.3), "warp_length without half_span; give half_span too"),
        (dict(half_span=0.2, warp_length=0.3), "shorter than the spans; at least 0.4 m"),
    ],
)
def test_half_a_warp_is_refused(asked, said) -> None:
    with pytest.raises(ParameterError, match=said):
        made(**asked)


def test_inertia_of_the_harmonic_cam() -> None:
    """Polar moment of the cam's face: 1/4 of the integral of (Rp + s)^4; guide cams are discs."""
    cam, stack = made().cam, made().stack
    angle = np.linspace(0, 2 * math.pi, 20_001)
    polar = np.trapezoid((cam.prime_radius + cam.programme.at(angle).s) ** 4, angle) / 4
    disc = math.pi / 2 * stack.guide_radius**4
    assert stack.inertia == pytest.approx(7850 * 1e-3 * (600 * polar + 601 * disc), rel=1e-5)


def test_shaft_turns_far_below_its_critical_speed_and_does_not_tire() -> None:
    """First critical speed of the span: (pi / l)^2 sqrt(E I / m'); 205 MPa of corner stress would tire S235."""
    shaft, stack = made().shaft, made().stack
    wanted = (math.pi / 1.2) ** 2 * math.sqrt(200e9 * shaft.bar**4 / 12 / (stack.mass / 1.2))
    assert shaft.critical == pytest.approx(wanted, rel=1e-9)
    thin, thick = made(shaft_bar=30 * mm), made(shaft_bar=80 * mm)
    assert thin.shaft.endurance < 1 < thick.shaft.endurance
    assert "fatigue of the shaft" in [check.name for check in answer(shaft_bar=30 * mm).failed]


def test_motor_over_the_turn() -> None:
    """180 sin 2q up, and down what the reducer's losses leave: rms and mean of both halves."""
    drive = made().drive
    assert drive.duty is not None
    up, down = 1.8 / 0.85, 1.8 * (2 - 1 / 0.85)
    assert drive.duty.rms == pytest.approx(math.hypot(up, down) / 2, rel=1e-6)
    assert drive.duty.power_mean == pytest.approx((up - down) / math.pi * drive.motor_speed, rel=1e-4)
    assert drive.duty.inertia_ratio == pytest.approx(made().stack.inertia / 100**2 / drive.motor.inertia)
