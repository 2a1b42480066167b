"""Function generation: planted four-bars are found again from their angles, and all that is found takes the angles."""

import numpy as np
import pytest
from effort import examples
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import fsolve

from ilmek.errors import ParameterError
from ilmek.synthesis.candidate import judge
from ilmek.synthesis.circuit_loops import circuit_loops
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.freudenstein import Generators, function_generators, generators_of
from ilmek.synthesis.function import Function, error_curve, function_of_samples
from ilmek.synthesis.task import PrecisionTask
from ilmek.units import deg

places = st.builds(complex, st.floats(-2, 2), st.floats(-2, 2))
STARTS = {3: (True, True), 4: (True, False), 5: (False, False)}


tasks = st.tuples(
    places, places, st.floats(-3, 3), st.lists(st.floats(0.3, 0.6), min_size=3, max_size=5), st.booleans()
)
Drawn = tuple[complex, complex, float, list[float], bool]


def planted(task: Drawn) -> tuple[FourBar, np.ndarray, np.ndarray]:
    """A four-bar on the ground from 0 to 1, and 3 to 5 pairs of angles of crank and rocker on one branch of it."""
    a, b, start, steps, wide = task
    assume(min(abs(a), abs(b - a), abs(b - 1)) > 0.2)
    assume(abs(FourBar(0j, 1 + 0j, a, b).grashof.ratio - 1) > 0.01)  # a parallelogram is one of a family
    loops = circuit_loops(FourBar(0j, 1 + 0j, a, b))
    assume(loops and loops[0].high - loops[0].low > 0.5)
    u = start + np.cumsum(steps) * (1 + wide) if loops[0].branch else np.cumsum(steps)
    pose = loops[0].at(u)
    first = FourBar(0j, 1 + 0j, complex(pose.a[0]), complex(pose.b[0]))
    return first, np.angle(pose.a), np.angle(pose.rocker)


def solved(crank: np.ndarray, rocker: np.ndarray, swap: bool = False) -> Generators:
    """With the start angles that go with the number of pairs; turns are from a place before the first pair."""
    start, other = float(crank[0]) - 0.1, float(rocker[0]) + 0.2
    say_crank, say_rocker = STARTS[len(crank)][:: -1 if swap else 1]
    turned = (np.angle(np.exp(1j * (angles - at))) for angles, at in ((crank, start), (rocker, other)))
    return function_generators(
        *turned, crank_start=start if say_crank else None, rocker_start=other if say_rocker else None
    )


@examples(60)
@given(tasks, st.booleans())
def test_a_planted_function_generator_is_found_again(task: Drawn, swap: bool) -> None:
    drawn, crank, rocker = planted(task)
    found = solved(crank, rocker, swap)
    assert min(abs(one.a - drawn.a) + abs(one.b - drawn.b) for one in found.four_bars) < 1e-6
    assert len(found.four_bars) + len(found.left_out) in {3: (1,), 4: (1, 2), 5: (1, 2, 3)}[len(crank)]


@settings(max_examples=20)
@given(tasks)
def test_every_generator_found_takes_the_angles(task: Drawn) -> None:
    _, crank, rocker = planted(task)
    for one in solved(crank, rocker).four_bars:
        found = judge(one, PrecisionTask(crank=crank, rocker=rocker))
        assert found.reached
        assert found.angle_error < 1e-6


@pytest.mark.parametrize("seed", [0, 1, 2, 3])
def test_no_generator_is_dropped_that_newton_s_method_finds_from_many_starts(seed: int) -> None:
    """Five pairs are five equations |1 + Z e^{i psi} - W e^{i phi}|^2 = c^2 for five unknowns."""
    random = np.random.default_rng(seed)
    crank, rocker = np.cumsum(random.uniform(0.2, 0.9, (2, 5)), axis=1) - 1.5

    def gaps(x: np.ndarray) -> np.ndarray:
        ends = 1 + complex(x[0], x[1]) * np.exp(1j * rocker) - complex(x[2], x[3]) * np.exp(1j * crank)
        return np.abs(ends) ** 2 - x[4]

    mine = {(round(one.a.real, 5), round(one.b.real, 5)) for one in function_generators(crank, rocker).four_bars}
    theirs = set()
    for _ in range(60):
        x, report, ok, _ = fsolve(gaps, random.normal(0, 2, 5), full_output=True, xtol=1e-13)
        Z, W = complex(x[0], x[1]), complex(x[2], x[3])
        if ok == 1 and np.max(np.abs(report["fvec"])) < 1e-10 and min(abs(Z), abs(W)) > 1e-3:
            a, b = W * np.exp(1j * crank[0]), 1 + Z * np.exp(1j * rocker[0])
            theirs.add((round(a.real, 5), round(b.real, 5)))
    assert theirs <= mine
    assert len(theirs) > 0


def test_three_pairs_are_freudenstein_s_linear_equations() -> None:
    """y = 1/x for x from 1 to 2, crank from 30 to 120 deg, rocker from 240 to 330 deg, at Chebyshev's places."""
    function = Function(lambda x: 1 / x, 1.0, 2.0, 90 * deg, 90 * deg)
    found = generators_of(function, 3, crank_start=30 * deg, rocker_start=240 * deg)
    x = function.nodes(3)
    th2, th4 = 30 * deg + function.crank(x), 240 * deg + function.rocker(x)
    assert np.degrees(th2) == pytest.approx([36.02885683, 75.0, 113.97114317])
    assert np.degrees(th4) == pytest.approx([251.30070965, 300.0, 326.88110853])
    r = np.linalg.solve(np.stack([np.cos(th4), -np.cos(th2), np.ones(3)], axis=1), np.cos(th2 - th4))
    crank, rocker = 1 / r[0], 1 / r[1]
    coupler = np.sqrt(1 + crank**2 + rocker**2 - 2 * crank * rocker * r[2])
    (one,) = found.four_bars
    assert one.lengths == pytest.approx((1, abs(crank), coupler, abs(rocker)))
    assert rocker < 0  # points away from its angle
    assert np.cos(one.rocker_angle - th4[0]) == pytest.approx(-1)


@pytest.mark.parametrize(("points", "starts"), [(3, (0.6, 1.2)), (4, (0.6, None)), (4, (None, 2.1)), (5, (None, None))])
def test_a_function_is_met_at_its_precision_points(points: int, starts: tuple[float | None, float | None]) -> None:
    function = Function(lambda x: np.sqrt(1 + x), 0.0, 3.0, 80 * deg, 60 * deg)
    found = generators_of(function, points, crank_start=starts[0], rocker_start=starts[1], ground=0.2)
    assert found.four_bars
    nodes = function.nodes(points)
    for one in found.four_bars:
        assert one.lengths.ground == pytest.approx(0.2)
        judged = judge(one, function.task(nodes))
        assert judged.angle_error < 1e-9
        curve = error_curve(one, function, float(nodes[0]), samples=601)
        if judged.one_branch and np.isfinite(curve.greatest):
            crossed = np.count_nonzero(np.sign(curve.error[:-1]) * np.sign(curve.error[1:]) < 0)
            assert crossed >= points
            near = np.abs(np.subtract.outer(curve.x, nodes)).argmin(axis=0)
            assert np.max(np.abs(curve.error[near])) < 0.1 * curve.greatest + 1e-9
            assert curve.y_error == pytest.approx(curve.error / (60 * deg))


def test_five_points_without_start_angles_do_better_than_three_with_guessed_ones() -> None:
    function = Function(lambda x: np.sqrt(1 + x), 0.0, 3.0, 80 * deg, 60 * deg)
    best = []
    for points, start in ((3, {"crank_start": 0.6, "rocker_start": 1.2}), (5, {})):
        errors = [
            error_curve(one, function, float(function.nodes(points)[0])).greatest
            for one in generators_of(function, points, **start).four_bars
        ]
        best.append(min(error for error in errors if np.isfinite(error)))
    assert best[1] < 0.05 * best[0]


def test_a_function_may_be_given_by_samples() -> None:
    x = np.linspace(0, 3, 200)
    sampled = function_of_samples(x, np.sqrt(1 + x), 80 * deg, 60 * deg)
    smooth = Function(lambda x: np.sqrt(1 + x), 0.0, 3.0, 80 * deg, 60 * deg)
    one, other = (generators_of(function, 5).four_bars for function in (sampled, smooth))
    assert len(one) == len(other)
    assert one[0].lengths == pytest.approx(other[0].lengths, rel=1e-3)


def test_a_rocker_at_rest_leaves_no_four_bar_and_says_so() -> None:
    found = function_generators(np.array([0, 0.5, 1.0]), np.zeros(3), crank_start=0.3, rocker_start=1.0)
    assert found.four_bars == ()
    assert found.left_out == ("crank or rocker degenerates to a point",)


TURNS = np.array([0.0, 0.4, 0.9, 1.3, 1.5, 1.6])


@pytest.mark.parametrize(
    ("pairs", "starts", "said"),
    [
        (2, {}, "through 2 pairs of angles; 3 with both start angles given.*give at least three"),
        (6, {}, "`function_approximations` fits the whole range"),
        (3, {}, "3 pairs of angles and 0 start angles.*no start angle given: 5 pairs"),
        (4, {"crank_start": 0.1, "rocker_start": 0.2}, "both start angles given: 3 pairs"),
        (5, {"crank_start": 0.1}, "one start angle given: 4 pairs"),
        (4, {"crank_start": 40.0}, "40 deg is 0.698132 rad"),
    ],
)
def test_pairs_and_start_angles_that_do_not_go_together(pairs: int, starts: dict[str, float], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        function_generators(TURNS[:pairs], TURNS[:pairs] ** 2, **starts)


@pytest.mark.parametrize(
    ("crank", "rocker", "said"),
    [
        ([0, 40, 80, 90, 95], [0, 30, 50, 55, 57], "95 deg would be 1.65806"),
        ([0, 0.5, 0.5, 1, 2], [0, 0.2, 0.2, 1, 3], "pairs 2 and 3 are the same"),
        ([0, 0.5, 0.8, 1, 2], [0, 0.5, 0.8, 1, 2], "a family"),
        ([0, 0.5, 0.8], [0, 0.5], "of shapes"),
        ([0, 0.5, np.nan, 1, 2], [0, 0.2, 0.3, 1, 3], "not finite"),
    ],
)
def test_pairs_that_are_no_task(crank: list[float], rocker: list[float], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        function_generators(np.array(crank, dtype=float), np.array(rocker, dtype=float))


@pytest.mark.parametrize(
    ("build", "said"),
    [
        (lambda: Function(np.sin, 0.0, 0.0, 1.0, 1.0), "two finite ends"),
        (lambda: Function(np.sin, 0.0, 1.0, 60.0, 1.0), "60 deg is 1.0472 rad"),
        (lambda: Function(np.cos, -1.0, 1.0, 1.0, 1.0), "two finite values that differ"),
        (lambda: function_of_samples(np.array([0.0, 2.0, 1.0]), np.zeros(3), 1.0, 1.0), "not in order"),
        (lambda: function_of_samples(np.array([0.0]), np.zeros(1), 1.0, 1.0), "two or more pairs"),
        (lambda: Function(lambda x: 1 / np.where(x == 0, np.nan, x), -1.0, 1.0, 1.0, 1.0).task(np.zeros(1)), "x = 0"),
        (lambda: function_generators(TURNS[:5], TURNS[:5] ** 2, ground=0.0), "ground 0 m"),
    ],
)
def test_what_is_no_function(build, said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        build()
