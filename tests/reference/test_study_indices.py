"""Methods of studies against functions whose indices, fronts, optima and yields are known in closed form."""

import math
from pathlib import Path

import numpy as np
import pytest
from study_targets import G_FACTORS, FunctionTarget

from ilmek.arrays import FloatArray
from ilmek.num.pareto import front
from ilmek.studies.fronts import evolve
from ilmek.studies.optimum import optimum
from ilmek.studies.outcome import Question
from ilmek.studies.recorder import DesignRecorder
from ilmek.studies.samples import sampled
from ilmek.studies.sensitivity import local, morris, sobol
from ilmek.studies.store import StudyFile
from ilmek.studies.tolerance import corners, spread_of, yield_of
from ilmek.studies.variable import NORMAL, Variable
from ilmek.studies.workers import Workers


def recorded(
    tmp_path: Path, function: str, variables: tuple[Variable, ...], results: tuple[str, ...]
) -> DesignRecorder:
    """A recorder of a function's designs."""
    file = StudyFile(tmp_path / "s.sqlite", {}, [v.name for v in variables], results)
    return DesignRecorder(file, variables, Workers(Question(FunctionTarget(function), results)), 1)


def ranges(number: int, low: float, high: float) -> tuple[Variable, ...]:
    """So many variables over the same range."""
    return tuple(Variable(f"x{n}", "", low, high, (low + high) / 2) for n in range(number))


def test_indices_of_ishigami(tmp_path: Path) -> None:
    """Saltelli et al., Sensitivity Analysis (2008): variances by a = 7, b = 0.1."""
    variables = ranges(3, -math.pi, math.pi)
    recorder = recorded(tmp_path, "ishigami", variables, ("f",))
    found = sobol(variables, ("f",), lambda x: recorder(x).results, 5 * 1024, seed=1)
    first = 0.5 * (1 + 0.1 * math.pi**4 / 5) ** 2
    interaction = 0.01 * math.pi**8 * (1 / 18 - 1 / 50)
    whole = first + 49 / 8 + interaction
    expected = {
        ("x0", "first order"): first / whole,
        ("x1", "first order"): 49 / 8 / whole,
        ("x2", "first order"): 0.0,
        ("x0", "total"): (first + interaction) / whole,
        ("x1", "total"): 49 / 8 / whole,
        ("x2", "total"): interaction / whole,
    }
    for one in found:
        assert one.value == pytest.approx(expected[one.variable, one.measure], abs=max(1.5 * one.interval, 0.02))


def test_indices_of_the_g_function(tmp_path: Path) -> None:
    variables = ranges(4, 0.0, 1.0)
    recorder = recorded(tmp_path, "sobol_g", variables, ("f",))
    parts = [1 / 3 / (1 + a) ** 2 for a in G_FACTORS]
    whole = math.prod(1 + part for part in parts) - 1
    found = sobol(variables, ("f",), lambda x: recorder(x).results, 6 * 1024, seed=1)
    for one, part in zip([s for s in found if s.measure == "first order"], parts, strict=True):
        assert one.value == pytest.approx(part / whole, abs=max(1.5 * one.interval, 0.02))


def test_elementary_effects_rank_the_g_function(tmp_path: Path) -> None:
    variables = ranges(4, 0.0, 1.0)
    recorder = recorded(tmp_path, "sobol_g", variables, ("f",))
    found = morris(variables, ("f",), lambda x: recorder(x).results, 400, seed=1)
    means = [one.value for one in found if one.measure == "mean |effect|"]
    assert means == sorted(means, reverse=True)


def test_derivatives_of_ishigami(tmp_path: Path) -> None:
    variables = tuple(Variable(f"x{n}", "", -math.pi, math.pi, x) for n, x in enumerate((0.3, 0.7, -1.1)))
    recorder = recorded(tmp_path, "ishigami", variables, ("f",))
    found = local(variables, ("f",), lambda x: recorder(x).results)
    exact = (math.cos(0.3) * (1 + 0.1 * 1.1**4), 7 * math.sin(1.4), 0.4 * -(1.1**3) * math.sin(0.3))
    assert [one.value for one in found] == pytest.approx(exact, rel=1e-9)
    assert all(abs(one.value - e) <= one.interval + 1e-9 for one, e in zip(found, exact, strict=True))


def test_yield_and_contributions_of_a_stack(tmp_path: Path) -> None:
    """Gap of normal lengths: standard deviation and yield in closed form, contributions as the variances."""
    halves = (0.3, 0.2, 0.1)
    middles = (10.1, 6.0, 4.0)
    variables = tuple(
        Variable(f"x{n}", "", m - h, m + h, m, spread=NORMAL)
        for n, (m, h) in enumerate(zip(middles, halves, strict=True))
    )
    recorder = recorded(tmp_path, "stack", variables, ("gap",))
    drawn = recorder(sampled(variables, "sobol", 4096, 0))
    ends = recorder(corners(variables))
    spread = spread_of("gap", variables, drawn.points, drawn.results[:, 0], ends.results[:, 0])
    sigma = math.sqrt(sum((h / 3) ** 2 for h in halves))
    assert spread.deviation == pytest.approx(sigma, rel=5e-3)
    assert (spread.worst_low, spread.worst_high) == pytest.approx((0.1 - sum(halves), 0.1 + sum(halves)))
    shares = [h**2 / sum(k**2 for k in halves) for h in halves]
    assert list(spread.contributions.values()) == pytest.approx(shares, abs=0.01)
    assert spread.explained == pytest.approx(1.0, abs=1e-6)
    exact = 0.5 * (1 + math.erf(0.1 / sigma / math.sqrt(2)))
    found = yield_of(drawn.feasible)
    assert found.low <= exact <= found.high
    assert found.value == pytest.approx(exact, abs=5e-3)


def test_front_of_zdt1_by_its_hypervolume(tmp_path: Path) -> None:
    variables = ranges(4, 0.0, 1.0)
    recorder = recorded(tmp_path, "zdt1", variables, ("f", "g"))

    def judge(points: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        return recorder(points).results, np.full((len(points), 1), np.nan)

    evolve(variables, 2, judge, 6400, seed=1)
    costs = recorder.file.designs().results
    best = costs[front(costs)]
    best = best[np.argsort(best[:, 0])]
    edges = np.append(best[:, 0], 1.1)
    volume = float(((1.1 - best[:, 1]).clip(0) * np.diff(edges).clip(0)).sum())
    exact = 1.1 - 1 / 3 + 0.1 * 1.1  # between the front, whose integral is 1/3, and the point (1.1, 1.1)
    assert volume == pytest.approx(exact, rel=0.01)
    assert volume <= exact + 1e-9


def volume_below(costs: np.ndarray, corner: np.ndarray) -> float:
    """Hypervolume between a front and a corner, by 2 * 10^5 brute samples of the box."""
    samples = np.random.default_rng(0).uniform(0.0, corner, (200_000, len(corner)))
    dominated = np.zeros(len(samples), dtype=bool)
    for cost in costs:
        dominated |= (samples >= cost).all(axis=1)
    return float(dominated.mean() * np.prod(corner))


def test_front_of_dtlz2_by_its_hypervolume(tmp_path: Path) -> None:
    """Three goals: no design is inside the sphere, and the volume is near that outside of it, 1.1^3 - pi/6."""
    variables = ranges(4, 0.0, 1.0)
    recorder = recorded(tmp_path, "dtlz2", variables, ("f", "g", "h"))

    def judge(points: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        return recorder(points).results, np.full((len(points), 1), np.nan)

    evolve(variables, 3, judge, 3200, seed=1)
    costs = recorder.file.designs().results
    best = costs[front(costs)]
    assert np.linalg.norm(costs, axis=1).min() >= 1 - 1e-12
    exact = 1.1**3 - math.pi / 6
    assert exact * 0.95 <= volume_below(best, np.full(3, 1.1)) <= exact * 1.003


def test_front_of_mw1_by_its_hypervolume(tmp_path: Path) -> None:
    """A front that a constraint cuts in pieces, against a dense sample of its line."""
    variables = ranges(3, 0.0, 1.0)
    recorder = recorded(tmp_path, "mw1", variables, ("f", "g"))

    def judge(points: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        first = recorder.evaluations
        rows = recorder(points)
        return rows.results, recorder.file.margins(first, first + len(points))

    evolve(variables, 2, judge, 3200, seed=1)
    rows = recorder.file.designs()
    costs = rows.results[rows.feasible]
    best = costs[front(costs)]
    f = np.linspace(0, 1, 2001)
    line = np.column_stack([f, 1 - 0.85 * f])
    wave = np.sin(2 * np.pi * math.sqrt(2) * (line[:, 1] - line[:, 0])) ** 8
    exact = line[line.sum(axis=1) - 1 - 0.5 * wave <= 0]
    corner = np.array([1.1, 1.1])
    assert volume_below(best, corner) == pytest.approx(volume_below(exact, corner), rel=0.02)
    assert ((best.sum(axis=1) - 1) <= 0.5 + 1e-9).all()


def test_optimum_with_its_multiplier(tmp_path: Path) -> None:
    """Least x + y with x y >= 1: 2 at (1, 1); a limit relaxed by 1 % lowers it by 1 %: df/d(limit) = 1."""
    variables = ranges(2, 0.1, 4.0)
    recorder = recorded(tmp_path, "corner", variables, ("f", "g"))

    def judge(points: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        first = recorder.evaluations
        rows = recorder(points)
        return rows.results[:, 0], recorder.file.margins(first, first + len(points))

    found = optimum(variables, judge, 600, seed=1)
    assert found.point is not None
    assert found.goal == pytest.approx(2.0, rel=1e-4)
    assert found.point.tolist() == pytest.approx([1.0, 1.0], rel=1e-2)
    assert list(found.multipliers.values()) == pytest.approx([1.0], rel=0.02)


def test_the_end_of_a_range_costs_what_its_derivative_is(tmp_path: Path) -> None:
    """Least x + y with x y >= 1 and y >= 2: at (0.5, 2), where df/dy = 1 - 1 / y^2."""
    variables = (Variable("x", "", 0.1, 4.0, 2.0), Variable("y", "mm", 2.0, 4.0, 3.0))
    recorder = recorded(tmp_path, "corner", variables, ("f", "g"))

    def judge(points: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        first = recorder.evaluations
        rows = recorder(points)
        return rows.results[:, 0], recorder.file.margins(first, first + len(points))

    found = optimum(variables, judge, 300, seed=1)
    assert found.goal == pytest.approx(2.5, rel=1e-7)
    assert found.ends == pytest.approx({1: 0.75}, rel=1e-3)


def test_optimum_of_whole_numbers_and_choices(tmp_path: Path) -> None:
    variables = (
        Variable("x", "", 0.0, 9.0, 0.0, whole=True),
        Variable("y", "", 0.0, 2.0, 0.0, choices=(0.0, 0.5, 1.0)),
    )
    recorder = recorded(tmp_path, "whole", variables, ("f",))

    def judge(points: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        rows = recorder(points)
        return rows.results[:, 0], np.full((len(points), 1), np.nan)

    found = optimum(variables, judge, 400, seed=1)
    assert found.point is not None
    assert found.goal == pytest.approx(0.2**2 + 0.2**2)


PUBLISHED = {
    "truss": (((0.05, 1.0, False), (0.05, 1.0, False)), 263.8958434, 1e-6, 1200),
    "spring": (((0.05, 0.2, False), (0.25, 1.3, False), (2.0, 15.0, False)), 0.0126652328, 1e-5, 4000),
    "vessel": (((1, 30, True), (1, 30, True), (10.0, 100.0, False), (10.0, 200.0, False)), 6059.714335, 6e-3, 8000),
    "beam": (((0.1, 2, False), (0.1, 10, False), (0.1, 10, False), (0.1, 2, False)), 1.7248523, 1e-6, 3000),
    "cantilever": (((1.0, 10.0, False),) * 5, 1.33995636, 1e-8, 1000),
    "gears": (((12, 60, True),) * 4, 0.0, 1e-9, 6000),
}
"""Problem -> ranges of its variables (whole or not), its published optimum, tolerance (of 0 absolute), designs."""


@pytest.mark.parametrize("name", PUBLISHED)
def test_published_optima_are_found(tmp_path: Path, name: str) -> None:
    bounds, best, tolerance, count = PUBLISHED[name]
    variables = tuple(
        Variable(f"x{n}", "", low, high, (low + high) // 2 if whole else (low + high) / 2, whole=whole)
        for n, (low, high, whole) in enumerate(bounds)
    )
    recorder = recorded(tmp_path, name, variables, ("f",))

    def judge(points: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        first = recorder.evaluations
        rows = recorder(points)
        return rows.results[:, 0], recorder.file.margins(first, first + len(points))

    found = optimum(variables, judge, count, seed=1)
    assert best * (1 - 1e-6) <= found.goal <= best + tolerance * (best or 1.0)
