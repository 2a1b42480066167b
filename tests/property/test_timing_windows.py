"""Windows and crossings: sets on the circle against sampling, edges against the curves themselves."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.cams.laws import LAWS
from ilmek.timing.crossings import crossing_shares, turning_shares, zone_windows
from ilmek.timing.cyclogram import Track, TrackSegment
from ilmek.timing.interference import distance_from, in_region, windows_where
from ilmek.timing.track import joints, sample
from ilmek.timing.windows import Window, Windows, common, separation, windows_of
from ilmek.units import deg, turn

spans = st.lists(st.tuples(st.floats(0, 6.28), st.floats(0.01, 6.0)).map(lambda s: (s[0], s[0] + s[1])), max_size=4)
# Rises whose displacement starts and ends steeply enough for the edge to be told by the position.
RISING = [law for law in LAWS.values() if law.velocity_peak < 3]


def holds(windows: Windows, angle: np.ndarray) -> np.ndarray:
    """Whether angles in the turn are in one of the windows."""
    found = np.zeros(angle.shape, dtype=bool)
    for one in windows:
        found |= ((angle - one.start) % turn) < one.length
    return found


def total(windows: Windows) -> float:
    return sum(one.length for one in windows)


@given(a=spans, b=spans)
def test_sets_of_windows_are_sets(a, b) -> None:
    one, two = windows_of(a), windows_of(b)
    angle = np.random.default_rng(1).uniform(0, turn, 400)
    inside, other = holds(one, angle), holds(two, angle)
    assert np.array_equal(holds(common(one, two), angle), inside & other)
    assert np.array_equal(holds(windows_of([*a, *b]), angle), inside | other)
    starts = [window.start for window in one]
    assert starts == sorted(starts)


@given(a=spans, turns=st.integers(-3, 3))
def test_spans_of_another_turn_are_the_same_windows(a, turns) -> None:
    moved = windows_of((start + turns * turn, end + turns * turn) for start, end in a)
    angle = np.random.default_rng(2).uniform(0, turn, 400)
    assert np.array_equal(holds(moved, angle), holds(windows_of(a), angle))
    assert total(moved) == pytest.approx(total(windows_of(a)))
    assert all(0 <= one.start < turn for one in moved)


@given(a=spans, b=spans)
def test_separation_is_negative_exactly_where_both_hold(a, b) -> None:
    one, two = windows_of(a), windows_of(b)
    apart = separation(one, two)
    assert apart == pytest.approx(separation(two, one), abs=1e-12)
    assert (apart < -1e-9) <= bool(common(one, two))
    assert (apart > 1e-9) <= (not common(one, two))


def test_a_law_turns_where_its_speed_changes_sign_and_not_where_it_only_stands() -> None:
    def turning(*roots: float) -> list[float]:
        return turning_shares(
            replace(LAWS["3-4-5"], v=lambda u: (u * (1 - u)) ** 2 * np.prod([u - r for r in roots], 0))
        ).tolist()

    assert turning_shares(LAWS["3-4-5"]).tolist() == [0.0, 1.0]
    assert turning(0.5, 0.5) == [0.0, 1.0]
    assert turning(0.25, 0.5, 0.7123) == pytest.approx([0.0, 0.25, 0.5, 0.7123, 1.0], abs=1e-12)


def test_separation_is_the_way_out_of_one_another() -> None:
    long, inner = (Window(1.0, 5.0),), (Window(2.0, 3.0),)
    assert separation(long, inner) == pytest.approx(-2.0)  # back to where the long one starts
    assert separation((Window(1.0, 3.0),), (Window(2.5, 4.0),)) == pytest.approx(-0.5)
    assert separation((Window(6.0, 6.5),), (Window(0.5, 1.0),)) == pytest.approx(0.5 + turn - 6.5)
    assert separation((), inner) == turn


@settings(max_examples=30)
@given(law=st.sampled_from(RISING), share=st.floats(0.02, 0.98), begin=st.floats(-1, 1), stroke=st.floats(0.05, 2))
def test_a_crossing_is_where_the_position_is(law, share, begin, stroke) -> None:
    motion = TrackSegment("go", 0.3, 1.9, begin, begin + stroke, law)
    position = begin + stroke * float(law.s(share))
    found = crossing_shares(motion, position)
    assert found
    for u in found:
        assert begin + stroke * float(law.s(u)) == pytest.approx(position, abs=1e-13)
    assert min(abs(u - share) for u in found) < 1e-6


def there_and_back(start: float, way: float, back: float) -> Track:
    """Out in `way`, a rest of 0.5, home in `back` [rad], modified-sine over 80 mm, maybe through the turn."""
    law = LAWS["modified-sine"]
    out = TrackSegment("out", start, start + way, 0.0, 0.08, law)
    return Track("carriage", "belt", (out, TrackSegment("home", out.end + 0.5, out.end + 0.5 + back, 0.08, 0.0, law)))


@settings(max_examples=20)
@given(
    start=st.floats(0.0, 4.0), way=st.floats(0.2, 1.0), back=st.floats(0.2, 1.0),
    low=st.floats(0.001, 0.04), width=st.floats(0.005, 0.06),
)  # fmt: skip
def test_zone_windows_agree_with_sampling(start, way, back, low, width) -> None:
    track = there_and_back(start, way, back)
    angle = np.linspace(0, turn, 3001)[:-1]
    position = sample(track, angle).position
    windows = zone_windows(track, low, low + width)
    clear = (np.abs(position - low) > 1e-6) & (np.abs(position - low - width) > 1e-6)
    inside = (position > low) & (position < low + width)
    assert np.array_equal(holds(windows, angle)[clear], inside[clear])
    edges = np.array([edge for one in windows for edge in (one.start, one.end)]) % turn
    off = np.abs(sample(track, edges).position[:, None] - [low, low + width]).min(axis=1)
    assert np.all(off < 1e-13)


def test_zones_at_rest_begin_and_end_with_the_motion() -> None:
    track = there_and_back(1.0, 1.0, 1.0)
    assert zone_windows(track, 0.0, math.inf) == (Window(1.0, 3.5),)  # out of its home
    (home,) = zone_windows(track, -math.inf, 0.08)  # not at the far end
    assert (home.start, home.end) == pytest.approx((2.5, 2.0 + turn))
    assert zone_windows(track, -1.0, 1.0) == (Window(0.0, turn),)
    assert zone_windows(track, 0.08, 1.0) == ()


@settings(max_examples=8)
@given(start=st.floats(0.0, 4.0), low=st.floats(0.001, 0.07))
def test_windows_of_a_margin_are_the_exact_ones(start, low) -> None:
    track = there_and_back(start, 0.8, 1.1)
    exact = zone_windows(track, low, math.inf)
    found = windows_where(lambda angle: low - sample(track, angle % turn).position, joints(track))
    assert [edge for one in found for edge in (one.start, one.end)] == pytest.approx(
        [edge for one in exact for edge in (one.start, one.end)], abs=1e-12
    )


@pytest.mark.parametrize("depth", [1e-3, 1e-6, 1e-9])
def test_a_dip_between_two_places_of_the_grid_is_found(depth: float) -> None:
    middle = 100.3 * deg
    (window,) = windows_where(lambda angle: 1 - depth - np.cos(angle - middle))
    half = math.acos(1 - depth)
    assert (window.start, window.end) == pytest.approx((middle - half, middle + half), rel=1e-7)


def test_a_point_on_a_circle_is_in_a_box_as_trigonometry_says() -> None:
    box = np.array([0.5 - 2j, 2 - 2j, 2 + 2j, 0.5 + 2j])
    (window,) = windows_where(in_region(lambda angle: np.exp(1j * angle), box))
    assert (window.start, window.end) == pytest.approx((turn - math.pi / 3, turn + math.pi / 3), abs=1e-14)
    (wide,) = windows_where(in_region(lambda angle: np.exp(1j * angle), box, radius=0.5))
    assert (wide.start, wide.end) == pytest.approx((turn - math.pi / 2, turn + math.pi / 2), abs=1e-14)


@given(x=st.floats(-3, 3), y=st.floats(-3, 3))
def test_distance_from_a_square(x, y) -> None:
    square = np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
    out = math.hypot(max(abs(x) - 1, 0), max(abs(y) - 1, 0))
    expected = out or max(abs(x), abs(y)) - 1
    for corners in (square, square[::-1]):
        assert float(distance_from(np.array([x + 1j * y]), corners)[0]) == pytest.approx(expected, abs=1e-15)
