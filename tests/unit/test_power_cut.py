"""A power cut at any instant leaves the old result or the new one, whole; after the report of success the new one.

The operations of real runs are recorded, and every state that the disk may then be in is tried with the next run.
"""

from pathlib import Path

import effort
import pytest
from output_scenarios import SCENARIOS, Scenario, at, expect, hidden, news, nexts, not_atomic, prepare, write
from power_cut import Recorder, State, materialise, read_tree, states

from ilmek.io.output import disk, outputs


def recorded(scenario: Scenario, root: Path, monkeypatch: pytest.MonkeyPatch) -> Recorder:
    prepare(scenario, root)
    with monkeypatch.context() as patched:
        if not scenario.atomic:
            patched.setattr(disk, "exchange", not_atomic)
        outputs._WRITTEN.clear()
        recorder = Recorder(root, lambda: bool(outputs._WRITTEN))
        with recorder.recording(disk):
            write(root, news(scenario), recorder.observe)
    return recorder


def wrong(scenario: Scenario, state: State, root: Path) -> str:
    """What is wrong with the state after the next run has looked at it, and after it has written; empty if nothing."""
    materialise(state.tree, root)
    expect(scenario, root)
    repaired = read_tree(root)
    for name, (old, new) in scenario.targets.items():
        if (found := at(repaired, name)) not in ((new,) if state.reported else (old, new)):
            return f"{name} is {found}"
    if any(hidden(repaired)):
        return f"left: {', '.join(hidden(repaired))}"
    write(root, nexts(scenario))
    written = read_tree(root)
    for name, content in nexts(scenario).items():
        if at(written, name) != content:
            return f"the next run gives {at(written, name)}"
    return f"left by the next run: {list(hidden(written))}" if any(hidden(written)) else ""


def tried(scenario: Scenario, memory: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[int, dict[str, State]]:
    """The number of states that were tried, and the first state for each message of what is wrong."""
    recorder = recorded(scenario, memory / "real", monkeypatch)
    found: dict[str, State] = {}
    number = 0
    with monkeypatch.context() as patched:
        patched.setattr(disk, "sync", lambda *_, **__: None)
        for state in states(recorder, effort.first(), effort.number(12, 200)):
            number += 1
            message = wrong(scenario, state, memory / str(number))
            if message:
                found.setdefault(message, state)
    return number, found


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda scenario: scenario.name)
@pytest.mark.one_in(3)
def test_a_power_cut_leaves_the_old_result_or_the_new_one(
    scenario: Scenario, memory: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    number, found = tried(scenario, memory, monkeypatch)
    assert not found, "\n".join(f"after step {state.step}: {message}; {state.tree}" for message, state in found.items())
    assert number > 10


@pytest.mark.parametrize("folders", [True, False])
def test_the_simulation_finds_a_missing_sync(memory: Path, monkeypatch: pytest.MonkeyPatch, folders: bool) -> None:
    scenario = next(scenario for scenario in SCENARIOS if scenario.name == "folder replaced by two renames")
    recorder = recorded(scenario, memory / "real", monkeypatch)
    recorder.operations[:] = [
        one for one in recorder.operations if not (one.kind == "sync" and one.node and one.node.folder is folders)
    ]
    monkeypatch.setattr(disk, "sync", lambda *_, **__: None)
    assert any(wrong(scenario, state, memory / str(number)) for number, state in enumerate(states(recorder)))
