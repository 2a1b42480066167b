r"""The line of each key of a TOML or JSON text.

The readers of the standard library give values without lines; this one gives lines without values, for texts that those
readers accept. A value's path is the sequence of keys to it; entries of a list count from 0:

>>> toml_lines(tokens('name = "arm"\n[bodies.ground.points]\nA = [0,\n 1]'))[("bodies", "ground", "points", "A", 1)]
4
>>> json_lines(tokens('{"bodies":\n {"ground": {}}}'))[("bodies", "ground")]
2
"""

import json
import re
import tomllib
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import TypeAlias

from ilmek.errors import IlmekError

Token: TypeAlias = tuple[str, str, int]
"""Kind, text and line of a token; of the kind "rest" from a quote without an end to the end of the text."""

Path: TypeAlias = tuple[str | int, ...]
KeyLines: TypeAlias = dict[Path, int]
"""Path of a key or a list's entry -> line, counted from 1; the path of the whole text, (), is in line 1."""

_TOKEN = re.compile(
    r'''(?P<string>"""(?:\\.|[^\\])*?"{3,5}|\'\'\'.*?\'{3,5}|"(?!"")(?:\\.|[^"\\\n])*+"|'(?!'')[^'\n]*+')'''
    r"|(?P<comment>\#[^\n]*)|(?P<newline>\n)|(?P<mark>[\[\]{}=:,.])|(?P<word>[^\s\[\]{}=:,.\"'#]+)|(?P<rest>[\"'].*)",
    re.DOTALL,
)


def toml_lines(found: Iterable[Token]) -> KeyLines:
    """The line of every key of a TOML text that `tomllib` accepts, by its tokens."""
    scan = _Scan(deque(found), lambda word: str(tomllib.loads(f"key = {word}")["key"]))
    prefix: Path = ()
    while scan.skip_newlines():
        line = scan.line
        if scan.take_if("["):
            many = scan.take_if("[")
            prefix = scan.opened(scan.keys("]"), many)
            scan.put(prefix, line)
            if many:
                scan.take()
        else:
            path = prefix + scan.keys("=")
            scan.put(path, line)
            scan.value(path)
    return scan.lines


def json_lines(found: Iterable[Token]) -> KeyLines:
    """The line of every key of a JSON text that `json` accepts, by its tokens.

    Raises IlmekError for a key that is given twice.
    """
    scan = _Scan(deque(found), json.loads, once=True)
    scan.value(())
    return scan.lines


def tokens(text: str) -> Iterator[Token]:
    """Every token except comments, in linear time for any text."""
    line, at = 1, 0
    for token in _TOKEN.finditer(text):
        line += text.count("\n", at, token.start())
        at = token.start()
        if token.lastgroup != "comment":
            yield token.lastgroup or "", token[0], line


_RENAME = "give each its own name"


@dataclass(slots=True)
class _Scan:
    """The tokens left, and the lines found so far.

    once  a path may occur only once; Python's JSON reader accepts a key given twice
    """

    left: deque[Token]
    decode: Callable[[str], str]
    once: bool = False
    lines: KeyLines = field(default_factory=lambda: {(): 1})
    arrays: dict[Path, int] = field(default_factory=dict)

    @property
    def line(self) -> int:
        """Line of the next token."""
        return self.left[0][2]

    def take(self) -> Token:
        """The next token."""
        return self.left.popleft()

    def take_if(self, mark: str) -> bool:
        """Whether the next token is this mark, which is then removed."""
        if self.left and self.left[0][:2] == ("mark", mark):
            self.take()
            return True
        return False

    def skip_newlines(self) -> bool:
        """Remove newlines; whether any token is left."""
        while self.left and self.left[0][0] == "newline":
            self.take()
        return bool(self.left)

    def put(self, path: Path, line: int) -> None:
        """Record the line of a path and of its parents."""
        if self.once and path in self.lines:
            key = ".".join(str(key) for key in path)
            raise IlmekError(
                f"line {line}, {key}: is given twice", allowed=f"first given in line {self.lines[path]}", do=_RENAME
            )
        for size in range(1, len(path) + 1):
            self.lines.setdefault(path[:size], line)

    def keys(self, end: str) -> Path:
        """The dotted keys before a mark, which is removed too."""
        found: list[str] = []
        while not self.take_if(end):
            kind, text, _ = self.take()
            if kind != "mark":
                found.append(self.decode(text) if kind == "string" else text)
        return tuple(found)

    def opened(self, keys: Path, many: bool) -> Path:
        """The path of a table's heading, with the index of the entry for each list of tables."""
        path: Path = ()
        for depth, key in enumerate(keys):
            path += (key,)
            if many and depth == len(keys) - 1:
                self.arrays[path] = self.arrays.get(path, -1) + 1
            if path in self.arrays:
                path += (self.arrays[path],)
        return path

    def value(self, path: Path) -> None:
        """Skip a value; the entries of a list or table are recorded."""
        self.skip_newlines()
        if self.take_if("["):
            self._entries(path)
        elif self.take_if("{"):
            self._table(path)
        else:
            while self.left and self.left[0][0] != "newline" and self.left[0][1] not in (",", "]", "}"):
                self.take()

    def _entries(self, path: Path) -> None:
        number = 0
        while self.skip_newlines() and not self.take_if("]"):
            self.put((*path, number), self.line)
            self.value((*path, number))
            self.skip_newlines()
            self.take_if(",")
            number += 1

    def _table(self, path: Path) -> None:
        while self.skip_newlines() and not self.take_if("}"):
            line = self.line
            inner = path + self.keys(":" if self.once else "=")
            self.put(inner, line)
            self.value(inner)
            self.skip_newlines()
            self.take_if(",")
