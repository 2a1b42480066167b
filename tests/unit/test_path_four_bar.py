"""The four-bar for a path: what it answers, and what it refuses."""

import json

import numpy as np
import pytest
from examples.draw_nine_points import POINTS as POINTS_OF_FIGURE
from examples.draw_nine_points import figure

from ilmek.errors import ParameterError
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.path_four_bar import MACHINE
from ilmek.progress import Cancelled, Progress
from ilmek.report import Animation, Report
from ilmek.synthesis.candidate import judge
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.task import PrecisionTask
from ilmek.units import deg

CASE_TWO = "(3mm,3mm) (2.759mm,3.363mm) (2.372mm,3.663mm) (1.890mm,3.862mm) (1.355mm,3.943mm)"
FIVE = "30deg 45deg 60deg 75deg 90deg"
THREE, TURNS = "(20mm,20mm) (22mm,30mm) (15mm,38mm)", "0deg 30deg 80deg"


def answer(**settings: str) -> Report:
    return MACHINE.report_for(settings)


def four_bar(found: dict[str, list[float]]) -> FourBar:
    return FourBar(*(complex(*found[name]) for name in ("a0", "b0", "a", "b", "tracer")))


def test_the_default_task_is_met_exactly_and_said_by_the_names_that_are_promised() -> None:
    said = answer(starts="200", cognates="yes")
    results = json.loads(json.dumps(said.as_json()))["results"]
    assert MACHINES["path-four-bar"] is MACHINE
    assert not said.failed
    assert results["error_max"] < 1e-12
    points = np.array([20 + (20 + 5 * k) * 1j for k in range(6)]) * 1e-3
    for found in results["solutions"]:
        again = judge(four_bar(found), PrecisionTask(points=points))
        assert again.met
        assert again.in_order
        assert list(four_bar(found).lengths) == pytest.approx([found[name] for name in LINKS], rel=1e-12)
        assert found["starts_agreed"] >= 1
        assert (found["active"], found["circuits"]) == ([], found["circuits"][:1] * 6)
    assert [one["name"] for one in results["cognates"]] == ["timed", "other"]
    assert all(one["error_max"] < 1e-12 for one in results["cognates"])
    assert sum(isinstance(figure, Animation) for figure in said.figures) == 1


LINKS = ("ground", "crank", "coupler", "rocker")


def test_bounds_and_a_fixed_pivot_reach_the_published_best_of_case_two() -> None:
    limits = dict.fromkeys(LINKS, "..50mm") | dict.fromkeys(("tracer_along", "tracer_across"), "-50mm..50mm")
    fixed = {"pivot_x": "0", "pivot_y": "0mm", "turn": "0deg..0deg", "start": "0"}
    results = answer(points=CASE_TWO, timing=FIVE, **limits, **fixed).as_json()["results"]
    assert results["error_squares"] == pytest.approx(7.4158e-7 * 1e-6, rel=1e-3, abs=0)  # synthesis.md, case 2, in mm²
    assert results["solutions"][0]["a0"] == pytest.approx([0.0, 0.0], abs=1e-15)
    assert results["solutions"][0]["crank_angles"][0] == pytest.approx(30 * deg)


def test_five_timed_points_are_met_exactly_by_every_solution_and_what_is_removed_says_why() -> None:
    results = answer(points=CASE_TWO, timing=FIVE, exact="yes", **LOOSE).as_json()["results"]
    points, turns = np.array([complex(*pair) for pair in POINTS]) * 1e-3, np.array([30, 45, 60, 75, 90]) * deg
    assert results["solutions"]
    for found in results["solutions"]:
        seen = judge(four_bar(found), PrecisionTask(points=points, crank=turns))
        assert seen.point_error < 1e-11
    strict = answer(points=CASE_TWO, timing=FIVE, exact="yes").as_json()["results"]
    assert len(strict["solutions"]) + len(strict["removed"]) == len(results["solutions"]) + len(results["removed"])
    assert all(one["reasons"] for one in strict["removed"])


LOOSE = {"one_circuit": "no", "one_branch": "no", "in_order": "no"}
POINTS = [(3, 3), (2.759, 3.363), (2.372, 3.663), (1.890, 3.862), (1.355, 3.943)]


def test_three_timed_points_are_met_with_the_pivots_that_are_given() -> None:
    results = answer(points=THREE, timing=TURNS, exact="yes", pivots="(0,0) (30mm,-5mm)", **LOOSE).as_json()["results"]
    (found,) = results["solutions"]
    assert (found["a0"], found["b0"]) == (pytest.approx([0, 0]), pytest.approx([0.03, -0.005]))
    assert found["error_max"] < 1e-12


def test_four_timed_points_give_four_bars_with_the_crank_at_its_own_angles() -> None:
    four = " ".join(CASE_TWO.split()[:4])
    results = answer(points=four, timing="30deg 45deg 60deg 75deg", exact="yes", **LOOSE, count="3").as_json()[
        "results"
    ]
    for found in results["solutions"]:
        pin = complex(*found["a"]) - complex(*found["a0"])
        assert abs((pin * np.exp(-1j * 30 * deg)).imag) < 1e-12 * abs(pin)


def test_an_error_that_is_too_great_is_a_reason_to_go() -> None:
    said = answer(points=CASE_TWO, timing=FIVE, pivot_x="0..0", pivot_y="0..0", starts="96", error_max="0.001um")
    results = said.as_json()["results"]
    assert results["solutions"] == []
    assert results["chosen"] is None
    assert all("misses position" in one["reasons"]["met"] for one in results["removed"])
    assert said.failed[0].name == "four-bars without defects"
    assert "error_max=0.0004454 mm gives one" in said.warnings[0]


def test_a_search_that_ends_at_the_transmission_angle_is_kept_and_says_what_holds_it() -> None:
    bow = "(60mm,0mm) (52mm,12mm) (30mm,18mm) (8mm,12mm) (0mm,0mm) (15mm,0mm) (30mm,0mm) (45mm,0mm)"
    limits = dict.fromkeys(LINKS, "10mm..120mm") | {"transmission_min": "40deg"}
    results = answer(points=bow, closed="yes", starts="96", **limits).as_json()["results"]
    assert results["removed"] == []
    held = [found for found in results["solutions"] if "transmission angle at its limit 40 deg" in found["active"]]
    assert held
    assert all(found["transmission_min"] == pytest.approx(40 * deg, abs=1e-6) for found in held)


def test_hoeken_s_linkage_is_found_from_its_straight_line() -> None:
    """Ground, crank, coupler and rocker are 2 : 1 : 2.5 : 2.5 and the tracer is at twice the coupler (Norton)."""
    turns = np.linspace(0, np.pi, 9)
    drawn = FourBar(0j, 40 + 0j, 20j, 20j + 50 * np.exp(1j * np.arctan2(-20, 40) + 1j * np.arccos(np.sqrt(2000) / 100)))
    rods = 20 * np.exp(1j * (np.pi / 2 + turns))
    joined = rods + (40 - rods) / 2 + 1j * (40 - rods) * np.sqrt(2500 / np.abs(40 - rods) ** 2 - 0.25)
    line = 2 * joined - rods
    assert joined[0] == pytest.approx(drawn.b)
    assert np.ptp(line.imag) < 0.0025 * np.ptp(line.real)
    points = " ".join(f"({point.real}mm,{point.imag}mm)" for point in line)
    results = answer(points=points, timing=" ".join(f"{turn}rad" for turn in turns), starts="96").as_json()["results"]
    found = four_bar(results["candidates"][0])
    lengths = np.array(
        [abs(found.b0 - found.a0), abs(found.a - found.a0), abs(found.b - found.a), abs(found.b - found.b0)]
    )
    assert lengths == pytest.approx([0.04, 0.02, 0.05, 0.05], rel=1e-6)


NARROW = dict.fromkeys(("ground", "coupler", "rocker"), "20mm..21mm") | {"crank": "12mm..13mm"}


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"points": "(1mm,2mm) (3mm,4mm)"}, "a path of 2 points; 4 to 200 are searched; give more points; a body"),
        ({"points": THREE}, "3 timed points are met exactly: set timing, pivots and exact=yes"),
        ({"points": "(1mm,2mm) " * 201}, "a hand-drawn curve needs no more than 60"),
        ({"points": "(1mm,2mm) (1mm,2mm) (3mm,4mm) (5mm,6mm)"}, "points 1 and 2 of the path are the same"),
        ({"points": "(1mm,2mm) " * 4}, "all points of the path are the same"),
        ({"points": "(1,2) (3,4) (5,6) (7,8)"}, "1 has no unit; did you mean 1mm"),
        ({"points": "(1mm,2mm,3deg) (4mm,5mm,6deg)"}, "holds 3 numbers, not 2"),
        ({"timing": "30 60 90 120 150 180"}, "30 has no unit; did you mean 30deg"),
        ({"timing": "30rad 60rad 90rad 120rad 150rad 180rad"}, "if 150 deg was meant"),
        ({"timing": "30deg 60deg"}, "timing of 2 angles for 6 points"),
        ({"timing": "0deg 60deg 30deg 90deg 120deg 150deg"}, "not monotonic"),
        ({"exact": "yes"}, "exact=yes without a timing"),
        ({"exact": "yes", "timing": "0 10deg 20deg 30deg 40deg 50deg"}, "leave exact out"),
        ({"exact": "yes", "points": THREE, "timing": TURNS}, "3 timed points need both pivots"),
        ({"exact": "yes", "points": CASE_TWO, "timing": FIVE, "crank": "..9mm"}, "leave crank out, or exact"),
        ({"exact": "yes", "points": CASE_TWO, "timing": FIVE, "pivots": "(0,0) (1mm,0)"}, "leave pivots out"),
        ({"exact": "yes", "points": CASE_TWO, "timing": TURNS}, "5 points and 3 angles"),
        ({"pivots": "(0,0) (9mm,0)"}, "fix the crank's with pivot_x"),
        ({"start": "0..0"}, "start is given without a timing"),
        ({"crank": "10mm..20mm..30mm"}, "is no pair of bounds; bounds are written 10mm..60mm"),
        ({"crank": ".."}, "is no pair of bounds"),
        ({"crank": "long"}, "crank: 'long' is not a quantity"),
        ({"crank": "60mm..10mm"}, "did you mean 10mm..60mm"),
        ({"crank": "10..60"}, "10 has no unit; did you mean 10mm"),
        ({"ground": "10mm..50mm", "crank": "60mm..80mm"}, "ground 0.01 m to 0.05 m and crank 0.06 m to 0.08 m clash"),
        ({**NARROW, "transmission_min": "60deg"}, "crank 0.012 m to 0.013 m and a transmission angle of 60 deg clash"),
        ({"transmission_min": "40"}, "did you mean 40deg"),
        ({"kind": "crank rocker"}, "did you mean crank-rocker"),
        ({"starts": "96", "count": "2", "chosen": "3"}, "chosen=3, and there are 2 solutions; 1 to 2"),
    ],
)
def test_refuses_in_words(settings: dict[str, str], said: str) -> None:
    with pytest.raises(ParameterError) as refused:
        answer(**settings)
    assert said in str(refused.value)


def test_a_long_search_reports_its_progress_and_is_cancelled() -> None:
    shares = list[float]()
    params = MACHINE.params.read({"starts": "400", "kind": "either"})
    MACHINE.designed(params, Progress(lambda _, share: shares.append(share)))
    assert shares == sorted(shares)
    assert len(set(shares)) > 3
    with pytest.raises(Cancelled):
        MACHINE.designed(params, Progress(cancelled=lambda: len(shares) > 0))


NINE = "(18mm,66mm) (30mm,88mm) (21mm,94mm) (6mm,90mm) (-9mm,78mm) (-21mm,59mm) (-24mm,42mm) (-18mm,34mm) (-4mm,41mm)"
SEVEN = "(18mm,66mm) (30mm,86mm) (23mm,94mm) (6mm,90mm) (-11mm,75mm) (-22mm,57mm) (-24mm,41mm)"
THREE_ANGLES = "0deg free free -28deg free free -3deg"


def test_nine_points_are_met_exactly_by_every_four_bar_that_does_and_each_is_proven() -> None:
    said = answer(points=NINE, exact="yes", count="10")
    results = json.loads(json.dumps(said.as_json()))["results"]
    assert (results["paths"], results["every_path_ended"]) == (1442, True)
    assert results["real"] == results["certified"] == results["found"] + sum(results["left_out"].values()) == 300
    assert results["found"] == len(results["candidates"]) == 4
    points = (
        np.array([18 + 66j, 30 + 88j, 21 + 94j, 6 + 90j, -9 + 78j, -21 + 59j, -24 + 42j, -18 + 34j, -4 + 41j]) * 1e-3
    )
    for found in results["candidates"]:
        seen = judge(four_bar(found), PrecisionTask(points=points))
        assert (seen.one_branch, seen.in_order, seen.point_error < 1e-11) == (True, True, True)
        assert found["certified"]
        assert found["within"] < 1e-12
    curves = [found["curve"] for found in results["candidates"]]
    assert sorted(curves.count(curve) for curve in set(curves)) == [2, 2]
    best = results["candidates"][0]
    assert [round(1e3 * best[name], 1) for name in LINKS] == [89.2, 30.1, 75.3, 69.2]
    assert any(table.name == "path-four-bar-proof" for table in said.tables)
    drawn = figure(four_bar(best), four_bar(results["candidates"][1]))
    assert np.array_equal(POINTS_OF_FIGURE, points)
    path = next(stroke.points for stroke in drawn.strokes if stroke.role == "path")
    assert np.abs(path[:, None] - points).min(axis=0).max() < 1e-3


def test_poses_and_points_together_are_met_exactly() -> None:
    results = answer(points=SEVEN, exact="yes", coupler_angles=THREE_ANGLES).as_json()["results"]
    assert (results["paths"], results["every_path_ended"], results["found"]) == (201, True, 5)
    for found in results["candidates"]:
        drawn = four_bar(found)
        seen = judge(drawn, PrecisionTask(points=np.array([18 + 66j, 6 + 90j, -24 + 41j]) * 1e-3, coupler=FREE_ANGLES))
        assert seen.met
        assert max(found["point_errors"]) < 1e-11


FREE_ANGLES = np.radians([0, -28, -3])


def test_without_a_four_bar_the_limit_to_loosen_is_named() -> None:
    said = answer(points=SEVEN, exact="yes", coupler_angles=THREE_ANGLES, transmission_min="60deg")
    results = said.as_json()["results"]
    assert results["found"] == 0
    assert "one_branch=no gives 10" in " ".join(results["loosened"])
    assert results["left_out"]["transmission"] == 5


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"points": SEVEN, "exact": "yes"}, "nine points"),
        ({"points": SEVEN, "exact": "yes", "coupler_angles": "0deg free 20deg"}, "7 points and 3 angles"),
        ({"points": SEVEN, "coupler_angles": THREE_ANGLES}, "set exact=yes"),
        ({"points": SEVEN, "exact": "yes", "coupler_angles": "0deg free free free free free 3deg"}, "2 and 6"),
        (
            {"points": SEVEN, "exact": "yes", "coupler_angles": THREE_ANGLES, "crank": "..30mm"},
            "bounds are for the search",
        ),
        ({"points": NINE, "exact": "yes", "pivots": "(0,0) (1mm,0)"}, "leave pivots out"),
        ({"points": SEVEN, "exact": "yes", "coupler_angles": "0deg loose"}, "coupler_angles"),
    ],
)
def test_exact_tasks_that_leave_something_free_are_refused(settings: dict[str, str], words: str) -> None:
    with pytest.raises(ParameterError, match=words):
        answer(**settings)
