"""`ilmek simulate` through the command line: results, files, checks, bad input."""

import csv
import json
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result
from small_programme import small_programme

from ilmek.cli import main
from ilmek.io.programme_file import open_programme, write_programme
from ilmek.jobs.simulate import SimulationOrder, simulate
from ilmek.jobs.simulate_runs import runs_of
from ilmek.loom.twin.faults import RATES, StopParams
from ilmek.loom.twin.statistics import Band, calendar_time
from ilmek.progress import Cancelled, Progress


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a programme, one whose packages are too short, and files of stops."""
    made = tmp_path_factory.mktemp("simulate")
    programme = small_programme(12, 60, 3, 4)
    write_programme(made / "programme.ilmek", programme)
    programme.setup = replace(programme.setup, packages=np.full((3, 4), 0.5))
    write_programme(made / "short.ilmek", programme)
    (made / "stops.toml").write_text('gripper_miss = 0.05\nresponse = "2min"\npile_break = "20/km"\n')
    (made / "misspelt.toml").write_text("\ngriper_miss = 0.05\n")
    (made / "table.toml").write_text("[response]\nmean = 3\n")
    (made / "list.json").write_text("[1]")
    (made / "loom.json").write_text('{"machine": "beat-up", "parameters": {}}')
    (made / "text.ilmek").write_text("a text")
    return made


def run(folder: Path, *args: str) -> Result:
    return CliRunner().invoke(main, ["simulate", *(arg.replace("DIR", str(folder)) for arg in args)])


def found(result: Result) -> dict[str, object]:
    assert result.exit_code in (0, 3), result.output
    return dict(json.loads(result.stdout))


NAMES = {
    "time", "knots", "digest", "utilisation", "time_without_faults", "order_time", "calendar_time", "knots_per_minute",
    "availability", "performance", "quality", "oee", "bottleneck", "bottleneck_cure", "losses", "heads", "stops",
    "yarn", "packages", "time_band", "oee_band",
}  # fmt: skip
"""The names of results in the JSON are stable."""

GROUPS = {
    "losses": {"use", "time", "share", "cure"},
    "heads": {"head", "tying", "changing", "travelling", "retrying", "stopped", "waiting", "row_ends", "planned",
              "changes", "last"},
    "stops": {"cause", "faults", "calls", "operator_time", "standstill", "mean_faults"},
    "yarn": {"name", "knots", "tied", "lost", "left", "packages"},
    "packages": {"head", "tube", "yarn", "length", "used", "left"},
}  # fmt: skip


def test_the_names_in_the_json_are_stable(folder: Path) -> None:
    data = found(run(folder, "DIR/programme.ilmek", "--seeds", "5", "--json", "-"))
    results = data["results"]
    assert isinstance(results, dict)
    assert results.keys() == NAMES
    assert {name: set(results[name][0]) for name in GROUPS} == GROUPS
    assert {"mean", "median", "p05", "p95", "least", "most", "runs"} == results["time_band"].keys()
    assert [data[name] for name in ("time", "knots", "digest", "utilisation")] == [
        results[name] for name in ("time", "knots", "digest", "utilisation")
    ]
    assert data["knots"] == 720
    assert re.fullmatch("[0-9a-f]{64}", str(data["digest"]))
    assert abs(sum(one["share"] for one in results["losses"]) - 1) < 1e-12


def test_the_same_seed_is_the_same_run_and_another_is_not(folder: Path) -> None:
    args = ("DIR/programme.ilmek", "--stops", "DIR/stops.toml", "--seeds", "3", "--json", "-")
    first, again = run(folder, *args, "--seed", "4"), run(folder, *args, "--seed", "4")
    assert first.stdout == again.stdout
    assert found(first)["digest"] != found(run(folder, *args, "--seed", "5"))["digest"]


def test_settings_replace_those_of_a_file(folder: Path) -> None:
    args = ("DIR/programme.ilmek", "--stops", "DIR/stops.toml", "--set", "response=5s", "--seeds", "0", "--json", "-")
    parameters = found(run(folder, *args))["parameters"]
    assert isinstance(parameters, dict)
    assert (parameters["response"], parameters["gripper_miss"], parameters["pile_break"]) == (5.0, 0.05, 0.02)


def test_without_faults_it_takes_the_time_of_the_programme(folder: Path) -> None:
    data = found(run(folder, "DIR/programme.ilmek", "--no-faults", "--json", "-"))
    results, parameters = data["results"], data["parameters"]
    assert isinstance(results, dict)
    assert isinstance(parameters, dict)
    assert results["time"] == results["time_without_faults"] == results["time_band"]["most"]
    assert not any(parameters[name] for name in RATES)
    assert all(test["ok"] for test in data["self_tests"])  # type: ignore[attr-defined]
    assert len(data["self_tests"]) == 3  # type: ignore[arg-type]


def test_checks_that_fail_end_with_3(folder: Path) -> None:
    late = run(folder, "DIR/programme.ilmek", "--deadline", "1min", "--seeds", "20")
    assert late.exit_code == 3
    assert "weaving time" in late.stdout
    short = run(folder, "DIR/short.ilmek", "--seeds", "0", "--json", "-")
    assert short.exit_code == 3
    assert [one["ok"] for one in found(short)["checks"]] == [True, False]  # type: ignore[attr-defined]


def test_the_folder_has_page_tables_and_json(folder: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    shown = run(
        folder, "DIR/programme.ilmek", "--stops", "DIR/stops.toml", "--out", str(out), "--shown", "rows", "--seeds", "9"
    )
    assert shown.exit_code == 0, shown.output
    page = (out / "simulation.html").read_text(encoding="utf-8")
    for text in ("The heads over the carpet", "When the carpet is woven", "which took longest", "gripper miss", "<svg"):
        assert text in page
    data = json.loads((out / "simulation.json").read_text())
    assert [Path(name).name for name in data["files"]] == [
        "simulation.html", "stops.csv", "rows.csv", "simulation.json",
    ]  # fmt: skip
    with (out / "rows.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert float(rows[-1]["end [s]"]) == data["time"]
    assert [int(float(row["row"])) for row in rows] == list(range(1, 13))
    with (out / "stops.csv").open() as file:
        assert len(list(csv.DictReader(file))) == sum(one["faults"] for one in data["results"]["stops"])


def test_any_number_of_workers_gives_the_same_numbers(folder: Path) -> None:
    path, params = folder / "programme.ilmek", StopParams(gripper_miss=0.05)
    with open_programme(path) as programme:
        alone = runs_of(programme, path, params, 3, 11, 1, None)
        shared = runs_of(programme, path, params, 3, 11, 2, None)
    assert (alone == shared).all()


def test_it_can_be_cancelled(folder: Path) -> None:
    def answers() -> Iterator[bool]:
        yield from (False,) * 30
        while True:
            yield True

    stop = answers()
    with pytest.raises(Cancelled):
        simulate(SimulationOrder(folder / "programme.ilmek"), progress=Progress(cancelled=lambda: next(stop)))


BAD = {
    "a text for a programme": ("DIR/text.ilmek", "is no loom programme"),
    "a missing programme": ("DIR/gone.ilmek", "gone.ilmek cannot be read"),
    "a seed below 0": ("DIR/programme.ilmek --seed -1", "--seed -1; 0 to"),
    "too many seeds": ("DIR/programme.ilmek --seeds 2000000", "--seeds 2000000; 0 to 1000000"),
    "no workers": ("DIR/programme.ilmek --workers 0", "--workers 0; 1 to 64"),
    "an unknown rate": ("DIR/programme.ilmek --set griper_miss=1%", "did you mean gripper_miss"),
    "a rate above its bound": ("DIR/programme.ilmek --set gripper_miss=0.9", "gripper_miss=0.9 is out of bounds"),
    "a rate in a wrong unit": ("DIR/programme.ilmek --set pile_break=2s", "pile_break.*wrong unit"),
    "an unknown policy": ("DIR/programme.ilmek --set others=halt", "others='halt' is unknown"),
    "a misspelt rate in a file": ("DIR/programme.ilmek --stops DIR/misspelt.toml", r"misspelt.toml, line 2: unknown"),
    "a table in a file": ("DIR/programme.ilmek --stops DIR/table.toml", r"table.toml, line 1: response"),
    "a list in a file": ("DIR/programme.ilmek --stops DIR/list.json", "is not a table"),
    "a deadline without a unit": ("DIR/programme.ilmek --deadline 72", "did you mean 72h"),
    "a machine that is no loom": ("DIR/programme.ilmek --loom DIR/loom.json", "is no loom"),
    "rows without a folder": ("DIR/programme.ilmek --shown rows", "--shown rows is given without --out"),
    "an operator of too many looms": (
        "DIR/programme.ilmek --set looms=200 --set gripper_miss=50% --set retries=0",
        "200 looms of an operator need .*below 100 %",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_line(folder: Path, name: str) -> None:
    args, message = BAD[name]
    result = run(folder, *args.split())
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    assert len(result.stderr.splitlines()) == 1
    assert re.search(message, result.stderr), result.stderr


def test_the_parameters_are_listed_with_bounds(folder: Path) -> None:
    shown = run(folder, "--parameters").stdout
    for name in ("gripper_miss", "response", "dressing", "0.1/km"):
        assert name in shown


@pytest.mark.parametrize(
    ("hours", "days", "work", "expected"),
    [(24, 7, 100.0, 100.0), (8, 7, 8.0, 8.0), (8, 7, 9.0, 25.0), (8, 5, 40.0, 104.0), (8, 5, 41.0, 169.0)],
)
def test_working_time_passes_in_shifts(hours: float, days: int, work: float, expected: float) -> None:
    params = StopParams(hours=hours * 3600.0, days=days)
    assert calendar_time(work * 3600.0, params) == pytest.approx(expected * 3600.0)


def test_a_band_is_by_order() -> None:
    band = Band(np.array([5.0, 1.0, 3.0, 2.0, 4.0]))
    assert (band.at(0.05), band.at(0.5), band.at(0.95), band.at(0.2)) == (1.0, 3.0, 5.0, 1.0)
