"""Tracks: position and derivatives, dwells, peaks, and what is no track."""

import math

import numpy as np
import pytest

from ilmek.cams.laws import LAWS
from ilmek.errors import ParameterError
from ilmek.timing.track import (
    ActuatorLimits,
    Track,
    TrackEvent,
    TrackSegment,
    joints,
    peak_acceleration,
    peak_speed,
    riding,
    sample,
    shortest_period,
)
from ilmek.units import deg, turn

HARMONIC = LAWS["harmonic"]


def up_and_down() -> Track:
    rise = TrackSegment("up", 0.0, 90 * deg, 0.0, 0.06, HARMONIC)
    fall = TrackSegment("down", 180 * deg, 270 * deg, 0.06, 0.0, HARMONIC)
    return Track("shed", "cam", (rise, fall), (TrackEvent("open", 90 * deg),))


def test_positions_with_dwells_between() -> None:
    angle = np.array([0, 45, 90, 120, 225, 300, 360]) * deg
    assert sample(up_and_down(), angle).position == pytest.approx([0, 0.03, 0.06, 0.06, 0.03, 0, 0], abs=1e-15)


def test_derivatives_are_those_of_the_position() -> None:
    angle = np.linspace(1, 359, 2000) * deg
    angle = angle[np.abs((angle / deg) % 90 - 45) < 44]
    step = 1e-5
    here, before, after = (sample(up_and_down(), angle + shift) for shift in (0.0, -step, step))
    assert here.slope == pytest.approx((after.position - before.position) / (2 * step), abs=1e-10)
    assert here.bend == pytest.approx((after.slope - before.slope) / (2 * step), abs=1e-9)


def test_at_a_joint_the_later_motion_counts() -> None:
    parts = (
        TrackSegment("up", 0.0, math.pi, 0.0, 1.0, HARMONIC),
        TrackSegment("down", math.pi, turn, 1.0, 0.0, HARMONIC),
    )
    bend = sample(Track("x", "y", parts), np.array([math.pi])).bend
    assert bend == pytest.approx([-0.5])


def test_peaks_are_those_of_the_shedding_cams_of_the_thesis() -> None:
    # 60 mm in 90 degrees at 5 rpm, harmonic: 31.416 mm/s and 32.899 mm/s^2.
    assert peak_speed(up_and_down(), 12.0) == pytest.approx(0.03141592654, rel=1e-9)
    assert peak_acceleration(up_and_down(), 12.0) == pytest.approx(0.03289868134, rel=1e-9)


@pytest.mark.parametrize(("speed", "acceleration"), [(0.01, 1.0), (1.0, 0.01), (0.05, 0.08)])
def test_shortest_period_meets_one_limit_and_keeps_the_other(speed: float, acceleration: float) -> None:
    track = up_and_down()
    period = shortest_period(track, speed, acceleration)
    shares = peak_speed(track, period) / speed, peak_acceleration(track, period) / acceleration
    assert max(shares) == pytest.approx(1.0)


def test_a_track_without_motion_rests() -> None:
    track = Track("lamp", "none", ())
    assert sample(track, np.array([0.0, 3.0])).position.tolist() == [0.0, 0.0]
    assert (track.stroke, peak_speed(track, 1.0)) == (0.0, 0.0)


def test_a_shaft_may_turn_on() -> None:
    parts = (TrackSegment("round", 0.0, math.pi, 0.0, turn, HARMONIC),)
    assert Track("handler", "cam", parts, revolves=turn).stroke == turn
    with pytest.raises(ParameterError, match="never jumps"):
        Track("handler", "cam", parts)


@pytest.mark.parametrize(
    ("spans", "said"),
    [
        (((0, 100, 0, 1), (90, 200, 1, 0)), "starts at 90 deg, before a ends at 100 deg"),
        (((0, 100, 0, 1), (150, 200, 2, 0)), "a ends at 1"),
        (((0, 100, 0, 1), (150, 200, 1, 0.5)), "b ends at 0.5"),
        (((100, 100, 0, 0), (150, 200, 0, 0)), "a motion starts before it ends"),
        (((0, 100, 0, 1), (150, 400, 1, 0)), "within 0..360 deg"),
    ],
    ids=["overlap", "jump", "no return", "no angle", "beyond the turn"],
)
def test_what_is_no_track(spans: tuple[tuple[float, ...], ...], said: str) -> None:
    parts = tuple(
        TrackSegment(name, start * deg, end * deg, float(begin), float(finish), HARMONIC)
        for name, (start, end, begin, finish) in zip("ab", spans, strict=True)
    )
    with pytest.raises(ParameterError, match=said):
        Track("x", "y", parts, unit="")


def test_an_event_lies_within_the_turn() -> None:
    with pytest.raises(ParameterError, match="event 'late' at 400 deg"):
        Track("x", "y", (), (TrackEvent("late", 400 * deg),))


def test_a_motion_may_run_through_the_end_of_the_turn() -> None:
    parts = (
        TrackSegment("back", 60 * deg, 150 * deg, 1.0, 0.0, HARMONIC),
        TrackSegment("go", 330 * deg, 420 * deg, 0.0, 1.0, HARMONIC),
    )
    track = Track("x", "y", parts, (riding("half", parts[1], 0.5),))
    angle = np.array([0, 15, 60, 105, 240, 345, 360]) * deg
    rise = [float(HARMONIC.s(share)) for share in (1 / 3, 1 / 2, 1 / 6)]
    expected = [rise[0], rise[1], 1.0, 0.5, 0.0, rise[2], rise[0]]
    assert sample(track, angle).position == pytest.approx(expected, abs=1e-14)
    assert track.event("half").angle == pytest.approx(15 * deg)
    assert joints(track)[:2] == pytest.approx([0.0, 60 * deg])


def test_an_axis_that_steps_on_through_the_end_of_the_turn() -> None:
    step = TrackSegment("step", 300 * deg, 390 * deg, 0.0, 0.01, HARMONIC)
    motion = sample(Track("carriage", "belt", (step,), revolves=0.01), np.array([0.0, 30.0, 299.0, 360.0]) * deg)
    late = 0.01 * float(HARMONIC.s(2 / 3))
    assert motion.position == pytest.approx([late - 0.01, 0.0, 0.0, late], abs=1e-15)
    assert motion.slope[0] == pytest.approx(motion.slope[-1])


@pytest.mark.parametrize(
    ("event", "said"),
    [
        (TrackEvent("cut", 0.5, "up", 0.25), "0.25 of up"),
        (TrackEvent("cut", 0.0, "across", 0.0), "no motion 'across'"),
        (TrackEvent("cut", 7.0), "at 401.1 deg"),
    ],
)
def test_an_event_rides_where_its_motion_is(event: TrackEvent, said: str) -> None:
    parts = (TrackSegment("up", 0.0, 1.0, 0.0, 1.0, HARMONIC), TrackSegment("down", 1.0, 2.0, 1.0, 0.0, HARMONIC))
    with pytest.raises(ParameterError, match=said):
        Track("x", "y", parts, (event,))


def test_motions_of_one_track_have_their_own_names() -> None:
    parts = (TrackSegment("a", 0.0, 1.0, 0.0, 1.0, HARMONIC), TrackSegment("a", 1.0, 2.0, 1.0, 0.0, HARMONIC))
    with pytest.raises(ParameterError, match="two motions are named 'a'"):
        Track("x", "y", parts)


@pytest.mark.parametrize("limits", [{"speed": 0.0}, {"jerk": math.nan}, {"time": -1.0}, {"time": math.inf}])
def test_what_is_no_limit(limits: dict[str, float]) -> None:
    with pytest.raises(ParameterError):
        ActuatorLimits(**limits)
