"""Programmes with constant speed, free parts and blends: continuity of the asked order, and jumps that remain."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from ilmek.cams.laws import LAWS, SMOOTH_LAWS, law_of
from ilmek.cams.programme import TURN, CamProgramme, all_jumps, blend, dwell, even, fall, free, joined, jumps, rise
from ilmek.errors import ParameterError


def uniform() -> CamProgramme:
    law = LAWS["uniform"]
    return CamProgramme((rise(1.0, 0.02, law), dwell(2.0), fall(1.0, 0.02, law), dwell(TURN - 4.0)))


def test_uniform_motion_jumps_in_the_velocity_and_nowhere_else() -> None:
    found = jumps(uniform(), 1)
    assert [(jump.where, round(jump.after - jump.before, 12)) for jump in found] == [
        ("from dwell to rise", 0.02),
        ("from rise to dwell", -0.02),
        ("from dwell to fall", -0.02),
        ("from fall to dwell", 0.02),
    ]
    assert jumps(uniform(), 2) == jumps(uniform(), 3) == ()


def test_continuity_not_met_names_place_angle_and_derivative() -> None:
    said = r"velocity jumps from 0 to 0.02 m/rad at 0 deg, from dwell to rise, and 3 more; no jump up to the accel"
    with pytest.raises(ParameterError, match=said):
        uniform().require_continuity(2)
    law = LAWS["cycloidal"]
    smooth = CamProgramme((rise(1.0, 0.02, law), fall(1.0, 0.02, law), dwell(TURN - 2.0)))
    assert smooth.require_continuity(2) is smooth
    with pytest.raises(ParameterError, match="the jerk jumps from 0 to .* m/rad.3 at 0 deg"):
        smooth.require_continuity(3)


@settings(max_examples=25)
@given(
    order=st.integers(1, 3),
    spans=st.lists(st.floats(0.5, 1.5), min_size=3, max_size=3),
    speed=st.floats(1e-3, 0.03),
    start=st.floats(-4, 4),
)
@example(order=1, spans=[1.0, 1.0, 1.0], speed=0.015625, start=0.0)
def test_blends_reach_the_asked_order(order, spans, speed, start) -> None:
    """Constant speed, blended into a dwell and back: no derivative up to the order steps at an edge."""
    feed, first, still = spans
    change, up = speed * feed, 0.4 * speed * first
    parts = (even(feed, change), blend(first, up), dwell(still), blend(TURN - sum(spans), -change - up))
    made = joined(parts, order, start)
    assert all_jumps(made, order) == ()
    for edge in made.edges[:-1]:
        before, after = (made.motion(np.array(start + edge + side)) for side in (-1e-9, 1e-9))
        for k in range(order + 1):
            assert float(before[k]) == pytest.approx(float(after[k]), abs=1e-7 * speed * 10**k)
    middle = made.motion(np.array(start + 0.5 * feed))
    assert float(middle.ds) == pytest.approx(speed)
    assert [segment.name for segment in made.segments] == ["constant speed", "blend", "dwell", "blend"]


def test_blends_do_not_hide_the_jumps_of_others() -> None:
    parts = (rise(1.0, 0.02, LAWS["harmonic"]), dwell(2.0), blend(TURN - 3.0, -0.02))
    with pytest.raises(ParameterError, match="acceleration jumps from -.* to 0 m/rad.2 at 57.3 deg, from rise"):
        joined(parts)
    assert all_jumps(joined(parts, 1), 1) == ()


@pytest.mark.parametrize(
    ("parts", "order", "said"),
    [
        ((blend(1.0, 0.01), blend(1.0, -0.01), dwell(TURN - 2.0)), 2, "two adjacent blends; give the motion"),
        ((dwell(TURN),), 4, "continuity of order 4; 1 .velocity., 2"),
        ((even(1.0, 0.01), blend(TURN - 1.0, -0.02)), 2, "-10 mm from its start; it must return"),
        ((even(1.0, 0.01), blend(1.0, -0.01)), 2, "constant speed 57.3 . blend 57.3 degrees; its parts must add up"),
    ],
)
def test_refuses_what_cannot_be_joined(parts, order, said) -> None:
    with pytest.raises(ParameterError, match=said):
        joined(parts, order)


@settings(max_examples=25)
@given(
    start=st.lists(st.floats(-0.05, 0.05), min_size=1, max_size=3),
    end=st.lists(st.floats(-0.05, 0.05), min_size=1, max_size=3),
    change=st.floats(-0.05, 0.05),
    span=st.floats(0.3, 3.0),
)
def test_a_free_part_has_the_derivatives_it_was_given(start, end, change, span) -> None:
    part = free(span, change, start, end)
    size = max(abs(change), *(abs(value) * span**k for row in (start, end) for k, value in enumerate(row, 1)))
    for u, row in ((0.0, start), (1.0, end)):
        for k, value in enumerate(row, 1):
            assert part.derivative(u, k) == pytest.approx(value, abs=1e-10 * size / span**k + 1e-300)
    assert float(part.motion(np.array(1.0)).s) == pytest.approx(change, abs=1e-12 * size + 1e-300)


def test_a_rise_that_overshoots_is_counted_in_the_bounds() -> None:
    over = free(2.0, 0.01, (0.03, 0.0), (0.0, 0.0))
    made = CamProgramme((over, fall(2.0, 0.01, LAWS["3-4-5"]), dwell(TURN - 4.0)))
    angle = np.linspace(0, TURN, 200_001)
    assert made.bounds == pytest.approx((made.at(angle).s.min(), made.at(angle).s.max()), abs=1e-10)
    assert made.bounds[1] > 0.0101


def test_an_indexing_programme_gains_its_step_every_turn() -> None:
    table = CamProgramme((rise(2.0, 0.05, LAWS["modified-sine"]), dwell(TURN - 2.0)), start=0.3, revolves=0.05)
    angle = np.linspace(-7, 20, 500)
    here, later = table.motion(angle), table.motion(angle + TURN)
    np.testing.assert_allclose(later.s - here.s, 0.05, atol=1e-15)
    np.testing.assert_allclose(later.ds, here.ds, atol=1e-13)
    assert np.all(np.diff(here.s) >= -1e-16)
    with pytest.raises(ParameterError, match="miss revolves=60 mm by -10 mm"):
        CamProgramme(table.segments, revolves=0.06)


@settings(max_examples=25)
@given(
    law=st.sampled_from([LAWS[name] for name in SMOOTH_LAWS]),
    angles=st.lists(st.floats(-20, 20), min_size=1, max_size=40),
    start=st.floats(-7, 7),
)
def test_any_order_of_angles_is_the_angles_one_by_one(law, angles, start) -> None:
    made = CamProgramme((rise(1.7, 0.03, law), dwell(0.8), fall(2.1, 0.03, law), dwell(TURN - 4.6)), start)
    whole = np.stack(made.motion(np.array(angles)))
    single = np.array([[float(row) for row in made.motion(np.array(angle))] for angle in angles]).T
    np.testing.assert_array_equal(whole, single)
    u = (math.fmod(angles[0] - start, TURN) + TURN) % TURN / 1.7
    if u < 1:
        assert whole[0, 0] == pytest.approx(0.03 * float(law.s(u)), abs=1e-15)


@pytest.mark.parametrize("first", [-0.1, 0.1])
@pytest.mark.parametrize("lift", [-0.02, 0.02])
def test_a_law_that_does_not_begin_at_zero_is_no_rise(first: float, lift: float) -> None:
    late = replace(LAWS["cycloidal"], first=first)
    parts = (rise(1.0, 0.02, LAWS["3-4-5"]), fall(1.0, 0.02, late)) if lift < 0 else (
        rise(1.0, 0.02, late), fall(1.0, 0.02, LAWS["3-4-5"])
    )  # fmt: skip
    with pytest.raises(ParameterError, match=f"its law cycloidal goes from {first:g} to 1; from 0 to 1"):
        CamProgramme((*parts, dwell(TURN - 2.0)))


def test_a_law_that_does_not_end_at_one_is_no_rise() -> None:
    half = law_of("polynomial", {"end": (0.5, 0, 0)})
    said = "rise: its law polynomial goes from 0 to 0.5; from 0 to 1; use a law that ends at 1, or `free`"
    with pytest.raises(ParameterError, match=said):
        CamProgramme((rise(1.0, 0.02, half), fall(1.0, 0.02, LAWS["3-4-5"]), dwell(TURN - 2.0)))
