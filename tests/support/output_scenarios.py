"""Outputs of a call that are written over old ones: what there was, what is written, and how to look at it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from power_cut import Tree

from ilmek.io.output import MANIFEST, Outputs

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


def prepare(scenario: Scenario, root: Path) -> None:
    """Write the old results."""
    root.mkdir()
    old = {name: before for name, (before, _) in scenario.targets.items() if before is not None}
    for name in [name for name, before in old.items() if before == {}]:
        (root / name).mkdir()
        del old[name]
    write(root, old)


def news(scenario: Scenario) -> dict[str, Tree | bytes]:
    """The new contents by path."""
    return {name: new for name, (_, new) in scenario.targets.items()}


def nexts(scenario: Scenario) -> dict[str, Tree | bytes]:
    """The contents of a run after that."""
    return {name: b"next" if isinstance(new, bytes) else NEXT for name, (_, new) in scenario.targets.items()}


def expect(scenario: Scenario, root: Path) -> None:
    """What a next run does before it works: repair and check."""
    with Outputs(force=True) as next_run:
        for name, (_, new) in scenario.targets.items():
            (next_run.expect_file if isinstance(new, bytes) else next_run.expect_folder)(root / name)


def without_manifest(found: Tree | bytes) -> Tree | bytes:
    return {name: one for name, one in found.items() if name != MANIFEST} if isinstance(found, dict) else found


def at(tree: Tree, path: str) -> Tree | bytes | None:
    found: Tree | bytes | None = tree
    for name in path.split("/"):
        found = found.get(name) if isinstance(found, dict) else None
    return None if found is None else without_manifest(found)


def hidden(tree: Tree) -> Iterator[str]:
    for name, inner in tree.items():
        if name.endswith((".part", ".old", ".kept", ".kept.json")):
            yield name
        elif isinstance(inner, dict):
            yield from hidden(inner)
