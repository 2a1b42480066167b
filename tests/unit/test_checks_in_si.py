"""Value and limit of a check are in SI; its unit is only that to show it in."""

import ast
import math
from functools import cache
from pathlib import Path

import pytest
from default_machines import default_report
from sources import tree_of

import ilmek
from ilmek.cli.terminal import show_checks
from ilmek.machines import ENTRIES
from ilmek.report import Check
from ilmek.units import format_quantity, parse_quantity, parse_unit

SOURCES = sorted(Path(ilmek.__file__).parent.rglob("*.py"))
CALLS = {"at_most", "at_least", "Check"}
UNITS = {
    "dm",
    "cm",
    "mm",
    "um",
    "km",
    "inch",
    "foot",
    "g",
    "mg",
    "tonne",
    "ms",
    "minute",
    "hour",
    "day",
    "mrad",
    "deg",
} | {*("turn", "rpm", "kN", "mN", "kPa", "MPa", "GPa", "from_si")}

LARGEST = {"deg": 4 * math.pi, "mm": 20.0, "um": 0.1, "%": 10.0, "kg": 1e5}
"""Magnitudes [SI] that no angle, length, share or mass of a machine exceeds: degrees or millimetres would."""

WORDS = {"yes": 1.0, "no": 0.0}
"""The shown words of a check that is a plain yes or no."""

LEAST = {"MPa": 1e5, "GPa": 1e8, "h": 3600.0, "min": 30.0, "kN": 10.0}
"""Magnitudes [SI] that no limit other than 0 is below: megapascals or hours would be."""


@cache
def checks(machine: str) -> tuple[Check, ...]:
    return tuple(default_report(machine).all_checks)


@pytest.mark.parametrize("machine", ENTRIES)
@pytest.mark.one_in(3)
def test_value_and_limit_have_the_magnitude_of_si(machine: str) -> None:
    for check in checks(machine):
        for number in filter(math.isfinite, (check.value, check.limit)):
            assert abs(number) <= LARGEST.get(check.unit, math.inf), check
        if check.limit and math.isfinite(check.limit):
            assert abs(check.limit) >= LEAST.get(check.unit, 0.0), check


@pytest.mark.parametrize("machine", ENTRIES)
def test_the_shown_text_is_the_number_of_the_json_over_its_unit(machine: str, monkeypatch: pytest.MonkeyPatch) -> None:
    rows: list[tuple[str, ...]] = []
    monkeypatch.setattr("ilmek.cli.terminal.show_table", lambda _, found, **__: rows.extend(found))
    show_checks(checks(machine))
    by_text = {(name, source): (value, limit) for _, name, value, limit, source in rows}
    for check in checks(machine):
        found = check.as_json()
        shown = by_text[found["name"], found["source"]]
        if shown[1] == "yes":
            assert (WORDS[shown[0]], found["limit"], found["unit"]) == (found["value"], 1.0, ""), check
            continue
        for text, number in zip((shown[0], shown[1].partition(" ")[2]), (found["value"], found["limit"]), strict=True):
            if number is not None and math.isfinite(number):
                noise = 1e-6 * abs(found["limit"] or 0.0)
                assert parse_quantity(text, found["unit"]) == pytest.approx(number, rel=1e-3, abs=noise), check


def converted(tree: ast.AST) -> list[str]:
    """Values and limits of checks that are divided by a unit, or written in one, before they are compared."""
    calls = (node for node in ast.walk(tree) if isinstance(node, ast.Call))
    named = (call for call in calls if getattr(call.func, "id", getattr(call.func, "attr", "")) in CALLS)
    return [
        ast.unparse(argument)
        for call in named
        for argument in call.args[1:3]
        for part in ast.walk(argument)
        if (isinstance(part, ast.BinOp) and isinstance(part.op, ast.Div) and getattr(part.right, "id", "") in UNITS)
        or (isinstance(part, ast.Call) and getattr(part.func, "id", "") in UNITS)
    ]


def test_no_check_converts_its_numbers() -> None:
    calling = [path for path in SOURCES if any(f"{call}(" in path.read_text(encoding="utf-8") for call in CALLS)]
    assert len(calling) > 50
    assert {str(path): converted(tree_of(path)) for path in calling} == {str(path): [] for path in calling}


@pytest.mark.parametrize(
    "text", ["at_most('a', angle / deg, 30 * deg, 'deg', '')", "at_least('a', from_si(x, u), 1, u, '')"]
)
def test_a_converted_number_is_found(text: str) -> None:
    assert converted(ast.parse(text))


def test_degrees_for_radians_are_found() -> None:
    assert LARGEST["deg"] < 30
    assert parse_unit("deg").factor == math.pi / 180
    assert format_quantity(30.0, "deg") == "1719 deg"
