"""A beat-up in use: swing from the hand, strength of links and pins, strokes along the carpet."""

import math

import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.machines.beat_up import BeatUpParams, design
from ilmek.machines.beat_up.hand import hand_swing, pivot
from ilmek.machines.beat_up.strength import beat_up_strength_checks
from ilmek.machines.beat_up.use import BeatUpUse, in_use
from ilmek.machines.beat_up.use_params import CastLinkParams
from ilmek.units import deg, mm, turn


def used(**settings: str) -> BeatUpUse:
    return in_use(design(BeatUpParams.read(settings)))


def test_the_usual_positions_of_the_hand_give_the_paper_s_swing() -> None:
    assert BeatUpParams().rocker_swing == pytest.approx(30 * deg, rel=1e-12)
    assert design(BeatUpParams()).swing == pytest.approx(30 * deg, rel=1e-9)


@pytest.mark.parametrize("swing", [10, 45, 120, 200])
def test_the_swing_is_the_angle_about_the_centre_of_three_positions(swing) -> None:
    centre = 0.1 - 0.4j
    at = centre + 0.35 * np.exp(1j * (1.0 + np.array([0.0, 0.3, 1.0]) * swing * deg))
    assert pivot(*at) == pytest.approx(centre)
    assert hand_swing(*at) == pytest.approx(swing * deg)
    assert hand_swing(*at[::-1]) == pytest.approx(swing * deg)


def test_positions_of_a_hand_set_the_swing() -> None:
    hand = "(80mm,0) (40mm,107.703mm) (0,0)"
    with pytest.raises(ParameterError, match="swing"):
        BeatUpParams.read({"hand": hand})
    flat = BeatUpParams.read({"hand": "(0,0) (100mm,5mm) (200mm,0)"})
    assert math.sin(flat.rocker_swing / 2) == pytest.approx(0.1 / ((0.1**2 + 0.005**2) / 0.01))
    assert BeatUpParams.read({"hand": hand, "swing": "32deg"}).rocker_swing == pytest.approx(32 * deg)


@pytest.mark.parametrize(
    ("hand", "said"), [("(0,0) (1mm,1mm)", "2 positions"), ("(0,0) (1mm,1mm) (2mm,2mm)", "in line")]
)
def test_positions_that_give_no_swing_are_refused(hand, said) -> None:
    with pytest.raises(ParameterError, match=said):
        BeatUpParams.read({"hand": hand})


def test_stresses_are_those_of_beams_and_pins() -> None:
    """The coupler is pulled by the force of its pins; the rocker is a cantilever beyond B; pins are cut twice."""
    made = design(BeatUpParams(speed=40.0, beater_mass=20.0, strength=CastLinkParams(pin_diameter=12 * mm)))
    found = made.strength
    w, b, d = 30 * mm, 10 * mm, 12 * mm
    most = max(made.pin_force_max.values())
    assert found.found.pin_shear == pytest.approx(most / (2 * math.pi * d**2 / 4), rel=1e-4)
    assert found.found.pin_pressure == pytest.approx(most / (d * b), rel=1e-4)
    modulus = b * (w**3 - d**3) / (6 * w)
    beyond = made.lengths["beater"] - made.lengths["rocker"]
    bent = made.beater_force_max * beyond / modulus
    assert bent <= found.rocker_stress <= 1.05 * bent
    pull = max(made.pin_force_max["B"], made.pin_force_max["C"])
    assert found.coupler_stress == pytest.approx(pull / ((w - d) * b), rel=0.1)
    euler = math.pi**2 * 110e9 * w * b**3 / 12 / made.lengths["coupler"] ** 2
    pushed = -np.real(np.conj(made.state.motion.direction("coupler")) * made.state.forces.pin("B", on="coupler"))
    assert found.coupler_buckling == pytest.approx(euler / pushed.max(), rel=0.02)
    crank = made.drive_torque_max / modulus
    assert found.crank_stress >= crank * 0.99


def test_links_too_weak_fail_and_name_the_cure() -> None:
    made = design(BeatUpParams(speed=40.0, beater_mass=200.0))
    failed = [check for check in beat_up_strength_checks(made.strength) if not check.ok]
    assert {"stress of the rocker", "stress of the crank"} <= {check.name for check in failed}
    assert all(check.cure for check in failed)


def test_the_thesis_loom_takes_a_hundred_strokes() -> None:
    """63.0 N at the beat are six warps of 10 N; each of the 99 turns between start and stop is a stroke."""
    found = used()
    assert found.travel.stroke_force == pytest.approx(63.0, abs=0.05)
    assert (found.travel.stroke_warps, found.travel.strokes, found.travel.mode) == (6, 100, "through")
    assert found.travel.step_time < found.travel.out_time
    assert found.start.beat_time == pytest.approx((100 + 0.75) * turn / 15.5)


def test_the_crank_stands_where_a_step_of_the_slide_takes_too_long() -> None:
    slow = used(**{"travel.jerk": "20m/s^3"})
    assert slow.travel.mode == "start-stop"
    assert slow.start.beat_time == pytest.approx(100 * 1.75 * turn / 15.5 + 99 * slow.travel.pause)
    quick = used(**{"travel.jerk": "20m/s^3", "travel.mode": "through"})
    assert quick.travel.step_time > quick.travel.out_time


def test_the_beater_is_out_of_the_warps_for_a_part_of_a_turn() -> None:
    """AE (1 - cos d) by the rocker's angle d from the beat; teeth longer than it never leave."""
    found = used()
    assert found.travel.clear == pytest.approx(0.30113 * (1 - math.cos(30 * deg)), rel=1e-4)
    assert 0 < found.travel.out_time < turn / 15.5
    assert used(**{"travel.reach": "41mm"}).travel.out_time == 0.0
