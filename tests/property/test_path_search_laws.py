"""Laws of the search for paths: slopes, limits, planted mechanisms, moves, seeds."""

import math

import numpy as np
import pytest
from effort import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.synthesis.path.confidence import probability_missed
from ilmek.synthesis.path.extent import extent
from ilmek.synthesis.path.fit import judged
from ilmek.synthesis.path.limits import LIMITS, excess, limit_rows
from ilmek.synthesis.path.links import random_links
from ilmek.synthesis.path.model import SIZE, coupler_point, with_slopes
from ilmek.synthesis.path.search import path_four_bars
from ilmek.synthesis.path.task import PathTask

TURN = 2 * math.pi
PLANTED = np.array([2.0, 0.7, 1.9, 1.6, 1.1, 0.8, 0.3, -0.2, 0.4, 0.0])


def drawn(design, count, part=1.0, branch=+1):
    angles = part * TURN * np.arange(count) / count
    return np.array([coupler_point(design, float(angle), branch) for angle in angles])


def oval(count):
    turn = TURN * np.arange(count) / count
    return 0.3 * np.cos(turn) + 0.1j * np.sin(turn)


@given(st.integers(0, 2**32 - 1), st.sampled_from([+1, -1]), st.sampled_from([+1, -1]))
@examples(60)
def test_slopes_are_differences(seed, kind, branch):
    rng = np.random.default_rng(seed)
    bounds = np.full(4, 1e-3), np.full(4, 10.0)
    design = np.r_[random_links(rng, 1, bounds, kind=kind, kappa=math.cos(0.3))[0], rng.normal(size=6)]
    angle, slopes, by = float(rng.uniform(0, TURN)), np.empty(SIZE, dtype=complex), 1e-6
    assert with_slopes(design, angle, branch, slopes) == pytest.approx(coupler_point(design, angle, branch), abs=1e-12)
    for place in range(SIZE - 1):
        ends = [design + sign * by * np.eye(SIZE)[place] for sign in (+1, -1)]
        difference = np.subtract(*(coupler_point(end, angle, branch) for end in ends)) / (2 * by)
        assert slopes[place] == pytest.approx(difference, abs=1e-5 * max(1.0, abs(slopes).max()))
    difference = (coupler_point(design, angle + by, branch) - coupler_point(design, angle - by, branch)) / (2 * by)
    assert slopes[-1] == pytest.approx(difference, abs=1e-5 * max(1.0, abs(slopes).max()))


@given(st.integers(0, 2**32 - 1), st.sampled_from([+1, -1]), st.floats(0.0, 1.2))
@settings(max_examples=40, deadline=None)
def test_random_links_keep_the_limits_of_the_crank(seed, kind, least):
    rng = np.random.default_rng(seed)
    for links in random_links(rng, 20, (np.full(4, 1e-6), np.full(4, 1e6)), kind=kind, kappa=math.cos(least)):
        ground, crank, coupler, rocker = links
        assert excess(np.r_[links, np.zeros(6)], kind, math.cos(least)) <= 1e-12
        for reach in (ground - crank, ground + crank):
            mu = math.acos((coupler**2 + rocker**2 - reach**2) / (2 * coupler * rocker))
            assert least - 1e-6 <= mu <= math.pi - least + 1e-6
        assert (crank < ground) == (kind > 0)


def spanned(links, kind, least):
    """What is left of the limits of the crank: rocker and coupler span what the crank needs at its dead centres."""
    ground, crank, coupler, rocker = links
    near, far = (abs(coupler - rocker * np.exp(1j * angle)) for angle in (least, math.pi - least))
    return kind * (ground - crank) - near, far - ground - crank


@given(st.integers(0, 2**32 - 1), st.sampled_from([+1, -1]), st.floats(0.05, 1.2))
@settings(max_examples=40, deadline=None)
def test_limits_of_a_step_are_the_tangents_of_the_limits_of_the_links(seed, kind, least):
    rng, kappa = np.random.default_rng(seed), math.cos(least)
    links = random_links(rng, 1, (np.full(4, 1e-3), np.full(4, 10.0)), kind=kind, kappa=kappa)[0]
    design, low, high = np.r_[links, rng.normal(size=6)], np.full(SIZE, -20.0), np.full(SIZE, 30.0)
    rows, slack, step = np.empty((LIMITS, SIZE)), np.empty(LIMITS), 1e-5 * rng.normal(size=SIZE)
    limit_rows(design, low, high, kind, kappa, math.inf, rows, slack)
    left = slack - rows @ step
    moved = design + step
    assert left[: 2 * SIZE : 2] == pytest.approx(high - moved)
    assert left[1 : 2 * SIZE : 2] == pytest.approx(moved - low)
    curved = np.abs(step).max() ** 2 / links.min()
    assert left[[-3, -1]] == pytest.approx(spanned(moved[:4], kind, least), abs=1e-9 + 40 * curved)
    assert left[-2] == math.inf


@given(st.integers(0, 2**32 - 1), st.sampled_from([+1, -1]))
@settings(max_examples=40, deadline=None)
def test_without_a_transmission_angle_the_limits_of_a_step_are_those_of_grashof(seed, kind):
    rng = np.random.default_rng(seed)
    links = random_links(rng, 1, (np.full(4, 1e-3), np.full(4, 10.0)), kind=kind, kappa=1.0)[0]
    design, low, high = np.r_[links, rng.normal(size=6)], np.full(SIZE, -20.0), np.full(SIZE, 30.0)
    rows, slack, step = np.empty((LIMITS, SIZE)), np.empty(LIMITS), 1e-5 * rng.normal(size=SIZE)
    limit_rows(design, low, high, kind, 1.0, math.inf, rows, slack)
    ground, crank, coupler, rocker = (design + step)[:4]
    near = [kind * (ground - crank) - sign * (coupler - rocker) for sign in (+1, -1)]
    assert (slack - rows @ step)[-3:] == pytest.approx([*near, coupler + rocker - ground - crank], abs=1e-9)


@given(st.integers(0, 2**32 - 1), st.sampled_from([+1, -1]))
@settings(max_examples=30, deadline=None)
def test_slopes_of_the_size_are_differences(seed, branch):
    rng, by = np.random.default_rng(seed), 1e-7
    bounds = np.full(4, 1e-3), np.full(4, 10.0)
    design = np.r_[random_links(rng, 1, bounds, kind=+1, kappa=math.cos(0.3))[0], rng.normal(size=6)]
    slopes, unused = np.empty(SIZE), np.empty(SIZE)
    size = extent(design, branch, slopes)
    step = by * rng.normal(size=SIZE)
    ahead, behind = (extent(design + sign * step, branch, unused) for sign in (+1, -1))
    if abs(ahead + behind - 2 * size) < 1e-11:  # else another pair of points is the farthest
        assert (ahead - behind) / 2 == pytest.approx(float(slopes @ step), abs=1e-12)


def test_the_ratio_of_links_and_the_size_are_kept_by_the_search():
    task = PathTask(oval(8), closed=True, link_ratio=3.0, size_max=0.85)
    fits = path_four_bars(task, starts=24)
    seen = [judged(task, fit) for fit in fits]
    assert all(one.link_ratio <= 3.0 + 1e-9 for one in seen)
    assert all(one.size <= 0.85 for one in seen)
    assert any("size at its limit" in limit for fit in fits for limit in fit.active)


def test_starts_are_made_exactly_so_many_and_runs_agree():
    fits = path_four_bars(PathTask(oval(9), timing=TURN * np.arange(9) / 9, closed=True), starts=200)
    search = fits[0].search
    assert (search.starts, search.runs) == (200, 2)
    assert 0 <= search.runs_agreed <= 2
    assert search.missed == probability_missed(2, search.runs_agreed)
    exact = path_four_bars(PathTask(drawn(PLANTED, 6, 0.5)), starts=200)[0].search
    assert (exact.starts, exact.missed) == (200, 0.0)


@pytest.mark.parametrize(("count", "part"), [(7, 0.5), (12, 1.0), (60, 1.0)])
def test_a_planted_four_bar_is_found_again(count, part):
    fit = path_four_bars(PathTask(drawn(PLANTED, count, part), closed=part == 1.0), starts=96)[0]
    assert fit.greatest_error < 1e-6


def test_what_is_found_is_what_the_linkage_does_and_candidate_finds_no_defect():
    task = PathTask(oval(16), closed=True, transmission=math.radians(45))
    for fit in path_four_bars(task, starts=96):
        motion = solve(plan(fit.four_bar.mechanism()), fit.crank_angles)
        np.testing.assert_allclose(motion.point("coupler", "P").position - task.points, fit.errors, atol=1e-12)
        seen = judged(task, fit)
        assert seen.reached
        assert seen.crank_turns
        assert seen.one_circuit
        assert seen.one_branch
        assert seen.in_order
        least = min(seen.transmission[0], math.pi - seen.transmission[1])
        assert fit.least_transmission == pytest.approx(least, abs=1e-9)
        assert fit.least_transmission >= task.transmission - 1e-9


def test_a_limit_that_holds_is_named_and_kept():
    free = path_four_bars(PathTask(oval(12), closed=True), starts=96)[0]
    least = free.least_transmission + math.radians(8)
    held = path_four_bars(PathTask(oval(12), closed=True, transmission=least), starts=96)[0]
    assert held.least_transmission == pytest.approx(least, abs=1e-6)
    assert any("transmission angle at its limit" in word for word in held.active)
    assert held.squared_error > free.squared_error


def test_bounds_hold_and_fixed_numbers_stay():
    bounds = {"ground": (0.5, 0.5), "x": (-0.5, -0.5), "y": (0.1, 0.1), "along": (-0.2, 0.3), "rocker": (0.1, 0.4)}
    fit = path_four_bars(PathTask(oval(10), closed=True, bounds=bounds), starts=96)[0]
    for name, (low, high) in bounds.items():
        assert low - 1e-9 <= fit.design[name] <= high + 1e-9
    assert fit.four_bar.a0 == pytest.approx(-0.5 + 0.1j)


def test_points_against_the_order_share_an_angle():
    points = drawn(PLANTED, 10, 0.6)
    points[[4, 5]] = points[[5, 4]]
    ordered, free = (path_four_bars(PathTask(points, ordered=ordered), starts=96)[0] for ordered in (True, False))
    steps = np.diff(ordered.crank_angles)
    assert (steps >= -1e-6).all() or (steps <= 1e-6).all()
    assert ordered.squared_error > free.squared_error
    assert any("met at one crank angle" in word for word in ordered.active)


def test_the_seed_decides_and_the_threads_do_not():
    task = PathTask(oval(9), timing=TURN * np.arange(9) / 9, closed=True)
    one, same = (path_four_bars(task, seed=3, starts=200, threads=threads) for threads in (1, 2))
    assert [fit.design for fit in one] == [fit.design for fit in same]
    assert one[0].search == same[0].search
    assert path_four_bars(task, seed=4, starts=96)[0].design != one[0].design


def test_a_task_moved_turned_and_scaled_has_the_same_answers():
    timing = TURN * np.arange(9) / 9
    task = PathTask(oval(9), timing=timing, closed=True)
    moved = PathTask(40j * task.points + 300, timing=timing, closed=True)
    errors = [path_four_bars(one, starts=96)[0].squared_error for one in (task, moved)]
    assert errors[1] == pytest.approx(1600 * errors[0], rel=1e-6)


def test_double_cranks_have_the_shortest_ground():
    fit = path_four_bars(PathTask(oval(12), closed=True, kind="double-crank", transmission=0.2), starts=96)[0]
    assert fit.four_bar.lengths.ground == min(fit.four_bar.lengths)
    assert fit.four_bar.grashof.kind == "double-crank"


@pytest.mark.parametrize("count", [4, 5, 200])
def test_any_number_of_points_has_an_answer(count):
    rng = np.random.default_rng(count)
    points = np.linspace(0, 1, count) + 0.003 * (rng.normal(size=count) + 1j * rng.normal(size=count))
    fit = path_four_bars(PathTask(points), starts=96)[0]
    assert fit.squared_error <= 3 * count * 0.003**2
