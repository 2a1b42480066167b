"""JSON output in SI and radians with full precision; a number that is not finite becomes null."""

import json
from pathlib import Path

from ilmek.progress import SILENT, Progress
from ilmek.report import plain

CHUNKS = 10_000
"""Pieces of text between two reports of progress."""


def json_text(data: object, progress: Progress = SILENT) -> str:
    """The data as JSON text with a newline at the end. Raises Cancelled.

    >>> print(json_text({"crank": 0.25, "slope": float("nan")}), end="")
    {
      "crank": 0.25,
      "slope": null
    }
    """
    whole, parts = plain(data), []
    values = _values(whole)
    for count, part in enumerate(json.JSONEncoder(indent=2, allow_nan=False).iterencode(whole)):
        parts.append(part)
        if count % CHUNKS == 0:
            progress(min(1.0, count / values))
    return "".join(parts) + "\n"


def _values(data: object) -> int:
    """The number of values in plain data, at least 1."""
    inner = list(data.values()) if isinstance(data, dict) else data if isinstance(data, list) else []
    deep = inner and any(isinstance(value, dict | list) for value in inner)
    return 1 + (sum(map(_values, inner)) if deep else len(inner))


def write_json(path: Path, data: object) -> None:
    """Write the data to a file. Raises OSError."""
    path.write_text(json_text(data), encoding="utf-8")
