"""The commands on a small carpet: what they print, the JSON they give, the files they make."""

import csv
import json
import re
import sqlite3
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from default_machines import SETTLED_OPTIONS
from PIL import Image

from ilmek.cli import main
from ilmek.elements.carpet_yarns import yarn
from ilmek.elements.yarns import usual_warp_density
from ilmek.io.programme_file import open_programme
from ilmek.jobs.carpet_files import FILES
from ilmek.machines.catalogue import MACHINES

EXAMPLES = Path(__file__).parents[2] / "examples"
MEDALLION = str(EXAMPLES / "medallion.png")
SMALL = ("--size", "40x60cm", "--quality", "15x15/dm")
LOOM = (*SMALL, "--heads", "1", *SETTLED_OPTIONS)
"""One loom for all tests of `weave` that ask for no other: it is designed once."""

pytestmark = pytest.mark.usefixtures("nothing_near")


def run(*arguments: str) -> Result:
    """Run a command that ends with its results; 3: a check fails, which tests/unit/test_verdict.py is about."""
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code in (0, 3), result.stderr
    return result


def data(*arguments: str) -> Any:
    result = run(*arguments, "--json", "-")
    return json.loads(result.stdout)


@pytest.fixture(scope="module")
def woven(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Any]:
    """The folder and the JSON of one `weave`."""
    folder = tmp_path_factory.mktemp("woven") / "deep" / "carpet"
    return folder, data("weave", MEDALLION, *LOOM, "--least-detail", "0%", "--out", str(folder))


def test_weave_makes_its_files(woven: tuple[Path, Any]) -> None:
    folder, found = woven
    not_by_default = {
        "chart.json",
        "wall.pdf",
        "chart.bmp",
        "chart.tiff",
        "chart.oxs",
        "chart.wif",
        "proposed.toml",
        "paper.html",
    }
    names = [file.name for file in FILES if file.name not in not_by_default]
    assert found["files"] == [str(folder / name) for name in names]
    assert sorted(path.name for path in folder.iterdir()) == sorted([*names, ".ilmek"])
    assert all((folder / name).stat().st_size > 200 for name in names)


def test_weave_json_has_its_names(woven: tuple[Path, Any]) -> None:
    folder, found = woven
    assert found["knots"] == 60 * 90
    assert found["heads"] == 1
    assert found["weaving_time"] > found["knots"] * 1.5
    assert {"name", "knots", "length", "mass"} <= found["yarn"][0].keys()
    assert sum(yarn["knots"] for yarn in found["yarn"]) == found["knots"]
    assert {"name", "value", "limit", "unit", "ok", "source"} <= found["checks"][0].keys()
    assert json.loads((folder / "report.json").read_text()) == found
    assert all(found[name] == value for name, value in found["results"].items())


def test_checks_name_their_machine_once(woven: tuple[Path, Any]) -> None:
    names = [check["name"] for check in woven[1]["checks"]]
    assert len(names) == len(set(names))
    assert {name.partition(":")[0] for name in names} >= {"weaver", "shedding", "warp-tension"}


def test_programme_ties_the_chart(woven: tuple[Path, Any]) -> None:
    folder, found = woven
    with Image.open(folder / "chart.png") as image:
        chart = np.asarray(image)
    with open_programme(folder / "programme.ilmek") as programme:
        setup, tied = programme.setup, np.full(chart.shape, 255, np.uint8)
        for number in range(setup.rows):
            row = programme.operations(number)
            of_head = np.repeat(np.arange(setup.heads), np.diff(row.starts))
            tied[number, row.columns] = setup.loading[of_head, row.tubes]
        assert programme.totals.duration == pytest.approx(found["weaving_time"], rel=1e-12)
        assert setup.heads == 1
        assert found["time_bound"] <= found["weaving_time"] <= found["time_naive"]
    assert np.array_equal(tied[::-1], chart)


def test_machine_json_has_every_machine(woven: tuple[Path, Any]) -> None:
    machine = json.loads((woven[0] / "machine.json").read_text())
    assert machine["machine"] == "automated-loom"
    assert set(machine["machines"]) >= {"weaver", "shedding", "warp-tension"}
    assert machine["machines"]["shedding"]["parameters"]["cloth.warp_pitch"] == machine["results"]["warp_pitch"]
    assert machine["machines"]["weaver"]["parameters"]["knot"] == "symmetric"
    assert "worst_tension" in machine["machines"]["warp-tension"]["results"]
    assert machine["parameters"]["width"] == 0.4


def test_the_programme_s_rows_are_the_finished_carpet_once_cut_off_and_washed(woven: tuple[Path, Any]) -> None:
    """The cylinder turns for each row of the programme; what it winds loses its strain and its shrinkage."""
    folder, found = woven
    machine = json.loads((folder / "machine.json").read_text())
    cylinder, tension = machine["machines"]["warp-tension"], machine["results"]["tension"]
    with open_programme(folder / "programme.ilmek") as programme:
        wound = programme.setup.rows * cylinder["results"]["take_up_angle"] * cylinder["results"]["outer_radius"]
        size, dense = programme.setup.size, programme.setup.quality.along
    warp = yarn("cotton", usual_warp_density(machine["results"]["warp_pitch"], "cotton"))
    finished = wound / (1 + tension / warp.stiffness) * (1 - machine["parameters"]["finish.shrink_along"])
    assert finished == pytest.approx(size.length, abs=0.5 / dense)
    assert found["rows"] / finished == pytest.approx(dense)
    assert found["woven_size"]["length"] == pytest.approx(wound)
    assert found["woven_longer"] == pytest.approx(wound - size.length)


def test_yarn_csv_adds_up(woven: tuple[Path, Any]) -> None:
    folder, found = woven
    with (folder / "yarn.csv").open(encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    grams = sum(float(line["mass [g]"]) for line in lines)
    assert grams == pytest.approx(1000 * found["yarn_mass"], abs=0.05 * len(lines))
    assert [line["use"] for line in lines[-5:]] == ["warp", "weft", "weft", "end", "selvedge"]


def test_report_needs_no_network(woven: tuple[Path, Any]) -> None:
    text = (woven[0] / "report.html").read_text(encoding="utf-8")
    assert not re.search(r"""(?:src|href)=["']?(?:https?:)?//""", text)
    assert "<svg" in text
    assert "medallion" in text


@pytest.mark.usefixtures("plain_page")
def test_weave_shows_a_short_table_and_the_report(tmp_path: Path) -> None:
    shown = run("weave", MEDALLION, *LOOM, "--out", str(tmp_path / "out")).stdout
    for name in ("knots", "colours", "yarn", "weaving time", "heads", "checks", "report"):
        assert re.search(rf"^{name} ", shown, re.MULTILINE), shown
    assert shown.endswith(f" {tmp_path / 'out' / 'report.html'}\n")
    assert re.match(r"weaves: (yes|NO, \d+ reason)", shown)
    assert len([line for line in shown.splitlines() if not line.startswith("  ")]) <= 19


@pytest.mark.usefixtures("plain_page")
def test_deadline_finds_the_heads(tmp_path: Path) -> None:
    carpet = ("weave", MEDALLION, "--size", "120x60cm", "--quality", "15x15/dm", "--loom", "beat=comb")
    found = data(*carpet, *SETTLED_OPTIONS, "--deadline", "5h", "--out", str(tmp_path / "out"))
    assert found["weaving_time"] <= 5 * 3600
    assert found["heads"] > 1
    last = next(check for check in found["checks"] if check["name"] == "weaving time")
    assert last["ok"]


@pytest.mark.usefixtures("plain_page")
def test_fine_pitch_weaves_a_fine_quality(tmp_path: Path) -> None:
    found = data("weave", MEDALLION, "--size", "30x20cm", "--quality", "40x40/dm", "--warp-pitch", "1.25mm",
                 *SETTLED_OPTIONS, "--loom", "beat=comb", "--out", str(tmp_path / "out"))  # fmt: skip
    assert found["warp_pitch"] == 0.00125
    assert found["columns"] == 120


def test_chart_json_has_its_names_and_makes_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    found = data("chart", MEDALLION, *SMALL, "--colours", "6")
    assert (found["rows"], found["columns"], found["colours"]) == (90, 60, 6)
    assert 0 < found["mean_delta_e"] < 20
    assert 0 < found["changes_per_knot"] < 1
    assert len(found["yarn"]) == 6
    assert list(tmp_path.iterdir()) == []


def test_chart_without_a_folder_takes_a_free_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for _ in range(2):
        run("chart", MEDALLION, *SMALL)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["medallion-chart", "medallion-chart-2"]
    assert (tmp_path / "medallion-chart/chart.pdf").read_bytes().startswith(b"%PDF")


def test_notes_tell_what_was_done_to_the_picture(tmp_path: Path) -> None:
    Image.new("RGBA", (300, 100), (200, 30, 30, 128)).save(tmp_path / "a.png")
    result = run("chart", str(tmp_path / "a.png"), *SMALL, "--json", "-")
    assert "note: transparent parts put on white" in result.stderr
    assert "78% of the picture is cut off, which has other proportions than" in result.stderr
    assert "1 of 1 yarn dyed to order" in result.stderr
    assert len(json.loads(result.stdout)["notes"]) == 3


def test_yarn_list_of_the_examples(tmp_path: Path) -> None:
    found = data("chart", MEDALLION, *SMALL, "--yarns", str(EXAMPLES / "wool.toml"), "--out", str(tmp_path / "out"))
    assert {yarn["name"] for yarn in found["yarn"]} <= set(found["parameters"]["yarns"])
    assert "indigo" in found["parameters"]["yarns"]


def test_machines_are_listed_with_their_parameters() -> None:
    assert list(data("machines")["machines"]) == list(MACHINES)
    assert all(name in run("machines").stdout for name in MACHINES)
    for name, machine in MACHINES.items():
        found = data("machines", name)
        assert [parameter["name"] for parameter in found["parameters"]] == list(machine.params().as_dict())
        assert run("machines", name).stdout.startswith(f"{name}: ")


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.one_in(3)
def test_design_gives_json_table_and_page(tmp_path: Path, name: str) -> None:
    page, file = tmp_path / "page.html", tmp_path / "data.json"
    shown = run("design", name, "--json", str(file), "--report", str(page)).stdout
    found = json.loads(file.read_text())
    assert found["machine"] == name
    assert set(found) >= {"parameters", "results", "checks", "warnings"}
    assert all(result in shown for result in found["results"])
    assert re.search(r"^(checks: \d+ passed, \d+ failed|weaves: (yes|NO, \d+ reasons?))$", shown, re.MULTILINE)
    assert "<svg" in page.read_text(encoding="utf-8")


def test_settings_in_one_go_or_one_by_one() -> None:
    one = data("design", "beat-up", "--set", "swing=35deg", "--set", "beta=48deg")
    assert one == data("design", "beat-up", "--set", "swing=35deg", "beta=48deg")
    assert one["parameters"]["swing"] == pytest.approx(np.radians(35))


def test_inspect_shows_a_row(woven: tuple[Path, Any]) -> None:
    file = str(woven[0] / "programme.ilmek")
    found = data("inspect", file, "--row", "7")
    assert found["row"]["number"] == 7
    shown = run("inspect", file, "--row", "7").stdout
    assert "row 7 of 90, from the bottom" in shown
    assert 1 <= data("inspect", file)["row"]["number"] <= 90
    for beyond in ("0", "91"):
        refused = CliRunner().invoke(main, ["inspect", file, "--row", beyond])
        assert refused.exit_code == 2
        assert "rows 1 to 90, from the bottom" in refused.stderr


@pytest.mark.parametrize("issue", ["B,tomorrow", "B,2026-02-30", "B,30.11.2026", "B,", "2026-11-30", ",2026-11-30", ""])
def test_an_issue_without_revision_or_with_no_date_is_refused(tmp_path: Path, issue: str) -> None:
    refused = CliRunner().invoke(main, ["design", "cam", "--workshop", str(tmp_path / "parts"), "--issue", issue])
    assert refused.exit_code == 2
    assert "2026-11-30" in refused.stderr
    assert not (tmp_path / "parts").exists()


@pytest.mark.parametrize("number", [1, 2, 7, 90])
def test_inspect_counts_as_the_printed_chart(woven: tuple[Path, Any], number: int) -> None:
    with Image.open(woven[0] / "chart.png") as image:
        line = np.asarray(image)[-number].tolist()
    row = data("inspect", str(woven[0] / "programme.ilmek"), "--row", str(number))["row"]
    tied = {pair: yarn for head in row["heads"] for pair, yarn in zip(head["pairs"], head["yarns"], strict=True)}
    assert tied == dict(enumerate(line, start=1))


def test_check_proves_a_woven_programme_for_its_loom(woven: tuple[Path, Any], tmp_path: Path) -> None:
    file, loom = woven[0] / "programme.ilmek", str(woven[0] / "machine.json")
    found = data("check", str(file), "--loom", loom)
    assert (found["ok"], found["knots"], found["errors"]) == (True, 60 * 90, [])
    assert found["totals"]["time"] == pytest.approx(woven[1]["weaving_time"], rel=1e-9)
    assert found["totals"]["colour_changes"] == woven[1]["colour_changes"]
    text = tmp_path / "p.txt"
    run("convert", str(file), str(text))
    text.write_text(re.sub(r"^loom .*$", f'loom "{"0" * 64}"', text.read_text(), flags=re.MULTILINE))
    other = data("check", str(text), "--loom", loom)
    assert [error["line"] for error in other["errors"]] == [2]
    assert "the programme is for the loom 000000000000" in other["errors"][0]["what"]


def test_damaged_programme_is_one_line(woven: tuple[Path, Any], tmp_path: Path) -> None:
    whole = (woven[0] / "programme.ilmek").read_bytes()
    (tmp_path / "cut.ilmek").write_bytes(whole[: len(whole) // 2])
    result = CliRunner().invoke(main, ["inspect", str(tmp_path / "cut.ilmek")])
    assert (result.exit_code, result.stderr.count("\n")) == (2, 1)
    assert "is truncated" in result.stderr


@pytest.mark.usefixtures("plain_page")
@pytest.mark.parametrize("failure", [OSError(28, "No space left on device"), sqlite3.OperationalError("disk is full")])
def test_full_disk_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failure: Exception) -> None:
    def full(*_: object, **__: object) -> None:
        raise failure

    monkeypatch.setattr("ilmek.jobs.weave.write_json", full)
    result = CliRunner().invoke(main, ["weave", MEDALLION, *LOOM, "--out", str(tmp_path / "out")])
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)
    assert "cannot be written" in result.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("not_in_space")
def test_the_aim_of_a_loom_is_an_option_too() -> None:
    option, setting = (
        json.loads(run("design", "automated-loom", "beat=comb", *aim, "--json", "-").stdout)["results"]["heads"]
        for aim in (("--aim", "time"), ("--set", "aim=time"))
    )
    assert option == setting > 1


@pytest.mark.usefixtures("not_in_space")
def test_a_file_of_rates_stands_for_settings_which_win_over_it(tmp_path: Path) -> None:
    rates = tmp_path / "rates.toml"
    rates.write_text('wage = "20/h"\nlife = 10\nprices = "milling per h = 70"\n', encoding="utf-8")
    of_file, of_settings = (
        json.loads(run("design", "automated-loom", *given, "--json", "-").stdout)["parameters"]
        for given in (
            ("--rates", str(rates), "--set", "cost.life=5"),
            ("cost.wage=20/h", "cost.life=5", "prices=milling per h = 70"),
        )
    )
    assert of_file == of_settings
    assert of_file["cost.wage"] == pytest.approx(20 / 3600)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("wages = 3", "line 1, wages: unknown key .* did you mean 'wage'"),
        ('life = 7\nwage = "-2/h"', "line 2, wage: .* out of bounds"),
        ("interest = [1]", "line 1, interest: .* is not a value"),
        ("wage = 12", "did you mean 12/h"),
        ("wage 12", "line 1"),
        ('prices = "miling per h = 3"', "line 1, prices: .* did you mean milling"),
    ],
)
def test_rates_that_are_none_are_one_error(tmp_path: Path, text: str, named: str) -> None:
    rates = tmp_path / "rates.toml"
    rates.write_text(text, encoding="utf-8")
    for command in (("design", "automated-loom"), ("weave", MEDALLION, "--out", str(tmp_path / "out"))):
        result = CliRunner().invoke(main, [*command, "--rates", str(rates)])
        assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)
        assert re.search(named, result.stderr)


@pytest.mark.usefixtures("not_in_space")
def test_a_table_of_the_report_is_shown_alone() -> None:
    result = run("design", "automated-loom", "width=0.45m", "length=0.6m", "--table", "cost")
    assert result.exit_code == 0
    assert re.search(r"heads( +(travelling|linkage|comb|guide-cams)){3,}", result.stdout)
    assert re.search(r"margin +\d+ +25.93", result.stdout)  # 35 % of what the loom costs its maker
    assert "result" not in result.stdout
    refused = CliRunner().invoke(main, ["design", "beat-up", "--table", "cost"])
    assert (refused.exit_code, refused.stdout) == (2, "")
    assert re.search(r"no table 'cost' .* its tables: ", refused.stderr)
