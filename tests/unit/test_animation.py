"""Machines in motion: bars keep their lengths, the run closes, and the page holds what the client draws."""

import itertools
import math
import re
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from default_machines import default_report, page_data

from ilmek.dynamics.animation import animated, frames
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.catalogue import MACHINES
from ilmek.report import Animation, Axis, Drawing, MovingStroke, Reading, Report
from ilmek.viz.labels import LabelRequest, steady
from ilmek.viz.page import machine_page
from ilmek.viz.svg import svg

NOTHING = Drawing("run", "A machine in motion", ())
MOVING = ("beat-up", "tufting", "knotting-four-bar", "motion-four-bar", "function-four-bar")


def motions(report: Report) -> list[Animation]:
    return [figure for figure in report.figures if isinstance(figure, Animation)]


@pytest.fixture(scope="module", params=MOVING)
def report(request: pytest.FixtureRequest) -> Report:
    return default_report(request.param)


def quick_return() -> Motion:
    """A crank whose block slides in an arm that swings: a guide that moves."""
    mechanism = Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "P": -0.3j}),
            Body("crank", {"O": 0, "A": 0.1}),
            Body("block", {"A": 0, "slot": 0}),
            Body("arm", {"P": 0, "slot": 0}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Pin("A", "crank", "block"),
            Slide("slot", "block", "arm"),
            Pin("P", GROUND, "arm"),
        ),
        inputs=(Rotation("crank", "O"),),
        branches={"slot": +1},
    )
    return solve(plan(mechanism), frames()).require()


def test_every_bar_keeps_its_shape(report: Report) -> None:
    for figure in motions(report):
        for bar in figure.strokes:
            for one, other in itertools.combinations(bar.points.T, 2):
                assert np.ptp(np.abs(one - other)) < 1e-12


def test_a_closed_run_goes_on_without_a_jump(report: Report) -> None:
    for figure in motions(report):
        assert len(figure.at) <= 60
        step = max(float(np.abs(np.diff(dot.at)).max()) for dot in figure.dots)
        over = max(abs(complex(dot.at[0] - dot.at[-1])) for dot in figure.dots)
        assert not figure.closes or over <= step


@pytest.mark.parametrize("name", [name for name in MACHINES if name != "automated-loom"])
def test_every_machine_that_moves_is_shown_moving(name: str) -> None:
    """The row of a loom, which is long to design, is shown by `test_arrangement`."""
    found = motions(default_report(name))
    assert found, "no figure moves"
    for figure in found:
        assert figure.readings
        assert all(np.isfinite(one.points).all() for one in figure.strokes)
        assert all(np.isfinite(one.at).all() for one in figure.dots)
        assert all(np.isfinite(one.values).all() and len(one.values) == len(figure.at) for one in figure.readings)
        assert {len(one.points) for one in figure.strokes} == {len(figure.at)}
        moved = np.array([np.abs(np.diff(one.points, axis=0)).max(axis=1) for one in figure.strokes]).max(axis=0)
        assert np.count_nonzero(moved) > 0.25 * len(figure.at)


def test_moving_machines_follow_the_motion_of_their_reports() -> None:
    """Lift of the warps, travel of the bar, stroke of the comb and carrier: distances in the figures, read off."""
    shedding, compensator, hammer, weft = (
        motions(default_report(name))[0] for name in ("shedding", "tension-compensator", "hammer", "weft")
    )
    even = [one.points for one in shedding.strokes if one.label == "even"][1]
    assert even[:, 1].real == pytest.approx(shedding.readings[0].values, abs=1e-12)
    bar = next(one.points.mean(axis=1) for one in compensator.strokes if one.label == "even bar")
    assert np.abs(bar - bar[0]) == pytest.approx(compensator.readings[2].values, abs=1e-6)
    comb = hammer.strokes[0].points[:, 0]
    assert np.ptp(comb.imag) == pytest.approx(np.ptp(hammer.readings[0].values), rel=1e-9)
    beat = int(np.argmax(hammer.readings[1].values))
    assert hammer.strokes[1].points[beat, 0].imag == pytest.approx(hammer.strokes[0].points[beat].imag.min(), abs=1e-6)
    middle = weft.strokes[1].points.mean(axis=1).real
    assert np.ptp(middle) == pytest.approx(np.ptp(weft.readings[0].values), rel=1e-9)


def test_what_is_shown_first_is_where_it_matters() -> None:
    (beat,) = motions(default_report("beat-up"))
    (fell,) = (dot for dot in beat.dots if dot.label == "E")
    distance = next(reading for reading in beat.readings if reading.label == "beater from the fell")
    assert distance.values[beat.start] == pytest.approx(0.0, abs=5e-4)
    assert distance.values.argmin() == beat.start
    assert np.abs(fell.at[beat.start] - fell.at).max() == pytest.approx(distance.values.max(), rel=0.02)


def test_the_page_holds_what_moves(report: Report) -> None:
    """Every line and point of the data that the client draws stands at every frame where the report has it."""
    text = machine_page(report)
    assert not re.search(r'(?:src|href)="(?!#|data:)', text)
    shown = [one["animation"] for one in page_data(text) if one["animation"]]
    assert len(shown) == len(motions(report)) > 0
    for figure, data in zip(motions(report), shown, strict=True):
        tracks = [np.array(track).view(complex) for track in data["tracks"]]
        assert data["at"] == pytest.approx(figure.at, rel=1e-5)
        for line, drawn in zip(figure.strokes, data["shapes"], strict=True):
            assert drawn_points(drawn, tracks) == pytest.approx(line.points, abs=1e-6)
        for dot, drawn in zip(figure.dots, data["points"], strict=True):
            assert tracks[drawn["track"]] == pytest.approx(dot.at, abs=1e-6)


def drawn_points(shape: dict[str, Any], tracks: list[np.ndarray]) -> np.ndarray:
    """The points of a line at every frame, from the tracks of its points or of the two that carry it."""
    if not shape["shape"]:
        return np.stack([tracks[number] for number in shape["tracks"]], axis=1)
    origin, ahead = (tracks[number] for number in shape["tracks"])
    local = np.array(shape["shape"]).view(complex)
    return origin[:, np.newaxis] + ((ahead - origin) / np.abs(ahead - origin))[:, np.newaxis] * local


def test_a_line_that_keeps_its_shape_is_moved_as_a_whole() -> None:
    at = np.linspace(0.0, 6.0, 30)
    shape = 0.1 * np.exp(1j * np.linspace(0.0, 6.2, 80)) * (1 + 0.2 * np.sin(np.arange(80)))
    points = (0.3 * np.exp(0.5j * at) + 0.1j)[:, np.newaxis] + np.exp(1j * at)[:, np.newaxis] * shape
    figure = Animation(NOTHING, Axis("angle", "deg"), at, (MovingStroke(points, "outline", closed=True),), (), False, 7)
    (data,) = page_data(machine_page(Report("m", "M", {}, (), (), figures=(figure,))))
    tracks = [np.array(track).view(complex) for track in data["animation"]["tracks"]]
    assert len(tracks) == 2
    assert drawn_points(data["animation"]["shapes"][0], tracks) == pytest.approx(points, abs=1e-5)


def test_every_name_is_there_once_and_bars_are_in_the_legend() -> None:
    (beat,) = motions(default_report("beat-up"))
    said = [(one.text or "").strip() for one in ET.fromstring(svg(beat)).iter() if one.tag.endswith("}text")]
    for name in ("A", "B", "C", "D", "E", "carpet", "warp", "fell"):
        assert said.count(name) == 1
    assert [text for text in said if text.endswith(" mm") and text[0].isalpha()] == [
        "rocker 231.6 mm",
        "coupler 199.8 mm",
        "crank 59.95 mm",
    ]


def test_a_guide_that_moves_is_drawn_as_far_as_its_block_goes() -> None:
    figure = animated(quick_return(), frames(), NOTHING)
    (arm,) = (bar for bar in figure.strokes if bar.label == "arm")
    length = float(np.abs(arm.points[:, 0] - arm.points[:, 1])[0])
    assert length == pytest.approx(0.4 + 0.15 * 0.2, abs=0.001)
    (block,) = (dot for dot in figure.dots if dot.role == "block")
    assert block.along is not None
    assert np.allclose(block.at - (-0.3j), np.abs(block.at - (-0.3j)) * block.along)
    (corners,) = re.findall(r'd="M([^"]+)Z" fill="#e4e8ec" stroke="#7b8794"', svg(figure))
    box = np.array([float(number) for number in re.split("[L ]", corners)]).view(complex)
    assert np.abs(np.diff(box)) == pytest.approx([20.0, 13.0, 20.0], abs=0.02)
    across = (box[0] - box[1]) / abs(box[0] - box[1])
    along = complex(block.along[figure.start])
    assert abs((across.conjugate() * along.conjugate()).imag) < 1e-3, "the box lies along its guide"


def test_a_coupler_of_three_points_is_an_area() -> None:
    mechanism = four_bar(0.3, 0.06, 0.2, 0.23, branch=+1)
    bodies = [
        Body(body.name, {**body.points, "K": 0.1 + 0.08j}) if body.name == "coupler" else body
        for body in mechanism.bodies
    ]
    made = Mechanism(tuple(bodies), mechanism.joints, mechanism.inputs, mechanism.branches)
    figure = animated(solve(plan(made), frames()), frames(), NOTHING, traces=(("coupler", "K"),))
    (coupler,) = (bar for bar in figure.strokes if bar.label == "coupler")
    assert coupler.closed
    assert coupler.points.shape == (60, 3)
    (path,) = (stroke for stroke in figure.still.strokes if stroke.role == "path")
    assert path.closed
    assert np.allclose(path.points, next(dot.at for dot in figure.dots if dot.label == "K"))


def test_no_turn_goes_to_and_fro() -> None:
    at = frames(math.radians(30), math.radians(200))
    motion = solve(plan(four_bar(0.3, 0.06, 0.2, 0.23, branch=+1)), at)
    figure = animated(motion, at, NOTHING, start=math.radians(200), readings=(Reading("<b>", at, "deg"),))
    assert not figure.closes
    assert figure.start == 59
    page = machine_page(Report("m", "M", {}, (), (), figures=(figure,)))
    assert "<b></dt>" not in page
    assert "&lt;b&gt;" in page


def test_names_of_moving_points_keep_their_side() -> None:
    """Of all sides of its point, a name takes the one on which it covers fewest points over all frames."""
    rng = np.random.default_rng(5)
    for _ in range(20):
        at = np.cumsum(rng.normal(size=(6, 2)), axis=0) @ [3, 3j] + (100 + 100j)
        met = [rng.uniform(60, 140, (30, 2)) @ [1, 1j] for _ in at]
        request = LabelRequest(at, "carrier", 9.0)
        (centres,) = steady([request], met, 0j, 200 + 200j)
        assert np.ptp((centres - at).real) < 1e-9 > np.ptp((centres - at).imag)
        half, chosen = request.half + (1 + 1j), centres - at

        def hidden(offset: complex, at: np.ndarray = at, half: complex = half, met: list[np.ndarray] = met) -> int:
            off = [points - place - offset for points, place in zip(met, at, strict=True)]
            return sum(np.count_nonzero((np.abs(o.real) <= half.real) & (np.abs(o.imag) <= half.imag)) for o in off)

        opposite = [-chosen[0], chosen[0].conjugate(), -chosen[0].conjugate()]
        assert hidden(complex(chosen[0])) <= min(map(hidden, map(complex, opposite)))
