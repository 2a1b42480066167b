"""The one result of all synthesis: solutions that are mechanisms, and what was left out, with reasons and numbers."""

import numpy as np
import pytest

import ilmek
from ilmek.units import deg, mm

POSES = [0, (25 + 15j) * mm, (30 + 1j) * mm], [10 * deg, 3 * deg, -25 * deg]
ELLIPSE = [100 * mm + (40 * np.cos(u) + 20j * np.sin(u)) * mm for u in range(6)]
FOUND = {
    "path": lambda: ilmek.path_four_bars(ELLIPSE, closed=True, count=2),
    "motion": lambda: ilmek.motion_four_bars(*POSES),
    "function": lambda: ilmek.function_four_bars(lambda x: 1 / x, 1, 2, 90 * deg, -90 * deg),
    "swing": lambda: ilmek.crank_rocker(30 * deg, ground=0.3),
}


@pytest.mark.parametrize("task", FOUND)
def test_every_solution_is_a_mechanism_that_a_simulation_moves(task: str) -> None:
    found = FOUND[task]()
    assert isinstance(found, ilmek.synthesis.Synthesis)
    assert [solution.error for solution in found] == found.table()[f"error [{found.unit}]"].tolist()
    for solution in found:
        drawn = solution.four_bar
        motion = ilmek.solve(solution, drawn.crank_angle).require()
        assert abs(motion["rocker.B"].position[0] - drawn.b) < 1e-9 * abs(drawn.b - drawn.b0)
        assert ilmek.judged(solution).mechanism.name == "four-bar"


def test_errors_are_those_of_a_simulation() -> None:
    path = FOUND["path"]().best
    curve = ilmek.solve(path, np.linspace(0, 2 * np.pi, 100_001))["coupler.P"].position
    assert max(np.abs(curve - point).min() for point in ELLIPSE) < path.error + 1e-5
    motion = FOUND["motion"]().best
    cranks = [met.crank_angle for met in motion.details.positions]
    poses = ilmek.solve(motion, cranks)["coupler.P"].position
    assert np.abs(poses - POSES[0]).max() < motion.error + 1e-12
    swing = np.ptp(ilmek.solve(FOUND["swing"]().best, np.linspace(0, 2 * np.pi, 100_001))["rocker"].angle)
    assert swing == pytest.approx(30 * deg, abs=1e-8)


@pytest.mark.parametrize("task", ["path", "swing"])
def test_transmission_is_the_least_over_the_turn(task: str) -> None:
    solution = FOUND[task]().best
    motion = ilmek.solve(solution, np.linspace(0, 2 * np.pi, 100_001))
    apart = np.exp(1j * (motion["rocker"].angle - motion["coupler"].angle))
    assert np.arccos(np.abs(apart.real).max()) == pytest.approx(solution.transmission, abs=1e-8)


def test_an_empty_result_says_why() -> None:
    none = ilmek.function_four_bars(np.log10, 1, 10, 60 * deg, 90 * deg, criterion="interpolation")
    assert not none
    assert [(entry.reason, entry.count) for entry in none.left_out] == [
        ("a four-bar that does not close over the whole range", 1)
    ]
    with pytest.raises(ilmek.IlmekError, match="does not close over the whole range"):
        _ = none.best


def test_what_is_left_out_is_counted() -> None:
    wide, narrow = ilmek.motion_four_bars(*POSES, transmission_min=30 * deg), ilmek.motion_four_bars(*POSES)
    counts = [{entry.reason: entry.count for entry in found.left_out} for found in (wide, narrow)]
    assert counts[0]["transmission angle too small"] > 0
    assert "transmission angle too small" not in counts[1]
    few = ilmek.motion_four_bars([0, 25 + 15j, 30 + 1j] * np.array(mm), POSES[1], size_max="1mm", loosen=False)
    assert len(few) == 0
    assert few.left_out
