"""An input: a command line, the files that it finds, and its environment. A text file when it is kept."""

import base64
import json
import shlex
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

COMMANDS = (
    "weave", "chart", "machines", "design", "mechanism", "cyclogram", "knot", "reproduce", "inspect", "check",
    "convert", "simulate",
)  # fmt: skip
TAKEN, OLD, MINE = "taken", "old", "mine.txt"
"""A folder that every input finds, one that some find with a result of ilmek, and a file that ilmek did not write."""


@dataclass(frozen=True)
class Case:
    """Arguments behind `ilmek`, contents of files by relative path, environment, and whether a terminal is attached."""

    arguments: tuple[str, ...]
    files: Mapping[str, bytes] = field(default_factory=dict)
    environment: Mapping[str, str] = field(default_factory=dict)
    terminal: bool = False

    @property
    def command(self) -> str:
        """The command; "other" where the first argument is none."""
        return next((word for word in self.arguments[:1] if word in COMMANDS), "other")

    @property
    def line(self) -> str:
        """The command line as typed, shortened."""
        variables = "".join(f"{name}={shlex.quote(value)} " for name, value in self.environment.items())
        return shortened(f"{variables}ilmek {shlex.join(self.arguments)}")

    def lay_out(self, folder: Path) -> None:
        """Write the files into an empty folder."""
        (folder / TAKEN).mkdir()
        (folder / TAKEN / MINE).write_bytes(b"mine")
        for name, content in self.files.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_bytes(content)

    def as_json(self) -> str:
        """The case as text: files in UTF-8 as they are, others in base 64."""
        data = {
            "arguments": self.arguments,
            "files": {name: _text(content) for name, content in self.files.items()},
            "environment": dict(self.environment),
            "terminal": self.terminal,
        }
        return json.dumps(data, indent=1) + "\n"


def read_case(text: str) -> Case:
    """The case that `as_json` wrote."""
    data: dict[str, Any] = json.loads(text)
    files = {
        name: base64.b64decode(content["base64"]) if isinstance(content, dict) else content.encode()
        for name, content in data["files"].items()
    }
    return Case(tuple(data["arguments"]), files, data.get("environment", {}), data.get("terminal", False))


def shortened(text: str, most: int = 300) -> str:
    """A text in one line of at most so many letters."""
    plain = "".join(letter if letter.isprintable() else f"\\x{ord(letter):02x}" for letter in text)
    return plain if len(plain) <= most else f"{plain[: most - 30]} ... ({len(plain)} letters)"


def _text(content: bytes) -> str | dict[str, str]:
    try:
        return content.decode()
    except UnicodeDecodeError:
        return {"base64": base64.b64encode(content).decode()}
