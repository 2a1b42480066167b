"""The command line and the Python of a state: both are run, and give the same numbers."""

import contextlib
import io
import json
import math
import os
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from ilmek.cli import main
from ilmek.errors import ParameterError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.commands import CommandRequest, ShownCommand, shown_command

EXAMPLE = Path(__file__).parents[2] / "src" / "ilmek" / "data" / "example_project"


@pytest.fixture
def here(tmp_path: Path) -> Iterator[Path]:
    before = Path.cwd()
    os.chdir(EXAMPLE)
    yield tmp_path
    os.chdir(before)


def shown(kind: str, **more: Any) -> ShownCommand:
    return shown_command(CommandRequest(kind, **more), Context(str(EXAMPLE)))


def of_command(command: str) -> dict[str, Any]:
    program, *arguments = shlex.split(command)
    assert program == "ilmek"
    result = CliRunner().invoke(main, [*arguments, "--json", "-"])
    assert result.exit_code in (0, 3), result.output
    return json.loads(result.stdout)


def of_python(text: str, name: str) -> Any:
    found: dict[str, Any] = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(text, "shown", "exec"), found)
    return found[name]


def numbers(data: Any) -> list[float]:
    """All numbers of plain data, in their order."""
    if isinstance(data, dict):
        return [number for value in data.values() for number in numbers(value)]
    if isinstance(data, list | tuple):
        return [number for value in data for number in numbers(value)]
    return [float(data)] if isinstance(data, int | float) and math.isfinite(data) else []


@pytest.mark.parametrize(
    "more",
    [
        {"machine": "shedding", "settings": {"lift": "50 mm", "pressure_angle_limit": "30deg"}},
        {"machine": "shedding", "settings": {"lift": 0.05, "pressure_angle_limit": 0.5}},
        {"path": "machines/shedding.toml", "settings": {"lift": "45mm"}},
        {"path": "machines/cam.toml"},
    ],
)
def test_a_design_by_both(here: Path, more: dict[str, Any]) -> None:
    text = shown("machine", **more)
    report = of_python(text.python, "report")
    assert numbers(of_command(text.command)["results"]) == numbers(report.as_json()["results"])


@pytest.mark.parametrize("options", [{}, {"over": "10deg..50deg", "speed": "90rpm", "steps": 5}, {"at": "30deg"}])
def test_a_mechanism_by_both(here: Path, options: dict[str, Any]) -> None:
    text = shown("linkage", path="linkages/slider-crank-press.toml", options=options)
    run = of_python(text.python, "run")
    found = numbers(of_command(text.command)["results"])
    assert found == numbers(run.report.as_json()["results"])
    assert len(found) > 5


@pytest.mark.parametrize("options", [{}, {"solve": "acceleration"}])
def test_a_cyclogram_by_both(here: Path, options: dict[str, Any]) -> None:
    text = shown("cyclogram", path="cyclograms/press.toml", options=options)
    given = of_command(text.command)
    python = of_python(text.python.replace("print(report(", "shown = (report("), "shown").as_json()
    assert numbers(given) == numbers(python)


def test_a_carpet_by_both(here: Path) -> None:
    (here / "carpet.toml").write_text('plain = "ivory"\nsize = "20x30cm"\n\n[[border]]\nyarn = "dark red"\nwidth = 3\n')
    os.chdir(here)
    text = shown("chart", path="carpet.toml")
    charted = of_python(text.python, "charted")
    assert (here / "out" / "carpet-chart" / "chart.png").is_file()
    command = text.command.replace("out/carpet-chart", "out/other")
    found = of_command(command)
    assert found["knots"] == charted.chart.knots.size
    assert {file.name for file in (here / "out/other").iterdir()} == {
        file.name for file in (here / "out/carpet-chart").iterdir()
    }
    assert shlex.split(shown("carpet", path="a b.toml").command)[2:] == ["a b.toml", "--out", "out/a b", "--force"]
    assert "ilmek.weave('a b.toml', 'out/a b', force=True)" in shown("carpet", path="a b.toml").python


def test_an_unknown_state_is_refused(here: Path) -> None:
    for kind, more in (
        ("poem", {}),
        ("linkage", {"options": {"colour": "red"}}),
        ("cyclogram", {"options": {"solve": "x"}}),
    ):
        with pytest.raises(ParameterError):
            shown(kind, **more)
