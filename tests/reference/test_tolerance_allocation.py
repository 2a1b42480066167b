"""Tolerances of stacks: allocation of least cost, correlated lengths, against closed forms and 10^6 brute samples."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import norm
from study_targets import ANGLES, FOUR_BAR, FunctionTarget

from ilmek.errors import MechanismError, ParameterError
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.study.order import read_variable
from ilmek.jobs.study.targets import read_target
from ilmek.studies.allocation import allocated, scaled
from ilmek.studies.outcome import Question
from ilmek.studies.recorder import DesignRecorder
from ilmek.studies.samples import correlation_of, sampled
from ilmek.studies.store import StudyFile
from ilmek.studies.tolerance import corners, spread_of, yield_of
from ilmek.studies.variable import NORMAL, TRIANGULAR, UNIFORM, Variable
from ilmek.studies.workers import Workers

HALVES, SIGNS = np.array([0.3, 0.2, 0.1]), np.array([1.0, -1.0, -1.0])
MIDDLES = np.array([10.2, 6.0, 4.0])
BRUTE = 1_000_000


def stack(spread: str = NORMAL) -> tuple[Variable, ...]:
    """Lengths a, b, c of a chain whose gap a - b - c is 0.2 at their middles."""
    rows = zip("abc", MIDDLES, HALVES, strict=True)
    return tuple(Variable(n, "mm", m - h, m + h, m, spread=spread) for n, m, h in rows)


def test_one_limit_has_the_tolerances_of_the_closed_form() -> None:
    """Gap >= 0: s_i^3 proportional to c_i / (g_i sigma_i)^2, all scaled until the gap is z deviations."""
    variables, costs = stack(), {"a": 1.0, "b": 3.0, "c": 0.5}
    points = sampled(variables, "sobol", 4096, 0)
    found = allocated(variables, points, (points @ SIGNS)[:, None], 0.99, costs)
    sigma = HALVES / 3
    ratios = (np.array([1.0, 3.0, 0.5]) / sigma**2) ** (1 / 3)
    exact = ratios * 0.2 / (norm.ppf(0.99) * math.sqrt(np.sum((ratios * sigma) ** 2)))
    assert list(found.factors.values()) == pytest.approx(exact, rel=2e-3)
    assert found.expected == pytest.approx(0.99, abs=1e-6)
    assert found.cost == pytest.approx(float(np.array([1.0, 3.0, 0.5]) @ (1 / exact)) / 4.5, rel=1e-3)
    lengths = np.random.default_rng(1).normal(MIDDLES, sigma * list(found.factors.values()), (BRUTE, 3))
    assert np.mean(lengths @ SIGNS >= 0) == pytest.approx(0.99, abs=5e-4)
    assert found.explained == pytest.approx(1.0)


def test_two_limits_keep_their_yield_and_no_cheaper_ones_do() -> None:
    """Gap from 0 to 0.35, lengths uniformly distributed; the cheapest of 2,000 other allocations costs more."""
    variables = stack(UNIFORM)
    points = sampled(variables, "sobol", 8192, 0)
    gap = points @ SIGNS
    found = allocated(variables, points, np.column_stack([gap, 0.35 - gap]), 0.95, {})
    factors = np.array(list(found.factors.values()))
    assert found.expected == pytest.approx(0.95, abs=1e-6)
    rng = np.random.default_rng(2)
    unit = rng.uniform(-1, 1, (BRUTE, 3)) * HALVES

    def brute(s: np.ndarray, count: int = BRUTE) -> float:
        gaps = 0.2 + (unit[:count] * s) @ SIGNS
        return float(np.mean((gaps >= 0) & (gaps <= 0.35)))

    assert brute(factors) >= 0.95 - 0.01  # three uniform lengths are nearly normal
    for other in factors * np.exp(rng.normal(0, 0.3, (500, 3))):
        if np.sum(1 / other) < 0.97 * np.sum(1 / factors):
            assert brute(other, 50_000) < brute(factors) + 0.005


def test_correlated_lengths_have_the_deviation_of_the_closed_form() -> None:
    """Var(a - b - c) with corr(a, b) = 0.8: the worst of correlation, and the best, is in its sign."""
    variables = stack()
    correlation = correlation_of(variables, {("a", "b"): 0.8})
    points = sampled(variables, "sobol", 8192, 0, correlation)
    sigma = HALVES / 3
    variance = np.sum(sigma**2) - 2 * 0.8 * sigma[0] * sigma[1]
    assert np.std(points @ SIGNS) == pytest.approx(math.sqrt(variance), rel=5e-3)
    assert np.corrcoef(points[:, 0], points[:, 1])[0, 1] == pytest.approx(0.8, abs=5e-3)
    found = allocated(variables, points, (points @ SIGNS)[:, None], 0.999, {}, correlation)
    new = scaled(variables, found.factors)
    lengths = sampled(new, "latin", BRUTE, 5, correlation)
    assert np.mean(lengths @ SIGNS >= 0) == pytest.approx(0.999, abs=2e-4)


@pytest.mark.parametrize("spread", [UNIFORM, NORMAL, TRIANGULAR])
def test_deviations_are_those_of_brute_samples(spread: str) -> None:
    variable = Variable("x", "mm", 1.0, 2.0, 1.2, spread=spread)
    shares = (np.arange(BRUTE) + 0.5) / BRUTE
    assert variable.deviation == pytest.approx(float(np.std(variable.at(shares))), rel=1e-3)


def test_what_no_tolerance_cures_is_an_error() -> None:
    variables = stack()
    points = sampled(variables, "sobol", 256, 0)
    with pytest.raises(ParameterError, match="fails at the middle"):
        allocated(variables, points, (points @ SIGNS - 1.0)[:, None], 0.9, {})
    with pytest.raises(ParameterError, match="no check depends"):
        allocated(variables, points, np.ones((256, 1)), 0.9, {})
    with pytest.raises(ParameterError, match="contradict"):
        correlation_of(variables, {("a", "b"): 0.9, ("b", "c"): 0.9, ("a", "c"): -0.9})
    with pytest.raises(ParameterError, match="does not vary"):
        correlation_of(variables, {("a", "d"): 0.9})


def test_play_of_a_pin_is_a_longer_link(tmp_path: Path) -> None:
    """The journal at the far side of its hole: least transmission angle of a four-bar with a longer rocker.

    cos mu = (b^2 + c^2 - d^2) / 2 b c at the distances d = ground -+ crank of the pins      [Norton, 4.10]
    """
    path = tmp_path / "four_bar.toml"
    path.write_text(FOUR_BAR)
    target = read_target(str(path), {}, MotionRequest({}, "", "", steps=360))

    def least(rocker: float) -> float:
        angles = [math.acos((0.2**2 + rocker**2 - d**2) / (2 * 0.2 * rocker)) for d in (0.24, 0.36)]
        return min(min(angle, math.pi - angle) for angle in angles)

    def computed(clearance: float, side: float) -> float:
        return target.numbers({"clearance.B": clearance, "side.B": side}).results["transmission_angle_min.B"]

    assert computed(0.0, 1.0) == pytest.approx(least(0.23), abs=1e-12)
    assert computed(0.002, math.pi) == pytest.approx(least(0.232), abs=1e-12)  # the rocker's x points from B to B0
    assert computed(0.002, 0.0) == pytest.approx(least(0.228), abs=1e-12)
    assert computed(0.002, math.pi / 2) == pytest.approx(least(math.hypot(0.23, 0.002)), abs=1e-12)
    with pytest.raises(MechanismError, match="has no joint 'Q'"):
        target.parameter("clearance.Q")
    with pytest.raises(ParameterError, match=r"clearance.B.*at least 0"):
        read_variable(target, "clearance.B", "-1mm..1mm")


def test_the_thesis_dyad_under_a_twentieth_of_a_millimetre(tmp_path: Path) -> None:
    """Links and pivot of the knotting dyad of 17.6 mm and 19.7 mm, +-0.05 mm each, against 10^6 brute samples."""
    half = 0.05e-3
    names = ("first", "second", "pivot x", "pivot y")
    variables = tuple(Variable(name, "mm", -half, half, 0.0, spread=NORMAL) for name in names)
    with (
        StudyFile(tmp_path / "s.sqlite", {}, names, ("error",)) as file,
        Workers(Question(FunctionTarget("dyad"), ("error",))) as workers,
    ):
        recorder = DesignRecorder(file, variables, workers, 1)
        drawn, ends = recorder(sampled(variables, "sobol", 8192, 0)), recorder(corners(variables))
    found = spread_of("error", variables, drawn.points, drawn.results[:, 0], ends.results[:, 0])
    errors = np.random.default_rng(3).normal(0.0, half / 3, (BRUTE, 4))
    turned = np.exp(1j * np.array(ANGLES))
    moved = errors[:, :1] * turned[0] + errors[:, 1:2] * turned[1] + (errors[:, 2] + 1j * errors[:, 3])[:, None]
    brute = np.abs(moved).max(axis=1)
    assert found.mean == pytest.approx(float(brute.mean()), rel=5e-3)
    assert found.deviation == pytest.approx(float(brute.std()), rel=1e-2)
    assert found.high == pytest.approx(float(np.quantile(brute, 0.99865)), rel=3e-2)
    assert found.worst_high >= brute[(np.abs(errors) <= half).all(axis=1)].max()
    share = yield_of(drawn.feasible)
    assert share.low <= np.mean(brute <= 0.08e-3) <= share.high
