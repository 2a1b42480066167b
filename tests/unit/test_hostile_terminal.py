"""What a terminal shows: no text of a file or an argument controls it, and every name can be written."""

import json
import os
from pathlib import Path

import pytest
from click.testing import CliRunner

from ilmek.cli import main, terminal
from ilmek.cli.report import show_report
from ilmek.errors import printable
from ilmek.io.json_file import json_text
from ilmek.report import Column, Report, Result, Table
from ilmek.viz.page import machine_page

HOSTILE = "a\x1b]0;title\x07b\x9bc\u202ed\u2066e\udce9f\rg\x00h"
EXAMPLES = Path(__file__).parents[2] / "examples"


def check_shown(text: str) -> None:
    assert text.replace("\n", "").isprintable()
    assert "title" in text


def test_a_text_is_printable() -> None:
    check_shown(printable(HOSTILE))
    assert printable("a\tb\u00a0c\nd é ×") == "a b c\nd é ×"


@pytest.mark.parametrize(
    "show",
    [
        lambda: terminal.say(HOSTILE),
        lambda: terminal.note(HOSTILE),
        lambda: terminal.show_pairs([(HOSTILE, HOSTILE)]),
        lambda: terminal.show_table((HOSTILE, "b"), [(HOSTILE, "1")], [("2", HOSTILE)]),
        lambda: show_report(
            Report(
                "machine",
                HOSTILE,
                {},
                (Result("name", HOSTILE, "", HOSTILE),),
                (),
                (Table("table", HOSTILE, (Column(HOSTILE),), ((HOSTILE,),), brief=True),),
            )
        ),
    ],
    ids=["say", "note", "pairs", "table", "report"],
)
def test_every_output_is_printable(show, capsys: pytest.CaptureFixture[str]) -> None:
    show()
    shown = capsys.readouterr()
    check_shown(shown.out + shown.err)


def test_commands_print_through_the_terminal_module_only() -> None:
    folder = Path(terminal.__file__).parent
    for source in folder.glob("*.py"):
        if source.name != "terminal.py":
            assert "console()" not in source.read_text(encoding="utf-8"), source.name


@pytest.mark.parametrize("words", [["design", "beat-up", "--set", f"swing={HOSTILE}"], [HOSTILE], ["knot", HOSTILE]])
def test_an_argument_is_shown_in_one_printable_line(words: list[str]) -> None:
    result = CliRunner().invoke(main, [word.replace("\x00", "") for word in words])
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1
    check_shown(result.stderr)


def test_a_long_argument_is_shortened() -> None:
    result = CliRunner().invoke(main, ["design", "beat-up", "--set", "x" * 100_000])
    assert result.exit_code == 2
    assert len(result.stderr) < 2100


def test_json_and_pages_hold_any_name() -> None:
    data = {HOSTILE: [HOSTILE, Path(HOSTILE.replace("\x00", ""))]}
    json_text(data).encode("utf-8")
    assert "\\ud" not in json_text(data)
    json.loads(json_text(data))
    machine_page(Report("machine", HOSTILE, {}, (Result("name", HOSTILE, "", "meaning"),), ())).encode("utf-8")


def test_a_file_name_in_latin_1(tmp_path: Path) -> None:
    path = Path(os.fsdecode(os.fsencode(tmp_path) + b"/pr\xe9ss.toml"))
    path.write_bytes((EXAMPLES / "press.toml").read_bytes())
    page, data = tmp_path / "page.html", tmp_path / "data.json"
    result = CliRunner().invoke(main, ["cyclogram", str(path), "--report", str(page), "--json", str(data)])
    assert result.exit_code == 3, result.output  # a check of the example fails
    assert "press" in page.read_text(encoding="utf-8")
    path.write_text("period = 1", encoding="utf-8")
    result = CliRunner().invoke(main, ["cyclogram", str(path)])
    assert result.exit_code == 2
    assert "pr�ss.toml" in result.stderr
