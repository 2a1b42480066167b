"""Variants as arrays against the same mechanisms one by one: motion, forces, and results of a file's values."""

import tempfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from study_targets import FOUR_BAR

from ilmek import four_bar, read_mechanism, slider_crank, solve
from ilmek.dynamics.inverse_run import InverseRun, inverse_run
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import mechanism_of_values
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.study.order import StudyOrder
from ilmek.jobs.study.run import study
from ilmek.jobs.study.targets import FEW, read_target
from ilmek.linkage.structure import plan
from ilmek.linkage.transmission import transmission_angles
from ilmek.linkage.variants import with_points
from ilmek.studies.outcome import Hold, Question, evaluated

TURN = np.linspace(0.0, 2 * np.pi, 37)

LENGTHS = st.lists(st.floats(0.02, 0.3), min_size=1, max_size=6)


@settings(max_examples=30, deadline=None)
@given(cranks=LENGTHS, rockers=LENGTHS)
def test_motions_of_variants_are_those_one_by_one(cranks: list[float], rockers: list[float]) -> None:
    """Four-bars that close nowhere, in part or everywhere."""
    want = ["coupler.P x", "coupler.P vy", "coupler.P ax", "rocker angle", "rocker alpha", "transmission_angle_min"]
    given = four_bar(0.3, 0.06, 0.2, 0.23, points={"coupler": {"P": 0.1 + 0.05j}})
    swept = given.vary(crank=np.array(cranks)[:, None], rocker=rockers).evaluate(37, want=want, speed=15.0)
    assert swept.closes.shape == (len(cranks), len(rockers))
    alone = given.vary(crank=np.array(cranks)[:, None], rocker=rockers).evaluate(37, want=want[:1], speed=15.0)
    np.testing.assert_array_equal(alone[want[0]], swept[want[0]])
    for place in np.ndindex(swept.closes.shape):
        crank, rocker = cranks[place[0]], rockers[place[1]]
        single = plan(four_bar(0.3, crank, 0.2, rocker, points={"coupler": {"P": 0.1 + 0.05j}}))
        motion = solve(single, TURN, speed=15.0)
        point = motion.point("coupler", "P")
        angle = transmission_angles(motion)["B"]
        expected = (
            point.position.real,
            point.velocity.imag,
            point.acceleration.real,
            np.angle(motion.direction("rocker")),
            motion.alpha("rocker"),
            np.fmin.reduce(angle),
        )
        assert swept.closes[place] == np.mean(motion.status == 0)
        usable = motion.status == 0
        for name, values in zip(want, expected, strict=True):
            ours, theirs = swept[name][place], np.asarray(values)
            if theirs.ndim:
                ours, theirs = ours[usable], theirs[usable]
            np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-12 * np.max(np.abs(theirs), initial=1.0))


def one_by_one(data: Mapping[str, object], values: Mapping[str, float]) -> InverseRun:
    """The forces of one variant of a file."""
    file = mechanism_of_values(data, values)
    speed = 150 * 2 * np.pi / 60
    motion = solve(plan(file.mechanism), TURN, speed=speed)
    return inverse_run(file.machine, motion, file.mechanism.inputs[0].name, TURN / speed)


@settings(max_examples=10, deadline=None)
@given(cranks=st.lists(st.floats(0.03, 0.065), min_size=1, max_size=130), mass=st.floats(0.1, 4.0))
def test_forces_of_a_files_values_are_those_one_by_one(cranks: list[float], mass: float) -> None:
    """More variants than are computed at once, lengths and masses that differ."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "four_bar.toml"
        path.write_text(FOUR_BAR)
        file = read_mechanism(path)
    want = ["drive_torque_max", "drive_torque_rms", "pin_forces_max.B", "pin_forces_max", "frame_force_max"]
    swept = file.vary(a=cranks, b=np.array([[0.2], [0.21]]), weight=np.array([[0.4], [mass]])).evaluate(37, want=want)
    for place in [(0, 0), (1, 0), (0, len(cranks) - 1), (1, len(cranks) - 1)]:
        run = one_by_one(file.data, {name: float(values[place]) for name, values in swept.given.items()})
        pins = run.pin_forces_max
        expected = (run.drive_torque_max, run.drive_torque_rms, pins["B"], max(pins.values()), run.frame_force_max)
        np.testing.assert_allclose([swept[name][place] for name in want], expected, rtol=1e-12)


@pytest.mark.parametrize("name", ["quick_return", "jansen_leg", "klann_leg", "stephenson_dwell", "peaucellier"])
def test_other_groups_are_moved_as_one_by_one(name: str) -> None:
    """A point of the first moving body with two is varied by a thousandth; the last one moves accordingly."""
    mechanism = read_mechanism(f"examples/{name}.toml").mechanism
    body = next(body for body in mechanism.bodies if body.name in mechanism.moving and len(body.points) > 1)
    point = list(body.points)[1]
    positions = body.points[point] * np.array([1.0, 1.001, 0.999])
    end = mechanism.body(mechanism.moving[-1])
    want = [f"{end.name}.{list(end.points)[-1]} ax", f"{end.name}.{list(end.points)[-1]} y"]
    swept = mechanism.vary({f"{body.name}.{point}": positions}).evaluate(37, want=want, speed=5.0)
    for number, position in enumerate(positions):
        single = with_points(mechanism, {(body.name, point): complex(position)})
        motion = solve(plan(single), TURN, speed=5.0)
        usable = motion.status == 0
        moved = motion.point(end.name, list(end.points)[-1])
        assert swept.closes[number] == usable.mean()
        for one, values in zip(want, (moved.acceleration.real, moved.position.imag), strict=True):
            error = np.abs(swept[one][number] - values)[usable].max()
            assert error <= 1e-12 * np.abs(values[usable]).max()


def test_a_table_of_variants_has_a_row_a_sample() -> None:
    pandas = pytest.importorskip("pandas")
    variants = slider_crank(0.04, 0.14).vary(crank=[0.03, 0.04])
    swept = variants.evaluate(5, want=["slider.B x", "transmission_angle_min"])
    assert isinstance(swept.frame(), pandas.DataFrame)
    assert swept.frame().shape == (10, 4)
    assert variants.evaluate(5, want=["transmission_angle_min"]).frame().shape == (2, 2)
    assert swept["slider.B x"][:, 0] == pytest.approx([0.17, 0.18], abs=1e-15)


def test_wrong_variants_are_errors() -> None:
    bar = four_bar(0.3, 0.06, 0.2, 0.23)
    with pytest.raises(MechanismError, match="nothing varies"):
        bar.vary()
    with pytest.raises(MechanismError, match="has no body 'crnk'.*crank"):
        bar.vary(crnk=[0.1])
    with pytest.raises(MechanismError, match="do not broadcast"):
        bar.vary(crank=[0.1, 0.2], rocker=[0.1, 0.2, 0.3])
    with pytest.raises(MechanismError, match="not above 0"):
        bar.vary(crank=[0.1, 0.0])
    with pytest.raises(MechanismError, match="no result 'rocker angl'.*rocker angle"):
        bar.vary(crank=[0.05]).evaluate(want=["rocker angl"])
    press = read_mechanism("examples/slider_crank_press.toml")
    with pytest.raises(MechanismError, match="unknown value 'strok'.*stroke"):
        press.vary(strok=[0.06])
    with pytest.raises(MechanismError, match="joint friction"):
        press.vary(stroke=[0.06]).evaluate(want=["drive_torque_max"])


WANTED = ("drive_torque_rms", "pin_forces_max", "pin_forces_max.B", "frame_force_max", "transmission_angle_min")


@settings(max_examples=5, deadline=None)
@given(st.lists(st.tuples(st.floats(0.02, 0.12), st.floats(0.15, 0.25)), min_size=2, max_size=8))
def test_designs_of_a_study_are_those_one_by_one(designs: list[tuple[float, float]]) -> None:
    """Cranks that turn, that stand near a dead centre and that close in part: results, checks, margins, reasons."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "four_bar.toml"
        path.write_text(FOUR_BAR)
        target = read_target(str(path), {}, MotionRequest({}))
    question = Question(target, WANTED, (Hold("drive_torque_rms", "<=", 0.2, "N*m"),))
    values = [{"a": a, "b": b} for a, b in (*designs, *((0.06, 0.2 + 1e-3 * n) for n in range(FEW)))]
    together = evaluated(question, values)
    alone = [evaluated(question, [one])[0] for one in values[: len(designs) + 1]]
    for ours, theirs in zip(together, alone, strict=False):
        assert (ours.status, ours.reason, ours.failed) == (theirs.status, theirs.reason, theirs.failed)
        np.testing.assert_allclose(ours.results, theirs.results, rtol=1e-12)
        assert (ours.margins or {}).keys() == (theirs.margins or {}).keys()
        for name, margin in (ours.margins or {}).items():
            np.testing.assert_allclose(margin, (theirs.margins or {})[name], rtol=1e-11, atol=1e-12)
    assert len(designs) in target.numbers_together(values, WANTED)


def test_designs_on_a_cluster_are_those_of_this_process(tmp_path: Path) -> None:
    """Blocks of arrays are the same, so that the results are, to the last bit."""
    distributed = pytest.importorskip("distributed")
    path = tmp_path / "four_bar.toml"
    path.write_text(FOUR_BAR)
    order = StudyOrder(str(path), {}, {"a": "40mm..60mm"}, ("drive_torque_rms",), samples=80)
    with distributed.LocalCluster(2, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        there = study(order, cluster=cluster.scheduler_address)
    assert there.digest == study(order).digest
