"""Machines in the studio: forms from their declarations, designs as the command line writes them, typed values."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner
from default_machines import SETTLED, default_report

from ilmek.cli import main
from ilmek.errors import ParameterError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.machine.figures import FiguresRequest, figures
from ilmek.jobs.studio.machine.tasks import (
    DesignRequest,
    MachineName,
    Nothing,
    TypedValue,
    design,
    form,
    list_of_machines,
    reading,
)
from ilmek.jobs.studio.machine.view import in_space, view
from ilmek.machines import ENTRIES
from ilmek.machines.catalogue import MACHINES
from ilmek.params import reachable
from ilmek.viz.plain import ShownAnimation

HERE = Context()


def test_catalogue_lists_every_machine_with_its_summary() -> None:
    summaries = {name: entry.summary for name, entry in ENTRIES.items()}
    assert {one.name: one.summary for one in list_of_machines(Nothing(), HERE).machines} == summaries


@pytest.mark.parametrize("name", ENTRIES)
def test_form_has_every_declared_parameter_and_each_default_reads_as_itself(name: str) -> None:
    fields = form(MachineName(name), HERE).fields
    assert [one.name for one in fields] == list(reachable(MACHINES[name].params))
    for one in fields:
        if one.default is not None and one.kind != "text" and one.default not in one.choices:
            found = reading(TypedValue(name, one.name, one.default_text), HERE)
            expected = one.default if one.kind == "flag" else pytest.approx(one.default, rel=1e-5)
            assert found.value == expected, one.name


def test_field_has_unit_bounds_and_the_machine_it_belongs_to() -> None:
    fields = {one.name: one for one in form(MachineName("automated-loom"), HERE).fields}
    swing = fields["beat-up.swing"]
    assert fields["width"].default_text == "1.2 m"
    assert (swing.machine, swing.group, swing.kind, swing.shown_unit) == ("beat-up", "beat-up", "quantity", "deg")
    assert fields["width"].machine == ""
    assert "at least" in fields["width"].allowed


def test_design_is_the_json_of_the_command_line(tmp_path: Path) -> None:
    file = tmp_path / "out.json"
    CliRunner().invoke(main, ["design", "beat-up", "--set", "swing=32deg", "--json", str(file)])
    assert design(DesignRequest("beat-up", {"swing": "32deg"}), HERE).body == file.read_bytes()


def test_typed_value_is_refused_as_the_command_line_refuses_it() -> None:
    with pytest.raises(ParameterError, match="wrong unit"):
        reading(TypedValue("beat-up", "swing", "20mm"), HERE)
    with pytest.raises(ParameterError, match="out of bounds"):
        reading(TypedValue("beat-up", "swing", "300deg"), HERE)
    with pytest.raises(ParameterError, match="unknown parameter"):
        reading(TypedValue("beat-up", "swng", "20deg"), HERE)


@pytest.mark.parametrize(("name", "settings"), [("beat-up", {"swing": "34deg"}), ("shedding", {"lift": "70mm"})])
def test_view_has_the_verdict_and_the_checks_of_the_design(name: str, settings: dict[str, str]) -> None:
    made, seen = json.loads(design(DesignRequest(name, settings), HERE).body), view(DesignRequest(name, settings), HERE)
    assert seen.holds == made["holds"]
    assert [(one.name, one.value, one.ok) for one in seen.checks if not one.machine] == [
        (one["name"], one["value"], one["ok"]) for one in made["checks"]
    ]
    assert {one.name: one.value for one in seen.results if one.value is not None} == {
        name: value
        for name, value in made["results"].items()
        if name in {one.name for one in seen.results} and isinstance(value, int | float) and not isinstance(value, bool)
    }
    (changed,) = (name for name, one in seen.parameters.items() if one.set)
    assert changed in settings


FINE = {**SETTLED, "knots_across": "200/dm", "knots_along": "200/dm", "width": "0.3m", "length": "0.3m", "beat": "comb"}
"""A loom that fails checks."""


def test_loom_in_the_studio_has_the_checks_of_all_its_machines_and_then_those_in_space() -> None:
    seen = view(DesignRequest("automated-loom", FINE), HERE)
    assert not seen.holds
    assert seen.failed == len(seen.reasons)
    assert {one.machine for one in seen.checks} >= {"", "weaver", "shedding", "warp-tension"}
    assert seen.pending
    whole = in_space(DesignRequest("automated-loom", FINE), HERE)
    assert not whole.pending
    assert {one.name for one in seen.checks} < {one.name for one in whole.checks}
    assert "buildable" in {one.name for one in whole.results} - {one.name for one in seen.results}


@pytest.mark.parametrize("name", ["beat-up", "shedding"])
def test_figures_are_those_of_the_page_chosen_by_name(name: str) -> None:
    machine = MACHINES[name]
    page = [figure.name for figure in default_report(machine.name).figures]
    none = figures(FiguresRequest(name, {}, names=()), HERE)
    assert [one.name for one in none.known] == page
    assert none.figures == []
    chosen = figures(FiguresRequest(name, {}, names=(page[1], "unknown")), HERE)
    drawn = [shown for one in chosen.figures for shown in (one.plot, one.drawing, one.timing, one.animation) if shown]
    assert [one.still.name if isinstance(one, ShownAnimation) else one.name for one in drawn] == [page[1]]


def test_figures_of_a_machine_in_the_loom_are_without_those_of_its_own_page_alone() -> None:
    found = figures(FiguresRequest("automated-loom", FINE, part="shedding", names=()), HERE)
    assert "shedding" in {one.name for one in found.parts}
    assert any(one.kind == "animation" for one in found.known)
    with pytest.raises(ParameterError, match="no part"):
        figures(FiguresRequest("automated-loom", FINE, part="tufting"), HERE)
