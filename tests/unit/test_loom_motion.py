"""A loom's knot and row in motion: views and actuators agree with the cyclograms and with the proof of the knot."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from default_machines import SETTLED

from ilmek.cli import main
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.figures import figures
from ilmek.machines.automated_loom.motion.actuators import knot_forces, knot_speeds, row_forces, row_speeds
from ilmek.machines.automated_loom.motion.knot_views import knot_from_the_front, knot_from_the_side
from ilmek.machines.automated_loom.motion.row_views import row_from_above, row_from_the_front
from ilmek.machines.automated_loom.motion.yarn_to_knot import yarn_to_knot
from ilmek.machines.weaver.motions import CENTRE_MOTION, SIDE_MOTION
from ilmek.report import Animation, MovingStroke, Plot
from ilmek.timing.track import sample


@cache
def loom(**settings: str) -> LoomDesign:
    return design(AutomatedLoomParams.read({"aim": "price", **SETTLED, "heads": "4", **settings}))


def stroke(animation: Animation, label: str) -> MovingStroke:
    return next(one for one in animation.strokes if one.label == label)


def curve(plot: Plot, label: str) -> tuple[np.ndarray, np.ndarray]:
    one = next(series for series in plot.series if series.label == label)
    return np.asarray(one.x), np.asarray(one.y)


def test_the_side_grippers_turn_as_their_screw() -> None:
    made = loom()
    front, by = knot_from_the_front(made), made.weaver.grippers
    turned = by.turned(sample(made.weaver.cyclogram.track(SIDE_MOTION), front.at).position)
    for label, hand in (("left side gripper", -1), ("right side gripper", 1)):
        points = stroke(front, label).points
        edge = points[:, 1] - points[:, 0]
        assert np.abs(edge) == pytest.approx(np.abs(edge[0]))
        assert np.angle(edge / edge[0]) == pytest.approx(hand * turned, abs=5e-3)


def test_the_yarn_from_the_front_ends_at_the_centre_gripper() -> None:
    front = knot_from_the_front(loom())
    tube = stroke(front, "centre gripper").points[-1]  # with the slot of its wire
    gripper = complex(tube.real.min() + tube.real.max(), tube.imag.min() + tube.imag.max()) / 2
    assert stroke(front, "yarn").points[-1][[0, -1]] == pytest.approx(gripper, abs=1e-4)  # of few chords


def test_tools_from_the_side_move_as_far_as_their_tracks() -> None:
    made = loom()
    moving = knot_from_the_side(made)
    centre = stroke(moving, "centre gripper").points.real.min(axis=1)
    track = sample(made.weaver.cyclogram.track(CENTRE_MOTION), moving.at).position
    assert centre.max() - centre == pytest.approx(track, abs=5e-5)


@pytest.mark.parametrize("weft", ["shuttle", "rapier"])
def test_each_weft_spans_the_cloth_when_it_is_beaten(weft: str) -> None:
    made = loom(weft=weft)
    moving, half = row_from_the_front(made), made.task.cloth.width / 2
    for name, beat in zip(
        ("straight weft", "sinuous weft"), made.row_cyclogram.track("beater").segments[::2], strict=True
    ):
        laid = stroke(moving, name).points[np.searchsorted(moving.at, beat.end)]
        assert np.sort(laid.real) == pytest.approx([-half, half])
        assert laid.imag == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("beat", "body"), [("travelling", "rocker"), ("comb", "comb")])
def test_what_beats_reaches_both_edges(beat: str, body: str) -> None:
    made = loom(beat=beat)
    across, half = stroke(row_from_the_front(made), body).points.real, made.task.cloth.width / 2
    assert across.min() == pytest.approx(-half, rel=0.05)
    assert across.max() == pytest.approx(half, rel=0.05)


def test_sheets_from_above_stand_apart_only_in_the_shed() -> None:
    made = loom()
    moving = row_from_above(made)
    even, odd = (stroke(moving, name).points[:, 0].imag for name in ("even warps", "odd warps"))
    positions = [sample(made.row_cyclogram.track(name), moving.at).position for name in ("even warps", "odd warps")]
    assert odd - even == pytest.approx((positions[0] - positions[1]) * (even.min() / -positions[0].max()))


@pytest.mark.parametrize("plot", [knot_speeds, row_speeds], ids=lambda one: one.__name__)
def test_speeds_integrate_to_the_travel_of_a_turn(plot: Callable[[LoomDesign], Plot]) -> None:
    made = loom()
    drawn = plot(made)
    cyclogram = made.cyclograms[0 if plot is knot_speeds else 1]
    for track in cyclogram.tracks:
        angle, speed = curve(drawn, track.name)
        scale = made.weaver.handler_radius if track.unit == "deg" else 1.0
        gained = np.trapezoid(speed, angle) / cyclogram.speed
        assert gained == pytest.approx(scale * track.gain, abs=2e-3 * scale * track.stroke), track.name


def test_the_lifted_warps_do_no_work_over_a_row() -> None:
    made = loom()
    for name in ("even warps", "odd warps"):
        angle, force = curve(row_forces(made), name)
        lift = sample(made.row_cyclogram.track(name), angle).position
        lifted = np.trapezoid(force * (np.gradient(lift) > 0), lift)
        assert lifted > 10.0
        assert np.trapezoid(force, lift) == pytest.approx(0.0, abs=1e-3 * lifted)


def test_forces_of_a_knot_open_the_warps_and_tighten_the_yarn() -> None:
    made = loom()
    opener = curve(knot_forces(made), SIDE_MOTION)[1].max()
    assert opener == pytest.approx(made.weaver.opener.force_max, rel=0.02)
    assert curve(knot_forces(made), CENTRE_MOTION)[1].min() == pytest.approx(-2 * made.weaver.params.forces.tightening)


def test_the_last_word_of_the_path_is_that_of_the_knot() -> None:
    made = loom()
    drawn = yarn_to_knot(made)
    words = [dot.label.split(": ")[1] for dot in drawn.dots if ": " in dot.label]
    assert words[0] == "no crossing"
    assert words[-1] == " ".join(f"{letter:+d}" for letter in made.weaver.tied.word)


def test_a_head_with_arms_has_no_views_of_grippers() -> None:
    names = [make.func.__name__ for make in figures(loom(knotting="arms"))]
    assert "knot_from_the_side" in names
    assert "knot_from_the_front" not in names


@pytest.mark.usefixtures("not_in_space")
@pytest.mark.usefixtures("not_in_space")
def test_a_motion_is_written_by_its_name(tmp_path: Path) -> None:
    target = tmp_path / "knot.gif"
    settings = [f"{name}={value}" for name, value in {**SETTLED, "beat": "comb"}.items()]
    call = ["design", "automated-loom", *settings, "--animation", str(target), "--motion", "loom-knot-front"]
    done = CliRunner().invoke(main, call)
    assert (done.exit_code, target.read_bytes()[:6]) == (0, b"GIF89a")
    unknown = CliRunner().invoke(main, [*call[:-1], "dance", "--force"])
    assert unknown.exit_code == 2
    assert "--motion dance; one of loom-row-moving, loom-row-front" in unknown.output
    alone = CliRunner().invoke(main, ["design", "automated-loom", "--motion", "dance"])
    assert "--motion needs --animation" in alone.output
