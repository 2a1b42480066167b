"""The knotting dyad: what it answers, and what it refuses."""

import json
import math
from typing import Any

import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.knotting_dyad import MACHINE, KnottingDyadParams, design, search
from ilmek.machines.knotting_dyad.section import section_of
from ilmek.plane.solids import is_closed
from ilmek.report import Drawing, Report
from ilmek.units import deg

POINTS = "(12mm,4mm) (18.5mm,9.5mm) (24mm,8mm) (27mm,3mm)"
ANGLES = "20deg 65deg 100deg 150deg"
CIRCLE = "(10mm,0) (0,10mm) (-10mm,0) (0,-10mm)"
LINE = "(0,0) (10mm,0) (20mm,0) (30mm,0)"


def answer(**settings: str) -> Report:
    return MACHINE.report(design(KnottingDyadParams.read(settings)))


def test_given_points_are_met_by_every_solution_by_the_names_that_are_promised() -> None:
    said = answer(points=POINTS, angles=ANGLES).as_json()
    assert json.dumps(said)
    points, angles = np.array([12 + 4j, 18.5 + 9.5j, 24 + 8j, 27 + 3j]) * 1e-3, np.array([20, 65, 100, 150]) * deg
    assert len(said["results"]["solutions"]) in (1, 3)
    for found in said["results"]["solutions"]:
        assert {"a0", "theta0", "a1", "a2", "pivot_x", "pivot_y"} < set(found)
        pivot = complex(found["pivot_x"], found["pivot_y"])
        assert found["a0"] * np.exp(1j * found["theta0"]) == pytest.approx(pivot, abs=1e-15)
        elbow = pivot + found["a1"] * np.exp(1j * angles)
        assert np.abs(points - elbow) == pytest.approx(np.full(4, found["a2"]), abs=1e-14)
    assert said["checks"][0]["ok"]
    assert MACHINES["knotting-dyad"] is MACHINE


def test_points_on_a_circle_are_reported_and_fail_where_no_other_arm_is() -> None:
    said = answer(points=CIRCLE, angles="0 100deg 170deg 300deg")
    results = said.as_json()["results"]
    assert any("first link has no length" in kind for kind in results["roots"])
    assert any("first link has no length" in warning for warning in said.warnings)
    still = next(found for found in results["solutions"] if found["a1"] == 0)
    assert still["a2"] == pytest.approx(0.01, rel=1e-12)


@pytest.mark.parametrize("settings", [{}, {"cloth.warp_pitch": "10mm"}, {"points": POINTS, "angles": ANGLES}])
def test_the_angle_off_straight_is_that_of_the_triangle_of_each_arm(settings: dict[str, str]) -> None:
    """The sine between two sides of a triangle is twice its area over their product, and the area is Heron's."""
    made = design(KnottingDyadParams.read(settings))
    for arm, bend in zip(made.dyads, made.bends.tolist(), strict=True):
        if bend > 0:
            a, b, c = abs(arm.first), abs(arm.second), np.abs(made.task.path - arm.pivot)
            s = (a + b + c) / 2
            sines = 2 * np.sqrt(s * (s - a) * (s - b) * (s - c)) / (a * b)
            assert bend == pytest.approx(sines.min(), rel=1e-9)
    assert (max(made.bends) > 0) == (made.head is not None)


def test_the_warning_names_the_least_distance_and_what_would_help() -> None:
    closed = {"opening": "0mm", "pair_opened": "2mm", "cloth.yarns.warp_diameter": "0.8mm"}
    (warning,) = answer(clearance="0.55mm", **closed).warnings
    assert warning.startswith("arms to warps: 0.32 mm, 0.55 mm is required; take a needle of 0.1 mm or less")


def test_points_on_a_line_say_which_root_is_infinitely_far() -> None:
    said = answer(points=LINE, angles=ANGLES)
    assert any("the points lie on a line" in kind for kind in said.as_json()["results"]["roots"])
    assert not any(found["a1"] == 0 for found in said.as_json()["results"]["solutions"])


def test_an_elbow_on_both_sides_is_a_failed_check_and_a_warning() -> None:
    said = answer(points=POINTS, angles=ANGLES)
    assert ["off straight" in check.name for check in said.failed] == [True]
    assert "on both sides" in said.warnings[-1]
    table = next(table for table in said.tables if table.name == "knotting-dyad-arms")
    assert "on both sides" in [row[-1] for row in table.rows]


def test_figures_show_every_arm_and_the_points() -> None:
    every, poses = answer(points=POINTS, angles=ANGLES).figures
    assert isinstance(every, Drawing)
    assert isinstance(poses, Drawing)
    links = [stroke for stroke in every.strokes if stroke.role == "link"]
    assert len(links) == 2 * len(answer(points=POINTS, angles=ANGLES).as_json()["results"]["solutions"])
    assert {"P1", "P2", "P3", "P4", "O1"} <= {dot.label for dot in every.dots}
    joints = {complex(np.round(stroke.points[-1], 12)) for stroke in links}
    assert complex(np.round(0.012 + 0.004j, 12)) in joints
    assert all(math.isfinite(abs(place)) for place in joints)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"points": POINTS}, "points are given without angles"),
        ({"angles": ANGLES}, "angles are given without points"),
        ({"points": POINTS, "angles": "20deg 65deg 100deg"}, "4 points and 3 angles"),
        ({"points": "(1mm,2mm) (3mm,1mm) (5mm,2mm)", "angles": "1deg 2deg 3deg"}, "exactly 4; for 3: crank_of_pivot"),
        ({"points": POINTS + "(1mm,1mm)", "angles": ANGLES + " 170deg"}, "for 5: cranks_through_five_points"),
        ({"points": POINTS + "(1mm,1mm) (2mm,9mm)", "angles": ANGLES + " 170deg 180deg"}, "given 6 timed points"),
        ({"points": "(1mm,2mm) " * 4, "angles": "5deg 10deg 5deg 20deg"}, "timed points 1 and 3 are the same"),
        (
            {"points": "(1mm,2mm) " * 4, "angles": "5deg 10deg 15deg 20deg"},
            "all points of the dyad's task are the same",
        ),
        ({"points": POINTS, "angles": "20 65 100 150"}, "20 has no unit; did you mean 20deg"),
        ({"points": POINTS, "angles": "20rad 65rad 100rad 150rad"}, "angles are in radians: 150 deg would be"),
        ({"points": POINTS, "angles": "20mm 65deg 100deg 150deg"}, "'20mm' has the wrong unit"),
        ({"points": POINTS, "angles": " "}, "no list of angles"),
        ({"points": "(12,4) (18,9) (24,8) (27,3)", "angles": ANGLES}, "12 has no unit; did you mean 12mm"),
        ({"points": "12mm,4mm", "angles": ANGLES}, "no list of points"),
        ({"points": POINTS + " and so on", "angles": ANGLES}, "no list of points"),
        ({"points": CIRCLE, "angles": "0 90deg 180deg 270deg"}, "a family of dyads"),
        ({"points": LINE, "angles": "95deg 125deg 250deg 125deg"}, "points lie on a line: no arm of finite links"),
        ({"depth": "0.5mm"}, "is among the warps; a depth of 0.723 mm or more"),
        ({"knot": "symmetrical"}, "did you mean symmetric"),
        ({"cloth.warp_pitch": "2"}, "did you mean 2mm"),
    ],
)
def test_refuses_in_words(settings: dict[str, str], said: str) -> None:
    with pytest.raises(ParameterError) as refused:
        answer(**settings)
    assert said in str(refused.value)


@pytest.mark.parametrize(
    ("settings", "failed"),
    [
        ({"cloth.yarns.warp_diameter": "2.2mm"}, "gap between two warps"),
        ({"link_limit": "5mm"}, "longest link of the arm to build"),
        ({"bend_limit": "89deg"}, "angle between its links, off straight, along the path"),
        ({"pivot_room": "1m"}, "room of the motors between the pivots"),
        ({"opening": "0mm", "pair_opened": "2mm"}, "needle and pile yarn together, between the pair"),
        ({"opening": "0mm"}, "needle and pile yarn together, beside the pair"),
        ({"cloth.yarns.pile_density": "4g/m", "pair_opened": "2mm"}, "pile yarn in the gap between the warps"),
        ({"needle_breadth": "0.02mm", "needle_diameter": "0.1mm"}, "needle against buckling under the yarn's pull"),
        ({"gear_ratio": "9000"}, "servos of the joints"),
    ],
)
@pytest.mark.one_in(2)
def test_what_cannot_be_kept_is_a_failed_check_and_drops_none(settings: dict[str, str], failed: str) -> None:
    usual, hard = answer(), answer(**settings)
    assert not usual.failed
    assert [check.name for check in hard.checks] == [check.name for check in usual.checks]
    assert any(check.name.startswith(failed) and check.cure for check in hard.failed)


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("knot", ["symmetric", "asymmetric"])
@pytest.mark.parametrize("pitch", ["0.25mm", "0.5mm", "1mm", "2mm", "4mm"])
def test_arms_with_an_opener_tie_both_knots_at_every_pitch_with_needle_and_yarn_in_the_gap(
    pitch: str, knot: str
) -> None:
    """The widths again, from the coordinates of the warps and the tilt at the hand-over."""
    made = design(KnottingDyadParams.read({"cloth.warp_pitch": pitch, "knot": knot}))
    report = MACHINE.report(made)
    assert not report.failed
    assert report.as_json()["results"]["knot_tied"] == knot
    assert made.head is not None
    section = made.head.section
    left, first, second = section.warps[5:8].real
    needle = made.head.arm.path(np.array([1.0])).theta[0, 1]
    across = (first - left) * abs(math.sin(needle))
    assert across - section.warp >= section.needle + section.yarn - 1e-9
    assert second - first - section.warp >= section.needle + section.yarn - 1e-9


def test_a_given_depth_widens_the_gaps_and_a_depth_that_no_gap_helps_fails() -> None:
    shallow, usual = (design(KnottingDyadParams(depth=depth)).head for depth in (3e-3, None))
    assert shallow is not None
    assert usual is not None
    assert shallow.section.outer > usual.section.outer
    assert shallow.section.beside == pytest.approx(shallow.section.needle + shallow.section.yarn, rel=1e-9)
    names = [check.name for check in answer(depth="1mm").failed]
    assert "needle and pile yarn together, beside the pair" in names


def test_arms_whose_pivots_lie_behind_their_servos_have_a_plate_with_all_bores() -> None:
    """Needles of 14 mm and a hand-over 100 mm deep: checks fail, and the plate still has a closed mesh."""
    made = MACHINE.design(KnottingDyadParams(needle_breadth=14e-3, depth=0.1))
    assert MACHINE.report(made, illustrated=False).failed
    assert MACHINE.tree is not None
    assert all(part.shape is None or is_closed(part.shape.mesh()) for part, _ in MACHINE.tree(made).occurrences())


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("pitch", ["2mm", "6mm"])
def test_the_arm_does_not_depend_on_the_rounding_of_a_processor(
    pitch: str, seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each parameter of the grid is moved by its last digit, as another exp or log moves it."""
    params = KnottingDyadParams.read({"cloth.warp_pitch": pitch})
    usual, rng, tried = search.best_arm(params, section_of(params)), np.random.default_rng(seed), search._tried

    def moved(*arguments: Any) -> Any:
        params, section, at, sign = arguments
        return tried(params, section, np.nextafter(at, at + rng.choice([-1.0, 0.0, 1.0], size=at.shape)), sign)

    monkeypatch.setattr(search, "_tried", moved)
    arm = search.best_arm(params, section_of(params))
    assert arm.pivot == pytest.approx(usual.pivot, abs=1e-10)
    assert (arm.first, arm.second) == pytest.approx((usual.first, usual.second), abs=1e-10)
