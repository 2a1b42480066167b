"""The four-bar for a motion: what it answers for three, four and five poses, and what it refuses."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from ilmek.cli import main
from ilmek.errors import ParameterError
from ilmek.io.mechanism_file import read_mechanism
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.motion_four_bar import MACHINE
from ilmek.params.text_lists import read_poses
from ilmek.report import Animation, Report
from ilmek.synthesis.burmester.links import Guide, GuideKind
from ilmek.synthesis.four_bar import FourBar

THREE = "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"
FOUR = "(0mm,0mm,35deg) (40mm,22mm,12deg) (78mm,12mm,-22deg) (92mm,-28mm,-60deg)"
FIVE = "(0mm,0mm,0deg) (15mm,6mm,10deg) (28mm,8mm,24deg) (40mm,5mm,40deg) (50mm,-3mm,55deg)"
FAR = "(40mm,22mm,35deg) (52mm,60mm,30deg) (43mm,86mm,26deg) (21mm,98mm,23deg) (1mm,94mm,22deg)"
"""Five poses whose only four-bar without defects has a pivot a metre away."""

LINKS = ("ground", "crank", "coupler", "rocker")


def answer(**settings: str) -> Report:
    return MACHINE.report_for(settings)


def four_bar(found: dict[str, list[float]]) -> FourBar:
    return FourBar(*(complex(*found[name]) for name in ("a0", "b0", "a", "b", "tracer")))


@pytest.mark.parametrize("text", [THREE, FOUR, FIVE], ids=["three", "four", "five"])
def test_every_solution_takes_the_poses_on_one_branch_when_it_is_moved(text: str) -> None:
    said = answer(poses=text, samples="40")
    results = json.loads(json.dumps(said.as_json()))["results"]
    points, angles = read_poses("poses", text)
    assert results["solutions"]
    for found in results["solutions"]:
        drawn = four_bar(found)
        motion = solve(plan(drawn.mechanism()), np.array(found["crank_angles"]))
        assert np.abs(motion.point("coupler", "P").position - points).max() < 1e-10
        turned = motion.direction("coupler") * np.exp(-1j * (angles - angles[0]))
        assert np.abs(turned - turned[0]).max() < 1e-9
        assert set(found["branches"]) <= {drawn.branch, 0}
        assert max(found[name] for name in LINKS) <= 10 * min(found[name] for name in LINKS)
    worth = [found["merit"] for found in results["candidates"]]
    assert worth == sorted(worth, reverse=True)
    assert all(found["certified"] for found in results["candidates"])
    assert sum(isinstance(figure, Animation) for figure in said.figures) == 1
    assert not [check for check in said.failed if check.name != "transmission angle"]
    assert MACHINES["motion-four-bar"] is MACHINE


def test_five_poses_list_every_link_and_judge_every_pair_both_ways() -> None:
    results = answer(poses=FIVE).as_json()["results"]
    assert len(results["links"]) == 4
    assert len(results["solutions"]) + len(results["removed"]) + 1 == results["judged"] == 12
    assert results["sieve"].startswith("12 four-bars: 6 kept, 6 removed")
    assert results["removed_counts"]["transmits"] == 1
    points, angles = read_poses("poses", FIVE)
    for link in results["links"]:
        guide = Guide(GuideKind(link["kind"]), complex(*link["pivot"]), complex(*link["pin"]))
        assert np.ptp(guide.reach(points, angles)) < 1e-12


def test_four_poses_give_both_curves_and_a_crank_that_turns_where_it_is_asked() -> None:
    results = answer(poses=FOUR, samples="40", full_turn="yes").as_json()["results"]
    assert {"pivots", "pins"} == set(results["curves"])
    assert sum(len(branch["places"]) for branch in results["curves"]["pivots"]) >= 39
    assert all(found["crank_turns"] for found in results["solutions"])


def test_pivots_and_pins_that_are_given_are_those_of_the_answer() -> None:
    loose = {"one_circuit": "no", "one_branch": "no", "in_order": "no"}
    results = answer(pivots="(0,-40mm) (40mm,-30mm)", **loose).as_json()["results"]
    given = np.array([[0, -0.04], [0.04, -0.03]])
    assert np.sort([found["a0"] for found in results["solutions"]], axis=0)[[0, -1]] == pytest.approx(given, abs=1e-12)
    results = answer(pins="(0,-10mm) (20mm,-3mm)", link_ratio_max="1000", **loose).as_json()["results"]
    given = np.array([[0, -0.01], [0.02, -0.003]])
    assert np.sort([found["a"] for found in results["solutions"]], axis=0)[[0, -1]] == pytest.approx(given, abs=1e-12)


def test_pivots_stay_within_their_bounds() -> None:
    for text in (THREE, FOUR):
        results = answer(poses=text, pivot_y="..-20mm", pivot_x="-60mm..90mm", samples="24").as_json()["results"]
        assert results["solutions"]
        for found in results["solutions"]:
            assert max(found["a0"][1], found["b0"][1]) <= -0.02 + 1e-10
            across = sorted([found["a0"][0], found["b0"][0]])
            assert -0.06 - 1e-10 <= across[0] <= across[1] <= 0.09 + 1e-10
    said = answer(poses=FIVE, pivot_y="..-20mm")
    assert said.as_json()["results"]["chosen"] is None
    assert "links with a pivot outside pivot_x and pivot_y: 3" in said.warnings[-1]


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"poses": "(0,0,0) (1mm,2mm,3deg)"}, "given 2 poses; 3, 4 or 5 are met exactly; give three at least"),
        ({"poses": FIVE + "(1mm,1mm,9deg)"}, "path-four-bar comes near any number of points"),
        ({"poses": THREE + "(25mm,15mm,3deg)"}, "poses 2 and 4 are the same; remove one or change it"),
        ({"poses": "(0,0) (1mm,2mm) (3mm,4mm)"}, "holds 2 numbers, not 3; poses are written (0mm,0mm,10deg)"),
        ({"poses": "(0mm,0mm,10) (25mm,15mm,3) (30mm,1mm,-25)"}, "10 has no unit; did you mean 10deg"),
        ({"poses": "(0,0,10rad) (25mm,15mm,3rad) (30mm,1mm,-25rad)"}, "-25 deg would be"),
        ({"poses": "(0,0,0) (10mm,0,0) (20mm,9mm,0) (30mm,1mm,0)"}, "the body has the same angle at all poses"),
        (
            {"poses": "(10mm,0,0) (0,10mm,90deg) (-10mm,0,180deg) (0,-10mm,270deg)"},
            "all poses are rotations about one point",
        ),
        ({"poses": FOUR, "pivots": "(0,0) (9mm,0)"}, "pivots are given for 4 poses; three poses leave them free"),
        ({"pivots": "(0,0) (9mm,0)", "pins": "(0,0) (9mm,0)"}, "pivots and pins are given; one of them, or neither"),
        ({"pivots": "(0,0)"}, "pivots holds 1 point; two, one for each link"),
        ({"pins": "(0,0) (0,0)"}, "both pins are one point"),
        ({"pivot_x": "50mm..0mm"}, "did you mean 0mm..50mm"),
        ({"keep_out": "(0,0) (1mm,0) (2mm,0)"}, "keep_out has no area"),
        ({"pivot_region": "(0,0) (9mm,9mm) (9mm,0) (0,8mm)"}, "two sides of pivot_region cross"),
        ({"crank_region": "(0,0)"}, "crank_region holds 1 point"),
        ({"driven": "first"}, "neither pivots nor pins are given"),
        ({"transmission_min": "40"}, "did you mean 40deg"),
        ({"poses": FIVE, "chosen": "9"}, "chosen=9, and there are 5 solutions; 1 to 5"),
    ],
)
def test_refuses_in_words(settings: dict[str, str], said: str) -> None:
    with pytest.raises(ParameterError) as refused:
        answer(**settings)
    assert said in str(refused.value)


def test_the_answer_is_written_as_a_mechanism_file_that_is_read_again(tmp_path: Path) -> None:
    file = tmp_path / "gripper.toml"
    run = CliRunner().invoke(main, ["design", "motion-four-bar", "--to", str(file)])
    assert run.exit_code == 0, run.output
    machine = read_mechanism(file).machine
    assert machine.paths == (("coupler", "P"),)
    results = answer().as_json()["results"]
    motion = solve(plan(machine.mechanism), np.array(results["candidates"][0]["crank_angles"]))
    assert np.abs(motion.point("coupler", "P").position - read_poses("poses", THREE).points).max() < 1e-12


def test_without_a_solution_no_file_is_written_and_the_rest_is_reported(tmp_path: Path) -> None:
    files = ["--to", str(tmp_path / "none.toml"), "--workshop", str(tmp_path / "parts")]
    run = CliRunner().invoke(main, ["design", "motion-four-bar", f"poses={FAR}", "size_max=900mm", *files])
    assert run.exit_code == 3, run.output
    assert "size alone removed 1, the nearest: size 1288 mm, allowed at most 900 mm" in run.output
    assert "none.toml was not written: there is no linkage" in run.output
    assert "parts was not written: there are no links" in run.output
    assert list(tmp_path.iterdir()) == []


def test_links_far_from_their_poses_are_proven() -> None:
    (found,) = answer(poses=FAR).as_json()["results"]["candidates"]
    assert abs(complex(*found["a0"])) > 1
    assert found["certified"]


@pytest.mark.parametrize(
    ("args", "refused"),
    [
        (["cam", "--to", "cam.toml"], "cam has no linkage that --to could write"),
        (["motion-four-bar", "--to", "gripper.txt"], "gripper.txt ends in '.txt'; .toml or .json"),
    ],
)
def test_a_mechanism_file_that_cannot_be_written_is_refused(args: list[str], refused: str) -> None:
    run = CliRunner().invoke(main, ["design", *args])
    assert run.exit_code == 2
    assert refused in run.output


def test_a_line_of_pivots_is_intersected_with_the_curve() -> None:
    results = answer(poses=FOUR, pivot_y="-20mm").as_json()["results"]
    assert results["candidates"]
    for found in results["candidates"]:
        assert abs(found["a0"][1] + 0.02) < 1e-10
        assert abs(found["b0"][1] + 0.02) < 1e-10
