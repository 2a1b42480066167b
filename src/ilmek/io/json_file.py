"""JSON output in SI and radians with full precision; a number that is not finite becomes null."""

import json
from pathlib import Path
from typing import Any

from ilmek.report import plain


def json_text(data: Any) -> str:
    """The data as JSON text with a newline at the end.

    >>> print(json_text({"crank": 0.25, "slope": float("nan")}), end="")
    {
      "crank": 0.25,
      "slope": null
    }
    """
    return json.dumps(plain(data), indent=2, allow_nan=False) + "\n"


def write_json(path: Path, data: Any) -> None:
    """Write the data to a file. Raises OSError."""
    path.write_text(json_text(data), encoding="utf-8")
