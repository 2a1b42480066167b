"""Thinned curves keep their shape; names and flags keep clear of one another."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.viz.flags import flags
from ilmek.viz.labels import LabelRequest, placed
from ilmek.viz.thinning import thinned_curve, thinned_line, thinned_lines

coordinates = st.floats(-100.0, 100.0)


@given(st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=200), st.floats(0.01, 5.0))
def test_a_thinned_line_strays_no_farther_than_its_tolerance(
    pairs: list[tuple[float, float]], tolerance: float
) -> None:
    points = np.array([complex(x, y) for x, y in pairs])
    kept = thinned_line(points, tolerance)
    assert kept[0] == points[0]
    assert kept[-1] == points[-1]
    steps = np.diff(kept)
    for point in points:
        share = np.clip(((point - kept[:-1]) * np.conj(steps)).real / np.maximum(np.abs(steps) ** 2, 1e-300), 0.0, 1.0)
        assert np.abs(kept[:-1] + share * steps - point).min() <= tolerance + 1e-6


@given(
    st.lists(st.lists(st.tuples(coordinates, coordinates), max_size=40), min_size=1, max_size=6), st.floats(0.01, 5.0)
)
def test_lines_together_are_thinned_as_each_alone(lines: list[list[tuple[float, float]]], tolerance: float) -> None:
    """Against the algorithm as its authors state it, by recursion."""
    every = [np.array([complex(x, y) for x, y in line], dtype=complex) for line in lines]
    for line, kept in zip(every, thinned_lines(every, tolerance), strict=True):
        assert kept.tolist() == douglas_peucker(line.tolist(), tolerance)


def douglas_peucker(points: list[complex], tolerance: float) -> list[complex]:
    if len(points) < 3:
        return points
    begin, chord = points[0], points[-1] - points[0]
    away = []
    for point in points[1:-1]:
        off = point - begin
        squared = max(chord.real**2 + chord.imag**2, np.finfo(float).tiny)
        share = min(max((off.real * chord.real + off.imag * chord.imag) / squared, 0.0), 1.0)
        away.append(abs(off - share * chord))
    if max(away) <= tolerance:
        return [points[0], points[-1]]
    cut = 1 + away.index(max(away))
    return [*douglas_peucker(points[: cut + 1], tolerance)[:-1], *douglas_peucker(points[cut:], tolerance)]


@given(st.integers(1, 20_000), st.integers(0, 2**32 - 1))
@settings(max_examples=30)
def test_a_thinned_curve_keeps_ends_peaks_and_order(count: int, seed: int) -> None:
    y = np.random.default_rng(seed).normal(size=count)
    x = np.arange(count, dtype=float)
    thin_x, thin_y = thinned_curve(x, y)
    assert len(thin_x) <= 722
    assert np.all(np.diff(thin_x) > 0)
    assert (thin_x[0], thin_x[-1]) == (0.0, count - 1.0)
    assert (thin_y.min(), thin_y.max()) == (y.min(), y.max())


def test_a_gap_stays_a_gap() -> None:
    y = np.sin(np.linspace(0, 6, 9000))
    y[4000:4100] = np.nan
    thin_x, thin_y = thinned_curve(np.arange(9000.0), y)
    assert np.isnan(thin_y[(thin_x >= 4000) & (thin_x < 4100)]).any()
    assert np.isnan(thinned_line(thin_x + 1j * thin_y).imag).any()


@given(st.lists(st.tuples(st.floats(0.0, 400.0), st.floats(5.0, 120.0)), max_size=9))
def test_no_flag_touches_another(wanted: list[tuple[float, float]]) -> None:
    places, widths = [x for x, _ in wanted], [width for _, width in wanted]
    flown = flags(places, widths, 400.0)
    boxes = [
        (flag.tier, flag.x - width if flag.leftward else flag.x, flag.x if flag.leftward else flag.x + width)
        for flag, width in zip(flown, widths, strict=True)
    ]
    for number, (tier, start, stop) in enumerate(boxes):
        for other_tier, other_start, other_stop in boxes[:number]:
            assert tier != other_tier or stop <= other_start or start >= other_stop


@given(st.lists(st.floats(0.0, 250.0), min_size=2, max_size=9, unique=True))
def test_no_tick_crosses_the_name_of_a_flag_that_flies_right(places: list[float]) -> None:
    flown = flags(places, [60.0] * len(places), 400.0)
    for flag in flown:
        assert not flag.leftward
        assert not [o for o in flown if flag.x < o.x < flag.x + 60.0 and o.tier >= flag.tier]


@given(st.lists(st.tuples(st.floats(60.0, 340.0), st.floats(60.0, 240.0)), min_size=1, max_size=8))
def test_names_lie_on_the_sheet_and_apart(places: list[tuple[float, float]]) -> None:
    wanted = [LabelRequest(np.array([complex(x, y)]), f"name {n}", 8.0) for n, (x, y) in enumerate(places)]
    centres = placed(wanted, np.array([complex(x, y) for x, y in places]), 0j, 400 + 300j)
    for one, centre in zip(wanted, centres, strict=True):
        assert one.half.real <= centre.real <= 400 - one.half.real
        assert one.half.imag <= centre.imag <= 300 - one.half.imag
    if len({(round(x / 80), round(y / 40)) for x, y in places}) == len(places):
        for number, first in enumerate(centres):
            for other, second in enumerate(centres[:number]):
                gap = wanted[number].half + wanted[other].half
                assert abs((first - second).real) >= gap.real or abs((first - second).imag) >= gap.imag
