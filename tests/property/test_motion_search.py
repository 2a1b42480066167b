"""Search of the families of three and four poses: no planted four-bar is missed, every answer keeps every limit."""

import math

import numpy as np
import pytest
from benchmarks.planted_motion import planted_motion

from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.motion_four_bar import MotionFourBar, MotionFourBarParams, design
from ilmek.synthesis.candidate import judge
from ilmek.synthesis.four_bar import TRACER, FourBar, from_lengths
from ilmek.synthesis.merit import merit
from ilmek.synthesis.motion.certificate import certified
from ilmek.synthesis.motion.limits import breaches
from ilmek.synthesis.task import PrecisionTask

SYMMETRIC = "(0mm,0mm,0deg) (60mm,40mm,45deg) (120mm,0mm,90deg)"
FLAP = "(0mm,0mm,35deg) (40mm,22mm,12deg) (78mm,12mm,-22deg) (92mm,-28mm,-60deg)"


def answer(**settings: str) -> MotionFourBar:
    return design(MotionFourBarParams.read(settings))


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("poses", [3, 4])
@pytest.mark.parametrize("seed", [3, 29, 57, 81, 102])
def test_a_planted_task_with_little_slack_has_an_answer_within_every_limit(poses: int, seed: int) -> None:
    planted = planted_motion(seed, poses)
    params = MotionFourBarParams.read(planted.settings)
    made = design(params)
    assert made.choice.kept
    for one in made.choice.kept:
        assert not breaches(one.candidate, params.limits())
        assert one.certified


def test_the_planted_four_bar_itself_keeps_its_limits() -> None:
    for seed in range(8):
        planted = planted_motion(seed, 3)
        params = MotionFourBarParams.read(planted.settings)
        task = PrecisionTask(points=params.task().points, coupler=params.task().angles)
        assert not breaches(judge(planted.drawn, task), params.limits())


def test_a_turning_crank_of_limited_size_is_found_where_a_random_search_finds_one() -> None:
    made = answer(poses=SYMMETRIC, full_turn="yes", size_max="400mm")
    best = made.choice.kept[0].candidate
    assert best.crank_turns
    assert best.size <= 0.4
    assert math.degrees(best.least_transmission) >= 40 - 1e-6
    assert len(made.choice.kept) == 5
    assert made.choice.found > 800


def test_answers_differ_by_half_the_extent_of_the_task_in_their_pins() -> None:
    made = answer(poses=SYMMETRIC)
    pins = np.array(
        [[getattr(one.candidate.four_bar, name) for name in ("a0", "b0", "a", "b")] for one in made.choice.kept]
    )
    for at, one in enumerate(pins):
        others = np.delete(pins, at, axis=0)
        both = np.concatenate([others, others[:, [1, 0, 3, 2]]])
        # The poses are symmetric about x = 60 mm, the last one first: a mirror image is no other answer.
        assert np.min(np.max(np.abs(both - one), axis=1)) > 0.5 * 0.12 - 1e-9
    gaps = [one.apart for one in made.choice.kept]
    assert sum(math.isinf(gap) for gap in gaps) == 1
    assert min(gaps) >= 0.5


def test_a_region_to_keep_clear_of_moves_the_answers_away() -> None:
    first = answer(poses=FLAP).choice.kept[0].candidate
    middle = (first.four_bar.a0 + first.four_bar.a) / 2
    box = f"({1e3 * middle.real - 4}mm,{1e3 * middle.imag - 4}mm) ({1e3 * middle.real + 4}mm,{1e3 * middle.imag + 4}mm)"
    params = MotionFourBarParams.read({"poses": FLAP, "keep_out": box})
    assert "keep_out" in breaches(first, params.limits())
    corners = params.limits().keep_out
    low, high = corners[0], corners[2]
    for one in design(params).choice.kept:
        at = one.candidate.motion(400)
        pivots = one.candidate.four_bar.a0, one.candidate.four_bar.b0
        for start, stop in ((pivots[0], at.a), (pivots[1], at.b), (at.a, at.b), (at.a, at.tracer), (at.b, at.tracer)):
            along = np.asarray(start) + np.linspace(0, 1, 100)[:, None] * (np.asarray(stop) - start)
            inside = (
                (along.real > low.real) & (along.real < high.real) & (along.imag > low.imag) & (along.imag < high.imag)
            )
            assert not inside.any()


def test_swings_and_the_region_of_the_crank_are_limits_of_the_search() -> None:
    settings = {"rocker_swing": "20deg..45deg", "crank_swing": "..80deg", "crank_region": "(-60mm,-90mm) (20mm,-10mm)"}
    made = answer(poses=FLAP, **settings)
    assert made.choice.kept
    for one in made.choice.kept:
        motion = solve(plan(one.candidate.four_bar.mechanism()), np.linspace(*_range(one.candidate.positions), 4000))
        swung = math.degrees(np.ptp(np.unwrap(np.angle(motion.direction("rocker")))))
        turned = math.degrees(np.ptp(_range(one.candidate.positions)))
        if not one.candidate.crank_turns:
            assert 20 - 0.01 <= swung <= 45 + 0.01
            assert turned <= 80 + 1e-6
        pivot = one.candidate.four_bar.a0
        assert -0.06 - 1e-10 <= pivot.real <= 0.02 + 1e-10
        assert -0.09 - 1e-10 <= pivot.imag <= -0.01 + 1e-10


def _range(positions: tuple[object, ...]) -> tuple[float, float]:
    cranks = [met.crank_angle for met in positions]  # type: ignore[attr-defined]
    return min(cranks), max(cranks)


def test_without_an_answer_the_limit_to_loosen_is_named_and_does_give_one() -> None:
    settings = {"poses": FLAP, "full_turn": "yes", "transmission_min": "40deg", "pivot_y": "..-50mm"}
    made = answer(**settings)
    assert not made.choice.kept
    assert made.choice.found == 0
    assert made.choice.left_out["transmission"] > 0
    words = {cure.split("=")[0]: cure for cure in made.choice.cures}
    assert set(words) == {"transmission_min", "full_turn"}
    least = words["transmission_min"].split(" ")[0].split("=")[1]
    assert answer(**(settings | {"transmission_min": least})).choice.kept


def test_the_sensitivity_is_that_of_the_moved_linkage() -> None:
    drawn = FourBar(0j, 0.1 + 0.01j, 0.03j, 0.08 + 0.07j, 0.05 + 0.09j)
    cranks = drawn.crank_angle + np.array([0.0, 0.7, 1.9])
    motion = solve(plan(drawn.mechanism()), cranks)
    points = motion.point("coupler", TRACER).position
    angles = np.unwrap(np.angle(motion.direction("coupler")))
    found = merit(judge(drawn, PrecisionTask(points=points, coupler=angles)))
    step, shifts = 1e-7, []
    ground = np.angle(drawn.b0 - drawn.a0)
    for name in drawn.lengths._fields:
        links = drawn.lengths._replace(**{name: getattr(drawn.lengths, name) + step})
        row = []
        for crank, point, angle in zip(cranks, points, angles, strict=True):
            moved = from_lengths(links, crank - ground, branch=drawn.branch, tracer=drawn.tracer_on_coupler)
            assert moved.tracer is not None
            there = drawn.a0 + moved.tracer * np.exp(1j * ground)
            row.append(
                (abs(there - point) / step, abs(np.angle(np.exp(1j * (moved.coupler_angle + ground - angle)))) / step)
            )
        shifts.append(row)
    table = np.array(shifts)
    extent = np.max(np.abs(points[:, None] - points))
    expected = np.max(np.sum(np.hypot(table[..., 0], extent * table[..., 1]), axis=0))
    assert found.sensitivity == pytest.approx(expected, rel=1e-4)
    assert found.point_shift == pytest.approx(1e-4 * np.max(np.sum(table[..., 0], axis=0)), rel=1e-4)


def test_a_proof_holds_for_exact_links_alone() -> None:
    made = answer(poses=FLAP)
    for one in made.choice.kept:
        drawn = one.candidate.four_bar
        pins = np.array([drawn.a0, drawn.b0, drawn.a, drawn.b])
        assert certified(pins, made.poses)
        assert not certified(pins + np.array([1e-9, 0, 0, 0]), made.poses)
