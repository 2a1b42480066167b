"""Laws of the quickest motion along any path: limits kept, rates that belong together, reversal and scale."""

import numpy as np
import pytest
from effort import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.timing.path_speed.solve import AxesLimits, JointPath, PathMotion, quickest_motion
from ilmek.timing.s_curve import AxisLimits, s_curve

INTERVALS = 100
LIMIT = st.floats(-1.0, 1.0).map(lambda power: 10**power)
ANY = st.floats(-3.0, 3.0).map(lambda power: 10**power)


def path_of(seed: int, axes: int = 2, nodes: int = 61) -> JointPath:
    """Waves of up to one and a half turns."""
    rng = np.random.default_rng(seed)
    s = np.linspace(0.0, 1.0, nodes)
    pace, start, size = rng.uniform(-9, 9, (3, axes)) * np.array([[1.0], [1.0], [0.1]])
    phase = s[:, None] * pace + start
    return JointPath(s, size * np.sin(phase), size * pace * np.cos(phase), -size * pace**2 * np.sin(phase))


def limits_of(speed: float, acceleration: float, jerk: float, axes: int = 2) -> AxesLimits:
    return AxesLimits(*(np.linspace(limit, 2 * limit, axes) for limit in (speed, 10 * acceleration, 100 * jerk)))


def moved(seed: int, limits: AxesLimits) -> PathMotion:
    return quickest_motion(path_of(seed, len(limits.jerk)), limits, INTERVALS)


@settings(max_examples=5)
@given(seed=st.integers(0, 10**6), axes=st.integers(1, 3), speed=ANY, acceleration=ANY, jerk=ANY)
def test_no_limit_is_overstepped_and_one_is_always_reached(
    seed: int, axes: int, speed: float, acceleration: float, jerk: float
) -> None:
    limits = limits_of(speed, acceleration, jerk, axes)
    motion = moved(seed, limits)
    course = motion.at(np.random.default_rng(seed).uniform(0.0, motion.duration, 4000))
    used = np.stack(
        [
            np.abs(course.speed) / limits.speed,
            np.abs(course.acceleration) / limits.acceleration,
            np.abs(course.jerk) / limits.jerk,
        ]
    )
    assert used.max() <= 1 + 1e-3
    assert np.max(used, axis=(0, 2)).mean() > 0.9  # at nearly every moment, some limit
    assert motion.usage.max() <= 1 + 1e-9


@settings(max_examples=4)
@given(seed=st.integers(0, 10**6), speed=LIMIT, jerk=LIMIT)
def test_positions_speeds_accelerations_and_jerks_belong_together(seed: int, speed: float, jerk: float) -> None:
    motion = moved(seed, limits_of(speed, 1.0, jerk))
    time = np.linspace(0.02, 0.98, 200) * motion.duration
    step = 1e-4 * motion.duration
    before, here, after = (motion.at(time + shift) for shift in (-step, 0.0, step))
    for value, rate in (
        ("position", "speed"),
        ("speed", "acceleration"),
        ("s", "s_speed"),
        ("s_speed", "s_acceleration"),
    ):
        slope = (getattr(after, value) - getattr(before, value)) / (2 * step)
        exact = getattr(here, rate)
        moved_on = np.maximum(*(np.abs(getattr(one, rate) - exact) for one in (before, after)))
        assert (np.abs(slope - exact) <= moved_on + 1e-4 * np.abs(exact).max()).all()  # a mean of the rates in between
    change = np.abs(after.acceleration - before.acceleration).max(axis=0)
    assert (change <= 2 * step * motion.limits.jerk * (1 + 2e-3)).all()
    assert np.abs(here.position - motion.path.at(here.s)).max() == 0


@settings(max_examples=2)
@given(seed=st.integers(0, 10**6), jerk=LIMIT)
def test_backwards_and_in_other_units_it_takes_the_same_time(seed: int, jerk: float) -> None:
    path, limits = path_of(seed), limits_of(1.0, 1.0, jerk)
    back = JointPath(1 - path.s[::-1], path.positions[::-1], np.asarray(-path.slopes[::-1]), path.bends[::-1])
    other = AxesLimits(limits.speed / 3, limits.acceleration / 9, limits.jerk / 27)  # three times slower
    longer = JointPath(5 * path.s, path.positions, path.slopes / 5, path.bends / 25)
    time = quickest_motion(path, limits, INTERVALS).duration
    assert quickest_motion(back, limits, INTERVALS).duration == pytest.approx(time, rel=2e-3)
    assert quickest_motion(path, other, INTERVALS).duration == pytest.approx(3 * time, rel=2e-3)
    assert quickest_motion(longer, limits, INTERVALS).duration == pytest.approx(time, rel=2e-3)


@examples(60)
@given(
    distance=st.floats(-10, 10).filter(lambda way: way == 0 or abs(way) > 1e-3),
    speed=LIMIT,
    acceleration=LIMIT,
    jerk=LIMIT,
)
def test_the_seven_phases_end_where_they_should_and_keep_the_limits(
    distance: float, speed: float, acceleration: float, jerk: float
) -> None:
    motion = s_curve(distance, AxisLimits(speed, acceleration, jerk))
    position, rate, bend, third = motion.at(np.linspace(0.0, motion.time, 501))
    size = max(abs(distance), 1e-3)
    just_before = motion.at(np.array([np.nextafter(motion.time, 0.0)]))[:3, 0]
    assert just_before == pytest.approx([distance, 0.0, 0.0], abs=1e-7 * size + 1e-7)
    assert position[-1] == distance
    assert np.abs(rate).max() <= speed * (1 + 1e-9)
    assert np.abs(bend).max() <= acceleration * (1 + 1e-9)
    assert np.abs(third).max() <= jerk
    assert (np.diff(np.abs(position)) >= -1e-12).all()


def ones(axes: int) -> FloatArray:
    return np.ones(axes)


@pytest.mark.parametrize(
    ("made", "said"),
    [
        (lambda: AxesLimits(ones(1), -ones(1), ones(1)), "acceleration limits"),
        (lambda: AxesLimits(ones(1), ones(1), np.array([np.inf])), "jerk's finite"),
        (lambda: JointPath(np.zeros(2), np.zeros((2, 1)), np.ones((2, 1)), np.zeros((2, 1))), "s ascending"),
        (lambda: JointPath(np.arange(2.0), np.zeros((2, 1)), np.zeros((2, 1)), np.zeros((2, 1))), "no axis moves"),
        (lambda: quickest_motion(path_of(1), limits_of(1, 1, 1, 3)), "2 axes with limits of 3"),
        (lambda: quickest_motion(path_of(1), limits_of(1, 1, 1), 3), "ten intervals or more"),
        (lambda: AxisLimits(0.0, 1.0, 1.0), "speed limit 0"),
        (lambda: s_curve(1.0, AxisLimits(1.0, 1.0)).at(ones(1)), "a finite jerk limit"),
        (lambda: s_curve(np.nan, AxisLimits(1.0, 1.0, 1.0)), "a finite distance"),
    ],
)
def test_refuses_in_words(made: object, said: str) -> None:
    assert callable(made)
    with pytest.raises(ParameterError, match=said):
        made()
