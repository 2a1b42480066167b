"""The page of limits states the limits of the program."""

import re
from importlib import import_module
from pathlib import Path

import pytest
from click.testing import CliRunner

from ilmek.cli import main

PAGE = Path(__file__).parents[2] / "docs/reference/limits.md"
ROW = re.compile(r"^\| (?P<what>[^|]+) \| (?P<limit>[^|]+) \| `(?P<constant>[\w.]+)` \|$", re.MULTILINE)
ROWS = [found.group("limit", "constant") for found in ROW.finditer(PAGE.read_text(encoding="utf-8"))]
UNITS = {"kB": 1e3, "MB": 1e6, "s": 1.0, "characters": 1.0, "pixels": 1.0, "": 1.0}


def test_the_page_has_limits() -> None:
    assert len(ROWS) > 40


@pytest.mark.parametrize(("limit", "constant"), ROWS, ids=[constant for _, constant in ROWS])
def test_a_limit_is_that_of_the_program(limit: str, constant: str) -> None:
    module, _, name = constant.rpartition(".")
    number, _, unit = limit.replace(",", "").partition(" ")
    assert getattr(import_module(module), name) == float(number) * UNITS[unit]


COMMANDS = ["weave", "chart", "mechanism", "cyclogram", "knot", "inspect", "simulate", "call", "check", "convert"]
COMMANDS += ["run", "serve", "status", "hold", "resume", "stop", "plan", "studio"]


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_of_a_command_states_its_limits(name: str) -> None:
    shown = " ".join(CliRunner().invoke(main, [name, "--help"]).stdout.partition("Limits:")[2].split())
    stated = re.findall(r"\d[\d,]*(?: [kM]B)?", shown)
    assert stated
    warps = {"10,000"}  # the bound of --warps
    assert set(stated) <= {limit.partition(" ")[0] for limit, _ in ROWS} | {limit for limit, _ in ROWS} | warps
