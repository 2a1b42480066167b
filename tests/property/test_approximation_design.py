"""The design error as a synthesis polynomial: the exact four-bars of the precision points, no better neighbour."""

import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.synthesis.approximation.function_design import design_generators, design_polynomial
from ilmek.synthesis.approximation.function_error import structural_error
from ilmek.synthesis.freudenstein import generators_of
from ilmek.synthesis.function import Function
from ilmek.units import deg

ROOT = Function(lambda x: np.sqrt(1 + x), 0.0, 3.0, 80 * deg, 60 * deg)
STARTS = [{"crank_start": 1.0, "rocker_start": 0.8}, {"crank_start": 1.0}, {"rocker_start": 0.8}, {"rocker_start": 2.0}]


@pytest.mark.parametrize("starts", STARTS)
def test_interpolation_gives_the_four_bars_of_the_precision_points(starts: dict[str, float]) -> None:
    exact = generators_of(ROOT, 5 - len(starts), **starts)
    found = design_generators(ROOT, "interpolation", **starts)
    ours = sorted(sorted(np.abs([1.0, *design.generator.links])) for design in found.found)
    theirs = sorted(sorted(one.lengths) for one in exact.four_bars)
    np.testing.assert_allclose(ours, theirs, rtol=1e-8)
    assert not [words for words in found.left_out if "far" in words]
    assert len(found.found) + 2 * len(found.left_out) == len(exact.four_bars) + 2 * ("2 complex" in found.left_out)


def test_an_answer_without_design_error_at_a_node_has_no_structural_error_there() -> None:
    for design in design_generators(ROOT, "interpolation", crank_start=1.0).found:
        errors = [structural_error(ROOT, design.generator, sense, ROOT.nodes(4)) for sense in (1, -1)]
        assert min(np.max(np.abs(error)) for error in errors) < 1e-9


@pytest.mark.parametrize("starts", STARTS[:2])
def test_each_criterion_is_best_by_its_own_measure(starts: dict[str, float]) -> None:
    squares, greatest = (design_generators(ROOT, name, **starts).found for name in ("least squares", "minimax"))
    assert squares[0].error.rms < greatest[0].error.rms
    assert greatest[0].error.worst < squares[0].error.worst
    assert all(one.error.proven for one in (*squares, *greatest))
    touching = np.abs(greatest[0].error.errors) > greatest[0].error.worst * (1 - 1e-7)
    # Four for three parameters, if 1, cos th2 and cos th4 were a Chebyshev system: they are not, and three are enough.
    assert touching.sum() == {1: 5, 2: 3}[len(starts)]


def test_a_wrong_question_is_answered_in_words() -> None:
    with pytest.raises(ParameterError, match="use `function_approximations`"):
        design_polynomial(ROOT)
    with pytest.raises(ParameterError, match="interpolation, least squares, minimax"):
        design_generators(ROOT, "best", crank_start=1.0)
