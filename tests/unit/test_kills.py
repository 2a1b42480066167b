"""A few of the kills of `make kills`: each signal loses nothing at a random instant, and messages are true."""

from pathlib import Path

from kills.__main__ import kills
from kills.case import SIGNALS, bench, killed
from kills.commands import COMMANDS


def test_kills_lose_nothing(tmp_path: Path) -> None:
    command = next(command for command in COMMANDS if command.name == "mechanism")
    made = bench(tmp_path / "run", command)
    results = [killed(made, kill, again=index == 0) for index, kill in enumerate(kills(made, len(SIGNALS), seed=3))]
    assert [f"{result.kill}: {text}" for result in results for text in result.findings] == []
    assert {result.outcome for result in results} >= {"old"}
