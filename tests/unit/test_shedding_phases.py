"""Cams of a parity all at once, one after another, or as flat as the shuttle allows."""

import math

import numpy as np
import pytest
from cloths import cloth
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.cams.opposed_cams import offsets
from ilmek.errors import ParameterError
from ilmek.machines.shedding import MACHINE, SheddingDesign, SheddingParams
from ilmek.units import deg


def made(**settings_given) -> SheddingDesign:
    return MACHINE.design(SheddingParams(**settings_given))


@settings(max_examples=5)
@given(groups=st.integers(2, 6), spread=st.floats(1 * deg, 80 * deg))
def test_groups_of_the_harmonic_cam_add_as_vectors(groups, spread) -> None:
    """M = |sum n_k e^(2 i delta_k)| F L / 2 max: 180 N m for the thesis' cams, all at once."""
    shed = made(phase="staggered", stagger=spread, stagger_groups=groups).shed
    numbers = np.array(shed.even.numbers)
    assert numbers.sum() == 300
    wanted = 0.3 * 2 * abs(np.sum(numbers * np.exp(2j * offsets(spread, groups))))
    assert max(shed.peaks()[0].value, -shed.peaks()[1].value) == pytest.approx(wanted, rel=1e-6)


@pytest.mark.parametrize("groups", [1, 3])
def test_every_warp_has_its_cam_where_their_number_is_odd(groups) -> None:
    shed = made(cloth=cloth(warps=401), phase="staggered", stagger_groups=groups).shed
    assert (sum(shed.even.numbers), sum(shed.odd.numbers)) == (200, 201)


def test_two_halves_give_the_cosine_of_their_spread() -> None:
    assert made(phase="staggered", stagger=40 * deg).drive.torque_max.value == pytest.approx(180 * math.cos(40 * deg))


def test_the_window_shrinks_by_the_spread() -> None:
    together, apart = made().shuttle_window, made(phase="staggered", stagger=20 * deg).shuttle_window
    assert apart[1] - apart[0] == pytest.approx(together[1] - together[0] - 20 * deg)
    assert apart[0] + apart[1] == pytest.approx(math.pi)


def test_flattest_of_harmonic_cams_is_two_halves_at_the_ends_of_what_the_shuttle_leaves() -> None:
    """Half of acos(-1/3) to pi - that: 35.26 deg, and cos of it of 180 N m."""
    flat = made(phase="flattest", stagger_groups=5)
    window = (math.pi - math.acos(-1 / 3)) / 2
    assert flat.shed.groups == 2
    assert flat.shed.spread == pytest.approx(window, rel=1e-6)
    assert flat.drive.torque_max.value == pytest.approx(180 * math.cos(window), rel=1e-6)
    assert flat.shuttle_window[1] - flat.shuttle_window[0] >= window * (1 - 1e-9)


def test_no_spread_is_flatter_than_the_flattest() -> None:
    asked = dict(cloth=cloth(warp_stiffness=1800.0), front_span=0.2, back_span=0.4, warp_length=1.5, lift=0.08)
    flat = made(phase="flattest", stagger_groups=3, shuttle_angle=60 * deg, **asked)
    peak = max(flat.drive.torque_max.value, -flat.drive.torque_min.value)
    for groups in (2, 3):
        for spread in np.linspace(0.0, flat.shed.spread, 7):
            other = made(phase="staggered", stagger=float(spread), stagger_groups=groups, **asked).drive
            assert peak <= max(other.torque_max.value, -other.torque_min.value) * (1 + 1e-4)


def test_a_window_that_cams_all_at_once_do_not_have_leaves_them_so() -> None:
    flat = made(phase="flattest", shuttle_angle=120 * deg)
    assert (flat.shed.groups, flat.shed.spread) == (1, 0.0)
    assert [check.name for check in MACHINE.report(flat).failed] == ["window of the shuttle"]


def test_half_a_turn_of_spread_takes_the_torque_away() -> None:
    """Many even groups over the period of sin 2 theta: nothing is left, nor is the shed."""
    design = made(phase="staggered", stagger=180 * deg * 9 / 10, stagger_groups=10)
    assert design.drive.torque_max.value < 1e-9
    assert design.shuttle_window[0] == design.shuttle_window[1]


def test_more_groups_than_cams_of_a_parity() -> None:
    with pytest.raises(ParameterError, match="stagger_groups=3 of 4 warps; at most 2"):
        made(cloth=cloth(warps=4), phase="staggered", stagger_groups=3)


def test_plates_of_the_groups_have_their_bores_turned() -> None:
    plates = MACHINE.report(made(phase="staggered", stagger=20 * deg), in_a_loom=True).plates
    assert [(plate.name, plate.number) for plate in plates] == [
        ("shedding-cam-1", 300),
        ("shedding-cam-2", 300),
        ("guide-cam", 516),
        ("thin-guide-cam", 85),
        ("shims", 85),
        ("pressure-ring", 2),
    ]
    corners = [complex(plate.cutouts[0].points[0]) for plate in plates[:2]]
    assert np.angle(corners[1] / corners[0]) == pytest.approx(20 * deg)
