"""A power cut at any instant leaves the old result or the new one, whole; after the report of success the new one.

The operations of real runs are recorded, and every state that the disk may then be in is tried with the next run.
"""

import os
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import pytest
from power_cut import Recorder, State, Tree, materialise, read_tree, states

from ilmek.io.output import MANIFEST, Outputs, disk, outputs

OLD: Tree = {"a.txt": b"the old a", "b.txt": b"the old b", "old.txt": b"only old"}
NEW: Tree = {"a.txt": b"new a", "b.txt": b"the new b", "c.txt": b"the new c"}
NEXT: Tree = {"a.txt": b"next"}


@dataclass(frozen=True)
class Scenario:
    """Targets by relative path, each with the old content and the new one; None: there was none."""

    name: str
    targets: dict[str, tuple[Tree | bytes | None, Tree | bytes]]
    atomic: bool = True


SCENARIOS = [
    Scenario("new folder", {"out": (None, NEW)}),
    Scenario("new folder in new folders", {"deep/er/out": (None, NEW)}),
    Scenario("folder replaced", {"out": (OLD, NEW)}),
    Scenario("folder replaced by two renames", {"out": (OLD, NEW)}, atomic=False),
    Scenario("empty folder replaced", {"out": ({}, NEW)}),
    Scenario("empty folder replaced by two renames", {"out": ({}, NEW)}, atomic=False),
    Scenario("new file", {"a.json": (None, b"new")}),
    Scenario("file replaced", {"a.json": (b"the old one", b"new")}),
    Scenario("file replaced by a rename", {"a.json": (b"the old one", b"new")}, atomic=False),
    Scenario("folder and files", {"out": (OLD, NEW), "a.json": (b"the old one", b"new"), "b.html": (None, b"page")}),
    Scenario(
        "folder and files by renames",
        {"out": (OLD, NEW), "a.json": (b"the old one", b"new"), "b.html": (None, b"page")},
        atomic=False,
    ),
]


def write(root: Path, contents: dict[str, Tree | bytes], observe: Callable[[], None] = lambda: None) -> None:
    with Outputs(force=True) as made:
        for name, content in contents.items():
            if isinstance(content, bytes):
                made.write(root / name, content)
                continue
            with made.folder(root / name) as work:
                for file, data in content.items():
                    (work / file).write_bytes(cast(bytes, data))
                    observe()


def not_atomic(_first: Path, _second: Path) -> bool:
    return False


@pytest.fixture
def place(tmp_path: Path) -> Iterator[Path]:
    """A folder in memory, where the system has such; thousands of folders are made in it."""
    memory = Path("/dev/shm")
    if not os.access(memory, os.W_OK):
        yield tmp_path
        return
    with tempfile.TemporaryDirectory(dir=memory) as folder:
        yield Path(folder)


def recorded(scenario: Scenario, root: Path, monkeypatch: pytest.MonkeyPatch) -> Recorder:
    root.mkdir()
    old = {name: before for name, (before, _) in scenario.targets.items() if before is not None}
    for name in [name for name, before in old.items() if before == {}]:
        (root / name).mkdir()
        del old[name]
    write(root, old)
    with monkeypatch.context() as patched:
        if not scenario.atomic:
            patched.setattr(disk, "exchange", not_atomic)
        outputs._WRITTEN.clear()
        recorder = Recorder(root, lambda: bool(outputs._WRITTEN))
        with recorder.recording(disk):
            write(root, {name: after for name, (_, after) in scenario.targets.items()}, recorder.observe)
    return recorder


def without_manifest(found: Tree | bytes) -> Tree | bytes:
    return {name: one for name, one in found.items() if name != MANIFEST} if isinstance(found, dict) else found


def at(tree: Tree, path: str) -> Tree | bytes | None:
    found: Tree | bytes | None = tree
    for name in path.split("/"):
        found = found.get(name) if isinstance(found, dict) else None
    return None if found is None else without_manifest(found)


def hidden(tree: Tree) -> Iterator[str]:
    for name, inner in tree.items():
        if name.endswith((".part", ".old", ".kept")):
            yield name
        elif isinstance(inner, dict):
            yield from hidden(inner)


def wrong(scenario: Scenario, state: State, root: Path) -> str:
    """What is wrong with the state after the next run has looked at it, and after it has written; empty if nothing."""
    materialise(state.tree, root)
    with Outputs(force=True) as next_run:
        for name, (_, new) in scenario.targets.items():
            (next_run.expect_file if isinstance(new, bytes) else next_run.expect_folder)(root / name)
    repaired = read_tree(root)
    for name, (old, new) in scenario.targets.items():
        if (found := at(repaired, name)) not in ((new,) if state.reported else (old, new)):
            return f"{name} is {found}"
    if any(hidden(repaired)):
        return f"left: {', '.join(hidden(repaired))}"
    write(root, {name: b"next" if isinstance(new, bytes) else NEXT for name, (_, new) in scenario.targets.items()})
    written = read_tree(root)
    for name in scenario.targets:
        if at(written, name) not in (b"next", NEXT):
            return f"the next run gives {at(written, name)}"
    return f"left by the next run: {list(hidden(written))}" if any(hidden(written)) else ""


def tried(scenario: Scenario, place: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[int, dict[str, State]]:
    """The number of states that were tried, and the first state for each message of what is wrong."""
    recorder = recorded(scenario, place / "real", monkeypatch)
    found: dict[str, State] = {}
    number = 0
    with monkeypatch.context() as patched:
        patched.setattr(disk, "sync", lambda *_, **__: None)
        for state in states(recorder):
            number += 1
            message = wrong(scenario, state, place / str(number))
            if message:
                found.setdefault(message, state)
    return number, found


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda scenario: scenario.name)
def test_a_power_cut_leaves_the_old_result_or_the_new_one(
    scenario: Scenario, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    number, found = tried(scenario, place, monkeypatch)
    assert not found, "\n".join(f"after step {state.step}: {message}; {state.tree}" for message, state in found.items())
    assert number > 10


@pytest.mark.parametrize("folders", [True, False])
def test_the_simulation_finds_a_missing_sync(place: Path, monkeypatch: pytest.MonkeyPatch, folders: bool) -> None:
    scenario = next(scenario for scenario in SCENARIOS if scenario.name == "folder replaced by two renames")
    recorder = recorded(scenario, place / "real", monkeypatch)
    recorder.operations[:] = [
        one for one in recorder.operations if not (one.kind == "sync" and one.node and one.node.folder is folders)
    ]
    monkeypatch.setattr(disk, "sync", lambda *_, **__: None)
    assert any(wrong(scenario, state, place / str(number)) for number, state in enumerate(states(recorder)))
