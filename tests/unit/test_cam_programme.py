"""Programmes: filling the turn, motion at any angle, jumps named, pieces searched and integrated."""

import math

import numpy as np
import pytest

from ilmek.cams.laws import LAWS
from ilmek.cams.programme import CamProgramme, dwell, fall, jumps, rise
from ilmek.errors import ParameterError
from ilmek.num.piecewise import infimum, integral, supremum

QUARTER = math.pi / 2


def shed(name: str) -> CamProgramme:
    law = LAWS[name]
    return CamProgramme((rise(QUARTER, 0.06, law), fall(QUARTER, 0.06, law), dwell(math.pi)))


def test_shedding_programme_is_the_printed_law() -> None:
    """s = 30 (1 - cos 2q) mm on the first half turn, and its derivatives; nothing on the second."""
    q = np.linspace(0.01, math.pi - 0.01, 50)
    at = shed("harmonic").at(q)
    np.testing.assert_allclose(at.s, 0.03 * (1 - np.cos(2 * q)), atol=1e-16)
    np.testing.assert_allclose(at.ds, 0.06 * np.sin(2 * q), atol=1e-16)
    np.testing.assert_allclose(at.dds, 0.12 * np.cos(2 * q), atol=1e-15)
    np.testing.assert_allclose(at.ddds, -0.24 * np.sin(2 * q), atol=1e-15)
    assert not np.any(shed("harmonic").at(q + math.pi).s)


def test_any_turn_and_any_shape() -> None:
    q = np.linspace(0.1, 6.0, 12).reshape(3, 4)
    programme = shed("3-4-5")
    np.testing.assert_allclose(programme.at(q - 4 * math.pi).s, programme.at(q).s, atol=1e-15)
    np.testing.assert_allclose(programme.shifted(1.0).at(q + 1.0).s, programme.at(q).s, atol=1e-15)
    assert programme.at(np.array(-1e-18)).s == pytest.approx(0.0)


@pytest.mark.parametrize(
    ("name", "places"),
    [
        ("harmonic", [("from dwell to rise", 0.0), ("from fall to dwell", math.pi)]),
        (
            "parabolic",
            [
                ("from dwell to rise", 0.0),
                ("inside the rise", QUARTER / 2),
                ("inside the fall", 1.5 * QUARTER),
                ("from fall to dwell", math.pi),
            ],
        ),
        ("cycloidal", []),
        ("3-4-5", []),
        ("modified-sine", []),
    ],
)
def test_names_where_the_acceleration_jumps(name, places) -> None:
    found = jumps(shed(name))
    assert [jump.where for jump in found] == [place for place, _ in places]
    assert [jump.angle for jump in found] == pytest.approx([angle for _, angle in places])
    assert jumps(shed(name), order=1) == ()


def test_whole_turns_are_the_begin_of_the_first_part() -> None:
    law = LAWS["uniform"]
    saw = CamProgramme((rise(1.0, 0.01, law), fall(2 * math.pi - 1.0, 0.01, law)))
    np.testing.assert_allclose(saw.motion(2 * math.pi * np.arange(-300, 301)).ds, 0.01, rtol=1e-12)


def test_size_of_the_jump() -> None:
    first = jumps(shed("harmonic"))[0]
    assert (first.before, first.after) == pytest.approx((0.0, 0.12))
    middle = jumps(shed("parabolic"))[1]
    assert (middle.before, middle.after) == pytest.approx((4 * 0.06 / QUARTER**2, -4 * 0.06 / QUARTER**2))


def test_the_jerk_jumps_where_a_smooth_law_meets_a_dwell() -> None:
    assert [jump.where for jump in jumps(shed("cycloidal"), order=3)] == [
        "from dwell to rise",
        "from rise to fall",
        "from fall to dwell",
    ]


@pytest.mark.parametrize(
    ("segments", "said"),
    [
        ((rise(QUARTER, 0.06, LAWS["harmonic"]), fall(QUARTER, 0.06, LAWS["harmonic"])), "rise 90 . fall 90 degrees"),
        ((rise(QUARTER, 0.06, LAWS["harmonic"]), dwell(1.5 * math.pi)), "60 mm from its start"),
        ((dwell(3 * math.pi), dwell(-math.pi)), "must add up to 360"),
        ((), "no parts"),
    ],
)
def test_refuses_what_is_no_turn(segments, said) -> None:
    with pytest.raises(ParameterError, match=said):
        CamProgramme(segments)


def test_least_upper_bound_takes_the_side_where_it_is_larger() -> None:
    knots = np.array([0.0, 1.0, 2.0])

    def step(x):
        return np.where(x < 1.0, x, 0.25)

    assert supremum(step, knots).value == pytest.approx(1.0, abs=1e-12)
    assert infimum(step, knots).value == pytest.approx(0.0, abs=1e-12)
    assert integral(step, knots) == pytest.approx(0.75, abs=1e-12)


def test_the_top_is_found_to_rounding() -> None:
    top = supremum(lambda x: 1 - (x - 0.123456789) ** 2, np.array([0.0, 2.0]))
    assert top.value == pytest.approx(1.0, abs=1e-15)
    assert top.at == pytest.approx(0.123456789, abs=3e-8)
