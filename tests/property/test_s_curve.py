"""Jerk-limited moves: limits kept by integrating the jerk, no shorter one among others, the limits' own laws."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from ilmek.cams.laws import law_of
from ilmek.errors import ParameterError
from ilmek.timing.s_curve import AxisLimits, SCurve, move_time, s_curve, travel_time

SIZES = st.floats(1e-3, 1e3)


def integrated(move: SCurve, jerk: float) -> tuple[float, float, float]:
    """Distance, greatest speed and greatest acceleration, by exact integration of the seven parts of constant jerk."""
    place = speed = acceleration = top_speed = top_acceleration = 0.0
    parts = ((move.ramp, 1), (move.hold, 0), (move.ramp, -1), (move.cruise, 0))
    for time, sign in (*parts, (move.ramp, -1), (move.hold, 0), (move.ramp, 1)):
        j = sign * jerk
        place += speed * time + acceleration * time**2 / 2 + j * time**3 / 6
        speed += acceleration * time + j * time**2 / 2
        acceleration += j * time
        top_speed, top_acceleration = max(top_speed, speed), max(top_acceleration, abs(acceleration))
    return place, top_speed, top_acceleration


@given(SIZES, SIZES, SIZES, SIZES)
def test_the_integrated_jerk_arrives_and_keeps_every_limit(distance, speed, acceleration, jerk):
    move = s_curve(distance, AxisLimits(speed, acceleration, jerk))
    place, top_speed, top_acceleration = integrated(move, jerk)
    assert place == pytest.approx(distance, rel=1e-9)
    assert top_speed <= speed * (1 + 1e-9)
    assert top_acceleration <= acceleration * (1 + 1e-9)
    assert min(move.ramp, move.hold, move.cruise) >= -1e-12 * move.time
    assert move.speed == pytest.approx(top_speed, rel=1e-6)


@given(SIZES, SIZES, SIZES, SIZES)
def test_some_limit_is_used_up_throughout(distance, speed, acceleration, jerk):
    """The shortest move uses full jerk, and then acceleration, and then speed as far as it has the room."""
    move = s_curve(distance, AxisLimits(speed, acceleration, jerk))
    _, top_speed, top_acceleration = integrated(move, jerk)
    if move.hold > 1e-9 * move.time:
        assert top_acceleration == pytest.approx(acceleration, rel=1e-6)
    if move.cruise > 1e-9 * move.time:
        assert top_speed == pytest.approx(speed, rel=1e-6)


@given(SIZES, SIZES, SIZES)
def test_without_a_limit_of_the_jerk_it_is_the_trapezoid(distance, speed, acceleration):
    reached = distance >= speed**2 / acceleration
    trapezoid = distance / speed + speed / acceleration if reached else 2 * math.sqrt(distance / acceleration)
    assert move_time(distance, AxisLimits(speed, acceleration)) == pytest.approx(trapezoid, rel=1e-12)


@given(SIZES, SIZES, SIZES, SIZES, st.floats(0.1, 10.0))
def test_scale_laws(distance, speed, acceleration, jerk, scale):
    """Length by k leaves the time; time by k divides the limits by k, k^2, k^3."""
    time = move_time(distance, AxisLimits(speed, acceleration, jerk))
    longer = AxisLimits(speed * scale, acceleration * scale, jerk * scale)
    slower = AxisLimits(speed / scale, acceleration / scale**2, jerk / scale**3)
    assert move_time(distance * scale, longer) == pytest.approx(time, rel=1e-9)
    assert move_time(distance, slower) == pytest.approx(time * scale, rel=1e-9)


@given(SIZES, SIZES, SIZES)
def test_no_random_profile_of_the_same_limits_is_quicker(speed, acceleration, jerk):
    """Profiles of other ramp and hold within the limits need at least as long for what distance they cover."""
    rng = np.random.default_rng(1)
    for ramp, hold, cruise in rng.uniform(0, 1, (40, 3)):
        ramp = ramp * min(acceleration / jerk, math.sqrt(speed / jerk))
        hold = hold * max(0.0, speed / (jerk * ramp) - ramp)
        other = SCurve(0.0, ramp, hold, cruise * ramp)
        covered = integrated(other, jerk)[0]
        assert move_time(covered, AxisLimits(speed, acceleration, jerk)) <= other.time * (1 + 1e-9)


@given(SIZES, SIZES, SIZES, SIZES)
def test_the_law_of_a_move_has_its_course(distance, speed, acceleration, jerk):
    move = s_curve(distance, AxisLimits(speed, acceleration, jerk))
    law = law_of("s-curve", {"ramp": min(0.25, move.ramp / move.time), "cruise": move.cruise / move.time})
    _, top_speed, top_acceleration = integrated(move, jerk)
    assert law.velocity_peak * distance / move.time == pytest.approx(top_speed, rel=1e-6)
    assert law.acceleration_peak * distance / move.time**2 == pytest.approx(top_acceleration, rel=1e-6)
    assert law.jerk_peak * distance / move.time**3 == pytest.approx(jerk, rel=1e-6)


@given(st.floats(0.01, 0.25), st.floats(0.0, 1.0))
def test_the_laws_torque_and_rms_are_those_of_its_curves(ramp, share):
    law = law_of("s-curve", {"ramp": ramp, "cruise": share * (1 - 4 * ramp)})
    u = (np.arange(100_000) + 0.5) / 100_000
    assert law.torque_peak == pytest.approx(float(np.max(law.v(u) * law.a(u))), rel=1e-3)
    assert law.acceleration_rms == pytest.approx(math.sqrt(float(np.mean(law.a(u) ** 2))), rel=1e-3)


def test_no_move_takes_no_time_and_bad_limits_are_told():
    assert move_time(0.0, AxisLimits(1.0, 1.0, 1.0)) == 0.0
    with pytest.raises(ParameterError, match="acceleration"):
        AxisLimits(1.0, -1.0)
    with pytest.raises(ParameterError, match="one of them finite"):
        AxisLimits(1.0, math.inf)
    with pytest.raises(ParameterError, match="a finite distance"):
        s_curve(math.nan, AxisLimits(1.0, 1.0))


@given(SIZES, SIZES, SIZES, SIZES)
def test_backwards_a_move_is_the_same_move(distance, speed, acceleration, jerk):
    limits = AxisLimits(speed, acceleration, jerk)
    there, back = s_curve(distance, limits), s_curve(-distance, limits)
    assert (there.time, there.speed) == (back.time, back.speed)
    time = np.linspace(-0.1, 1.1, 30) * there.time
    np.testing.assert_array_equal(there.at(time), -back.at(time))


LIMITS = st.tuples(SIZES, SIZES, st.one_of(SIZES, st.just(math.inf)))


@given(st.floats(1e-3, 10.0), st.floats(0.0, 5.0), LIMITS)
@example(0.1115, 0.0, (0.55, 837.0, 3.72))  # the second pitch requires the most, although more are required beyond
def test_the_time_of_a_further_pitch_is_the_least_that_no_longer_move_exceeds(pitch, window, limits):
    """Tried for each number of pitches up to where every move has its full speed, and far beyond."""
    axis = AxisLimits(*limits)
    room = max(window, move_time(pitch, axis))
    ramp = axis.acceleration / axis.jerk + (axis.speed / axis.jerk) ** 0.5
    reach = 4 * axis.speed * (axis.speed / axis.acceleration + ramp)
    counts = sorted({*range(2, 300), *np.geomspace(2, max(3.0, 4 * reach / pitch), 200).astype(int).tolist()})
    needed = [(move_time(count * pitch, axis) - room) / (count - 1) for count in counts]
    least = max(pitch / axis.speed, *needed)
    further = travel_time(pitch, window, axis)
    assert further >= least * (1 - 1e-9)  # every move keeps it
    if max(needed) <= pitch / axis.speed or counts[int(np.argmax(needed))] < 300:
        assert further == pytest.approx(least, rel=1e-9)  # and none shorter would do


def test_the_time_of_a_further_pitch_by_hand():
    """1 m/s, 2 m/s²: a pitch of 0.1 m takes 2 sqrt(0.1 / 2) s; the worst of the longer moves by trial."""
    axis = AxisLimits(1.0, 2.0)
    moves = [2 * math.sqrt(d * 0.1 / 2) if d * 0.1 <= 0.5 else d * 0.1 + 0.5 for d in range(2, 100)]
    worst = max((move - 2 * math.sqrt(0.05)) / (d - 1) for d, move in enumerate(moves, 2))
    assert travel_time(0.1, 0.0, axis) == pytest.approx(worst)
    assert worst == pytest.approx(2 * math.sqrt(0.05) * (math.sqrt(2) - 1))
    assert travel_time(0.1, 10.0, axis) == 0.1
