"""`ilmek study`: its words, its exit codes, its files."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from processes import ended, ilmek
from study_targets import FOUR_BAR

from ilmek import read_mechanism, study
from ilmek.cli import main
from ilmek.errors import MechanismError
from ilmek.units import deg

SWING = ("--vary", "swing=28deg..32deg")
TOLERANCE = ("--vary", "swing=30deg+-0.2deg", "--method", "tolerance", "--record", "drive_torque_max")
GOAL = ("--goal", "drive_torque_max")


def call(*words: str) -> Result:
    """The command run on the beat-up."""
    return CliRunner().invoke(main, ["study", "beat-up", *words])


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--vary", "swinge=20deg..40deg"), "did you mean 'swing'?"),
        (("--vary", "swing=200deg..400deg"), "out of bounds"),
        (("--vary", "swing=40deg..20deg"), "give the lower value first"),
        (("--vary", "swing=abc"), "a range FROM..TO"),
        ((*SWING, "--goal", "drive_torque"), "did you mean"),
        ((*SWING, "--method", "local"), "name one with --goal"),
        ((*SWING, *GOAL, "--hold", "drive_torque_max >= 3kg"), "N*m is required"),
        ((*SWING, "--resume"), "--out FILE.sqlite"),
        ((*SWING, "--set", "swing=30deg"), "varies and is set"),
        ((), "nothing varies"),
        ((*SWING, *GOAL, "--yield", "99%"), "they are of --method tolerance"),
        ((*TOLERANCE, "--yield", "120%"), "below 100%"),
        ((*TOLERANCE, "--yield", "99%", "--cost", "swinge=2"), "did you mean 'swing'?"),
        ((*TOLERANCE, "--correlate", "swing: beta"), 'write "NAME, NAME = 0.8"'),
    ],
)
def test_bad_words_are_one_error(words: tuple[str, ...], said: str) -> None:
    found = call(*words)
    assert found.exit_code == 2
    assert said in found.stderr
    assert len(found.stderr.splitlines()) == 1


@pytest.mark.parametrize(
    ("table", "words", "said"),
    [
        ("swinge\n30deg\n", (), "did you mean 'swing'?"),
        ("swing\n30deg\n400deg\n", (), "line 3: swing=400 deg is out of bounds"),
        ("swing,speed\n30deg\n", (), "line 2: 1 cell"),
        ("swing\n", (), "no row below the headings"),
        ("swing\n30deg\n", SWING, "--designs with --vary"),
        ("swing\n30deg\n", ("--set", "swing=30deg"), "varies and is set"),
    ],
)
def test_bad_tables_of_designs_are_one_error(tmp_path: Path, table: str, words: tuple[str, ...], said: str) -> None:
    file = tmp_path / "designs.csv"
    file.write_text(table)
    found = call("--designs", str(file), *words)
    assert (found.exit_code, len(found.stderr.splitlines())) == (2, 1)
    assert said in found.stderr


def test_designs_of_a_table_are_those_of_its_rows(tmp_path: Path) -> None:
    """What a study wrote as a table is read again: plain numbers are SI."""
    file = tmp_path / "designs.csv"
    file.write_text("# two of three\nswing;link_mass\n0.5;made\n31deg;bars\n")
    found = json.loads(call("--designs", str(file), *GOAL, "--json", "-").stdout)
    assert (found["samples"], found["done"]) == (2, 2)
    assert found["best"]["parameters"] in (
        {"swing": 0.5, "link_mass": "made"},
        {"swing": 31 * deg, "link_mass": "bars"},
    )


def test_a_study_writes_its_files_and_goes_on(tmp_path: Path) -> None:
    out, table, page = tmp_path / "s.sqlite", tmp_path / "s.csv", tmp_path / "s.html"
    words = (*SWING, *GOAL, "--sampling", "grid", "--samples", "3", "--out", str(out))
    first = call(*words, "--csv", str(table), "--report", str(page), "--json", "-")
    found = json.loads(first.stdout)
    assert (first.exit_code, found["samples"], found["done"]) == (0, 3, 3)
    assert found["best"]["parameters"]["swing"] == pytest.approx(0.4886921905584123)
    assert table.read_text().splitlines()[0] == "swing,drive_torque_max,failed,worst"
    assert "drive_torque_max over swing" in page.read_text()
    assert "Designs" in page.read_text()
    again = call(*words, "--resume", "--json", "-")
    assert json.loads(again.stdout)["digest"] == found["digest"]
    assert "exists" in call(*words).stderr
    design = CliRunner().invoke(main, [*found["best"]["command"].split()[1:], "--json", "-"])
    assert json.loads(design.stdout)["results"]["drive_torque_max"] == found["best"]["results"]["drive_torque_max"]


def test_the_table_as_parquet_is_that_of_csv(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    csv, file = tmp_path / "s.csv", tmp_path / "s.parquet"
    words = ("--vary", "law=cycloidal, modified-sine", "--record", "prime_radius", "--csv", str(csv))
    assert CliRunner().invoke(main, ["study", "cam", *words, "--parquet", str(file)]).exit_code in (0, 3)
    found = parquet.read_table(file).to_pydict()
    heads, *rows = (line.split(",") for line in csv.read_text().splitlines())
    assert list(found) == heads
    assert [[str(cell) for cell in row] for row in zip(*found.values(), strict=True)] == rows


def test_listed_values_are_taken_once_each_and_stand_in_the_table() -> None:
    words = ("--vary", "law=cycloidal, modified-sine", "--vary", "lift=20mm, 30mm", "--record", "prime_radius")
    found = CliRunner().invoke(main, ["study", "cam", *words, "--csv", "-"])
    rows = [row.split(",")[:2] for row in found.stdout.splitlines()]
    pairs = [[law, lift] for law in ("cycloidal", "modified-sine") for lift in ("0.02", "0.03")]
    assert rows == [["law", "lift"], *pairs]


def test_a_study_without_a_design_that_holds_ends_with_3() -> None:
    found = call(*SWING, *GOAL, "--samples", "2", "--hold", "drive_torque_max <= 0.1 N*m")
    assert found.exit_code == 3
    assert "drive_torque_max <= limit fails in 100%" in found.stdout


def test_a_time_limit_holds_for_one_process_too() -> None:
    """The command works beside the main thread, which alone can be interrupted."""
    done = ended(ilmek("study", "beat-up", *SWING, *GOAL, "--samples", "2", "--time-limit", "100s", "--json", "-"))
    assert json.loads(done.stdout)["done"] == 2
    slow = ended(ilmek("study", "beat-up", *SWING, *GOAL, "--samples", "1", "--time-limit", "1ms", "--json", "-"))
    assert json.loads(slow.stdout)["results"]["reasons"] == [["timeout", "longer than 0.001 s", 1]]


def test_a_wrong_word_leaves_the_results_file_that_it_would_replace(tmp_path: Path) -> None:
    out = tmp_path / "s.sqlite"
    words = (*SWING, "--samples", "2", "--out", str(out), "--force")
    assert call(*words, *GOAL).exit_code == 0
    before = out.read_bytes()
    assert call(*words, "--goal", "drive").exit_code == 2
    assert out.read_bytes() == before
    assert call(*words, *GOAL, "--seed", "1").exit_code == 0
    assert out.read_bytes() != before


def test_a_study_file_gives_the_words(tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text('target = "beat-up"\ngoals = ["drive_torque_max"]\nsamples = 2\n[vary]\nswing = "28deg..32deg"\n')
    found = CliRunner().invoke(main, ["study", str(file), "--json", "-"])
    assert json.loads(found.stdout)["samples"] == 2
    file.write_text('target = "beat-up"\ngoal = "drive_torque_max"\n')
    wrong = CliRunner().invoke(main, ["study", str(file)])
    assert "line 2: unknown key 'goal'" in wrong.stderr
    assert "did you mean 'goals'?" in wrong.stderr


def test_a_mechanism_varies_by_its_values() -> None:
    words = ("--vary", "stroke=55mm..65mm", "--goal", "drive_torque_rms", "--sampling", "grid", "--samples", "2")
    found = CliRunner().invoke(main, ["study", "examples/slider_crank_press.toml", *words, "--json", "-"])
    best = json.loads(found.stdout)["best"]
    assert best["command"].endswith("examples/slider_crank_press.toml --set stroke=55mm")
    one = CliRunner().invoke(main, [*best["command"].split()[1:], "--json", "-"])
    assert json.loads(one.stdout)["results"]["drive_torque_rms"] == best["results"]["drive_torque_rms"]


def test_a_mechanism_that_was_read_is_studied_as_its_file() -> None:
    path, vary = "examples/slider_crank_press.toml", {"stroke": "55mm..65mm"}
    more = {"goals": ["drive_torque_rms"], "fixed": {"rod": "130mm"}, "samples": 3}
    read = study(read_mechanism(path), vary, **more)
    assert read.digest == study(path, vary, **more).digest
    assert read.command(0).startswith(f"ilmek mechanism {path} --set rod=130mm --set stroke=")
    with pytest.raises(MechanismError, match="did you mean 'rod'"):
        study(read_mechanism(path), vary, goals=["drive_torque_rms"], fixed={"rods": "1mm"})


def test_tolerances_of_a_wanted_yield_are_found_and_proven(tmp_path: Path) -> None:
    """The crank's tolerance costs twice and makes the torque spread: it alone is tightened."""
    file = tmp_path / "four_bar.toml"
    file.write_text(FOUR_BAR)
    order = tmp_path / "study.toml"
    order.write_text(
        'target = "four_bar.toml"\nmethod = "tolerance"\nsamples = 16\nyield = "95%"\n'
        'hold = ["drive_torque_max <= 0.3925 N*m"]\ncorrelate = ["a, b = 0.3"]\n'
        '[vary]\na = "60mm+-0.5mm"\nb = "200mm+-1mm"\n[cost]\na = 2\n'
    )
    found = json.loads(CliRunner().invoke(main, ["study", str(order), "--json", "-"]).stdout)["results"]["allocation"]
    assert found["factors"]["a"] < 1 < found["factors"]["b"]
    assert found["expected"] == pytest.approx(0.95, abs=1e-6)
    assert found["found"]["high"] >= 0.95
