"""A figure that cannot be made is left out with a warning; with the defaults nothing is left out."""

import json
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
from click.testing import CliRunner
from default_machines import SETTLED, default_page

from ilmek.carpet.design import MOST_KNOTS
from ilmek.cli import main
from ilmek.errors import OutputError
from ilmek.machines import ENTRIES
from ilmek.machines.automated_loom import MACHINE
from ilmek.machines.automated_loom.figures import time_against_pitch, time_of_one_knotter
from ilmek.machines.catalogue import find_machine
from ilmek.progress import Cancelled
from ilmek.report import Axis, Plot
from ilmek.report.left_out import SWITCH, made_figures, made_or_left_out
from ilmek.viz import sections
from ilmek.viz.page import machine_page

FIGURE = Plot("name", "Title", Axis("x"), Axis("y"), ())


def failing_figure() -> Plot:
    raise ZeroDivisionError("division\nby zero")


@pytest.fixture
def guarded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(SWITCH)


@pytest.mark.usefixtures("guarded")
def test_a_lazy_figure_is_left_out_alone() -> None:
    left_out: list[str] = []
    assert made_figures(lambda: (FIGURE, partial(failing_figure), partial(lambda: FIGURE)), left_out) == (FIGURE,) * 2
    assert left_out == ["figure 'failing figure' is left out: division"]


@pytest.mark.usefixtures("guarded")
def test_all_figures_are_left_out_together() -> None:
    left_out: list[str] = []
    assert made_figures(lambda: (failing_figure(),), left_out) == ()
    assert left_out == ["every figure is left out: division"]


@pytest.mark.usefixtures("guarded")
@pytest.mark.parametrize("error", [OSError, OutputError, Cancelled, KeyboardInterrupt])
def test_errors_of_the_job_are_raised(error: type[BaseException]) -> None:
    def fail() -> None:
        raise error("disc full")

    with pytest.raises(error):
        made_or_left_out("it", fail, [])


def test_in_the_tests_errors_are_raised() -> None:
    with pytest.raises(ZeroDivisionError):
        made_or_left_out("it", failing_figure, [])


@pytest.mark.usefixtures("guarded")
def test_a_report_without_its_figures() -> None:
    machine = find_machine("function-four-bar")
    whole = machine.report_for({})
    without = replace(machine, figures=lambda _: (failing_figure(),)).report_for({})
    assert without.figures == ()
    assert without.warnings == (*whole.warnings, "every figure is left out: division")
    assert without.results_as_json() == whole.results_as_json()


@pytest.mark.usefixtures("guarded")
def test_a_page_names_the_figure_that_cannot_be_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> str:
        raise ValueError("<b>")

    report = find_machine("function-four-bar").report_for({})
    monkeypatch.setattr(sections, "svg", fail)
    left_out: list[str] = []
    shown = machine_page(report, left_out)
    assert len(left_out) == len(report.figures)
    assert left_out[0] == f"figure {report.figures[0].title!r} is left out: <b>"
    assert shown.count("is left out: &lt;b&gt;") == len(report.figures)


def test_a_command_draws_figures_only_for_what_shows_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    machine = replace(find_machine("function-four-bar"), figures=lambda _: (failing_figure(),))
    monkeypatch.setattr("ilmek.machines.function_four_bar.MACHINE", machine)
    design = ("design", "function-four-bar", "--json", "-")
    shown = CliRunner().invoke(main, design)
    assert (shown.exit_code, json.loads(shown.stdout)["machine"]) == (0, "function-four-bar")
    drawn = CliRunner().invoke(main, (*design, "--report", str(tmp_path / "page.html")))
    assert drawn.exit_code not in (0, 3)


@pytest.mark.parametrize("name", ENTRIES)
@pytest.mark.one_in(3)
def test_with_the_defaults_nothing_is_left_out(name: str) -> None:
    page, left_out = default_page(name)
    assert "is left out" not in page
    assert left_out == ()


def test_the_scaling_of_the_largest_carpets_is_drawn() -> None:
    settings = {"width": "4m", "length": "8m", "knots_across": "250/dm", "knots_along": "250/dm", "beat": "comb"}
    loom = MACHINE.design(MACHINE.params.read(SETTLED | settings))
    assert 0.9 * MOST_KNOTS < loom.rows * loom.columns <= MOST_KNOTS
    assert len(time_against_pitch(loom).series) == 3
    narrow = {"width": "2cm", "length": "50m", "knots_across": "500/dm", "knots_along": "500/dm", "beat": "comb"}
    assert len(time_of_one_knotter(MACHINE.design(MACHINE.params.read(SETTLED | narrow))).series[0].x) == 33
