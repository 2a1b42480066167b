"""The student report "Planar knotting mechanisms for Turkish hand woven carpet", sections 3 to 5: every number.

The quoted four-bar with the ground link where closure puts it. Where the report is wrong, the right value is asserted
and the printed one named beside it.
"""

from functools import cache

import numpy as np
import pytest

from ilmek.machines.knotting_four_bar import KnottingFourBar, KnottingFourBarParams, design
from ilmek.machines.knotting_four_bar.posed import COUPLER_ANGLES, POINTS
from ilmek.units import deg, g, mm, turn


@cache
def quoted() -> KnottingFourBar:
    return design(KnottingFourBarParams())


def motion_of(made: KnottingFourBar) -> dict[str, float]:
    motion = made.at.motion
    bodies = {"2": "coupler", "3": "rocker"}
    kinds = {"theta": motion.angle, "omega": motion.omega, "alpha": motion.alpha}
    return {f"{kind}{link}": float(of(body)[0]) for kind, of in kinds.items() for link, body in bodies.items()}


def test_the_loop_closes_only_with_the_ground_at_74_deg() -> None:
    assert quoted().ground_angle / deg == pytest.approx(74.34453836, abs=5e-9)
    r0, r1, r2, r3 = 78.105, 82.345, 15.688, 65.426
    O2_far = r1 * np.exp(135j * deg) + r2 * np.exp(10j * deg)
    assert abs(O2_far) == pytest.approx(74.46400308, abs=5e-9)  # the report: 74.464
    assert np.angle(O2_far) / deg == pytest.approx(125.0622499, abs=5e-8)  # the report: 125, rounded too early
    # The report's ground, 180 - 275 = -95 deg, or 275 deg: the loop misses, and no angles at all would close it.
    theta3 = motion_of(quoted())["theta3"]
    for ground, miss, apart in ((-95, 155.535, 145.428), (275, 153.679, 150.781)):
        pivot = r0 * np.exp(1j * ground * deg)
        assert abs(O2_far - pivot - r3 * np.exp(1j * theta3)) == pytest.approx(miss, abs=5e-4)
        assert abs(r1 * np.exp(135j * deg) - pivot) == pytest.approx(apart, abs=5e-4)
        assert apart > r2 + r3


def test_motion_at_the_quoted_pose() -> None:
    found = motion_of(quoted())
    assert found["theta2"] / deg == pytest.approx(10, abs=1e-9)
    assert found["theta3"] % turn / deg == pytest.approx(192.5859167, abs=5e-8)  # 192.524: from the rounded theta_s
    assert found["omega3"] == pytest.approx(-22.85109041, abs=5e-8)  # -23.41
    assert found["omega2"] == pytest.approx(98.21291193, abs=5e-7)  # 100.55
    # -65454.04: its denominator should be r2 sin(t2 - t3), the report has r3 sin(t3 - t2).
    assert found["alpha2"] == pytest.approx(261779.7656, abs=5e-3)
    assert found["alpha3"] == pytest.approx(-62809.53679, abs=5e-4)  # -67494.34


def test_the_other_ground_gives_the_other_assembly() -> None:
    made = design(KnottingFourBarParams(branch=+1))
    assert made.ground_angle / deg == pytest.approx(175.7799615, abs=5e-8)
    found = motion_of(made)
    assert found["theta3"] / deg == pytest.approx(57.53858314, abs=5e-9)
    assert (found["omega2"], found["omega3"]) == pytest.approx((6.945244485, 1.397502827), abs=5e-9)
    assert (found["alpha2"], found["alpha3"]) == pytest.approx((34.64492833, 12.91237430), abs=5e-8)


def test_the_quoted_pose_is_a_hundredth_of_a_degree_from_a_dead_point() -> None:
    made = quoted()
    assert made.grashof.kind == "double-rocker"
    assert made.range is not None
    from_ground = np.array(made.range) - made.ground_angle
    np.testing.assert_allclose(from_ground / deg, (35.99435523, 60.66614285), atol=5e-9)
    assert (135 * deg - made.ground_angle) / deg == pytest.approx(60.65546164, abs=5e-9)
    assert made.dead_point_distance / deg == pytest.approx(0.0107, abs=5e-5)


def test_accelerations_of_the_mass_centres() -> None:
    motion = quoted().at.motion
    # The report, in mm: 22820 - 1080517 j and -461371 + 2159320 j, from its alpha2 and with G2 at mid-link.
    for body, right in (("coupler", -1061.15086 + 4945.73643j), ("rocker", -431.052138 + 2009.03712j)):
        found = motion.carried(body, quoted().inertias[body].centre).acceleration
        assert complex(found[0]) == pytest.approx(right, abs=5e-4)


@pytest.mark.parametrize(
    ("part", "mass", "moment"),
    [
        ("crank", 3.4977686, 1986.936297),  # 3.5, 1988.2: with the rounded mass
        ("rocker", 2.7791002, 999.6797),  # 2.78, 1000
        ("coupler bar", 1.3863218, None),
        ("holder", 0.1132720, None),
        ("gripper", 0.1415900, None),
    ],
)
def test_masses_and_moments_of_inertia(part: str, mass: float, moment: float | None) -> None:
    found = quoted().parts[part]
    assert found.mass / g == pytest.approx(mass, abs=5e-8)
    assert moment is None or found.moment * 1e9 == pytest.approx(moment, abs=5e-5)


def test_the_coupler_with_holder_and_gripper() -> None:
    found = quoted().inertias["coupler"]
    assert found.mass / g == pytest.approx(1.6411838, abs=5e-8)
    assert found.centre.real / mm == pytest.approx(19.30987269, abs=5e-9)  # 19.30; later it is put at mid-link, 16.32
    assert found.moment * 1e9 == pytest.approx(208.9951571, abs=5e-8)  # 208.94
    assert found.mass * 9.81 == pytest.approx(1.610001356e-2, abs=5e-12)  # 16.1e-2 is printed, 16.1e-3 used
    middles = [quoted().parts[part].centre.real / mm for part in ("holder", "gripper")]
    assert middles == pytest.approx([33.637, 37.137], abs=1e-9)


@pytest.mark.parametrize(
    ("pin", "static", "dynamic"),
    [
        # The report: 78.34 + 7888.8 w², 17.4 - 1378.7 w²; -78.34 - 7851.37 w², -32.4 - 394.43 w²: its dynamic parts are
        # mN added to N, with the wrong alpha2, without m2 aG2 in the moment; its static ones have a sign slip.
        ("O2'", -664.0668191 - 148.2787788j, 379.5945454 + 80.84275421j),
        ("O2", 664.0668191 + 133.2948788j, -381.3360890 - 72.72589146j),
    ],
)
def test_forces_on_the_coupler(pin: str, static: complex, dynamic: complex) -> None:
    made = quoted()
    rest, one = (complex(state.pins[pin][0]) for state in (made.static, made.unit))
    assert rest == pytest.approx(static, abs=1e-6)
    assert one - rest == pytest.approx(dynamic, abs=1e-6)
    assert complex(made.at.pins[pin][0]) == pytest.approx(static + dynamic, abs=1e-6)


def test_drive_torque() -> None:
    # The report: 6448.4 + 484714.7 w² N mm, in truth N mm and uN m added.
    made = quoted()
    static, at_one = float(made.static.torque[0]), float(made.unit.torque[0])
    assert static == pytest.approx(-46.42874564, abs=5e-8)
    assert at_one - static == pytest.approx(26.43853430, abs=5e-8)
    assert float(made.at.torque[0]) == pytest.approx(-19.99021134, abs=5e-8)
    assert made.at.forces.power_error < 1e-12


def test_the_torque_grows_with_the_square_of_the_speed() -> None:
    fast = float(design(KnottingFourBarParams(speed=3.0)).at.torque[0])
    assert fast == pytest.approx(-46.42874564 + 9 * 26.43853430, rel=1e-9)


def test_the_four_bar_of_both_arms_takes_the_three_poses() -> None:
    made = quoted().instead
    lengths = [getattr(made.params, name) / mm for name in ("ground", "crank", "coupler", "rocker")]
    assert lengths == pytest.approx([22.02981005, 17.16552771, 14.29661384, 37.52517660], abs=5e-9)
    np.testing.assert_allclose(made.crank_angles / deg, [185.8208794, 63.40440539, 33.73276562], atol=5e-8)
    motion = made.state.motion
    np.testing.assert_allclose(motion.point("coupler", "H").position, POINTS, atol=1e-15)
    hand = motion.angle("coupler") + np.pi  # the hand points away from O2'
    np.testing.assert_allclose(np.exp(1j * hand), np.exp(1j * COUPLER_ANGLES), atol=1e-12)
    assert np.abs(np.sin(motion.angle("coupler") - motion.angle("rocker"))).min() == pytest.approx(0.618, abs=5e-4)


def test_it_passes_them_in_one_direction_without_a_dead_point() -> None:
    made = quoted().instead
    whole = design(made.params)
    assert whole.range is not None
    assert whole.range[0] < made.crank_angles.min() - 5 * deg
    assert whole.range[1] > made.crank_angles.max() + 5 * deg
    # 0.53 N m where the quoted pose needs 46 N m for the same 15 N.
    assert np.abs(made.state.torque).max() == pytest.approx(0.5322, abs=5e-5)
