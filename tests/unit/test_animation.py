"""Machines in motion: bars keep their lengths, the run closes, and the page's figure says what the script needs."""

import itertools
import json
import math
import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from default_machines import default_report

from ilmek.dynamics.animation import animated, frames
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.catalogue import MACHINES
from ilmek.report import Animation, Drawing, Reading, Report
from ilmek.viz.moving_names import steadiest
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


def test_the_page_moves_by_itself_and_stays_small(report: Report) -> None:
    text = machine_page(report)
    assert text.count('class="moves"') == len(motions(report)) > 0
    assert text.count("prefers-reduced-motion") == 1
    assert text.count('<input type="range"') == text.count('<div class="controls" hidden>') == len(motions(report))
    assert not re.search(r'(?:src|href)="(?!#|data:)', text)
    assert sum(len(svg(figure).encode()) for figure in motions(report)) < 100_000


def test_parts_stand_at_the_frame_shown_first_and_refer_to_places(report: Report) -> None:
    for figure in motions(report):
        root = ET.fromstring(svg(figure))
        run = json.loads(next(one.text or "" for one in root.iter() if one.tag.endswith("metadata")))
        assert {len(places) for places in run["positions"]} == {2 * len(figure.at)}
        first = [tuple(places[2 * run["start"] : 2 * run["start"] + 2]) for places in run["positions"]]
        moved = [one for one in root.iter() if "data-at" in one.attrib or "data-line" in one.attrib]
        for one in moved:
            place = one.get("data-at")
            if place is not None:
                x, y = re.findall(r"-?[\d.]+", one.attrib["transform"])[:2]
                assert (float(x), float(y)) == pytest.approx(first[int(place)], abs=0.02)
            else:
                drawn = [tuple(map(float, point.split())) for point in re.split("[MLZ]", one.attrib["d"]) if point]
                assert drawn == [pytest.approx(first[int(at)], abs=0.02) for at in one.attrib["data-line"].split(",")]
        used = {int(at) for one in moved for at in re.findall(r"\d+", one.get("data-at") or one.attrib["data-line"])}
        used |= {int(one.attrib["data-ahead"]) for one in moved if "data-ahead" in one.attrib}
        assert used == set(range(len(first)))


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
    assert "rotate(" in svg(figure)


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


@pytest.mark.parametrize("closes", [True, False])
def test_names_take_the_steadiest_way(closes: bool) -> None:
    cost = np.random.default_rng(5).uniform(0, 3, (5, 4))

    def total(places: tuple[int, ...]) -> float:
        pairs = [*itertools.pairwise(places), (places[-1], places[0])] if closes else list(itertools.pairwise(places))
        moved = sum(0.4 * min(abs(a - b), 4 - abs(a - b)) ** 2 for a, b in pairs)
        return float(sum(cost[frame, place] for frame, place in enumerate(places)) + moved)

    best = min(itertools.product(range(4), repeat=5), key=total)
    assert tuple(steadiest(cost, 0.4, closes=closes)) == best
