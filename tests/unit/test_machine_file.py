"""Machine files: a machine and its settings; errors name the line; --set wins."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

import ilmek
from ilmek.cli import main
from ilmek.errors import ParameterError
from ilmek.jobs.machine_file import read_machine_order

EXAMPLE = Path(__file__).parents[2] / "src" / "ilmek" / "data" / "example_project"


def written(folder: Path, text: str, name: str = "m.toml") -> Path:
    path = folder / name
    path.write_text(text)
    return path


def test_a_file_gives_what_the_options_give(tmp_path: Path) -> None:
    file = written(tmp_path, 'machine = "shedding"\n[settings]\nlift = "60mm"\n')
    by_file = CliRunner().invoke(main, ["design", str(file), "--json", "-"])
    by_options = CliRunner().invoke(main, ["design", "shedding", "lift=60mm", "--json", "-"])
    assert by_file.exit_code == by_options.exit_code == 0
    assert json.loads(by_file.stdout) == json.loads(by_options.stdout)
    assert ilmek.design(str(file)).as_json() == json.loads(by_file.stdout)


def test_settings_of_the_command_win_also_by_an_alias(tmp_path: Path) -> None:
    file = written(tmp_path, '{"machine": "shedding", "settings": {"lift": 0.06, "speed": "60rpm"}}', "m.json")
    order = read_machine_order(str(file), {"lift": "70mm"})
    assert order.settings == {"lift": "70mm", "speed": "60rpm"}
    assert order.machine == "shedding"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            'machine = "beat-up"\n[settings]\nswing = "900deg"\n',
            "line 3, settings.swing: swing=900 deg is out of bounds",
        ),
        ('machine = "shedding"\n[settings]\n\nliftt = "1mm"\n', r"line 4, settings\.liftt: .*did you mean lift"),
        ('machine = "sheding"\n', r"line 1, machine: .*sheding"),
        ('machine = "shedding"\nsetings = {}\n', r"line 2, setings: unknown key .*settings"),
        ("[settings]\n", "has no 'machine'"),
        ('machine = "shedding"\n[settings]\nlift = [1]\n', r"line 3, settings\.lift: .*is not a value"),
        ('machine = "shedding"\n[settings\n', "line 2"),
        ("machine = 3\n", "line 1, machine: 3 is not text"),
    ],
)
def test_an_error_names_the_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        read_machine_order(str(written(tmp_path, text)), {})


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("path", sorted(EXAMPLE.glob("*/*.toml")), ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_each_file_of_the_example_runs_by_its_command(path: Path) -> None:
    command = {"linkages": "mechanism", "cyclograms": "cyclogram"}.get(path.parent.name, "design")
    result = CliRunner().invoke(main, [command, str(path), "--json", "-"])
    assert result.exit_code == 0, result.output
