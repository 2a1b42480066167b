"""`unit` in any JSON is the unit of the numbers beside it: an SI unit, whose factor is 1."""

import json
import math
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from designs import random_settings
from hypothesis import given
from hypothesis import strategies as st

from ilmek.cli import main
from ilmek.errors import IlmekError
from ilmek.jobs.machines import machine_form
from ilmek.machines.catalogue import MACHINES
from ilmek.report import Check, reasons
from ilmek.units import UNITS, parse_quantity, parse_unit, si_unit

SYMBOLS = [name for name in UNITS if name not in ("1", "%")]
EXAMPLES = Path(__file__).parents[2] / "examples"


def with_units(value: Any, path: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Every group of a JSON value that has a unit, with its place."""
    if isinstance(value, dict):
        if "unit" in value:
            yield path, value
        for key, inner in value.items():
            yield from with_units(inner, f"{path}.{key}")
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            yield from with_units(inner, f"{path}[{index}]")


def assert_si(value: Any, least: int = 1) -> None:
    groups = list(with_units(value))
    assert len(groups) >= least
    for path, group in groups:
        assert parse_unit(group["unit"]).factor == 1.0, (path, group)


@given(st.lists(st.tuples(st.sampled_from(SYMBOLS), st.integers(-3, 3)), min_size=1, max_size=3))
def test_the_si_unit_of_any_unit_has_the_factor_1_and_its_dimension(parts: list[tuple[str, int]]) -> None:
    text = "*".join(f"{symbol}^{power}" for symbol, power in parts)
    try:
        unit = parse_unit(text)
    except IlmekError:
        return
    assert parse_unit(si_unit(text)).factor == 1.0
    assert parse_unit(si_unit(text)).dimension == unit.dimension


@pytest.mark.parametrize(
    "unit", [*UNITS, "", "/dm", "1/dm^2", "mm/s^2", "kg/m^3", "N*mm", "rpm^2", "m/rpm", "cm²", "g/m"]
)
def test_the_si_unit_is_written_like_any_unit(unit: str) -> None:
    assert parse_unit(si_unit(unit)).factor == 1.0
    assert parse_unit(si_unit(unit)).dimension == parse_unit(unit).dimension
    assert si_unit(si_unit(unit)) == si_unit(unit)


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.one_in(3)
def test_units_of_every_machine_are_those_of_its_numbers(machine: str) -> None:
    component = MACHINES[machine]
    fewer = {"path-four-bar": {"starts": "96"}}.get(machine, {})
    drawn = [random_settings(machine, random.Random(f"{machine} unit {seed}"), most=2) for seed in range(2)]
    for settings in ({}, *drawn)[: 1 if machine == "automated-loom" else 3]:
        try:
            report = component.report(component.design(component.params.read(settings | fewer)), illustrated=False)
        except IlmekError:
            continue
        assert_si(report.as_json(), len(report.all_checks))
        for check in report.all_checks:
            assert_shown(check, check.as_json())
        for check, reason in zip(sorted(report.failed, key=lambda one: one.name), by_name(report.failed), strict=True):
            assert_shown(check, reason)


def by_name(checks: tuple[Check, ...]) -> list[dict[str, Any]]:
    return [reason.as_json() for reason in sorted(reasons(checks), key=lambda one: one.name)]


def assert_shown(check: Check, data: dict[str, Any]) -> None:
    """The text for people has the same numbers, in its own unit, to four digits."""
    assert parse_unit(data["unit"]).dimension == parse_unit(check.unit).dimension
    if data["shown"] in ("yes", "no"):
        return
    texts = data["shown"].split(f" {check.relation} ")
    for text, number in zip(texts, (check.value, check.limit), strict=True):
        if math.isfinite(number):
            assert parse_quantity(text, data["unit"]) == pytest.approx(number, rel=1e-3, abs=1e-6 * abs(check.limit))


@pytest.mark.parametrize("machine", ["cam", "beat-up"])
def test_units_of_parameters_are_those_of_their_defaults(machine: str) -> None:
    form = machine_form(machine).as_json()
    assert_si(form, 10)
    for entry in form["parameters"]:
        if isinstance(entry["default"], float):
            value = entry["default"] / parse_unit(entry["shown_unit"]).factor
            assert parse_quantity(f"{value!r}{entry['shown_unit']}", entry["unit"]) == pytest.approx(entry["default"])


@pytest.mark.parametrize(
    "arguments",
    [
        ("mechanism", str(EXAMPLES / "slider_crank_press.toml"), "--speed", "60rpm"),
        ("cyclogram", str(EXAMPLES / "press.toml")),
        ("reproduce",),
        ("chart", str(EXAMPLES / "medallion.png"), "--size", "30x40cm", "--quality", "25x25/dm"),
    ],
)
def test_units_of_a_command_are_those_of_its_numbers(arguments: tuple[str, ...]) -> None:
    result = CliRunner().invoke(main, [*arguments, "--json", "-"])
    assert result.exit_code in (0, 3), result.stderr
    data = json.loads(result.stdout)
    if arguments[0] == "cyclogram":
        data["results"].pop("cyclogram")  # as its file has it: texts with units, and the unit to draw a track in
    assert_si(data)


def test_units_of_the_workshop_index_are_those_of_its_numbers(tmp_path: Path) -> None:
    result = CliRunner().invoke(main, ["design", "cam", "--workshop", str(tmp_path / "parts"), "--json", "-"])
    assert result.exit_code == 0, result.stderr
    index = json.loads((tmp_path / "parts" / "workshop.json").read_text(encoding="utf-8"))
    assert_si(index)
    tables = [entry for entry in index["files"] if "tolerance" in entry]
    assert tables
    for entry in tables:
        assert parse_unit(entry["file_unit"]).dimension == parse_unit(entry["unit"]).dimension
