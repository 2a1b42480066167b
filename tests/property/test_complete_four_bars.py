"""Complete synthesis finds planted four-bars again, with their cognates; every answer meets its task."""

import numpy as np
import pytest
from effort import number

from ilmek.errors import MechanismError
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.progress import Cancelled, Progress
from ilmek.synthesis.alt_burmester.defects import motion_defect
from ilmek.synthesis.alt_burmester.four_bars import CompleteFourBars, complete_four_bars
from ilmek.synthesis.alt_burmester.task import PosesAndPoints
from ilmek.synthesis.burmester.links import GuideKind, arms_through_five_poses
from ilmek.synthesis.candidate import judge
from ilmek.synthesis.circuit_loops import circuit_loops
from ilmek.synthesis.cognates import cognates
from ilmek.synthesis.filters import defects
from ilmek.synthesis.four_bar import TRACER, FourBar, LinkLengths, from_lengths
from ilmek.synthesis.task import PrecisionTask


def planted(seed: int, poses: int) -> tuple[FourBar, PosesAndPoints]:
    """A random four-bar, in decimetres, and positions on one of its circuits; which are poses is random."""
    rng, count = np.random.default_rng(seed), 10 - max(poses, 1)
    while True:
        try:
            made = from_lengths(
                LinkLengths(*rng.uniform(0.03, 0.2, 4)), 1.0, branch=+1, tracer=complex(*rng.normal(size=2)) / 10
            )
        except MechanismError:
            continue
        u = np.sort(rng.uniform(0, 2 * np.pi, count))
        if np.diff(np.r_[u, u[0] + 2 * np.pi]).min() > 0.1:
            break
    at = circuit_loops(made)[0].at(u)
    angles = np.full(count, np.nan)
    known = rng.permutation(count)[: poses if poses > 1 else 0]
    angles[known] = np.angle(at.coupler)[known]
    drawn = FourBar(made.a0, made.b0, at.a[0], at.b[0], at.tracer[0])
    return drawn, PosesAndPoints(at.tracer, angles)


def same(one: FourBar, other: FourBar, tolerance: float) -> bool:
    pins = np.array([[one.a0, one.a, one.b0, one.b], [one.b0, one.b, one.a0, one.a]])
    return bool(np.abs(pins - np.array([other.a0, other.a, other.b0, other.b])).max(axis=1).min() < tolerance)


def check_answers(task: PosesAndPoints, answer: CompleteFourBars) -> None:
    """Every answer is at every position, with the coupler's angle at poses: by the linkage's own solver."""
    for one in answer.found:
        drawn = one.four_bar
        tilt = np.exp(1j * one.angles) * (drawn.b - drawn.a)
        a = task.points + np.exp(1j * one.angles) * (drawn.a - drawn.tracer)
        branch = np.sign(((drawn.b0 - a).conj() * tilt).imag)
        size = max(drawn.lengths)
        for sign in (+1, -1):
            which = np.flatnonzero(branch == sign)
            if len(which):
                motion = solve(plan(drawn.mechanism(sign)), np.angle(a[which] - drawn.a0))
                gap = np.abs(motion.point("coupler", TRACER).position - task.points[which])
                assert gap.max() < 1e-6 * size, (one, gap)
        given = ~np.isnan(task.angles)
        turned = np.exp(1j * (one.angles - task.angles))[given]
        assert not given.any() or np.abs(turned - turned[0]).max() < 1e-9


@pytest.mark.parametrize(
    ("poses", "seed"),
    [(5, 0), (4, 1), (3, 2), *number([(2, 0)], [(5, 1), (4, 0), (4, 2), (3, 0), (3, 1), (2, 0), (0, 4)])],
)
def test_a_planted_four_bar_is_found_again(poses, seed):
    drawn, task = planted(seed, poses)
    answer = complete_four_bars(task)
    assert answer.complete
    assert all(one.certified for one in answer.found)
    assert answer.paths == len(answer.found) // (3 if poses < 2 else 1) + answer.left_out.get("complex", 0)
    near = 1e-7 * task.size
    hits = [one for one in answer.found if same(one.four_bar, drawn, near)]
    assert len(hits) == 1
    check_answers(task, answer)
    if poses < 2:
        family = [one.four_bar for one in answer.found if one.family == hits[0].family]
        assert len(family) == 3
        for cognate in cognates(drawn)[:3]:
            assert cognate is not None
            assert any(same(one, cognate, 1e-6 * task.size) for one in family)


def test_defects_of_known_configurations_are_those_of_the_full_check():
    seen = set()
    for seed in range(4, 7):
        _, task = planted(seed, 3)
        for one in complete_four_bars(task).found:
            full = defects(judge(one.four_bar, PrecisionTask(points=task.points, coupler=one.angles)))
            named = [name for name in ("one_circuit", "one_branch", "in_order") if name in full]
            quick = motion_defect(one.four_bar, one, task.points)
            assert quick == (named[0] if named else None)
            seen.add(quick)
    assert seen >= {"one_circuit", "one_branch", "in_order"}


def test_five_poses_give_the_pairs_of_burmester_s_links():
    for seed in range(6):
        _, task = planted(seed, 5)
        cranks = [one for one in arms_through_five_poses(task.points, task.angles) if one.kind is GuideKind.CRANK]
        answer = complete_four_bars(task)
        assert len(answer.found) == len(cranks) * (len(cranks) - 1) // 2
        for one in answer.found:
            pivots = [min(abs(pivot - crank.pivot) for crank in cranks) for pivot in (one.four_bar.a0, one.four_bar.b0)]
            assert max(pivots) < 1e-6 * task.size


def test_the_order_of_the_positions_and_the_frame_do_not_matter():
    drawn, task = planted(3, 3)
    found = complete_four_bars(task)
    order = np.r_[3:7, 0:3]
    turned = PosesAndPoints((2j - 1) * task.points[order] + 5, task.angles[order] + 0.25)
    again = complete_four_bars(turned)
    lengths = [sorted(max(one.four_bar.lengths) for one in answer.found) for answer in (found, again)]
    assert np.array(lengths[1]) == pytest.approx(5**0.5 * np.array(lengths[0]), rel=1e-7)
    assert min(abs(max(drawn.lengths) - one) for one in lengths[0]) < 1e-9


def test_positions_of_a_circle_have_a_family_of_four_bars_and_are_reported_as_incomplete():
    angles = np.r_[0.0, 0.3, 0.7, np.full(4, np.nan)]
    answer = complete_four_bars(PosesAndPoints(np.exp(1j * np.array([0, 0.3, 0.7, 1.1, 1.6, 2.2, 2.9])), angles))
    assert not answer.complete
    assert answer.left_out["path not finished"] > 0


def test_points_nearly_on_a_circle_end_in_an_answer():
    angles = np.r_[0.0, 0.3, 0.7, np.full(4, np.nan)]
    circle = np.exp(1j * np.array([0, 0.3, 0.7, 1.1, 1.6, 2.2, 2.9]))
    for shift in (1e-6, 1e-12):
        answer = complete_four_bars(PosesAndPoints(circle + shift * np.arange(7), angles))
        assert answer.paths == 201


def test_a_search_can_be_cancelled():
    _, task = planted(0, 3)
    with pytest.raises(Cancelled):
        complete_four_bars(task, Progress(cancelled=lambda: True))
