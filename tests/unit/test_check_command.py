"""`ilmek check` and `ilmek convert` on files."""

import json
import sqlite3
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from edited_programme import edited, swept, with_knot
from small_programme import small_programme

from ilmek.cli import main
from ilmek.io.any_programme import write_any_programme
from ilmek.jobs.check import check_programme
from ilmek.loom.operations import LoomProgramme

NAMES = {"ok", "knots", "errors", "error_count", "digest", "loom", "rows", "columns", "heads", "totals"}
"""Names of the JSON: they are stable."""

TOTALS = {"time", "colour_changes", "travel", "idle_travel", "stops", "bobbin_changes", "package_changes"}


def run(*arguments: str | Path) -> Result:
    return CliRunner().invoke(main, [str(one) for one in arguments])


def written(file: Path, programme: LoomProgramme) -> Path:
    write_any_programme(file, file.suffix, programme)
    return file


@pytest.fixture
def broken() -> LoomProgramme:
    """A programme that ties knot 7 of the second row from a tube of another yarn."""
    return edited(swept(small_programme()), 1, lambda row: with_knot(row, 5, tube=(row.tubes[5] + 1) % 3))


@pytest.mark.parametrize("ending", [".ilmek", ".txt"])
def test_a_sound_programme_is_proved(tmp_path: Path, ending: str) -> None:
    file = written(tmp_path / f"p{ending}", small_programme())
    result = run("check", file)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.startswith("proved: 144 knots\n")
    found: dict[str, Any] = json.loads(run("check", file, "--json", "-").stdout)
    assert (set(found), set(found["totals"])) == (NAMES, TOTALS)
    assert (found["ok"], found["knots"], found["errors"], found["error_count"]) == (True, 144, [], 0)
    assert found["digest"] == small_programme().digest


def test_an_error_has_the_line_of_the_text(tmp_path: Path, broken: LoomProgramme) -> None:
    file, text = written(tmp_path / "p.ilmek", broken), tmp_path / "p.txt"
    assert run("convert", file, text).exit_code == 0
    found = [json.loads(run("check", one, "--json", "-").stdout) for one in (file, text)]
    assert found[0] == found[1]
    (error,) = found[0]["errors"]
    assert text.read_text().splitlines()[error["line"] - 1] == "tie 7 tube 1"
    assert error["what"] == "row 2: knot 7 of head 1: tube 1 has yarn 1, the chart has yarn 3"
    result = run("check", file)
    assert result.exit_code == 3
    assert result.stdout.startswith("NOT proved: 1 error in 144 knots\n")
    assert result.stdout.endswith(f"p.ilmek, line {error['line']}: {error['what']}\n")


def test_lines_that_do_not_agree_are_errors_of_a_check(tmp_path: Path) -> None:
    file = written(tmp_path / "p.txt", swept(small_programme()))
    lines = file.read_text().splitlines()
    at = lines.index("tube 3")
    file.write_text("\n".join([*lines[:at], "tube 2", *lines[at + 1 :], ""]))
    result = run("check", file, "--json", "-")
    assert result.exit_code == 3
    what = "`tube 2` is not the change of tube before the next knot"
    assert json.loads(result.stdout)["errors"] == [{"line": at + 1, "what": what}]
    refused = run("convert", file, tmp_path / "p.ilmek")
    assert refused.exit_code == 2
    assert f"p.txt, line {at + 1}: {what}" in refused.stderr
    assert not (tmp_path / "p.ilmek").exists()


def test_a_file_whose_rows_were_changed_is_proved_row_by_row(tmp_path: Path, broken: LoomProgramme) -> None:
    """The rows of another programme put into a file: its digest is another one, and the broken rule has its line."""
    file = written(tmp_path / "p.ilmek", swept(small_programme()))
    other = written(tmp_path / "other.ilmek", broken)
    with sqlite3.connect(file) as base:
        base.execute("ATTACH ? AS other", (str(other),))
        base.execute("UPDATE row SET data = (SELECT data FROM other.row AS new WHERE new.number = row.number)")
    base.close()
    found = check_programme(file)
    assert [error.line for error in found.errors] == [1, check_programme(other).errors[0].line]
    assert "by its operations: the file was changed" in found.errors[0].what
    refused = run("convert", file, tmp_path / "p.txt")
    assert (refused.exit_code, "its digest is not that of its rows" in refused.stderr) == (2, True)


def test_a_file_is_replaced_only_with_force(tmp_path: Path) -> None:
    file = written(tmp_path / "p.ilmek", small_programme())
    (tmp_path / "p.txt").write_text("mine")
    assert run("convert", file, tmp_path / "p.txt").exit_code == 2
    assert (tmp_path / "p.txt").read_text() == "mine"
    assert run("convert", file, tmp_path / "p.txt", "--force").exit_code == 0
    assert run("convert", tmp_path / "p.txt", tmp_path / "again.ilmek").exit_code == 0
    assert (tmp_path / "again.ilmek").read_bytes() == file.read_bytes()


def test_errors_are_listed_up_to_a_number(tmp_path: Path) -> None:
    programme = swept(small_programme(40, 240, 2, 3, weft_rows=9))
    loading = programme.setup.loading[:, [1, 2, 0]]
    found = check_programme(written(tmp_path / "p.ilmek", edited(programme, loading=loading)))
    assert len(found.errors) == 1000 < found.count
    assert [error.line for error in found.errors] == sorted(error.line for error in found.errors)
    shown = run("check", tmp_path / "p.ilmek")
    assert f"… {found.count - 20:,} more: see --json" in shown.stdout
