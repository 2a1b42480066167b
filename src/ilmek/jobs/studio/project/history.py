"""The history of a file: its earlier states, for undo and redo across restarts.

One file of lines for each file of the project, to which lines are only appended; each line is synced. A line that a
kill cut off is not counted. The project's file is the truth: where it is not the current state of the history, another
program changed it, and it becomes a new state. The states before a change are in the history before the file changes,
so that a kill at any instant loses none.

    {"text": "..."}      a new state after the current one; states that were undone are dropped
    {"text": null}       the file was deleted
    {"move": -1}         undone: the state before is the current one
    {"move": 1}          redone
"""

import contextlib
import hashlib
import json
import os
from dataclasses import dataclass
from pathlib import Path

from ilmek.io.output import disk
from ilmek.jobs.studio.project.folder import OWN, cannot, write_bytes

MOST_STATES = 200
"""Largest number of states that are kept of a file."""

MOST_BYTES = 4_000_000
"""Size of a history at which it is written anew with the states that are kept; these take at most half."""

State = str | None
"""The text of a file; None: there is none."""


@dataclass(eq=False, slots=True)
class History:
    """States of a file and the index of the current one; -1: there is none."""

    path: Path
    states: list[State]
    at: int

    @property
    def current(self) -> State:
        """The current state."""
        return self.states[self.at] if self.at >= 0 else None

    def can(self, step: int) -> bool:
        """Whether there is a state before (-1) or after (1) the current one that is a text."""
        return self.next_text(step) is not None

    def next_text(self, step: int) -> int | None:
        """Number of moves to the next state that is a text in the direction of `step`; None if there is none."""
        index = self.at + step
        while 0 <= index < len(self.states):
            if self.states[index] is not None:
                return index - self.at
            index += step
        return None

    def add(self, state: State) -> None:
        """A new current state, if it is another one. Raises OutputError."""
        if self.current != state:
            self._append({"text": state})
            self.states[self.at + 1 :] = [state]
            self.at += 1
            self._shorten()

    def move(self, step: int) -> None:
        """Make the state `step` further the current one. Raises OutputError."""
        self._append({"move": step})
        self.at += step

    def _append(self, line: dict[str, object]) -> None:
        text = json.dumps(line) + "\n"  # ASCII: bytes that are not UTF-8 are kept as halves of pairs
        try:
            self.path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            handle = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o600)
            with os.fdopen(handle, "r+b") as file:
                size = file.seek(0, os.SEEK_END)
                torn = size > 0 and os.pread(file.fileno(), 1, size - 1) != b"\n"
                try:
                    file.write((b"\n" if torn else b"") + text.encode("ascii"))
                    file.flush()
                    os.fsync(file.fileno())
                except OSError:
                    with contextlib.suppress(OSError):
                        file.truncate(size)
                    raise
        except OSError as error:
            raise cannot("be written", self.path, error) from None

    def _shorten(self) -> None:
        """Write the history anew, where it has become too long."""
        too_many = len(self.states) > 2 * MOST_STATES
        if not too_many and self.path.stat().st_size <= MOST_BYTES:
            return
        kept: list[State] = []
        size = 0
        for state in reversed(self.states):
            size += len(state or "") * 2
            if kept and (len(kept) >= MOST_STATES or size > MOST_BYTES // 2):
                break
            kept.insert(0, state)
        lines = "".join(json.dumps({"text": state}) + "\n" for state in kept)
        write_bytes(self.path, lines.encode("ascii"))
        self.states, self.at = kept, len(kept) - 1


def history_path(base: Path, path: str) -> Path:
    """The file of the history of a project's file."""
    return base / OWN / "history" / f"{hashlib.sha256(path.encode()).hexdigest()[:32]}.jsonl"


def read_history(base: Path, path: str) -> History:
    """The history of a file; lines that cannot be read are left out."""
    file = history_path(base, path)
    states: list[State] = []
    at = -1
    try:
        lines = file.read_bytes().splitlines()
    except FileNotFoundError:
        lines = []
    except OSError as error:
        raise cannot("be read", file, error) from None
    for line in lines:
        entry = _entry(line)
        text, move = entry.get("text"), entry.get("move")
        if "text" in entry and (text is None or isinstance(text, str)):
            states[at + 1 :] = [text]
            at += 1
        elif isinstance(move, int) and 0 <= at + move < len(states):
            at += move
    return History(file, states, at)


def _entry(line: bytes) -> dict[str, object]:
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def move_history(base: Path, old: str, new: str) -> None:
    """Give the history of a file to its new name. Raises OutputError."""
    source = history_path(base, old)
    with contextlib.suppress(FileNotFoundError):
        try:
            disk.replace(source, history_path(base, new))
        except FileNotFoundError:
            raise
        except OSError as error:
            raise cannot("be written", source, error) from None
