"""`ilmek mechanism` on the shipped examples and on files that are wrong: what it says, gives and refuses."""

import csv
import io
import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from ilmek.cli import main
from ilmek.io.mechanism_file import parse_mechanism, read_mechanism
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.tufting.model import mechanism as tufting
from ilmek.machines.tufting.model import move
from ilmek.machines.tufting.params import TuftingParams

EXAMPLES = Path(__file__).parents[2] / "examples"
MECHANISMS = sorted(EXAMPLES.glob("*.toml"), key=lambda path: path.name)
MECHANISMS = [path for path in MECHANISMS if "[bodies" in path.read_text(encoding="utf-8")]


def called(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["mechanism", *arguments])


def run(*arguments: str) -> str:
    result = called(*arguments)
    assert result.exit_code == 0, result.stderr
    return result.stdout


def example(name: str) -> str:
    return str(EXAMPLES / f"{name}.toml")


def test_there_are_examples():
    assert {path.stem for path in MECHANISMS} >= {"peaucellier", "jansen_leg", "tufting_needle"}


def test_peaucellier_draws_a_straight_line():
    found = json.loads(run(example("peaucellier"), "--over", "-40deg..40deg", "--json", "-"))
    place = np.array(found["points"]["ar"]["R"]["position"])
    np.testing.assert_allclose(place[:, 0], (0.25**2 - 0.1**2) / (2 * 0.08), rtol=1e-13)
    assert np.ptp(place[:, 1]) > 0.2
    assert set(found["status"]) == {"OK"}


def test_jansens_foot_strides_flat():
    """The foot's path of the holy numbers: longer than 60 mm, and flat within 2 mm for half of the turn."""
    motion = solve(read_mechanism(EXAMPLES / "jansen_leg.toml").plan(), np.arange(360) * np.pi / 180).require()
    foot = motion.point("leg", "F").position
    assert 0.060 < np.ptp(foot.real) < 0.075
    low = foot[foot.imag < foot.imag.min() + 0.002]
    assert np.ptp(low.real) > 0.045


def test_the_tufting_example_is_the_tufting_machine():
    params, angle = TuftingParams(), np.linspace(0, 6, 25)
    machine = move(params, plan(tufting(params)), angle).point("needle", "F")
    found = solve(read_mechanism(EXAMPLES / "tufting_needle.toml").plan(), angle, params.speed).point("needle", "F")
    for field in ("position", "velocity", "acceleration"):
        ours, theirs = getattr(found, field), getattr(machine, field)
        np.testing.assert_allclose(ours, theirs, atol=1e-12 * np.abs(theirs).max() * 100)


def test_one_pose_gives_numbers_of_one_sample():
    found = json.loads(run(example("tufting_needle"), "--at", "30deg", "--json", "-"))
    motion = solve(read_mechanism(EXAMPLES / "tufting_needle.toml").plan(), np.pi / 6)
    assert found["points"]["needle"]["F"]["position"] == [
        [motion.point("needle", "F").position[0].real, motion.point("needle", "F").position[0].imag]
    ]
    assert found["bodies"]["crank"]["angle"] == [pytest.approx(np.pi / 6)]


def test_csv_has_every_number_of_the_motion():
    table = list(csv.reader(io.StringIO(run(example("jansen_leg"), "--speed", "60rpm", "--steps", "36", "--csv", "-"))))
    assert table[0][0] == "crank [rad]"
    assert len(table) == 1 + 37
    motion = solve(read_mechanism(EXAMPLES / "jansen_leg.toml").plan(), np.linspace(0, 2 * np.pi, 37), 2 * np.pi)
    column = [float(line[table[0].index("leg.F vx [m/s]")]) for line in table[1:]]
    np.testing.assert_array_equal(column, motion.point("leg", "F").velocity.real)


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("path", MECHANISMS, ids=lambda path: path.stem)
def test_every_example_makes_a_page_with_a_moving_figure(path: Path, tmp_path: Path):
    page = tmp_path / "page.html"
    shown = run(str(path), "--report", str(page), *(["--over", "-40deg..40deg"] if path.stem == "peaucellier" else []))
    assert "freedoms: 1" in shown
    assert "mobility: 1 degree of freedom by count and by rank" in shown
    assert "in motion" in page.read_text(encoding="utf-8")


def test_a_mechanism_that_closes_only_partly_says_its_ranges_to_the_end():
    """P may come as near to O as the arms are longer than the rhombus' sides: 160 mm cos(crank / 2) = 150 mm."""
    result = called(example("peaucellier"), "--json", "-")
    assert result.exit_code == 0
    assert "note: Peaucellier cannot close for crank " in result.stderr
    end = 2 * math.acos(150 / 160)
    first, last = json.loads(result.stdout)["results"]["closes"]
    assert first == pytest.approx([0, end], abs=1e-10)
    assert last == pytest.approx([2 * math.pi - end, 2 * math.pi], abs=1e-10)


def test_a_toml_file_as_toml_keeps_its_text_and_comments():
    path = EXAMPLES / "jansen_leg.toml"
    assert run(str(path), "--as", "toml") == path.read_text(encoding="utf-8")


def test_the_same_file_in_the_other_form(tmp_path: Path):
    text = run(example("peaucellier"), "--as", "json")
    assert parse_mechanism(text, toml=False).mechanism == read_mechanism(EXAMPLES / "peaucellier.toml").mechanism


FOUR_BAR = four_bar(0.3, 0.06, 0.2, 0.23, branch=1)
WRONG = {
    "missing file": (["gone.toml"], "mechanism file gone.toml does not exist"),
    "unknown input": ([example("peaucellier"), "--at", "rank=1"], "Peaucellier has no input 'rank'; it has crank"),
    "held twice": ([example("peaucellier"), "--at", "1", "--at", "2"], "fixes the input twice"),
    "no range": ([example("peaucellier"), "--over", "3"], "write FROM..TO, like 0deg..360deg"),
    "empty range": ([example("peaucellier"), "--over", "1rad..1rad"], "has no length"),
    "no unit": ([example("jansen_leg"), "--at", "350"], "350 has no unit; write 350deg"),
    "no speed": ([example("jansen_leg"), "--speed", "0rpm"], "speed 0rpm of 'crank'"),
    "wrong unit": ([example("peaucellier"), "--over", "1mm..2mm"], "'1mm' has the wrong unit"),
    "wrong speed": ([example("peaucellier"), "--speed", "3mm"], "'3mm' has the wrong unit"),
    "closes nowhere": ([example("peaucellier"), "--at", "180deg"], "Peaucellier cannot close for crank 180"),
    "closes nowhere over a range": (
        [example("peaucellier"), "--over", "150deg..210deg"],
        "Peaucellier cannot close for crank 150.0°..210.0°: |P-O| ",
    ),
    "two on one stream": ([example("peaucellier"), "--csv", "-", "--json", "-"], "both --csv and --json"),
    "csv into no folder": ([example("peaucellier"), "--csv", "gone/a.csv"], "there is no folder"),
    "no steps": ([example("peaucellier"), "--steps", "0"], "0 is not in the range"),
}


@pytest.mark.parametrize(("arguments", "said"), WRONG.values(), ids=WRONG.keys())
def test_what_is_wrong_is_one_line_and_exit_code_2(arguments: list[str], said: str):
    result = called(*arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert result.stderr.count("\n") == 1
    assert result.stdout == ""


def test_a_mistake_in_a_file_is_told_at_the_command_line(tmp_path: Path):
    path = tmp_path / "mine.toml"
    path.write_text(
        (EXAMPLES / "peaucellier.toml").read_text("utf-8").replace('"arm_a", "arm_b"]', '"arm_x", "arm_b"]', 1), "utf-8"
    )
    result = called(str(path))
    assert result.exit_code == 2
    assert result.stderr.startswith(f"ilmek: {path}, line 19, joints.O: Peaucellier has no body 'arm_x'; it has")
