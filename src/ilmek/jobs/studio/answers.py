"""What a task of the studio gets beside its request, and what it may answer besides records."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import msgspec

from ilmek.progress import SILENT, Progress
from ilmek.records import json_value

PACKED = "application/vnd.ilmek.packed"
"""Media type of JSON with bytes behind it: see `packed`."""


@dataclass(frozen=True, slots=True)
class Binary:
    """An answer that is not JSON: media type and bytes."""

    kind: str
    body: bytes


def _unseen(news: object) -> None:
    """Nobody follows."""


@dataclass(frozen=True, slots=True)
class Context:
    """What a task gets beside its request.

    project   folder of the project; every file of the task lies in it
    progress  receives the progress; raises Cancelled
    show      sends a record to whoever follows the work, before its end
    announce  sends a record to every open page: a file has changed
    """

    project: str = "."
    progress: Progress = SILENT
    show: Callable[[object], None] = _unseen
    announce: Callable[[object], None] = _unseen

    @property
    def folder(self) -> Path:
        """The folder of the project."""
        return Path(self.project)


def packed(about: object, *parts: bytes) -> Binary:
    """JSON and arrays in one answer.

    Four bytes, little endian: the length of the JSON; the JSON, filled with spaces so that what follows begins at a
    multiple of eight bytes; then the parts, each filled with zeros to a multiple of eight. The JSON must state the
    lengths of the parts.
    """
    text = msgspec.json.encode(about, enc_hook=json_value)
    text += b" " * (-(len(text) + 4) % 8)
    filled = (part + bytes(-len(part) % 8) for part in parts)
    return Binary(PACKED, b"".join((len(text).to_bytes(4, "little"), text, *filled)))
