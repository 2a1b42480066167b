"""The verdict as a user meets it: exit code, headline, JSON, page and files agree."""

import json
import math
import re
from html import escape
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from default_machines import SETTLED_OPTIONS

from ilmek.cli import main
from ilmek.errors import MechanismError, ParameterError
from ilmek.io.output import MANIFEST
from ilmek.machines.automated_loom.nearest import NearestFit
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.component import Component

EXAMPLES = Path(__file__).parents[2] / "examples"
MEDALLION = str(EXAMPLES / "medallion.png")
SMALL = ("--size", "40x60cm", "--quality", "15x15/dm", "--no-pdf")
COMB = (*SETTLED_OPTIONS, "--loom", "beat=comb")
FAILS = ("--loom", "head_width=20mm", *COMB)
"""A setting with which the loom is designed, and fails a check."""

pytestmark = pytest.mark.usefixtures("nothing_near")


def run(*arguments: str) -> Result:
    return CliRunner().invoke(main, arguments)


def judged(found: dict[str, Any]) -> int:
    """The exit code that the checks of a JSON demand; its verdict agrees with them."""
    failed = {check["name"] for check in found["checks"] if not check["ok"]}
    assert {reason["name"] for reason in found["reasons"]} == failed
    assert found["holds"] is not bool(failed)
    weights = [weight(reason) for reason in found["reasons"]]
    assert weights == sorted(weights, reverse=True)
    return 3 if failed else 0


def weight(reason: dict[str, Any]) -> float:
    value, limit = reason["value"], reason["limit"]
    ratio = value / limit if value is not None and limit else math.inf
    return abs(math.log(ratio)) if math.isfinite(ratio) and ratio > 0 else math.inf


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.one_in(3)
@pytest.mark.usefixtures("not_in_space")
def test_design_ends_as_its_checks_demand(tmp_path: Path, name: str) -> None:
    file = tmp_path / "found.json"
    shown = run("design", name, "--json", str(file))
    assert shown.exit_code == judged(json.loads(file.read_text(encoding="utf-8")))
    assert re.match(r"(checks: \d+ passed|weaves: )", shown.stdout.splitlines()[1])


def test_reasons_stand_below_the_headline_and_all_warnings_are_notes() -> None:
    result = run("design", "knotting-four-bar")
    assert result.exit_code == 3
    found = json.loads(run("design", "knotting-four-bar", "--json", "-").stdout)
    _, headline, *lines = result.stdout.splitlines()
    assert headline == f"checks: {len(found['checks']) - len(found['reasons'])} passed, {len(found['reasons'])} failed"
    assert [line.partition(":")[0].strip() for line in lines[: len(found["reasons"])]] == [
        reason["name"] for reason in found["reasons"]
    ]
    assert all(f"note: {warning}" in result.stderr for warning in found["warnings"])


@pytest.mark.usefixtures("not_in_space")
def test_the_loom_states_whether_it_weaves() -> None:
    result = run("design", "automated-loom", "--json", "-")
    found = json.loads(result.stdout)
    assert found["weaves"] is found["results"]["weaves"] is found["holds"] is (result.exit_code == 0)
    assert found["row_pitch_left"] == found["results"]["row_pitch_left"] > 0
    assert found["results"]["reasons"] == found["reasons"]


@pytest.mark.usefixtures("plain_page")
def test_a_loom_that_cannot_weave_gets_no_programme(tmp_path: Path) -> None:
    out = str(tmp_path / "out")
    first = run("weave", MEDALLION, *SMALL, *COMB, "--out", out, "--json", "-")
    found = json.loads(first.stdout)
    assert first.exit_code == judged(found)
    assert found["weaves"] is any(file.endswith("programme.ilmek") for file in found["files"])

    refused = run("weave", MEDALLION, *SMALL, *FAILS, "--out", out, "--force")
    assert refused.exit_code == 3
    assert re.match(r"weaves: NO, \d+ reasons?\n  ", refused.stdout)
    there = {path.name for path in (tmp_path / "out").iterdir()}
    assert there == {
        "report.html",
        "loom.html",
        "report.json",
        "chart.png",
        "carpet.png",
        "rows.txt",
        "yarn.csv",
        "machine.json",
        MANIFEST,
    }
    found = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert (found["weaves"], found["holds"], judged(found)) == (False, False, 3)
    assert not any(file.endswith("programme.ilmek") for file in found["files"])
    machine = json.loads((tmp_path / "out" / "machine.json").read_text(encoding="utf-8"))
    assert not machine["weaves"]
    assert "weaver: cams beside each other" in {reason["name"] for reason in machine["reasons"]}


@pytest.mark.usefixtures("plain_loom_page")
def test_the_page_of_a_loom_that_cannot_weave_is_red(tmp_path: Path) -> None:
    run("weave", MEDALLION, "--size", "20x30cm", "--quality", "10x10/dm", *FAILS, "--out", str(tmp_path / "out"))
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert '<div class="answer bad" role="alert">' in page
    assert "The loom cannot weave this carpet, and there is no programme." in page
    found = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert all(escape(reason["cure"]) in page for reason in found["reasons"])


@pytest.mark.parametrize(("name", "kind"), [("knotting-four-bar", "bad"), ("warp-tension", "good")])
def test_the_page_of_a_machine_begins_with_its_verdict(tmp_path: Path, name: str, kind: str) -> None:
    page = tmp_path / "page.html"
    run("design", name, "--report", str(page))
    main_part = page.read_text(encoding="utf-8").partition("<main>")[2].lstrip()
    assert main_part.startswith(f'<div class="answer {kind}"')


def cannot(*_: object) -> None:
    raise MechanismError("the crank cannot close", do="take a longer coupler")


@pytest.mark.usefixtures("plain_page")
def test_a_loom_that_cannot_be_designed_leaves_chart_yarn_and_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in ("loom", "wishes"):
        monkeypatch.setattr(f"ilmek.jobs.{module}.design", cannot)
    monkeypatch.setattr("ilmek.jobs.loom.any_loom", lambda _: False)
    result = run(
        "weave",
        MEDALLION,
        *SMALL,
        "--least-detail",
        "0%",
        "--deadline",
        "90h",
        "--out",
        str(tmp_path / "out"),
        "--json",
        "-",
    )
    found = json.loads(result.stdout)
    assert (result.exit_code, found["weaves"], found["heads"], found["row_pitch_left"]) == (3, False, None, None)
    (reason,) = found["reasons"]
    assert (reason["name"], reason["cure"]) == ("the loom can be designed", "take a longer coupler")
    assert next(c for c in found["checks"] if not c["ok"])["source"] == "the crank cannot close"
    assert {Path(file).name for file in found["files"]} >= {"chart.png", "yarn.csv", "machine.json", "report.html"}
    assert not (tmp_path / "out" / "programme.ilmek").exists()


def test_a_setting_that_prevents_a_design_is_bad_input(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def contradicting(*_: object) -> None:
        raise ParameterError("the spacer is heavier than its beam")

    monkeypatch.setattr("ilmek.jobs.wishes.design", contradicting)
    result = run("weave", MEDALLION, *SMALL, "--loom", "margin=60mm", "--out", str(tmp_path / "out"))
    assert (result.exit_code, result.stdout) == (2, "")
    assert "heavier than its beam" in result.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("not_in_space")
@pytest.mark.matrix(light=2)
@pytest.mark.parametrize(
    ("wishes", "named"),
    [
        (("--heads", "2", "--deadline", "3h"), ("2 heads weave it in", "the deadline of 3 h", "mm fit 0.8 m")),
        (("--heads", "40"), ("40 heads", "mm fit 0.8 m")),
        (("--deadline", "1h"), ("the deadline of 1 h", "mm fit 0.8 m")),
        (("--loom", "price_limit=10"), ("the price is to be at most 10", "this loom costs", "weave the carpet in")),
        (
            ("--heads", "2", "--deadline", "3h", "--loom", "price_limit=10"),
            ("2 heads weave it in", "the deadline of 3 h", "mm fit 0.8 m", "at most 10"),
        ),
        (
            ("--deadline", "2.6h", "--loom", "price_limit=58000"),
            ("at most 58000; this loom costs", "the deadline of 2.6 h needs 3 heads", "for 58000 it is woven in about"),
        ),
    ],
)
def test_wishes_that_contradict_are_named_together(
    tmp_path: Path, wishes: tuple[str, ...], named: tuple[str, ...]
) -> None:
    size = ("--size", "80x80cm", "--quality", "15x15/dm", "--no-pdf", "--out", str(tmp_path / "out"))
    result = run("weave", MEDALLION, *size, *wishes)
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)
    assert all(text in result.stderr for text in ("the wishes contradict each other", *named)), result.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("plain_page")
def test_heads_and_a_deadline_that_agree_are_both_kept(tmp_path: Path) -> None:
    size = ("--size", "80x80cm", "--quality", "15x15/dm", "--no-pdf", "--out", str(tmp_path / "out"))
    result = run("weave", MEDALLION, *size, "--heads", "2", "--deadline", "90h", "--loom", "beat=comb", "--json", "-")
    found = json.loads(result.stdout)
    assert found["heads"] == 2
    assert next(check for check in found["checks"] if check["name"] == "weaving time")["ok"]


def test_the_chart_and_the_cyclogram_end_with_their_checks(tmp_path: Path) -> None:
    thick = run("chart", MEDALLION, "--size", "20x30cm", "--quality", "80x100/dm", "--yarn-count", "2/2", "--json", "-")
    assert thick.exit_code == judged(json.loads(thick.stdout)) == 3
    press = str(EXAMPLES / "press.toml")
    given, solved = run("cyclogram", press, "--json", "-"), run("cyclogram", press, "--solve", "period", "--json", "-")
    assert given.exit_code == judged(json.loads(given.stdout)) == 3
    assert solved.exit_code == judged(json.loads(solved.stdout)) == 0


@pytest.mark.usefixtures("plain_page")
def test_every_choice_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    found = json.loads(run("design", "automated-loom", "--json", "-").stdout)
    assert {"name", "chosen", "decided_by", "next_cheaper", "failed"} == found["choices"][0].keys()
    assert {"beat", "heads"} <= {choice["name"] for choice in found["choices"]}
    shown = run("design", "automated-loom").stdout
    assert "decided by" in shown
    machine: Component = MACHINES["automated-loom"]
    assert [choice.name for choice in machine.report_for({}).all_choices] == [one["name"] for one in found["choices"]]


@pytest.mark.usefixtures("plain_page")
def test_the_nearest_carpets_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fits = (NearestFit("quality", "20/dm x 20/dm"), NearestFit("width", "0.9 m"))
    monkeypatch.setattr("ilmek.jobs.nearest.nearest_fits", lambda *_: fits)
    found = run("design", "automated-loom", *FAILS[1::2], "--json", "-")
    expected = [{"wish": one.wish, "value": one.value} for one in fits]
    data = json.loads(found.stdout)
    assert data["nearest"] == data["results"]["nearest"] == expected
    page = tmp_path / "page.html"
    shown = run("design", "automated-loom", *FAILS[1::2], "--report", str(page)).stdout
    assert "\nnearest that weaves: quality 20/dm x 20/dm; width 0.9 m\n" in shown
    assert "quality 20/dm x 20/dm; width 0.9 m." in page.read_text(encoding="utf-8")
    monkeypatch.setattr("ilmek.jobs.weave.carpet_page", lambda page, *_: page.nearest)
    out = tmp_path / "out"
    woven = run("weave", MEDALLION, *SMALL, *FAILS, "--out", str(out))
    assert "\nnearest that weaves: quality 20/dm x 20/dm; width 0.9 m\n" in woven.stdout
    assert json.loads((out / "report.json").read_text(encoding="utf-8"))["nearest"] == expected
    assert (out / "report.html").read_text(encoding="utf-8") == "quality 20/dm x 20/dm; width 0.9 m"
