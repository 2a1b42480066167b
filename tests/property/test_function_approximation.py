"""Approximate function generation: no neighbour is better, the bound meets the error, the linkage moves as said."""

import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.synthesis.approximation.function_error import StructuralErrors, of_four_bar
from ilmek.synthesis.approximation.function_generator import FunctionApproximation, function_approximations
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.function import Function, error_curve
from ilmek.units import deg

ROOT = Function(lambda x: np.sqrt(1 + x), 0.0, 3.0, 80 * deg, 60 * deg)
LOG = Function(np.log10, 1.0, 2.0, 60 * deg, 90 * deg)


def neighbours(function: Function, best: FunctionApproximation, free: list[bool], size: float) -> np.ndarray:
    """Errors over the range of 300 generators near the best, a row each."""
    sense, one = of_four_bar(best.four_bar, function, best.drawn_at)
    errors = StructuralErrors(function, sense, one.numbers, np.array(free))
    x = np.linspace(function.start, function.stop, 400)
    random = np.random.default_rng(5)
    _, sizes, ways = np.linalg.svd(errors(one.numbers[free], x)[1], full_matrices=False)
    steps = random.normal(size=(300, sum(free))) @ (ways / sizes[:, None]) * size * np.sqrt(len(x))
    return np.stack([errors(one.numbers[free] + step, x)[0] for step in steps])


@pytest.mark.parametrize(
    ("function", "starts"), [(ROOT, {"crank_start": 1.0, "rocker_start": 0.8}), (LOG, {"crank_start": 1.0})]
)
def test_no_neighbour_has_a_smaller_greatest_error_or_mean_square(function: Function, starts: dict[str, float]) -> None:
    free = [True, True, True, "crank_start" not in starts, "rocker_start" not in starts]
    for criterion in ("minimax", "least squares"):
        for best in function_approximations(function, criterion, **starts).found:
            errors = neighbours(function, best, free, 0.05 * best.rms)
            greatest, squares = np.max(np.abs(errors), axis=-1), np.sqrt(np.mean(errors**2, axis=-1))
            assert best.proven
            if criterion == "minimax":
                assert np.min(greatest) > best.greatest * (1 - 1e-3)  # 400 places miss the peaks by this at most
                assert best.bound == pytest.approx(best.greatest, rel=1e-7)
            else:
                assert np.min(squares) > best.rms * (1 - 0.02)  # the sum over even places is not quite the integral


def test_a_minimax_touches_its_greatest_error_in_turns_and_a_weight_shifts_it() -> None:
    best = function_approximations(ROOT, crank_start=1.0).found[0]
    touching = np.abs(best.errors) > best.greatest * (1 - 1e-9)
    assert touching.sum() == 5  # four free numbers
    assert (np.sign(best.errors[touching])[1:] == -np.sign(best.errors[touching])[:-1]).all()
    starts = {"crank_start": 1.0, "rocker_start": 0.8}
    even = function_approximations(ROOT, **starts).found[0]
    weighted = function_approximations(ROOT, weight=lambda x: 1 + x, **starts).found[0]
    sizes = np.abs(weighted.errors) * (1 + weighted.at)
    assert np.sort(sizes)[-4:] == pytest.approx(weighted.worst, rel=1e-8)
    assert weighted.greatest > even.greatest


def test_a_four_bars_own_function_is_met_without_error_and_its_scale_is_the_ground() -> None:
    planted = FourBar(0j, 1 + 0j, 0.45j, 1.3 + 0.8j)
    sense, one = of_four_bar(planted, Function(lambda x: x, 0.0, 1.0, 1.0, 1.0), 0.0)
    x = np.linspace(0, 1.2, 200)
    line = Function(lambda x: x, 0.0, 1.2, 1.2, 1.2)
    shown = StructuralErrors(line, sense, one.numbers, np.ones(5, bool))(one.numbers, x)[0] + x
    drawn = Function(lambda at: np.interp(at, x, shown), 0.0, 1.2, 1.2, float(shown[-1]))
    starts = {"crank_start": planted.crank_angle, "rocker_start": planted.rocker_angle}
    found = function_approximations(drawn, "least squares", ground=0.2, **starts).found[0]
    assert found.four_bar.lengths == pytest.approx([0.2 * length for length in planted.lengths], rel=1e-4)
    assert found.greatest < 1e-5  # of the interpolated table


def test_the_linkage_moves_as_the_closed_form_says() -> None:
    for one in function_approximations(ROOT, "least squares", crank_start=1.0).found:
        assert one.curve.greatest == pytest.approx(one.greatest, rel=1e-3)
        moved = error_curve(one.four_bar, ROOT, one.drawn_at, 37)
        sense, generator = of_four_bar(one.four_bar, ROOT, one.drawn_at)
        errors = StructuralErrors(ROOT, sense, generator.numbers, np.ones(5, bool))
        np.testing.assert_allclose(moved.error, errors(generator.numbers, moved.x)[0], atol=1e-9)


def test_interpolation_is_exact_at_chebyshevs_places() -> None:
    found = function_approximations(ROOT, "interpolation", crank_start=1.0)
    for one in found.found:
        sense, generator = of_four_bar(one.four_bar, ROOT, one.drawn_at)
        errors = StructuralErrors(ROOT, sense, generator.numbers, np.ones(5, bool))
        np.testing.assert_allclose(errors(generator.numbers, ROOT.nodes(4))[0], 0, atol=1e-9)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"criterion": "best"}, "interpolation, least squares, minimax"),
        ({"crank_start": 60.0}, "60 deg is 1.0472 rad"),
        ({"ground": -1.0}, "ground -1 m"),
        ({"weight": lambda x: x - 1}, "above 0 over the whole range"),
    ],
)
def test_a_wrong_question_is_answered_in_words(wrong: dict[str, object], words: str) -> None:
    with pytest.raises(ParameterError, match=words):
        function_approximations(ROOT, **wrong)


def test_what_is_no_four_bar_is_told_in_words() -> None:
    steep = Function(lambda x: x**3, 0.0, 1.0, 60 * deg, 300 * deg)
    starts = {"crank_start": 1.0, "rocker_start": 0.8}
    both = "a four-bar that meets the Chebyshev nodes on two branches"
    assert function_approximations(steep, "interpolation", **starts) == ((), {both: 1})
    answer = function_approximations(steep, "least squares", **starts)
    assert not answer.found
    assert "dead centre" in list(answer.left_out)[-1]
    answer = function_approximations(ROOT, "interpolation", rocker_start=0.8)
    assert "no four-bar passes through" in next(iter(answer.left_out))


@pytest.mark.parametrize(
    "function", [Function(np.sqrt, 4.0, 1.0, -80 * deg, 60 * deg), Function(np.exp, 0, 1e-3, 0.02, 0.02)]
)
def test_turned_round_and_small_ranges_are_ranges(function: Function) -> None:
    best = function_approximations(function, crank_start=1.0).found[0]
    assert best.proven
    assert best.curve.greatest == pytest.approx(best.greatest, rel=1e-3, abs=1e-9)
