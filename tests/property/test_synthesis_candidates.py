"""Candidates of random four-bars: circuits and branches on which positions were planted are told in every frame."""

import math

import numpy as np
import pytest

from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.circuit_loops import CircuitLoop, circuit_loops
from ilmek.synthesis.filters import defects
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.task import PrecisionTask


def drawn_on(four_bar: FourBar, loops: tuple[CircuitLoop, ...]) -> tuple[int, float]:
    """The circuit on which a four-bar is drawn, and where."""
    for index, loop in enumerate(loops):
        for u in loop.parameters_at(four_bar.crank_angle, 1e-6):
            if abs(loop.at(np.array([u])).b[0] - four_bar.b) < 1e-6:
                return index, float(u)
    raise AssertionError("drawn on none of its circuits")


def task_on(loops: tuple[CircuitLoop, ...], circuits: np.ndarray, u: np.ndarray, timed: bool) -> PrecisionTask:
    """Points, and timing, of configurations."""
    pairs = list(zip(circuits, u, strict=True))
    points = np.array([loops[circuit].at(np.array([at])).tracer[0] for circuit, at in pairs])
    cranks = np.array([float(loops[circuit].crank(np.array([at]))[0]) for circuit, at in pairs])
    return PrecisionTask(points=points, crank=np.angle(np.exp(1j * (cranks - cranks[0]))) if timed else None)


@pytest.mark.parametrize("timed", [False, True], ids=["points", "timed points"])
@pytest.mark.parametrize("planted", ["branch", "circuit", "anywhere"])
def test_where_positions_were_planted_is_where_they_are_told_to_be(planted: str, timed: bool) -> None:
    random = np.random.default_rng(5)
    for _ in range(25):
        four_bar = FourBar(*random.normal(size=10).view(complex))
        loops, count = circuit_loops(four_bar), int(random.integers(3, 8))
        home, start = drawn_on(four_bar, loops)
        circuits = random.integers(len(loops), size=count) if planted == "anywhere" else np.full(count, home)
        u = random.uniform(0, 2 * math.pi, count)
        circuits[0], u[0] = home, start
        if planted == "branch" and not loops[home].branch:
            u = np.where(np.sin(u) * math.sin(start) > 0, u, -u)
        branches = [loops[k].branch or int(math.copysign(1, math.sin(at))) for k, at in zip(circuits, u, strict=True)]
        found = judge(four_bar, task_on(loops, circuits, u, timed))
        assert found.met
        assert found.point_error < 1e-9
        assert found.one_circuit == (len(set(circuits)) == 1)
        assert found.one_branch == (found.one_circuit and len(set(branches)) == 1)
        if timed:
            assert [one.circuit for one in found.positions] == [k + 1 for k in circuits]
            assert [one.branch for one in found.positions] == branches


def judged(four_bar: FourBar, points: np.ndarray) -> Candidate:
    return judge(four_bar, PrecisionTask(points=points))


def test_the_frame_and_the_size_change_nothing_in_the_judgement() -> None:
    random = np.random.default_rng(8)
    for _ in range(20):
        four_bar = FourBar(*random.normal(size=10).view(complex))
        loops = circuit_loops(four_bar)
        home, start = drawn_on(four_bar, loops)
        u = np.append(start, random.uniform(0, 2 * math.pi, 3))
        points = loops[home].at(u).tracer
        one = judged(four_bar, points)
        turn = np.exp(0.7j)
        for other in (
            judged(four_bar.moved(2 - 1j).turned(0.7).scaled(50.0), 50 * turn * (points + 2 - 1j)),
            judged(four_bar.mirrored().scaled(50.0), 50 * points.conj()),
        ):
            assert list(defects(other)) == list(defects(one))
            assert (other.order, other.circuits) == (one.order, one.circuits)
            assert other.transmission == pytest.approx(one.transmission, abs=1e-6)
            assert other.size == pytest.approx(50 * one.size, rel=2e-3)  # looked at in samples
            assert other.link_ratio == pytest.approx(one.link_ratio)


def test_a_linkage_that_stands_in_its_only_pose_gets_nowhere_else_and_says_so() -> None:
    rigid = FourBar(0j, 1 + 0j, 0.4 + 0j, 0.7 + 0j)
    found = judge(rigid, PrecisionTask(crank=np.array([0.0, 0.1]), rocker=np.array([0.0, 0.1])))
    assert found.circuits == 0
    assert defects(found) == {"closes": "does not close at position 1, 2"}
    assert math.isnan(found.least_transmission)
