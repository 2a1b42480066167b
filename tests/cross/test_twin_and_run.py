"""The whole carpet in time beside the loom under its controller: two programs, the same nanosecond."""

import json
from pathlib import Path

from click.testing import CliRunner
from small_programme import small_programme

from ilmek.cli import main
from ilmek.io.programme_file import write_programme


def called(*args: str) -> dict[str, object]:
    result = CliRunner().invoke(main, args)
    assert result.exit_code == 0, result.output
    return dict(json.loads(result.stdout))


def test_a_controlled_loom_takes_the_time_of_the_twin(tmp_path: Path) -> None:
    path = tmp_path / "programme.ilmek"
    write_programme(path, small_programme(9, 40, 3, 4))
    twin = called("simulate", str(path), "--no-faults", "--seeds", "0", "--json", "-")
    loom = called("run", str(path), "--journal", str(tmp_path / "journal"), "--speed", "max", "--json", "-")
    assert loom["time"] == twin["time"]
    assert loom["knots"] == twin["knots"] == 360
