"""Errors of the system at any call: the old results stay, or the new ones are in place, and the message is true."""

import errno
import io
import os
import random
import re
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from output_scenarios import SCENARIOS, Scenario, at, expect, hidden, news, nexts, not_atomic, prepare, write
from power_cut import functions, read_tree

from ilmek.errors import OutputError
from ilmek.io.output import disk

CODES = (errno.ENOSPC, errno.EIO, errno.EACCES, errno.EROFS)


class Faults:
    """Calls of the system, counted; those whose numbers are `failing` raise an error."""

    def __init__(self, failing: Callable[[int], bool], code: int) -> None:
        self.failing, self.code, self.number = failing, code, 0

    def wrap(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function, with such errors."""

        def call(*arguments: Any, **settings: Any) -> Any:
            self.number += 1
            if self.failing(self.number):
                raise OSError(self.code, os.strerror(self.code), str(arguments[0]))
            return function(*arguments, **settings)

        return call


def run(scenario: Scenario, root: Path, faults: Faults, monkeypatch: pytest.MonkeyPatch) -> str:
    """The message of a run with faults; empty where it succeeds."""
    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", lambda _: None)
        if not scenario.atomic:
            patched.setattr(disk, "exchange", not_atomic)
        for name, function in functions(disk).items():
            patched.setattr(disk, name, faults.wrap(function))
        for module, name in ((os, "open"), (io, "open"), (Path, "mkdir"), (Path, "chmod")):
            patched.setattr(module, name, faults.wrap(getattr(module, name)))
        try:
            write(root, news(scenario))
        except OutputError as error:
            return str(error)
    return ""


def wrong(scenario: Scenario, root: Path, message: str) -> Iterator[str]:
    """What is wrong after a run that ended with `message`, and with the run after it."""
    yield from untrue(scenario, root, message)
    expect(scenario, root)
    repaired = read_tree(root)
    for name, (old, new) in scenario.targets.items():
        if at(repaired, name) not in (old, new):
            yield f"{name} is then {at(repaired, name)}"
    write(root, nexts(scenario))
    written = read_tree(root)
    for name, content in nexts(scenario).items():
        if at(written, name) != content:
            yield f"the next run gives {at(written, name)}"
    left = {name for name in hidden(written) if not name.endswith((".kept", ".kept.json"))}
    if left or ("kept:" not in message and any(hidden(written))):
        yield f"left: {list(hidden(written))}"


def untrue(scenario: Scenario, root: Path, message: str) -> Iterator[str]:
    """What a message states that is not so."""
    tree = read_tree(root)
    kept = dict(re.findall(r"place: (\S+); the old one is kept: (\S+?)(?:;|$)", message))
    set_aside = [Path(path) for path in re.findall(r"the old result is kept: (\S+);", message)]
    for name, (old, new) in scenario.targets.items():
        found, path = at(tree, name), str(root / name)
        if not message or f"in place: {path}" in message:
            if found != new:
                yield f"{name} is {found}, not new"
        elif found != old and not (found is None and any(at(tree, p.name) == old for p in set_aside)):
            yield f"{name} is {found}, not old"
        if path in kept and at(tree, str(Path(kept[path]).relative_to(root))) != old:
            yield f"{name}: the old result is not where it should be"


def check(scenario: Scenario, root: Path, faults: Faults, monkeypatch: pytest.MonkeyPatch) -> str:
    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", lambda _: None)
        prepare(scenario, root)
        message = run(scenario, root, faults, monkeypatch)
        found = list(wrong(scenario, root, message))
    assert not found, (message, found)
    return message


@pytest.mark.matrix(light=8)
@pytest.mark.parametrize("lasting", [False, True])
@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda scenario: scenario.name)
def test_an_error_at_any_call(scenario: Scenario, lasting: bool, memory: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    messages = set()
    for first in count(1):
        faults = Faults(lambda n, k=first: n >= k if lasting else n == k, CODES[first % 4])  # type: ignore[misc]
        messages.add(check(scenario, memory / str(first), faults, monkeypatch))
        if faults.number < first:
            break
    assert "" in messages
    assert any("nothing was written" in message for message in messages)


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda scenario: scenario.name)
def test_two_errors(scenario: Scenario, memory: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    chance = random.Random(1)
    for number in range(60):
        first = chance.randint(1, 60)
        pair = {first, first + chance.randint(1, 12)}
        faults = Faults(pair.__contains__, errno.EIO)
        check(scenario, memory / str(number), faults, monkeypatch)


@pytest.mark.parametrize("name", ["folder replaced", "file replaced", "file replaced by a rename"])
def test_an_undo_that_fails_keeps_the_old_result_where_it_can_be_seen(
    name: str, memory: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scenario = next(scenario for scenario in SCENARIOS if scenario.name == name)
    root, calls = memory / "root", count(1)
    prepare(scenario, root)
    (output,) = scenario.targets
    old = scenario.targets[output][0]

    def failing(path: Path, mode: int | None = None) -> None:
        if path == root and scenario.targets[output][1] == at(read_tree(root), output):
            raise OSError(errno.EIO, "Input/output error")
        if mode is not None:
            path.chmod(mode)

    def once(first: Path, second: Path) -> bool:
        if not scenario.atomic:
            return False
        if next(calls) > 1:
            raise OSError(errno.EIO, "Input/output error")
        return exchange(first, second)

    def into_staging_only(source: Path, target: Path) -> None:
        if source.name.startswith("old"):
            raise OSError(errno.EIO, "Input/output error")
        replace(source, target)

    exchange, replace = disk.exchange, disk.replace
    with monkeypatch.context() as patched:
        patched.setattr(disk, "sync", failing)
        patched.setattr(disk, "exchange", once)
        patched.setattr(disk, "replace", into_staging_only)
        with pytest.raises(OutputError) as caught:
            write(root, news(scenario))
    stated = re.search(r"the new result is in place: \S+; the old one is kept: (\S+)$", str(caught.value))
    assert stated, str(caught.value)
    assert at(read_tree(root), Path(stated[1]).name) == old
    assert not Path(stated[1]).name.startswith(".")
    write(root, nexts(scenario))
    assert at(read_tree(root), Path(stated[1]).name) == old
