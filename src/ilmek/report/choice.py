"""Choices: what a design chose of what was left open, which check decided, and what the next cheaper one failed."""

from dataclasses import dataclass
from typing import Any

from ilmek.report.json import plain


@dataclass(frozen=True, slots=True)
class Choice:
    """A choice of a design.

    name          what was chosen, a parameter's name where it is one         chosen  with its unit
    decided_by    the check that the next cheaper fails, or the aim: price, time
    next_cheaper  the next cheaper one; "" where this is the cheapest
    failed        value and limit of the check that it fails; "" where none
    """

    name: str
    chosen: str
    decided_by: str
    next_cheaper: str = ""
    failed: str = ""

    def as_json(self) -> dict[str, Any]:
        """The choice as plain data."""
        return {name: plain(getattr(self, name)) for name in Choice.__slots__}
