"""`ilmek cyclogram`, its page and its table, and the example file."""

import csv
import io
import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from examples.draw_cyclogram import figure, solved

from ilmek.cams.laws import LAWS
from ilmek.cli import main
from ilmek.io.cyclogram_file import read_cyclogram
from ilmek.jobs.cyclogram import columns
from ilmek.timing.cyclogram import check_cyclogram
from ilmek.timing.track import sample
from ilmek.units import turn
from ilmek.viz.plain import shown_figures
from ilmek.viz.svg import svg

PRESS = str(Path(__file__).parents[2] / "examples" / "press.toml")


def run(*arguments: str) -> tuple[int, str, str]:
    result = CliRunner().invoke(main, ["cyclogram", *arguments])
    return result.exit_code, result.stdout, result.stderr


def test_the_example_is_overlapped_to_a_fifth_of_its_acceleration() -> None:
    found = solved()
    assert found.before / found.after == pytest.approx(5.192, abs=5e-4)
    assert all(check.ok for check in check_cyclogram(found.cyclogram))


def test_a_solved_cyclogram_is_written_read_and_found_solved(tmp_path: Path) -> None:
    quick, page = tmp_path / "quick.toml", tmp_path / "quick.html"
    code, said, _ = run(PRESS, "--solve", "period", "--out", str(quick), "--report", str(page))
    assert code == 0
    assert "period: 1 s -> 0.4279 s" in said
    assert "die: up starts after die: pressed: 1 deg less would reduce the period by" in said
    again = read_cyclogram(quick)
    assert again.period == pytest.approx(0.4278743, rel=1e-6)
    assert all(check.ok for check in check_cyclogram(again))
    html = page.read_text(encoding="utf-8")
    assert 'class="shown wide"' in html
    assert "https://" not in html.replace("https://ilmek.invalid", "").replace("http://www.w3.org", "")


def test_json_says_what_was_won_and_what_binds() -> None:
    code, said, _ = run(PRESS, "--solve", "acceleration", "--json", "-")
    results = json.loads(said)["results"]
    assert code == 0
    assert results["goal"] == "acceleration"
    assert results["before"] / results["after"] == pytest.approx(5.192, abs=5e-4)
    assert sum(one["share"] for one in results["binding"] if one["kind"] == "motion") == pytest.approx(1.0)
    assert {one["kind"] for one in results["binding"]} == {"motion", "relation", "exclusion", "order", "turn"}
    assert set(results["tracks"]) == {"feeder", "die", "ejector"}
    assert results["cyclogram"]["tracks"]["die"]["motions"]["up"]["law"]["constant_velocity"] == 0.2


def test_the_table_has_units_and_derivatives_that_are_derivatives() -> None:
    code, said, note = run(PRESS, "--csv", "-", "--steps", "3600")
    assert code == 3
    assert "1 failed: feeder: out starts after feeder: blank let go" in note
    heads, *rows = csv.reader(io.StringIO(said))
    assert heads[:2] == ["master angle [deg]", "time [s]"]
    table = np.array(rows, dtype=float)
    at = {head: table[:, place] for place, head in enumerate(heads)}
    assert (len(table), table[-1, 0], table[-1, 1]) == (3601, 360.0, 1.0)
    step = at["time [s]"][1]
    speed = np.gradient(at["die position [mm]"], step)
    assert speed[1:-1] == pytest.approx(at["die velocity [mm/s]"][1:-1], abs=2.0)
    bend = np.gradient(at["die velocity [mm/s]"], step)
    assert bend[1:-1] == pytest.approx(at["die acceleration [mm/s^2]"][1:-1], abs=0.02 * 1e5)


def test_columns_are_those_of_the_tracks() -> None:
    press = read_cyclogram(Path(PRESS))
    exact = sample(press.track("feeder"), np.array([0.0, turn / 4, turn]))
    assert columns(press, 4)["feeder position [mm]"][[0, 1, 4]] == pytest.approx(exact.position * 1e3)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["nowhere.toml"], "does not exist"),
        (["weavr"], "neither a cyclogram file nor a machine; a path, or automated-loom, weaver"),
        ([PRESS, "--out", "x.txt"], "ends in '.txt'; .toml or .json"),
        ([PRESS, "--csv", "-", "--json", "-"], "both --csv and --json"),
    ],
)
def test_bad_input_is_one_line(arguments: list[str], said: str) -> None:
    code, shown, told = run(*arguments)
    assert (code, shown) == (2, "")
    assert said in told
    assert told.count("\n") == 1


def test_a_relation_loop_in_a_file_is_named(tmp_path: Path) -> None:
    text = Path(PRESS).read_text(encoding="utf-8")
    back = '[[relations]]\nthen = { track = "die", starts = "down" }\nfirst = { track = "ejector", ends = "out" }\n'
    place = tmp_path / "loop.toml"
    place.write_text(f"{text}\n{back}", encoding="utf-8")
    code, _, told = run(str(place))
    assert code == 2
    assert "a relation loop in the cyclogram cannot hold: " in told
    for one in ("die: down starts after ejector: out ends", "ejector: out starts after die: up past 40 mm"):
        assert one in told


def test_the_drawing_carries_laws_windows_arrows_and_what_the_client_draws() -> None:
    text = svg(figure(solved()))
    for words in ("modified-sine (0.2)", "in the tool", "pressed", "3-4-5"):
        assert words in text
    timing = shown_figures((figure(solved()),))[0].timing
    assert timing is not None
    assert [lane.unit for lane in timing.lanes] == ["mm"] * 3
    cyclogram = solved().cyclogram
    feed, down = cyclogram.tracks[0].segments[0], cyclogram.track("die").segment("down")
    lane, law = timing.lanes[0], LAWS["cycloidal"]
    angle, beta = np.array(lane.angle), feed.end - feed.start
    inside = (angle > feed.start) & (angle < feed.end)
    u, speed = (angle[inside] - feed.start) / beta, 2 * np.pi / cyclogram.period / beta
    exact = (feed.begin + feed.stroke * law.s(u), feed.stroke * speed * law.v(u), feed.stroke * speed**2 * law.a(u))
    for row, values in zip(lane.motion, exact, strict=True):
        assert np.array(row)[inside] == pytest.approx(values, abs=1e-4 * np.abs(values).max())
    move = timing.lanes[1].moves[0]
    assert (move.start, move.end, move.begin, move.finish) == pytest.approx((down.start, down.end, 0.0, 0.1), rel=1e-5)


@pytest.mark.parametrize("name", ["weaver", "automated-loom:row", "automated-loom:knot"])
def test_cyclograms_of_machines_hold_and_are_solved(name: str, tmp_path: Path) -> None:
    place = tmp_path / "machine.json"
    code, said, _ = run(name, "--solve", "acceleration", "--out", str(place))
    assert code == 0
    assert "FAIL" not in said
    again = read_cyclogram(place)
    assert again.relations
    assert all(check.ok for check in check_cyclogram(again))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["automated-loom"], "automated-loom:knot or automated-loom:row"),
        (["automated-loom:weft"], "automated-loom:knot or automated-loom:row"),
        (["beat-up"], "beat-up has no cyclogram; machines with some: automated-loom, weaver"),
        ([PRESS, "--set", "cycle=1s"], "is a file and has no parameters to set"),
    ],
)
def test_a_machine_without_that_cyclogram_is_said(arguments: list[str], said: str) -> None:
    code, _, told = run(*arguments)
    assert code == 2
    assert said in told
