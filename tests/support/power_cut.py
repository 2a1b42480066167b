"""Power cuts, simulated: which states can a disk be in if the power fails at some instant of a run?

A run writes into a real folder while `Recorder` notes its operations. In the model a disk keeps

    the content of a file         as it was when the file was synced last; what came later may be there, in part, or not
    a change of names             if a folder that it changes was synced afterwards; any subset of the later ones

A rename or an exchange is one change, in both of its folders at once, as every file system with a journal has it. That
subsets are arbitrary is stricter than such a file system, which keeps their order. `states` lists what the disk may
hold after each operation, `materialise` makes it a real folder, on which the next run can be tried.
"""

import contextlib
import itertools
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

MOST = 48
"""Largest number of states that are tried for one instant; of more, a seeded sample."""

Tree: TypeAlias = dict[str, "bytes | Tree"]
"""A folder: file contents and folders by name."""


@dataclass(eq=False)
class Node:
    """A file or a folder. `content` of a file is the latest; `entries` of a folder are those at the begin."""

    folder: bool
    content: bytes = b""
    entries: dict[str, "Node"] = field(default_factory=dict)


Change: TypeAlias = list[tuple[Node, str, Node | None]]
"""Names that change at once: folder, name, what it then means."""


@dataclass(frozen=True, eq=False)
class Operation:
    """A change of names, new content of a file, or a sync; `reported` if the run had then reported success."""

    kind: str
    node: Node | None
    change: Change
    content: bytes
    reported: bool


def functions(module: ModuleType) -> dict[str, Callable[..., Any]]:
    """The public functions of a module by name."""
    own = {name: value for name, value in vars(module).items() if getattr(value, "__module__", "") == module.__name__}
    return {name: value for name, value in own.items() if callable(value) and not name.startswith("_")}


class Recorder:
    """Notes the operations of a run in `root`.

    reported  whether the run has reported its success
    """

    def __init__(self, root: Path, reported: Callable[[], bool]) -> None:
        self.root, self.reported = root, reported
        self.operations: list[Operation] = []
        self.now: dict[Node, dict[str, Node]] = {}
        self._known: dict[int, Node] = {}
        self.start = self._scanned(root)
        self.first = {node: node.content for node in self._known.values()}

    @contextlib.contextmanager
    def recording(self, disk: ModuleType) -> Iterator[None]:
        """Note what the functions of a module do; each takes paths."""
        names = [
            name
            for name, value in vars(disk).items()
            if callable(value) and getattr(value, "__module__", "") == disk.__name__ and not name.startswith("_")
        ]
        before = {name: getattr(disk, name) for name in names}
        for name in names:
            setattr(disk, name, self._noted(name, before[name]))
        try:
            yield
            self.observe()
        finally:
            for name, function in before.items():
                setattr(disk, name, function)

    def observe(self) -> None:
        """Note everything that has changed since, in one change of names for each name."""
        self._compare(self.root, self.start)

    def _noted(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any, **settings: Any) -> Any:
            self.observe()
            change: Change = []
            synced = None
            if name == "sync":
                synced = self._at(arguments[0])
            elif name in ("rename", "replace", "exchange", "keep"):
                (source, its), (target, other) = (self._entry(path) for path in arguments[:2])
                node, old = self.now[source][its], self.now[target].get(other)
                change = [(target, other, node)]
                if name != "keep":
                    change.append((source, its, old if name == "exchange" else None))
            value = function(*arguments, **settings)
            if synced is not None:
                self._note("sync", synced)
            if change and value is not False:
                self._change(change)
            self.observe()
            return value

        return call

    def _note(self, kind: str, node: Node | None = None, change: Change | None = None, content: bytes = b"") -> None:
        self.operations.append(Operation(kind, node, change or [], content, self.reported()))

    def _change(self, change: Change) -> None:
        for folder, name, node in change:
            if node is None:
                self.now[folder].pop(name, None)
            else:
                self.now[folder][name] = node
        self._note("names", change=change)

    def _entry(self, path: Path) -> tuple[Node, str]:
        return self._at(path.parent), path.name

    def _at(self, path: Path) -> Node:
        node = self.start
        for name in path.relative_to(self.root).parts:
            node = self.now[node][name]
        return node

    def _scanned(self, path: Path) -> Node:
        node = Node(path.is_dir())
        self._known[path.stat().st_ino] = node
        if node.folder:
            node.entries = {entry.name: self._scanned(entry) for entry in sorted(path.iterdir())}
            self.now[node] = dict(node.entries)
        else:
            node.content = path.read_bytes()
        return node

    def _compare(self, path: Path, folder: Node) -> None:
        found = {entry.name: entry for entry in sorted(path.iterdir())}
        for name in [name for name in self.now[folder] if name not in found]:
            self._change([(folder, name, None)])
        for name, entry in found.items():
            node = self.now[folder].get(name)
            if node is None or node is not self._known.get(entry.stat().st_ino):
                node = Node(entry.is_dir())
                self._known[entry.stat().st_ino] = node
                if node.folder:
                    self.now[node] = {}
                self._change([(folder, name, node)])
            if node.folder:
                self._compare(entry, node)
            elif (content := entry.read_bytes()) != node.content:
                node.content = content
                self._note("content", node, content=content)


@dataclass(frozen=True)
class State:
    """What a disk may hold after an operation.

    step      number of operations that were begun
    reported  whether the run had reported its success before
    """

    step: int
    reported: bool
    tree: Tree


def states(recorder: Recorder, seed: int = 0, most: int = MOST) -> Iterator[State]:
    """All states, each once, of few of them; else a sample of about `most` for each instant."""
    chance = random.Random(seed)
    forced: list[int] = []
    pending: list[int] = []
    durable: dict[Node, bytes] = {}
    latest: dict[Node, bytes] = {}
    seen: set[str] = set()
    for step in range(len(recorder.operations) + 1):
        reported = step > 0 and recorder.operations[step - 1].reported
        for chosen, contents in _choices(recorder, pending, latest, durable, (chance, most)):
            tree = _tree(recorder, sorted([*forced, *chosen]), {**durable, **contents})
            if tree is not None and (key := repr((reported, tree))) not in seen:
                seen.add(key)
                yield State(step, reported, tree)
        if step == len(recorder.operations):
            return
        done = recorder.operations[step]
        if done.kind == "names":
            pending.append(step)
        elif done.kind == "content":
            assert done.node is not None
            latest[done.node] = done.content
        elif done.node is not None and done.node.folder:
            touched = [i for i in pending if any(folder is done.node for folder, _, _ in recorder.operations[i].change)]
            forced += touched
            pending = [index for index in pending if index not in touched]
        elif done.node in latest:
            assert done.node is not None
            durable[done.node] = latest.pop(done.node)


def _choices(
    recorder: Recorder,
    pending: list[int],
    latest: dict[Node, bytes],
    durable: dict[Node, bytes],
    chance: tuple[random.Random, int],
) -> Iterator[tuple[list[int], dict[Node, bytes]]]:
    """The changes of names that are kept, and contents: all, or a sample of about so many, by chance."""
    rng, most = chance
    versions = {
        node: [durable.get(node, recorder.first.get(node, b"")), new[: len(new) // 2], new]
        for node, new in latest.items()
    }
    number = 2 ** len(pending) * 3 ** len(versions)
    if number <= most:
        for kept in itertools.product((False, True), repeat=len(pending)):
            for contents in itertools.product(*versions.values()):
                chosen = list(itertools.compress(pending, kept))
                yield chosen, dict(zip(versions, contents, strict=True))
        return
    for count in range(len(pending) + 1):  # those that a journal allows
        yield pending[:count], {}
    yield pending, dict(latest)
    for _ in range(most):
        chosen = [index for index in pending if rng.random() < 0.5]
        yield chosen, {node: rng.choice(contents) for node, contents in versions.items()}


def _tree(recorder: Recorder, chosen: list[int], contents: dict[Node, bytes]) -> Tree | None:
    """The tree after the chosen changes of names; None where a folder would have two names."""
    entries: dict[Node, dict[str, Node]] = {}
    met: set[Node] = set()

    def of(folder: Node) -> dict[str, Node]:
        return entries.setdefault(folder, dict(folder.entries))

    for index in chosen:
        for folder, name, node in recorder.operations[index].change:
            if node is None:
                of(folder).pop(name, None)
            else:
                of(folder)[name] = node

    def built(folder: Node) -> Tree | None:
        tree: Tree = {}
        for name, node in sorted(of(folder).items()):
            if not node.folder:
                tree[name] = contents.get(node, recorder.first.get(node, b""))
                continue
            if node in met:
                return None
            met.add(node)
            inner = built(node)
            if inner is None:
                return None
            tree[name] = inner
        return tree

    return built(recorder.start)


def materialise(tree: Tree, folder: Path) -> None:
    """Make the tree a real folder."""
    folder.mkdir(parents=True)
    for name, content in tree.items():
        if isinstance(content, bytes):
            (folder / name).write_bytes(content)
        else:
            materialise(content, folder / name)


def read_tree(folder: Path) -> Tree:
    """The tree of a real folder."""
    return {
        entry.name: read_tree(entry) if entry.is_dir() else entry.read_bytes() for entry in sorted(folder.iterdir())
    }
